// Polygons of cells as UGRID: each polygon is a face, with the center of its cell as coordinates, and the columns as
// data of faces. Coordinates are those of a mesh in UGRID: degrees on a map or a sphere.
#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/conversion/globe.hpp"
#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/formats/netcdf/ugrid.hpp"
#include "io/operators/cell_files.hpp"

namespace temper::io {
namespace {

constexpr std::int32_t kNoNode = -1;  // the _FillValue

class CellsUgrid {
 public:
  explicit CellsUgrid(const CellJob& job)
      : job_(job), c_(job.cells), kept_(job.file), out_(job.path, needs_cdf5(MeshFile(), 2 * c_.corners.size())) {}

  void write() {
    nodes_ = out_.dimension(named("nodes"), std::max(c_.points.size(), c_.sphere_points.size()));
    faces_ = out_.dimension(named("faces"), c_.n_polygons());
    kept_.copy(nullptr, out_, NetcdfWriter::kFile);
    out_.attribute(NetcdfWriter::kFile, "Conventions", kUgridConventions);
    topology();
    face_nodes();
    in_degrees_ = job_.file.map() != nullptr || job_.file.sphere() != nullptr;
    FlatPlaces places = in_degrees_ ? flat_places(job_) : FlatPlaces{false, c_.centers, c_.points};
    std::vector<Vec2> centers;
    for (const std::uint32_t cell : c_.cells) centers.push_back(places.centers[cell]);
    coordinates("node", nodes_, places.points, "corners of cells");
    coordinates("face", faces_, centers,
                c_.of == CellsOf::vertices ? "vertices, the centers of cells" : "orthocenters, the centers of cells");
    for (const CellColumn& column : job_.columns()) data(column);
    kept_.write_values(out_);
    out_.finish([this](std::string_view bytes) { job_.outputs.open(job_.path).put(bytes); });
  }

 private:
  [[nodiscard]] static std::string named(std::string_view what) { return text(kUsualTopology, "_", what); }

  void topology() {
    const int id = out_.variable(std::string(kUsualTopology), {}, std::vector<std::int32_t>{0});
    out_.attribute(id, "cf_role", "mesh_topology");
    out_.attribute(id, "topology_dimension", std::int32_t{2});
    out_.attribute(id, "node_coordinates", text(named("node_x"), " ", named("node_y")));
    out_.attribute(id, "face_node_connectivity", named("face_nodes"));
    out_.attribute(id, "face_coordinates", text(named("face_x"), " ", named("face_y")));
    out_.attribute(id, "face_dimension", named("faces"));
  }

  void face_nodes() {
    std::size_t most = 0;
    for (std::size_t p = 0; p < c_.n_polygons(); ++p) most = std::max(most, c_.polygon(p).size());
    std::vector<std::int32_t> rows;
    rows.reserve(most * c_.n_polygons());
    for (std::size_t p = 0; p < c_.n_polygons(); ++p) {
      for (const std::uint32_t corner : c_.polygon(p)) rows.push_back(static_cast<std::int32_t>(corner));
      rows.resize(most * (p + 1), kNoNode);
    }
    const int id =
        out_.variable(named("face_nodes"), {faces_, out_.dimension(named("max_face_nodes"), most)}, std::move(rows));
    out_.attribute(id, "cf_role", "face_node_connectivity");
    out_.attribute(id, "start_index", std::int32_t{0});
    out_.attribute(id, "_FillValue", kNoNode);
  }

  /// Units and coordinate system are those of the nodes of the file that the mesh came from, if it was UGRID.
  void coordinates(const std::string& what, int dimension, const std::vector<Vec2>& places, std::string_view is) {
    const NetcdfVariable* const topology = kept_.find("cf_role", "mesh_topology");
    const std::string both = kept_.text_of(topology, "node_coordinates");
    const std::size_t blank = both.find(' ');
    for (const bool is_x : {true, false}) {
      std::vector<double> values;
      values.reserve(places.size());
      for (const Vec2 p : places) values.push_back(is_x ? p.x : p.y);
      const int id = out_.variable(named(text(what, is_x ? "_x" : "_y")), {dimension}, std::move(values));
      out_.attribute(id, "long_name", is);
      if (in_degrees_) {
        name_degrees(out_, id, is_x ? kLongitude : kLatitude);
        continue;
      }
      out_.attribute(id, "standard_name", is_x ? kProjectedX : kProjectedY);
      out_.attribute(id, "units", "m");
      if (topology == nullptr || blank == std::string::npos) continue;
      const NetcdfVariable* const kept = kept_.find(is_x ? both.substr(0, blank) : both.substr(blank + 1));
      for (const char* attribute : {"standard_name", "units", "grid_mapping"})
        if (kept != nullptr) kept_.copy(kept, out_, id, attribute);
    }
  }

  void data(const CellColumn& column) {
    const std::string name(column.name);
    int id = -1;
    if (const auto* const integers = std::get_if<CellColumn::Integers>(&column.of)) {
      std::vector<std::int32_t> values;
      for (const std::uint32_t cell : c_.cells) values.push_back(static_cast<std::int32_t>((*integers)(cell)));
      id = out_.variable(name, {faces_}, std::move(values));
    } else if (const auto* const reals = std::get_if<CellColumn::Reals>(&column.of)) {
      std::vector<double> values;
      for (const std::uint32_t cell : c_.cells) values.push_back((*reals)(cell));
      id = out_.variable(name, {faces_}, std::move(values));
    } else {
      std::vector<std::string_view> values;
      for (const std::uint32_t cell : c_.cells) values.push_back(std::get<CellColumn::Texts>(column.of)(cell));
      id = out_.texts(name, faces_, values);
    }
    out_.attribute(id, "long_name", column.is);
    out_.attribute(id, "mesh", kUsualTopology);
    out_.attribute(id, "location", "face");
  }

  const CellJob& job_;
  const CellPolygons& c_;
  NetcdfKept kept_;
  NetcdfWriter out_;
  bool in_degrees_ = false;
  int nodes_ = -1, faces_ = -1;
};

}  // namespace

void write_cells_ugrid(const CellJob& job) { CellsUgrid(job).write(); }

}  // namespace temper::io

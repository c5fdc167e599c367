// UGRID 1.0 in NetCDF (CF conventions for unstructured grids): attributes of a topology variable name the others.
//
//   node_coordinates  face_node_connectivity     read; numbers from start_index, 0 unless it says 1; _FillValue
//                                                or NaN: none
//   edge_node_connectivity  edge_face_connectivity  face_edge_connectivity  face_coordinates  edge_coordinates
//                                                written: faces are at their orthocenters, edges at weighted midpoints
//
// The node variable MESH_node_weight holds weights. Other variables of nodes and faces with one number each are data.
// MESH is the name that the data begin with, such as mesh2d of mesh2d_node_z, or mesh.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "io/containers/hdf5_magic.hpp"
#include "io/conversion/globe.hpp"
#include "io/formats/format.hpp"
#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

Document read_mpas_from(const NetcdfReader& in, const std::string& path);
std::optional<Document> read_grid_from(const NetcdfReader& in, const Source& source);

bool sniff_ugrid(std::string_view head) { return is_netcdf(head); }

namespace {

constexpr std::int32_t kUgridNone = -1;  // the _FillValue of what temper writes

class UgridReader {
 public:
  UgridReader(const NetcdfReader& in, const NetcdfVariable& topology, const std::string& path)
      : in_(in), topology_(topology), document_(new_document(path)) {}

  Document read() {
    document_.file.format = "ugrid";
    nodes();
    faces();
    const NetcdfVariable* weight = in_.find(text(topology_.name, "_node_weight"));
    if (weight != nullptr && weight->sizes.size() == 1) {
      used_.insert(weight->name);
      document_.file.weights = to_doubles(in_.values(*weight));
      expect(document_.file.weights.size() == document_.file.points.size(), weight->name);
    }
    read_netcdf_extras(in_, document_);
    data();
    return std::move(document_);
  }

 private:
  const std::string& path() const { return document_.names->path; }
  void expect(bool good, std::string_view variable) const {
    if (!good) fail(ErrorCode::size_mismatch, path(), "variable ", variable, " has a wrong size");
  }

  /// The names in an attribute of the topology.
  std::vector<std::string> named(const char* attribute) {
    const std::string all = in_.text_attribute(&topology_, attribute);
    Scanner scanner(path(), all);
    std::vector<std::string> names;
    while (!scanner.at_end()) names.emplace_back(scanner.word("a name"));
    used_.insert(names.begin(), names.end());
    return names;
  }

  void nodes() {
    const auto names = named("node_coordinates");
    if (names.size() != 2)
      fail(ErrorCode::unsupported, path(), "has ", names.size(), " node_coordinates; temper reads x and y");
    const NetcdfVariable &vx = in_.variable(names[0]), &vy = in_.variable(names[1]);
    expect(vx.sizes.size() == 1, vx.name);
    expect(vy.sizes == vx.sizes, vy.name);
    node_dimension_ = vx.dimensions[0];
    const auto x = to_doubles(in_.values(vx)), y = to_doubles(in_.values(vy));
    const std::string_view of_x = axis(vx), of_y = axis(vy);
    const bool degrees = !of_x.empty() && !of_y.empty() && of_x != of_y, turned = degrees && of_x == kLatitude;
    if (degrees) document_.file.points_in = DegreePoints{};
    for (std::size_t i = 0; i < x.size(); ++i) {
      document_.file.points.push_back(turned ? Vec2{y[i], x[i]} : Vec2{x[i], y[i]});
    }
  }

  /// Longitude or latitude, by CF's standard names and units (degrees_east, degree_N, degreesE, …), or neither.
  /// Coordinates of a rotated pole are plain degrees.
  std::string_view axis(const NetcdfVariable& v) const {
    const std::string name = in_.text_attribute(&v, "standard_name"), units = in_.text_attribute(&v, "units");
    const auto ends = [&](std::string_view word) { return units.starts_with("degree") && units.ends_with(word); };
    if (name == kLongitude || ends("_east") || ends("E")) return kLongitude;
    if (name == kLatitude || ends("_north") || ends("N")) return kLatitude;
    return {};
  }

  void faces() {
    const auto names = named("face_node_connectivity");
    if (names.size() != 1)
      fail(ErrorCode::unsupported, path(), "has no face_node_connectivity. Next: write the mesh with its faces");
    const NetcdfVariable& v = in_.variable(names[0]);
    expect(v.sizes.size() == 2, v.name);
    // Rows are faces, unless face_dimension names the columns.
    const std::string face_dimension = in_.text_attribute(&topology_, "face_dimension");
    const bool turned = !face_dimension.empty() && in_.dimension_name(v.dimensions[1]) == face_dimension &&
                        in_.dimension_name(v.dimensions[0]) != face_dimension;
    face_dimension_ = v.dimensions[turned ? 1 : 0];
    const std::size_t n = v.sizes[turned ? 1 : 0], most = v.sizes[turned ? 0 : 1];
    const double first = in_.number_attribute(&v, "start_index").value_or(0);
    if (first != 0 && first != 1) fail(ErrorCode::unsupported, path(), "has start_index ", first, "; expected 0 or 1");
    const std::int64_t start = first == 1 ? 1 : 0;
    const auto fill = in_.number_attribute(&v, "_FillValue");
    const auto all = in_.integers(v);
    document_.names->points = RunLength(start, document_.file.points.size());
    document_.names->triangles = RunLength(start, n);
    for (std::size_t face = 0; face < n; ++face) {
      std::array<std::int32_t, 3> corners = {};
      std::size_t count = 0;
      for (std::size_t k = 0; k < most; ++k) {
        const std::int64_t number = all[turned ? k * n + face : face * most + k];
        if (number == NetcdfReader::kNoInteger || (fill && static_cast<double>(number) == *fill)) continue;
        if (!std::in_range<std::int32_t>(number)) {
          fail(ErrorCode::index_out_of_range, path(), "triangle ", static_cast<std::int64_t>(face) + start,
               " uses vertex ", number, ", which is beyond 32 bits");
        }
        if (count < 3) corners[count] = static_cast<std::int32_t>(number - start);
        ++count;
      }
      if (count != 3) {
        fail(ErrorCode::unsupported, path(), "face ", static_cast<std::int64_t>(face) + start, " has ", count,
             " corners; temper reads triangles");
      }
      document_.file.triangles.push_back(corners);
    }
  }

  /// Other variables become data of their location.
  void data() {
    for (const char* attribute :
         {"edge_node_connectivity", "face_edge_connectivity", "edge_face_connectivity", "face_face_connectivity",
          "boundary_node_connectivity", "face_coordinates", "edge_coordinates", "boundary_coordinates"}) {
      static_cast<void>(named(attribute));
    }
    used_.insert(topology_.name);
    std::vector<std::string_view> dropped;
    for (const NetcdfVariable& v : in_.variables()) {
      if (used_.contains(v.name) || is_netcdf_extra(in_, v)) continue;
      const bool one = v.scalar && v.dimensions.size() == 1;
      if (one && v.dimensions[0] == node_dimension_) {
        add_netcdf_data(in_, v, document_.file.point_data);
      } else if (one && v.dimensions[0] == face_dimension_) {
        add_netcdf_data(in_, v, document_.file.cell_data);
      } else {
        dropped.push_back(v.name);
      }
    }
    if (!dropped.empty())
      document_.file.warnings.push_back(text(path(), ": variables are dropped: ", list_of(dropped)));
  }

  const NetcdfReader& in_;
  const NetcdfVariable& topology_;
  Document document_;
  std::set<std::string> used_;
  int node_dimension_ = -1, face_dimension_ = -1;
};

// --- writing ---------------------------------------------------------------------------------------------

/// The name that the data have in front of _node_ or _face_, as in mesh2d_node_z; else "mesh". So names that a solver
/// looks for stay what they are.
std::string name_of_topology(const MeshFile& file) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  for (const auto& [data, location] : {std::pair{&file.point_data, "_node_"}, std::pair{&file.cell_data, "_face_"}}) {
    for (const DataArray& a : *data) {
      const std::size_t at = a.name.find(location);
      if (at == std::string::npos || at == 0) continue;
      std::string name = a.name.substr(0, at);
      if (name.find_first_not_of(kPlain) == std::string::npos && name[0] > '9') return name;
    }
  }
  return "mesh";
}

class UgridWriter {
 public:
  explicit UgridWriter(const WriteJob& job)
      : job_(job),
        m_(mesh_for_netcdf(job, "UGRID")),
        name_(name_of_topology(m_.file)),
        out_(job.path, needs_cdf5(m_.file, std::max(2 * m_.complex.edges.size(), 3 * m_.mesh.n_triangles()))) {}

  void write() {
    nodes_ = out_.dimension(named("nodes"), m_.mesh.n_vertices());
    faces_ = out_.dimension(named("faces"), m_.mesh.n_triangles());
    edges_ = out_.dimension(named("edges"), m_.complex.edges.size());
    out_.attribute(NetcdfWriter::kFile, "Conventions", "CF-1.8 UGRID-1.0");
    topology();
    coordinates();
    connectivity();
    if (!m_.file.weights.empty()) {
      const int id = out_.variable(named("node_weight"), {nodes_}, m_.file.weights);
      const std::string map =
          m_.file.map() != nullptr      ? text(" on the map ", projection_text(m_.file.map()->projection))
          : m_.file.sphere() != nullptr ? text(" on the sphere of radius ", m_.file.sphere()->radius)
                                        : std::string();
      out_.attribute(id, "long_name", text("weight of the power diagram, a squared length", map));
      out_.attribute(id, "units", "m2");
      on(id, "node");
    }
    if (m_.file.sphere() != nullptr && m_.file.sphere()->radius != Projection{}.radius) {
      job_.warn("points are longitude and latitude, without the radius: give --projection sphere:radius=",
                m_.file.sphere()->radius, " where the file is read again");
    }
    write_netcdf_extras(out_, job_, m_.file, {nodes_, faces_, name_});
    out_.finish(job_.outputs.open(job_.path));
  }

 private:
  [[nodiscard]] std::string named(std::string_view what) const { return text(name_, "_", what); }
  [[nodiscard]] std::string both(std::string_view what) const { return text(named(what), "_x ", named(what), "_y"); }

  void on(int id, std::string_view location) {
    out_.attribute(id, "mesh", name_);
    out_.attribute(id, "location", location);
  }

  void topology() {
    const int id = out_.variable(name_, {}, std::vector<std::int32_t>{0});
    out_.attribute(id, "cf_role", "mesh_topology");
    out_.attribute(id, "topology_dimension", std::int32_t{2});
    out_.attribute(id, "node_coordinates", both("node"));
    out_.attribute(id, "face_node_connectivity", named("face_nodes"));
    out_.attribute(id, "edge_node_connectivity", named("edge_nodes"));
    out_.attribute(id, "face_edge_connectivity", named("face_edges"));
    out_.attribute(id, "edge_face_connectivity", named("edge_faces"));
    out_.attribute(id, "face_coordinates", both("face"));
    out_.attribute(id, "edge_coordinates", both("edge"));
    out_.attribute(id, "face_dimension", named("faces"));
    out_.attribute(id, "edge_dimension", named("edges"));
  }

  void places(const std::string& what, int dimension, const std::vector<Vec2>& all, const char* long_name) {
    const bool degrees = m_.file.map() != nullptr || m_.file.sphere() != nullptr;
    for (const bool is_x : {true, false}) {
      std::vector<double> values(all.size());
      for (std::size_t i = 0; i < all.size(); ++i) values[i] = is_x ? all[i].x : all[i].y;
      const int id = out_.variable(named(text(what, is_x ? "_x" : "_y")), {dimension}, std::move(values));
      out_.attribute(id, "long_name", long_name);
      if (degrees) {
        name_degrees(out_, id, is_x ? kLongitude : kLatitude);
      } else {
        out_.attribute(id, "standard_name", is_x ? "projection_x_coordinate" : "projection_y_coordinate");
        out_.attribute(id, "units", "m");
      }
    }
  }

  /// Points of the plane in the file's coordinates: on a map as longitude and latitude.
  [[nodiscard]] std::vector<Vec2> unmapped(const std::vector<Vec2>& points) const {
    return m_.file.map() != nullptr ? lon_lat_of_places(m_.file, m_.mesh, points) : points;
  }
  [[nodiscard]] static std::vector<Vec2> degrees_of(const std::vector<Vec3>& points) {
    std::vector<Vec2> all;
    all.reserve(points.size());
    for (const Vec3 p : points) all.push_back(lon_lat_of(p));
    return all;
  }

  void coordinates() {
    const DecComplex& c = m_.complex;
    std::vector<Vec2> midpoints;
    midpoints.reserve(c.edges.size());
    for (const DecEdge& edge : c.edges) midpoints.push_back(edge.midpoint);
    const bool sphere = m_.file.sphere() != nullptr;
    places("node", nodes_, m_.file.map() != nullptr ? *lon_lat_of_points(m_.file) : m_.file.points, "vertices");
    places("face", faces_, sphere ? degrees_of(c.sphere_orthocenters.raw()) : unmapped(c.orthocenters.raw()),
           "orthocenters");
    places("edge", edges_, sphere ? degrees_of(c.sphere_midpoints.raw()) : unmapped(midpoints), "weighted midpoints");
  }

  void connectivity() {
    const DecComplex& c = m_.complex;
    const auto number = [](auto id) { return id.valid() ? static_cast<std::int32_t>(id.index) : kUgridNone; };
    std::vector<std::int32_t> face_nodes, face_edges, edge_nodes, edge_faces;
    for (const HalfedgeId h : m_.mesh.halfedges()) {
      face_nodes.push_back(number(m_.mesh.origin(h)));
      face_edges.push_back(number(c.edge_of_halfedge[h]));
    }
    for (std::size_t i = 0; i < c.edges.size(); ++i) {
      const DecEdge& e = c.edges[EdgeId(i)];
      // The triangle that exists comes first.
      const TriangleId first = e.left.valid() ? e.left : e.right, second = e.left.valid() ? e.right : e.left;
      edge_nodes.insert(edge_nodes.end(), {number(e.from), number(e.to)});
      edge_faces.insert(edge_faces.end(), {number(first), number(second)});
    }
    const int two = out_.dimension("TWO", 2), three = out_.dimension("THREE", 3);
    table(named("face_nodes"), "face_node_connectivity", {faces_, three}, std::move(face_nodes));
    table(named("face_edges"), "face_edge_connectivity", {faces_, three}, std::move(face_edges));
    table(named("edge_nodes"), "edge_node_connectivity", {edges_, two}, std::move(edge_nodes));
    const int id = table(named("edge_faces"), "edge_face_connectivity", {edges_, two}, std::move(edge_faces));
    out_.attribute(id, "_FillValue", kUgridNone);
  }

  int table(const std::string& name, const char* role, const std::vector<int>& dimensions,
            std::vector<std::int32_t> values) {
    const int id = out_.variable(name, dimensions, std::move(values));
    out_.attribute(id, "cf_role", role);
    out_.attribute(id, "start_index", std::int32_t{0});
    return id;
  }

  const WriteJob& job_;
  NetcdfMesh m_;
  const std::string name_;  // of the topology
  NetcdfWriter out_;
  int nodes_ = -1, faces_ = -1, edges_ = -1;
};

/// NetCDF files of any kind: the first bytes do not determine the format, the variables do.
Document read_ugrid_from(const NetcdfReader& in, const Source& source) {
  const std::string& path = source.path;
  if (in.find("cellsOnVertex") != nullptr && in.find("xCell") != nullptr) return read_mpas_from(in, path);
  for (const NetcdfVariable& v : in.variables()) {
    if (in.text_attribute(&v, "cf_role") != "mesh_topology") continue;
    if (in.number_attribute(&v, "topology_dimension").value_or(2) != 2) continue;
    return UgridReader(in, v, path).read();
  }
  if (auto grid = read_grid_from(in, source)) return *std::move(grid);
  if (in.find("connect1") != nullptr)
    fail(ErrorCode::unsupported, path, "is an Exodus mesh, which temper does not read; meshio converts it");
  // Recognized by the name of a group, which libnetcdf does not show among variables.
  if (is_hdf5(source.bytes) && source.bytes.find("ENS_MAA") != std::string::npos)
    fail(ErrorCode::unsupported, path, "is a MED mesh, which temper does not read; meshio converts it");
  fail(ErrorCode::unsupported, path,
       "is NetCDF without a mesh that temper reads: neither MPAS nor a two-dimensional topology of UGRID. Next: write "
       "the "
       "mesh as UGRID with its faces");
}

}  // namespace

Document read_ugrid(Source& source) { return read_ugrid_from(NetcdfReader(source), source); }

void write_ugrid(const WriteJob& job) { UgridWriter(job).write(); }

}  // namespace temper::io

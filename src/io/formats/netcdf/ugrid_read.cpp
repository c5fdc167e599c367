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
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "io/containers/hdf5_magic.hpp"
#include "io/conversion/bed.hpp"
#include "io/conversion/globe.hpp"
#include "io/conversion/planar_faces.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/formats/format.hpp"
#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/formats/netcdf/ugrid.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

Document read_mpas_from(const NetcdfReader& in, const std::string& path);
std::optional<Document> read_grid_from(const NetcdfReader& in, const Source& source);
bool is_icon(const NetcdfReader& in);
Document read_icon(const NetcdfReader& in, const std::string& path);
Document read_exodus(const NetcdfReader& in, const std::string& path);

bool sniff_ugrid(std::string_view head) { return is_netcdf(head); }

namespace {

/// The variables of D-Flow FM's older nets (net.nc), which have no topology; numbers count from 1.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOldNet = {
    {{"node_coordinates", "NetNode_x NetNode_y"},
     {"face_node_connectivity", "NetElemNode"},
     {"edge_node_connectivity", "NetLink"}}};
constexpr std::string_view kOldLevel = "NetNode_z";

double in_degrees_of(double radians) { return radians * (180 / std::numbers::pi); }
bool is_meter(std::string_view units) {
  constexpr std::array kMeters = {"m", "meter", "meters", "metre", "metres", "1"};
  return std::ranges::find(kMeters, units) != kMeters.end();
}

class UgridReader {
 public:
  /// `topology`: null for the older nets of D-Flow FM, whose variables have fixed names.
  UgridReader(const NetcdfReader& in, const NetcdfVariable* topology, const std::string& path)
      : in_(in), topology_(topology), document_(new_document(path)), kept_(in) {}

  Document read() {
    document_.file.format = "ugrid";
    nodes();
    faces();
    const NetcdfVariable* weight = in_.find(text(name(), "_node_weight"));
    if (weight != nullptr && weight->sizes.size() == 1) {
      used_.insert(weight->name);
      document_.file.weights = to_doubles(in_.unpacked(*weight));
      expect(document_.file.weights.size() == document_.file.points.size(), weight->name);
    }
    read_netcdf_extras(in_, document_, kept_);
    data();
    keep_attributes();
    return std::move(document_);
  }

 private:
  const std::string& path() const { return document_.names->path; }
  std::string name() const { return topology_ != nullptr ? topology_->name : "mesh2d"; }
  void expect(bool good, std::string_view variable) const {
    if (!good) fail(ErrorCode::size_mismatch, path(), "variable ", variable, " has a wrong size");
  }

  /// The names in an attribute of the topology.
  std::vector<std::string> named(const char* attribute) {
    std::string all = topology_ != nullptr ? in_.text_attribute(topology_, attribute) : std::string();
    for (const auto& [role, variables] : kOldNet) {
      if (topology_ == nullptr && role == attribute && in_.find(variables.substr(0, variables.find(' '))) != nullptr)
        all = variables;
    }
    Scanner scanner(path(), all);
    std::vector<std::string> names;
    while (!scanner.at_end()) names.emplace_back(scanner.word("a name"));
    used_.insert(names.begin(), names.end());
    return names;
  }

  void nodes() {
    const auto both = axes();
    const NetcdfVariable *const vx = both.first, *const vy = both.second;
    expect(vx->sizes.size() == 1, vx->name);
    expect(vy->sizes == vx->sizes, vy->name);
    node_dimension_ = vx->dimensions[0];
    auto x = to_doubles(in_.unpacked(*vx)), y = to_doubles(in_.unpacked(*vy));
    const std::string units = in_.text_attribute(vx, "units"), of_y = in_.text_attribute(vy, "units");
    const bool is_globe = axis(*vx) == kLongitude && axis(*vy) == kLatitude;
    if (is_globe) {
      document_.file.points_in = DegreePoints{};
      if (is_radian(units)) std::ranges::for_each(x, [](double& angle) { angle = in_degrees_of(angle); });
      if (is_radian(of_y)) std::ranges::for_each(y, [](double& angle) { angle = in_degrees_of(angle); });
    } else if (units != of_y) {
      fail(ErrorCode::unsupported, path(), "variable ", vx->name, " is in ", in_quotes(units), ", and ", vy->name,
           " in ", in_quotes(of_y), "; expected the same units");
    } else if (!units.empty() && !is_meter(units)) {
      document_.file.warnings.push_back(text(path(), ": coordinates are in ", units, ": so are lengths and sizes"));
    }
    document_.may_be_degrees = !is_globe && units.empty() && in_.text_attribute(vx, "standard_name").empty();
    for (std::size_t i = 0; i < x.size(); ++i) document_.file.points.push_back({x[i], y[i]});
    for (const NetcdfVariable* const v : {vx, vy}) {
      kept_.variable(*v, [&](std::string_view name, const std::string& value) {
        return (name == "standard_name" && value == (v == vx ? kProjectedX : kProjectedY)) ||
               (name == "units" && value == "m") || (name == "long_name" && value == kNodesLongName);
      });
    }
    coordinates_ = text(vx->name, " ", vy->name);
  }

  /// The variables of x and y: by what they say of themselves, else in their order.
  std::pair<const NetcdfVariable*, const NetcdfVariable*> axes() {
    std::vector<const NetcdfVariable*> all;
    for (const std::string& name : named("node_coordinates")) {
      if (const NetcdfVariable* const v = in_.find(name)) all.push_back(v);
    }
    if (all.size() < 2) {
      for (const NetcdfVariable& v : in_.variables()) {
        const bool here = in_.text_attribute(&v, "mesh") == name() && in_.text_attribute(&v, "location") == "node";
        if (here && !axis(v).empty()) all.push_back(&v);
      }
    }
    const auto along = [&](std::string_view lon_lat, std::string_view projected) {
      const auto found = std::ranges::find_if(all, [&](const NetcdfVariable* v) {
        const std::string_view of = axis(*v);
        return of == lon_lat || of == projected;
      });
      return found == all.end() ? nullptr : *found;
    };
    const NetcdfVariable *x = along(kLongitude, kProjectedX), *y = along(kLatitude, kProjectedY);
    if ((x == nullptr || y == nullptr) && all.size() == 2) x = all[0], y = all[1];
    if (x == nullptr || y == nullptr) {
      fail(ErrorCode::unsupported, path(), "the topology ", name(), " has ", all.size(),
           " node_coordinates, and none with the standard names or units of x and y, or of longitude and latitude");
    }
    used_.insert({x->name, y->name});
    return {x, y};
  }

  /// The axis of a variable, by CF's standard name or units (degrees_east, degree_N, degreesE, …), or by `axis`; else
  /// empty. Coordinates of a rotated pole are plain degrees.
  std::string_view axis(const NetcdfVariable& v) const {
    const std::string name = in_.text_attribute(&v, "standard_name"), units = in_.text_attribute(&v, "units"),
                      letter = in_.text_attribute(&v, "axis"), long_name = in_.text_attribute(&v, "long_name");
    const auto ends = [&](std::string_view word) { return units.starts_with("degree") && units.ends_with(word); };
    const auto says = [&](std::string_view word) {
      return is_radian(units) && !name.starts_with("grid_") &&
             (long_name.find(word) != std::string::npos || v.name.find(word) != std::string::npos);
    };
    if (name == kLongitude || ends("_east") || ends("E") || says("lon")) return kLongitude;
    if (name == kLatitude || ends("_north") || ends("N") || says("lat")) return kLatitude;
    if (name == kProjectedX || name == "grid_longitude" || letter == "X") return kProjectedX;
    if (name == kProjectedY || name == "grid_latitude" || letter == "Y") return kProjectedY;
    return {};
  }

  /// The first number of points in a table.
  std::int64_t start_of(const NetcdfVariable& table) const {
    const double first = in_.number_attribute(&table, "start_index").value_or(topology_ != nullptr ? 0 : 1);
    if (first != 0 && first != 1) fail(ErrorCode::unsupported, path(), "has start_index ", first, "; expected 0 or 1");
    return first == 1 ? 1 : 0;
  }

  void faces() {
    const auto names = named("face_node_connectivity");
    if (names.size() != 1) return faces_of_edges();
    const NetcdfVariable& v = in_.variable(names[0]);
    expect(v.sizes.size() == 2, v.name);
    // Rows are faces, unless face_dimension names the columns.
    const std::string face_dimension = topology_ != nullptr ? in_.text_attribute(topology_, "face_dimension") : "";
    const bool turned = !face_dimension.empty() && in_.dimension_name(v.dimensions[1]) == face_dimension &&
                        in_.dimension_name(v.dimensions[0]) != face_dimension;
    face_dimension_ = v.dimensions[turned ? 1 : 0];
    const std::size_t n = v.sizes[turned ? 1 : 0], most = v.sizes[turned ? 0 : 1];
    const std::int64_t start = start_of(v);
    const std::vector<double> fills = in_.fill_values(v);
    const auto all = in_.integers(v);
    // D-Flow FM finds the faces of an old net itself. Editors have changed edges and points, and left the faces.
    const auto n_points = static_cast<std::int64_t>(document_.file.points.size());
    if (topology_ == nullptr && std::ranges::any_of(all, [&](std::int64_t number) { return number > n_points; })) {
      document_.file.warnings.push_back(text(path(), ": ", v.name, " is of another net and is left out"));
      return faces_of_edges();
    }
    document_.names->points = RunLength(start, document_.file.points.size());
    document_.names->triangles = RunLength(start, n);
    for (std::size_t face = 0; face < n; ++face) {
      std::array<std::int32_t, 4> corners = {};
      std::size_t count = 0;
      for (std::size_t k = 0; k < most; ++k) {
        const std::int64_t number = all[turned ? k * n + face : face * most + k];
        if (number == NetcdfReader::kNoInteger || std::ranges::find(fills, static_cast<double>(number)) != fills.end())
          continue;
        if (!std::in_range<std::int32_t>(number)) {
          fail(ErrorCode::index_out_of_range, path(), "face ", static_cast<std::int64_t>(face) + start, " uses vertex ",
               number, ", which is beyond 32 bits");
        }
        if (count < 4) corners[count] = static_cast<std::int32_t>(number - start);
        ++count;
      }
      if (count != 3 && count != 4) {
        fail(ErrorCode::unsupported, path(), "face ", static_cast<std::int64_t>(face) + start, " has ", count,
             " corners; temper reads triangles and quadrilaterals");
      }
      document_.add_face({corners[0], corners[1], corners[2]}, count == 4 ? corners[3] : kNoCorner);
    }
  }

  /// Says of each point whether it is one of the plane. D-Flow FM's links have types, and MeshKernel ignores them: 0
  /// and 2 are of the plane, and others too, if they join its points. The rest is a network of channels, with its own
  /// points.
  [[nodiscard]] std::vector<bool> points_of_plane(const std::vector<std::int64_t>& ends, std::int64_t start) {
    const NetcdfVariable* const types = topology_ == nullptr ? in_.find("NetLinkType") : nullptr;
    const auto type = types != nullptr ? in_.integers(*types) : std::vector<std::int64_t>();
    const std::size_t n_points = document_.file.points.size();
    std::vector<bool> of_plane(n_points);
    bool any = false;
    for (std::size_t e = 0; e < std::min(type.size(), ends.size() / 2); ++e) {
      if (type[e] != 0 && type[e] != 2) continue;
      for (const std::size_t at : {2 * e, 2 * e + 1}) {
        if (ends[at] >= start && std::cmp_less(ends[at] - start, n_points))
          of_plane[static_cast<std::size_t>(ends[at] - start)] = true;
      }
      any = true;
    }
    return any ? of_plane : std::vector<bool>(n_points, true);
  }
  /// Without a table of faces, they are what the edges enclose.
  void faces_of_edges() {
    const auto names = named("edge_node_connectivity");
    if (names.size() != 1) {
      fail(ErrorCode::unsupported, path(),
           "has neither face_node_connectivity nor edge_node_connectivity. Next: write the mesh with its faces");
    }
    const NetcdfVariable& v = in_.variable(names[0]);
    expect(v.sizes.size() == 2 && v.sizes[1] == 2, v.name);
    const std::int64_t start = start_of(v);
    const auto all = in_.integers(v);
    const std::vector<bool> of_plane = points_of_plane(all, start);
    const auto n_points = static_cast<std::int64_t>(document_.file.points.size());
    document_.names->points = RunLength(start, document_.file.points.size());
    std::vector<EdgeEnds> edges;
    for (std::size_t e = 0; 2 * e < all.size(); ++e) {
      const auto is_point = [&](std::int64_t number) { return number >= start && number < n_points + start; };
      if (!is_point(all[2 * e]) || !is_point(all[2 * e + 1])) {
        fail(ErrorCode::index_out_of_range, path(), "edge ", static_cast<std::int64_t>(e) + start, " joins vertices ",
             all[2 * e], " and ", all[2 * e + 1], ", but the file has ", n_points, " vertices, numbered from ", start);
      }
      const std::int64_t a = all[2 * e] - start, b = all[2 * e + 1] - start;
      if (!of_plane[static_cast<std::size_t>(a)] || !of_plane[static_cast<std::size_t>(b)]) continue;
      const Vec2 p = document_.file.points[static_cast<std::size_t>(a)],
                 q = document_.file.points[static_cast<std::size_t>(b)];
      const bool is_finite = std::isfinite(p.x + p.y) && std::isfinite(q.x + q.y);  // else the point is named later
      if (a != b && is_finite) edges.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
    }
    for (const auto& [a, b, c, d] : planar_faces(document_.file.points, edges, *document_.names, path()))
      document_.add_face({a, b, c}, d);
    if (document_.file.triangles.empty()) {
      fail(ErrorCode::empty_input, path(), "its ", edges.size(), " edges (", v.name,
           ") enclose no triangle and no quadrilateral. Next: write the mesh with its faces, or with all their edges");
    }
    document_.names->triangles = RunLength(start, document_.file.triangles.size());
    const bool has_quadrilaterals = !document_.fourth_corners.empty();
    document_.file.warnings.push_back(text(path(), ": has edges without faces: ", document_.file.triangles.size(),
                                           has_quadrilaterals ? " triangles and quadrilaterals" : " triangles",
                                           " are found between ", edges.size(), " edges"));
  }

  /// Other variables become data of their location.
  void data() {
    for (const char* attribute :
         {"edge_node_connectivity", "face_edge_connectivity", "edge_face_connectivity", "face_face_connectivity",
          "boundary_node_connectivity", "face_coordinates", "edge_coordinates", "boundary_coordinates"}) {
      static_cast<void>(named(attribute));
    }
    used_.insert(topology_ != nullptr ? topology_->name : "NetLinkType");
    std::vector<std::string_view> dropped;
    for (const NetcdfVariable& v : in_.variables()) {
      if (used_.contains(v.name) || is_netcdf_extra(in_, v)) continue;
      const bool one = v.scalar && v.dimensions.size() == 1;
      if (one && v.dimensions[0] == node_dimension_) {
        add_netcdf_data(in_, v, document_.file.point_data, kept_,
                        topology_ == nullptr && v.name == kOldLevel ? std::string(kBedLevel) : v.name);
      } else if (one && v.dimensions[0] == face_dimension_) {
        add_netcdf_data(in_, v, document_.file.triangles.data, kept_);
      } else if (is_kept_alone(in_, v)) {
        kept_.variable(v);
      } else {
        dropped.push_back(v.name);
      }
    }
    warn_of_dropped(document_, dropped);
  }

  /// The attributes of the file and of the topology; not the ones that every file of temper has.
  void keep_attributes() {
    kept_.file([](std::string_view name, const std::string& value) {
      return name == "Conventions" && value == kUgridConventions;
    });
    if (topology_ == nullptr) return kept_.finish(document_.file);
    const bool usual = topology_->name == kUsualTopology &&
                       coordinates_ == text(kUsualTopology, "_node_x ", kUsualTopology, "_node_y");
    kept_.variable(*topology_, [&](std::string_view name, std::string& value) {
      const auto ends = [&](std::string_view end) { return name.ends_with(end); };
      if (name == "node_coordinates") value = coordinates_;
      if (name == "node_coordinates" || name == "cf_role") return usual;
      return name == "topology_dimension" || ends("_connectivity") || ends("_coordinates") || ends("_dimension") ||
             ends("_dimensions");
    });
    kept_.finish(document_.file);
  }

  const NetcdfReader& in_;
  const NetcdfVariable* const topology_;
  Document document_;
  NetcdfCollector kept_;
  std::string coordinates_;  // the names of x and y
  std::set<std::string> used_;
  int node_dimension_ = -1, face_dimension_ = -1;
};

/// NetCDF files of any kind: the first bytes do not determine the format, the variables do.
Document read_ugrid_from(const NetcdfReader& in, const Source& source) {
  const std::string& path = source.path;
  if (in.find("cellsOnVertex") != nullptr && in.find("xCell") != nullptr) return read_mpas_from(in, path);
  for (const NetcdfVariable& v : in.variables()) {
    if (in.text_attribute(&v, "cf_role") != "mesh_topology") continue;
    if (in.number_attribute(&v, "topology_dimension").value_or(2) != 2) continue;
    return UgridReader(in, &v, path).read();
  }
  if (in.find("NetNode_x") != nullptr && in.find("NetLink") != nullptr) return UgridReader(in, nullptr, path).read();
  if (is_icon(in)) return read_icon(in, path);
  if (auto grid = read_grid_from(in, source)) return *std::move(grid);
  if (in.find("connect1") != nullptr) return read_exodus(in, path);
  // Recognized by the name of a group, which libnetcdf does not show among variables.
  for (const auto& [group, name] :
       {std::pair("ENS_MAA", "a MED mesh"), std::pair("CGNSLibraryVersion", "a CGNS file")}) {
    if (is_hdf5(source.bytes) && source.bytes.find(group) != std::string::npos)
      fail(ErrorCode::unsupported, path, "is ", name, ", which temper does not read; meshio converts it");
  }
  fail(ErrorCode::unsupported, path,
       "is NetCDF without a mesh that temper reads: neither MPAS, ICON nor a two-dimensional topology of UGRID. Next: "
       "write the mesh as UGRID with its faces");
}

}  // namespace

Document read_ugrid(Source& source) { return read_ugrid_from(NetcdfReader(source), source); }

}  // namespace temper::io

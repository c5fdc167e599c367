// MPAS meshes of the plane, which may be periodic, and of the sphere (MPAS Mesh Specification 1.0): cells are points,
// MPAS's vertices are triangles.
//
// The reader takes xCell, yCell, zCell and cellsOnVertex, and x_period and y_period if is_periodic is YES. Vertices of
// fewer than three cells, on a boundary, are no triangles. The variables weight and cullCell of cells are temper's own.
// MPAS-Tools' culler removes cells at the boundary, where cullCell is 1.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "io/conversion/globe.hpp"
#include "io/conversion/update.hpp"
#include "io/formats/netcdf/mpas.hpp"
#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"

namespace temper::io {

bool sniff_mpas(std::string_view head) {
  return is_netcdf(head) && head.find("vertexDegree") != std::string_view::npos &&
         head.find("nVertices") != std::string_view::npos;
}

namespace {

constexpr std::string_view kMpasWeight = "weight";

/// The variables that follow from the mesh; they are computed again.
const std::set<std::string_view> kMpasDerived = {"latCell",        "lonCell",
                                                 "xCell",          "yCell",
                                                 "zCell",          "indexToCellID",
                                                 "latEdge",        "lonEdge",
                                                 "xEdge",          "yEdge",
                                                 "zEdge",          "indexToEdgeID",
                                                 "latVertex",      "lonVertex",
                                                 "xVertex",        "yVertex",
                                                 "zVertex",        "indexToVertexID",
                                                 "cellsOnEdge",    "nEdgesOnCell",
                                                 "nEdgesOnEdge",   "edgesOnCell",
                                                 "edgesOnEdge",    "weightsOnEdge",
                                                 "dvEdge",         "dcEdge",
                                                 "dv1Edge",        "dv2Edge",
                                                 "angleEdge",      "areaCell",
                                                 "areaTriangle",   "cellsOnCell",
                                                 "verticesOnCell", "verticesOnEdge",
                                                 "edgesOnVertex",  "cellsOnVertex",
                                                 "meshDensity",    "gridSpacing",
                                                 "cellQuality",    "triangleQuality",
                                                 "obtuseTriangle", "triangleAngleQuality",
                                                 "boundaryVertex", "kiteAreasOnVertex",
                                                 "cullCell"};

/// The attributes of the file that follow from the mesh, or say which one it is.
const std::set<std::string_view> kMpasAttributes = {"Conventions",   "mesh_spec",   "on_a_sphere",
                                                    "sphere_radius", "is_periodic", "x_period",
                                                    "y_period",      "source",      "file_id"};

class MpasReader {
 public:
  MpasReader(const NetcdfReader& in, const std::string& path) : in_(in), document_(new_document(path)), kept_(in) {}

  Document read() {
    document_.file.format = "mpas";
    points();
    periods();
    triangles();
    if (const NetcdfVariable* w = in_.find(kMpasWeight);
        w != nullptr && w->sizes.size() == 1 && w->scalar && !is_netcdf_extra(in_, *w)) {
      document_.file.weights = to_doubles(in_.unpacked(*w));
      expect(document_.file.weights.size() == document_.file.points.size(), kMpasWeight);
    }
    read_netcdf_extras(in_, document_, kept_);
    data();
    kept_.file([](std::string_view name, const std::string&) { return kMpasAttributes.contains(name); });
    kept_.finish(document_.file);
    return std::move(document_);
  }

 private:
  void expect(bool good, std::string_view variable) const {
    if (!good) fail(ErrorCode::size_mismatch, document_.names->path, "variable ", variable, " has a wrong size");
  }

  bool says_yes(const char* name) const {
    const std::string value = in_.text_attribute(nullptr, name);
    return value.starts_with("YES") || value.starts_with("yes");
  }

  /// Along an axis without a period its attribute is 0.
  void periods() {
    if (!says_yes("is_periodic")) return;
    const auto period = [&](const char* name) {
      const auto length = in_.number_attribute(nullptr, name);
      if (length && *length >= 0 && std::isfinite(*length)) return *length;
      fail(ErrorCode::out_of_scale, document_.names->path, "attribute is_periodic is YES, and ", name, " is ",
           length ? text(*length) : "not there", "; expected the length of the period, or 0");
    };
    const Vec2 periods = {period("x_period"), period("y_period")};
    const bool sphere = document_.file.sphere() != nullptr;
    if (sphere || periods == Vec2{}) {
      fail(ErrorCode::unsupported, document_.names->path,
           sphere ? "attributes on_a_sphere and is_periodic are YES; expected one of them"
                  : "attribute is_periodic is YES, but x_period and y_period are 0");
    }
    document_.file.points_in = PeriodicPoints{periods};
  }

  std::vector<double> coordinates(const char* name) const { return to_doubles(in_.unpacked(in_.variable(name))); }

  void points() {
    const auto x = coordinates("xCell"), y = coordinates("yCell");
    expect(x.size() == y.size(), "yCell");
    const auto z = in_.find("zCell") != nullptr ? coordinates("zCell") : std::vector<double>(x.size());
    expect(x.size() == z.size(), "zCell");
    document_.names->points = RunLength(1, x.size());
    if (says_yes("on_a_sphere")) return points_on_sphere(x, y, z);
    const bool flat = in_.text_attribute(nullptr, "on_a_sphere").starts_with("NO");
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (flat && z[i] != z[0] && std::isfinite(z[i])) {
        fail(ErrorCode::not_planar, document_.names->point_where(i), "attribute on_a_sphere is NO, but ",
             document_.names->point(i), " has z = ", z[i], " and ", document_.names->point(0), " has z = ", z[0],
             "; expected a plane of constant z");
      }
      document_.file.points.push_back({x[i], y[i]});
      plane.add(i, z[i]);
    }
  }

  /// The file gives the radius, which its points must have.
  void points_on_sphere(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& z) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < x.size(); ++i) places.push_back({x[i], y[i], z[i]});
    const auto said = in_.number_attribute(nullptr, "sphere_radius");
    if (said) expect_radius(places, *said);
    settle_points(document_.file, places, *document_.names, false);
    if (document_.file.sphere() == nullptr) {
      // Points on one parallel have one z, as in a plane.
      const auto common = common_radius(places);
      if (!common) {
        fail(ErrorCode::not_planar, document_.names->path,
             "attribute on_a_sphere is YES, but all points have z = ", document_.file.z(),
             " and not one distance from the origin; expected points on a sphere around the origin");
      }
      set_sphere(document_.file, *common, std::move(places));
    }
    if (said) std::get<SpherePoints>(document_.file.points_in).radius = *said;
  }

  void expect_radius(const std::vector<Vec3>& places, double radius) const {
    constexpr double kSame = 1e-6;  // what Mesh::build takes
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double distance = length(places[i]);
      if (!std::isfinite(distance) || std::abs(distance - radius) <= kSame * radius) continue;
      fail(ErrorCode::not_planar, document_.names->point_where(i), "attribute sphere_radius is ", radius, ", but ",
           document_.names->point(i), " is ", distance,
           " from the origin; expected xCell, yCell and zCell on a sphere of that radius");
    }
  }

  void triangles() {
    const NetcdfVariable& v = in_.variable("cellsOnVertex");
    if (v.sizes.size() != 2 || v.sizes[1] != 3) {
      fail(ErrorCode::unsupported, document_.names->path, "vertices have ", v.sizes.size() == 2 ? v.sizes[1] : 0,
           " cells; temper reads triangles");
    }
    const auto cells = in_.integers(v);
    std::size_t incomplete = 0;
    for (std::size_t t = 0; 3 * t < cells.size(); ++t) {
      const std::int64_t* c = cells.data() + 3 * t;
      if (c[0] == 0 || c[1] == 0 || c[2] == 0) {
        ++incomplete;
        continue;
      }
      std::array<std::int32_t, 3> corners = {};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!std::in_range<std::int32_t>(c[k]) || c[k] < 0) {
          fail(ErrorCode::index_out_of_range, document_.names->path, "triangle ", t + 1, " uses vertex ", c[k],
               ", but the file has ", document_.file.points.size(), " vertices, numbered from 1");
        }
        corners[k] = static_cast<std::int32_t>(c[k] - 1);
      }
      document_.file.triangles.corners.push_back(corners);
      complete_.push_back(static_cast<std::int64_t>(t));
      document_.names->triangles.push_back(static_cast<std::int64_t>(t) + 1);
    }
    all_triangles_ = incomplete == 0;
    if (incomplete > 0) {
      document_.file.warnings.push_back(text(document_.names->path, ": ", incomplete,
                                             " vertices of fewer than three cells are no triangles and are left out"));
    }
  }

  /// Other numbers of cells and vertices are data of points and triangles.
  void data() {
    std::vector<std::string_view> dropped;
    for (const NetcdfVariable& v : in_.variables()) {
      if (kMpasDerived.contains(v.name) || v.name == kMpasWeight || is_netcdf_extra(in_, v)) continue;
      const std::string dimension = v.dimensions.size() == 1 ? in_.dimension_name(v.dimensions[0]) : "";
      if (v.scalar && dimension == "nCells") {
        add_netcdf_data(in_, v, document_.file.point_data, kept_);
      } else if (v.scalar && dimension == "nVertices") {
        add_netcdf_data(in_, v, document_.file.triangles.data, kept_);
        DataArray& a = document_.file.triangles.data.back();
        if (!all_triangles_) a.values = gather(a.values, 1, complete_);
      } else if (is_kept_alone(in_, v)) {
        kept_.variable(v);
      } else {
        dropped.push_back(v.name);
      }
    }
    warn_of_dropped(document_, dropped);
  }

  const NetcdfReader& in_;
  Document document_;
  NetcdfCollector kept_;
  RunLength complete_;  // which vertices are triangles
  bool all_triangles_ = true;
};

// --- writing ---------------------------------------------------------------------------------------------

/// Latitudes and longitudes in radians, from 0 to 2 π; 0 where they are not known.
void write_mpas_angles(NetcdfWriter& out, const char* what, int dimension, std::size_t n,
                       const std::vector<Vec2>& lon_lat) {
  constexpr double kRadians = std::numbers::pi / 180;
  std::vector<double> lon(n), lat(n);
  for (std::size_t i = 0; i < lon_lat.size(); ++i) {
    lon[i] = (lon_lat[i].x - 360 * std::floor(lon_lat[i].x / 360)) * kRadians;
    lat[i] = lon_lat[i].y * kRadians;
  }
  out.variable(text("lat", what), {dimension}, std::move(lat));
  out.variable(text("lon", what), {dimension}, std::move(lon));
}

/// Positions of cells, edges or vertices, and their longitude and latitude if known.
struct MpasPositions {
  std::vector<Vec3> at;
  std::vector<Vec2> lon_lat;
};

MpasPositions on_sphere(std::vector<Vec3> at) {
  MpasPositions places = {std::move(at), {}};
  for (const Vec3 p : places.at) places.lon_lat.push_back(lon_lat_of(p));
  return places;
}

MpasPositions in_plane(const NetcdfMesh& m, const std::vector<Vec2>& points) {
  MpasPositions places;
  for (const Vec2 p : points) places.at.push_back({p.x, p.y, m.file.z()});
  const bool of_points = &points == &m.file.points;
  if (auto known = lon_lat_of_points(m.file))
    places.lon_lat = of_points ? *std::move(known) : lon_lat_of_places(m.file, m.mesh, points);
  return places;
}

/// Their images in the domain of a periodic plane; unchanged in the plane itself.
std::vector<Vec2> in_domain(const NetcdfMesh& m, std::vector<Vec2> points) {
  for (Vec2& p : points) p = m.mesh.space().in_domain({p.x, p.y, 0}).position();
  return points;
}

MpasPositions mpas_cells(const NetcdfMesh& m) {
  return m.file.sphere() != nullptr ? on_sphere(m.file.sphere()->places) : in_plane(m, m.file.points);
}
MpasPositions mpas_edges(const NetcdfMesh& m) {
  if (m.file.sphere() != nullptr) return on_sphere(m.complex.sphere_midpoints.raw());
  std::vector<Vec2> midpoints;
  for (const DecEdge& edge : m.complex.edges) midpoints.push_back(edge.midpoint);
  return in_plane(m, in_domain(m, std::move(midpoints)));
}
MpasPositions mpas_vertices(const NetcdfMesh& m) {
  return m.file.sphere() != nullptr ? on_sphere(m.complex.sphere_orthocenters.raw())
                                    : in_plane(m, in_domain(m, m.complex.orthocenters.raw()));
}

/// x, y and z of cells, edges or vertices, latitudes and longitudes, and their numbers.
void write_mpas_positions(NetcdfWriter& out, const char* what, int dimension, const MpasPositions& places) {
  const std::size_t n = places.at.size();
  std::vector<double> x(n), y(n), z(n);
  std::vector<std::int32_t> numbers(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = places.at[i].x;
    y[i] = places.at[i].y;
    z[i] = places.at[i].z;
    numbers[i] = static_cast<std::int32_t>(i) + 1;
  }
  write_mpas_angles(out, what, dimension, n, places.lon_lat);
  out.variable(text("x", what), {dimension}, std::move(x));
  out.variable(text("y", what), {dimension}, std::move(y));
  out.variable(text("z", what), {dimension}, std::move(z));
  out.variable(text("indexTo", what, "ID"), {dimension}, std::move(numbers));
}

template <class IdType>
std::vector<double> plain_values(const IdVector<IdType, double>& values) {
  std::vector<double> result;
  result.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) result.push_back(values[IdType(i)]);
  return result;
}

}  // namespace

Document read_mpas_from(const NetcdfReader& in, const std::string& path) { return MpasReader(in, path).read(); }

Document read_mpas(Source& source) { return read_mpas_from(NetcdfReader(source), source.path); }

namespace {

/// MPAS's tables are as wide as the cell with the most edges: one vertex with thousands would make a file of gigabytes.
void refuse_too_wide(const WriteJob& job, const Mesh& mesh, std::size_t n_edges) {
  constexpr std::size_t kUsual = 64, kMostNumbers = std::size_t{1} << 25;
  std::size_t most = 0;
  for (const VertexId v : mesh.vertices()) {
    std::size_t n = 0;
    for ([[maybe_unused]] const HalfedgeId h : mesh.star(v)) ++n;
    most = std::max(most, n);
  }
  if (most <= kUsual || most <= kMostNumbers / (2 * n_edges)) return;
  fail(ErrorCode::unsupported, job.path, "MPAS has columns for as many edges as any cell has, here ", most,
       " for each of ", n_edges, " edges: too many to be written");
}

/// Warns that with weights the edges do not cross midway between the cells.
void warn_of_offsets(const WriteJob& job, const NetcdfMesh& m) {
  constexpr double kVisible = 0.01;
  if (!is_weighted(m.file)) return;
  std::size_t visible = 0;
  double most = 0;
  for (const DecEdge& edge : m.complex.edges) {
    const double offset = std::abs(edge.crossing / edge.length - 0.5);
    most = std::max(most, offset);
    visible += offset > kVisible ? 1 : 0;
  }
  if (visible == 0) return;
  job.warn("with weights, ", visible, " of ", m.complex.edges.size(),
           " edges are crossed more than 1 % of dcEdge away from the middle of their cells, up to ",
           std::round(1000 * most) / 10,
           " %. Models such as MPAS use xEdge as the midpoint, and need a mesh without weights. Next: temper weights "
           "IN --zero -o PLAIN, then temper optimize PLAIN --for mpas");
}

}  // namespace

void write_mpas(const WriteJob& job) {
  const NetcdfMesh m = mesh_for_netcdf(job, "MPAS");
  const DecComplex& c = m.complex;
  refuse_too_wide(job, m.mesh, c.edges.size());
  MpasArrays a = mpas_arrays(m.mesh, c);
  std::size_t n_bad = 0;
  for (std::size_t e = 0; e < a.dv_edge.size(); ++e) n_bad += a.vertices_on_edge[2 * e + 1] > 0 && a.dv_edge[e] <= 0;
  if (n_bad > 0) job.warn(n_bad, " edges inside have a dvEdge that is not positive; MPAS expects a well-centered mesh");
  const Space& space = m.mesh.space();
  warn_of_offsets(job, m);
  const std::size_t most_values = 2 * a.max_edges * c.edges.size();  // of weightsOnEdge
  NetcdfWriter out(job.path, needs_cdf5(m.file, most_values));
  const int cells = out.dimension("nCells", m.mesh.n_vertices()), edges = out.dimension("nEdges", c.edges.size()),
            vertices = out.dimension("nVertices", m.mesh.n_triangles()),
            around = out.dimension("maxEdges", a.max_edges), around2 = out.dimension("maxEdges2", 2 * a.max_edges),
            two = out.dimension("TWO", 2), degree = out.dimension("vertexDegree", 3);
  const NetcdfKept kept(m.file);
  kept.copy(nullptr, out, NetcdfWriter::kFile);
  out.attribute(NetcdfWriter::kFile, "Conventions", "MPAS");
  out.attribute(NetcdfWriter::kFile, "mesh_spec", "1.0");
  out.attribute(NetcdfWriter::kFile, "on_a_sphere", m.file.sphere() != nullptr ? "YES" : "NO");
  out.attribute(NetcdfWriter::kFile, "sphere_radius", space.radius());
  out.attribute(NetcdfWriter::kFile, "is_periodic", space.is_periodic() ? "YES" : "NO");
  if (const PeriodicPoints* const periodic = m.file.periodic()) {
    out.attribute(NetcdfWriter::kFile, "x_period", periodic->period.x);
    out.attribute(NetcdfWriter::kFile, "y_period", periodic->period.y);
  }
  out.attribute(NetcdfWriter::kFile, "source", "temper");
  write_mpas_positions(out, "Cell", cells, mpas_cells(m));
  write_mpas_positions(out, "Edge", edges, mpas_edges(m));
  write_mpas_positions(out, "Vertex", vertices, mpas_vertices(m));
  out.variable("cellsOnEdge", {edges, two}, std::move(a.cells_on_edge));
  out.variable("verticesOnEdge", {edges, two}, std::move(a.vertices_on_edge));
  out.variable("nEdgesOnCell", {cells}, std::move(a.n_edges_on_cell));
  out.variable("edgesOnCell", {cells, around}, std::move(a.edges_on_cell));
  out.variable("cellsOnCell", {cells, around}, std::move(a.cells_on_cell));
  out.variable("verticesOnCell", {cells, around}, std::move(a.vertices_on_cell));
  out.variable("edgesOnVertex", {vertices, degree}, std::move(a.edges_on_vertex));
  out.variable("cellsOnVertex", {vertices, degree}, std::move(a.cells_on_vertex));
  out.variable("nEdgesOnEdge", {edges}, std::move(a.n_edges_on_edge));
  out.variable("edgesOnEdge", {edges, around2}, std::move(a.edges_on_edge));
  out.variable("weightsOnEdge", {edges, around2}, std::move(a.weights_on_edge));
  out.variable("dcEdge", {edges}, std::move(a.dc_edge));
  out.variable("dvEdge", {edges}, std::move(a.dv_edge));
  out.variable("angleEdge", {edges}, std::move(a.angle_edge));
  out.variable("areaCell", {cells}, plain_values(c.star0));
  out.variable("areaTriangle", {vertices}, plain_values(c.areas));
  out.variable("kiteAreasOnVertex", {vertices, degree}, std::move(a.kite_areas_on_vertex));
  out.variable("meshDensity", {cells}, std::vector<double>(m.mesh.n_vertices(), 1.0));
  out.variable("cullCell", {cells}, std::move(a.boundary_cell));
  if (!m.file.weights.empty()) out.variable(std::string(kMpasWeight), {cells}, m.file.weights);
  write_netcdf_extras(out, job, m.file, {cells, vertices, kept});
  out.finish([&](std::string_view bytes) { job.outputs.open(job.path).put(bytes); });
}

}  // namespace temper::io

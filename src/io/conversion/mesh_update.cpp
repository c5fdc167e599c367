// From a mesh back to the arrays of the file that it came from.
//
// Coordinates, weights, triangles and regions are the mesh's. Everything else is the file's, and goes with its point,
// its line or its triangle. data_update.cpp moves data of points and triangles.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/conversion/globe.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/disk/files.hpp"
#include "io/text/failure.hpp"
#include "io/text/file_names.hpp"
#include "io/text/values.hpp"
#include "temper/io.hpp"
#include "temper/mesher.hpp"

namespace temper::io {
namespace {

/// Vertices that have not moved keep the image that the file has; all others are in the domain.
void copy_periodic(MeshFile& file, const Mesh& mesh, const Former& former) {
  const Space& space = mesh.space();
  if (!(file.space() == space)) file.points_in = PeriodicPoints{space.period(), file.z()};  // rounded, the file's
  std::vector<Vec2> points;
  points.reserve(mesh.n_vertices());
  file.weights.resize(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const std::size_t was = former.empty() ? v.index : former[v].valid() ? former[v].index : file.points.size();
    points.push_back(mesh.position(v));
    if (was < file.points.size()) {
      const Vec2 before = file.points[was];
      if (space.in_domain({before.x, before.y, 0}).position() == points.back()) points.back() = before;
    }
    file.weights[v.index] = mesh.weight(v);
  }
  file.points = std::move(points);
}

/// Copies the mesh's data to arrays for its own vertices.
void copy_plane(MeshFile& file, const Mesh& mesh) {
  file.points.resize(mesh.n_vertices());
  file.weights.resize(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    file.points[v.index] = mesh.position(v);
    file.weights[v.index] = mesh.weight(v);
  }
}

/// Vertices that have not moved keep their points and degrees, and weights that give the same vertex.
void copy_sphere(MeshFile& file, const Mesh& mesh, const Former& former) {
  const std::span<const Vec3> before = sphere_places(file);
  std::vector<Vec2> degrees;
  std::vector<Vec3> places;
  std::vector<double> weights;
  for (const VertexId v : mesh.vertices()) {
    const std::size_t was = former.empty() ? v.index : former[v].valid() ? former[v].index : before.size();
    const Vec3 p = mesh.weighted_vector(v);
    weights.push_back(mesh.weight(v));
    if (was < before.size() && mesh.space().same_place(as_point(before[was]), as_point(p))) {
      degrees.push_back(file.points[was]);
      places.push_back(before[was]);
      if (was < file.weights.size() && mesh.space().vertex_at(places.back(), file.weights[was]) == as_point(p)) {
        weights.back() = file.weights[was];
      }
    } else {
      places.push_back(mesh.space().place(as_point(p)));
      degrees.push_back(lon_lat_of(p));
      // From −180 to 180, or from 0 to 360: as in the file near this point.
      if (was < file.points.size()) {
        degrees.back().x += 360 * std::round((file.points[was].x - degrees.back().x) / 360);
      }
    }
  }
  file.points = std::move(degrees);
  file.points_in = SpherePoints{mesh.space().radius(), std::move(places)};
  file.weights = std::move(weights);
}

void copy_vertices(MeshFile& file, const Mesh& mesh, const Former& former) {
  switch (mesh.space().kind()) {
    case SpaceKind::plane:
      copy_plane(file, mesh);
      break;
    case SpaceKind::sphere:
      copy_sphere(file, mesh, former);
      break;
    case SpaceKind::periodic_plane:
      copy_periodic(file, mesh, former);
      break;
  }
  drop_zero_weights(file);
}

void copy_triangles(MeshFile& file, const Mesh& mesh) {
  file.triangles.corners.resize(mesh.n_triangles());
  bool regions = !file.triangles.tags.empty();
  for (const TriangleId t : mesh.triangles()) {
    const auto corners = mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) file.triangles[t.index][k] = static_cast<std::int32_t>(corners[k].index);
    regions = regions || mesh.region(t) != 0;
  }
  file.triangles.tags.resize(regions ? mesh.n_triangles() : 0);
  for (std::size_t t = 0; t < file.triangles.tags.size(); ++t) file.triangles.tags[t] = mesh.region(TriangleId(t));
}

template <class T>
void keep(std::vector<T>& values, const std::vector<bool>& kept) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (kept[i]) values[n++] = values[i];
  }
  values.resize(n);
}

void keep(std::vector<DataArray>& arrays, const std::vector<bool>& kept) {
  RunLength indices;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) indices.push_back(static_cast<std::int64_t>(i));
  }
  for (DataArray& a : arrays) a.values = gather(a.values, a.components, indices);
}

/// Renumbers lines and marked points by new_index (−1: gone) and drops those that lost a point.
template <class NewIndex>
void renumber(MeshFile& file, NewIndex new_index) {
  std::vector<bool> kept_lines(file.lines.size());
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    for (std::int32_t& p : file.lines[i]) p = new_index(p);
    kept_lines[i] = file.lines[i][0] >= 0 && file.lines[i][1] >= 0;
  }
  std::vector<bool> kept_points(file.marked_points.size());
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) {
    file.marked_points[i] = new_index(file.marked_points[i]);
    kept_points[i] = file.marked_points[i] >= 0;
  }
  keep(file.lines.corners, kept_lines);
  keep(file.lines.tags, kept_lines);
  keep(file.lines.data, kept_lines);
  keep(file.marked_points.corners, kept_points);
  keep(file.marked_points.tags, kept_points);
  keep(file.marked_points.data, kept_points);
}

void drop_unused_points(MeshFile& file, const VertexOfPoint& vertex_of_point) {
  std::vector<bool> used(vertex_of_point.size());
  for (std::size_t p = 0; p < used.size(); ++p) used[p] = vertex_of_point[p] >= 0;
  keep(file.points, used);
  if (auto* sphere = std::get_if<SpherePoints>(&file.points_in)) keep(sphere->places, used);
  keep(file.point_data, used);
  for (auto& triangle : file.triangles) {
    for (std::int32_t& p : triangle) p = vertex_of_point[static_cast<std::size_t>(p)];
  }
  renumber(file, [&](std::int32_t p) { return vertex_of_point[static_cast<std::size_t>(p)]; });
}

/// For each vertex the point at its place in the plane, bit for bit.
Former vertices_by_place_in_plane(const std::vector<Vec2>& points, const Mesh& mesh) {
  std::unordered_map<Vec2, VertexId, PlaceHash> places;
  for (std::size_t p = 0; p < points.size(); ++p) {
    places.emplace(mesh.space().in_domain({points[p].x, points[p].y, 0}).position(), VertexId(p));
  }
  Former former(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const auto found = places.find(mesh.position(v));
    if (found != places.end()) former[v] = found->second;
  }
  return former;
}

/// Points of a sphere by their place. Weights round places, so the search uses cells much larger than this rounding.
class PlacesOnSphere {
 public:
  PlacesOnSphere(std::span<const Vec3> points, const Space& space) : points_(points), space_(space) {
    for (std::size_t p = 0; p < points.size(); ++p) cells_.emplace(cell(direction(points[p])), VertexId(p));
  }
  /// The point at the place of p, which is in its cell or just across a side of the cell; invalid: none.
  [[nodiscard]] VertexId find(const Vec3& p) const {
    const Vec3 middle = direction(p);
    for (const double x : {-kRounded, kRounded}) {
      for (const double y : {-kRounded, kRounded}) {
        for (const double z : {-kRounded, kRounded}) {
          const auto [first, last] = cells_.equal_range(cell(middle + Vec3{x, y, z}));
          for (auto it = first; it != last; ++it) {
            if (space_.same_place(as_point(points_[it->second.index]), as_point(p))) return it->second;
          }
        }
      }
    }
    return {};
  }

 private:
  static constexpr double kRounded = 0x1p-46;       // above same_place()'s tolerance and direction()'s rounding
  static constexpr double kCellsOfRadius = 0x1p36;  // on the Earth a cell is a tenth of a millimeter wide
  static Vec3 direction(const Vec3& p) { return (1 / length(p)) * p; }
  static Vec3 cell(const Vec3& p) {
    return {std::floor(kCellsOfRadius * p.x), std::floor(kCellsOfRadius * p.y), std::floor(kCellsOfRadius * p.z)};
  }

  std::span<const Vec3> points_;
  const Space& space_;
  std::unordered_multimap<Vec3, VertexId, PlaceHash> cells_;
};

/// For each vertex the point at its place.
Former vertices_by_place(const MeshFile& file, const Mesh& mesh) {
  if (file.sphere() == nullptr) return vertices_by_place_in_plane(file.points, mesh);
  const PlacesOnSphere places(file.sphere()->places, mesh.space());
  Former former(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) former[v] = places.find(mesh.weighted_vector(v));
  return former;
}

// --- vertices that were removed or inserted ----------------------------------------------------------------------

using NewNumbers = std::vector<std::int32_t>;  // of the points before; −1: removed

/// A vertex on a straight line may be removed: of each tag, the two lines that met there become one.
///
///     a --i-- v --j-- b     becomes    a --i-- b
class LineMerger {
 public:
  LineMerger(MeshFile& file, const NewNumbers& new_index) : file_(file), new_index_(new_index) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      for (const std::int32_t p : file.lines[i]) {
        if (removed(p)) lines_at_[p].push_back(i);
      }
    }
  }
  /// Lines that were merged into others get a removed vertex at both ends, for renumber() to drop.
  std::size_t merge() {
    std::size_t merged = 0;
    for (std::size_t p = 0; p < new_index_.size(); ++p) merged += merge_at(static_cast<std::int32_t>(p));
    return merged;
  }

 private:
  [[nodiscard]] bool removed(std::int32_t p) const { return new_index_[static_cast<std::size_t>(p)] < 0; }
  std::size_t merge_at(std::int32_t v) {
    const auto found = lines_at_.find(v);
    if (found == lines_at_.end()) return 0;
    std::map<std::int32_t, std::vector<std::size_t>> lines_of;  // by tag, ascending
    for (const std::size_t line : found->second) lines_of[file_.lines.tags[line]].push_back(line);
    std::size_t merged = 0;
    for (auto& [tag, lines] : lines_of) {
      std::sort(lines.begin(), lines.end());
      if (lines.size() != 2 || lines[0] == lines[1]) continue;
      join(v, lines[0], lines[1]);
      ++merged;
    }
    return merged;
  }
  void join(std::int32_t v, std::size_t i, std::size_t j) {
    auto &kept = file_.lines[i], &gone = file_.lines[j];
    const std::int32_t far = gone[0] == v ? gone[1] : gone[0];
    kept[kept[0] == v ? 0 : 1] = far;
    gone = {v, v};
    if (removed(far)) std::replace(lines_at_[far].begin(), lines_at_[far].end(), j, i);
  }

  MeshFile& file_;
  const NewNumbers& new_index_;
  std::unordered_map<std::int32_t, std::vector<std::size_t>> lines_at_;  // of removed points
};

/// Lines and marked points of n points get the vertices that these points have become.
void follow(MeshFile& file, std::size_t n, const Mesh& mesh, const Former& former) {
  NewNumbers new_index(n, -1);
  for (const VertexId v : mesh.vertices()) {
    if (former[v].valid()) new_index[former[v].index] = static_cast<std::int32_t>(v.index);
  }
  const std::size_t n_lines = file.lines.size(), n_marked = file.marked_points.size();
  const std::size_t merged = LineMerger(file, new_index).merge();
  renumber(file, [&](std::int32_t p) { return new_index[static_cast<std::size_t>(p)]; });
  const std::size_t lost = n_lines - merged - file.lines.size() + n_marked - file.marked_points.size();
  if (lost > 0) file.warnings.push_back(text(lost, " lines or marked points have lost their vertices and are dropped"));
  split_lines(file, mesh, former);
}

bool same_numbers(const Former& former, std::size_t n) {
  if (former.empty()) return true;
  for (std::size_t v = 0; v < former.size(); ++v) {
    if (former[VertexId(v)] != VertexId(v)) return false;
  }
  return former.size() == n;
}

/// Renumbers the lines and marked points of a file with n points for the mesh.
void update_lines(MeshFile& file, std::size_t n, const LoadedMesh& loaded, const Mesh& mesh, const Former& former) {
  const std::vector<bool>& edge_lines = loaded.edge_lines;
  // If the file was changed meanwhile, nothing is known of its lines.
  const bool has_edge_lines = !edge_lines.empty() && edge_lines.size() == file.lines.size();
  if (has_edge_lines && same_numbers(former, n)) {
    replace_edge_lines(file, edge_lines, mesh);
  } else if (has_edge_lines) {
    const EdgeLinesTakenOut lines(file, edge_lines);
    follow(file, n, mesh, former);
    lines.put_back(file, mesh);
  } else if (!former.empty()) {
    follow(file, n, mesh, former);
  }
}

}  // namespace

DataReport update(MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
                  const IdVector<VertexId, VertexId>& vertices, const UpdateOptions& options) {
  const auto& vertex = loaded.vertex_of_point;
  const bool has_unused = file.points.size() == vertex.size() && vertex.n_kept() < vertex.size();
  if (has_unused) drop_unused_points(file, vertex);
  const bool released = file.points.empty();
  const std::size_t n_before = released ? vertex.n_kept() : file.points.size();
  Former former;  // empty: the same numbers
  if (!vertices.empty() && n_before == vertex.n_kept()) {
    former = vertices;
  } else if (!released && mesh.n_vertices() != n_before) {
    former = vertices_by_place(file, mesh);
  }
  DataReport report = update_data(file, mesh, former, options);
  update_lines(file, n_before, loaded, mesh, former);
  copy_vertices(file, mesh, former);
  copy_triangles(file, mesh);
  if (has_unused || !former.empty()) file.numbering = nullptr;  // its numbers no longer fit the points
  return report;
}

void release_geometry(MeshFile& file, const LoadedMesh& loaded) {
  if (file.points.size() != loaded.mesh.n_vertices()) return;
  if (!file.point_data.empty() || !file.triangles.data.empty() || !(file.space() == Space())) return;
  give_memory_back_of(file.points, file.weights, file.triangles.corners);
}

namespace {

/// Longitude and latitude of the vertices of a map, as point data.
void add_degrees(MeshFile& file, const OutlineMesh& made, std::span<const Vec2> lon_lat, const Projection& map) {
  std::vector<double> longitudes, latitudes;
  const LongitudeTurn turn(lon_lat);
  for (const VertexId v : made.mesh.vertices()) {
    const Vec2 place = turn(inverse(map, made.mesh.position(v)));
    longitudes.push_back(place.x);
    latitudes.push_back(place.y);
  }
  for (std::size_t p = lon_lat.size(); p-- > 0;) {  // bit for bit; of joined points the first
    const VertexId v = made.vertex_of_point[p];
    if (v.valid()) longitudes[v.index] = lon_lat[p].x, latitudes[v.index] = lon_lat[p].y;
  }
  file.point_data.push_back({std::string(kLongitude), 1, std::move(longitudes)});
  file.point_data.push_back({std::string(kLatitude), 1, std::move(latitudes)});
}

}  // namespace

MeshFile from_outline(const OutlineMesh& made, std::span<const Vec2> lon_lat, const std::optional<Projection>& map) {
  MeshFile file = from_mesh(made.mesh);
  file.lines = {};
  file.marked_points = {};
  constexpr std::int32_t kBoundary = 1, kHighest = std::numeric_limits<std::int32_t>::max() - 2;
  std::int32_t highest = kBoundary;
  for (const MeshLine& line : made.lines) highest = std::max(highest, line.tag);
  for (const MarkedVertex& mark : made.marked) highest = std::max(highest, mark.tag);
  highest = std::min(highest, kHighest);
  const std::int32_t inside = highest + 1, point = highest + 2;
  const auto number = [](VertexId v) { return static_cast<std::int32_t>(v.index); };
  for (const MeshLine& line : made.lines) {
    const HalfedgeId h = made.mesh.find_halfedge(line.a, line.b);
    const bool boundary = !h.valid() || made.mesh.is_boundary(h);
    file.lines.add({number(line.a), number(line.b)}, line.tag != 0 ? line.tag : boundary ? kBoundary : inside);
  }
  for (const MarkedVertex& mark : made.marked)
    file.marked_points.add(number(mark.vertex), mark.tag != 0 ? mark.tag : point);
  file.names = made.groups;
  if (map) add_degrees(file, made, lon_lat, *map);
  if (made.mesh.space().is_plane()) return file;
  for (std::size_t p = lon_lat.size(); p-- > 0;) {  // bit for bit; of joined points the first
    const VertexId v = made.vertex_of_point[p];
    if (v.valid()) file.points[v.index] = lon_lat[p];
  }
  return file;
}

MeshFile from_mesh(const Mesh& mesh) {
  MeshFile file;
  copy_vertices(file, mesh, {});
  copy_triangles(file, mesh);
  std::vector<std::array<TriangleId, 2>> pairs;  // of halves of quadrilaterals
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_constrained(h) || mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    // An interface between regions is constrained by its regions; any other line has to be written.
    const TriangleId t = Mesh::triangle(h), other = Mesh::triangle(mesh.twin(h));
    if (mesh.is_diagonal(h)) pairs.push_back({t, other});
    if (mesh.region(t) != mesh.region(other) || mesh.is_half(t) || mesh.is_half(other)) continue;
    file.lines.add({static_cast<std::int32_t>(mesh.origin(h).index), static_cast<std::int32_t>(mesh.target(h).index)},
                   0);
  }
  if (!pairs.empty()) {
    std::vector<std::int32_t> numbers(mesh.n_triangles());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (const TriangleId t : pairs[i]) numbers[t.index] = static_cast<std::int32_t>(i + 1);
    }
    file.triangles.data.push_back({std::string(kQuadrilateral), 1, std::move(numbers)});
  }
  constexpr std::int32_t kFixed = 1;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_fixed(v)) file.marked_points.add(static_cast<std::int32_t>(v.index), kFixed);
  }
  return file;
}

}  // namespace temper::io

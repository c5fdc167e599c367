// From a mesh back to the file that it came from: update() of triangles and of tetrahedra.
//
// Points, weights, cells and regions are the mesh's. Everything else is the file's, and goes with its point, its line,
// its face or its cell: data_update.hpp, lines_update.cpp, pieces_update.cpp.
#include "io/conversion/update.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/conversion/edge_lines.hpp"
#include "io/conversion/follow.hpp"
#include "io/conversion/globe.hpp"
#include "io/disk/files.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/location.hpp"
#include "temper/detail/transfer.hpp"
#include "temper/io.hpp"
#include "temper/tets/location.hpp"
#include "temper/tets/transfer.hpp"

namespace temper::io {
namespace {

/// The change of a mesh of triangles, for DataUpdater. The file still has the former mesh.
class TriangleChange {
 public:
  static constexpr int dimension = 2;
  using Found = FoundOfChange<Place>;

  TriangleChange(const MeshFile& file, const Mesh& mesh, Executor* executor)
      : file_(file), mesh_(mesh), executor_(executor) {}
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] std::optional<std::array<std::int32_t, 3>> former_corners(std::size_t triangle) const {
    if (triangle >= file_.triangles.size()) return {};
    return file_.triangles[triangle];
  }
  [[nodiscard]] std::optional<double> moved(VertexId v, VertexId was) const {
    const Space& space = mesh_.space();
    const WeightedPoint now = mesh_.point(v), before = as_point(position_of(file_, was.index));
    if (space.same_place(space.in_domain(before), now)) return {};
    const double moved = distance(space, before, space.image(now, before));
    return moved > 0 ? std::optional(moved) : std::nullopt;
  }
  [[nodiscard]] bool has_other_weight(VertexId v, VertexId was) const {
    return mesh_.weight(v) != (was.index < file_.weights.size() ? file_.weights[was.index] : 0);
  }
  [[nodiscard]] Expected<Found> find(const Former& former, const WantedOfChange& wanted) const {
    MeshInput input;
    input.space = mesh_.space();
    input.points = file_.points;
    input.sphere_points = sphere_places(file_);
    input.triangles = file_.triangles;
    input.regions = file_.triangles.tags;
    input.executor = executor_;
    if (wanted.vertex_overlaps) input.weights = file_.weights;
    const Expected<BuiltMesh> built = Mesh::build(input);
    if (!built) return built.error();
    const Mesh& before = built->mesh;
    Found found;
    if (wanted.places || wanted.sources) found.places = positions_of_vertices(before, mesh_, former, executor_);
    if (wanted.sources) {
      for (const TriangleId t : sources_of_triangles(before, mesh_, found.places, executor_))
        found.sources.push_back(t.index);
    }
    if (wanted.vertex_overlaps) found.vertex_overlaps = overlaps(before, mesh_, CellsOf::vertices, executor_);
    if (wanted.cell_overlaps) found.cell_overlaps = overlaps(before, mesh_, CellsOf::triangles, executor_);
    return found;
  }

 private:
  const MeshFile& file_;
  const Mesh& mesh_;
  Executor* executor_;
};

/// The change of a mesh of tetrahedra.
class TetChange {
 public:
  static constexpr int dimension = 3;
  using Found = FoundOfChange<tets::Place>;

  TetChange(const tets::TetMesh& before, const tets::TetMesh& mesh, Executor* executor)
      : before_(before), mesh_(mesh), executor_(executor) {}
  [[nodiscard]] const tets::TetMesh& mesh() const { return mesh_; }
  [[nodiscard]] std::optional<std::array<std::int32_t, 4>> former_corners(std::size_t tetrahedron) const {
    if (tetrahedron >= before_.n_tetrahedra()) return {};
    return numbers(before_.corners(tets::TetId(tetrahedron)));
  }
  [[nodiscard]] std::optional<double> moved(VertexId v, VertexId was) const {
    if (before_.position(was) == mesh_.position(v)) return {};
    return length(mesh_.position(v) - before_.position(was));
  }
  [[nodiscard]] bool has_other_weight(VertexId v, VertexId was) const { return before_.weight(was) != mesh_.weight(v); }
  [[nodiscard]] Expected<Found> find(const Former& former, const WantedOfChange& wanted) const {
    Found found;
    if (wanted.places) found.places = positions_of_vertices(before_, mesh_, former, executor_);
    if (wanted.sources) {
      for (const tets::TetId t : sources_of_tetrahedra(before_, mesh_, former, executor_))
        found.sources.push_back(t.index);
    }
    if (wanted.vertex_overlaps)
      found.vertex_overlaps = tets::overlaps(before_, mesh_, tets::CellsOf::vertices, executor_);
    if (wanted.cell_overlaps)
      found.cell_overlaps = tets::overlaps(before_, mesh_, tets::CellsOf::tetrahedra, executor_);
    return found;
  }

 private:
  const tets::TetMesh &before_, &mesh_;
  Executor* executor_;
};

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

}  // namespace

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

namespace {

/// Copies the vertices of a mesh in space.
template <class SpaceMesh>
void copy_space(MeshFile& file, const SpaceMesh& mesh, int dimension) {
  std::vector<double> heights(mesh.n_vertices());
  file.points.resize(mesh.n_vertices());
  file.weights.resize(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    const auto p = mesh.point(v);
    file.points[v.index] = {p.x, p.y};
    heights[v.index] = p.z;
    file.weights[v.index] = p.w;
  }
  file.points_in = SpacePoints{std::move(heights), dimension};
  drop_zero_weights(file);
}

bool same_numbers(const Former& former, std::size_t n) {
  if (former.empty()) return true;
  for (std::size_t v = 0; v < former.size(); ++v) {
    if (former[VertexId(v)] != VertexId(v)) return false;
  }
  return former.size() == n;
}

}  // namespace

void copy_vertices(MeshFile& file, const surfaces::SurfaceMesh& mesh) { copy_space(file, mesh, 2); }

void update_lines(MeshFile& file, std::size_t n, const std::vector<bool>& edge_lines, const Mesh& mesh,
                  const Former& former) {
  // If the file was changed meanwhile, nothing is known of its lines.
  const bool has_edge_lines = !edge_lines.empty() && edge_lines.size() == file.lines.size();
  if (has_edge_lines && same_numbers(former, n)) {
    replace_edge_lines(file, edge_lines, mesh);
  } else if (has_edge_lines) {
    const EdgeLinesTakenOut lines(file, edge_lines);
    follow_lines(file, n, mesh, former);
    lines.put_back(file, mesh);
  } else if (!former.empty()) {
    follow_lines(file, n, mesh, former);
  }
}

DataReport update(MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh, const Former& vertices,
                  const UpdateOptions& options) {
  const auto& vertex = loaded.vertex_of_point;
  const bool has_unused = drop_unused_points(file, vertex), released = file.points.empty();
  const std::size_t n_before = released ? vertex.n_kept() : file.points.size();
  Former former;  // empty: the same numbers
  if (!vertices.empty() && n_before == vertex.n_kept()) {
    former = vertices;
  } else if (!released && mesh.n_vertices() != n_before) {
    former = vertices_by_place(file, mesh);
  }
  DataReport report = DataUpdater(file, TriangleChange(file, mesh, options.executor), former, options).update();
  update_lines(file, n_before, loaded.edge_lines, mesh, former);
  copy_vertices(file, mesh, former);
  copy_cells(file.triangles, mesh);
  if (has_unused || !former.empty()) file.numbering = nullptr;  // its numbers no longer fit the points
  return report;
}

DataReport update(MeshFile& file, const LoadedTetMesh& loaded, const tets::TetMesh& mesh, const tets::Origins& origins,
                  const UpdateOptions& options) {
  const bool has_unused = drop_unused_points(file, loaded.vertex_of_point);
  DataReport report =
      DataUpdater(file, TetChange(loaded.mesh, mesh, options.executor), origins.vertices, options).update();
  if (!origins.vertices.empty()) take_pieces(file, loaded.mesh, mesh, origins);
  copy_space(file, mesh, 3);
  copy_cells(file.tetrahedra, mesh);
  if (has_unused || !origins.vertices.empty()) file.numbering = nullptr;
  return report;
}

void release_geometry(MeshFile& file, const LoadedMesh& loaded) {
  if (file.points.size() != loaded.mesh.n_vertices()) return;
  if (!file.point_data.empty() || !file.triangles.data.empty() || !(file.space() == Space())) return;
  give_memory_back_of(file.points, file.weights, file.triangles.corners);
}

void release_geometry(MeshFile& file, const LoadedTetMesh& loaded) {
  const auto is_of_corners = [](const DataArray& array) { return array.name == kCornerWeights; };
  if (file.points.size() != loaded.mesh.n_vertices() || std::ranges::any_of(file.tetrahedra.data, is_of_corners))
    return;
  give_memory_back_of(file.points, std::get<SpacePoints>(file.points_in).heights, file.weights,
                      file.tetrahedra.corners);
}

}  // namespace temper::io

// From the arrays of a file with a curved surface to a mesh, and back.
//
// Points of no triangle are left out. Lines become constrained edges, and marked points are fixed, as in the plane.
#include <algorithm>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/conversion/edge_lines.hpp"
#include "io/conversion/fixed_points.hpp"
#include "io/conversion/kept_points.hpp"
#include "io/conversion/update.hpp"
#include "io/text/failure.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

class SurfaceMaker {
 public:
  explicit SurfaceMaker(const MeshFile& file) : file_(file) {}

  Expected<LoadedSurface> make(std::span<const std::string> fixed_tags) {
    VertexOfPoint& vertex = loaded_.vertex_of_point;
    vertex = VertexOfPoint(corners_among(file_.points.size(), file_.triangles));
    if (auto warning = warning_of_unused(vertex, names(), "triangle")) warn(*std::move(warning));
    auto built = build(fixed_points(file_, vertex, fixed_tags));
    if (!built) {
      InputError error = built.error();
      if (error.where.empty()) error.where = file_.path;
      return error;
    }
    loaded_.mesh = std::move(built->mesh);
    warn_of_repairs(*built);
    LinesOfMesh lines = lines_of_mesh(file_, vertex, names(), loaded_.mesh.connectivity());
    loaded_.edge_lines = std::move(lines.edge_lines);
    for (const HalfedgeId h : lines.constrained) loaded_.mesh.set_constrained(h, true);
    for (std::string& warning : lines.warnings) warn(std::move(warning));
    for (const VertexId v : ends_of_tags(file_, lines.edges, loaded_.mesh.connectivity()))
      loaded_.mesh.set_fixed(v, true);
    for (const VertexId v : fixed_marks(file_, vertex, loaded_.mesh.connectivity())) loaded_.mesh.set_fixed(v, true);
    return std::move(loaded_);
  }

 private:
  void warn(std::string message) {
    loaded_.warnings.push_back(file_.path.empty() ? std::move(message) : text(file_.path, ": ", message));
  }
  void warn_of_repairs(const surfaces::BuiltSurface& built) {
    if (const std::size_t n = built.reversed_triangles; n > 0)
      warn(text(n, n == 1 ? " triangle is" : " triangles are", " reversed, so that all of a component face one side"));
    if (const std::size_t n = built.coincident_points; n > 0)
      warn(text(n, n == 1 ? " point is" : " points are", " at the place of another point. Next: if the surface should ",
                "be joined there, temper convert IN --merge 0 -o OUT"));
  }
  [[nodiscard]] const InputNames& names() const { return file_.numbering ? *file_.numbering : counting_; }
  [[nodiscard]] Expected<surfaces::BuiltSurface> build(const std::vector<std::int32_t>& fixed) const {
    const VertexOfPoint& vertex = loaded_.vertex_of_point;
    std::vector<Vec3> points;
    for (std::size_t p = 0; p < file_.points.size(); ++p) {
      if (vertex[p] >= 0) points.push_back(file_.place(p));
    }
    const std::vector<double> weights = kept(file_.weights, vertex);
    const auto triangles = renumbered(file_.triangles.corners, vertex);
    const KeptTriangleNames kept_names(names(), vertex);
    surfaces::SurfaceInput input;
    input.points = points;
    input.weights = weights;
    input.triangles = triangles;
    input.regions = file_.triangles.tags;
    input.fixed_vertices = fixed;
    input.names = &kept_names;
    return surfaces::SurfaceMesh::build(input);
  }

  const MeshFile& file_;
  InputNames counting_;
  LoadedSurface loaded_;
};

/// The change of a surface, for DataUpdater.
class SurfaceChange {
 public:
  static constexpr int dimension = 2;
  using Found = FoundOfChange<Place>;

  SurfaceChange(const surfaces::SurfaceMesh& before, const surfaces::SurfaceMesh& mesh)
      : before_(before), mesh_(mesh) {}
  [[nodiscard]] const Mesh& mesh() const { return mesh_.connectivity(); }
  [[nodiscard]] std::optional<std::array<std::int32_t, 3>> former_corners(std::size_t triangle) const {
    if (triangle >= before_.n_triangles()) return {};
    return numbers(before_.connectivity().corners(TriangleId(triangle)));
  }
  [[nodiscard]] std::optional<double> moved(VertexId v, VertexId was) const {
    if (before_.position(was) == mesh_.position(v)) return {};
    return length(mesh_.position(v) - before_.position(was));
  }
  [[nodiscard]] bool has_other_weight(VertexId v, VertexId was) const { return before_.weight(was) != mesh_.weight(v); }
  [[nodiscard]] Expected<Found> find(const Former& former, const WantedOfChange& wanted) const {
    if (wanted.vertex_overlaps || wanted.cell_overlaps)
      return InputError{ErrorCode::unsupported, {}, "data are not conserved on curved surfaces"};
    Found found;
    if (wanted.places) {
      std::vector<Vec3> points;
      for (const VertexId v : mesh().vertices()) points.push_back(mesh_.position(v));
      std::vector<Place> places = surfaces::closest_places(before_, points);
      for (const VertexId v : mesh().vertices()) {
        const VertexId was = former.empty() ? v : former[v];
        const bool stays = was.valid() && !moved(v, was);
        found.places.push_back(stays ? Place::at(was, places[v.index].triangle) : places[v.index]);
      }
    }
    if (wanted.sources) {
      std::vector<Vec3> middles;
      for (const TriangleId t : mesh().triangles()) {
        const auto [a, b, c] = mesh_.points(t);
        middles.push_back((1.0 / 3) * (a.position() + b.position() + c.position()));
      }
      for (const Place& place : surfaces::closest_places(before_, middles))
        found.sources.push_back(place.triangle.index);
    }
    return found;
  }

 private:
  const surfaces::SurfaceMesh &before_, &mesh_;
};

}  // namespace

Expected<LoadedSurface> make_surface(const MeshFile& file, std::span<const std::string> fixed_tags) {
  return guarded<LoadedSurface>(file.path, [&] { return SurfaceMaker(file).make(fixed_tags); });
}

DataReport update(MeshFile& file, const LoadedSurface& loaded, const surfaces::SurfaceMesh& mesh,
                  const Former& vertices, const UpdateOptions& options) {
  const bool has_unused = drop_unused_points(file, loaded.vertex_of_point);
  DataReport report = DataUpdater(file, SurfaceChange(loaded.mesh, mesh), vertices, options).update();
  update_lines(file, loaded.mesh.n_vertices(), loaded.edge_lines, mesh.connectivity(), vertices);
  copy_vertices(file, mesh);
  copy_cells(file.triangles, mesh.connectivity());
  if (has_unused || !vertices.empty()) file.numbering = nullptr;  // its numbers no longer fit the points
  return report;
}

}  // namespace temper::io

// From the arrays of a file to a mesh.
//
// Points of no triangle are left out of the mesh. Tagged lines inside the domain become constrained edges, unless they
// list all edges of the mesh. Marked points are fixed, unless they list vertices. Points of fixed tags are fixed, too,
// and points that the file calls required.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/conversion/edge_lines.hpp"
#include "io/conversion/fixed_points.hpp"
#include "io/conversion/format_traits.hpp"
#include "io/conversion/globe.hpp"
#include "io/conversion/kept_points.hpp"
#include "io/conversion/known_arrays.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/text/failure.hpp"
#include "io/text/file_names.hpp"
#include "io/text/names.hpp"
#include "io/text/values.hpp"
#include "temper/detail/faces.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

// The cause of an error of the mesh, if the file shows it: meshes that their program accepts, and temper does not
// support.

/// In a mesh that was made by hand, errors may come before all numbers are known to be right.
bool numbers_are_right(const MeshFile& file) {
  const auto right = [&](std::int32_t p) { return p >= 0 && static_cast<std::size_t>(p) < file.points.size(); };
  return !file.points.empty() && file.marked_points.tags.size() == file.marked_points.size() &&
         std::all_of(file.marked_points.begin(), file.marked_points.end(), right) &&
         std::all_of(file.triangles.begin(), file.triangles.end(),
                     [&](const auto& triangle) { return std::all_of(triangle.begin(), triangle.end(), right); });
}

/// Degrees from the western to the eastern end of points.
template <class Points>
double width_in_degrees(const MeshFile& file, const Points& points) {
  const auto x = [&](std::int32_t p) { return file.points[static_cast<std::size_t>(p)].x; };
  const auto [west, east] =
      std::minmax_element(points.begin(), points.end(), [&](auto a, auto b) { return x(a) < x(b); });
  return x(*east) - x(*west);
}

/// If triangles span more than half of a mesh that does not go around the globe, they join its ends. Meshes of a few
/// triangles are excepted.
std::string cyclic_in_longitude(const MeshFile& file) {
  constexpr double kAround = 270;     // degrees: with wide triangles a mesh around the globe may look as narrow
  constexpr std::size_t kFewest = 4;  // times as many triangles as those that join
  const auto [west, east] =
      std::minmax_element(file.points.begin(), file.points.end(), [](Vec2 p, Vec2 q) { return p.x < q.x; });
  const double width = east->x - west->x;
  if (width >= kAround) return {};
  const auto n =
      static_cast<std::size_t>(std::count_if(file.triangles.begin(), file.triangles.end(), [&](const auto& triangle) {
        return width_in_degrees(file, triangle) > width / 2;
      }));
  if (n == 0 || kFewest * n > file.triangles.size()) return {};
  return text("; ", n, n == 1 ? " triangle joins" : " triangles join", " the ends of the mesh in longitude, ", width,
              " degrees apart: it is cyclic, and on the sphere these ends do not meet. temper has such a mesh as a "
              "periodic plane, of MPAS, VTU or VTKHDF files");
}

/// The error that a mesh of the file was refused with, and its cause if the format tells: a mesh that is cyclic in
/// longitude.
InputError with_known_cause(InputError error, const MeshFile& file) {
  if (traits_of(file).may_join_ends && numbers_are_right(file)) error.message += cyclic_in_longitude(file);
  return error;
}

class MeshMaker {
 public:
  MeshMaker(const MeshFile& file, Executor* executor) : file_(file), executor_(executor) {}
  Expected<LoadedMesh> make(std::span<const std::string> fixed_tags) {
    number_vertices();
    auto built = build(fixed_points(file_, loaded_.vertex_of_point, fixed_tags));
    if (!built) {
      InputError error = with_known_cause(built.error(), file_);
      if (error.where.empty()) error.where = file_.path;
      return error;
    }
    loaded_.mesh = std::move(built->mesh);
    loaded_.reversed_triangles = built->reversed_triangles;
    const std::size_t reversed = loaded_.reversed_triangles;
    if (reversed > 0)
      warn(text(reversed, reversed == 1 ? " clockwise triangle is reversed" : " clockwise triangles are reversed"));
    LinesOfMesh lines = lines_of_mesh(file_, loaded_.vertex_of_point, names(), loaded_.mesh);
    edges_ = std::move(lines.edges);
    loaded_.edge_lines = std::move(lines.edge_lines);
    for (const HalfedgeId h : lines.constrained) loaded_.mesh.set_constrained(h, true);
    for (std::string& warning : lines.warnings) warn(std::move(warning));
    keep_quadrilaterals();
    keep_flagged_faces();
    fix_ends_of_tags(file_, edges_, loaded_.mesh);
    for (const VertexId v : fixed_marks(file_, loaded_.vertex_of_point, loaded_.mesh)) loaded_.mesh.set_fixed(v, true);
    return std::move(loaded_);
  }

 private:
  void number_vertices() {
    loaded_.vertex_of_point = VertexOfPoint(corners_among(file_.points.size(), file_.triangles));
    if (auto warning = warning_of_unused(loaded_.vertex_of_point, names(), "triangle")) warn(*std::move(warning));
  }
  void warn(std::string message) {
    loaded_.warnings.push_back(file_.path.empty() ? std::move(message) : text(file_.path, ": ", message));
  }
  [[nodiscard]] const InputNames& names() const { return file_.numbering ? *file_.numbering : counting_; }
  [[nodiscard]] bool whole() const { return loaded_.vertex_of_point.n_kept() == file_.points.size(); }
  // The file's own arrays when every point is used; else copies without the others.
  Expected<BuiltMesh> build(const std::vector<std::int32_t>& fixed) const {
    const auto& vertex = loaded_.vertex_of_point;
    const KeptTriangleNames kept_names(names(), vertex);
    MeshInput input;
    input.regions = file_.triangles.tags;
    input.fixed_vertices = fixed;
    input.executor = executor_;
    input.space = file_.space();
    input.names = &kept_names;
    input.points = file_.points;
    input.sphere_points = sphere_places(file_);
    input.weights = file_.weights;
    input.triangles = file_.triangles;
    if (whole()) return Mesh::build(input);
    const std::vector<Vec2> points = kept(file_.points, vertex);
    const std::vector<Vec3> places =
        file_.sphere() != nullptr ? kept(file_.sphere()->places, vertex) : std::vector<Vec3>();
    const std::vector<double> weights = kept(file_.weights, vertex);
    const auto triangles = renumbered(file_.triangles.corners, vertex);
    input.points = points;
    input.sphere_points = places;
    input.weights = weights;
    input.triangles = triangles;
    return Mesh::build(input);
  }
  /// Quadrilaterals stay as they are: their corners are fixed, their sides and their diagonal constrained.
  void keep_quadrilaterals() {
    Mesh& mesh = loaded_.mesh;
    for (const Halves& q : quadrilaterals_of(file_)) {
      for (const TriangleId t : {TriangleId(q.triangle), TriangleId(q.other)}) {
        for (const VertexId v : mesh.corners(t)) mesh.set_fixed(v, true);
        for (int k = 0; k < 3; ++k) {
          const HalfedgeId h = Mesh::halfedge(t, k);
          if (mesh.is_boundary(h) || mesh.is_diagonal(h)) continue;
          if (Mesh::triangle(mesh.twin(h)) == TriangleId(t.index == q.other ? q.triangle : q.other))
            mesh.set_diagonal(h);
          else
            mesh.set_constrained(h, true);
        }
      }
    }
  }
  /// Faces stay as they are: the weights and places around them, too.
  void keep_flagged_faces() {
    const DataArray* const data = find(file_.lines.data, kFace);
    const auto flags = data == nullptr || data->components != 1 ? std::nullopt : to_int32(data->values);
    if (!flags || flags->size() != file_.lines.size()) return;
    std::vector<HalfedgeId> faces;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if ((*flags)[i] == 1 && edges_[i].valid() && !loaded_.mesh.is_boundary(edges_[i])) faces.push_back(edges_[i]);
    }
    keep_faces(loaded_.mesh, faces);
  }
  const MeshFile& file_;
  Executor* executor_;
  InputNames counting_;
  LoadedMesh loaded_;
  std::vector<HalfedgeId> edges_;  // of each line of the file; invalid: it is none of the mesh
};

}  // namespace

VertexOfPoint::VertexOfPoint(const std::vector<bool>& kept) : VertexOfPoint(kept.size()) {
  n_kept_ = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
  if (n_kept_ == n_) return;
  vertices_.assign(n_, -1);
  std::int32_t next = 0;
  for (std::size_t p = 0; p < n_; ++p) {
    if (kept[p]) vertices_[p] = next++;
  }
}

Expected<void> expect_triangles(const MeshFile& file) {
  if (auto right = expect_no_surface(file); !right) return right;
  const std::size_t n = file.tetrahedra.size();
  if (n == 0) return {};
  return InputError{ErrorCode::unsupported, file.numbering ? file.numbering->tetrahedron_where(0) : file.path,
                    text("has ", n, n == 1 ? " tetrahedron" : " tetrahedra",
                         "; expected a mesh of triangles. Next: temper check, convert, draw, explain, optimize, "
                         "weights, operators and errors take tetrahedra")};
}

Expected<LoadedMesh> make_mesh(const MeshFile& file, std::span<const std::string> fixed_tags, Executor* executor) {
  if (auto right = expect_triangles(file); !right) return right.error();
  if (const DegreePoints* const degrees = file.degrees())
    return InputError{ErrorCode::geographic, file.path, needs_projection(degrees->is_guessed)};
  return guarded<LoadedMesh>(file.path, [&] { return MeshMaker(file, executor).make(fixed_tags); });
}

}  // namespace temper::io

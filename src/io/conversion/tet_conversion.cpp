// From the arrays of a file with tetrahedra to a mesh.
//
// Points of no tetrahedron are left out of the mesh, with the faces, lines and marks at them. Everything that is
// dropped or repaired is named in warnings, in the numbers of the file.
#include <algorithm>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/conversion/kept_points.hpp"
#include "io/text/failure.hpp"
#include "io/text/names.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

class KeptTetNames final : public KeptNames<tets::InputNames> {
 public:
  using KeptNames::KeptNames;
  [[nodiscard]] std::string tetrahedron(std::size_t i) const override { return all().tetrahedron(i); }
  [[nodiscard]] std::string tetrahedron_where(std::size_t i) const override { return all().tetrahedron_where(i); }
};

class TetMeshMaker {
 public:
  TetMeshMaker(const MeshFile& file, Executor* executor) : file_(file), executor_(executor) {}

  Expected<LoadedTetMesh> make() {
    number_vertices();
    const VertexOfPoint& vertex = loaded_.vertex_of_point;
    const auto tetrahedra = renumbered(file_.tetrahedra.corners, vertex);
    const auto faces = renumbered(file_.triangles.corners, vertex);
    const auto lines = renumbered(file_.lines.corners, vertex);
    const std::vector<Vec3> points = kept_places();
    const std::vector<double> weights = kept(file_.weights, vertex);
    const auto [marked, tags] = kept_marks();
    std::vector<std::int32_t> fixed;
    for (const std::int32_t p : required_points(file_.point_data)) {
      if (is_point(p) && vertex[static_cast<std::size_t>(p)] >= 0) fixed.push_back(vertex[static_cast<std::size_t>(p)]);
    }
    const KeptTetNames names(names_of_file(), loaded_.vertex_of_point);
    tets::TetMeshInput input;
    input.points = points;
    input.weights = weights;
    input.tetrahedra = tetrahedra;
    input.regions = file_.tetrahedra.tags;
    input.faces = faces;
    input.face_tags = file_.triangles.tags;
    input.lines = lines;
    input.line_tags = file_.lines.tags;
    input.marked_points = marked;
    input.point_tags = tags;
    input.fixed_points = fixed;
    input.names = &names;
    input.executor = executor_;
    auto built = tets::TetMesh::build(input);
    if (!built) {
      InputError error = built.error();
      if (error.where.empty()) error.where = file_.path;
      return error;
    }
    loaded_.mesh = std::move(built->mesh);
    const std::size_t n = built->reversed_tetrahedra;
    if (n > 0) {
      warn(text(n, n == 1 ? " negative tetrahedron is" : " negative tetrahedra are",
                " reversed: two corners are exchanged, the shape stays"));
    }
    warn_of_dangling(built->dangling_faces, "face is no face", "faces are no faces",
                     [&](std::size_t i) { return names_of_file().triangle(i); });
    warn_of_dangling(built->dangling_lines, "line is no edge", "lines are no edges",
                     [&](std::size_t i) { return names_of_file().line(i); });
    return std::move(loaded_);
  }

 private:
  void warn(std::string message) {
    loaded_.warnings.push_back(file_.path.empty() ? std::move(message) : text(file_.path, ": ", message));
  }
  template <class Name>
  void warn_of(const std::vector<std::size_t>& indices, std::string_view what, const Name& name) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < std::min(indices.size(), kNamed); ++k) names.push_back(name(indices[k]));
    warn(listed(indices.size(), what, names));
  }
  template <class Name>
  void warn_of_dangling(const std::vector<std::size_t>& indices, std::string_view one, std::string_view several,
                        const Name& name) {
    if (indices.empty()) return;
    warn_of(indices,
            text(indices.size() == 1 ? one : several, " of the mesh and ", indices.size() == 1 ? "tags" : "tag",
                 " nothing"),
            name);
  }
  [[nodiscard]] const tets::InputNames& names_of_file() const { return file_.numbering ? *file_.numbering : counting_; }
  [[nodiscard]] bool is_point(std::int32_t p) const {
    return p >= 0 && static_cast<std::size_t>(p) < file_.points.size();
  }

  void number_vertices() {
    loaded_.vertex_of_point = VertexOfPoint(corners_among(file_.points.size(), file_.tetrahedra));
    if (auto warning = warning_of_unused(loaded_.vertex_of_point, names_of_file(), "tetrahedron"))
      warn(*std::move(warning));
  }
  [[nodiscard]] std::vector<Vec3> kept_places() const {
    std::vector<Vec3> places;
    for (std::size_t p = 0; p < file_.points.size(); ++p) {
      if (loaded_.vertex_of_point[p] >= 0) places.push_back(file_.place(p));
    }
    return places;
  }
  [[nodiscard]] std::pair<std::vector<std::int32_t>, std::vector<std::int32_t>> kept_marks() const {
    std::vector<std::int32_t> marked, tags;
    for (std::size_t i = 0; i < file_.marked_points.size(); ++i) {
      const std::int32_t p = file_.marked_points[i];
      const std::int32_t v = is_point(p) ? loaded_.vertex_of_point[static_cast<std::size_t>(p)] : p;
      if (is_point(p) && v < 0) continue;  // dropped with its point, which a warning names
      marked.push_back(v);
      if (i < file_.marked_points.tags.size()) tags.push_back(file_.marked_points.tags[i]);
    }
    return {std::move(marked), std::move(tags)};
  }

  const MeshFile& file_;
  Executor* executor_;
  tets::InputNames counting_;
  LoadedTetMesh loaded_;
};

}  // namespace

Expected<LoadedTetMesh> make_tet_mesh(const MeshFile& file, Executor* executor) {
  return guarded<LoadedTetMesh>(file.path, [&] { return TetMeshMaker(file, executor).make(); });
}

}  // namespace temper::io

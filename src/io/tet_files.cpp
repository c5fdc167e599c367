#include "io/tet_files.hpp"

#include <algorithm>
#include <utility>

#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {

TetFile tet_file(Document&& document) {
  MeshFile& f = document.file;
  Tetrahedra& tets = document.tetrahedra;
  for (DataArray& array : tets.data) array.name = plain_name(array.name);
  make_names_unique(tets.data);
  TetFile result;
  result.points.reserve(f.points.size());
  for (std::size_t i = 0; i < f.points.size(); ++i) result.points.push_back(document.place(i));
  result.weights = std::move(f.weights);
  result.tetrahedra = std::move(tets.corners);
  result.regions = std::move(tets.regions);
  result.cell_data = std::move(tets.data);
  result.faces = std::move(f.triangles);
  result.face_tags = std::move(f.regions);
  result.face_tags.resize(result.faces.size());
  result.face_data = std::move(f.cell_data);
  result.lines = std::move(f.lines);
  result.line_tags = std::move(f.line_tags);
  result.line_data = std::move(f.line_data);
  result.marked_points = std::move(f.marked_points);
  result.point_tags = std::move(f.point_tags);
  result.marked_point_data = std::move(f.marked_point_data);
  result.names = std::move(f.names);
  result.point_data = std::move(f.point_data);
  result.field_data = std::move(f.field_data);
  result.path = std::move(f.path);
  result.format = std::move(f.format);
  result.warnings = std::move(f.warnings);
  result.numbering = std::move(document.names);
  return result;
}

MeshFile tags_of_file(const TetFile& file) {
  MeshFile f;
  f.points.reserve(file.points.size());
  for (const Vec3& p : file.points) f.points.push_back({p.x, p.y});
  if (std::any_of(file.weights.begin(), file.weights.end(), [](double w) { return w != 0; })) f.weights = file.weights;
  f.triangles = file.faces;
  f.regions = file.face_tags;
  f.cell_data = file.face_data;
  f.lines = file.lines;
  f.line_tags = file.line_tags;
  f.line_data = file.line_data;
  f.marked_points = file.marked_points;
  f.point_tags = file.point_tags;
  f.marked_point_data = file.marked_point_data;
  f.names = file.names;
  f.point_data = file.point_data;
  f.field_data = file.field_data;
  return f;
}

void check_sizes(const std::string& path, const TetFile& f) {
  const auto insist = [&](bool good, std::string_view what) {
    if (!good) fail(ErrorCode::size_mismatch, path, "the mesh to be written has ", what);
  };
  insist(f.regions.empty() || f.regions.size() == f.tetrahedra.size(), "another number of regions than of tetrahedra");
  insist(f.face_tags.size() == f.faces.size(), "another number of face tags than of faces");
  for (const DataArray& a : f.cell_data) {
    insist(plain_name(a.name) == a.name, "cell data whose name is not in UTF-8, or has control characters");
    insist(a.components >= 1 && size(a.values) == f.tetrahedra.size() * static_cast<std::size_t>(a.components),
           text("cell data ", in_quotes(a.name), " with ", size(a.values), " values, expected ", f.tetrahedra.size(),
                " times ", a.components));
  }
  for (const auto& t : f.tetrahedra)
    insist(std::all_of(t.begin(), t.end(),
                       [&](std::int32_t p) { return p >= 0 && static_cast<std::size_t>(p) < f.points.size(); }),
           "a tetrahedron with a vertex that is none");
}

}  // namespace temper::io

// A file, and what was loaded of it, as values of an archive (temper/archive.hpp): for checkpoints, and for meshes that
// go from one process to another. Each visit() names all members of its class, so that a new one does not compile
// before it is looked at here.
#include <utility>

#include "io/conversion/globe.hpp"
#include "io/text/file_names.hpp"
#include "temper/archive.hpp"
#include "temper/io.hpp"

namespace temper::io {

void visit(Archive& archive, DataArray& array) {
  auto& [name, components, values] = array;
  archive(name, components, values);
}

void visit(Archive& archive, PhysicalName& physical) {
  auto& [dimension, tag, name] = physical;
  archive(dimension, tag, name);
}

void visit(Archive& archive, GeographicMap& map) {
  auto& [projection, lon_lat, places] = map;
  auto& [kind, center, radius] = projection;
  archive(kind, center, radius, lon_lat, places);
}

void RunLength::visit(Archive& archive) {
  auto& [runs, size] = *this;
  static_assert(sizeof(Run) == sizeof(std::size_t) + sizeof(std::int64_t));  // no gaps
  archive.plain(runs);
  archive(size);
}

void visit(Archive& archive, FileNames& names) {
  archive(names.path, names.triangle_path, names.points, names.triangles, names.lines, names.point_lines,
          names.triangle_lines, names.line_lines);
}

void VertexOfPoint::visit(Archive& archive) {
  auto& [n, n_kept, vertices] = *this;
  archive(n, n_kept, vertices);
}

namespace {

/// The names are those of a file that was read, if any.
void visit_names(Archive& archive, MeshFile& file) {
  const auto* known = dynamic_cast<const FileNames*>(file.numbering.get());
  bool are_known = known != nullptr;
  auto names = std::make_shared<FileNames>(are_known ? *known : FileNames(file.path));
  archive(are_known, *names);
  if (archive.reads()) file.numbering = are_known ? std::move(names) : nullptr;
}

void visit_points(Archive& archive, MeshFile& file) {
  std::size_t kind = file.points_in.index();
  double z = file.z(), radius = file.space().radius();
  Vec2 period = file.space().period();
  bool is_guessed = file.degrees() != nullptr && file.degrees()->is_guessed;
  std::vector<Vec3> places(sphere_places(file).begin(), sphere_places(file).end());
  std::optional<GeographicMap> map;
  if (file.map() != nullptr) map = *file.map();
  archive(kind, z, radius, period, is_guessed, places, map);
  if (!archive.reads()) return;
  switch (kind) {
    case 1:
      file.points_in = PeriodicPoints{period, z};
      return;
    case 2:
      file.points_in = SpherePoints{radius, std::move(places)};
      return;
    case 3:
      file.points_in = DegreePoints{is_guessed, z};
      return;
    case 4:
      file.points_in = MappedPoints{std::make_shared<const GeographicMap>(map.value_or(GeographicMap())), z};
      return;
    default:
      file.points_in = PlanePoints{z};
  }
}

}  // namespace

void visit(Archive& archive, MeshFile& file) {
  auto& [points, points_in, weights, triangles, regions, lines, line_tags, marked_points, point_tags, names, point_data,
         cell_data, line_data, marked_point_data, field_data, path, format, warnings, numbering] = file;
  archive(points, weights, triangles, regions, lines, line_tags, marked_points, point_tags, names, point_data,
          cell_data, line_data, marked_point_data, field_data, path, format, warnings);
  visit_points(archive, file);
  visit_names(archive, file);
}

void visit(Archive& archive, LoadedMesh& loaded) {
  auto& [mesh, vertex_of_point, reversed_triangles, edge_lines, warnings] =
      loaded;  // mesh: it is kept by whoever has it
  std::vector<std::uint8_t> are_edge_lines(edge_lines.begin(), edge_lines.end());
  archive(vertex_of_point, reversed_triangles, are_edge_lines, warnings);
  if (archive.reads()) edge_lines.assign(are_edge_lines.begin(), are_edge_lines.end());
}

}  // namespace temper::io

// A file, and what was loaded of it, as values of an archive (temper/archive.hpp): for checkpoints, and for meshes that
// go from one process to another. Each visit() names all members of its class, so that a new one does not compile
// before it is looked at here.
#include <utility>

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

void visit_map(Archive& archive, MeshFile& file) {
  std::optional<GeographicMap> map;
  if (file.map && !archive.reads()) map = *file.map;
  archive(map);
  if (archive.reads()) file.map = map ? std::make_shared<const GeographicMap>(*std::move(map)) : nullptr;
}

}  // namespace

void visit(Archive& archive, MeshFile& file) {
  auto& [points, sphere_radius, sphere_points, period, z, weights, triangles, regions, lines, line_tags, marked_points,
         point_tags, names, point_data, cell_data, line_data, marked_point_data, field_data, geographic,
         geographic_is_guessed, map, path, format, warnings, numbering] = file;
  archive(points, sphere_radius, sphere_points, period, z, weights, triangles, regions, lines, line_tags, marked_points,
          point_tags, names, point_data, cell_data, line_data, marked_point_data, field_data, geographic,
          geographic_is_guessed, path, format, warnings);
  visit_map(archive, file);
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

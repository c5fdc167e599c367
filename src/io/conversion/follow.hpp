// Cells of a file that follow a changed mesh, with their tags and data: the same for points, lines, faces and cells of
// the mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "io/text/values.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// Elements by indices that may repeat.
template <class T>
std::vector<T> at(const std::vector<T>& values, const std::vector<std::size_t>& indices) {
  std::vector<T> result;
  result.reserve(indices.size());
  for (const std::size_t i : indices) result.push_back(values[i]);
  return result;
}
/// Rows of data by indices that may repeat.
void take_rows(std::vector<DataArray>& arrays, const std::vector<std::size_t>& indices);
/// The tags and data of the cells that these indices name, for cells whose corners are new.
template <int dimension>
void take_contents(Cells<dimension>& cells, const std::vector<std::size_t>& indices) {
  if (!cells.tags.empty()) cells.tags = at(cells.tags, indices);
  take_rows(cells.data, indices);
}

/// Removes the triangles that do not stay, with their tags and data. Numbers of the file no longer hold.
void keep_triangles(MeshFile& file, const std::vector<bool>& stays);

/// The new number of each point; −1: it is gone.
class NewNumbers {
 public:
  explicit NewNumbers(std::size_t n) : numbers_(n, -1) {}
  explicit NewNumbers(const VertexOfPoint& vertices) {
    for (std::size_t p = 0; p < vertices.size(); ++p) numbers_.push_back(vertices[p]);
  }
  /// The numbers of n former points among the vertices of a mesh. `former(v)`: the point of v, invalid for a new one.
  template <class M, class FormerOf>
  NewNumbers(std::size_t n, const M& mesh, const FormerOf& former) : NewNumbers(n) {
    for (const VertexId v : mesh.vertices()) {
      if (former(v).valid()) numbers_[former(v).index] = static_cast<std::int32_t>(v.index);
    }
  }
  /// Tags that the mesh has dropped may name points out of range: they are lost, too.
  [[nodiscard]] std::int32_t operator()(std::int32_t point) const {
    return point >= 0 && static_cast<std::size_t>(point) < numbers_.size() ? numbers_[static_cast<std::size_t>(point)]
                                                                           : -1;
  }
  [[nodiscard]] std::size_t size() const { return numbers_.size(); }
  void push_back(std::int32_t number) { numbers_.push_back(number); }

 private:
  std::vector<std::int32_t> numbers_;
};

template <class Corners>
void renumber_corners(Corners& cell, const NewNumbers& number) {
  for (std::int32_t& p : corners_of(cell)) p = number(p);
}
template <class Corners>
[[nodiscard]] bool is_there(const Corners& cell) {
  return std::ranges::all_of(corners_of(cell), [](std::int32_t p) { return p >= 0; });
}

/// Renumbers cells, and drops those that lose a point, with their tags and data. Returns the number of these.
template <int dimension>
std::size_t renumber(Cells<dimension>& cells, const NewNumbers& number) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    renumber_corners(cells[i], number);
    if (is_there(cells[i])) kept.push_back(i);
  }
  const std::size_t lost = cells.size() - kept.size();
  if (lost == 0) return 0;
  cells.corners = at(cells.corners, kept);
  take_contents(cells, kept);
  return lost;
}

/// Drops the points that are no vertices of the mesh, with all that is at them. Returns false if there are none, or if
/// the points are no longer those of the file.
inline bool drop_unused_points(MeshFile& file, const VertexOfPoint& vertices) {
  if (vertices.n_kept() == vertices.size() || file.points.size() != vertices.size()) return false;
  std::vector<std::size_t> used;
  for (std::size_t p = 0; p < vertices.size(); ++p) {
    if (vertices[p] >= 0) used.push_back(p);
  }
  file.points = at(file.points, used);
  if (auto* const sphere = std::get_if<SpherePoints>(&file.points_in)) sphere->places = at(sphere->places, used);
  if (auto* const space = std::get_if<SpacePoints>(&file.points_in)) space->heights = at(space->heights, used);
  take_rows(file.point_data, used);
  const NewNumbers number(vertices);
  std::apply([&](auto&... cells) { (renumber(cells, number), ...); }, file.cells());
  return true;
}

// The cells of a mesh, for both kinds.
[[nodiscard]] inline auto ids_of_cells(const Mesh& mesh) { return mesh.triangles(); }
[[nodiscard]] inline auto ids_of_cells(const tets::TetMesh& mesh) { return mesh.tetrahedra(); }
[[nodiscard]] inline std::size_t n_cells(const Mesh& mesh) { return mesh.n_triangles(); }
[[nodiscard]] inline std::size_t n_cells(const tets::TetMesh& mesh) { return mesh.n_tetrahedra(); }

/// Gives the cells of a mesh to a file: regions if the file has them, or the mesh has others than 0.
template <int dimension, class M>
void copy_cells(Cells<dimension>& cells, const M& mesh) {
  bool regions = !cells.tags.empty();
  cells.corners.resize(n_cells(mesh));
  for (const auto id : ids_of_cells(mesh)) {
    const auto corners = mesh.corners(id);
    for (std::size_t k = 0; k <= dimension; ++k) cells[id.index][k] = static_cast<std::int32_t>(corners[k].index);
    regions = regions || mesh.region(id) != 0;
  }
  cells.tags.resize(regions ? n_cells(mesh) : 0);
  if (!regions) return;
  for (const auto id : ids_of_cells(mesh)) cells.tags[id.index] = mesh.region(id);
}

}  // namespace temper::io

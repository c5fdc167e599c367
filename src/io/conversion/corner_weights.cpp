// Weights for each vertex and region: cell data with a number for each corner.
#include <algorithm>
#include <array>
#include <cstddef>
#include <variant>

#include "io/conversion/known_arrays.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

auto find_array(auto& data) {
  return std::ranges::find_if(data, [](const DataArray& array) {
    return array.name == kCornerWeights && std::holds_alternative<std::vector<double>>(array.values);
  });
}

/// Cells of the mesh may have their corners in another order than those of the file.
template <std::size_t n, class Cells, class Loaded, class CornersOf>
std::vector<double> read_corners(const Cells& cells, const Loaded& loaded, std::size_t n_cells,
                                 const CornersOf& corners_of) {
  const auto array = find_array(cells.data);
  if (array == cells.data.end() || array->components != static_cast<int>(n) || cells.size() != n_cells) return {};
  const auto& values = std::get<std::vector<double>>(array->values);
  std::vector<double> weights(n * n_cells);
  for (std::size_t t = 0; t < n_cells; ++t) {
    const std::array<VertexId, n> corners = corners_of(t);
    for (std::size_t k = 0; k < n * n; ++k) {
      const auto point = static_cast<std::size_t>(cells[t].at(k % n));
      if (loaded.vertex_of_point[point] == static_cast<std::int32_t>(corners[k / n].index))
        weights[n * t + k / n] = values[n * t + k % n];
    }
  }
  return weights;
}

template <class Cells>
void set_array(Cells& cells, int components, const std::vector<double>& weights) {
  std::erase_if(cells.data, [](const DataArray& array) { return array.name == kCornerWeights; });
  if (!weights.empty()) cells.data.push_back({std::string(kCornerWeights), components, weights});
}

}  // namespace

std::vector<double> corner_weights_of(const MeshFile& file, const LoadedMesh& loaded) {
  const Mesh& mesh = loaded.mesh;
  return read_corners<3>(file.triangles, loaded, mesh.n_triangles(),
                         [&mesh](std::size_t t) { return mesh.corners(TriangleId(t)); });
}

std::vector<double> corner_weights_of(const MeshFile& file, const LoadedTetMesh& loaded) {
  const tets::TetMesh& mesh = loaded.mesh;
  return read_corners<4>(file.tetrahedra, loaded, mesh.n_tetrahedra(),
                         [&mesh](std::size_t t) { return mesh.corners(tets::TetId(t)); });
}

void set_corner_weights(MeshFile& file, const std::vector<double>& weights) {
  file.tetrahedra.size() == 0 ? set_array(file.triangles, 3, weights) : set_array(file.tetrahedra, 4, weights);
}

}  // namespace temper::io

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

}  // namespace

/// Triangles of the mesh are counter-clockwise, those of the file need not be.
std::vector<double> corner_weights_of(const MeshFile& file, const LoadedMesh& loaded) {
  const auto array = find_array(file.triangles.data);
  const Mesh& mesh = loaded.mesh;
  if (array == file.triangles.data.end() || array->components != 3 || file.triangles.size() != mesh.n_triangles())
    return {};
  const auto& values = std::get<std::vector<double>>(array->values);
  std::vector<double> weights(mesh.n_halfedges());
  for (const HalfedgeId h : mesh.halfedges()) {
    const std::size_t t = h.index / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto point = static_cast<std::size_t>(file.triangles[t].at(k));
      if (loaded.vertex_of_point[point] == static_cast<std::int32_t>(mesh.origin(h).index))
        weights[h.index] = values[3 * t + k];
    }
  }
  return weights;
}

void set_corner_weights(MeshFile& file, const std::vector<double>& weights) {
  std::erase_if(file.triangles.data, [](const DataArray& array) { return array.name == kCornerWeights; });
  if (!weights.empty()) file.triangles.data.push_back({std::string(kCornerWeights), 3, weights});
}

}  // namespace temper::io

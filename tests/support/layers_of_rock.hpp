// A lattice of layers with different tensors, and a pressure that is linear in each of them.
#pragma once

#include <cmath>
#include <vector>

#include "support/lattice.hpp"
#include "temper/detail/tensor.hpp"

namespace temper::test {

struct LayersOfRock {
  Mesh mesh;
  std::vector<Tensor> tensors;  ///< of the triangles
  std::vector<Tensor> of_layers;
  std::vector<Vec2> gradients;  ///< of the pressure in each layer
  std::vector<double> constants;
  std::vector<std::size_t> layers;  ///< of the triangles

  [[nodiscard]] MetricMesh pieces() const { return *mapped(mesh, *Metrics::of(tensors)); }
  [[nodiscard]] double pressure(TriangleId t, Vec2 x) const {
    return dot(gradients[layers[t.index]], x) + constants[layers[t.index]];
  }
};

/// Layers of `rows` rows of a lattice each, with tensors of the eigenvalues 1 and `ratio` and turned axes. Rows are
/// level, so slopes along x are equal, and so are fluxes along y.
inline LayersOfRock layers_of_rock(int n_layers, double ratio, int rows = 3, double jitter = 0.1,
                                   std::uint64_t seed = 1) {
  LayersOfRock rock;
  const int n = n_layers * rows + 1;
  rock.mesh = lattice({.n = n, .jitter = jitter, .weight = 0, .seed = seed});
  // Vertices of interfaces are on their lines.
  for (const VertexId v : rock.mesh.vertices()) {
    const int row = static_cast<int>(v.index) / n;
    if (row % rows == 0) rock.mesh.set_position(v, {rock.mesh.position(v).x, std::sqrt(0.75) * row});
  }
  const double slope = 0.7, flux = 0.4, height = std::sqrt(0.75) * rows;
  for (int i = 0; i < n_layers; ++i) {
    const double angle = 0.7 + 1.3 * i, c = std::cos(angle), s = std::sin(angle), more = ratio - 1;
    const Tensor k = {1 + more * c * c, more * c * s, 1 + more * s * s};
    rock.of_layers.push_back(k);
    rock.gradients.push_back({slope, (flux - k.xy * slope) / k.yy});
    const double before =
        i == 0 ? 0 : rock.constants.back() + (rock.gradients[i - 1].y - rock.gradients[i].y) * height * i;
    rock.constants.push_back(before);
  }
  for (const TriangleId t : rock.mesh.triangles()) {
    double y = 0;
    for (const VertexId v : rock.mesh.corners(t)) y += rock.mesh.position(v).y / 3;
    rock.layers.push_back(static_cast<std::size_t>(y / height));
    rock.tensors.push_back(rock.of_layers[rock.layers.back()]);
  }
  return rock;
}

}  // namespace temper::test

#include "experiments/inputs.hpp"

#include <utility>

#include "temper/generate.hpp"

namespace temper::gallery {

const Mesh& dense_horseshoe() {
  static const Mesh mesh = [] {
    auto made = horseshoe();
    return made ? *std::move(made) : Mesh();
  }();
  return mesh;
}

}  // namespace temper::gallery

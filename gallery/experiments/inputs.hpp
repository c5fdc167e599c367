// The dense horseshoe of figure 11, from which most runs start. (The sparse one is a constant of the library.)
#pragma once

#include "temper/mesh.hpp"

namespace temper::gallery {

[[nodiscard]] const Mesh& dense_horseshoe();

}  // namespace temper::gallery

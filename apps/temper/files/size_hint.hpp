// What to say of a mesh without sizes: the extent of its outline, and a size that makes some thousand triangles.
#pragma once

#include <string>

#include "temper/mesher.hpp"

namespace temper::app {

/// "The outline is 4000 by 2150. Next: --size 61, which makes about 4000 triangles, or --points few". Without a
/// projection an outline in degrees gets one. Throws Failure for errors in the outline.
[[nodiscard]] std::string size_hint(const Outline& outline, bool geographic, const std::string& projection,
                                    const MesherOptions& options);
[[nodiscard]] std::string size_hint(const SphereOutline& outline, const MesherOptions& options);

}  // namespace temper::app

// The colours of drawings of triangles and meshes: those of temper's pictures.
#pragma once

namespace temper::gallery {

inline constexpr const char *kInk = "#222222", *kDual = "#005fa3", *kPositive = "#00845f", *kNegative = "#c8320a";

}  // namespace temper::gallery

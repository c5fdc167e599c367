// A moment of a run as a picture: vertices by their number in the input, and the edges that flip between two moments.
#pragma once

#include <vector>

#include "experiments/mesh_picture.hpp"
#include "experiments/recording.hpp"

namespace temper::gallery {

/// A disc on the vertex with that number in the input, unless it has been removed.
void add_mark(MeshPicture& picture, const Moment& moment, VertexId input, const char* color);

/// The triangles that the other moment has not.
[[nodiscard]] std::vector<Shade> cavities(const Moment& here, const Moment& there);

}  // namespace temper::gallery

// Lines on faces of power cells in pictures.
#pragma once

#include <vector>

#include "draw/panel.hpp"

namespace temper {

/// The lines with their names, over a panel of cells. Neither framed nor clipped.
[[nodiscard]] Panel draw_lines(const std::vector<FaceLine>& lines, const Viewport& viewport,
                               const DrawOptions& options);

/// Says whether an edge is only kept because of faces: its dual is one, or it belongs to the polygon around an end.
[[nodiscard]] bool is_beside_face(const Mesh& mesh, HalfedgeId h);

}  // namespace temper

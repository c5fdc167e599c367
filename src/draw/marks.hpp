// Marks over the mesh of a panel.
#pragma once

#include "draw/panel.hpp"

namespace temper {

/// Dots on fixed vertices, lines where a period begins again, rings around edges that are nearly points, and numbers.
/// Neither framed nor clipped.
[[nodiscard]] Panel draw_marks(const Mesh& mesh, const Viewport& viewport, const DrawOptions& options);

}  // namespace temper

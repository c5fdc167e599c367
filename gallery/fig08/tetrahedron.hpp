// Figure 8 with a dimension more: the energy of tetrahedra over the position of one vertex.
#pragma once

#include "gallery.hpp"

namespace temper::gallery::fig08 {

/// Adds pictures, a table, and claims of temper: what of the triangle generalizes, and what does not.
void add_tetrahedron(Page& page, bool full);

}  // namespace temper::gallery::fig08

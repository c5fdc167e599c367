// The figures' makers: figNN::make is defined in figNN/figure.cpp.
#pragma once

#include "gallery.hpp"

namespace temper::gallery {

// clang-format off
// Distances of a triangle and its dual.
namespace fig01 { Page make(Effort effort); }
namespace fig02 { Page make(Effort effort); }

// Energy landscapes and the single triangle.
namespace fig03 { Page make(Effort effort); }
namespace fig04 { Page make(Effort effort); }
namespace fig05 { Page make(Effort effort); }
namespace fig06 { Page make(Effort effort); }
namespace fig07 { Page make(Effort effort); }
namespace fig08 { Page make(Effort effort); }
namespace fig09 { Page make(Effort effort); }
namespace fig10 { Page make(Effort effort); }

// The sparse horseshoe.
namespace fig11 { Page make(Effort effort); }
namespace fig12 { Page make(Effort effort); }
namespace fig13 { Page make(Effort effort); }
namespace fig14 { Page make(Effort effort); }
namespace fig15 { Page make(Effort effort); }

// The dense horseshoe without collapses.
namespace fig16 { Page make(Effort effort); }
namespace fig17 { Page make(Effort effort); }
namespace fig18 { Page make(Effort effort); }

// Its collapses and outer iterations, positions only.
namespace fig19 { Page make(Effort effort); }
namespace fig20 { Page make(Effort effort); }
namespace fig21 { Page make(Effort effort); }
namespace fig22 { Page make(Effort effort); }

// Weights over the mesh that oscillates.
namespace fig23 { Page make(Effort effort); }
namespace fig24 { Page make(Effort effort); }
namespace fig25 { Page make(Effort effort); }

// High heat, removal, and the summary.
namespace fig26 { Page make(Effort effort); }
namespace fig27 { Page make(Effort effort); }
namespace fig28 { Page make(Effort effort); }
namespace fig29 { Page make(Effort effort); }
namespace fig30 { Page make(Effort effort); }
namespace fig31 { Page make(Effort effort); }
namespace fig32 { Page make(Effort effort); }
// clang-format on

}  // namespace temper::gallery

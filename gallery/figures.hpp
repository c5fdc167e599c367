// The figures' makers: make_figNN is defined in figNN/figure.cpp.
#pragma once

#include "gallery.hpp"

namespace temper::gallery {

// Distances of a triangle and its dual.
Page make_fig01(Effort effort);
Page make_fig02(Effort effort);

// Energy landscapes and the single triangle.
Page make_fig03(Effort effort);
Page make_fig04(Effort effort);
Page make_fig05(Effort effort);
Page make_fig06(Effort effort);
Page make_fig07(Effort effort);
Page make_fig08(Effort effort);
Page make_fig09(Effort effort);
Page make_fig10(Effort effort);

// The sparse horseshoe.
Page make_fig11(Effort effort);
Page make_fig12(Effort effort);
Page make_fig13(Effort effort);
Page make_fig14(Effort effort);
Page make_fig15(Effort effort);

// The dense horseshoe without collapses.
Page make_fig16(Effort effort);
Page make_fig17(Effort effort);
Page make_fig18(Effort effort);

// Its collapses and outer iterations, positions only.
Page make_fig19(Effort effort);
Page make_fig20(Effort effort);
Page make_fig21(Effort effort);
Page make_fig22(Effort effort);

// Weights over the mesh that oscillates.
Page make_fig23(Effort effort);
Page make_fig24(Effort effort);
Page make_fig25(Effort effort);

// High heat, removal, and the summary.
Page make_fig26(Effort effort);
Page make_fig27(Effort effort);
Page make_fig28(Effort effort);
Page make_fig29(Effort effort);
Page make_fig30(Effort effort);
Page make_fig31(Effort effort);
Page make_fig32(Effort effort);

}  // namespace temper::gallery

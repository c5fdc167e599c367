// Included by one source for each instruction set, compiled for that set.
#pragma once

#include "tets/energy/parts_kernel.hpp"

namespace temper::TEMPER_INSTRUCTION_SET {
namespace {

using Duals = tets::TetDuals<Pack>;

TEMPER_INLINE Duals duals_of(const tets::TetLanes& tetrahedra) {
  const auto& c = tetrahedra.corners;
  return Duals({tets::load<Pack>(c[0]), tets::load<Pack>(c[1]), tets::load<Pack>(c[2]), tets::load<Pack>(c[3])});
}

void parts(const tets::TetLanes& tetrahedra, tets::PartsLanes& to) {
  tets::TetPartsOf<Pack> parts = duals_of(tetrahedra).parts();
  tets::Lane* next = to.numbers;
  parts.for_each([&](const Pack& number) { number.store(*next++); });
}

void pull_back(const tets::TetLanes& tetrahedra, const tets::PartsLanes& from, tets::TetLanes& by_corners) {
  tets::TetPartsOf<Pack> by;
  const tets::Lane* next = from.numbers;
  by.for_each([&](Pack& number) { number = Pack::load(*next++); });
  tets::PointVector<Pack> slopes[4];
  duals_of(tetrahedra).pull_back(by, slopes);
  for (std::size_t k = 0; k < 4; ++k) {
    auto& [x, y, z, w] = by_corners.corners[k];
    slopes[k].at.x.store(x), slopes[k].at.y.store(y), slopes[k].at.z.store(z), slopes[k].w.store(w);
  }
}

}  // namespace

const tets::PartsKernels kPartsKernels = {parts, pull_back};

}  // namespace temper::TEMPER_INSTRUCTION_SET

// The polynomials of the operators, with a small relative error whatever cancels in them: as src/dec/accurate.hpp.
#pragma once

#include "temper/tets/geometry.hpp"

namespace temper::tets::accurate {

/// 6 V of pqrs.
[[nodiscard]] double six_volumes(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                                 const WeightedPoint& s);
/// 4 A² of the face pqr.
[[nodiscard]] double squared_doubled_area(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
/// The polynomial whose sign is power_test: > 0 where t conflicts with the positive tetrahedron pqrs.
[[nodiscard]] double power_polynomial(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                                      const WeightedPoint& s, const WeightedPoint& t);
/// 4 h A |6 V| of the face pqr in pqrs.
[[nodiscard]] double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                                      const WeightedPoint& s);
/// 4 k ℓ A of edge pq in the face pqr.
[[nodiscard]] double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r);
/// 2 d ℓ of edge pq, from p.
[[nodiscard]] double doubled_crossing(const WeightedPoint& p, const WeightedPoint& q);

}  // namespace temper::tets::accurate

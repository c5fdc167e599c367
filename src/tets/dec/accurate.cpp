#include "tets/dec/accurate.hpp"

#include "dec/accurate.hpp"
#include "tets/geometry/evaluated.hpp"

namespace temper::tets::accurate {
namespace {

template <class Polynomial>
double evaluated(const Polynomial& polynomial) {
  return tets::evaluated(temper::accurate::kRelativeError, polynomial);
}

}  // namespace

double six_volumes(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s) {
  return evaluated([&]<class T>(const T&) { return volume_polynomial<T>(p, q, r, s); });
}

double squared_doubled_area(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return evaluated([&]<class T>(const T&) { return area_polynomial<T>(p, q, r); });
}

double power_polynomial(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r, const WeightedPoint& s,
                        const WeightedPoint& t) {
  return evaluated([&]<class T>(const T&) { return tets::power_polynomial<T>(p, q, r, s, t); });
}

double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r,
                        const WeightedPoint& s) {
  return evaluated([&]<class T>(const T&) { return height_polynomial<T>(p, q, r, s); });
}

double height_numerator(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  return evaluated([&]<class T>(const T&) { return height_polynomial<T>(p, q, r); });
}

double doubled_crossing(const WeightedPoint& p, const WeightedPoint& q) {
  return evaluated([&]<class T>(const T&) { return crossing_polynomial<T>(p, q); });
}

}  // namespace temper::tets::accurate

// A box around a Joukowski airfoil, graded from the trailing edge to the far field.
//
// The foil is the image of a circle through ζ = 1 under z = ζ + 1/ζ, which sends ζ = 1 to a cusp. Rings of points
// around the circle, their spacing growing from ring to ring, are mapped with it: the map is conformal, so that
// triangles keep their angles while their sizes shrink towards the cusp, as around a real airfoil.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/rng.hpp"
#include "generate/outline.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

using Complex = std::complex<double>;

constexpr Complex kCentre = {-0.12, 0.08};  // thickness and camber of about a tenth of the chord, which is about 4
constexpr double kHalfBox = 10;             // two and a half chords to each side
constexpr double kRowHeight = 0.8660254037844386;  // of a row of equilateral triangles
constexpr double kJitter = 0.15;                   // of the spacing: enough to break the symmetry of rings
constexpr double kBoxGap = 0.6;                    // of the spacing: what inner points keep from the box
constexpr double kCornerRoom = 0.5;                // of the spacing: no second point that near to a corner's own
constexpr double kMostPoints = 2e7;                // of the rings, about around / (growth − 1)
constexpr int kFewestAround = 16;                  // points on the widest rings

Vec2 joukowski(Complex zeta) {
  const Complex z = zeta + 1.0 / zeta;
  return {z.real(), z.imag()};
}

}  // namespace

Expected<Mesh> airfoil(const Airfoil& shape) {
  if (shape.around < 16 || shape.around > 1'000'000) {
    return generate::invalid("an airfoil needs 16 to 1,000,000 points around, not " + std::to_string(shape.around));
  }
  if (!(shape.growth >= 1.02 && shape.growth <= 2)) {
    return generate::invalid("the growth of an airfoil mesh is between 1.02 and 2");
  }
  if (shape.around / (shape.growth - 1) > kMostPoints) {
    return generate::invalid("an airfoil mesh of that many points and so little growth is out of reach");
  }
  Rng rng(shape.seed);
  const double radius = std::abs(1.0 - kCentre), start = std::arg(1.0 - kCentre);
  std::vector<Vec2> foil;
  for (int i = 0; i < shape.around; ++i) {
    // The first point is the cusp itself: exactly (2, 0).
    const double angle = start + 2 * std::numbers::pi * i / shape.around;
    foil.push_back(i == 0 ? Vec2{2, 0} : joukowski(kCentre + std::polar(radius, angle)));
  }
  std::vector<Vec2> inner;
  double spacing = 2 * std::numbers::pi * radius / shape.around;
  for (double at = radius + kRowHeight * spacing; at < std::numbers::sqrt2 * kHalfBox; at += kRowHeight * spacing) {
    spacing = std::min(spacing * shape.growth, 2 * std::numbers::pi * at / kFewestAround);
    const int n = static_cast<int>(std::round(2 * std::numbers::pi * at / spacing));
    const double phase = rng.uniform(), limit = kHalfBox - kBoxGap * spacing;
    for (int i = 0; i < n; ++i) {
      const double outwards = kJitter * spacing * rng.uniform(-1, 1);
      const double angle = start + 2 * std::numbers::pi * (i + phase + kJitter * rng.uniform(-1, 1)) / n;
      const Vec2 p = joukowski(kCentre + std::polar(at + outwards, angle));
      if (std::abs(p.x) < limit && std::abs(p.y) < limit) inner.push_back(p);
    }
  }
  const Polygon box = {{-kHalfBox, -kHalfBox}, {kHalfBox, -kHalfBox}, {kHalfBox, kHalfBox}, {-kHalfBox, kHalfBox}};
  generate::Outline outline;
  outline.add_loop(foil);
  outline.add_loop(generate::divide_sides(box, spacing));
  for (const Vec2 corner : generate::corner_points(box, std::numbers::sqrt2 * kBoxGap * spacing)) {
    const bool lonely = std::none_of(inner.begin(), inner.end(), [&](Vec2 p) {
      return squared_length(p - corner) < kCornerRoom * kCornerRoom * spacing * spacing;
    });
    if (lonely) outline.points.push_back(corner);
  }
  outline.points.insert(outline.points.end(), inner.begin(), inner.end());
  return outline.triangulate();
}

}  // namespace temper

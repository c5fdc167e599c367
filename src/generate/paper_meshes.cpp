// The meshes of the paper: a single triangle (§3.1.2), the sparse (§6.4) and the parameterized horseshoe (§6.5).
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/rng.hpp"
#include "generate/outline.hpp"
#include "temper/generate.hpp"

namespace temper {
namespace {

using generate::invalid;

bool is_positive(double x) { return std::isfinite(x) && x > 0; }

/// cos and sin of π i / n, exactly symmetric about i = n/2, exact at both ends and in the middle. The example means a
/// level foot and an axis at 0, but cos(π/2) is 6e-17 in doubles.
Vec2 half_turn(int i, int n) {
  if (2 * i == n) return {0, 1};
  const int folded = 2 * i < n ? i : n - i;
  const double angle = std::numbers::pi * folded / n;
  const double cosine = folded == 0 ? 1 : std::cos(angle), sine = folded == 0 ? 0 : std::sin(angle);
  return {folded == i ? cosine : -cosine, sine};
}

}  // namespace

Mesh sparse_horseshoe() {
  constexpr std::array<Vec2, 5> kPoints = {{{-2, 0}, {0, 2}, {2, 0}, {0, 4}, {0, 3}}};
  constexpr std::array<std::array<std::int32_t, 3>, 4> kTriangles = {{{0, 1, 4}, {1, 2, 4}, {4, 2, 3}, {4, 3, 0}}};
  MeshInput input;
  input.points = kPoints;
  input.triangles = kTriangles;
  return Mesh::build(input)->mesh;
}

Expected<Mesh> horseshoe(const Horseshoe& shape) {
  if (shape.a < 3 || shape.b < 2) {
    return invalid("a horseshoe needs a ≥ 3 and b ≥ 2, not " + std::to_string(shape.a) + " and " +
                   std::to_string(shape.b));
  }
  if (!is_positive(shape.x[0]) || !is_positive(shape.y[0]) || !is_positive(shape.x[1] - shape.x[0]) ||
      !is_positive(shape.y[1] - shape.y[0])) {
    return invalid("a horseshoe needs 0 < x0 < x1 and 0 < y0 < y1");
  }
  generate::Outline outline;
  const auto number = [&](int i, int j) { return i * shape.b + j; };  // i-th value of a, j-th of b
  for (int i = 0; i < shape.a; ++i) {
    const Vec2 direction = half_turn(shape.a - 1 - i, shape.a - 1);
    for (int j = 0; j < shape.b; ++j) {
      const double b = static_cast<double>(j) / (shape.b - 1);
      outline.points.push_back({((1 - b) * shape.x[0] + b * shape.x[1]) * direction.x,
                                ((1 - b) * shape.y[0] + b * shape.y[1]) * direction.y});
    }
  }
  for (int i = 0; i + 1 < shape.a; ++i) {
    outline.segments.push_back({number(i, 0), number(i + 1, 0)});
    outline.segments.push_back({number(i, shape.b - 1), number(i + 1, shape.b - 1)});
  }
  for (int j = 0; j + 1 < shape.b; ++j) {
    outline.segments.push_back({number(0, j), number(0, j + 1)});
    outline.segments.push_back({number(shape.a - 1, j), number(shape.a - 1, j + 1)});
  }
  return outline.triangulate();
}

Expected<Mesh> single_triangle(const SingleTriangle& shape) {
  if (!is_positive(shape.a) || !is_positive(shape.b) || !(shape.angle_deg > 0 && shape.angle_deg < 180)) {
    return invalid("a triangle needs sides a, b > 0 and an angle between 0 and 180 degrees");
  }
  const double angle = shape.angle_deg * std::numbers::pi / 180;
  const std::array<Vec2, 3> points = {{{0, 0}, {shape.a, 0}, {shape.b * std::cos(angle), shape.b * std::sin(angle)}}};
  constexpr std::array<std::array<std::int32_t, 3>, 1> kTriangles = {{{0, 1, 2}}};
  MeshInput input;
  input.points = points;
  input.triangles = kTriangles;
  auto built = Mesh::build(input);
  if (!built) return built.error();
  return std::move(built->mesh);
}

// A box around a Joukowski airfoil, graded from the trailing edge to the far field.
//
// The foil is the image of a circle through ζ = 1 under z = ζ + 1/ζ, which sends ζ = 1 to a cusp. Rings of points
// around the circle, whose spacing grows from ring to ring, are mapped with it. The map is conformal: triangles keep
// their angles while their sizes shrink towards the cusp, as around a real airfoil.

namespace {

using Complex = std::complex<double>;

constexpr Complex kCenter = {-0.12, 0.08};  // thickness and camber of about a tenth of the chord, which is about 4
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

// The circle that becomes the foil, and the angle of the cusp on it.
const double kRadius = std::abs(1.0 - kCenter), kStart = std::arg(1.0 - kCenter);

std::vector<Vec2> foil_points(int n) {
  std::vector<Vec2> foil;
  for (int i = 0; i < n; ++i) {
    // The first point is the cusp itself: exactly (2, 0).
    const double angle = kStart + 2 * std::numbers::pi * i / n;
    foil.push_back(i == 0 ? Vec2{2, 0} : joukowski(kCenter + std::polar(kRadius, angle)));
  }
  return foil;
}

/// Points between the foil and the box, and the spacing of the widest ring.
struct Rings {
  std::vector<Vec2> points;
  double spacing = 0;
};

Rings rings_around(const Airfoil& shape) {
  Rng rng(shape.seed);
  Rings rings;
  double spacing = 2 * std::numbers::pi * kRadius / shape.around;
  for (double at = kRadius + kRowHeight * spacing; at < std::numbers::sqrt2 * kHalfBox; at += kRowHeight * spacing) {
    spacing = std::min(spacing * shape.growth, 2 * std::numbers::pi * at / kFewestAround);
    const int n = static_cast<int>(std::round(2 * std::numbers::pi * at / spacing));
    const double phase = rng.uniform(), limit = kHalfBox - kBoxGap * spacing;
    for (int i = 0; i < n; ++i) {
      const double outwards = kJitter * spacing * rng.uniform(-1, 1);
      const double angle = kStart + 2 * std::numbers::pi * (i + phase + kJitter * rng.uniform(-1, 1)) / n;
      const Vec2 p = joukowski(kCenter + std::polar(at + outwards, angle));
      if (std::abs(p.x) < limit && std::abs(p.y) < limit) rings.points.push_back(p);
    }
  }
  rings.spacing = spacing;
  return rings;
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
  const std::vector<Vec2> foil = foil_points(shape.around);
  const Rings rings = rings_around(shape);
  const std::vector<Vec2>& inner = rings.points;
  const double spacing = rings.spacing;
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

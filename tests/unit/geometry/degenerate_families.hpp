// Quadruples of weighted points on which predicates go wrong: exact ties, ties missed by one unit in the last
// place, and extreme scales. A family is a name and a function from random bits to four points.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "temper/detail/vec.hpp"

namespace temper::testing {

using Random = std::mt19937_64;
using Quad = std::array<WeightedPoint, 4>;

struct Family {
  const char* name;
  Quad (*draw)(Random&);
};

/// An integer in −n … n.
inline int integer(Random& random, int n) {
  return static_cast<int>(random() % static_cast<std::uint64_t>(2 * n + 1)) - n;
}
/// A double in (−1, 1) with all 53 bits in use.
inline double real(Random& random) { return static_cast<double>(static_cast<std::int64_t>(random()) >> 10) * 0x1p-53; }

/// One unit in the last place up or down, or none. Zero, whose neighbors are out of range, moves by 2^-200.
inline double nudge(Random& random, double x) {
  const int direction = integer(random, 1);
  if (direction == 0) return x;
  return x == 0 ? direction * 0x1p-200 : std::nextafter(x, direction * std::numeric_limits<double>::infinity());
}

template <class Draw>
Quad four(Random& random, Draw draw) {
  Quad quad;
  for (WeightedPoint& p : quad) p = draw(random);
  return quad;
}

/// Twelve lattice points on one circle of radius 25 around the origin.
inline WeightedPoint on_lattice_circle(Random& random) {
  constexpr std::array<std::array<int, 2>, 5> kPoints = {{{25, 0}, {24, 7}, {20, 15}, {15, 20}, {7, 24}}};
  const auto& p = kPoints[random() % kPoints.size()];
  const double sx = random() % 2 == 0 ? 1 : -1;
  const double sy = random() % 2 == 0 ? 1 : -1;
  return {sx * p[0], sy * p[1], 0};
}

/// Four points of the lattice circle times a power of two, nonzero coordinates nudged.
inline Quad scaled_circle(Random& random, double scale) {
  return four(random, [&](Random& r) -> WeightedPoint {
    const WeightedPoint p = on_lattice_circle(r);
    return {p.x == 0 ? 0 : scale * nudge(r, p.x), p.y == 0 ? 0 : scale * nudge(r, p.y), scale * scale * nudge(r, 1)};
  });
}

/// Lattice points with weights x² + y² + (a plane): all four cocircular in the power sense.
inline Quad lifted_to_plane(Random& random, int size) {
  const int a = integer(random, 9), b = integer(random, 9), c = integer(random, 9);
  return four(random, [&](Random& r) -> WeightedPoint {
    const double x = integer(r, size), y = integer(r, size);
    return {x, y, x * x + y * y + a * x + b * y + c};
  });
}

/// Random points, the last one moved in weight onto the power circle of the others, as well as doubles can.
inline Quad nearly_power_cocircular(Random& random, double offset) {
  Quad q = four(random, [&](Random& r) -> WeightedPoint {
    return {offset + real(r), offset + real(r), 0.3 * real(r)};
  });
  const Vec2 a = q[1].position() - q[0].position();
  const Vec2 b = q[2].position() - q[0].position();
  const Vec2 d = q[3].position() - q[0].position();
  const double along_a = squared_length(a) + q[0].w - q[1].w;
  const double along_b = squared_length(b) + q[0].w - q[2].w;
  const Vec2 o = (0.5 / cross(a, b)) * Vec2{along_a * b.y - along_b * a.y, along_b * a.x - along_a * b.x};
  q[3].w = nudge(random, squared_length(d - o) - squared_length(o) + q[0].w);
  return q;
}

/// Random points, with weights that bring the orthocenter of the first three to the first, as well as doubles can.
inline Quad nearly_centered_at_a_corner(Random& random) {
  Quad q = four(random, [](Random& r) -> WeightedPoint { return {real(r), real(r), 0.3 * real(r)}; });
  for (const int i : {1, 2}) {
    q[i].w = nudge(random, q[0].w + squared_length(q[i].position() - q[0].position()));
  }
  return q;
}

inline const std::vector<Family>& degenerate_families() {
  static const std::vector<Family> families = {
      {"small lattice",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint { return {1.0 * integer(s, 2), 1.0 * integer(s, 2), 0}; });
       }},
      {"small lattice with integer weights",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           return {1.0 * integer(s, 2), 1.0 * integer(s, 2), 1.0 * integer(s, 2)};
         });
       }},
      {"decimal lattice",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           return {0.1 * integer(s, 5), 0.1 * integer(s, 5), 0.01 * integer(s, 1)};
         });
       }},
      {"nudged lattice",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           return {nudge(s, integer(s, 2)), nudge(s, integer(s, 2)), 0};
         });
       }},
      {"lattice circle", [](Random& r) { return four(r, on_lattice_circle); }},
      {"nudged lattice circle",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           const WeightedPoint p = on_lattice_circle(s);
           return {nudge(s, p.x), nudge(s, p.y), 0};
         });
       }},
      {"nudged circle at offset 1e6",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           const WeightedPoint p = on_lattice_circle(s);
           return {nudge(s, 1e6 + p.x), nudge(s, 1e6 - p.y), nudge(s, 0.1)};
         });
       }},
      {"lattice circle at offset 1e15",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           const WeightedPoint p = on_lattice_circle(s);
           return {nudge(s, 1e15 + p.x), 1e15 + p.y, 1.0 * integer(s, 1)};
         });
       }},
      {"rounded circle",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           const double angle = 4 * real(s);
           return {1.0 / 3 + std::cos(angle), 1.0 / 7 + std::sin(angle), 0.1};
         });
       }},
      {"collinear",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           const int t = integer(s, 9);
           return {7.0 + 3 * t, -2.0 + 5 * t, 1.0 * integer(s, 3)};
         });
       }},
      {"nearly collinear",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           const double t = real(s);
           return {nudge(s, t), nudge(s, t), 0.1 * integer(s, 1)};
         });
       }},
      {"line y = 0.1 x at offset 12",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           const double t = 12 + 0x1p-50 * integer(s, 40);
           return {t, nudge(s, 0.1 * t), 0};
         });
       }},
      {"needles",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           return {1.0 * integer(s, 2), 0x1p-50 * integer(s, 3), 0x1p-52 * integer(s, 2)};
         });
       }},
      {"tiny",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           return {0x1p-205 * integer(s, 3), 0x1p-205 * integer(s, 3), 0x1p-410 * integer(s, 3)};
         });
       }},
      {"huge",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           return {nudge(s, 0x1p245 * integer(s, 3)), 0x1p245 * integer(s, 3), 0x1p490 * integer(s, 3)};
         });
       }},
      {"bottom of the range", [](Random& r) { return scaled_circle(r, 0x1p-211); }},
      {"top of the range", [](Random& r) { return scaled_circle(r, 0x1p242); }},
      {"range of magnitudes",
       [](Random& r) {
         return four(r, [](Random& s) -> WeightedPoint {
           return {std::ldexp(integer(s, 1), integer(s, 60)), std::ldexp(integer(s, 1), integer(s, 60)),
                   std::ldexp(integer(s, 1), integer(s, 120))};
         });
       }},
      {"lifted to a plane", [](Random& r) { return lifted_to_plane(r, 30); }},
      {"lifted to a plane, large lattice", [](Random& r) { return lifted_to_plane(r, 1 << 24); }},
      {"nearly lifted to a plane",
       [](Random& r) {
         Quad q = lifted_to_plane(r, 1 << 24);
         for (WeightedPoint& p : q) p.w = nudge(r, p.w);
         return q;
       }},
      {"nearly centered at a corner", nearly_centered_at_a_corner},
      {"coincident points",
       [](Random& r) {
         Quad q = four(r, [](Random& s) -> WeightedPoint { return {real(s), real(s), 0.1 * integer(s, 1)}; });
         q[r() % 4] = q[r() % 4];
         q[r() % 4].w = nudge(r, 0.1);
         return q;
       }},
      {"nearly power-cocircular", [](Random& r) { return nearly_power_cocircular(r, 0); }},
      {"nearly power-cocircular at offset 1e6", [](Random& r) { return nearly_power_cocircular(r, 1e6); }},
      {"nearly right angles",
       [](Random& r) -> Quad {
         const double x = real(r), y = real(r), s = real(r), t = real(r);
         return {
             {{x, y, 0}, {nudge(r, x - s), nudge(r, y - t), 0}, {nudge(r, x + t), nudge(r, y - s), 0}, {x + s, y, 0}}};
       }},
      {"weighted midpoint near an end",
       [](Random& r) -> Quad {
         const double x = real(r), y = real(r);
         return {
             {{0, 0, 0}, {x, y, nudge(r, x * x + y * y)}, {-y, x, nudge(r, -(x * x + y * y))}, {x - y, x + y, 0.25}}};
       }},
  };
  return families;
}

}  // namespace temper::testing

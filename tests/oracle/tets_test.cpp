// Every sign of the predicates of tetrahedra, and the stars of faces, against rational arithmetic, on random points and
// on degenerate families.
//
// The oracle shares no formula with the library: it eliminates whole matrices of raw coordinates, solves for the
// orthocenter, and asks on which side of a face it is. In a face it takes barycentric coordinates.
#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/rational.hpp"
#include "support/tet_lattice.hpp"
#include "temper/tets/geometry.hpp"
#include "temper/tets/operators.hpp"
#include "unit/geometry/degenerate_families.hpp"

namespace temper::tets {
namespace {

using testing::expect_relative;
using testing::Rational;
using Matrix = std::vector<std::vector<Rational>>;
using testing::integer;
using testing::Random;
using testing::real;
using Five = std::array<WeightedPoint, 5>;

Sign sign_of(const Rational& x) { return static_cast<Sign>(sgn(x)); }

Rational determinant(Matrix m) {
  Rational result = 1;
  for (std::size_t k = 0; k < m.size(); ++k) {
    std::size_t pivot = k;
    while (pivot < m.size() && m[pivot][k] == 0) ++pivot;
    if (pivot == m.size()) return 0;
    if (pivot != k) std::swap(m[pivot], m[k]), result = -result;
    result *= m[k][k];
    for (std::size_t i = k + 1; i < m.size(); ++i) {
      const Rational factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < m.size(); ++j) m[i][j] -= factor * m[k][j];
    }
  }
  return result;
}

struct RationalPoint {
  Rational x, y, z, w;
  [[nodiscard]] Rational lift() const { return x * x + y * y + z * z - w; }
};
RationalPoint to_rational(const WeightedPoint& p) {
  return {Rational(p.x), Rational(p.y), Rational(p.z), Rational(p.w)};
}

/// Minus | x y z 1 |.
Rational volume(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r, const RationalPoint& s) {
  Matrix m;
  for (const RationalPoint* a : {&p, &q, &r, &s}) m.push_back({a->x, a->y, a->z, 1});
  return -determinant(m);
}

/// Minus | x y z x² + y² + z² − w 1 |.
Rational power(const std::array<RationalPoint, 5>& points) {
  Matrix m;
  for (const RationalPoint& a : points) m.push_back({a.x, a.y, a.z, a.lift(), 1});
  return -determinant(m);
}

Sign perturbed(std::array<RationalPoint, 5> points, const std::array<std::uint32_t, 5>& index) {
  const Rational value = power(points);
  if (value != 0) return sign_of(value);
  std::array<std::size_t, 5> order = {0, 1, 2, 3, 4};
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return index[i] < index[j]; });
  for (const std::size_t i : order) {
    auto heavier = points;
    heavier[i].w += 1;
    if (const Rational change = power(heavier); change != 0) return sign_of(change);
  }
  return Sign::zero;
}

/// The orthocenter by Cramer's rule.
RationalPoint center_of(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r,
                        const RationalPoint& s) {
  const auto row = [&](const RationalPoint& a) {
    return std::vector<Rational>{2 * (a.x - p.x), 2 * (a.y - p.y), 2 * (a.z - p.z), a.lift() - p.lift()};
  };
  const Matrix rows = {row(q), row(r), row(s)};
  const auto with = [&](std::size_t replaced) {
    Matrix m;
    for (const auto& each : rows) m.push_back({each[0], each[1], each[2]});
    for (std::size_t i = 0; replaced < 3 && i < 3; ++i) m[i][replaced] = rows[i][3];
    return determinant(m);
  };
  const Rational all = with(3);
  return {with(0) / all, with(1) / all, with(2) / all, 0};
}

/// The side of the face pqr on which the orthocenter is, positive on the side of s.
Sign height(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r, const RationalPoint& s) {
  return sign_of(volume(p, q, r, center_of(p, q, r, s)) * volume(p, q, r, s));
}

/// The barycentric coordinate of r of the orthocenter of the face, from products of its edges.
Sign face_height(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  const auto product = [&](const RationalPoint& a, const RationalPoint& b) -> Rational {
    return (a.x - p.x) * (b.x - p.x) + (a.y - p.y) * (b.y - p.y) + (a.z - p.z) * (b.z - p.z);
  };
  const Rational to_q = product(q, q) - q.w + p.w, to_r = product(r, r) - r.w + p.w;
  return sign_of(product(q, q) * to_r - product(q, r) * to_q);
}

Sign crossing(const RationalPoint& p, const RationalPoint& q) {
  const Rational x = q.x - p.x, y = q.y - p.y, z = q.z - p.z;
  return sign_of((x * x + y * y + z * z - q.w) - (-p.w));
}

bool are_collinear(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  for (const auto& [dx, dy] : {std::pair(&WeightedPoint::x, &WeightedPoint::y),
                               {&WeightedPoint::y, &WeightedPoint::z},
                               {&WeightedPoint::z, &WeightedPoint::x}}) {
    if (orient2d({p.*dx, p.*dy}, {q.*dx, q.*dy}, {r.*dx, r.*dy}) != Sign::zero) return false;
  }
  return true;
}

/// Number of predicates whose sign is not the rational one.
int wrong_signs(const Five& f, const std::array<std::uint32_t, 5>& index) {
  std::array<RationalPoint, 5> e;
  std::transform(f.begin(), f.end(), e.begin(), to_rational);
  const auto& [p, q, r, s, t] = f;
  const Sign side = orientation(p.position(), q.position(), r.position(), s.position());
  int wrong = (side != sign_of(volume(e[0], e[1], e[2], e[3]))) + (power_test(p, q, r, s, t) != sign_of(power(e))) +
              (power_test_perturbed(f, index) != perturbed(e, index)) +
              (dual_crossing_sign(p, q) != crossing(e[0], e[1]));
  if (side != Sign::zero) wrong += signed_height_sign(p, q, r, s) != height(e[0], e[1], e[2], e[3]);
  if (!are_collinear(p, q, r)) wrong += signed_height_sign(p, q, r) != face_height(e[0], e[1], e[2]);
  return wrong;
}

struct FamilyOfFive {
  const char* name;
  Five (*draw)(Random&);
};

template <class Draw>
Five five(Random& random, Draw draw) {
  Five points;
  for (WeightedPoint& p : points) p = draw(random);
  return points;
}
WeightedPoint on_cube(Random& r) { return {double(r() % 2), double(r() % 2), double(r() % 2), 0}; }
WeightedPoint scaled(const WeightedPoint& p, double s) { return {s * p.x, s * p.y, s * p.z, s * s * p.w}; }

/// Lattice points with weights x² + y² + z² + (a plane): all cospherical in the power sense.
Five lifted_to_plane(Random& random) {
  const int a = integer(random, 9), b = integer(random, 9), c = integer(random, 9);
  return five(random, [&](Random& r) -> WeightedPoint {
    const double x = integer(r, 9), y = integer(r, 9), z = integer(r, 9);
    return {x, y, z, x * x + y * y + z * z + a * x + b * y + c * z};
  });
}
/// A tetrahedron of a mesh and the point across one of its faces.
Five neighbors(const TetMesh& mesh, Random& random) {
  HalffaceId h;
  do h = HalffaceId(random() % mesh.n_halffaces());
  while (mesh.is_boundary(h));
  const auto [a, b, c] = mesh.vertices(h);
  return {mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(mesh.opposite(h)),
          mesh.point(mesh.opposite(mesh.twin(h)))};
}

Five random_points(Random& random) {
  return five(random, [](Random& r) -> WeightedPoint { return {real(r), real(r), real(r), real(r)}; });
}
/// The weight of the third point puts the orthocenter of the face onto its first edge, as well as doubles can.
Five nearly_on_an_edge(Random& random) {
  Five f = random_points(random);
  const auto& [p, q, r, s, t] = f;
  const Vec3 pq = q.position() - p.position(), pr = r.position() - p.position(), qr = r.position() - q.position();
  const double at_p = dot(pq, pr), at_q = -dot(pq, qr);
  f[2].w = dot(pr, qr) + (at_p * q.w + at_q * p.w) / (at_p + at_q);
  return f;
}
/// The weight of the second point puts the crossing onto the first.
Five nearly_at_a_vertex(Random& random) {
  Five f = random_points(random);
  f[1].w = f[0].w + squared_length(f[1].position() - f[0].position());
  return f;
}

constexpr FamilyOfFive kFamilies[] = {
    {"orthocenter of a face nearly on an edge", nearly_on_an_edge},
    {"crossing nearly at a vertex", nearly_at_a_vertex},
    {"corners of a cube", [](Random& r) { return five(r, on_cube); }},
    {"corners of a cube of tenths, off the origin",
     [](Random& r) {
       return five(r, [](Random& each) {
         const WeightedPoint p = on_cube(each);
         return WeightedPoint{0.1 + 0.1 * p.x, 0.3 + 0.1 * p.y, 0.7 + 0.1 * p.z, 0};
       });
     }},
    {"nudged cube",
     [](Random& r) {
       return five(r, [](Random& each) {
         const WeightedPoint p = on_cube(each);
         const auto move = [&](double x) { return x == 0 ? 0 : testing::nudge(each, x); };
         return WeightedPoint{move(p.x), move(p.y), move(p.z), 0};
       });
     }},
    {"cubes in six", [](Random& r) { return neighbors(test::mesh_of(test::cubes(2, test::kSixTets)), r); }},
    {"cubes in five", [](Random& r) { return neighbors(test::mesh_of(test::cubes(2, test::kFiveTets)), r); }},
    {"body-centered lattice", [](Random& r) { return neighbors(test::mesh_of(test::body_centered(2)), r); }},
    {"lifted to a plane", lifted_to_plane},
    {"huge",
     [](Random& r) {
       return five(r, [](Random& each) { return scaled({real(each), real(each), real(each), real(each)}, 0x1p124); });
     }},
    {"tiny cube", [](Random& r) { return five(r, [](Random& each) { return scaled(on_cube(each), 0x1p-117); }); }},
    {"huge and tiny",
     [](Random& r) {
       return five(r, [](Random& each) {
         const auto number = [&] { return std::ldexp(integer(each, 3), integer(each, 1) * 115); };
         return WeightedPoint{number(), number(), number(), std::ldexp(integer(each, 3), integer(each, 1) * 230)};
       });
     }},
    {"small cube far away",
     [](Random& r) {
       return five(r, [](Random& each) {
         const WeightedPoint p = scaled(on_cube(each), 0x1p-30);
         return WeightedPoint{1e3 + p.x, 1e6 + p.y, 7 + p.z, 0};
       });
     }},
    {"one plane",
     [](Random& r) {
       return five(r, [](Random& each) -> WeightedPoint { return {real(each), real(each), 0.5, real(each)}; });
     }},
};

TEST(TetOracle, NoSignIsWrongOnAnyDegenerateFamily) {
  int ties = 0;
  for (const FamilyOfFive& family : kFamilies) {
    SCOPED_TRACE(family.name);
    Random random(2);
    std::array<std::uint32_t, 5> index = {0, 1, 2, 3, 4};
    int wrong = 0;
    for (int round = 0; round < 150; ++round) {
      const Five f = family.draw(random);
      std::shuffle(index.begin(), index.end(), random);
      wrong += wrong_signs(f, index);
      ties += power_test(f[0], f[1], f[2], f[3], f[4]) == Sign::zero;
    }
    EXPECT_EQ(wrong, 0);
  }
  EXPECT_GT(ties, 500);
}

/// The normal of the face pqr, of length 2 A.
std::array<Rational, 3> normal_of(const RationalPoint& p, const RationalPoint& q, const RationalPoint& r) {
  const Rational ax = q.x - p.x, ay = q.y - p.y, az = q.z - p.z, bx = r.x - p.x, by = r.y - p.y, bz = r.z - p.z;
  return {ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx};
}

/// From the orthocenter behind to the one ahead along the normal of the face, over its area.
Rational dual_over_area(const std::array<Rational, 3>& n, const RationalPoint& behind, const RationalPoint& ahead) {
  const Rational along = n[0] * (ahead.x - behind.x) + n[1] * (ahead.y - behind.y) + n[2] * (ahead.z - behind.z);
  return 2 * along / (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

TEST(TetOracle, EveryStarOfFacesAndTetrahedraHasASmallRelativeError) {
  std::size_t compared = 0, zeros = 0, negative = 0;
  for (const FamilyOfFive& family : kFamilies) {
    SCOPED_TRACE(family.name);
    Random random(4);
    for (int round = 0; round < 60; ++round) {
      test::TetArrays arrays;
      for (const WeightedPoint& p : family.draw(random)) {
        arrays.points.push_back(p.position());
        arrays.weights.push_back(p.w);
      }
      arrays.tetrahedra = {{0, 1, 2, 3}, {0, 1, 2, 4}};
      const auto built = TetMesh::build(arrays.input());
      if (!built) continue;  // flat, or both on one side
      const TetMesh& mesh = built->mesh;
      std::array<RationalPoint, 5> e;
      for (const VertexId v : mesh.vertices()) e[v.index] = to_rational(mesh.point(v));
      const DecComplex c = dec_operators(mesh);
      const DecFace& shared = c.faces[FaceId(0)];
      ASSERT_EQ(shared.vertices, (std::array{VertexId(0), VertexId(1), VertexId(2)}));
      const bool first_is_ahead = shared.ahead == TetId(0);
      const RationalPoint a = center_of(e[0], e[1], e[2], e[3]), b = center_of(e[0], e[1], e[2], e[4]);
      const auto n = normal_of(e[0], e[1], e[2]);
      const Rational star2 = dual_over_area(n, first_is_ahead ? b : a, first_is_ahead ? a : b);
      expect_relative(c.star2[FaceId(0)], star2);
      const Rational to_plane = dual_over_area(n, first_is_ahead ? e[0] : a, first_is_ahead ? a : e[0]);
      expect_relative((first_is_ahead ? shared.ahead_height : shared.behind_height) / shared.area, to_plane);
      for (std::size_t t = 0; t < 2; ++t)
        expect_relative(c.star3[TetId(t)], 6 / abs(volume(e[0], e[1], e[2], e[3 + t])));
      ++compared, zeros += star2 == 0, negative += star2 < 0;
    }
  }
  EXPECT_GT(compared, 200U);
  EXPECT_GT(zeros, 50U);
  EXPECT_GT(negative, 10U);
}

TEST(TetOracle, NoSignIsWrongOnRandomPoints) {
  Random random(3);
  std::array<int, 3> seen = {};
  for (int round = 0; round < 600; ++round) {
    const Five f = random_points(random);
    EXPECT_EQ(wrong_signs(f, {0, 1, 2, 3, 4}), 0);
    ++seen[std::size_t(static_cast<int>(power_test(f[0], f[1], f[2], f[3], f[4])) + 1)];
  }
  EXPECT_GT(seen[0], 100);
  EXPECT_GT(seen[2], 100);
}

}  // namespace
}  // namespace temper::tets

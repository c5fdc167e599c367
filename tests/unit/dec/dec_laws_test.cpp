// Laws of the operators: exactness, sums, gauge, and what motions and relabelling do to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "property/mesh_of_random_points.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

constexpr double kRelative = 1e-12;

Mesh delaunay(std::size_t vertices, std::uint64_t seed) { return *random_mesh({.vertices = vertices, .seed = seed}); }

/// Random weights of the size of edges: many obtuse triangles, edges not crossed, edges not regular.
Mesh rough(std::uint64_t seed = 1) {
  Mesh mesh = delaunay(200, seed);
  test::Noise noise(seed);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.01 * noise());
  return mesh;
}

/// Multiples of 2⁻²⁴: moderate shifts of coordinates and weights are then exact.
Mesh dyadic(Mesh mesh) {
  const auto rounded = [](double v) { return std::round(v * 0x1p24) * 0x1p-24; };
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    mesh.set_point(v, {rounded(p.x), rounded(p.y), rounded(p.w)});
  }
  EXPECT_FALSE(mesh.validate().has_value());
  return mesh;
}

template <class Change>
Mesh changed(Mesh mesh, Change change) {
  for (const VertexId v : mesh.vertices()) mesh.set_point(v, change(mesh.point(v)));
  return mesh;
}

template <class Range>
double largest(const Range& values) {
  double result = 0;
  for (const double v : values) result = std::max(result, std::abs(v));
  return result;
}

template <class Id>
void expect_scaled(const IdVector<Id, double>& a, const IdVector<Id, double>& b, double factor) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 0u);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(factor * a[Id(i)], b[Id(i)]);
}

template <class Id>
void expect_close(const IdVector<Id, double>& a, const IdVector<Id, double>& b) {
  ASSERT_EQ(a.size(), b.size());
  const double scale = largest(a);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[Id(i)], b[Id(i)], kRelative * scale);
}

TEST(DecLaws, TheRoughMeshHasEverySign) {
  const Mesh mesh = rough();
  const DecSummary s = summarize(mesh, dec_operators(mesh));
  EXPECT_GT(s.negative_star0, 0u);
  EXPECT_GT(s.negative_star1, 0u);
  EXPECT_GT(s.negative_boundary_star1, 0u);
  EXPECT_GT(s.not_well_centered, 0u);
  EXPECT_LT(s.not_well_centered, s.triangles);
}

TEST(DecLaws, TheBoundaryOfABoundaryIsNothing) {
  const Mesh mesh = rough();
  const DecComplex c = dec_operators(mesh);
  ASSERT_EQ(c.d0.n_rows(), mesh.n_edges());
  ASSERT_EQ(c.d0.n_columns, mesh.n_vertices());
  ASSERT_EQ(c.d1.n_rows(), mesh.n_triangles());
  ASSERT_EQ(c.d1.n_columns, mesh.n_edges());
  for (std::size_t t = 0; t < c.d1.n_rows(); ++t) {
    ASSERT_EQ(c.d1.starts[t + 1] - c.d1.starts[t], 3);
    std::map<std::int32_t, int> row;  // of d1 d0
    for (std::int64_t i = c.d1.starts[t]; i < c.d1.starts[t + 1]; ++i) {
      const std::int32_t e = c.d1.columns[i];
      for (std::int64_t j = c.d0.starts[e]; j < c.d0.starts[e + 1]; ++j) {
        row[c.d0.columns[j]] += c.d1.signs[i] * c.d0.signs[j];
      }
    }
    EXPECT_EQ(row.size(), 3u);
    for (const auto& [vertex, entry] : row) EXPECT_EQ(entry, 0);
  }
}

TEST(DecLaws, EdgesAreOrientedUpwardsAndSortedAndKnowTheirTriangles) {
  const Mesh mesh = rough();
  const DecComplex c = dec_operators(mesh);
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const DecEdge& e = c.edges[EdgeId(i)];
    EXPECT_LT(e.from, e.to);
    if (i > 0) {
      const DecEdge& before = c.edges[EdgeId(i - 1)];
      EXPECT_LT(std::pair(before.from, before.to), std::pair(e.from, e.to));
    }
    EXPECT_EQ(c.d0.columns[2 * i], static_cast<std::int32_t>(e.from.index));
    EXPECT_EQ(c.d0.signs[2 * i], -1);
    EXPECT_EQ(c.d0.signs[2 * i + 1], 1);
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    const DecEdge& e = c.edges[c.edge_of_halfedge[h]];
    EXPECT_EQ(std::pair(e.from, e.to), std::minmax({mesh.origin(h), mesh.target(h)}));
    const bool upwards = mesh.origin(h) == e.from;
    EXPECT_EQ(upwards ? e.left : e.right, Mesh::triangle(h));
    EXPECT_EQ(e.is_boundary(), mesh.is_boundary(h));
    const auto begin = c.d1.columns.begin() + 3 * static_cast<std::ptrdiff_t>(Mesh::triangle(h).index);
    const auto at = std::find(begin, begin + 3, static_cast<std::int32_t>(c.edge_of_halfedge[h].index));
    ASSERT_NE(at, begin + 3);
    EXPECT_TRUE(std::is_sorted(begin, begin + 3));
    EXPECT_EQ(c.d1.signs[static_cast<std::size_t>(at - c.d1.columns.begin())], upwards ? 1 : -1);
  }
}

TEST(DecLaws, WithoutWeightsStarOneIsTheCotangentFormula) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Mesh mesh = delaunay(400, seed);
    const DecComplex c = dec_operators(mesh);
    IdVector<EdgeId, double> cotangents(c.edges.size(), 0.0), size(c.edges.size(), 1.0);
    for (const HalfedgeId h : mesh.halfedges()) {
      const Vec2 p = mesh.position(mesh.opposite(h));
      const Vec2 a = mesh.position(mesh.origin(h)) - p, b = mesh.position(mesh.target(h)) - p;
      const double cotangent = dot(a, b) / cross(a, b);
      cotangents[c.edge_of_halfedge[h]] += 0.5 * cotangent;
      size[c.edge_of_halfedge[h]] += std::abs(cotangent);
    }
    for (std::size_t i = 0; i < c.edges.size(); ++i) {
      const EdgeId e(i);
      EXPECT_NEAR(c.star1[e], cotangents[e], kRelative * size[e]);
    }
  }
}

TEST(DecLaws, StarZeroSumsToTheAreaOfTheDomainWhateverTheWeights) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Mesh mesh = rough(seed);
    const DecComplex c = dec_operators(mesh);
    const double area = test::area(mesh);
    EXPECT_NEAR(std::accumulate(c.star0.begin(), c.star0.end(), 0.0), area, kRelative * area);
    EXPECT_NEAR(summarize(mesh, c).area, area, kRelative * area);
  }
}

TEST(DecLaws, LinearFunctionsAreHarmonicWhateverTheWeights) {
  const Mesh mesh = rough();
  const DecComplex c = dec_operators(mesh);
  const auto u = [&](VertexId v) { return 3 * mesh.position(v).x - 2 * mesh.position(v).y + 5; };
  IdVector<VertexId, double> laplacian(mesh.n_vertices(), 0.0), size(mesh.n_vertices(), 0.0);
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const DecEdge& e = c.edges[EdgeId(i)];
    const double transmissibility = c.star1[EdgeId(i)] * (u(e.to) - u(e.from));
    laplacian[e.from] -= transmissibility, laplacian[e.to] += transmissibility;
    size[e.from] += std::abs(transmissibility), size[e.to] += std::abs(transmissibility);
  }
  std::size_t inner = 0;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    ++inner;
    EXPECT_NEAR(laplacian[v], 0, kRelative * size[v]);
  }
  EXPECT_GT(inner, 50u);
}

// --- with a coefficient -----------------------------------------------------------------------------------------

/// Rows of a lattice below and above a straight line of edges, with a coefficient for each side.
struct Layered {
  Mesh mesh;
  double line;
  std::vector<double> coefficient;
};
Layered layered(double below, double above) {
  Layered made = {test::lattice({.n = 9, .jitter = 0, .weight = 0.3}), 4 * std::sqrt(0.75), {}};
  test::Noise noise(3);
  for (const VertexId v : made.mesh.vertices()) {
    const WeightedPoint p = made.mesh.point(v);
    if (!made.mesh.is_boundary(v) && p.y != made.line)
      made.mesh.set_point(v, {p.x + 0.2 * noise(), p.y + 0.2 * noise(), p.w});
  }
  EXPECT_FALSE(made.mesh.validate().has_value());
  for (const TriangleId t : made.mesh.triangles()) {
    double y = 0;
    for (const VertexId v : made.mesh.corners(t)) y += made.mesh.position(v).y / 3;
    made.coefficient.push_back(y < made.line ? below : above);
  }
  return made;
}

TEST(DecLaws, AConstantCoefficientIsAFactor) {
  const Mesh mesh = rough();
  const DecComplex plain = dec_operators(mesh);
  const std::vector<double> four(mesh.n_triangles(), 4.0);  // a power of two: exact
  const DecComplex c = *with_coefficient(mesh, plain, four);
  expect_close(c.star0, plain.star0);
  for (std::size_t i = 0; i < plain.edges.size(); ++i) {
    const EdgeId e(i);
    EXPECT_NEAR(c.star1[e], 4 * plain.star1[e], kRelative * std::abs(c.star1[e]));
    EXPECT_NEAR(c.transmissibility[e], 4 * plain.transmissibility[e], kRelative * std::abs(c.transmissibility[e]));
  }
  for (const VertexId v : mesh.vertices()) EXPECT_NEAR(c.capacity[v], 4 * plain.star0[v], kRelative);
}

// u = x + (y − y₀) q / K has the flux q across the line on both sides, and the slope 1 along it.
TEST(DecLaws, FluxesAreExactAcrossAStraightLineBetweenTwoCoefficients) {
  constexpr double kFlux = 3;
  const Layered m = layered(0.01, 7);
  const DecComplex c = *with_coefficient(m.mesh, dec_operators(m.mesh), m.coefficient);
  const auto u = [&](Vec2 p, double k) { return p.x + (p.y - m.line) * kFlux / k; };
  const auto at_vertex = [&](VertexId v) {
    const Vec2 p = m.mesh.position(v);
    return u(p, p.y < m.line ? 0.01 : 7);
  };
  IdVector<VertexId, double> residual(m.mesh.n_vertices(), 0.0);
  std::size_t on_line = 0;
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const DecEdge& e = c.edges[EdgeId(i)];
    const double along = c.star1[EdgeId(i)] * (at_vertex(e.to) - at_vertex(e.from));
    residual[e.from] -= along, residual[e.to] += along;
    if (e.is_boundary()) continue;
    const double left = c.coefficient[e.left], right = c.coefficient[e.right];
    const double across =
        c.transmissibility[EdgeId(i)] * (u(c.orthocenters[e.left], left) - u(c.orthocenters[e.right], right));
    // From right to left, along the normal on the left of the edge.
    const Vec2 edge = m.mesh.position(e.to) - m.mesh.position(e.from);
    const double expected = left != right ? kFlux * edge.x : left * dot(Vec2{1, kFlux / left}, Vec2{-edge.y, edge.x});
    EXPECT_NEAR(across, expected, 1e-9) << i;
    on_line += left != right ? 1 : 0;
  }
  EXPECT_EQ(on_line, 8u);
  for (const VertexId v : m.mesh.vertices()) {
    if (m.mesh.is_boundary(v)) continue;
    EXPECT_NEAR(residual[v], 0, 1e-9);
  }
  double sum = 0, expected = 0;
  for (const VertexId v : m.mesh.vertices()) sum += c.capacity[v];
  for (const TriangleId t : m.mesh.triangles()) expected += c.coefficient[t] * c.areas[t];
  EXPECT_NEAR(sum, expected, kRelative * expected);
}

TEST(DecLaws, ACoefficientIsOneFiniteNumberAboveZeroForEachTriangle) {
  const Mesh mesh = rough();
  std::vector<double> k(mesh.n_triangles(), 1.0);
  k[3] = 0;
  const auto zero = with_coefficient(mesh, dec_operators(mesh), k);
  ASSERT_FALSE(zero);
  EXPECT_EQ(zero.error().message, "triangle 3 has the coefficient 0; expected a finite number above 0");
  k.pop_back();
  EXPECT_FALSE(with_coefficient(mesh, dec_operators(mesh), k));
}

TEST(DecLaws, DualVerticesHaveEqualPowerAndDualEdgesAreWhatLiesBetweenThem) {
  const Mesh mesh = rough();
  const DecComplex c = dec_operators(mesh);
  const auto power = [&](Vec2 x, VertexId v) { return squared_length(x - mesh.position(v)) - mesh.weight(v); };
  for (const TriangleId t : mesh.triangles()) {
    const auto [i, j, k] = mesh.corners(t);
    const Vec2 o = c.orthocenters[t];
    const double size = squared_length(o - mesh.position(i)) + squared_length(o);
    EXPECT_NEAR(power(o, i), power(o, j), kRelative * size);
    EXPECT_NEAR(power(o, i), power(o, k), kRelative * size);
    EXPECT_NEAR(c.star2[t] * c.areas[t], 1, kRelative);
  }
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const DecEdge& e = c.edges[EdgeId(i)];
    EXPECT_NEAR(power(e.midpoint, e.from), power(e.midpoint, e.to), kRelative);
    const Vec2 p = mesh.position(e.from);
    const Vec2 along = (1 / e.length) * (mesh.position(e.to) - p), across = {-along.y, along.x};
    EXPECT_NEAR(dot(e.midpoint - p, along), e.crossing, kRelative);
    EXPECT_NEAR(cross(along, e.midpoint - p), 0, kRelative);
    const double left = e.left.valid() ? dot(c.orthocenters[e.left] - e.midpoint, across) : 0;
    const double right = e.right.valid() ? dot(c.orthocenters[e.right] - e.midpoint, across) : 0;
    const double size = 1 + std::abs(left) + std::abs(right);
    EXPECT_NEAR(e.left_height, left, 1e-10 * size) << "orthocenters of flat triangles lose digits";
    EXPECT_NEAR(e.right_height, -right, 1e-10 * size);
    EXPECT_NEAR(e.dual_length, e.left_height + e.right_height, kRelative * size);
    EXPECT_NEAR(c.star1[EdgeId(i)] * e.length, e.dual_length, kRelative * size);
    EXPECT_NEAR(c.transmissibility[EdgeId(i)] * c.star1[EdgeId(i)], 1, kRelative);
  }
}

TEST(DecLaws, SignsAreThoseOfTheExactPredicates) {
  Rng rng(7);
  std::size_t zeros = 0, negative = 0;
  for (int round = 0; round < 20; ++round) {
    Mesh mesh = test::mesh_of_random_points(rng, 40, 6);  // on a lattice: ties everywhere
    if (round % 4 > 1) {
      for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.125 * rng.below(3));
    }
    if (round % 2 == 0) restore_regularity(mesh);
    const DecComplex c = dec_operators(mesh);
    for (const HalfedgeId h : mesh.halfedges()) {
      const double star1 = c.star1[c.edge_of_halfedge[h]];
      const WeightedPoint p = mesh.point(mesh.origin(h)), q = mesh.point(mesh.target(h));
      const WeightedPoint r = mesh.point(mesh.opposite(h));
      const Sign found = star1 > 0 ? Sign::positive : star1 < 0 ? Sign::negative : Sign::zero;
      const Sign expected = mesh.is_boundary(h) ? signed_height_sign(p, q, r)
                                                : -power_test(p, q, r, mesh.point(mesh.opposite(mesh.twin(h))));
      EXPECT_EQ(found, expected);
      zeros += found == Sign::zero ? 1 : 0;
      negative += found == Sign::negative ? 1 : 0;
    }
  }
  EXPECT_GT(zeros, 40u);
  EXPECT_GT(negative, 100u);
}

// --- gauge and motions --------------------------------------------------------------------------------------

TEST(DecLaws, AConstantAddedToAllWeightsChangesNothing) {
  const Mesh mesh = dyadic(rough());
  const DecComplex a = dec_operators(mesh);
  const DecComplex b = dec_operators(changed(mesh, [](WeightedPoint p) { return WeightedPoint{p.x, p.y, p.w + 4}; }));
  expect_scaled(a.star0, b.star0, 1);
  expect_scaled(a.star1, b.star1, 1);
  expect_scaled(a.star2, b.star2, 1);
  expect_scaled(a.transmissibility, b.transmissibility, 1);
  EXPECT_EQ(a.orthocenters, b.orthocenters);
}

TEST(DecLaws, ALinearFunctionAddedToAllWeightsShiftsTheDualAndKeepsInnerDualEdges) {
  const Mesh mesh = dyadic(rough());
  const Vec2 slope = {0.25, -0.125};
  const DecComplex a = dec_operators(mesh);
  const DecComplex b = dec_operators(changed(mesh, [&](WeightedPoint p) {
    return WeightedPoint{p.x, p.y, p.w + dot(slope, p.position())};
  }));
  const double scale = largest(a.star1);
  std::size_t changed_on_boundary = 0;
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    const EdgeId e(i);
    const double difference = std::abs(a.star1[e] - b.star1[e]);
    if (a.edges[e].is_boundary()) {
      changed_on_boundary += difference > 1e-3 ? 1 : 0;
    } else {
      EXPECT_LE(difference, kRelative * std::max(1.0, std::abs(a.star1[e])));
    }
  }
  EXPECT_GT(changed_on_boundary, 0u) << "only a constant keeps boundary duals";
  expect_scaled(a.star2, b.star2, 1);
  for (const TriangleId t : mesh.triangles()) {
    const Vec2 shift = b.orthocenters[t] - a.orthocenters[t];
    EXPECT_NEAR(length(shift + 0.5 * slope), 0, kRelative * (1 + squared_length(a.orthocenters[t]) + scale));
  }
  EXPECT_NEAR(std::accumulate(b.star0.begin(), b.star0.end(), 0.0), test::area(mesh), kRelative * 10);
}

TEST(DecLaws, UnitsOfLengthScaleStars) {
  const Mesh mesh = rough();
  const DecComplex a = dec_operators(mesh);
  const DecComplex b = dec_operators(changed(mesh, [](WeightedPoint p) {
    return WeightedPoint{8 * p.x, 8 * p.y, 64 * p.w};
  }));
  expect_scaled(a.star0, b.star0, 64);
  expect_scaled(a.star1, b.star1, 1);
  expect_scaled(a.star2, b.star2, 1.0 / 64);
  expect_scaled(a.transmissibility, b.transmissibility, 1);
}

TEST(DecLaws, TurningAndShiftingTheDomainKeepsStars) {
  const Mesh mesh = dyadic(rough());
  const DecComplex a = dec_operators(mesh);
  const DecComplex b = dec_operators(changed(mesh, [](WeightedPoint p) {
    return WeightedPoint{16 - p.y, p.x + 4, p.w};
  }));
  expect_close(a.star0, b.star0);
  expect_close(a.star1, b.star1);
  expect_close(a.star2, b.star2);
}

TEST(DecLaws, AnotherOrderOfVerticesAndTrianglesPermutesStars) {
  const Mesh mesh = rough();
  const std::size_t n = mesh.n_vertices(), m = mesh.n_triangles();
  std::vector<std::size_t> to(n);  // old vertex → new
  std::iota(to.begin(), to.end(), std::size_t{0});
  Rng rng(3);
  for (std::size_t i = n; i-- > 1;) std::swap(to[i], to[rng.below(static_cast<std::uint32_t>(i + 1))]);
  std::vector<Vec2> points(n);
  std::vector<double> weights(n);
  for (const VertexId v : mesh.vertices()) {
    points[to[v.index]] = mesh.position(v);
    weights[to[v.index]] = mesh.weight(v);
  }
  std::vector<std::array<std::int32_t, 3>> triangles(m);
  for (const TriangleId t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      triangles[m - 1 - t.index][k] = static_cast<std::int32_t>(to[mesh.corners(t)[(k + 1) % 3].index]);
    }
  }
  const auto built = Mesh::build({.points = points, .weights = weights, .triangles = triangles});
  ASSERT_TRUE(built);
  const DecComplex a = dec_operators(mesh), b = dec_operators(built->mesh);
  std::map<std::pair<std::size_t, std::size_t>, double> star1;
  for (std::size_t i = 0; i < b.edges.size(); ++i) {
    star1[{b.edges[EdgeId(i)].from.index, b.edges[EdgeId(i)].to.index}] = b.star1[EdgeId(i)];
  }
  ASSERT_EQ(star1.size(), a.edges.size());
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    const DecEdge& e = a.edges[EdgeId(i)];
    const auto key = std::minmax({to[e.from.index], to[e.to.index]});
    ASSERT_TRUE(star1.contains(key));
    EXPECT_NEAR(star1[key], a.star1[EdgeId(i)], kRelative * std::max(1.0, std::abs(a.star1[EdgeId(i)])));
  }
  for (const VertexId v : mesh.vertices()) {
    EXPECT_NEAR(a.star0[v], b.star0[VertexId(to[v.index])], kRelative * largest(a.star0));
  }
}

}  // namespace
}  // namespace temper

// Laws of the report: what must not change it, what must scale, sums, and counts against a naive twin.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "base/median.hpp"
#include "quality/measure.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

using test::lattice;
using test::mesh_of;
using test::Noise;

// Sums over some hundred triangles, each with a handful of roundings.
constexpr double kRelative = 1e-11;

// A mesh with everything that can be wrong in it; coordinates and weights are multiples of 2⁻²⁴, so that
// moderate shifts are exact.
Mesh bad_mesh(int n = 12, std::uint64_t seed = 1) {
  Mesh mesh = lattice({.n = n, .jitter = 0.3, .weight = 0.3, .seed = seed});
  const auto dyadic = [](double v) { return std::round(v * 0x1p24) * 0x1p-24; };
  for (VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    mesh.set_point(v, {dyadic(p.x), dyadic(p.y), dyadic(p.w)});
  }
  EXPECT_FALSE(mesh.validate().has_value());
  return mesh;
}

template <class Change>
Mesh changed(Mesh mesh, Change change) {
  for (VertexId v : mesh.vertices()) mesh.set_point(v, change(mesh.point(v)));
  return mesh;
}

std::size_t sum(const Histogram& histogram) {
  return std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t{0});
}

void expect_close(double a, double b) {
  if (std::isfinite(a) && std::isfinite(b)) {
    EXPECT_NEAR(a, b, kRelative * std::max({1.0, std::abs(a), std::abs(b)}));
  } else {
    EXPECT_EQ(a, b);
  }
}

void expect_same_counts(const Quality& a, const Quality& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.boundary_edges, b.boundary_edges);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.inverted_triangles, b.inverted_triangles);
  EXPECT_EQ(a.non_regular_edges, b.non_regular_edges);
  EXPECT_EQ(a.negative_boundary_duals, b.negative_boundary_duals);
  EXPECT_EQ(a.orthocenters_outside, b.orthocenters_outside);
  EXPECT_EQ(a.edges_not_crossed, b.edges_not_crossed);
  EXPECT_EQ(a.well_centered_fraction, b.well_centered_fraction);
  for (const CriterionInfo& row : criteria_table())
    EXPECT_EQ(violations(a, row.criterion), violations(b, row.criterion)) << row.name;
}

void expect_same_shape(const Quality& a, const Quality& b) {
  expect_same_counts(a, b);
  expect_close(a.min_coefficient, b.min_coefficient);
  expect_close(a.min_h_over_l, b.min_h_over_l);
  expect_close(a.min_d_over_l, b.min_d_over_l);
  expect_close(a.min_angle_deg, b.min_angle_deg);
  expect_close(a.max_angle_deg, b.max_angle_deg);
  // A ratio of nearly canceled lengths: the shortest dual of these meshes is 1e-4 of an edge.
  EXPECT_NEAR(a.max_transmissibility_over_median / b.max_transmissibility_over_median, 1, 1e-9);
  EXPECT_EQ(a.histograms.angles.counts, b.histograms.angles.counts);
  EXPECT_EQ(a.histograms.h_over_l.counts, b.histograms.h_over_l.counts);
  EXPECT_EQ(a.histograms.d_over_l.counts, b.histograms.d_over_l.counts);
  ASSERT_EQ(a.worst.size(), b.worst.size());
  for (std::size_t i = 0; i < a.worst.size(); ++i) {
    expect_close(a.worst[i].h_over_l, b.worst[i].h_over_l);
    expect_close(a.worst[i].angle_deg, b.worst[i].angle_deg);
  }
}

void expect_same_energies(const Quality& a, const Quality& b, double scale = 1) {
  for (std::size_t row = 0; row < a.energy.size(); ++row) {
    const double factor = std::pow(scale, energies()[row].length_exponent);
    for (std::size_t star = 0; star < 3; ++star) {
      SCOPED_TRACE(std::string(energies()[row].name) + " star " + std::to_string(star));
      const double expected = factor * a.energy[row][star], found = b.energy[row][star];
      if (std::isfinite(expected)) {
        EXPECT_NEAR(found / expected, 1, 1e-9);
      } else {
        EXPECT_EQ(found, expected);
      }
    }
  }
}

TEST(QualityLaws, TheTestMeshHasSomethingToCount) {
  const Quality q = quality(bad_mesh());
  EXPECT_GT(q.orthocenters_outside, 0u);
  EXPECT_GT(q.non_regular_edges, 0u);
  EXPECT_GT(q.negative_boundary_duals, 0u);
  EXPECT_GT(q.edges_not_crossed, 0u);
  EXPECT_GT(q.well_centered_fraction, 0);
  EXPECT_LT(q.well_centered_fraction, 1);
}

TEST(QualityLaws, AQuarterTurnChangesNothing) {
  const Mesh mesh = bad_mesh();
  const Quality before = quality(mesh);
  const Quality after = quality(changed(mesh, [](WeightedPoint p) { return WeightedPoint{-p.y, p.x, p.w}; }));
  expect_same_shape(before, after);
  expect_same_energies(before, after);
}

TEST(QualityLaws, ATranslationChangesNothing) {
  const Mesh mesh = bad_mesh();
  const Quality before = quality(mesh);
  const Quality after = quality(changed(mesh, [](WeightedPoint p) {
    return WeightedPoint{p.x + 1024, p.y - 512, p.w};
  }));
  expect_same_shape(before, after);
  expect_same_energies(before, after);
}

TEST(QualityLaws, AWeightForAllChangesNothing) {
  const Mesh mesh = bad_mesh();
  const Quality before = quality(mesh);
  const Quality after = quality(changed(mesh, [](WeightedPoint p) { return WeightedPoint{p.x, p.y, p.w + 8}; }));
  expect_same_shape(before, after);
  expect_same_energies(before, after);
}

TEST(QualityLaws, ALinearWeightLeavesRegularityAndInteriorDuals) {
  const Mesh mesh = bad_mesh();
  const Quality before = quality(mesh);
  const Quality after = quality(changed(mesh, [](WeightedPoint p) {
    return WeightedPoint{p.x, p.y, p.w + 0.5 * p.x - 0.25 * p.y};
  }));
  EXPECT_EQ(before.non_regular_edges, after.non_regular_edges);
  EXPECT_NEAR(before.max_transmissibility_over_median / after.max_transmissibility_over_median, 1, 1e-9);
  EXPECT_NE(before.orthocenters_outside, after.orthocenters_outside) << "the orthocenters all move";
}

TEST(QualityLaws, ScalingLeavesRatiosAndMultipliesEnergies) {
  const Mesh mesh = bad_mesh();
  const QualityOptions relative = {.gamma = {0.5, LengthScale::relative}, .h0 = {40.0, LengthScale::relative}};
  const Quality before = quality(mesh, relative);
  for (const double scale : {0x1p-40, 0x1p40}) {
    const auto scaled = [&](WeightedPoint p) { return WeightedPoint{scale * p.x, scale * p.y, scale * scale * p.w}; };
    const Quality after = quality(changed(mesh, scaled), relative);
    expect_same_shape(before, after);
    expect_same_energies(before, after, scale);
  }
}

TEST(QualityLaws, BriefLeavesOutMeasuresAndChangesNone) {
  const Mesh mesh = bad_mesh();
  const Quality all = quality(mesh), none;
  std::size_t left_out_before = 0;
  for (const QualityDetail detail : {QualityDetail::brief, QualityDetail::criterion}) {
    const Quality less = quality(mesh, {.detail = detail});
    std::size_t left_out = 0;
    for (const QualityMeasure& measure : quality_measures()) {
      if (measure.of(less) == measure.of(all)) continue;
      EXPECT_EQ(measure.of(less), measure.of(none)) << measure.key;
      ++left_out;
    }
    EXPECT_GT(left_out, std::exchange(left_out_before, left_out));
    EXPECT_EQ(less.energy, none.energy);
    for (const Criterion criterion : {Criterion::well_centered, Criterion::distances, Criterion::coefficients})
      EXPECT_EQ(violations(less, criterion), violations(all, criterion));
  }
  const Quality brief = quality(mesh, {.detail = QualityDetail::brief});
  EXPECT_EQ(brief.min_edge_over_size, all.min_edge_over_size);
  EXPECT_EQ(brief.max_transmissibility_over_median, all.max_transmissibility_over_median);
  EXPECT_EQ(brief.min_h_over_l, all.min_h_over_l);
}

// The same mesh with vertices and triangles in another order, and other first corners.
Mesh relabeled(const Mesh& mesh, std::uint64_t seed) {
  Noise noise(seed);
  const auto shuffled = [&](std::size_t n) {
    std::vector<std::int32_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = n; i > 1; --i) {
      std::swap(order[i - 1], order[static_cast<std::size_t>((0.5 + 0.4999 * noise()) * static_cast<double>(i))]);
    }
    return order;
  };
  const auto new_of_old = shuffled(mesh.n_vertices());
  const auto triangle_order = shuffled(mesh.n_triangles());
  std::vector<Vec2> points(mesh.n_vertices());
  std::vector<double> weights(mesh.n_vertices());
  for (VertexId v : mesh.vertices()) {
    points[new_of_old[v.index]] = mesh.position(v);
    weights[new_of_old[v.index]] = mesh.weight(v);
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const std::int32_t t : triangle_order) {
    const auto c = mesh.corners(TriangleId(static_cast<std::size_t>(t)));
    triangles.push_back({new_of_old[c[1].index], new_of_old[c[2].index], new_of_old[c[0].index]});
  }
  return mesh_of(points, triangles, weights);
}

TEST(QualityLaws, OtherNumbersForVerticesAndTrianglesChangeNothing) {
  const Mesh mesh = bad_mesh();
  const Quality before = quality(mesh);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Quality after = quality(relabeled(mesh, seed));
    expect_same_shape(before, after);
    expect_same_energies(before, after);
    ASSERT_EQ(before.worst.size(), 5u);
    for (std::size_t i = 0; i < before.worst.size(); ++i) {
      EXPECT_NEAR(before.worst[i].at.x, after.worst[i].at.x, 1e-12);
      EXPECT_NEAR(before.worst[i].at.y, after.worst[i].at.y, 1e-12);
    }
  }
}

// Large enough to be looked at along a curve: the worst triangles have the numbers of the mesh that was given.
TEST(QualityLaws, ScatteredNumbersChangeNothingEither) {
  const Mesh scattered = *random_mesh({.vertices = 60000, .seed = 4});
  const OrderedMesh ordered = hilbert_ordered(scattered);
  Mesh in_place = scattered;
  const Quality of_scattered = quality(scattered), of_ordered = quality(ordered.mesh),
                there = quality_in_place(in_place);
  EXPECT_EQ(in_place, scattered);
  expect_same_energies(of_scattered, there);
  expect_same_shape(of_scattered, of_ordered);
  expect_same_energies(of_scattered, of_ordered);
  ASSERT_EQ(of_scattered.worst.size(), of_ordered.worst.size());
  for (std::size_t i = 0; i < of_ordered.worst.size(); ++i) {
    EXPECT_EQ(of_scattered.worst[i].triangle, there.worst[i].triangle);
    EXPECT_EQ(of_scattered.worst[i].triangle, ordered.order.triangles[of_ordered.worst[i].triangle]);
  }
}

// --- a naive twin: orthocenters by Cramer's rule, insides and powers by definition ---------------------------

struct Point {
  long double x, y;
};

Point naive_orthocenter(const std::array<WeightedPoint, 3>& p) {
  const auto lift = [](const WeightedPoint& q) -> long double {
    return static_cast<long double>(q.x) * q.x + static_cast<long double>(q.y) * q.y - q.w;
  };
  const long double ax = p[1].x - p[0].x, ay = p[1].y - p[0].y, bx = p[2].x - p[0].x, by = p[2].y - p[0].y;
  const long double a = (lift(p[1]) - lift(p[0])) / 2, b = (lift(p[2]) - lift(p[0])) / 2;
  const long double det = ax * by - ay * bx;
  return {(a * by - b * ay) / det, (ax * b - bx * a) / det};
}

long double power(const WeightedPoint& p, Point o) {
  return (p.x - o.x) * (p.x - o.x) + (p.y - o.y) * (p.y - o.y) - p.w;
}

long double left_of(const WeightedPoint& a, const WeightedPoint& b, Point o) {
  return (b.x - a.x) * (o.y - a.y) - (b.y - a.y) * (o.x - a.x);
}

bool naive_crossed(const WeightedPoint& a, const WeightedPoint& b) {
  const long double squared = static_cast<long double>(b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
  return std::abs(static_cast<long double>(a.w) - b.w) < squared;
}

Quality naive_counts(const Mesh& mesh) {
  Quality q;
  std::size_t well_centered = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (TriangleId t : mesh.triangles()) {
    const auto v = mesh.corners(t);
    const std::array<WeightedPoint, 3> p = {mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])};
    const Point o = naive_orthocenter(p);
    bool inside = true, crossed = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t n = (k + 1) % 3;
      const bool left = left_of(p[k], p[n], o) > 0;
      inside = inside && left;
      crossed = crossed && naive_crossed(p[k], p[n]);
      const HalfedgeId twin = mesh.twin(Mesh::halfedge(t, static_cast<int>(k)));
      q.boundary_edges += !twin.valid();
      q.negative_boundary_duals += !twin.valid() && !left;
      // Each interior edge is seen from both sides and not regular from both.
      const bool conflict = twin.valid() && power(mesh.point(mesh.opposite(twin)), o) < power(p[k], o);
      q.non_regular_edges += conflict && v[k] < v[n];
      const bool first = edges.insert(std::minmax(v[k].index, v[n].index)).second;
      q.edges_not_crossed += first && !naive_crossed(p[k], p[n]);
    }
    q.orthocenters_outside += !inside;
    well_centered += inside && crossed;
  }
  q.nonpositive_distances = q.non_regular_edges;  // no dual of these meshes is 0
  q.nonpositive_boundary_distances = q.negative_boundary_duals;
  q.vertices = mesh.n_vertices();
  q.triangles = mesh.n_triangles();
  q.edges = edges.size();
  q.regions = 1;
  q.well_centered_fraction = static_cast<double>(well_centered) / static_cast<double>(q.triangles);
  return q;
}

TEST(QualityLaws, CountsAgreeWithANaiveTwin) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = bad_mesh(9, seed);
    expect_same_counts(naive_counts(mesh), quality(mesh));
  }
}

TEST(QualityLaws, EulerAndTheHistogramsAddUp) {
  const Quality q = quality(bad_mesh());
  EXPECT_EQ(q.vertices + q.triangles, q.edges + 1) << "a disc";
  EXPECT_EQ(3 * q.triangles + q.boundary_edges, 2 * q.edges);
  EXPECT_EQ(sum(q.histograms.angles), 3 * q.triangles);
  EXPECT_EQ(sum(q.histograms.h_over_l), 3 * q.triangles);
  EXPECT_EQ(sum(q.histograms.d_over_l), q.edges);
  const std::size_t negative_bins = 2;  // of d/ℓ: [−0.1, 0)
  EXPECT_EQ(std::accumulate(q.histograms.d_over_l.counts.begin(), q.histograms.d_over_l.counts.begin() + negative_bins,
                            std::size_t{0}),
            q.edges_not_crossed);
}

TEST(QualityLaws, NotANumberIsOfTheFirstBinTheWorstMarginAndTheLargestRatio) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  Histogram histogram = {0, 1, std::vector<std::size_t>(2)};
  for (const double value : {nan, -nan, 0.7}) histogram.add(value);
  EXPECT_EQ(histogram.counts, (std::vector<std::size_t>{2, 1}));

  EXPECT_EQ(median_of({nan, 1, 2}), 2);
  EXPECT_EQ(median_of({nan, nan, 1}), infinity);

  WorstList<TriangleId> worst(100);
  for (std::size_t i = 0; i < 100; ++i) worst.offer({i % 3 == 0 ? nan : double(i), TriangleId(99 - i)});
  const auto sorted = worst.sorted();
  EXPECT_EQ(sorted[0].element, TriangleId(std::size_t{0}));  // number 99 was offered NaN, and so was each third before
  EXPECT_EQ(sorted[33].element, TriangleId(std::size_t{99}));
  EXPECT_EQ(sorted[34].margin, 1);
}

TEST(QualityLaws, TheWorstListIsAPrefixOfALongerOne) {
  const Mesh mesh = bad_mesh();
  const Quality all = quality(mesh, {.worst = mesh.n_triangles() + 7});
  ASSERT_EQ(all.worst.size(), mesh.n_triangles());
  double least = std::numeric_limits<double>::infinity();
  for (const WorstTriangle& w : all.worst) least = std::min(least, w.h_over_l);
  EXPECT_EQ(least, all.min_h_over_l);
  for (const std::size_t n : {0u, 1u, 7u}) {
    const Quality some = quality(mesh, {.worst = n});
    ASSERT_EQ(some.worst.size(), n);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(some.worst[i].triangle, all.worst[i].triangle);
  }
}

TEST(QualityLaws, EveryTriangleThatIsNotWellCenteredRanksBeforeAllOthers) {
  const Mesh mesh = bad_mesh();
  const Quality q = quality(mesh, {.worst = mesh.n_triangles()});
  bool good_seen = false;
  for (const WorstTriangle& w : q.worst) {
    const bool good = w.why.starts_with("well-centered");
    EXPECT_FALSE(good_seen && !good) << w.why;
    good_seen = good_seen || good;
    EXPECT_EQ(good, is_well_centered(mesh.point(w.vertices[0]), mesh.point(w.vertices[1]), mesh.point(w.vertices[2])));
  }
  EXPECT_TRUE(good_seen);
}

TEST(QualityLaws, ManyBlocksAddUpToTheWhole) {
  const Mesh mesh = lattice({.n = 100, .jitter = 0.3, .weight = 0.3});
  ASSERT_GT(mesh.n_triangles(), 2 * 8192u);
  const Quality q = quality(mesh);
  expect_same_counts(naive_counts(mesh), q);
  double min_h = 1, min_d = 1, min_angle = 180, max_angle = 0;
  for (HalfedgeId h : mesh.halfedges()) {
    const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h)),
                        c = mesh.point(mesh.opposite(h));
    const double l = length(b.position() - a.position());
    const double angle = corner_angle(c.position(), a.position(), b.position()) * 180 / std::numbers::pi;
    min_h = std::min(min_h, signed_height(a, b, c) / l);
    min_d = std::min({min_d, dual_crossing(a, b) / l, dual_crossing(b, a) / l});
    min_angle = std::min(min_angle, angle);
    max_angle = std::max(max_angle, angle);
  }
  expect_close(q.min_h_over_l, min_h);
  expect_close(q.min_d_over_l, min_d);
  expect_close(q.min_angle_deg, min_angle);
  expect_close(q.max_angle_deg, max_angle);
  EXPECT_EQ(sum(q.histograms.angles), 3 * q.triangles);
  EXPECT_EQ(sum(q.histograms.h_over_l), 3 * q.triangles);
  EXPECT_EQ(sum(q.histograms.d_over_l), q.edges);
}

// Two threads, the blocks from the last to the first.
class Backwards : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    ++walks_;
    fewest_blocks_ = std::min(fewest_blocks_, n);
    std::thread odd([&] {
      for (std::size_t i = n; i-- > 0;) {
        if (i % 2 == 1) block(i);
      }
    });
    for (std::size_t i = n; i-- > 0;) {
      if (i % 2 == 0) block(i);
    }
    odd.join();
  }
  std::size_t walks_ = 0, fewest_blocks_ = std::numeric_limits<std::size_t>::max();
};

TEST(QualityLaws, ThreadsDoNotChangeABit) {
  const Mesh mesh = lattice({.n = 140, .jitter = 0.3, .weight = 0.3});
  const Quality alone = quality(mesh);
  Backwards executor;
  const Quality together = quality(mesh, {.executor = &executor});
  EXPECT_EQ(executor.walks_, 7u)
      << "triangles; edges, counted and measured; energies; for solvers sizes, triangles and cells";
  EXPECT_GT(executor.fewest_blocks_, 1u);
  for (const QualityMeasure& measure : quality_measures()) {
    EXPECT_EQ(measure.of(alone), measure.of(together)) << measure.key;
  }
  EXPECT_EQ(alone.max_transmissibility_over_median, together.max_transmissibility_over_median);
  EXPECT_EQ(alone.energy, together.energy);
  EXPECT_EQ(alone.histograms.angles.counts, together.histograms.angles.counts);
  ASSERT_EQ(alone.worst.size(), together.worst.size());
  for (std::size_t i = 0; i < alone.worst.size(); ++i) EXPECT_EQ(alone.worst[i].why, together.worst[i].why);
}

}  // namespace
}  // namespace temper

// The space of a tensor's metric, the way there and back, pieces, and operators with tensors.
#include "temper/tets/tensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/lattice.hpp"
#include "support/tet_layers.hpp"
#include "temper/tets/operators.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"
#include "temper/tets/weights.hpp"
#include "tets/optimize/seam_slide.hpp"

namespace temper::tets {
namespace {

using test::kLower, test::kOther, test::kUpper, test::pieces_of, test::two_layers;

const Tensor3 kTensors[] = {{},
                            {1, 0, 0, 1, 0, 100},
                            {3, 1.1, 0.2, 0.9, -0.3, 2},
                            {1e-9, 2e-10, 0, 4e-9, 1e-10, 3e-9},
                            {2e12, -1e12, 3e11, 9e11, 1e10, 1e12},
                            {1, 0, 0, 9e7, 0, 5}};

Vec3 times(const Tensor3& k, Vec3 v) { return k * v; }

TEST(TetMetric, LengthsAreThoseOfTheInverseTensorAndVolumesStay) {
  test::Noise noise(3);
  for (const Tensor3& k : kTensors) {
    const auto metric = Metric::of(k);
    ASSERT_TRUE(metric) << metric.error().what();
    const Vec3 x = metric->to_metric({1, 0, 0}), y = metric->to_metric({0, 1, 0}), z = metric->to_metric({0, 0, 1});
    EXPECT_NEAR(dot(x, cross(y, z)), 1, 1e-7);
    const Tensor3 inverse = test::inverse_of(k);
    for (int i = 0; i < 20; ++i) {
      const Vec3 v = {noise(), noise(), noise()};
      const double expected = metric->strength() * dot(v, times(inverse, v));
      EXPECT_NEAR(squared_length(metric->to_metric(v)), expected, 1e-7 * expected);
      EXPECT_NEAR(length(metric->from_metric(metric->to_metric(v)) - v), 0, 1e-7 * length(v));
    }
  }
}

TEST(TetMetric, OfOneMovesNothing) {
  const auto metric = Metric::of({2, 0, 0, 2, 0, 2});
  ASSERT_TRUE(metric);
  const Vec3 p = {0.3, -7, 1e5};
  EXPECT_EQ(metric->to_metric(p), p);
  EXPECT_EQ(metric->strength(), 2);
}

TEST(TetMetric, TensorsThatAreNoneAreTold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Tensor3& k) {
    const auto made = Metric::of(k);
    return made ? "nothing" : made.error().message;
  };
  const std::string definite = "tensor: expected a positive definite tensor kxx,kxy,kxz,kyy,kyz,kzz, found ";
  EXPECT_EQ(message({1, 2, 0, 1, 0, 1}), definite + "1, 2, 0, 1, 0, 1");
  EXPECT_EQ(message({1, 0, 0, -1, 0, 1}), definite + "1, 0, 0, -1, 0, 1");
  EXPECT_EQ(message({0, 0, 0, 0, 0, 0}), definite + "0, 0, 0, 0, 0, 0");
  EXPECT_EQ(message({1, nan, 0, 1, 0, 1}), "tensor: expected finite numbers, found 1, nan, 0, 1, 0, 1");
  EXPECT_EQ(message({1, 0, 0, 1, 0, 1e9}),
            "tensor: expected eigenvalues that are at most 1e8 times each other, found 1, 0, 0, 1, 0, 1e+09");
}

TEST(TetMapped, ThereAndBackIsTheSameMeshBitForBit) {
  const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(3, test::kSixTets), 0.1, 0.2));
  for (const Tensor3& k : kTensors) {
    const auto there = mapped(mesh, *Metric::of(k));
    ASSERT_TRUE(there);
    EXPECT_FALSE(there->is_cut());
    EXPECT_FALSE(there->mesh.validate());
    EXPECT_NEAR(quality(there->mesh).volume, quality(mesh).volume, 1e-6);
    const auto back = mapped_back(*there, mesh, *there);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->mesh, mesh);
  }
}

TEST(TetMapped, TetrahedraThatTurnOverAreRefused) {
  const TetMesh mesh = test::mesh_of(test::cubes(1, test::kFiveTets));
  TetMesh flat = mesh;
  const WeightedPoint p = mesh.point(VertexId(0));
  flat.set_point(VertexId(0), {p.x + 2, p.y + 2, p.z + 2, 0});
  const MetricMesh pieces = *mapped(mesh, Metric());
  const auto turned = mapped_back(with_mesh(pieces, flat), mesh, pieces);
  ASSERT_FALSE(turned);
  EXPECT_EQ(turned.error().code, ErrorCode::zero_volume);
}

/// A mesh with tags of every kind, some of them on the plane between two layers.
TetMesh tagged_layers() {
  const TetMesh plain = two_layers(4, 0.1, 0.1);
  std::vector<Vec3> points;
  std::vector<double> weights;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  std::vector<std::int32_t> regions;
  const auto number = [](VertexId v) { return static_cast<std::int32_t>(v.index); };
  for (const VertexId v : plain.vertices()) points.push_back(plain.position(v)), weights.push_back(plain.weight(v));
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::array<std::int32_t, 2>> lines;
  for (const TetId t : plain.tetrahedra()) {
    const auto& c = plain.corners(t);
    tetrahedra.push_back({number(c[0]), number(c[1]), number(c[2]), number(c[3])});
    regions.push_back(plain.region(t));
  }
  for (const HalffaceId h : plain.halffaces()) {
    if (plain.is_boundary(h) || !plain.bounds_region(h) || h.index % 3 != 0) continue;
    const auto [a, b, c] = plain.vertices(h);
    faces.push_back({number(a), number(b), number(c)});
    lines.push_back({number(b), number(a)});
  }
  const std::vector<std::int32_t> face_tags(faces.size(), 3), line_tags(lines.size(), 4);
  const std::vector<std::int32_t> marked = {lines[0][0], 1, lines[0][1]}, point_tags = {1, 2, 3},
                                  fixed = {lines[1][0], 0};
  TetMeshInput in;
  in.points = points, in.weights = weights, in.tetrahedra = tetrahedra, in.regions = regions;
  in.faces = faces, in.face_tags = face_tags, in.lines = lines, in.line_tags = line_tags;
  in.marked_points = marked, in.point_tags = point_tags, in.fixed_points = fixed;
  return test::built(in).mesh;
}

TEST(TetPieces, AreCutWhereTheSpaceChangesAndJoinedAgainBitForBit) {
  const TetMesh mesh = tagged_layers();
  ASSERT_GT(mesh.tagged_faces().size(), 3U);
  const MetricMesh pieces = pieces_of(mesh, kLower, kOther);
  EXPECT_TRUE(pieces.is_cut());
  EXPECT_FALSE(pieces.mesh.validate());
  std::size_t seams = 0;
  for (const HalffaceId h : mesh.halffaces()) {
    if (mesh.is_boundary(h)) continue;
    seams += mesh.bounds_region(h) && mesh.is_face_representative(h) ? 1 : 0;
    EXPECT_EQ(pieces.mesh.is_boundary(h), mesh.bounds_region(h));
  }
  EXPECT_EQ(seams_of(pieces).size(), seams);
  EXPECT_EQ(seams, 32U);  // two for each of 16 squares
  EXPECT_EQ(pieces.mesh.n_vertices(), mesh.n_vertices() + 25);
  EXPECT_EQ(pieces.mesh.tagged_faces().size(), mesh.tagged_faces().size());
  EXPECT_EQ(pieces.mesh.tagged_lines().size(), mesh.tagged_lines().size());
  for (const TetId t : mesh.tetrahedra()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId v = pieces.mesh.corners(t)[k];
      EXPECT_EQ(pieces.first_copy(v), mesh.corners(t)[k]);
      EXPECT_EQ(pieces.mesh.position(v), pieces.metrics.of(t).to_metric(mesh.position(mesh.corners(t)[k])));
    }
  }
  const auto back = mapped_back(pieces, mesh, pieces);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->mesh, mesh);
  EXPECT_TRUE(back->vertices.empty());
  EXPECT_EQ(back->corner_weights.size(), mesh.n_halffaces());
  EXPECT_EQ(back->tensors, test::tensors_of(mesh, kLower, kOther));
}

TEST(TetPieces, ThatMeetAtAVertexAloneHaveCopiesOfIt) {
  // Region 1 in a cube and in the cube across a corner, region 2 around them.
  TetMesh mesh = test::mesh_of(test::cubes(2, test::kSixTets));
  for (const TetId t : mesh.tetrahedra()) {
    Vec3 middle;
    for (const VertexId v : mesh.corners(t)) middle = middle + 0.25 * mesh.position(v);
    const bool low = middle.x < 1 && middle.y < 1 && middle.z<1, high = middle.x> 1 && middle.y > 1 && middle.z > 1;
    mesh.set_region(t, low || high ? 1 : 2);
  }
  const MetricMesh pieces = pieces_of(mesh, kLower, kOther);
  EXPECT_FALSE(pieces.mesh.validate());
  const auto copies_of = [&](VertexId v) {
    return std::count_if(pieces.mesh.vertices().begin(), pieces.mesh.vertices().end(),
                         [&](VertexId u) { return pieces.first_copy(u) == v; });
  };
  EXPECT_EQ(copies_of(VertexId(13)), 3);  // the middle
  EXPECT_EQ(mapped_back(pieces, mesh, pieces)->mesh, mesh);
}

TEST(TetPieces, OfMultiplesOfOneTensorAreOne) {
  const TetMesh mesh = two_layers(2, 0, 0);
  const Tensor3 k = {1, 0.1, 0.2, 4, 0.3, 2}, multiple = {3, 0.3, 0.6, 12, 0.9, 6};
  const MetricMesh pieces = pieces_of(mesh, k, multiple);
  EXPECT_FALSE(pieces.is_cut());
  EXPECT_EQ(pieces.mesh.n_vertices(), mesh.n_vertices());
  EXPECT_EQ(mapped_back(pieces, mesh, pieces)->mesh, mesh);
  EXPECT_TRUE(Metrics::of(test::tensors_of(mesh, k, k))->is_constant());
}

TEST(TetPieces, KeepAWeightForEachCorner) {
  const TetMesh mesh = two_layers(2, 0, 0);
  const auto metrics = Metrics::of(test::tensors_of(mesh, kLower, kUpper));
  std::vector<double> weights;
  for (const TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) weights.push_back(0.01 * mesh.region(t) * v.index);
  }
  const auto pieces = mapped(mesh, *metrics, weights);
  ASSERT_TRUE(pieces);
  EXPECT_EQ(mapped_back(*pieces, mesh, *pieces)->corner_weights, weights);
  weights.pop_back();
  const auto refused = mapped(mesh, *metrics, weights);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "corner weights: expected 160 for 40 tetrahedra, found 159");
}

TEST(TetPieces, WrongTensorsAreToldWithTheirTetrahedron) {
  std::vector<Tensor3> tensors(5);
  tensors[4].xy = 2;
  const auto refused = Metrics::of(tensors);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().message.starts_with("tetrahedron 4: tensor: expected a positive definite tensor"));
}

// --- operators ------------------------------------------------------------------------------------------------------

template <class Id>
void expect_same(const IdVector<Id, double>& a, const IdVector<Id, double>& b, double relative = 1e-11) {
  ASSERT_EQ(a.size(), b.size());
  double scale = 0;
  for (const double x : a) scale = std::max(scale, std::isfinite(x) ? std::abs(x) : 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[Id(i)] == b[Id(i)]) continue;  // infinite, too
    EXPECT_NEAR(a[Id(i)], b[Id(i)], relative * scale) << i;
  }
}

DecComplex operators_of(const MetricMesh& pieces, const TetMesh& mesh) {
  return mapped_back(dec_operators(pieces.mesh), pieces, mesh);
}

TEST(TetMetricDec, ScalarTensorsAreACoefficient) {
  const TetMesh mesh = two_layers(4, 0.15, 0.3);
  std::vector<double> k;
  std::vector<Tensor3> tensors;
  for (const TetId t : mesh.tetrahedra()) {
    k.push_back(mesh.region(t) == 1 ? 2 : 7.5);
    tensors.push_back({k.back(), 0, 0, k.back(), 0, k.back()});
  }
  const MetricMesh pieces = *mapped(mesh, *Metrics::of(tensors));
  const DecComplex with_tensors = operators_of(pieces, mesh);
  const auto expected = with_coefficient(mesh, dec_operators(mesh), k);
  expect_same(with_tensors.star1, expected->star1);
  expect_same(with_tensors.transmissibility, expected->transmissibility);
  expect_same(with_tensors.star0, expected->star0);
  expect_same(with_tensors.star2, expected->star2);
  // The other way round: tensors of one, and a coefficient.
  const MetricMesh plain = *mapped(mesh, Metric());
  const auto both = with_coefficient(mesh, dec_operators(mesh), k);
  const DecComplex same = mapped_back(*both, plain, mesh);
  expect_same(same.star1, expected->star1);
  expect_same(same.capacity, expected->capacity);
}

TEST(TetMetricDec, OneTensorIsAScaledSpace) {
  // K = diag(1, 4, 16): lengths x, y, z become 4^½ x, 4^0 y, 4^−½ z, and fluxes get the factor 4.
  const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(3, test::kSixTets), 0.1, 0.2));
  TetMesh scaled = mesh;
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    scaled.set_point(v, {2 * p.x, p.y, 0.5 * p.z, p.w});
  }
  const MetricMesh pieces = *mapped(mesh, *Metric::of({1, 0, 0, 4, 0, 16}));
  const DecComplex c = operators_of(pieces, mesh), there = dec_operators(scaled);
  for (std::size_t e = 0; e < c.star1.size(); ++e)
    EXPECT_NEAR(c.star1[EdgeId(e)], 4 * there.star1[EdgeId(e)], 1e-10 * std::abs(there.star1[EdgeId(e)]) + 1e-12);
  for (const TetId t : mesh.tetrahedra()) {
    const Vec3 o = there.orthocenters[t];
    EXPECT_NEAR(length(c.orthocenters[t] - Vec3{0.5 * o.x, o.y, 2 * o.z}), 0, 1e-9 * (1 + length(o)));
  }
}

TEST(TetMetricDec, TransmissibilitiesAreTheHarmonicSumOfTheirHalves) {
  const TetMesh mesh = two_layers(4, 0.15, 0.3);
  const DecComplex c = operators_of(pieces_of(mesh, kLower, kOther), mesh);
  IdVector<FaceId, double> resistance(c.faces.size(), 0.0), transmissibility = c.transmissibility;
  for (const HalffaceId h : mesh.halffaces()) {
    auto corners = mesh.vertices(h);
    std::sort(corners.begin(), corners.end());
    const auto face =
        std::find_if(c.faces.begin(), c.faces.end(), [&](const DecFace& f) { return f.vertices == corners; });
    resistance[FaceId(static_cast<std::size_t>(face - c.faces.begin()))] += 1 / c.half_transmissibility[h];
  }
  for (std::size_t f = 0; f < c.faces.size(); ++f)
    EXPECT_NEAR(1 / transmissibility[FaceId(f)], resistance[FaceId(f)], 1e-9) << f;
}

TEST(TetMetricDec, SumsOfStar0AreTheVolumeAndConstantsHaveNoFlux) {
  const TetMesh mesh = two_layers(4, 0.15, 0.3);
  const DecComplex c = operators_of(pieces_of(mesh, kLower, kOther), mesh);
  const DecSummary s = summarize(c);
  EXPECT_NEAR(s.volume, 64, 1e-10);
  EXPECT_NEAR(s.star0_sum, 64, 1e-9);
  EXPECT_EQ(c.edges.size(), dec_operators(mesh).edges.size());
}

/// A pressure that is linear below and above z = n/2, with one value and one flux there.
struct Pressure {
  Vec3 below, above;
  double height;

  Pressure(const Tensor3& lower, const Tensor3& upper, int n) : below({0.7, -0.4, 1.3}), above(below), height(n / 2) {
    const double flux = (lower * below).z;
    above.z = (flux - upper.xz * above.x - upper.yz * above.y) / upper.zz;
  }
  [[nodiscard]] double at(Vec3 p, bool is_below) const { return dot(is_below ? below : above, p - Vec3{0, 0, height}); }
};

/// The largest difference between the pressures of two orthocenters and the exact flux over the transmissibility,
/// relative to the largest pressure.
double flux_error(const TetMesh& mesh, const DecComplex& c, const Tensor3& lower, const Tensor3& upper, int n) {
  const Pressure pressure(lower, upper, n);
  double error = 0, largest = 0;
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    const DecFace& face = c.faces[FaceId(f)];
    if (face.is_boundary()) continue;
    const auto at = [&](TetId t) { return pressure.at(c.orthocenters[t], mesh.region(t) == 1); };
    const auto [p, q, r] = face.vertices;
    const Vec3 normal = 0.5 * cross(mesh.position(q) - mesh.position(p), mesh.position(r) - mesh.position(p));
    const bool is_below = mesh.region(face.behind) == 1;
    const double flux = dot((is_below ? lower : upper) * (is_below ? pressure.below : pressure.above), normal);
    error = std::max(error, std::abs(at(face.ahead) - at(face.behind) - flux / c.transmissibility[FaceId(f)]));
    largest = std::max(largest, std::abs(at(face.behind)));
  }
  return error / largest;
}

TEST(TetMetricDec, FluxesAreExactForAPressureThatIsLinearInEachLayer) {
  const TetMesh mesh = two_layers(4, 0.1, 0.1);
  const MetricMesh pieces = pieces_of(mesh, kLower, kUpper);
  EXPECT_LT(largest_gap(pieces), 1e-13);
  EXPECT_LT(flux_error(mesh, operators_of(pieces, mesh), kLower, kUpper, 4), 1e-12);
}

TEST(TetMetricDec, FacesHaveTwoCentersIfMetricsDifferWithinThem) {
  const TetMesh mesh = two_layers(4, 0.1, 0.1);
  const MetricMesh pieces = pieces_of(mesh, kLower, kOther);
  EXPECT_LT(largest_gap_of_edges(pieces), 1e-13);
  EXPECT_GT(largest_gap(pieces), 0.1);
  EXPECT_GT(flux_error(mesh, operators_of(pieces, mesh), kLower, kOther, 4), 1e-3);
}

// --- runs -----------------------------------------------------------------------------------------------------------

TEST(TetOptimize, WithOneTensorIsTheRunOfTheMappedMesh) {
  const Tensor3 k = {1, 0.1, 0, 2, 0.2, 1.5};
  TetMesh mesh = test::mesh_of(test::shaken(test::cubes(3, test::kSixTets), 0.05, 0));
  const TetMesh original = mesh;
  const MetricMesh pieces = *mapped(mesh, *Metric::of(k));
  TetMesh there = pieces.mesh;
  const auto expected = optimize(there);
  OptimizeOptions options;
  options.tetrahedra_tensors = {k};
  const auto report = optimize(mesh, options);
  ASSERT_TRUE(report) << report.error().what();
  EXPECT_EQ(report->sweeps, expected->sweeps);
  EXPECT_EQ(report->objective_after, expected->objective_after);
  EXPECT_TRUE(report->corner_weights.empty());
  const auto& numbers = expected->origins.vertices;
  EXPECT_EQ(mesh, mapped_back(with_mesh(pieces, there, numbers), original, pieces, numbers)->mesh);
  EXPECT_LT(report->history.back().bad, report->history.front().bad);
}

/// The number of tetrahedra that are bad in their metrics, after a run.
std::size_t bad_after(const TetMesh& mesh, const OptimizeReport& report) {
  const auto pieces = mapped(mesh, *Metrics::of(report.tetrahedra_tensors), report.corner_weights);
  return quality(pieces->mesh).orthocenters_outside;
}

TEST(TetOptimize, WithSeveralTensorsKeepsInterfacesAndTheirEquations) {
  TetMesh mesh = two_layers(4, 0.1, 0, test::kSixTets);
  const TetMesh original = mesh;
  OptimizeOptions options;
  options.tetrahedra_tensors = test::tensors_of(mesh, kLower, kUpper);
  options.tets.repair_trials = 1;
  const auto report = optimize(mesh, options);
  ASSERT_TRUE(report) << report.error().what();
  EXPECT_FALSE(mesh.validate());
  const std::size_t bad = bad_after(mesh, *report);
  EXPECT_LT(bad, report->history.front().bad);
  ASSERT_EQ(report->corner_weights.size(), mesh.n_halffaces());
  const auto& numbers = report->origins.vertices;
  for (const VertexId v : mesh.vertices()) {
    const VertexId old = numbers.empty() ? v : numbers[v];
    if (!old.valid() || original.position(old).z != 2) continue;
    EXPECT_EQ(mesh.position(v), original.position(old));
  }
  const auto pieces = mapped(mesh, *Metrics::of(report->tetrahedra_tensors), report->corner_weights);
  ASSERT_TRUE(pieces);
  EXPECT_EQ(quality(pieces->mesh).inverted_tetrahedra, 0U);
  EXPECT_LT(largest_gap(*pieces), 1e-12);
  EXPECT_LT(flux_error(mesh, operators_of(*pieces, mesh), kLower, kUpper, 4), 1e-12);
  // A second run begins from these weights.
  options.tetrahedra_tensors = report->tetrahedra_tensors;
  options.corner_weights = report->corner_weights;
  const auto again = optimize(mesh, options);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->history.front().bad, bad);
  EXPECT_LE(bad_after(mesh, *again), bad);
}

TEST(TetOptimize, KeepsTagsWhereInterfacesSlide) {
  TetMesh mesh = tagged_layers();
  const TetMesh original = mesh;
  OptimizeOptions options;
  options.tetrahedra_tensors = test::tensors_of(mesh, test::inverse_of({1, 0, 0.4, 1, -0.3, 12}), kUpper);
  options.tets.repair_trials = 1;
  options.boundary = BoundaryVertices::slide;
  const auto report = optimize(mesh, options);
  ASSERT_TRUE(report) << report.error().what();
  EXPECT_FALSE(mesh.validate());
  const std::size_t bad = bad_after(mesh, *report);
  EXPECT_EQ(bad, report->bad_after);
  EXPECT_LT(bad, report->history.front().bad);
  EXPECT_EQ(mesh.tagged_faces().size(), original.tagged_faces().size());
  EXPECT_EQ(mesh.tagged_lines().size(), original.tagged_lines().size());
}

TEST(TetOptimize, LetsInterfacesSlideOnBothSides) {
  const Tensor3 across = test::inverse_of({1, 0, 0.4, 1, -0.3, 12});
  TetMesh mesh = two_layers(4, 0.1, 0);
  const TetMesh original = mesh;
  OptimizeOptions options;
  options.tetrahedra_tensors = test::tensors_of(mesh, across, kUpper);
  options.tets.repair_trials = 0;  // the numbers of vertices stay
  const auto slid = [&](BoundaryVertices boundary) {
    options.boundary = boundary;
    mesh = original;
    const auto report = optimize(mesh, options);
    EXPECT_TRUE(report) << report.error().what();
    EXPECT_FALSE(mesh.validate());
    std::size_t moved = 0;
    for (const VertexId v : mesh.vertices()) {
      if (original.position(v).z != 2) continue;
      EXPECT_NEAR(mesh.position(v).z, 2, 1e-12);
      moved += mesh.position(v) == original.position(v) ? 0 : 1;
    }
    const auto pieces = mapped(mesh, *Metrics::of(report->tetrahedra_tensors), report->corner_weights);
    EXPECT_LT(largest_gap(*pieces), 1e-12);
    EXPECT_LT(flux_error(mesh, operators_of(*pieces, mesh), across, kUpper, 4), 1e-11);
    EXPECT_EQ(quality(pieces->mesh).orthocenters_outside, report->bad_after);
    return moved;
  };
  EXPECT_EQ(slid(BoundaryVertices::keep), 0U);
  EXPECT_GT(slid(BoundaryVertices::slide), 3U);
}

TEST(TetSlide, MovesAllCopiesOfAVertexTogetherAndNothingElse) {
  const TetMesh mesh = two_layers(4, 0.1, 0);
  const MetricMesh before = test::pieces_of(mesh, test::inverse_of({1, 0, 0.4, 1, -0.3, 12}), kUpper);
  MetricMesh pieces = before;
  OptimizeOptions options;
  options.boundary = BoundaryVertices::slide;
  EXPECT_FALSE(slide_seams(pieces, mesh, options, [] { return true; }));
  for (const VertexId v : pieces.mesh.vertices()) EXPECT_EQ(pieces.mesh.position(v), before.mesh.position(v));
  ASSERT_TRUE(slide_seams(pieces, mesh, options, [] { return false; }));
  const auto place = [](const MetricMesh& of, VertexId v) {
    return of.metric(of.mesh.incident(v)).from_metric(of.mesh.position(v));
  };
  std::size_t moved = 0;
  for (const VertexId v : pieces.mesh.vertices()) {
    EXPECT_LT(length(place(pieces, v) - place(pieces, pieces.first_copy(v))), 1e-12);
    EXPECT_EQ(pieces.mesh.weight(v), before.mesh.weight(v));
    if (pieces.mesh.position(v) == before.mesh.position(v)) continue;
    ++moved;
    EXPECT_NEAR(place(before, v).z, 2, 1e-12);
    EXPECT_NEAR(place(pieces, v).z, 2, 1e-12);
  }
  EXPECT_GT(moved, 6U);
}

TEST(TetOptimize, RefusesTensorsOfTrianglesAndSplitInterfaces) {
  TetMesh mesh = two_layers(2, 0, 0);
  OptimizeOptions options;
  options.tensor = Tensor();
  const auto of_triangles = optimize(mesh, options);
  ASSERT_FALSE(of_triangles);
  EXPECT_EQ(of_triangles.error().message,
            "tensors of triangles are given for tetrahedra. Next: give `tetrahedra_tensors`");
  options.tensor.reset();
  options.tetrahedra_tensors = test::tensors_of(mesh, kLower, kUpper);
  options.boundary = BoundaryVertices::split;
  const auto split = optimize(mesh, options);
  ASSERT_FALSE(split);
  EXPECT_TRUE(split.error().message.starts_with("`boundary=split` does not split interfaces"));
}

}  // namespace
}  // namespace temper::tets

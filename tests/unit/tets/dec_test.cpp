// The operators of tetrahedra: complexes, sums, linear functions, gauge, and duals measured directly.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "support/lattice.hpp"
#include "support/tet_lattice.hpp"
#include "temper/tets/operators.hpp"

namespace temper::tets {
namespace {

constexpr double kRelative = 1e-11;

/// Random places and weights: every sign occurs.
test::TetArrays rough() { return test::shaken(test::cubes(3, test::kSixTets), 0.12, 1); }

std::vector<double> times(const IncidenceMatrix& a, const std::vector<double>& x) {
  std::vector<double> y(a.n_rows(), 0.0);
  for (std::size_t row = 0; row < a.n_rows(); ++row) {
    for (auto i = static_cast<std::size_t>(a.starts[row]); i < static_cast<std::size_t>(a.starts[row + 1]); ++i)
      y[row] += a.signs[i] * x[static_cast<std::size_t>(a.columns[i])];
  }
  return y;
}

std::vector<double> noise(std::size_t n) {
  test::Noise random(7);
  std::vector<double> x(n);
  for (double& value : x) value = std::round(100 * random());
  return x;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

template <class Id>
void expect_close(const IdVector<Id, double>& a, const IdVector<Id, double>& b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  double scale = 0;
  for (const double value : a) scale = std::max(scale, std::abs(value));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[Id(i)], b[Id(i)], kRelative * scale);
}

TEST(TetDec, TheBoundaryOfABoundaryIsNothing) {
  const DecComplex c = dec_operators(test::mesh_of(rough()));
  const std::vector<double> vertices = noise(c.star0.size()), edges = noise(c.star1.size());
  EXPECT_EQ(times(c.d1, times(c.d0, vertices)), std::vector<double>(c.star2.size(), 0.0));
  EXPECT_EQ(times(c.d2, times(c.d1, edges)), std::vector<double>(c.star3.size(), 0.0));
  EXPECT_NE(times(c.d2, noise(c.star2.size())), std::vector<double>(c.star3.size(), 0.0));
}

// Incidence is that of the geometry: the flux of a constant field through the faces of a tetrahedron is 0, and the flux
// of x is its volume.
TEST(TetDec, FacesPointOutOfTheTetrahedronBehind) {
  const TetMesh mesh = test::mesh_of(rough());
  const DecComplex c = dec_operators(mesh);
  std::vector<double> flux;
  for (const DecFace& f : c.faces) {
    const Vec3 p = mesh.position(f.vertices[0]), q = mesh.position(f.vertices[1]), r = mesh.position(f.vertices[2]);
    const Vec3 normal = 0.5 * cross(q - p, r - p);
    EXPECT_NEAR(f.area, length(normal), kRelative);
    flux.push_back(normal.x * (p.x + q.x + r.x) / 3);
  }
  const std::vector<double> out = times(c.d2, flux);
  for (const TetId t : mesh.tetrahedra()) EXPECT_NEAR(out[t.index], c.volumes[t], kRelative);
}

TEST(TetDec, DualCellsHaveTheVolumeOfTheDomainWhateverTheWeights) {
  const DecComplex c = dec_operators(test::mesh_of(rough()));
  const DecSummary s = summarize(c);
  double by_edges = 0, by_faces = 0;
  for (const DecEdge& e : c.edges) by_edges += e.length * e.dual_area / 3;
  for (const DecFace& f : c.faces) by_faces += f.area * f.dual_length / 3;
  EXPECT_NEAR(s.star0_sum, s.volume, kRelative * s.volume);
  EXPECT_NEAR(by_edges, s.volume, kRelative * s.volume);
  EXPECT_NEAR(by_faces, s.volume, kRelative * s.volume);
  EXPECT_NEAR(s.volume, sum(c.volumes.raw()), 1e-12);
  EXPECT_GT(s.negative_star0, 0U);
  EXPECT_GT(s.negative_star1, 0U);
  EXPECT_GT(s.negative_star2, 0U);
  EXPECT_GT(s.negative_boundary_star2, 0U);
  EXPECT_GT(s.not_well_centered, 0U);
  EXPECT_EQ(s.zero_star2, 0U);
}

TEST(TetDec, LinearFunctionsAreHarmonicAndHaveExactFluxes) {
  const TetMesh mesh = test::mesh_of(rough());
  const DecComplex c = dec_operators(mesh);
  const Vec3 slope = {1.25, -2, 0.5};
  std::vector<double> u;
  for (const VertexId v : mesh.vertices()) u.push_back(dot(slope, mesh.position(v)));
  std::vector<double> laplacian(u.size(), 0.0);
  const std::vector<double> gradient = times(c.d0, u);
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    laplacian[c.edges[EdgeId(e)].from.index] += c.star1[EdgeId(e)] * gradient[e];
    laplacian[c.edges[EdgeId(e)].to.index] -= c.star1[EdgeId(e)] * gradient[e];
  }
  const auto on_boundary = boundary_vertices(mesh);
  std::size_t inner = 0;
  for (const VertexId v : mesh.vertices()) {
    if (on_boundary[v] != 0) continue;
    EXPECT_NEAR(laplacian[v.index], 0, 1e-10);
    ++inner;
  }
  EXPECT_EQ(inner, 8U);
  // The two-point flux from behind to ahead is that of the slope through the face. On the boundary the value is taken
  // at the orthocenter of the face.
  for (std::size_t i = 0; i < c.faces.size(); ++i) {
    const DecFace& f = c.faces[FaceId(i)];
    const Vec3 p = mesh.position(f.vertices[0]), q = mesh.position(f.vertices[1]), r = mesh.position(f.vertices[2]);
    const auto at = [&](TetId t) { return t.valid() ? c.orthocenters[t] : f.orthocenter; };
    const double flux = c.transmissibility[FaceId(i)] * dot(slope, at(f.ahead) - at(f.behind));
    EXPECT_NEAR(flux, dot(slope, 0.5 * cross(q - p, r - p)), 1e-9 * (1 + std::abs(c.transmissibility[FaceId(i)])));
  }
}

TEST(TetDec, AnOffsetOfAllWeightsChangesNothingAndALinearOneShiftsTheDual) {
  const test::TetArrays arrays = rough();
  test::TetArrays offset = arrays, sloped = arrays;
  for (double& w : offset.weights) w += 4;
  for (std::size_t i = 0; i < sloped.points.size(); ++i) sloped.weights[i] += 0.25 * sloped.points[i].y;
  const DecComplex c = dec_operators(test::mesh_of(arrays)), same = dec_operators(test::mesh_of(offset)),
                   shifted = dec_operators(test::mesh_of(sloped));
  expect_close(c.star0, same.star0);
  expect_close(c.star1, same.star1);
  expect_close(c.star2, same.star2);
  expect_close(c.star3, same.star3);
  for (const TetId t : IdRange<TetId>(c.volumes.size()))
    EXPECT_NEAR(length(shifted.orthocenters[t] - c.orthocenters[t] + Vec3{0, 0.125, 0}), 0, 1e-10);
  for (std::size_t e = 0; e < c.edges.size(); ++e) {
    if (c.edges[EdgeId(e)].is_boundary) continue;
    EXPECT_NEAR(c.star1[EdgeId(e)], shifted.star1[EdgeId(e)], 1e-9);
  }
}

/// The signed area of the polygon of orthocenters around an inner edge, as seen along the edge.
double polygon_area(const TetMesh& mesh, const DecComplex& c, VertexId from, VertexId to) {
  std::map<VertexId, std::pair<VertexId, TetId>> next;  // tetrahedra from, to, p, q, positive: p → q
  for (const TetId t : mesh.tetrahedra()) {
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      const auto v = mesh.vertices(h);
      for (std::size_t k = 0; k < 3; ++k) {
        if (v[k] == from && v[(k + 1) % 3] == to) next[v[(k + 2) % 3]] = {mesh.opposite(h), t};
      }
    }
  }
  const Vec3 along = mesh.position(to) - mesh.position(from);
  Vec3 doubled = {0, 0, 0};
  VertexId at = next.begin()->first;
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto& [after, t] = next[at];
    doubled = doubled +
              cross(c.orthocenters[t] - mesh.position(from), c.orthocenters[next[after].second] - mesh.position(from));
    at = after;
  }
  return 0.5 * dot(doubled, along) / length(along);
}

// Without weights the dual is that of circumcenters. Here both are measured from the orthocenters alone.
TEST(TetDec, DualsAreThoseOfTheOrthocenters) {
  for (const double weight : {0.0, 0.3}) {
    const TetMesh mesh = test::mesh_of(test::shaken(test::cubes(3, test::kSixTets), 0.12, weight));
    const DecComplex c = dec_operators(mesh);
    for (const TetId t : mesh.tetrahedra()) {
      for (const WeightedPoint& p : mesh.points(t)) {
        const WeightedPoint first = mesh.points(t)[0];
        EXPECT_NEAR(squared_length(c.orthocenters[t] - p.position()) - p.w,
                    squared_length(c.orthocenters[t] - first.position()) - first.w, 1e-7);
      }
    }
    std::size_t inner = 0;
    for (std::size_t e = 0; e < c.edges.size(); e += 3) {
      const DecEdge& edge = c.edges[EdgeId(e)];
      if (edge.is_boundary) continue;
      EXPECT_NEAR(edge.dual_area, polygon_area(mesh, c, edge.from, edge.to), 1e-8);
      EXPECT_NEAR(c.star1[EdgeId(e)], edge.dual_area / edge.length, 1e-12 * std::abs(c.star1[EdgeId(e)]));
      ++inner;
    }
    EXPECT_GT(inner, 10U);
    for (const DecFace& f : c.faces) {
      if (f.is_boundary()) continue;
      EXPECT_NEAR(std::abs(f.dual_length), length(c.orthocenters[f.ahead] - c.orthocenters[f.behind]), 1e-8);
      EXPECT_NEAR(f.dual_length, f.behind_height + f.ahead_height, 1e-8);
    }
  }
}

TEST(TetDec, TheBodyCenteredLatticeHasOneNumberForEachKindOfElement) {
  const DecComplex c = dec_operators(test::mesh_of(test::body_centered(4)));
  const DecSummary s = summarize(c);
  EXPECT_EQ(s.not_well_centered + s.negative_star0 + s.negative_star1 + s.negative_star2 + s.negative_boundary_star2,
            0U);
  for (const double volume : c.volumes) EXPECT_NEAR(volume, 1.0 / 12, 1e-15);
  // Both orthocenters are √2/8 from the face, whose area is √2/4. Dual cells of inner vertices are truncated octahedra.
  for (std::size_t f = 0; f < c.faces.size(); ++f)
    EXPECT_NEAR(c.star2[FaceId(f)], c.faces[FaceId(f)].is_boundary() ? 0.5 : 1, 1e-13);
  EXPECT_NEAR(*std::max_element(c.star0.begin(), c.star0.end()), 0.5, 1e-13);
}

TEST(TetDec, CubesInSixHaveDualEdgesOfLengthZeroExactly) {
  const DecComplex c = dec_operators(test::mesh_of(test::cubes(2, test::kSixTets)));
  const DecSummary s = summarize(c);
  EXPECT_EQ(s.zero_star2, 6U * 8);  // the faces inside of cubes: all six orthocenters are in the middle
  EXPECT_EQ(s.negative_star2, 0U);
  EXPECT_EQ(s.not_well_centered, s.tetrahedra) << "orthocenters on faces are not inside";
  EXPECT_EQ(s.max_transmissibility, HUGE_VAL);
}

TEST(TetDec, ACoefficientScalesFluxesAndAJumpIsCrossedOneSideAfterTheOther) {
  const TetMesh mesh = test::mesh_of(rough());
  const DecComplex c = dec_operators(mesh);
  const std::vector<double> three(mesh.n_tetrahedra(), 3.0);
  const auto scaled = with_coefficient(mesh, c, three);
  ASSERT_TRUE(scaled);
  for (std::size_t e = 0; e < c.edges.size(); ++e) EXPECT_NEAR(scaled->star1[EdgeId(e)], 3 * c.star1[EdgeId(e)], 1e-10);
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    const double expected = 3 * c.transmissibility[FaceId(f)];
    EXPECT_NEAR(scaled->transmissibility[FaceId(f)], expected, 1e-12 * std::abs(expected));
  }
  EXPECT_NEAR(sum(scaled->capacity.raw()), 3 * sum(c.volumes.raw()), 1e-9);
  EXPECT_EQ(scaled->star2, c.star2);

  std::vector<double> layers;
  for (const TetId t : mesh.tetrahedra()) layers.push_back(t.index % 2 == 0 ? 1.0 : 10.0);
  const auto jumps = with_coefficient(mesh, c, layers);
  ASSERT_TRUE(jumps);
  for (std::size_t i = 0; i < c.faces.size(); ++i) {
    const DecFace& f = c.faces[FaceId(i)];
    double resistance = 0;
    if (f.behind.valid()) resistance += f.behind_height / layers[f.behind.index];
    if (f.ahead.valid()) resistance += f.ahead_height / layers[f.ahead.index];
    EXPECT_NEAR(1 / jumps->transmissibility[FaceId(i)], resistance / f.area, 1e-9);
  }

  std::vector<double> wrong = three;
  wrong[5] = 0;
  EXPECT_EQ(with_coefficient(mesh, c, wrong).error().message,
            "tetrahedron 5 has the coefficient 0; expected a finite number above 0");
  wrong.pop_back();
  EXPECT_EQ(with_coefficient(mesh, c, wrong).error().message,
            "expected one coefficient for each of the 162 tetrahedra, found 161");
}

}  // namespace
}  // namespace temper::tets

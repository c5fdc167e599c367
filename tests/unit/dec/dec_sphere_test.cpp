// Laws of the operators on the sphere: sums, kernels, eigenfunctions, motions, and the plane as the limit of a large
// radius.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "base/rng.hpp"
#include "support/lattice.hpp"
#include "support/spheres.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

constexpr double kOnSphere = 1e-12;

/// Random weights of the size of edges: triangles that are not well-centered, edges that are not regular.
Mesh rough_sphere(std::uint64_t seed = 1, double radius = 1) {
  Mesh mesh = test::globe(300, seed, radius);
  test::Noise noise(seed);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, 0.02 * radius * radius * noise());
  return mesh;
}

Mesh coasts() { return test::ocean(rough_sphere(), 0.4); }

template <class Range>
double sum(const Range& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

template <class Id>
void expect_close(const IdVector<Id, double>& a, const IdVector<Id, double>& b, double factor, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  double scale = 0;
  for (const double v : b) scale = std::max(scale, std::abs(v));
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(factor * a[Id(i)], b[Id(i)], tolerance * scale);
}

TEST(DecSphere, TheRoughGlobeHasEverySign) {
  const Mesh mesh = coasts();
  const DecSummary s = summarize(mesh, dec_operators(mesh));
  EXPECT_GT(s.negative_star0, 0u);
  EXPECT_GT(s.negative_star1, 0u);
  EXPECT_GT(s.negative_boundary_star1, 0u);
  EXPECT_GT(s.not_well_centered, 0u);
  EXPECT_LT(s.not_well_centered, s.triangles);
}

TEST(DecSphere, CellsAndTrianglesOfAClosedMeshCoverTheSphere) {
  for (const double radius : {1.0, 6371220.0}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Mesh mesh = rough_sphere(seed, radius);
      const DecComplex c = dec_operators(mesh);
      const double whole = 4 * std::numbers::pi * radius * radius;
      EXPECT_NEAR(sum(c.star0), whole, kOnSphere * whole);
      EXPECT_NEAR(sum(c.areas), whole, kOnSphere * whole);
    }
  }
}

TEST(DecSphere, CellsCoverADomainWithCoastsWhateverTheWeights) {
  const Mesh mesh = coasts();
  const DecComplex c = dec_operators(mesh);
  EXPECT_GT(summarize(mesh, c).boundary_edges, 10u);
  EXPECT_NEAR(sum(c.star0), sum(c.areas), kOnSphere * sum(c.areas));
}

TEST(DecSphere, TheBoundaryOfABoundaryIsNothing) {
  const Mesh mesh = rough_sphere();
  const DecComplex c = dec_operators(mesh);
  ASSERT_EQ(c.d0.n_rows(), mesh.n_edges());
  ASSERT_EQ(c.d1.n_rows(), mesh.n_triangles());
  for (std::size_t t = 0; t < c.d1.n_rows(); ++t) {
    std::map<std::int32_t, int> row;  // of d1 d0
    for (std::int64_t i = c.d1.starts[t]; i < c.d1.starts[t + 1]; ++i) {
      const std::int32_t e = c.d1.columns[i];
      for (std::int64_t j = c.d0.starts[e]; j < c.d0.starts[e + 1]; ++j)
        row[c.d0.columns[j]] += c.d1.signs[i] * c.d0.signs[j];
    }
    EXPECT_EQ(row.size(), 3u);
    for (const auto& [vertex, entry] : row) EXPECT_EQ(entry, 0);
  }
}

TEST(DecSphere, DualVerticesHaveEqualPowerAndDualArcsAreWhatLiesBetweenThem) {
  const double radius = 3;
  const Mesh mesh = rough_sphere(1, radius);
  const DecComplex c = dec_operators(mesh);
  ASSERT_EQ(c.sphere_orthocenters.size(), mesh.n_triangles());
  ASSERT_EQ(c.sphere_midpoints.size(), c.edges.size());
  EXPECT_TRUE(c.orthocenters.empty());
  for (const TriangleId t : mesh.triangles()) {
    const auto [i, j, k] = mesh.corners(t);
    const Vec3 o = c.sphere_orthocenters[t];
    EXPECT_NEAR(length(o), radius, kOnSphere * radius);
    EXPECT_NEAR(dot(o, mesh.weighted_vector(i)), dot(o, mesh.weighted_vector(j)), 1e-10);
    EXPECT_NEAR(dot(o, mesh.weighted_vector(i)), dot(o, mesh.weighted_vector(k)), 1e-10);
  }
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const EdgeId id(i);
    const DecEdge& e = c.edges[id];
    const Vec3 p = mesh.weighted_vector(e.from), q = mesh.weighted_vector(e.to), m = c.sphere_midpoints[id];
    const Vec3 pole = (1 / length(cross(p, q))) * cross(p, q);  // on the left
    EXPECT_NEAR(length(m), radius, kOnSphere);
    EXPECT_NEAR(dot(m, p), dot(m, q), kOnSphere * radius * radius);
    EXPECT_NEAR(dot(m, pole), 0, kOnSphere);
    EXPECT_NEAR(radius * arc_length(p, q), e.length, kOnSphere);
    EXPECT_NEAR(std::abs(e.crossing), radius * arc_length(p, m), 1e-7);
    EXPECT_NEAR(radius * std::asin(dot(c.sphere_orthocenters[e.left], pole) / radius), e.left_height, 1e-9);
    EXPECT_NEAR(radius * std::asin(dot(c.sphere_orthocenters[e.right], pole) / radius), -e.right_height, 1e-9);
    EXPECT_NEAR(e.left_height + e.right_height, e.dual_length, 1e-10);
    EXPECT_NEAR(c.star1[id] * e.length, e.dual_length, 1e-10);
    EXPECT_NEAR(c.transmissibility[id] * c.star1[id], 1, kOnSphere);
  }
}

TEST(DecSphere, SignsAreThoseOfTheExactPredicates) {
  std::size_t zeros = 0, negative = 0;
  const auto icosahedron = icosahedral({.level = 3});
  for (const Mesh& mesh : {*icosahedron, rough_sphere(1), rough_sphere(2), coasts()}) {
    const DecComplex c = dec_operators(mesh);
    for (const HalfedgeId h : mesh.halfedges()) {
      const double star1 = c.star1[c.edge_of_halfedge[h]];
      const Vec3 p = mesh.weighted_vector(mesh.origin(h)), q = mesh.weighted_vector(mesh.target(h));
      const Vec3 r = mesh.weighted_vector(mesh.opposite(h));
      const Sign found = star1 > 0 ? Sign::positive : star1 < 0 ? Sign::negative : Sign::zero;
      const Sign expected = mesh.is_boundary(h)
                                ? signed_height_sign(p, q, r)
                                : -power_test(p, q, r, mesh.weighted_vector(mesh.opposite(mesh.twin(h))));
      EXPECT_EQ(found, expected);
      zeros += found == Sign::zero ? 1 : 0;
      negative += found == Sign::negative ? 1 : 0;
    }
  }
  EXPECT_EQ(zeros, 0u);
  EXPECT_GT(negative, 100u);
}

TEST(DecSphere, CocircularPointsHaveADualEdgeOfNoLength) {
  // A cube, each square cut in two.
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  const auto mesh = spherical_delaunay(points, std::sqrt(3.0));
  ASSERT_TRUE(mesh) << mesh.error().what();
  const DecSummary s = summarize(*mesh, dec_operators(*mesh));
  EXPECT_EQ(s.edges, 18u);
  EXPECT_EQ(s.zero_star1, 6u);
  EXPECT_EQ(s.negative_star1, 0u);
}

// --- the Laplacian ------------------------------------------------------------------------------------------------

/// ★0⁻¹ d0ᵀ ★1 d0 u.
template <class Function>
std::vector<double> minus_laplacian(const Mesh& mesh, const DecComplex& c, const Function& u) {
  std::vector<double> result(mesh.n_vertices(), 0.0);
  for (std::size_t i = 0; i < c.edges.size(); ++i) {
    const DecEdge& e = c.edges[EdgeId(i)];
    const double flow = c.star1[EdgeId(i)] * (u(mesh.weighted_vector(e.from)) - u(mesh.weighted_vector(e.to)));
    result[e.from.index] += flow, result[e.to.index] -= flow;
  }
  for (const VertexId v : mesh.vertices()) result[v.index] /= c.star0[v];
  return result;
}

TEST(DecSphere, ConstantsAreHarmonic) {
  const Mesh mesh = rough_sphere();
  for (const double value : minus_laplacian(mesh, dec_operators(mesh), [](Vec3) { return 7.0; })) EXPECT_EQ(value, 0);
}

/// Spherical harmonics of the degrees 1, 2 and 3 about a generic axis, as functions of the direction.
double harmonic(int degree, Vec3 p) {
  const Vec3 axis = {2.0 / 7, 3.0 / 7, 6.0 / 7}, across = {6.0 / 7, 2.0 / 7, -3.0 / 7};
  const double z = dot(axis, p) / length(p), x = dot(across, p) / length(p);
  return degree == 1 ? z : degree == 2 ? 3 * z * z - 1 : x * (5 * z * z - 1);
}

/// The error of the Laplacian of a harmonic, in L² of cells, relative.
double eigenvalue_error(const Mesh& mesh, int degree) {
  const DecComplex c = dec_operators(mesh);
  const double radius = mesh.space().radius(), eigenvalue = degree * (degree + 1) / (radius * radius);
  const auto found = minus_laplacian(mesh, c, [&](Vec3 p) { return harmonic(degree, p); });
  double error = 0, size = 0;
  for (const VertexId v : mesh.vertices()) {
    const double expected = eigenvalue * harmonic(degree, mesh.weighted_vector(v));
    error += c.star0[v] * (found[v.index] - expected) * (found[v.index] - expected);
    size += c.star0[v] * expected * expected;
  }
  return std::sqrt(error / size);
}

// Where one bisected triangle meets the next of another shape, the error is larger than inside them: measured up to
// level 7, the order falls towards 1 from above, for degree 1 towards 1.5.
TEST(DecSphere, SphericalHarmonicsBecomeEigenfunctionsOfTheLaplacian) {
  for (const int degree : {1, 2, 3}) {
    double before = 0;
    for (const int level : {2, 3, 4, 5}) {
      const auto mesh = icosahedral({.level = level, .radius = 2});
      const double error = eigenvalue_error(*mesh, degree);
      if (before > 0) {
        EXPECT_GT(std::log2(before / error), 1) << "degree " << degree << ", level " << level;
      }
      before = error;
    }
    EXPECT_LT(before, 0.01);
  }
}

// --- motions and units ----------------------------------------------------------------------------------------------

TEST(DecSphere, TurningTheSphereKeepsStars) {
  const Mesh mesh = coasts();
  Mesh turned = mesh;
  // Columns of a rotation by quaternion (1, 2, 3, 4)/√30.
  const Vec3 a = {-20.0 / 30, 20.0 / 30, 10.0 / 30}, b = {4.0 / 30, -10.0 / 30, 28.0 / 30},
             c = {22.0 / 30, 20.0 / 30, 4.0 / 30};
  for (const VertexId v : mesh.vertices()) {
    const Vec3 p = mesh.weighted_vector(v);
    turned.set_point(v, as_point(p.x * a + p.y * b + p.z * c));
  }
  ASSERT_FALSE(turned.validate());
  const DecComplex before = dec_operators(mesh), after = dec_operators(turned);
  expect_close(before.star0, after.star0, 1, 1e-10);
  expect_close(before.star1, after.star1, 1, 1e-10);
  expect_close(before.star2, after.star2, 1, 1e-10);
}

TEST(DecSphere, UnitsOfLengthScaleStars) {
  const Mesh mesh = coasts();
  Mesh scaled = mesh;
  scaled.set_space(mesh.space().in_units_of(1.0 / 8));
  for (const VertexId v : mesh.vertices()) scaled.set_point(v, as_point(8.0 * mesh.weighted_vector(v)));
  const DecComplex a = dec_operators(mesh), b = dec_operators(scaled);
  expect_close(a.star0, b.star0, 64, 0);
  expect_close(a.star1, b.star1, 1, 0);
  expect_close(a.star2, b.star2, 1.0 / 64, 0);
  expect_close(a.transmissibility, b.transmissibility, 1, 0);
}

TEST(DecSphere, AllPointsScaledChangeNothing) {
  const Mesh mesh = coasts();
  Mesh scaled = mesh;
  for (const VertexId v : mesh.vertices()) scaled.set_point(v, as_point(2.0 * mesh.weighted_vector(v)));
  const DecComplex a = dec_operators(mesh), b = dec_operators(scaled);
  expect_close(a.star0, b.star0, 1, 0);
  expect_close(a.star1, b.star1, 1, 0);
  expect_close(a.star2, b.star2, 1, 0);
}

/// A planar mesh in [−½, ½]², and the same around the pole of a sphere, weights included.
double distance_to_plane(double radius) {
  const auto planar = random_mesh({.vertices = 200, .seed = 4});
  EXPECT_TRUE(planar);
  Mesh plane = *planar;
  test::Noise noise(4);
  std::vector<Vec3> points;
  std::vector<double> weights;
  for (const VertexId v : plane.vertices()) {
    plane.set_weight(v, 0.003 * noise());
    const Vec2 p = plane.position(v) - Vec2{0.5, 0.5};
    points.push_back({p.x, p.y, std::sqrt(radius * radius - squared_length(p))});
    weights.push_back(plane.weight(v));
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (const TriangleId t : plane.triangles()) {
    const auto [i, j, k] = plane.corners(t);
    triangles.push_back({std::int32_t(i.index), std::int32_t(j.index), std::int32_t(k.index)});
  }
  const auto sphere = Mesh::build(
      {.weights = weights, .triangles = triangles, .space = Space::sphere(radius), .sphere_points = points});
  EXPECT_TRUE(sphere) << sphere.error().what();
  const DecComplex a = dec_operators(plane), b = dec_operators(sphere->mesh);
  double most = 0, size = 0;
  for (const VertexId v : plane.vertices()) {
    most = std::max(most, std::abs(a.star0[v] - b.star0[v]));
    size = std::max(size, std::abs(a.star0[v]));
  }
  for (std::size_t i = 0; i < a.edges.size(); ++i) {
    const EdgeId e(i);
    most = std::max(most, size * std::abs(a.star1[e] - b.star1[e]) / (1 + std::abs(a.star1[e])));
  }
  return most / size;
}

TEST(DecSphere, ASmallPatchHasTheOperatorsOfThePlaneToSecondOrder) {
  const double at_30 = distance_to_plane(30), at_120 = distance_to_plane(120);
  EXPECT_LT(at_30, 1e-2);
  EXPECT_NEAR(std::log2(at_30 / at_120), 4, 0.2);  // a radius of four times: one sixteenth
}

// --- power cells ----------------------------------------------------------------------------------------------------

std::vector<Vec3> sphere_polygon(const PowerCells& cells, std::size_t p) {
  return {cells.sphere_corners.begin() + static_cast<std::ptrdiff_t>(cells.starts[p]),
          cells.sphere_corners.begin() + static_cast<std::ptrdiff_t>(cells.starts[p + 1])};
}

/// By the winding of its sides around x: right also where it is not convex.
bool inside(const std::vector<Vec3>& corners, Vec3 x) {
  double turn = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = cross(x, corners[i]), b = cross(x, corners[(i + 1) % corners.size()]);
    turn += std::atan2(dot(x, cross(a, b)) / length(x), dot(a, b));
  }
  return turn > std::numbers::pi;
}

/// A place in each triangle is in one cell only; in that of the greatest x·P where the mesh is regular and closed.
void expect_partition(const Mesh& mesh, const PowerCells& cells, bool of_power_diagram) {
  double whole = 0;
  for (const double area : dec_operators(mesh).areas) whole += area;
  EXPECT_NEAR(sum(cells.areas), whole, 1e-11 * whole);
  EXPECT_NEAR(sum(cells.polygon_areas), whole, 1e-11 * whole);
  Rng rng(5);
  for (const TriangleId t : mesh.triangles()) {
    const auto [i, j, k] = mesh.corners(t);
    const double a = rng.uniform(0.05, 0.9), b = rng.uniform(0.02, 0.95 - a);
    const Vec3 x = a * mesh.weighted_vector(i) + b * mesh.weighted_vector(j) + (1 - a - b) * mesh.weighted_vector(k);
    std::vector<VertexId> owners;
    for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
      if (dot(x, cells.sphere_corners[cells.starts[p]]) > 0 && inside(sphere_polygon(cells, p), x))
        owners.push_back(cells.vertices[p]);
    }
    ASSERT_EQ(owners.size(), 1u);
    if (!of_power_diagram) continue;
    for (const VertexId v : mesh.vertices())
      EXPECT_LE(dot(x, mesh.weighted_vector(v)), dot(x, mesh.weighted_vector(owners[0])) + 1e-12);
  }
}

TEST(DecSphere, PowerCellsCoverTheDomainOnceWhateverTheWeights) {
  Mesh regular = rough_sphere();
  expect_partition(regular, power_cells(regular, dec_operators(regular)), false);
  restore_regularity(regular);
  ASSERT_GT(summarize(regular, dec_operators(regular)).not_well_centered, 0u);
  expect_partition(regular, power_cells(regular, dec_operators(regular)), true);
  const Mesh coast = coasts();
  expect_partition(coast, power_cells(coast, dec_operators(coast)), false);
  // Five points, whose cells reach far around.
  const std::vector<Vec3> points = {{1, 0, 0.1}, {-0.5, 0.8, 0}, {-0.6, -0.7, 0.1}, {0, 0.1, 1}, {0.1, 0, -1}};
  const auto few = spherical_delaunay(points);
  ASSERT_TRUE(few) << few.error().what();
  expect_partition(*few, power_cells(*few, dec_operators(*few)), true);
}

TEST(DecSphere, PowerCellsOfAWellCenteredMeshAreItsDualCells) {
  const auto mesh = icosahedral({.level = 2, .radius = 5});
  const DecComplex c = dec_operators(*mesh);
  const PowerCells cells = power_cells(*mesh, c);
  EXPECT_EQ(cells.n_polygons(), mesh->n_vertices());
  expect_close(cells.areas, c.star0, 1, kOnSphere);
}

}  // namespace
}  // namespace temper

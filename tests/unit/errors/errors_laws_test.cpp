// measure_errors(): what must hold of the errors on any mesh, and the same numbers by plainer means.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "errors/fields.hpp"
#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/std_threads.hpp"
#include "temper/dec.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/errors.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"

namespace temper::test {
namespace {

using error_detail::all_fields;
using error_detail::Field;

ErrorReport verified(const Mesh& mesh, const MeasureErrorsOptions& options = {}) {
  auto report = measure_errors(mesh, options);
  EXPECT_TRUE(report) << report.error().what();
  return report ? *std::move(report) : ErrorReport{};
}

/// About half of the triangles obtuse, and weights that are as wild as the mesh.
Mesh wild_mesh(double weight) {
  Mesh mesh = *random_mesh({.vertices = 150, .seed = 5});
  Noise noise(11);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, weight * noise());
  return mesh;
}

void expect_near(const ErrorReport& a, const ErrorReport& b, double relative) {
  ASSERT_EQ(a.fields.size(), b.fields.size());
  ASSERT_GT(a.fields.size(), 0u);
  for (std::size_t i = 0; i < a.fields.size(); ++i) {
    for (const ErrorMeasure& measure : error_measures()) {
      const double x = measure.of(a.fields[i].errors), y = measure.of(b.fields[i].errors);
      EXPECT_NEAR(x, y, relative * std::max(std::abs(x), 1e-6)) << a.fields[i].field.name << " " << measure.key;
    }
  }
  EXPECT_EQ(a.poisson.m_matrix, b.poisson.m_matrix);
  EXPECT_EQ(a.flux.negative, b.flux.negative);
  EXPECT_NEAR(a.flux.largest_over_median, b.flux.largest_over_median, relative * b.flux.largest_over_median);
}

// --- laws ------------------------------------------------------------------------------------------------------------

TEST(ErrorLaws, LinearFieldsAreExactForArbitraryWeights) {
  std::vector<Mesh> meshes = {lattice(), lattice({.n = 9, .jitter = 0.2, .weight = 0.1}), wild_mesh(0),
                              wild_mesh(1e-3)};
  for (const Mesh& mesh : meshes) {
    const ErrorReport report = verified(mesh, {.fields = {"exact"}});
    ASSERT_EQ(report.fields.size(), 1u);
    const OperatorErrors& errors = report.fields[0].errors;
    EXPECT_FALSE(report.poisson.singular || report.flux.singular);
    EXPECT_GT(report.poisson.unknowns, 0u);
    EXPECT_LT(errors.poisson.max, 1e-10);
    EXPECT_LT(errors.flux.max, 1e-10);
    EXPECT_LT(errors.star[1].max, 1e-12);  // its derivative and that turned are constant forms
    EXPECT_LT(errors.star[1].l2, 1e-12);
  }
}

TEST(ErrorLaws, TranslationAndScaleChangeNothing) {
  const ErrorReport plain = verified(lattice({.n = 7}));
  expect_near(verified(lattice({.n = 7, .scale = 1000})), plain, 1e-8);
  expect_near(verified(lattice({.n = 7, .scale = 1e-3, .offset = {5, -3}})), plain, 1e-6);
}

TEST(ErrorLaws, AConstantAddedToAllWeightsChangesNothing) {
  Mesh mesh = lattice({.n = 7});
  const ErrorReport plain = verified(mesh);
  for (const VertexId v : mesh.vertices()) mesh.set_weight(v, mesh.weight(v) + 1.75);
  expect_near(verified(mesh), plain, 1e-8);
}

TEST(ErrorLaws, TheNumbersOfVerticesAndTrianglesDoNotMatter) {
  const Mesh mesh = wild_mesh(1e-4);
  expect_near(verified(hilbert_ordered(mesh).mesh), verified(mesh), 1e-8);
}

TEST(ErrorLaws, ThreadsDoNotChangeAByte) {
  const Mesh mesh = *random_mesh({.vertices = 12000, .seed = 2});  // more than one block of edges
  StdThreads threads(4);
  const MeasureErrorsOptions options = {.fields = {"bump"}, .local = true};
  MeasureErrorsOptions threaded = options;
  threaded.executor = &threads;
  const ErrorReport one = verified(mesh, options), four = verified(mesh, threaded);
  EXPECT_GT(threads.runs(), 0u);
  for (const ErrorMeasure& measure : error_measures()) {
    EXPECT_EQ(measure.of(one.fields[0].errors), measure.of(four.fields[0].errors)) << measure.key;
  }
  EXPECT_EQ(one.local, four.local);
}

// --- the same by plainer means ---------------------------------------------------------------------------------------

/// Everything in the frame, by midpoint sums: slow, short.
struct Naive {
  const Mesh& mesh;
  const Field& field;
  FieldFrame frame = field_frame(mesh);
  DecComplex complex = dec_operators(mesh);

  Vec2 in_frame(Vec2 p) const { return (1 / frame.half_size) * (p - frame.center); }
  static Vec2 at(Vec2 a, Vec2 b, double t) { return a + t * (b - a); }

  Vec2 mean_gradient(Vec2 a, Vec2 b) const {
    constexpr int kSteps = 400;
    Vec2 sum;
    for (int i = 0; i < kSteps; ++i) {
      const Vec3 gradient = field.at(in_frame(at(a, b, (i + 0.5) / kSteps))).gradient;
      sum = sum + (1.0 / kSteps) * Vec2{gradient.x, gradient.y};
    }
    return sum;
  }
  /// ∫ u over the signed triangle, in units of the frame, by 32² similar ones.
  double integral(Vec2 a, Vec2 b, Vec2 c) const {
    constexpr int kSteps = 32;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; i + j < kSteps; ++j) {
        const auto add = [&](double s, double t) {
          sum += field.at(in_frame(a + (s / kSteps) * (b - a) + (t / kSteps) * (c - a))).u;
        };
        add(i + 1.0 / 3, j + 1.0 / 3);
        if (i + j + 1 < kSteps) add(i + 2.0 / 3, j + 2.0 / 3);
      }
    }
    const double doubled = cross(in_frame(b) - in_frame(a), in_frame(c) - in_frame(a));
    return 0.5 * doubled * sum / (kSteps * kSteps);
  }
};

TEST(ErrorTwins, StarsAreIntegralsOverCellsAgainstIntegralsOverDuals) {
  const Field& field = all_fields()[5];
  const Mesh mesh = wild_mesh(3e-4);
  const ErrorReport report = verified(mesh, {.fields = {std::string(field.field.name)}, .local = true});
  const Naive naive{mesh, field};
  const auto size = size_of(field);

  std::vector<double> cells(mesh.n_vertices(), 0.0), unsigned_areas(mesh.n_vertices(), 0.0);
  std::size_t e = 0;
  double square1 = 0, area = 0;
  for (const DecEdge& edge : naive.complex.edges) {
    const Vec2 from = mesh.position(edge.from), to = mesh.position(edge.to);
    const Vec2 right = edge.right.valid() ? naive.complex.orthocenters[edge.right] : edge.midpoint;
    const Vec2 left = edge.left.valid() ? naive.complex.orthocenters[edge.left] : edge.midpoint;
    const double error = length(naive.mean_gradient(right, left) - naive.mean_gradient(from, to)) / size.gradient;
    EXPECT_NEAR(report.local[1][e], error, 1e-4 * (1 + error)) << "edge " << e;
    square1 += edge.length * std::abs(edge.dual_length) * error * error;
    for (const auto& [a, b] : {std::pair{edge.midpoint, left}, std::pair{right, edge.midpoint}}) {
      cells[edge.from.index] += naive.integral(from, a, b);
      cells[edge.to.index] -= naive.integral(to, a, b);
    }
    const double heights = std::abs(edge.left_height) + std::abs(edge.right_height);
    unsigned_areas[edge.from.index] += 0.5 * std::abs(edge.crossing) * heights;
    unsigned_areas[edge.to.index] += 0.5 * std::abs(edge.length - edge.crossing) * heights;
    ++e;
  }
  const double unit = naive.frame.half_size * naive.frame.half_size;
  for (const VertexId v : mesh.vertices()) {
    const double expected = naive.complex.star0[v] / unit * field.at(naive.in_frame(mesh.position(v))).u;
    const double error = std::abs(cells[v.index] - expected) / (unsigned_areas[v.index] / unit) / size.value;
    EXPECT_NEAR(report.local[0][v.index], error, 1e-4 * (1 + error)) << "vertex " << v.index;
  }
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const double mean =
        naive.integral(mesh.position(a), mesh.position(b), mesh.position(c)) / (naive.complex.areas[t] / unit);
    const double error = std::abs(mean - field.at(naive.in_frame(naive.complex.orthocenters[t])).u) / size.value;
    EXPECT_NEAR(report.local[2][t.index], error, 1e-4 * (1 + error)) << "triangle " << t.index;
    area += naive.complex.areas[t];
  }
  EXPECT_NEAR(report.fields[0].errors.star[1].l2, std::sqrt(square1 / (2 * area)), 1e-4);
  EXPECT_EQ(report.fields[0].errors.star[0].max, *std::max_element(report.local[0].begin(), report.local[0].end()));
}

/// Gauss-Seidel: needs positive definite matrices, and no library.
std::vector<double> relaxed(const std::vector<std::vector<double>>& matrix, const std::vector<double>& right) {
  std::vector<double> x(right.size(), 0.0);
  for (int sweep = 0; sweep < 3000; ++sweep) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      double sum = right[i];
      for (std::size_t j = 0; j < x.size(); ++j) sum -= j == i ? 0 : matrix[i][j] * x[j];
      x[i] = sum / matrix[i][i];
    }
  }
  return x;
}

TEST(ErrorTwins, PoissonOfAnUnweightedMeshIsTheCotangentScheme) {
  const Mesh mesh = lattice({.n = 6, .jitter = 0.15, .weight = 0});
  const Field& field = all_fields()[0];
  const Naive naive{mesh, field};
  const std::size_t n = mesh.n_vertices();
  std::vector<std::vector<double>> matrix(n, std::vector<double>(n, 0.0));
  std::vector<double> cells(n, 0.0), right(n, 0.0);
  double area = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    const std::size_t i = mesh.origin(h).index, j = mesh.target(h).index;
    const Vec2 p = naive.in_frame(mesh.position(mesh.origin(h))), q = naive.in_frame(mesh.position(mesh.target(h)));
    const Vec2 r = naive.in_frame(mesh.position(mesh.opposite(h)));
    const double cotangent = dot(p - r, q - r) / cross(p - r, q - r);
    for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, i}}) {
      matrix[a][a] += 0.5 * cotangent;
      matrix[a][b] -= 0.5 * cotangent;
      cells[a] += 0.125 * squared_length(q - p) * cotangent;
    }
    area += cross(q - p, r - p) / 6;
  }
  for (const VertexId v : mesh.vertices()) {
    const auto value = field.at(naive.in_frame(mesh.position(v)));
    right[v.index] = mesh.is_boundary(v) ? value.u : -value.laplacian * cells[v.index];
    if (!mesh.is_boundary(v)) continue;
    std::fill(matrix[v.index].begin(), matrix[v.index].end(), 0.0);
    matrix[v.index][v.index] = 1;
  }
  const std::vector<double> solution = relaxed(matrix, right);
  double sum = 0, most = 0;
  for (const VertexId v : mesh.vertices()) {
    const double error = solution[v.index] - field.at(naive.in_frame(mesh.position(v))).u;
    sum += cells[v.index] * error * error;
    most = std::max(most, std::abs(error));
  }
  const ErrorReport report = verified(mesh, {.fields = {"product"}});
  ASSERT_GT(most, 1e-4);
  EXPECT_NEAR(report.fields[0].errors.poisson.max, most / size_of(field).value, 1e-10);
  EXPECT_NEAR(report.fields[0].errors.poisson.l2, std::sqrt(sum / area) / size_of(field).value, 1e-10);
}

TEST(ErrorTwins, TwoPointFluxIsDifferencesOverDistances) {
  const Mesh mesh = lattice({.n = 5, .jitter = 0.05, .weight = 0.05});
  const Field& field = all_fields()[7];  // cubic: −∫ Δu is exact at the centroid
  const Naive naive{mesh, field};
  const std::size_t n = mesh.n_triangles();
  std::vector<std::vector<double>> matrix(n, std::vector<double>(n, 0.0));
  std::vector<double> right(n, 0.0), areas(n, 0.0);
  std::vector<Vec2> centers;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    centers.push_back(naive.in_frame(orthocenter(mesh.point(a), mesh.point(b), mesh.point(c))));
    const Vec2 p = naive.in_frame(mesh.position(a)), q = naive.in_frame(mesh.position(b));
    const Vec2 r = naive.in_frame(mesh.position(c));
    areas[t.index] = 0.5 * cross(q - p, r - p);
    right[t.index] = -areas[t.index] * field.at((1.0 / 3) * (p + q + r)).laplacian;
  }
  for (const HalfedgeId h : mesh.halfedges()) {
    const std::size_t t = Mesh::triangle(h).index;
    const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h));
    const double face = length(naive.in_frame(b.position()) - naive.in_frame(a.position()));
    if (mesh.is_boundary(h)) {
      const double crossing = dual_crossing(a, b) / length(b.position() - a.position());
      const Vec2 foot = naive.in_frame(a.position() + crossing * (b.position() - a.position()));
      const double coefficient = face / length(centers[t] - foot);
      matrix[t][t] += coefficient;
      right[t] += coefficient * field.at(foot).u;
    } else {
      const std::size_t other = Mesh::triangle(mesh.twin(h)).index;
      matrix[t][t] += face / length(centers[t] - centers[other]);
      matrix[t][other] -= face / length(centers[t] - centers[other]);
    }
  }
  const std::vector<double> solution = relaxed(matrix, right);
  double sum = 0, most = 0, area = 0;
  for (std::size_t t = 0; t < n; ++t) {
    const double error = solution[t] - field.at(centers[t]).u;
    sum += areas[t] * error * error;
    area += areas[t];
    most = std::max(most, std::abs(error));
  }
  const ErrorReport report = verified(mesh, {.fields = {"cubic"}});
  ASSERT_TRUE(report.flux.m_matrix);
  ASSERT_GT(most, 1e-4);
  EXPECT_NEAR(report.fields[0].errors.flux.max, most / size_of(field).value, 1e-10);
  EXPECT_NEAR(report.fields[0].errors.flux.l2, std::sqrt(sum / area) / size_of(field).value, 1e-10);
}

// --- matrices --------------------------------------------------------------------------------------------------------

TEST(ErrorMatrices, AreMMatricesExactlyWhenNoSignIsWrong) {
  const ErrorReport good = verified(lattice({.n = 6}), {.condition = true});
  EXPECT_TRUE(good.poisson.m_matrix && good.flux.m_matrix && good.poisson.definite && good.flux.definite);
  EXPECT_EQ(good.poisson.negative + good.flux.negative, 0u);
  EXPECT_EQ(good.poisson.unknowns, 16u);
  EXPECT_EQ(good.flux.unknowns, 50u);
  EXPECT_GT(*good.poisson.condition, 1);
  EXPECT_GT(*good.flux.condition, 1);

  Mesh lifted = lattice({.n = 6});
  lifted.set_weight(VertexId(std::size_t{14}), 1.2);  // in the middle: it hides its neighbors
  const ErrorReport bad = verified(lifted);
  const Quality measured = quality(lifted);
  EXPECT_GT(measured.non_regular_edges, 0u);
  EXPECT_EQ(bad.non_regular_edges, measured.non_regular_edges);
  EXPECT_EQ(bad.poisson.negative, measured.non_regular_edges);  // none is between boundary vertices
  EXPECT_EQ(bad.flux.negative, measured.non_regular_edges + measured.negative_boundary_duals);
  EXPECT_FALSE(bad.poisson.m_matrix || bad.flux.m_matrix);
  EXPECT_NEAR(bad.flux.largest_over_median, measured.max_transmissibility_over_median,
              1e-9 * bad.flux.largest_over_median);
}

TEST(ErrorMatrices, CellsWhoseOrthocentersCoincideAreOne) {
  const Mesh grid = *sheared_grid({.nx = 6, .ny = 6, .shear = 0});
  const ErrorReport report = verified(grid);
  EXPECT_EQ(report.flux.merged, 36u);
  EXPECT_EQ(report.flux.unknowns, 36u);
  EXPECT_TRUE(std::isinf(report.flux.largest_over_median));
  EXPECT_TRUE(report.flux.m_matrix && report.flux.definite);
  // The five-point scheme on squares: second order, as at the vertices.
  const ErrorReport family = verified(grid, {.fields = {"bump"}, .refine = 3});
  EXPECT_NEAR(arithmetic_mean(family.orders).flux.l2, 2, 0.1);
  EXPECT_NEAR(arithmetic_mean(family.orders).poisson.l2, 2, 0.1);
  EXPECT_LT(verified(grid, {.fields = {"linear"}}).fields[0].errors.flux.max, 1e-12);
}

TEST(ErrorMatrices, OrthocentersOnTheBoundaryHaveItsValue) {
  // A right angle opposite to a boundary edge, twice: nothing is left to solve for.
  const Mesh square = mesh_of({{0, 0}, {2, 0}, {1, 1}, {1, -1}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_EQ(verified(square).flux.unknowns, 1u);  // around the diagonal both orthocenters are its midpoint
  const Mesh corner = one_triangle({0, 0}, {1, 0}, {0, 1});
  const ErrorReport report = verified(corner);
  EXPECT_EQ(report.flux.unknowns, 0u);
  EXPECT_EQ(report.poisson.unknowns, 0u);
  EXPECT_LT(report.fields[0].errors.flux.max, 1e-15);
  EXPECT_EQ(report.fields[0].errors.poisson.max, 0);
}

TEST(ErrorMatrices, FarOrthocentersGiveInfiniteErrorsNotNaN) {
  const Mesh flat = one_triangle({0, 0}, {1, 0}, {0.5, 1e-9});
  const ErrorReport report = verified(flat);
  for (const FieldErrors& row : report.fields) {
    for (const ErrorMeasure& measure : error_measures()) {
      EXPECT_FALSE(std::isnan(measure.of(row.errors))) << row.field.name << " " << measure.key;
    }
  }
}

// --- comparisons and options -----------------------------------------------------------------------------------------

TEST(ErrorComparison, IsErrorsOverErrors) {
  const Mesh coarse = lattice({.n = 5, .jitter = 0}), same = coarse;
  Mesh moved = coarse;
  for (const VertexId v : moved.vertices()) moved.set_weight(v, moved.weight(v) * 2);
  const ErrorReport before = verified(coarse), after = verified(moved);
  const auto ratios = error_ratios(after, before);
  ASSERT_TRUE(ratios);
  for (std::size_t i = 0; i < ratios->size(); ++i) {
    EXPECT_DOUBLE_EQ((*ratios)[i].errors.star[1].l2,
                     after.fields[i].errors.star[1].l2 / before.fields[i].errors.star[1].l2);
  }
  EXPECT_GT(geometric_mean(*ratios).star[1].l2, 1);
  const double whole = std::log(geometric_mean(*ratios).flux.l2) * 9;
  const double parts = std::log(geometric_mean(*ratios, FieldGroup::chosen).flux.l2) * 4 +
                       std::log(geometric_mean(*ratios, FieldGroup::held_back).flux.l2) * 5;
  EXPECT_NEAR(whole, parts, 1e-10);
  const auto none = error_ratios(before, verified(same));
  for (const ErrorMeasure& measure : error_measures()) EXPECT_EQ(measure.of(geometric_mean(*none)), 1);
}

TEST(ErrorComparison, KnowsZeroAndInfinity) {
  ErrorReport a, b;
  a.fields = b.fields = {{error_fields()[0], {}}};
  a.fields[0].errors.flux = {HUGE_VAL, 0};
  b.fields[0].errors.flux = {1, 0};
  a.fields[0].errors.poisson = {3, 1};
  b.fields[0].errors.poisson = {HUGE_VAL, 0};
  const OperatorErrors ratios = error_ratios(a, b)->front().errors;
  EXPECT_EQ(ratios.flux.l2, HUGE_VAL);
  EXPECT_EQ(ratios.flux.max, 1);
  EXPECT_EQ(ratios.poisson.l2, 0);
  EXPECT_EQ(ratios.poisson.max, HUGE_VAL);
}

TEST(ErrorComparison, RefusesOtherFieldsAndOtherFrames) {
  const Mesh mesh = lattice();
  const ErrorReport report = verified(mesh);
  EXPECT_FALSE(error_ratios(report, verified(mesh, {.fields = {"chosen"}})));
  EXPECT_FALSE(error_ratios(report, verified(mesh, {.frame = FieldFrame{{0, 0}, 3}})));
  EXPECT_TRUE(error_ratios(report, verified(lattice({.seed = 4}), {.frame = report.frame})));
}

TEST(ErrorOptionErrors, AreNamed) {
  const Mesh mesh = lattice();
  const auto message = [](const Mesh& m, const MeasureErrorsOptions& options) {
    const auto report = measure_errors(m, options);
    return report ? std::string("none") : std::string(name(report.error().code)) + ": " + report.error().message;
  };
  EXPECT_TRUE(message(mesh, {.fields = {"sine"}}).starts_with("invalid_option: no field 'sine'"));
  EXPECT_EQ(message(mesh, {.refine = -1}), "invalid_option: refine is negative");
  EXPECT_EQ(message(mesh, {.refine = 100}), "invalid_option: refining 100 times makes more than 8000000 triangles");
  EXPECT_TRUE(message(mesh, {.frame = FieldFrame{{0, 0}, 0}}).starts_with("invalid_option: the frame"));
  EXPECT_TRUE(message(mesh, {.frame = FieldFrame{{NAN, 0}, 1}}).starts_with("invalid_option: the frame"));
  EXPECT_EQ(message(Mesh(), {}), "empty_input: the mesh has no triangles");
}

}  // namespace
}  // namespace temper::test

// The user's own problem: solutions that both schemes reproduce, orders of convergence, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "temper/errors.hpp"
#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper {
namespace {

/// A well-centered mesh of the unit square.
Mesh square(std::size_t n) {
  Mesh mesh = *random_mesh({.vertices = n, .seed = 4, .polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
  static_cast<void>(optimize(mesh));
  return mesh;
}

/// The boundary edges with their middle where the test holds.
template <class Test>
BoundaryValue piece(const Mesh& mesh, double value, bool is_flux, const Test& test) {
  BoundaryValue part{{}, value, is_flux};
  for (const HalfedgeId h : mesh.halfedges()) {
    const Vec2 middle = 0.5 * (mesh.position(mesh.origin(h)) + mesh.position(mesh.target(h)));
    if (mesh.is_boundary(h) && test(middle)) part.edges.push_back({mesh.target(h), mesh.origin(h)});
  }
  EXPECT_FALSE(part.edges.empty());
  return part;
}
bool on_left(Vec2 p) { return p.x < 1e-9; }
bool on_right(Vec2 p) { return p.x > 1 - 1e-9; }

constexpr double kRounding = 1e-10;

TEST(Diffusion, BothSchemesReproduceALinearHead) {
  const Mesh mesh = square(200);
  for (const bool flux : {false, true}) {
    DiffusionProblem problem;
    problem.coefficient.assign(mesh.n_triangles(), 2.5);
    problem.boundary = {piece(mesh, flux ? 2.5 * 3 : 4, flux, on_left), piece(mesh, 1, false, on_right)};
    const DiffusionErrors errors = *measure_diffusion_errors(mesh, problem, 2);
    EXPECT_LT(errors.vertex.max, kRounding);
    EXPECT_LT(errors.cell.max, kRounding);
    EXPECT_LT(errors.reference.max, kRounding);
    EXPECT_NEAR(errors.least, 1, kRounding);
    EXPECT_NEAR(errors.largest, 4, kRounding);
    EXPECT_TRUE(errors.vertex_system.m_matrix && errors.cell_system.m_matrix);
  }
}

TEST(Diffusion, ErrorsOfASourceFallWithTheSquareOfTheSize) {
  double last_vertex = 0, last_cell = 0;
  for (const std::size_t n : {100u, 1600u}) {
    const Mesh mesh = square(n);
    DiffusionProblem problem;
    for (const VertexId v : mesh.vertices()) {
      problem.source.push_back(1 + std::sin(3 * mesh.position(v).x));
    }
    problem.boundary = {piece(mesh, 0, false, on_left), piece(mesh, 0.5, false, on_right)};
    const DiffusionErrors errors = *measure_diffusion_errors(mesh, problem, 2);
    EXPECT_LT(errors.reference.l2, errors.cell.l2);
    if (n > 100) {
      EXPECT_LT(errors.vertex.l2, last_vertex / 8) << "four times finer";
      EXPECT_LT(errors.cell.l2, last_cell / 6);
    }
    last_vertex = errors.vertex.l2, last_cell = errors.cell.l2;
  }
}

TEST(Diffusion, ABadMeshHasLargerErrors) {
  const Mesh bad = *random_mesh({.vertices = 300, .seed = 9});
  Mesh good = bad;
  ASSERT_TRUE(optimize(good));
  const auto errors = [](const Mesh& mesh) {
    DiffusionProblem problem;
    problem.source.assign(mesh.n_vertices(), 1.0);
    problem.boundary = {piece(mesh, 0, false, [](Vec2) { return true; })};
    return *measure_diffusion_errors(mesh, problem);
  };
  const DiffusionErrors before = errors(bad), after = errors(good);
  EXPECT_GT(before.vertex_system.negative + before.cell_system.negative, 0u);
  EXPECT_EQ(after.cell_system.negative, 0u);
  EXPECT_LT(after.cell.l2, 0.7 * before.cell.l2);
}

TEST(Diffusion, WrongProblemsAreNamed) {
  const Mesh mesh = *random_mesh({.vertices = 30, .seed = 1});
  DiffusionProblem problem;
  problem.boundary = {piece(mesh, 1, false, on_left)};
  const auto message = [&](const DiffusionProblem& wrong, int refinements = 2) {
    const auto result = measure_diffusion_errors(mesh, wrong, refinements);
    EXPECT_FALSE(result);
    return result ? std::string() : result.error().message;
  };
  EXPECT_TRUE(measure_diffusion_errors(mesh, problem, 1));
  EXPECT_EQ(message(problem, 12), "refining 12 times makes more than 4000000 triangles");
  DiffusionProblem wrong = problem;
  wrong.source = {1, 2};
  EXPECT_EQ(message(wrong), "expected a source for each of the 30 vertices, found 2");
  wrong = problem;
  wrong.coefficient.assign(mesh.n_triangles(), -1.0);
  EXPECT_EQ(message(wrong), "triangle 0 has the coefficient -1; expected a finite number above 0");
  wrong = problem;
  wrong.boundary[0].is_flux = true;
  EXPECT_EQ(message(wrong), "no boundary edge has a value of u, so u is known up to a constant only");
  wrong = problem;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_boundary(h)) wrong.boundary[0].edges = {{mesh.origin(h), mesh.target(h)}};
  }
  EXPECT_TRUE(message(wrong).find("is not on the boundary of the mesh") != std::string::npos);
  wrong.boundary[0] = problem.boundary[0];
  wrong.boundary[0].value = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(message(wrong), "a value on the boundary is not finite");
}

}  // namespace
}  // namespace temper

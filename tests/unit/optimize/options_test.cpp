// Options that make no sense are named, and leave the mesh as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/lattice.hpp"
#include "temper/optimize.hpp"

namespace temper::test {
namespace {

std::string error_of(const OptimizeOptions& options) {
  Mesh mesh = lattice();
  const Mesh before = mesh;
  const auto report = optimize(mesh, options);
  EXPECT_EQ(mesh, before);
  if (report) return "no error";
  EXPECT_EQ(report.error().code, ErrorCode::invalid_option);
  return report.error().what();
}

TEST(OptimizeOptions, OutOfRangeAreRefusedByName) {
  EXPECT_EQ(error_of({.star = Star::all}),
            "star is all, which is of objective accuracy; of an energy expected 0, 1 or 2");
  EXPECT_EQ(error_of({.paper = {.gamma = Softening{0}}}), "gamma is 0; expected a positive number");
  EXPECT_EQ(error_of({.paper = {.gamma = Softening{NAN}}}), "gamma is nan; expected a positive number");
  EXPECT_EQ(error_of({.paper = {.h0 = Softening{-1}}}), "h0 is -1; expected −h° ≥ 0");
  EXPECT_EQ(error_of({.paper = {.overshoot = 0.5}}), "overshoot is 0.5; expected at least 1");
  EXPECT_EQ(error_of({.paper = {.relaxation = 2}}), "relaxation is 2; expected a number between 0 and 2");
  EXPECT_EQ(error_of({.paper = {.anchor = VertexId(25)}}), "anchor is vertex 25, but the mesh has 25 vertices");
  EXPECT_EQ(error_of({.max_sweeps = -1}), "max sweeps is -1; expected at least 0");
  EXPECT_EQ(error_of({.paper = {.tolerance = NAN}}), "tolerance is nan; expected at least 0");
  EXPECT_EQ(error_of({.time_limit = -1}), "time limit is -1; expected at least 0");
}

TEST(OptimizeOptions, AHardBarrierOutsideItsDomainIsRefused) {
  Mesh mesh = lattice({.jitter = 0.45, .weight = 0});
  const Mesh before = mesh;
  const auto report = optimize(mesh, {.energy = EnergyKind::BH});
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().what().find("energy BH is infinite on this mesh"), std::string::npos);
  EXPECT_EQ(mesh, before);
}

TEST(OptimizeOptions, AVertexHiddenByItsWeightIsNamed) {
  Mesh mesh = lattice();
  mesh.set_weight(VertexId(12), -50);
  const Mesh before = mesh;
  const auto report = optimize(mesh);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::hidden_vertex);
  EXPECT_EQ(report.error().what(),
            "weights hide point 12 (weight -50); expected weights that leave every vertex a power cell");
  EXPECT_EQ(mesh, before);
}

}  // namespace
}  // namespace temper::test

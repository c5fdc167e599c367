// The way into the optimizer's units and back is exact.
#include <gtest/gtest.h>

#include "optimize/working/input_mesh.hpp"
#include "optimize/working/working_units.hpp"
#include "support/lattice.hpp"
#include "temper/generate.hpp"

namespace temper::test {
namespace {

class FrameRoundTrip : public testing::TestWithParam<LatticeOptions> {};

TEST_P(FrameRoundTrip, IsBitForBit) {
  const Mesh mesh = lattice(GetParam());
  const WorkingUnits units = WorkingUnits::of(mesh);
  Mesh there = mesh;
  units.enter(there);
  for (const VertexId v : there.vertices()) {
    EXPECT_LE(std::abs(there.position(v).x), 16);
    EXPECT_LE(std::abs(there.position(v).y), 16);
    EXPECT_EQ(units.snap(there.position(v)), there.position(v));
  }
  units.leave(there);
  EXPECT_EQ(there, mesh);
}

INSTANTIATE_TEST_SUITE_P(Everywhere, FrameRoundTrip,
                         testing::Values(LatticeOptions{}, LatticeOptions{.offset = {1e6, -3e6}},
                                         LatticeOptions{.offset = {-7, 0}}, LatticeOptions{.scale = 1e-12},
                                         LatticeOptions{.scale = 1e12},
                                         LatticeOptions{.scale = 3, .offset = {1e9, 1e9}},
                                         LatticeOptions{.scale = 1e-3, .offset = {1, 0.001}}));

TEST(WorkingUnits, KeepsTheSignOfAZero) {
  Mesh mesh = lattice({});
  const VertexId v(0);
  mesh.set_point(v, {-0.0, -0.0, -0.0});
  const WorkingUnits units = WorkingUnits::of(mesh);
  units.enter(mesh);
  units.leave(mesh);
  EXPECT_TRUE(std::signbit(mesh.position(v).x) && std::signbit(mesh.position(v).y) && std::signbit(mesh.weight(v)));
}

TEST(WorkingUnits, SnapsToWhatTheUsersCoordinatesCanHold) {
  const Mesh mesh = lattice({.offset = {1e6, 1e6}});
  const WorkingUnits units = WorkingUnits::of(mesh);
  Noise noise(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 p = units.snap(Vec2{noise(), noise()});
    const double user = p.x * units.scale + units.center.x;
    EXPECT_EQ((user - units.center.x) / units.scale, p.x);
  }
}

TEST(InputMesh, ComesBackBitForBit) {
  for (const std::size_t n : {400u, 33000u}) {
    const Mesh original = *random_mesh({.vertices = n, .seed = 4});
    const Mesh expected = WorkingCopy(original, SweepOrder::hilbert).mesh;
    Mesh mesh = original;
    {
      InputMesh input(mesh, true, SweepOrder::hilbert, nullptr);
      EXPECT_EQ(input.copy().mesh, expected);
      EXPECT_EQ(input.whole(), original);
      for (int i = 0; i < 2; ++i) EXPECT_EQ(input.copy().mesh, expected);
      EXPECT_LT(mesh.memory_bytes(), original.memory_bytes());
    }
    EXPECT_EQ(mesh, original);
  }
}

}  // namespace
}  // namespace temper::test

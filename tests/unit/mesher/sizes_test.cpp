// Sizes and what is decided without them: shortcuts may change no mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/rng.hpp"
#include "mesher/divided_outline.hpp"
#include "mesher/graded_size.hpp"
#include "outlines.hpp"

namespace temper::test {
namespace {

using mesher::GradedSize;
using mesher::SizeSource;
using mesher::WantedSize;

constexpr double kGrade = 0.3;

/// Places in a square or on a sphere, half of them on a lattice, so that many have equal coordinates.
Vec3 random_place(const Space& space, Rng& rng) {
  const bool on_lattice = rng.uniform() < 0.5;
  const auto coordinate = [&] {
    const double x = 20 * rng.uniform() - 10;
    return on_lattice ? std::round(x) : x;
  };
  const Vec3 p = {coordinate(), coordinate(), space.is_plane() ? 0 : coordinate()};
  return space.is_plane() ? p : (space.radius() / std::max(length(p), 1e-3)) * p;
}

TEST(MesherSizes, AreTheLeastOverAllSourcesBitForBit) {
  for (const Space& space : {Space(), Space::sphere(10)}) {
    const Surface surface(space);
    for (const std::size_t n : {0, 1, 8, 9, 33, 1000}) {
      Rng rng(n + 1);
      std::vector<SizeSource> sources;
      for (std::size_t i = 0; i < n; ++i) sources.push_back({random_place(space, rng), 3 * rng.uniform()});
      const WantedSize wanted = {2, nullptr};
      const GradedSize size(surface, sources, wanted, kGrade);
      for (int i = 0; i < 300; ++i) {
        const Vec3 x = random_place(space, rng);
        double least = wanted.most;
        for (const SizeSource& s : sources) least = std::min(least, s.size + kGrade * length(x - s.at));
        EXPECT_EQ(size(x), least) << n << " sources";
      }
    }
  }
}

// The number of pieces is the integral of 1/size, in which a quarter more than a piece is still one.
TEST(MesherSizes, DecideHowManyPiecesAnEdgeHas) {
  const Surface surface{Space()};
  const Observer nobody;
  mesher::Deadline deadline(0, nobody);
  int whole = 0, divided_ones = 0;
  Rng rng(5);
  for (int i = 0; i < 2000; ++i) {
    mesher::Arrangement edge;
    edge.places = {{0, 0, 0}, {1, 0, 0}};
    edge.edges.push_back({{0, 1}, {}, {}, 0, {}});
    std::vector<SizeSource> sources;
    for (int k = 0; k < 3; ++k) sources.push_back({{rng.uniform(), 0.2 * rng.uniform(), 0}, 0.6 + 0.8 * rng.uniform()});
    const GradedSize size(surface, sources, {1.2, nullptr}, kGrade);
    constexpr int kSteps = 500;
    double integral = 0;
    for (int k = 0; k < kSteps; ++k) integral += 1 / size({(k + 0.5) / kSteps, 0, 0}) / kSteps;
    if (std::abs(integral - 1.25) < 2e-3) continue;  // the sum of the mesher has longer steps
    const mesher::DividedOutline divided = mesher::divide(edge, size, {0, 0}, 100, deadline);
    EXPECT_EQ(divided.pieces.size(), integral < 1.25 ? 1U : 2U) << "integral " << integral;
    (integral < 1.25 ? whole : divided_ones) += 1;
  }
  EXPECT_GT(whole, 200);
  EXPECT_GT(divided_ones, 200);
}

/// A square with points whose sizes differ much.
Outline wells_of_many_sizes() {
  Outline outline = square();
  Rng rng(3);
  for (std::int32_t i = 4; i < 60; ++i) {
    outline.points.push_back({0.05 + 0.9 * rng.uniform(), 0.05 + 0.9 * rng.uniform()});
    outline.sizes.push_back({{i, i}, 0.03 * rng.uniform() * rng.uniform() + 0.001});
  }
  return outline;
}

// An area with a size of its own asks for all sizes, since they jump at its border. This one is smaller by rounding.
TEST(MesherSizes, PointsThatAreRefusedWithoutTheirSizesHadBeenRefused) {
  std::vector<NamedOutline> all = outlines();
  all.push_back({"wells", wells_of_many_sizes()});
  for (const NamedOutline& named : all) {
    if (!named.outline.regions.empty()) continue;
    for (const double grade : {0.1, kGrade, 0.45, 0.6}) {
      SCOPED_TRACE(named.name + ", grade " + std::to_string(grade));
      MesherOptions options = of_size((named.name == "wells" ? 0.2 : 0.021) * extent(named.outline));
      options.grade = grade;
      options.optimize.reset();
      const Expected<OutlineMesh> quick = mesh_outline(named.outline, options);
      options.region_sizes = {{0, options.size * (1 - 1e-15)}};
      const Expected<OutlineMesh> slow = mesh_outline(named.outline, options);
      ASSERT_TRUE(quick.has_value() && slow.has_value());
      EXPECT_EQ(quick->mesh.n_vertices(), slow->mesh.n_vertices());
    }
  }
}

}  // namespace
}  // namespace temper::test

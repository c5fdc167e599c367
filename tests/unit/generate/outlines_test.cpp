// Real outlines, read in place where they are: Triangle's .poly files, with holes given by the segments alone.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

struct Poly {
  std::vector<Vec2> points;
  std::vector<std::array<std::int32_t, 2>> segments;
};

Poly read_poly(const std::filesystem::path& path) {
  std::ifstream in(path);
  Poly poly;
  std::map<long, std::int32_t> index;
  std::size_t n = 0, m = 0;
  std::string line;
  std::getline(in, line);
  std::istringstream(line) >> n;
  while (poly.points.size() < n && std::getline(in, line)) {
    long number = 0;
    Vec2 p;
    std::istringstream(line) >> number >> p.x >> p.y;
    index[number] = static_cast<std::int32_t>(poly.points.size());
    poly.points.push_back(p);
  }
  std::getline(in, line);
  std::istringstream(line) >> m;
  while (poly.segments.size() < m && std::getline(in, line)) {
    long number = 0, a = 0, b = 0;
    std::istringstream(line) >> number >> a >> b;
    poly.segments.push_back({index.at(a), index.at(b)});
  }
  return poly;
}

TEST(Outlines, AreFilledByAConstrainedDelaunayTriangulation) {
  const std::filesystem::path folder = TEMPER_SHARED "/outlines";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  int outlines = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".poly") continue;
    const Poly poly = read_poly(entry.path());
    const auto mesh = constrained_delaunay({poly.points, poly.segments});
    ASSERT_TRUE(mesh) << entry.path() << ": " << mesh.error().what();
    EXPECT_EQ(mesh->validate(), std::nullopt);
    EXPECT_EQ(mesh->n_vertices(), poly.points.size());
    EXPECT_EQ(count_non_regular_edges(*mesh, false), 0u);
    for (const auto& [a, b] : poly.segments) {
      const VertexId u(static_cast<std::size_t>(a)), v(static_cast<std::size_t>(b));
      EXPECT_TRUE(mesh->find_halfedge(u, v).valid() || mesh->find_halfedge(v, u).valid()) << entry.path();
    }
    ++outlines;
  }
  EXPECT_GT(outlines, 3);
}

}  // namespace
}  // namespace temper

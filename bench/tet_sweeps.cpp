// The cost of sweeps over tetrahedra, as a multiple of their kernel: value, gradient and Hessian of each star.
//
//   bench_tet_sweeps IN
//
// Times are processor time of one thread. Both are measured in turn, and the least of several rounds counts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "child.hpp"
#include "options.hpp"
#include "temper/io.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/sweeper.hpp"

namespace temper::bench {
namespace {

template <class Work>
double seconds_of(Work&& work) {
  const double start = cpu_seconds();
  work();
  return cpu_seconds() - start;
}

constexpr int kRounds = 5;           // of one γ
constexpr int kTimes = 40;           // of each kernel, which finds its input at hand
constexpr std::size_t kStride = 16;  // between the vertices whose kernels are timed

/// Seconds of the kernels of all stars, from some of them.
double kernel_seconds(const tets::TetMesh& mesh, const std::vector<VertexId>& vertices, double gamma) {
  std::vector<tets::HalffaceId> halffaces;
  std::vector<tets::LinkLanes> lanes;
  double seconds = 0, sum = 0;
  std::size_t stars = 0;
  for (std::size_t i = 0; i < vertices.size(); i += kStride, ++stars) {
    tets::collect_link(mesh, vertices[i], halffaces);
    const tets::Link link = tets::gather(mesh, halffaces, lanes);
    const tets::WeightedPoint p = mesh.point(vertices[i]);
    seconds += seconds_of([&] {
      for (int k = 0; k < kTimes; ++k) sum += tets::kernels().derivatives(link, p, gamma).value;
    });
  }
  if (sum == 0) std::printf("no energy\n");  // so that the sum is used
  return seconds / kTimes * static_cast<double>(vertices.size()) / static_cast<double>(stars);
}

tets::TetMesh mesh_of(const std::string& path) {
  auto file = io::read(path);
  if (!file) fail(file.error().what());
  if (file->dimension() == 2) fail(path + " has no tetrahedra");
  auto loaded = io::make_tet_mesh(*file);
  if (!loaded) fail(loaded.error().what());
  return std::move(loaded->mesh);
}

int run(const std::string& path) {
  tets::TetMesh mesh = mesh_of(path);
  const auto all = mesh.vertices();
  const std::vector<VertexId> vertices(all.begin(), all.end());
  const auto mobility = tets::mobilities(mesh);
  tets::Sweeper sweeper(mesh, mobility, vertices);
  const double to_ns = 1e9 / static_cast<double>(vertices.size());
  std::printf("%zu vertices, %zu tetrahedra\n      γ  kernel    step  measure  ns a vertex and sweep; step/kernel\n",
              mesh.n_vertices(), mesh.n_tetrahedra());
  for (const double gamma : {1.0, 0.1, 0.003}) {
    double kernel = HUGE_VAL, step = HUGE_VAL, measure = HUGE_VAL;
    for (int round = 0; round < kRounds; ++round) {
      kernel = std::min(kernel, kernel_seconds(mesh, vertices, gamma));
      step = std::min(step, seconds_of([&] { sweeper.sweep(tets::SweepParameters{gamma, 1.7}); }));
      measure = std::min(measure, seconds_of([&] { static_cast<void>(tets::state_of(mesh, gamma)); }));
    }
    std::printf("%7.3f %7.0f %7.0f %8.0f %25.2f\n", gamma, to_ns * kernel, to_ns * step, to_ns * measure,
                step / kernel);
  }
  return 0;
}

}  // namespace
}  // namespace temper::bench

int main(int argc, char** argv) {
  if (argc != 2) temper::bench::fail("expected IN");
  return temper::bench::run(argv[1]);
}

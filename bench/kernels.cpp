// Kernels one by one, on the patches and edges of a random mesh; times are an item: a predicate, a patch, a flip.
#include <benchmark/benchmark.h>

#include <vector>

#include "energy/patch.hpp"
#include "fixtures.hpp"
#include "geometry/predicates_inline.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/quality.hpp"
#include "temper/topology.hpp"

namespace temper::bench {
namespace {

struct Quad {
  WeightedPoint a, b, c, d;
};

/// The four points at each inner edge.
std::vector<Quad> quads(const Mesh& mesh) {
  std::vector<Quad> result;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    result.push_back({mesh.point(mesh.origin(h)), mesh.point(mesh.target(h)), mesh.point(mesh.opposite(h)),
                      mesh.point(mesh.opposite(mesh.twin(h)))});
  }
  return result;
}

/// Squares of a grid: every test is a tie, which no filter decides.
std::vector<Quad> cocircular_quads() {
  std::vector<Quad> result;
  for (int j = 0; j < 64; ++j) {
    for (int i = 0; i < 64; ++i) {
      const double x = 0.1 * i, y = 0.1 * j, u = 0.1 * (i + 1), v = 0.1 * (j + 1);
      result.push_back({{x, y, 0.3}, {u, v, 0.3}, {x, v, 0.3}, {u, y, 0.3}});
    }
  }
  return result;
}

/// Calls kernel(item) for all items in turn; reports items a second and the time of one.
template <class Items, class Kernel>
void for_items(benchmark::State& state, const Items& items, Kernel&& kernel) {
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kernel(items[i]));
    if (++i == items.size()) i = 0;
  }
  state.SetItemsProcessed(state.iterations());
}

void orient2d_filter(benchmark::State& state) {
  for_items(state, quads(good_mesh()),
            [](const Quad& q) { return orient2d(q.a.position(), q.b.position(), q.c.position()); });
}
BENCHMARK(orient2d_filter);

void orient2d_exact(benchmark::State& state) {
  for_items(state, quads(good_mesh()),
            [](const Quad& q) { return exact::orient2d(q.a.position(), q.b.position(), q.c.position()); });
}
BENCHMARK(orient2d_exact);

void power_test_filter(benchmark::State& state) {
  for_items(state, quads(good_mesh()), [](const Quad& q) { return power_test(q.a, q.b, q.c, q.d); });
}
BENCHMARK(power_test_filter);

void power_test_exact(benchmark::State& state) {
  for_items(state, quads(good_mesh()), [](const Quad& q) { return exact::power_test(q.a, q.b, q.c, q.d); });
}
BENCHMARK(power_test_exact);

void power_test_of_ties(benchmark::State& state) {
  for_items(state, cocircular_quads(), [](const Quad& q) { return power_test(q.a, q.b, q.c, q.d); });
}
BENCHMARK(power_test_of_ties);

void well_centered(benchmark::State& state) {
  for_items(state, quads(good_mesh()), [](const Quad& q) { return is_well_centered(q.a, q.b, q.c); });
}
BENCHMARK(well_centered);

void gather(benchmark::State& state) {
  const Mesh& mesh = good_mesh();
  const bool with_outer = state.range(0) != 0;
  Patch patch;
  std::size_t v = 0;
  for (auto _ : state) {
    gather_patch(mesh, VertexId(v), with_outer, patch);
    benchmark::DoNotOptimize(patch.link.data());
    if (++v == mesh.n_vertices()) v = 0;
  }
  state.SetLabel(with_outer ? "with heights across the link" : "");
}
BENCHMARK(gather)->Arg(0)->Arg(1);

void patch_value(benchmark::State& state) {
  const EnergyInfo& info = energies()[static_cast<std::size_t>(state.range(0))];
  const EnergyModel model = model_of(info.kind);
  const Mesh& mesh = good_mesh();
  for_items(state, patches(mesh, needs_outer(info.kind)),
            [&](const Patch& patch) { return patch_energy(patch, model, mesh.point(patch.center)); });
  state.SetLabel(std::string(info.name));
}
BENCHMARK(patch_value)->DenseRange(0, 5);

void patch_gradient_and_hessian(benchmark::State& state) {
  const EnergyInfo& info = energies()[static_cast<std::size_t>(state.range(0))];
  const EnergyModel model = model_of(info.kind);
  const Mesh& mesh = good_mesh();
  for_items(state, patches(mesh, needs_outer(info.kind)),
            [&](const Patch& patch) { return patch_derivatives(patch, model, mesh.point(patch.center)); });
  state.SetLabel(std::string(info.name));
}
BENCHMARK(patch_gradient_and_hessian)->DenseRange(0, 5);

void flip_and_back(benchmark::State& state) {
  Mesh mesh = good_mesh();
  std::vector<HalfedgeId> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (can_flip(mesh, h) == FlipStatus::possible) edges.push_back(h);
  }
  for_items(state, edges, [&](HalfedgeId h) {
    const HalfedgeId flipped = flip(mesh, h);
    unflip(mesh, flipped);
    return flipped;
  });
}
BENCHMARK(flip_and_back);

void whole_mesh_energy(benchmark::State& state) {
  const EnergyInfo& info = energies()[static_cast<std::size_t>(state.range(0))];
  const EnergyModel model = model_of(info.kind);
  const Mesh& mesh = good_mesh();
  for (auto _ : state) benchmark::DoNotOptimize(total_energy(mesh, model));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.n_triangles()));
  state.SetLabel(std::string(info.name) + ", items are triangles");
}
BENCHMARK(whole_mesh_energy)->DenseRange(0, 5)->Unit(benchmark::kMicrosecond);

void whole_mesh_quality(benchmark::State& state) {
  const Mesh& mesh = good_mesh();
  for (auto _ : state) benchmark::DoNotOptimize(quality(mesh));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.n_triangles()));
  state.SetLabel("items are triangles");
}
BENCHMARK(whole_mesh_quality)->Unit(benchmark::kMicrosecond);

void hilbert(benchmark::State& state) {
  const Mesh original = *random_mesh({.vertices = kVertices, .seed = 1});
  for (auto _ : state) {
    Mesh mesh = original;
    benchmark::DoNotOptimize(hilbert_order(mesh));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kVertices));
  state.SetLabel("items are vertices");
}
BENCHMARK(hilbert)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace temper::bench

// What runs on threads: each row of the table is a function of the library that takes an executor. It gives the same
// bytes on any number of threads, and to several callers at once who look at one mesh. ThreadSanitizer watches it in a
// stage of scripts/test.sh.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "support/lattice.hpp"
#include "support/shapes.hpp"
#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"
#include "support/thread_communicator.hpp"
#include "temper/detail/location.hpp"
#include "temper/detail/size.hpp"
#include "temper/energy.hpp"
#include "temper/generate.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/regularity.hpp"
#include "temper/tets/optimize.hpp"

namespace temper::test {
namespace {

constexpr std::size_t kManyVertices = 20000;  // several blocks of every loop, several parts of a sweep

template <class T>
std::string bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}
template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return bytes_of(std::span<const T>(values));
}
std::string bytes_of(double value) { return bytes_of(std::span<const double>(&value, 1)); }

std::string bytes_of(const Mesh& mesh) {
  std::string bytes;
  for (const VertexId v : mesh.vertices()) {
    bytes += bytes_of(mesh.position(v).x) + bytes_of(mesh.position(v).y) + bytes_of(mesh.weight(v));
  }
  for (const TriangleId t : mesh.triangles()) {
    const auto corners = mesh.corners(t);
    bytes += bytes_of(std::span<const VertexId>(corners));
  }
  return bytes;
}

/// The mesh that rows look at, another one of the same domain, and one that is well-centered.
struct Meshes {
  Mesh mesh = mesh_with_regions(kManyVertices, 3);
  Mesh moved = shrunk(mesh);
  Mesh well_centered = lattice({.n = 140, .jitter = 0.02, .weight = 0.02});
  io::MeshFile file = io::from_mesh(mesh);

  static Mesh shrunk(Mesh mesh) {
    for (const VertexId v : mesh.vertices()) {
      if (!mesh.is_boundary(v)) mesh.set_position(v, 0.999 * mesh.position(v));
    }
    return mesh;
  }
};

const Meshes& meshes() {
  static const Meshes all;
  return all;
}

std::string optimized(Mesh mesh, OptimizeOptions options, Executor* executor, Communicator* communicator = nullptr) {
  options.max_sweeps = 1;
  OptimizeHooks hooks;
  hooks.executor = executor;
  hooks.communicator = communicator;
  const auto report = optimize(mesh, options, hooks);
  EXPECT_TRUE(report) << report.error().what();
  return bytes_of(mesh);
}

std::string slurped(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Row {
  std::string_view name;
  std::string (*run)(const Meshes& meshes, Executor* executor);

  friend void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }
};

constexpr Row kRows[] = {
    {"build",
     [](const Meshes& m, Executor* e) {
       const auto made = io::make_mesh(m.file, {}, e);
       return made ? bytes_of(made->mesh) : made.error().what();
     }},
    {"hilbert_order", [](const Meshes& m, Executor* e) { return bytes_of(hilbert_ordered(m.mesh, e).mesh); }},
    {"total_energy",
     [](const Meshes& m, Executor* e) {
       return bytes_of(total_energy(m.mesh, {}, e)) + bytes_of(total_energy(m.mesh, {.kind = EnergyKind::T}, e));
     }},
    {"regularity",
     [](const Meshes& m, Executor* e) { return std::to_string(count_non_regular_edges(m.mesh, true, e)); }},
    {"quality",
     [](const Meshes& m, Executor* e) {
       const Quality q = quality(m.mesh, {.executor = e});
       return bytes_of(q.min_h_over_l) + bytes_of(q.min_d_over_l) + bytes_of(q.histograms.angles.counts);
     }},
    {"size",
     [](const Meshes& m, Executor* e) {
       const SizeReport r = measure_size(m.moved, input_size_field_of(m.mesh, e), e);
       return bytes_of(r.over_field.min) + bytes_of(r.over_field.p95) + bytes_of(r.gradation.max);
     }},
    {"location",
     [](const Meshes& m, Executor* e) {
       const auto places = positions_of_vertices(m.mesh, m.moved, {}, e);
       return bytes_of(sources_of_triangles(m.mesh, m.moved, places, e).raw());
     }},
    {"optimize", [](const Meshes& m, Executor* e) { return optimized(m.mesh, {}, e); }},
    {"accuracy",
     [](const Meshes& m, Executor* e) {
       return optimized(m.well_centered, {.objective = Objective::accuracy, .accuracy = {.sweeps = 1}}, e);
     }},
    {"files",
     [](const Meshes& m, Executor* e) {
       const std::filesystem::path file =
           std::filesystem::path(testing::TempDir()) /
           (std::to_string(std::hash<std::thread::id>()(std::this_thread::get_id())) + ".vtu");
       EXPECT_TRUE(io::write(file.string(), m.file, {"", {}, e}));
       const auto read = io::read(file.string(), {e});
       std::string bytes = slurped(file.string()) + (read ? bytes_of(read->points) : read.error().what());
       std::filesystem::remove(file);
       return bytes;
     }},
};

class OnThreads : public testing::TestWithParam<Row> {};

TEST_P(OnThreads, TheBytesAreThoseOfOneThread) {
  const std::string alone = GetParam().run(meshes(), nullptr);
  EXPECT_FALSE(alone.empty());
  for (const std::size_t n : {2, 3, 8}) {
    StdThreads threads(n);
    EXPECT_TRUE(GetParam().run(meshes(), &threads) == alone) << n << " threads";
    EXPECT_GT(threads.runs(), 0u) << "no threads were used: nothing was tested";
  }
}

TEST_P(OnThreads, CallersAtOnceLookAtOneMesh) {
  const std::string alone = GetParam().run(meshes(), nullptr);
  std::string first, second;
  std::thread other([&] { first = GetParam().run(meshes(), nullptr); });
  second = GetParam().run(meshes(), nullptr);
  other.join();
  EXPECT_TRUE(first == alone);
  EXPECT_TRUE(second == alone);
}

TEST(OnRanks, WithThreadsTheBytesAreThoseOfOneProcess) {
  const std::string alone = optimized(meshes().mesh, {}, nullptr);
  on_ranks(3, [&](Communicator& communicator) {
    StdThreads threads(2);
    EXPECT_TRUE(optimized(meshes().mesh, {}, &threads, &communicator) == alone);
  });
}

INSTANTIATE_TEST_SUITE_P(Rows, OnThreads, testing::ValuesIn(kRows),
                         [](const auto& row) { return std::string(row.param.name); });

/// Sweeps over all vertices, and searches in patches: some tetrahedra of this cube stay bad without.
TEST(Threads, TetrahedraHaveTheSameBytes) {
  const tets::TetMesh input = mesh_of(shaken(cubes(3, kSixTets), 0.3, 0));
  OptimizeOptions options;
  options.tets.repair_trials = 1;
  tets::TetMesh one = input, many = input;
  StdThreads threads(3);
  ASSERT_TRUE(tets::optimize(one, options));
  tets::OptimizeHooks hooks;
  hooks.executor = &threads;
  hooks.observer = [](const Progress&) { return Continue::yes; };
  const auto report = tets::optimize(many, options, hooks);
  ASSERT_TRUE(report);
  EXPECT_GT(report->vertices_inserted, 5U);
  EXPECT_EQ(one, many);
}

}  // namespace
}  // namespace temper::test

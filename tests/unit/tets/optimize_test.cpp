// Sweeps over meshes of tetrahedra: what stays, what falls, and how a run ends.
#include "temper/tets/optimize.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "support/std_threads.hpp"
#include "support/tet_lattice.hpp"
#include "temper/detail/instruction_set.hpp"
#include "temper/tets/quality.hpp"
#include "tets/energy/hot.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/sweeper.hpp"
#include "tets/optimize/violations.hpp"

namespace temper::tets {
namespace {

/// The body-centered lattice with inner vertices off their places.
test::TetArrays input_arrays() {
  test::TetArrays arrays = test::shaken(test::body_centered(4), 0.18, 0.1);
  const test::TetArrays exact = test::body_centered(4);
  const TetMesh mesh = test::mesh_of(exact);
  const auto on_boundary = boundary_vertices(mesh);
  for (const VertexId v : mesh.vertices()) {
    if (on_boundary[v] != 0) arrays.points[v.index] = exact.points[v.index];
  }
  return arrays;
}

/// Options of a run that does not lower errors.
OptimizeOptions only_good() {
  OptimizeOptions options;
  options.tets.accuracy_steps = 0;
  return options;
}

TEST(TetOptimize, MakesAllTetrahedraGoodAndKeepsTheBoundary) {
  const TetMesh input = test::mesh_of(input_arrays());
  TetMesh mesh = input;
  const auto report = optimize(mesh);
  ASSERT_TRUE(report);
  const Quality before = quality(input), after = quality(mesh);
  EXPECT_GT(before.orthocenters_outside, before.tetrahedra / 10);
  EXPECT_EQ(after.orthocenters_outside, 0U);
  EXPECT_EQ(mesh.validate(), std::nullopt);
  EXPECT_LT(report->objective_after, report->objective_before);
  const auto on_boundary = boundary_vertices(input);
  std::size_t moved = 0;
  for (const VertexId v : mesh.vertices()) {
    if (on_boundary[v] != 0) {
      EXPECT_EQ(mesh.position(v), input.position(v));
    }
    moved += mesh.position(v) == input.position(v) ? 0 : 1;
  }
  EXPECT_GT(moved, 20U);
  const auto& history = report->history;
  ASSERT_EQ(history.size(), std::size_t(report->sweeps) + 1);
  for (std::size_t i = 1; i < history.size(); ++i) {  // energies of one γ fall
    if (history[i].objective == Objective::energy && history[i].length_parameter == history[i - 1].length_parameter) {
      EXPECT_LE(history[i].energy, history[i - 1].energy);
    }
  }
}

TEST(TetOptimize, AListenerSeesBetterAndBetterMeshesAndLastTheResult) {
  const TetMesh input = test::mesh_of(test::shaken(test::cubes(2, test::kSixTets), 0.3, 0));
  OptimizeOptions all, vertex, hot;
  vertex.scheme = Scheme::vertex;
  hot.energy = EnergyKind::F;
  for (OptimizeOptions options : {all, vertex, hot}) {
    options.tets.accuracy_steps = 3;
    TetMesh mesh = input, last;
    Origins origins;
    const auto n_violating = [&](const TetMesh& of) {
      return violating(Draft(of, {}), criterion_of(options.scheme)).size();
    };
    std::vector<std::size_t> bad = {n_violating(input)};
    OptimizeHooks hooks;
    hooks.best_so_far = [&](const auto& best) {
      best([&](const BestSoFar& now) {
        bad.push_back(n_violating(now.mesh));
        last = now.mesh;
        origins = now.origins;
      });
    };
    const auto report = optimize(mesh, options, hooks);
    ASSERT_TRUE(report);
    EXPECT_GT(report->vertices_inserted, 0U);
    EXPECT_TRUE(origins.vertices == report->origins.vertices);
    EXPECT_GT(bad.size(), 3U);
    EXPECT_TRUE(std::is_sorted(bad.rbegin(), bad.rend()));
    EXPECT_EQ(last, mesh);
  }
}

/// Runs the last block first.
class BackwardExecutor final : public Executor {
 public:
  void run(std::size_t n, const std::function<void(std::size_t)>& block) override {
    while (n > 0) block(--n);
  }
};

TEST(TetOptimize, TheBytesDoNotDependOnThreadsOrTheInstructionSet) {
  const TetMesh input = test::mesh_of(test::shaken(test::body_centered(7), 0.18, 0.1));
  const auto result = [&](Executor* executor) {
    TetMesh mesh = input;
    OptimizeHooks hooks;
    hooks.executor = executor;
    const auto report = optimize(mesh, {.max_sweeps = 4}, hooks);
    EXPECT_TRUE(report);
    return std::pair(mesh, report->history.back().energy);
  };
  const auto expected = result(nullptr);
  EXPECT_NE(expected.first, input);
  BackwardExecutor backwards;
  EXPECT_EQ(result(&backwards), expected);
  for (const std::size_t n : {2U, 3U, 8U}) {
    test::StdThreads threads(n);
    EXPECT_EQ(result(&threads), expected) << n;
  }
  const InstructionSet used = instruction_set();
  for (const InstructionSet set : instruction_sets()) {
    ASSERT_TRUE(use_instruction_set(set));
    EXPECT_EQ(result(nullptr), expected) << name(set);
  }
  use_instruction_set(used);
}

TEST(TetOptimize, EveryStepLowersTheEnergyOfItsStar) {
  TetMesh mesh = test::mesh_of(input_arrays());
  const auto mobility = mobilities(mesh);
  std::vector<HalffaceId> halffaces;
  std::vector<LinkLanes> room;
  std::size_t steps = 0;
  for (const VertexId v : mesh.vertices()) {
    collect_link(mesh, v, halffaces);
    std::vector<LinkFace<double>> link;
    for (const HalffaceId h : halffaces) link.push_back(link_face(mesh, h));
    const WeightedPoint before = mesh.point(v),
                        after = improved(mesh, halffaces, before, mobility[v], {0.1, 1.7}, room);
    if (after == before) continue;
    EXPECT_LT(star_energy(link, after, 0.1), star_energy(link, before, 0.1));
    mesh.set_point(v, after);
    ++steps;
  }
  EXPECT_GT(steps, mesh.n_vertices() / 2);
}

/// Of a symmetric matrix with eigenvalues of both signs.
PointDerivatives<double> saddle() {
  PointDerivatives<double> d = {};
  d.gradient = {{1, -2, 0.5}, 0.25};
  d.hessian = {-3, 0.5, 0, 0.1, 2, 0.2, 0, 0.5, 0, 1};
  return d;
}

std::vector<Mobility> mobilities_of_a_step() {
  std::vector<Mobility> all = {Mobility::none, Mobility::weight, Mobility::position, Mobility::free};
  for (const bool weighs : {false, true}) {
    const Vec3 direction = {1.0 / 3, 2.0 / 3, -2.0 / 3};
    for (Mobility sliding : {Mobility::along_line(direction), Mobility::in_plane(direction)}) {
      sliding.weighs = weighs;
      all.push_back(sliding);
    }
  }
  return all;
}

TEST(TetOptimize, StepsGoDownhillWithinTheTrustRadiusAlongWhatMayChange) {
  for (const double radius : {1e-3, 1.0, 1e3}) {
    for (const Mobility& mobility : mobilities_of_a_step()) {
      const PointDerivatives<double> d = saddle();
      const auto [step, predicted] = newton_step(d, mobility, radius);
      const double along = dot(d.gradient.at, Vector<double>{step.x, step.y, step.z}) + d.gradient.w * step.w;
      EXPECT_NEAR(along, -predicted, 1e-12 * predicted);
      EXPECT_EQ(predicted > 0, mobility.moves() || mobility.weighs);
      const double moved = length(step.position()) / radius, weighed = step.w / (radius * radius);
      EXPECT_LE(moved * moved + weighed * weighed, 0.25 * (1 + 1e-12));
      EXPECT_EQ(step.w == 0, !mobility.weighs);
      EXPECT_EQ(moved == 0, !mobility.moves());
      EXPECT_LE(length(mobility.allowed(step.position()) - step.position()), 1e-15 * radius);
    }
  }
}

TEST(TetOptimize, AStepOfAConvexEnergyGoesToItsLeastPlace) {
  PointDerivatives<double> d = {};
  d.gradient = {{0.1, -0.2, 0.05}, 0.025};
  d.hessian = {3, 0.5, 0, 0.1, 2, 0.2, 0, 1.5, 0, 1};
  const auto& [xx, xy, xz, xw, yy, yz, yw, zz, zw, ww] = d.hessian;
  for (const Mobility& mobility : mobilities_of_a_step()) {
    if (!mobility.moves()) continue;
    const WeightedPoint s = newton_step(d, mobility, 1).step;
    const Vec3 slope = {xx * s.x + xy * s.y + xz * s.z + xw * s.w + d.gradient.at.x,
                        xy * s.x + yy * s.y + yz * s.z + yw * s.w + d.gradient.at.y,
                        xz * s.x + yz * s.y + zz * s.z + zw * s.w + d.gradient.at.z};
    EXPECT_LE(length(mobility.allowed(slope)), 2e-15);
    if (mobility.weighs) {
      EXPECT_NEAR(xw * s.x + yw * s.y + zw * s.z + ww * s.w, -d.gradient.w, 1e-15);
    }
  }
}

TEST(TetOptimize, PositionsOrWeightsStayWhenTheyAreKept) {
  const TetMesh input = test::mesh_of(input_arrays());
  TetMesh weighed = input, moved = input;
  OptimizeOptions positions, weights;
  positions.unknowns = Unknowns::weights, weights.unknowns = Unknowns::positions;
  ASSERT_TRUE(optimize(weighed, positions));
  ASSERT_TRUE(optimize(moved, weights));
  EXPECT_NE(weighed, input);
  EXPECT_NE(moved, input);
  for (const VertexId v : input.vertices()) {
    EXPECT_EQ(weighed.position(v), input.position(v));
    EXPECT_EQ(moved.weight(v), input.weight(v));
  }
  weights.boundary = BoundaryVertices::split;
  EXPECT_FALSE(optimize(moved, weights));
}

TEST(TetOptimize, TaggedFacesAndLinesStay) {
  const test::TetArrays arrays = input_arrays();
  const TetMesh plain = test::mesh_of(arrays);
  const auto on_boundary = boundary_vertices(plain);
  const auto inside = [&](const auto& corners) {
    return std::all_of(corners.begin(), corners.end(), [&](VertexId v) { return on_boundary[v] == 0; });
  };
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<std::array<std::int32_t, 2>> lines;
  for (const HalffaceId h : plain.halffaces()) {
    const auto corners = plain.vertices(h);
    if (!inside(corners)) continue;
    const auto at = [&](std::size_t k) { return static_cast<std::int32_t>(corners[k].index); };
    if (faces.empty()) faces.push_back({at(0), at(1), at(2)});
    const bool apart = std::none_of(corners.begin(), corners.end(), [&](VertexId v) {
      return std::count(faces[0].begin(), faces[0].end(), static_cast<std::int32_t>(v.index)) > 0;
    });
    if (apart && lines.empty()) lines.push_back({at(0), at(1)});
  }
  ASSERT_EQ(lines.size(), 1U);
  const std::vector<std::int32_t> tag = {1};
  TetMeshInput in = arrays.input();
  in.faces = faces, in.face_tags = tag, in.lines = lines, in.line_tags = tag;
  const TetMesh input = test::built(in).mesh;
  TetMesh mesh = input;
  ASSERT_TRUE(optimize(mesh));
  for (const std::int32_t p : {faces[0][0], faces[0][1], faces[0][2], lines[0][0], lines[0][1]}) {
    const VertexId v(static_cast<std::size_t>(p));
    EXPECT_EQ(mesh.position(v), input.position(v));
    EXPECT_NE(mesh.weight(v), input.weight(v));
  }
}

TEST(TetOptimize, HeightsThatNoPlaceMakesPositiveFlattenNoTetrahedron) {
  TetMesh mesh = test::mesh_of(test::shaken(test::cubes(3, test::kSixTets), 0.35, 0, 3));
  const auto shape = [&mesh](TetId t) {
    const auto [p, q, r, s] = mesh.points(t);
    double length2 = 0;
    for (const auto& [a, b] : {std::pair(p, q), {p, r}, {p, s}, {q, r}, {q, s}, {r, s}})
      length2 += squared_length(a.position() - b.position());
    return six_volumes(p.position(), q.position(), r.position(), s.position()) / std::pow(length2 / 6, 1.5) *
           std::numbers::sqrt2;  // 1 for a regular one
  };
  std::vector<double> before;
  for (const TetId t : mesh.tetrahedra()) before.push_back(shape(t));
  const auto mobility = mobilities(mesh);
  const auto vertices = mesh.vertices();
  Sweeper sweeper(mesh, mobility, std::vector(vertices.begin(), vertices.end()));
  for (int sweep = 0; sweep < 60; ++sweep) sweeper.sweep(SweepParameters{0.003, 1.7});
  EXPECT_GT(quality(mesh).orthocenters_outside, 0U);
  for (const TetId t : mesh.tetrahedra()) EXPECT_GE(shape(t), std::min(0.1, before[t.index]) * (1 - 1e-9));
}

TEST(TetOptimize, SweepsThatCureLittleEndARunWithoutRepairs) {
  const TetMesh input = test::mesh_of(test::shaken(test::cubes(6, test::kSixTets), 0.1, 0));
  const auto history_of = [&input](const OptimizeOptions& options) {
    TetMesh mesh = input;
    return optimize(mesh, options)->history;
  };
  OptimizeOptions options = only_good();
  options.flips = Flips::none;
  const auto all = history_of(options);  // repairs could follow, if edges could change
  options.tets.repair_trials = 0;
  const auto quick = history_of(options);
  ASSERT_LT(quick.size(), all.size());
  std::vector<std::size_t> least = {input.n_tetrahedra()};  // bad tetrahedra so far
  const auto last = quick.back().length_parameter;
  std::size_t first = 0;  // sweep at the last γ
  for (const SweepRecord& sweep : quick) {
    least.push_back(std::min(least.back(), sweep.bad));
    first += sweep.length_parameter == last ? 0 : 1;
  }
  ASSERT_GT(least.back(), 0U);
  const auto cures = [&least](std::size_t i) { return double(least[i]) < 0.99 * double(least[i - 10]); };
  for (std::size_t i = first + 10; i + 1 < least.size(); ++i) EXPECT_TRUE(cures(i)) << i;
  EXPECT_FALSE(cures(least.size() - 1));
  for (std::size_t i = 0; i < quick.size(); ++i) EXPECT_EQ(quick[i].energy, all[i].energy);
}

TEST(TetOptimize, KeepsInterfacesAndSinglePoints) {
  const test::TetArrays arrays = input_arrays();
  const TetMesh plain = test::mesh_of(arrays);
  std::vector<VertexId> inside;
  const auto on_boundary = boundary_vertices(plain);
  for (const VertexId v : plain.vertices()) {
    if (on_boundary[v] == 0) inside.push_back(v);
  }
  std::vector<std::int32_t> regions;
  for (const TetId t : plain.tetrahedra()) {
    double x = 0;
    for (const VertexId v : plain.corners(t)) x += plain.position(v).x / 4;
    regions.push_back(x < 1.5 ? 1 : 2);
  }
  const std::vector<std::int32_t> point = {static_cast<std::int32_t>(inside.front().index)}, tag = {7};
  test::TetArrays copy = arrays;
  TetMeshInput in = copy.input();
  in.regions = regions, in.marked_points = point, in.point_tags = tag;
  const TetMesh input = test::built(in).mesh;
  TetMesh mesh = input;
  ASSERT_TRUE(optimize(mesh));
  std::size_t at_interface = 0;
  for (const HalffaceId h : input.halffaces()) {
    if (input.is_boundary(h)) continue;
    if (input.region(TetMesh::tetrahedron(h)) == input.region(TetMesh::tetrahedron(input.twin(h)))) continue;
    for (const VertexId v : input.vertices(h)) {
      EXPECT_EQ(mesh.position(v), input.position(v));
      ++at_interface;
    }
  }
  EXPECT_GT(at_interface, 0U);
  EXPECT_EQ(mesh.position(inside.front()), input.position(inside.front()));
  EXPECT_NE(mesh, input);
}

/// Corners of this cube have tetrahedra whose four corners are on the boundary.
TEST(TetOptimize, VerticesAreInsertedWhereMovesAloneLeaveBadTetrahedra) {
  const TetMesh input = test::mesh_of(test::shaken(test::cubes(2, test::kSixTets), 0.3, 0));
  TetMesh moved = input, changed = input;
  OptimizeOptions keep;
  keep.flips = Flips::none;
  const auto before = optimize(moved, keep), report = optimize(changed);
  ASSERT_TRUE(before && report);
  EXPECT_GT(quality(moved).orthocenters_outside, 0U);
  EXPECT_EQ(moved.corner_data().size(), input.corner_data().size());
  EXPECT_TRUE(before->origins.vertices.empty());
  const Quality after = quality(changed);
  EXPECT_EQ(after.orthocenters_outside, 0U);
  EXPECT_EQ(changed.validate(), std::nullopt);
  EXPECT_GT(report->vertices_inserted, 0U);
  EXPECT_EQ(changed.n_vertices() + report->vertices_removed, input.n_vertices() + report->vertices_inserted);
  ASSERT_EQ(report->origins.vertices.size(), changed.n_vertices());
  const auto on_boundary = boundary_vertices(input), still = boundary_vertices(changed);
  std::size_t kept = 0;
  for (const VertexId v : changed.vertices()) {
    const VertexId was = report->origins.vertices[v];
    EXPECT_EQ(still[v] != 0, was.valid() && on_boundary[was] != 0);
    if (still[v] == 0) continue;
    EXPECT_EQ(changed.position(v), input.position(was));
    ++kept;
  }
  EXPECT_EQ(kept, 26U);
  EXPECT_EQ(after.boundary_faces, quality(input).boundary_faces);
  TetMesh again = input;
  ASSERT_TRUE(optimize(again));
  EXPECT_EQ(again, changed);
}

/// A slab of two layers, whose only inner vertex cannot make up for its boundary.
TEST(TetOptimize, TheBoundaryIsSplitOnRequestAlone) {
  test::TetArrays arrays = test::shaken(test::cubes(2, test::kSixTets), 0.2, 0);
  for (Vec3& p : arrays.points) p.z *= 0.5;
  const TetMesh input = test::mesh_of(arrays);
  TetMesh kept = input, split = input;
  OptimizeOptions options;
  options.tets.repair_trials = 5;
  ASSERT_TRUE(optimize(kept, options));
  options.boundary = BoundaryVertices::split;
  const auto report = optimize(split, options);
  ASSERT_TRUE(report);
  const Quality before = quality(kept), after = quality(split);
  EXPECT_EQ(before.boundary_faces, quality(input).boundary_faces);
  EXPECT_LT(after.orthocenters_outside, before.orthocenters_outside);
  EXPECT_GT(after.boundary_faces, before.boundary_faces);
  EXPECT_NEAR(after.volume, before.volume, 1e-14);
  EXPECT_EQ(split.validate(), std::nullopt);
}

TEST(TetOptimize, SmallMarginsAreImprovedOnRequest) {
  const TetMesh input = test::mesh_of(test::shaken(test::cubes(2, test::kSixTets), 0.2, 0));
  TetMesh good = input, better = input;
  OptimizeOptions options = only_good();
  options.tets.repair_trials = 8;
  ASSERT_TRUE(optimize(good, options));
  options.tets.small_margin = 0.02;
  ASSERT_TRUE(optimize(better, options));
  EXPECT_EQ(quality(good).orthocenters_outside, 0U);
  EXPECT_EQ(quality(better).orthocenters_outside, 0U);
  EXPECT_LT(quality(good).min_h_over_l, 0.02);
  EXPECT_GT(quality(better).min_h_over_l, 1.2 * quality(good).min_h_over_l);
}

TEST(TetOptimize, AHotEnergyFallsWithinTheGoodMeshesOnAnyThread) {
  TetMesh good = test::mesh_of(test::shaken(test::body_centered(3), 0.1, 0.1));
  ASSERT_TRUE(optimize(good, only_good()));
  ASSERT_EQ(quality(good).orthocenters_outside, 0U);
  test::StdThreads threads(3);
  OptimizeHooks hooks;
  hooks.executor = &threads;
  using enum temper::Star;
  for (const temper::Star star : {zero, one, two, three}) {
    const HotEnergy& energy = kHotEnergies[static_cast<std::size_t>(star)];
    OptimizeOptions options;
    options.energy = EnergyKind::F, options.star = star, options.tets.accuracy_steps = 0;
    TetMesh none = good, mesh = good, again = good;
    const auto without = optimize(none, options);
    ASSERT_TRUE(without);
    options.tets.accuracy_steps = 2;
    const auto report = optimize(mesh, options);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->objective_after, hot_energy(mesh, energy));
    EXPECT_EQ(report->objective_before, hot_energy(good, energy));
    EXPECT_LE(report->objective_after, report->objective_before);
    EXPECT_LT(report->objective_after, 0.995 * without->objective_after);
    EXPECT_EQ(report->history.back().energy, report->objective_after);
    EXPECT_EQ(quality(mesh).orthocenters_outside, 0U);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    ASSERT_TRUE(optimize(again, options, hooks));
    EXPECT_EQ(again, mesh);
    const auto twice = optimize(again, options);  // sweeps for BP alone would raise it
    ASSERT_TRUE(twice);
    EXPECT_LE(twice->objective_after, report->objective_after);
    EXPECT_EQ(twice->objective_after, hot_energy(again, energy));
    EXPECT_EQ(quality(again).orthocenters_outside, 0U);
  }
  EXPECT_FALSE(optimize(good, {.energy = EnergyKind::F, .star = temper::Star::all}));
  EXPECT_FALSE(optimize(good, {.star = temper::Star::two}));  // without a HOT energy
  EXPECT_FALSE(optimize(good, {.scheme = Scheme::cell, .energy = EnergyKind::F}));
}

TEST(TetOptimize, PointsThatListAllVerticesStayFree) {
  test::TetArrays arrays = input_arrays();
  TetMeshInput in = arrays.input();
  std::vector<std::int32_t> all(arrays.points.size()), tags(arrays.points.size(), 1);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int32_t>(i);
  in.marked_points = all, in.point_tags = tags;
  const auto expected = mobilities(test::mesh_of(arrays));
  EXPECT_EQ(mobilities(test::built(in).mesh), expected);
  const auto well = std::find(expected.begin(), expected.end(), Mobility::free) - expected.begin();
  std::vector<std::int32_t> fixed = {static_cast<std::int32_t>(well)};
  in.fixed_points = fixed;
  auto with_fixed = expected;
  with_fixed[VertexId(static_cast<std::size_t>(well))] = Mobility::weight;
  EXPECT_EQ(mobilities(test::built(in).mesh), with_fixed);
  in.fixed_points = {};
  tags[static_cast<std::size_t>(well)] = 9;  // among points that list a part
  EXPECT_EQ(mobilities(test::built(in).mesh), with_fixed);
}

TEST(TetOptimize, TheObserverAndTheClockStopARunWithAMeshThatIsNoWorse) {
  const TetMesh input = test::mesh_of(input_arrays());
  const std::size_t bad = quality(input).orthocenters_outside;
  OptimizeHooks canceled, late;
  int calls = 0;
  canceled.observer = [&](const Progress&) { return ++calls < 3 ? Continue::yes : Continue::no; };
  late.started = std::chrono::steady_clock::now() - std::chrono::hours(1);
  for (const auto& [hooks, options, stopped] :
       {std::tuple{canceled, OptimizeOptions{}, Stopped::canceled},
        std::tuple{late, OptimizeOptions{.time_limit = 60}, Stopped::time_limit},
        std::tuple{OptimizeHooks{}, OptimizeOptions{.max_sweeps = 2}, Stopped::max_sweeps}}) {
    TetMesh mesh = input;
    const auto report = optimize(mesh, options, hooks);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->stopped, stopped);
    EXPECT_LE(report->sweeps, 2);
    EXPECT_EQ(mesh.validate(), std::nullopt);
    EXPECT_LE(quality(mesh).orthocenters_outside, bad);
  }
  // Sweeps of a large γ make this one worse at first.
  const TetMesh worse = test::mesh_of(test::shaken(test::cubes(4, test::kSixTets), 0.2, 0.1));
  const std::size_t at_first = quality(worse).orthocenters_outside;
  for (int sweeps = 1; sweeps < 3; ++sweeps) {
    TetMesh mesh = worse;
    const auto report = optimize(mesh, {.max_sweeps = sweeps});
    ASSERT_TRUE(report);
    EXPECT_GT(report->history.back().bad, at_first);
    EXPECT_EQ(mesh, worse);
  }
  TetMesh mesh = input;
  EXPECT_FALSE(optimize(mesh, {.max_sweeps = -1}));
  EXPECT_FALSE(optimize(mesh, {.time_limit = -1}));
  EXPECT_EQ(mesh, input);
}

}  // namespace
}  // namespace temper::tets

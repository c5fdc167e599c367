// The replay of every run's trace gives the same mesh, bit for bit.
#include "temper/detail/trace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "temper/generate.hpp"
#include "temper/optimize.hpp"

namespace temper {
namespace {

struct Case {
  std::string title;
  OptimizeOptions options;
};

/// Every solver, energy, timing and limit of flips, way to remove vertices and order.
std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](std::string title, OptimizeOptions o) {
    o.max_sweeps = std::min(o.max_sweeps, 12);
    all.push_back({std::move(title), std::move(o)});
  };
  for (const EnergyInfo& energy : energies()) {
    if (energy.is_hard()) continue;  // starts inside its barrier only
    const std::string name(energy.name);
    add(name, {.energy = energy.kind});
    add(name + " alternating", {.energy = energy.kind, .paper = {.solver = Solver::alternating}});
    add(name + " golden", {.energy = energy.kind, .max_sweeps = 3, .paper = {.solver = Solver::golden}});
    add(name + " deferred",
        {.energy = energy.kind, .flips = Flips::deferred, .paper = {.solver = Solver::alternating, .inner = 2}});
    add(name + " collapses", {.energy = energy.kind, .paper = {.collapse_from = 1, .collapse_ratio = 0.4}});
    add(name + " patch test", {.energy = energy.kind, .paper = {.removal = Removal::patch, .removal_from = 2}});
  }
  for (const FlipLimit limit : {FlipLimit::unlimited, FlipLimit::before, FlipLimit::at, FlipLimit::after}) {
    const std::string number = std::to_string(static_cast<int>(limit));
    add("F, flip limit " + number, {.energy = EnergyKind::F, .paper = {.flip_limit = limit}});
    add("BP, flip limit " + number, {.paper = {.flip_limit = limit}});
  }
  for (const RemovalMeasure measure : {RemovalMeasure::sum, RemovalMeasure::mean, RemovalMeasure::excess}) {
    add("removal measure " + std::to_string(static_cast<int>(measure)),
        {.paper = {.removal = Removal::patch, .removal_measure = measure, .removal_margin = 0, .removal_from = 0}});
  }
  for (const SweepOrder order : {SweepOrder::input, SweepOrder::reverse, SweepOrder::random}) {
    add("order " + std::to_string(static_cast<int>(order)),
        {.energy = EnergyKind::T, .paper = {.order = order, .collapse_from = 2, .collapse_ratio = 0.3}});
  }
  for (const HiddenPolicy policy : {HiddenPolicy::undo, HiddenPolicy::remove, HiddenPolicy::keep}) {
    OptimizeOptions o{.energy = EnergyKind::F, .paper = {.solver = Solver::alternating, .hidden = policy}};
    o.paper.weight_updates = Updates::deferred;
    add("hidden " + std::to_string(static_cast<int>(policy)) + ", deferred weights", o);
    o.flips = Flips::deferred;
    o.paper.inner = 3;
    add("hidden " + std::to_string(static_cast<int>(policy)) + ", all deferred", o);
  }
  const auto add_paper = [&](std::string title, auto change) {
    OptimizeOptions o{.energy = EnergyKind::dT, .flips = Flips::deferred, .paper = {.solver = Solver::golden}};
    o.max_sweeps = 6;
    change(o.paper);
    add(std::move(title), o);
  };
  for (const SearchRadius radius : {SearchRadius::max, SearchRadius::min}) {
    add_paper("search radius " + std::to_string(static_cast<int>(radius)),
              [&](PaperSwitches& p) { p.search_radius = radius, p.weight_search_radius = 4; });
  }
  add_paper("all deferred", [](PaperSwitches& p) { p.position_updates = p.weight_updates = Updates::deferred; });
  add_paper("visits twice", [](PaperSwitches& p) { p.visits = Visits::twice; });
  add_paper("constant overshoot",
            [](PaperSwitches& p) { p.flip_limit = FlipLimit::after, p.overshoot = 1.5, p.overshoot_factor = 1; });
  add_paper("removal by weight",
            [](PaperSwitches& p) { p.removal = Removal::weight, p.hidden_threshold = 0.2, p.removal_from = 1; });
  add("Newton, all deferred", {.paper = {.weight_updates = Updates::deferred, .position_updates = Updates::deferred}});
  add("insertion", {.energy = EnergyKind::T,
                    .paper = {.removal_measure = RemovalMeasure::sum, .insertion_from = 1, .insertion_ratio = 1.5}});
  add("first energy", {.paper = {.first_energy = EnergyKind::dT, .switch_at = 4}});
  add("weights only", {.unknowns = Unknowns::weights});
  add("positions only", {.energy = EnergyKind::dT, .unknowns = Unknowns::positions});
  add("anchor", {.paper = {.anchor = VertexId(5)}});
  add("frozen", {.flips = Flips::none});
  add("two restarts", {.max_sweeps = 120});
  OptimizeOptions paper = *options_for("paper");
  paper.max_sweeps = 6;
  paper.paper.inner = 2;
  for (const std::string energy : {"F", "T", "dT", "BP", "BHs"}) {
    paper.energy = find_energy(energy)->kind;
    add("paper, " + energy, paper);
    paper.paper.inversion = Inversion::refuse;
    add("paper without inversion, " + energy, paper);
    paper.paper.inversion = Inversion::allow;
  }
  for (Case& c : all) c.options.max_sweeps = c.title == "two restarts" ? 120 : c.options.max_sweeps;
  return all;
}

/// Weights that flip edges at once, coordinates far from the origin, on a scale of its own.
Mesh displaced(Mesh mesh) {
  for (const VertexId v : mesh.vertices()) {
    const WeightedPoint p = mesh.point(v);
    mesh.set_point(v, {0.01 * p.x + 1234, 0.01 * p.y - 77, (v.index % 7 == 0) ? 1e-7 : 0.0});
  }
  return mesh;
}

std::vector<std::pair<std::string, Mesh>> meshes() {
  return {{"sparse horseshoe", sparse_horseshoe()},
          {"horseshoe", *horseshoe()},
          {"random", *random_mesh({.vertices = 70})},
          {"displaced", displaced(*random_mesh({.vertices = 60, .seed = 3}))},
          {"annulus", *annulus({.around = 16, .rings = 3})}};
}

TEST(Trace, OfEveryRunReplaysToTheSameMesh) {
  std::map<EventKind, std::size_t> seen;
  std::size_t undone_sweeps = 0, runs = 0;
  for (const auto& [mesh_title, input] : meshes()) {
    for (const auto& [title, given] : cases()) {
      SCOPED_TRACE(mesh_title + ": " + title);
      std::vector<TraceEvent> events;
      OptimizeOptions options = given;
      OptimizeHooks hooks;
      hooks.tracer = [&](const TraceEvent& e) { events.push_back(e); };
      Mesh mesh = input;
      const auto report = optimize(mesh, options, hooks);
      if (!report) {
        EXPECT_EQ(mesh, input);
        continue;
      }
      const auto again = replay_with_vertices(input, events);
      ASSERT_TRUE(again) << again.error().what();
      EXPECT_EQ(again->mesh, mesh);
      EXPECT_EQ(again->vertices, report->vertices);
      for (const TraceEvent& e : events) {
        ++seen[e.kind];
        undone_sweeps += e.kind == EventKind::undo && !e.vertex.valid() ? 1 : 0;
      }
      ++runs;
    }
  }
  EXPECT_GT(runs, 200u);
  for (const EventKind kind : {EventKind::move, EventKind::weight, EventKind::flip, EventKind::collapse,
                               EventKind::removal, EventKind::undo}) {
    EXPECT_GT(seen[kind], 0u) << name(kind);
  }
  EXPECT_GT(undone_sweeps, 0u);
}

TEST(Trace, ChangesNothing) {
  for (const auto& [title, options] : cases()) {
    Mesh traced = *random_mesh({.vertices = 80}), silent = traced;
    OptimizeHooks hooks;
    hooks.tracer = [](const TraceEvent&) {};
    const auto a = optimize(traced, options, hooks), b = optimize(silent, options, hooks);
    ASSERT_EQ(a.has_value(), b.has_value()) << title;
    EXPECT_EQ(traced, silent) << title;
  }
}

// -0 == 0, so equal meshes are not enough.
TEST(Trace, MakesTheSameBits) {
  std::size_t zeros = 0, undone = 0;
  OptimizeOptions deferred{.unknowns = Unknowns::positions, .repair = Repair::none, .max_sweeps = 60};
  deferred.paper.position_updates = Updates::deferred;  // the second restart begins with a jitter
  for (const OptimizeOptions& options : {OptimizeOptions{.max_sweeps = 40}, deferred}) {
    Mesh input = *random_mesh({.vertices = 40});
    for (const VertexId v : input.vertices()) {
      const auto [x, y, w] = input.point(v);
      input.set_point(v, {x == 0 ? -0.0 : x, y == 0 ? -0.0 : y, w});
    }
    std::vector<TraceEvent> events;
    Mesh mesh = input;
    ASSERT_TRUE(optimize(mesh, options, {.tracer = [&](const TraceEvent& e) { events.push_back(e); }}));
    const auto again = replay(input, events);
    ASSERT_TRUE(again);
    for (const VertexId v : mesh.vertices()) {
      const WeightedPoint p = mesh.point(v), q = again->point(v), old = input.point(v);
      EXPECT_EQ(std::memcmp(&p, &q, sizeof p), 0);
      if (!mesh.is_boundary(v)) continue;
      EXPECT_EQ(std::memcmp(&p, &old, 2 * sizeof p.x), 0) << "the boundary stays bit for bit";
      zeros += std::signbit(old.x) || std::signbit(old.y) ? 1 : 0;
    }
    for (const TraceEvent& e : events) undone += e.kind == EventKind::undo && e.to_sweep == -1 ? 1 : 0;
  }
  EXPECT_GT(zeros, 4u);
  EXPECT_GT(undone, 0u);
}

TEST(Trace, SweepsNeverGoDown) {
  Mesh mesh = *horseshoe();
  int last = 0;
  std::size_t events = 0;
  OptimizeOptions options;
  OptimizeHooks hooks;
  hooks.tracer = [&](const TraceEvent& e) {
    EXPECT_GE(e.sweep, last);
    last = e.sweep;
    ++events;
  };
  ASSERT_TRUE(optimize(mesh, options, hooks));
  EXPECT_GT(events, 100u);
}

}  // namespace
}  // namespace temper

// Replay of events that the tests make without the optimizer: effects and refusals.
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/rng.hpp"
#include "temper/detail/trace.hpp"
#include "temper/generate.hpp"
#include "temper/topology.hpp"

namespace temper {
namespace {

using Events = std::vector<TraceEvent>;

VertexId id(std::size_t i) { return VertexId(i); }

TraceEvent move(int sweep, VertexId v, WeightedPoint p) {
  return {.kind = EventKind::move, .sweep = sweep, .vertex = v, .point = p};
}

TraceEvent back_to(int sweep, int to) { return {.kind = EventKind::undo, .sweep = sweep, .to_sweep = to}; }

/// Changes a mesh and records the events.
struct Actor {
  Mesh mesh;
  Events events;
  Rng rng;
  int sweep = 0;

  explicit Actor(Mesh m, std::uint64_t seed = 1) : mesh(std::move(m)), rng(seed) {}

  VertexId any_vertex() {
    for (;;) {
      const VertexId v(std::size_t{rng.below(static_cast<std::uint32_t>(mesh.n_vertices()))});
      if (!mesh.is_isolated(v)) return v;
    }
  }
  void place(EventKind kind) {
    const VertexId v = any_vertex();
    WeightedPoint p = mesh.point(v);
    if (kind == EventKind::move && mesh.is_boundary(v)) return;
    if (kind == EventKind::move) p.x += 1e-6 * rng.uniform(-1, 1);  // so little that no triangle turns over
    p.w += rng.uniform(-1, 1);
    mesh.set_point(v, p);
    events.push_back({.kind = kind, .sweep = sweep, .vertex = v, .point = p});
  }
  void flip_any() {
    const VertexId a = any_vertex();
    for (const HalfedgeId h : mesh.star(a)) {
      if (can_flip(mesh, h) != FlipStatus::possible) continue;
      events.push_back({.kind = EventKind::flip,
                        .sweep = sweep,
                        .quad = {a, mesh.target(h), mesh.opposite(h), mesh.opposite(mesh.twin(h))}});
      flip(mesh, h);
      return;
    }
  }
  void remove_any(EventKind kind) {
    const RemovalPlan plan = plan_removal(mesh, any_vertex());
    if (plan.status != RemovalStatus::possible) return;
    remove_vertex(mesh, plan);
    events.push_back(
        {.kind = kind, .sweep = sweep, .vertex = plan.vertex, .link = plan.link, .triangles = plan.triangles});
  }
  void act() {
    switch (rng.below(6)) {
      case 0:
        return place(EventKind::weight);
      case 1:
        return remove_any(rng.below(2) == 0 ? EventKind::collapse : EventKind::removal);
      case 2:
        return flip_any();
      case 3:
        events.push_back({.kind = EventKind::undo, .sweep = sweep, .vertex = any_vertex()});
        return;
      case 4:
        events.push_back({.kind = EventKind::hidden, .sweep = sweep, .vertex = any_vertex()});
        return;
      default:
        return place(EventKind::move);
    }
  }
};

std::size_t count(const Events& events, EventKind kind) {
  return static_cast<std::size_t>(
      std::count_if(events.begin(), events.end(), [&](const TraceEvent& e) { return e.kind == kind; }));
}

TEST(Replay, OfNothingIsTheInput) {
  const Mesh input = *horseshoe();
  const auto result = replay_with_vertices(input, {});
  ASSERT_TRUE(result) << result.error().what();
  EXPECT_EQ(result->mesh, input);
  EXPECT_TRUE(result->vertices.empty());
}

TEST(Replay, OfRandomChangesGivesTheSameMeshAndTheNumbersOfItsVertices) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Mesh input = *random_mesh({.vertices = 80, .seed = seed});
    Actor actor(input, seed);
    for (int i = 0; i < 300; ++i) actor.act();
    for (const EventKind kind : {EventKind::move, EventKind::weight, EventKind::flip, EventKind::collapse,
                                 EventKind::removal, EventKind::hidden, EventKind::undo}) {
      ASSERT_GT(count(actor.events, kind), 0u) << name(kind);
    }
    const auto result = replay_with_vertices(input, actor.events);
    ASSERT_TRUE(result) << result.error().what();
    const auto left = actor.mesh.compact().vertices;
    EXPECT_EQ(result->mesh, actor.mesh);
    EXPECT_EQ(result->vertices, left);
    EXPECT_EQ(result->mesh.validate(), std::nullopt);
    const auto plain = replay(input, actor.events);
    ASSERT_TRUE(plain);
    EXPECT_EQ(*plain, actor.mesh);
  }
}

// A replay in another order of slots and numbers gives the same mesh after the order is undone. So the optimizer's
// Hilbert order does not matter to a replay.
TEST(Replay, InAnyOrderOfSlotsGivesTheSameMesh) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Mesh input = *random_mesh({.vertices = 60, .seed = seed});
    Mesh ordered = input;
    const MeshOrder order = hilbert_order(ordered);
    Actor actor(ordered, seed);
    for (int i = 0; i < 200; ++i) {
      actor.place(EventKind::move);
      actor.flip_any();
    }
    Events events = actor.events;
    const auto user = [&](VertexId& v) { v = v.valid() ? order.vertices[v] : v; };
    for (TraceEvent& e : events) {
      user(e.vertex);
      for (VertexId& v : e.quad) user(v);
    }
    restore_order(actor.mesh, order);
    const auto result = replay(input, events);
    ASSERT_TRUE(result) << result.error().what();
    EXPECT_EQ(*result, actor.mesh);
  }
}

TEST(Replay, GoesBackToTheEndOfAnySweep) {
  const Mesh input = *random_mesh({.vertices = 60});
  Actor actor(input);
  std::vector<Mesh> ends;  // of sweeps 0, 1, …
  for (; actor.sweep < 6; ++actor.sweep) {
    for (int i = 0; i < 20; ++i) actor.act();
    ends.push_back(actor.mesh);
  }
  for (int to = -1; to < 6; ++to) {
    Events events = actor.events;
    events.push_back(back_to(6, to));
    Mesh expected = to < 0 ? input : ends[static_cast<std::size_t>(to)];
    expected.compact();
    const auto result = replay(input, events);
    ASSERT_TRUE(result) << result.error().what();
    EXPECT_EQ(*result, expected) << to;
  }
}

TEST(Replay, GoesOnAfterGoingBackAndBackAgain) {
  const Mesh input = *horseshoe();
  const auto w = [](int sweep, double weight) {
    return TraceEvent{.kind = EventKind::weight, .sweep = sweep, .vertex = id(3), .point = {0, 0, weight}};
  };
  const auto weight_after = [&](const Events& events) {
    const auto result = replay(input, events);
    EXPECT_TRUE(result) << result.error().what();
    return result ? result->weight(id(3)) : std::nan("");
  };
  EXPECT_EQ(weight_after({w(1, 1), w(2, 2), back_to(3, 1)}), 1);
  EXPECT_EQ(weight_after({w(1, 1), w(2, 2), back_to(3, -1), w(4, 4)}), 4);
  EXPECT_EQ(weight_after({w(1, 1), w(2, 2), back_to(3, -1), w(4, 4), back_to(5, 1)}), 1) << "of the first restart";
  EXPECT_EQ(weight_after({w(1, 1), w(2, 2), back_to(3, 1), w(4, 4), back_to(5, 1)}), 1);
  EXPECT_EQ(weight_after({w(1, 1), w(4, 4), back_to(5, 3)}), 1) << "a sweep without events ends as it begins";
  EXPECT_EQ(weight_after({w(2, 1), back_to(3, 0)}), input.weight(id(3)));
  EXPECT_EQ(weight_after({w(2, 1), back_to(2, 2)}), 1) << "nothing to take back";
}

TEST(Replay, WeightsLeaveThePositionAndMovesTakeTheWeightAlong) {
  const Mesh input = *horseshoe();
  const TraceEvent weight = {.kind = EventKind::weight, .vertex = id(2), .point = {77, 77, 0.5}};
  const auto result = replay(input, Events{weight, move(0, id(10), {1, 2, 3})});
  ASSERT_TRUE(result) << result.error().what();
  EXPECT_EQ(result->position(id(2)), input.position(id(2)));
  EXPECT_EQ(result->weight(id(2)), 0.5);
  EXPECT_EQ(result->point(id(10)), (WeightedPoint{1, 2, 3}));
}

//     3---------2       Two triangles 012, 023; the diagonal 0-2 inside.
//     |       / |
//     |   /     |
//     0---------1
Mesh square(bool constrained = false) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::vector<std::array<std::int32_t, 2>> edges = {{0, 2}};
  MeshInput input{.points = points, .triangles = triangles};
  if (constrained) input.constrained_edges = edges;
  return Mesh::build(input)->mesh;
}

TraceEvent flip_of(std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
  return {.kind = EventKind::flip, .quad = {id(a), id(b), id(c), id(d)}};
}

struct Misfit {
  const char* title;
  TraceEvent event;
  const char* message;
  bool constrained = false;
};

TEST(Replay, RefusesEventsThatDoNotFitByTheirNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const TraceEvent removal = {
      .kind = EventKind::removal, .vertex = id(1), .link = {id(2), id(0)}, .triangles = {{id(0), id(2), id(3)}}};
  const std::vector<Misfit> misfits = {
      {"no vertex", {.kind = EventKind::move}, "move without a vertex"},
      {"vertex out of range", move(0, id(4), {}), "move of vertex index 4, but the mesh has 4 vertices"},
      {"not a number", move(0, id(1), {kNan, 0, 0}), "move of point 1 to what is not finite; expected finite numbers"},
      {"infinite weight",
       {.kind = EventKind::weight, .vertex = id(1), .point = {0, 0, kInf}},
       "weight of point 1 to what is not finite; expected finite numbers"},
      {"no edge", flip_of(1, 3, 0, 2), "flip of the edge from point 1 to point 3, which is not in the mesh"},
      {"boundary edge", flip_of(0, 1, 2, 3), "flip of the edge from point 0 to point 1, which is on the boundary"},
      {"constrained edge", flip_of(0, 2, 3, 1), "flip of the edge from point 0 to point 2, which is constrained", true},
      {"wrong side", flip_of(0, 2, 1, 3),
       "flip of the edge from point 0 to point 2 between point 1 and point 3, but it is between point 3 and point 1"},
      {"hidden without a vertex", {.kind = EventKind::hidden}, "hiding without a vertex"},
      {"undo ahead", back_to(3, 5), "undo in sweep 3 to the end of sweep 5, which has not been"},
      {"undo before the input", back_to(3, -2), "undo in sweep 3 to the end of sweep -2, which has not been"},
      {"corner", removal, "removal of point 1, which is a corner of the boundary"},
      {"no link", {.kind = EventKind::collapse, .vertex = id(1)}, "collapse of point 1 without a link"},
  };
  for (const Misfit& misfit : misfits) {
    const Mesh input = square(misfit.constrained);
    const auto result = replay(input, Events{move(0, id(0), {0, 0, 1}), misfit.event});
    ASSERT_FALSE(result) << misfit.title;
    EXPECT_EQ(result.error().code, ErrorCode::trace_mismatch) << misfit.title;
    EXPECT_EQ(result.error().what(), std::string("event 1: ") + misfit.message) << misfit.title;
  }
}

TEST(Replay, RefusesAFlipToAnEdgeThatIsThere) {
  // Vertex 3 has degree three: a flip of 0-3 would join 1 and 2 twice.
  const std::vector<Vec2> points = {{0, 0}, {4, 0}, {0, 4}, {1, 1}};
  const std::vector<std::array<std::int32_t, 3>> triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const Mesh input = Mesh::build({.points = points, .triangles = triangles})->mesh;
  const auto result = replay(input, Events{flip_of(0, 3, 2, 1)});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().what(),
            "event 0: flip of the edge from point 0 to point 3 to one from point 1 to point 2, which is in the mesh "
            "already");
}

TEST(Replay, RefusesRemovalsThatDoNotFillTheCavity) {
  const Mesh input = *random_mesh({.vertices = 60});
  int tried = 0;
  for (const VertexId v : input.vertices()) {
    const RemovalPlan plan = plan_removal(input, v);
    if (plan.status != RemovalStatus::possible || input.is_boundary(v) || plan.link.size() < 5) continue;
    const TraceEvent good = {.kind = EventKind::removal, .vertex = v, .link = plan.link, .triangles = plan.triangles};
    ASSERT_TRUE(replay(input, Events{good}));
    TraceEvent turned = good, fewer = good, other_link = good, twice = good, outside = good;
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    fewer.triangles.pop_back();
    std::swap(other_link.link[1], other_link.link[2]);
    twice.triangles[0] = twice.triangles[1];
    outside.triangles[0][0] = id(1000);
    for (const TraceEvent& bad : {turned, fewer, other_link, twice, outside}) {
      const auto result = replay(input, Events{bad});
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().where, "event 0");
    }
    const auto again = replay(input, Events{good, good});
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().what(),
              "event 1: removal of point " + std::to_string(v.index) + ", which was removed before");
    ++tried;
  }
  EXPECT_GT(tried, 10);
}

TEST(Replay, SpeaksTheNumbersOfTheUser) {
  struct FromOne final : InputNames {
    std::string point(std::size_t i) const override { return "node " + std::to_string(i + 1); }
  } names;
  const auto result = replay_with_vertices(square(), Events{flip_of(1, 3, 0, 2)}, &names);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().what(), "event 0: flip of the edge from node 2 to node 4, which is not in the mesh");
}

TEST(Trace, EveryKindHasItsOwnName) {
  std::vector<std::string_view> names;
  for (int kind = 0; kind <= static_cast<int>(EventKind::undo); ++kind) {
    names.push_back(name(static_cast<EventKind>(kind)));
    EXPECT_NE(names.back(), "unknown");
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace temper

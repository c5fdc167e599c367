// The mesh: from arrays and back, changes of positions and weights.
#include <array>
#include <cmath>

#include "answer.hpp"
#include "held_mesh.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper::wasm {
namespace {

VertexId vertex_id(const Mesh& mesh, std::int32_t v) {
  if (v < 0 || static_cast<std::size_t>(v) >= mesh.n_vertices()) {
    fail(ErrorCode::index_out_of_range, "there is no vertex " + std::to_string(v) + ": the mesh has " +
                                            std::to_string(mesh.n_vertices()) + ", counted from 0");
  }
  return VertexId(static_cast<std::size_t>(v));
}

void check_number(VertexId v, const char* what, bool usable, double value) {
  if (usable) return;
  const bool finite = std::isfinite(value);
  fail(finite ? ErrorCode::out_of_scale : ErrorCode::not_finite,
       "point " + std::to_string(v.index) + ": " + what +
           (finite ? " out of the range of exact arithmetic" : " not finite"));
}

void check_counter_clockwise(const Mesh& mesh, TriangleId t) {
  const auto c = mesh.corners(t);
  if (orient2d(mesh.position(c[0]), mesh.position(c[1]), mesh.position(c[2])) == Sign::positive) return;
  fail(ErrorCode::zero_area, "triangle " + std::to_string(t.index) + " is not counter-clockwise at these points");
}

/// Puts a vertex elsewhere, when its triangles stay counter-clockwise there.
void set_point(Mesh& mesh, VertexId v, const WeightedPoint& p) {
  check_number(v, "x", is_exact_coordinate(p.x), p.x);
  check_number(v, "y", is_exact_coordinate(p.y), p.y);
  check_number(v, "weight", is_exact_weight(p.w), p.w);
  const WeightedPoint before = mesh.point(v);
  mesh.set_point(v, p);
  try {
    for (const HalfedgeId h : mesh.star(v)) check_counter_clockwise(mesh, Mesh::triangle(h));
  } catch (...) {
    mesh.set_point(v, before);
    throw;
  }
}

template <class T>
std::span<const T> span(const T* data, std::size_t n) {
  return {data, data == nullptr ? 0 : n};
}

/// The edges that `wanted` says, each once, from the halfedge that stands for it.
template <class Wanted>
void answer_edges(const Mesh& mesh, const Wanted& wanted) {
  std::vector<std::int32_t> ends;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || !wanted(h)) continue;
    ends.push_back(static_cast<std::int32_t>(mesh.origin(h).index));
    ends.push_back(static_cast<std::int32_t>(mesh.target(h).index));
  }
  answer_array(std::span<const std::int32_t>(ends));
}

// --- examples ---------------------------------------------------------------------------------------------------

/// A row for each function of generate.hpp: its name, the names of its parameters, and the call.
struct Generator {
  std::string_view name;
  std::vector<std::string_view> parameters;
  Expected<Mesh> (*make)(const Json& given);
};

std::span<const Generator> generators() {
  static const std::vector<Generator> rows = {
      {"sparse_horseshoe", {}, [](const Json&) -> Expected<Mesh> { return sparse_horseshoe(); }},
      {"horseshoe",
       {"a", "b", "x", "y"},
       [](const Json& given) {
         Horseshoe shape;
         take(given, "a", shape.a), take(given, "b", shape.b), take(given, "x", shape.x), take(given, "y", shape.y);
         return horseshoe(shape);
       }},
      {"single_triangle",
       {"a", "b", "angle_deg"},
       [](const Json& given) {
         SingleTriangle shape;
         take(given, "a", shape.a), take(given, "b", shape.b), take(given, "angle_deg", shape.angle_deg);
         return single_triangle(shape);
       }},
      {"random_mesh",
       {"vertices", "seed", "polygon"},
       [](const Json& given) {
         RandomMesh shape;
         std::vector<std::array<double, 2>> polygon;
         take(given, "vertices", shape.vertices), take(given, "seed", shape.seed), take(given, "polygon", polygon);
         for (const auto& [x, y] : polygon) shape.polygon.push_back({x, y});
         return random_mesh(shape);
       }},
      {"sheared_grid",
       {"nx", "ny", "shear"},
       [](const Json& given) {
         ShearedGrid shape;
         take(given, "nx", shape.nx), take(given, "ny", shape.ny), take(given, "shear", shape.shear);
         return sheared_grid(shape);
       }},
      {"annulus",
       {"inner", "outer", "around", "rings", "jitter", "seed"},
       [](const Json& given) {
         Annulus shape;
         take(given, "inner", shape.inner), take(given, "outer", shape.outer), take(given, "around", shape.around);
         take(given, "rings", shape.rings), take(given, "jitter", shape.jitter), take(given, "seed", shape.seed);
         return annulus(shape);
       }},
      {"airfoil",
       {"around", "growth", "seed"},
       [](const Json& given) {
         Airfoil shape;
         take(given, "around", shape.around), take(given, "growth", shape.growth), take(given, "seed", shape.seed);
         return airfoil(shape);
       }},
      {"regular_polygon",
       {"corners"},
       [](const Json& given) {
         RegularPolygon shape;
         take(given, "corners", shape.corners);
         return regular_polygon(shape);
       }},
      {"letter_a", {}, [](const Json&) -> Expected<Mesh> { return letter_a(); }},
      {"wedge",
       {"angle_deg", "pieces", "seed"},
       [](const Json& given) {
         Wedge shape;
         take(given, "angle_deg", shape.angle_deg), take(given, "pieces", shape.pieces);
         take(given, "seed", shape.seed);
         return wedge(shape);
       }},
      {"graded_mesh",
       {"finest", "growth", "seed"},
       [](const Json& given) {
         GradedMesh shape;
         take(given, "finest", shape.finest), take(given, "growth", shape.growth), take(given, "seed", shape.seed);
         return graded_mesh(shape);
       }},
  };
  return rows;
}

}  // namespace

/// Null: the answer says why. Otherwise it is {"reversed_triangles"}.
TEMPER_EXPORT(mesh_build)
HeldMesh* mesh_build(const Vec2* points, std::size_t n_points, const std::array<std::int32_t, 3>* triangles,
                     std::size_t n_triangles, const double* weights, std::size_t n_weights,
                     const std::array<std::int32_t, 2>* constrained, std::size_t n_constrained,
                     const std::int32_t* regions, std::size_t n_regions, const std::int32_t* fixed,
                     std::size_t n_fixed) {
  return guarded<HeldMesh*>(nullptr, [&] {
    MeshInput input;
    input.points = span(points, n_points);
    input.triangles = span(triangles, n_triangles);
    input.weights = span(weights, n_weights);
    input.constrained_edges = span(constrained, n_constrained);
    input.regions = span(regions, n_regions);
    input.fixed_vertices = span(fixed, n_fixed);
    BuiltMesh built = or_fail(Mesh::build(input));
    answer(Json{{"reversed_triangles", built.reversed_triangles}});
    return new HeldMesh(std::move(built.mesh));
  });
}

/// Names of examples, and of their parameters.
TEMPER_EXPORT(generators) void answer_generators() {
  Json rows = Json::array();
  for (const Generator& row : generators()) rows.push_back({{"name", row.name}, {"parameters", row.parameters}});
  answer(rows);
}
/// An example mesh. Null: the answer says why.
TEMPER_EXPORT(mesh_generate)
HeldMesh* mesh_generate(const char* name, std::size_t name_size, const char* parameters, std::size_t size) {
  return guarded<HeldMesh*>(nullptr, [&]() -> HeldMesh* {
    const std::string_view wanted(name, name_size);
    const Json given = parse({parameters, size});
    for (const Generator& row : generators()) {
      if (row.name != wanted) continue;
      expect_names(given, row.parameters);
      return new HeldMesh(or_fail(row.make(given)));
    }
    throw WrongType{"there is no example " + std::string(wanted)};
  });
}

TEMPER_EXPORT(mesh_copy) HeldMesh* mesh_copy(const HeldMesh* held) {
  return guarded<HeldMesh*>(nullptr, [&] { return new HeldMesh(*held); });
}
TEMPER_EXPORT(mesh_release) void mesh_release(HeldMesh* held) { delete held; }
TEMPER_EXPORT(mesh_equal) int mesh_equal(const HeldMesh* a, const HeldMesh* b) { return a->mesh == b->mesh ? 1 : 0; }

TEMPER_EXPORT(mesh_n_vertices) std::size_t mesh_n_vertices(const HeldMesh* held) { return held->mesh.n_vertices(); }
TEMPER_EXPORT(mesh_n_triangles) std::size_t mesh_n_triangles(const HeldMesh* held) { return held->mesh.n_triangles(); }
TEMPER_EXPORT(mesh_n_edges) std::size_t mesh_n_edges(const HeldMesh* held) { return held->mesh.n_edges(); }

// Arrays as they lie in memory: valid until the mesh changes or any call takes memory.
/// x, y, w and 8 bytes of something else of each vertex.
TEMPER_EXPORT(mesh_vertex_data) const double* mesh_vertex_data(const HeldMesh* held) {
  static_assert(Mesh::kVertexStride == 4 * sizeof(double));
  return held->mesh.vertex_data();
}
TEMPER_EXPORT(mesh_corner_data) const VertexId* mesh_corner_data(const HeldMesh* held) {
  return held->mesh.corner_data().data();
}
TEMPER_EXPORT(mesh_twin_data) const HalfedgeId* mesh_twin_data(const HeldMesh* held) {
  return held->mesh.twin_data().data();
}

// Arrays of int32 as the answer.
TEMPER_EXPORT(mesh_corner_weights) int mesh_corner_weights(const HeldMesh* held) {
  return done([&] { answer_array(std::span<const double>(held->corner_weights)); });
}
TEMPER_EXPORT(mesh_regions) int mesh_regions(const HeldMesh* held) {
  return done([&] {
    std::vector<std::int32_t> regions;
    for (const TriangleId t : held->mesh.triangles()) regions.push_back(held->mesh.region(t));
    answer_array(std::span<const std::int32_t>(regions));
  });
}
TEMPER_EXPORT(mesh_fixed) int mesh_fixed(const HeldMesh* held) {
  return done([&] {
    std::vector<VertexId> fixed;
    for (const VertexId v : held->mesh.vertices()) {
      if (held->mesh.is_fixed(v)) fixed.push_back(v);
    }
    answer_array(std::span<const VertexId>(fixed));
  });
}
TEMPER_EXPORT(mesh_edges) int mesh_edges(const HeldMesh* held) {
  return done([&] { answer_edges(held->mesh, [](HalfedgeId) { return true; }); });
}
TEMPER_EXPORT(mesh_boundary_edges) int mesh_boundary_edges(const HeldMesh* held) {
  return done([&] { answer_edges(held->mesh, [&](HalfedgeId h) { return held->mesh.is_boundary(h); }); });
}
TEMPER_EXPORT(mesh_constrained_edges) int mesh_constrained_edges(const HeldMesh* held) {
  return done([&] { answer_edges(held->mesh, [&](HalfedgeId h) { return held->mesh.is_constrained(h); }); });
}

/// All positions at once; a mesh that is none there is left as it was.
TEMPER_EXPORT(mesh_set_points) int mesh_set_points(HeldMesh* held, const double* in) {
  return done([&] {
    Mesh mesh = held->mesh;
    for (const VertexId v : mesh.vertices()) {
      const Vec2 p{*in++, *in++};
      check_number(v, "coordinates", is_exact_coordinate(p.x) && is_exact_coordinate(p.y), p.x + p.y);
      mesh.set_position(v, p);
    }
    for (const TriangleId t : mesh.triangles()) check_counter_clockwise(mesh, t);
    held->mesh = std::move(mesh);
  });
}
TEMPER_EXPORT(mesh_set_weights) int mesh_set_weights(HeldMesh* held, const double* in) {
  return done([&] {
    for (const VertexId v : held->mesh.vertices()) check_number(v, "weight", is_exact_weight(in[v.index]), in[v.index]);
    for (const VertexId v : held->mesh.vertices()) held->mesh.set_weight(v, in[v.index]);
    held->corner_weights.clear();
  });
}
TEMPER_EXPORT(mesh_set_point) int mesh_set_point(HeldMesh* held, std::int32_t v, double x, double y, double w) {
  return done([&] { set_point(held->mesh, vertex_id(held->mesh, v), {x, y, w}); });
}
TEMPER_EXPORT(mesh_set_fixed) int mesh_set_fixed(HeldMesh* held, const std::int32_t* vertices, std::size_t n) {
  return done([&] {
    Mesh& mesh = held->mesh;
    for (const std::int32_t v : span(vertices, n)) static_cast<void>(vertex_id(mesh, v));
    for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, false);
    for (const std::int32_t v : span(vertices, n)) mesh.set_fixed(vertex_id(mesh, v), true);
  });
}

/// The answer is the first thing that does not hold of the mesh, or null.
TEMPER_EXPORT(mesh_validate) int mesh_validate(const HeldMesh* held) {
  return done([&] {
    const std::optional<std::string> problem = held->mesh.validate();
    answer(problem ? Json(*problem) : Json(nullptr));
  });
}

/// Lawson's flips. Vertices that the weights hide stay.
TEMPER_EXPORT(mesh_restore_regularity) int mesh_restore_regularity(HeldMesh* held) {
  return done([&] {
    const Restoration r = restore_regularity(held->mesh);
    if (r.flips > 0) held->corner_weights.clear();  // the edges are regular for the weights of the vertices
    Json json = {{"flips", r.flips}, {"regular", r.regular()}, {"stuck", Json::array()}, {"hidden", Json::array()}};
    for (const HalfedgeId h : r.stuck) json["stuck"].push_back(h.index);
    for (const VertexId v : r.hidden) json["hidden"].push_back(v.index);
    answer(json);
  });
}

}  // namespace temper::wasm

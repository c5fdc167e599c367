// The mesh: made from arrays, shown as arrays, changed by arrays. See mesh.hpp.
#include <algorithm>
#include <cmath>

#include "bind.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::python {
namespace {

// --- from arrays --------------------------------------------------------------------------------------------

py::tuple mesh_from_arrays(double radius, std::pair<double, double> period, const Doubles& points,
                           const py::array& triangles, const Doubles& weights, const Int64s& constrained_edges,
                           const Int32s& regions, const Int64s& fixed, const py::object& threads) {
  const bool narrow_already = py::isinstance<Int32s>(triangles);
  const Int32s same = narrow_already ? Int32s(triangles) : Int32s(Shape{0, 3});
  std::vector<std::array<std::int32_t, 3>> narrowed;
  if (!narrow_already) narrowed = narrow<3>(Int64s(triangles), "triangle");
  const auto edges = narrow<2>(constrained_edges, "constrained edge");
  const auto fixed_vertices = narrow<1>(fixed, "fixed vertex");
  MeshInput input;
  if (radius > 0) {
    input.space = Space::sphere(radius);
    input.sphere_points = as_span<Vec3>(points);
  } else {
    input.points = as_span<Vec2>(points);
    if (period.first > 0 || period.second > 0) input.space = Space::periodic({period.first, period.second});
  }
  input.weights = as_span<double>(weights);
  input.triangles = narrow_already ? as_span<std::array<std::int32_t, 3>>(same) : std::span(std::as_const(narrowed));
  input.constrained_edges = edges;
  input.regions = as_span<std::int32_t>(regions);
  input.fixed_vertices = {fixed_vertices.empty() ? nullptr : fixed_vertices.front().data(), fixed_vertices.size()};
  const auto count = threads_from(threads);
  auto built = aside([&] {
    const auto executor = make_threads(count);
    input.executor = executor.get();
    return Mesh::build(input);
  });
  BuiltMesh result = or_raise(std::move(built));
  return py::make_tuple(std::make_unique<PyMesh>(std::move(result.mesh)), result.reversed_triangles);
}

// --- arrays of a mesh ---------------------------------------------------------------------------------------

/// The first `per` numbers of each vertex, as they lie in memory.
py::array vertex_view(const std::shared_ptr<const Mesh>& mesh, py::ssize_t per) {
  const auto n = static_cast<py::ssize_t>(mesh->n_vertices());
  constexpr py::ssize_t stride = Mesh::kVertexStride;
  return view(py::dtype::of<double>(), {n, per}, {stride, py::ssize_t{sizeof(double)}}, mesh->vertex_data(),
              keep(mesh));
}

/// Copies are read-only, so that nobody expects a write to change the mesh.
py::array read_only(py::array array) {
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

py::array points_of(const std::shared_ptr<const Mesh>& mesh) {
  if (mesh->space().is_plane()) return vertex_view(mesh, 2);
  std::vector<Vec3> places;
  places.reserve(mesh->n_vertices());
  for (const VertexId v : mesh->vertices()) {
    const WeightedPoint p = mesh->point(v);
    places.push_back(as_vector(mesh->weight(v) == 0 ? p : mesh->space().with_weight(p, 0)));
  }
  return read_only(rows_of<double>(std::span<const Vec3>(places)));
}

py::array weighted_vectors_of(const std::shared_ptr<const Mesh>& mesh) {
  if (mesh->space().is_plane()) {
    fail(ErrorCode::unsupported, "weighted_vectors: the mesh is one of the plane; its vertices are points and weights");
  }
  return vertex_view(mesh, 3);
}

py::array weights_of(const std::shared_ptr<const Mesh>& mesh) {
  const auto n = static_cast<py::ssize_t>(mesh->n_vertices());
  if (!mesh->space().is_plane()) {
    std::vector<double> weights;
    weights.reserve(mesh->n_vertices());
    for (const VertexId v : mesh->vertices()) weights.push_back(mesh->weight(v));
    return read_only(array_of<double>(weights));
  }
  constexpr py::ssize_t stride = Mesh::kVertexStride;
  const double* first = n == 0 ? nullptr : mesh->vertex_data() + 2;
  return view(py::dtype::of<double>(), {n}, {stride}, first, keep(mesh));
}

py::array triangles_of(const std::shared_ptr<const Mesh>& mesh) {
  const auto m = static_cast<py::ssize_t>(mesh->n_triangles());
  constexpr py::ssize_t item = sizeof(VertexId);
  return view(dtype_of<VertexId>(), {m, 3}, {3 * item, item}, mesh->corner_data().data(), keep(mesh));
}

py::array twins_of(const std::shared_ptr<const Mesh>& mesh) {
  const auto n = static_cast<py::ssize_t>(mesh->n_halfedges());
  return view(dtype_of<HalfedgeId>(), {n}, {py::ssize_t{sizeof(HalfedgeId)}}, mesh->twin_data().data(), keep(mesh));
}

py::array regions_of(const Mesh& mesh) {
  py::array_t<std::int32_t> copy(Shape{static_cast<py::ssize_t>(mesh.n_triangles())});
  std::int32_t* out = copy.mutable_data();
  for (const TriangleId t : mesh.triangles()) *out++ = mesh.region(t);
  return copy;
}

py::array fixed_of(const Mesh& mesh) {
  std::vector<VertexId> fixed;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_fixed(v)) fixed.push_back(v);
  }
  return array_of<VertexId>(fixed);
}

/// The edges that `wanted` accepts, each once, from its representative halfedge.
template <class Wanted>
py::array edges_of(const Mesh& mesh, const Wanted& wanted) {
  std::vector<std::array<std::int32_t, 2>> edges;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_erased(Mesh::triangle(h)) || !mesh.is_edge_representative(h) || !wanted(h)) continue;
    edges.push_back({static_cast<std::int32_t>(mesh.origin(h).index), static_cast<std::int32_t>(mesh.target(h).index)});
  }
  return rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 2>>(edges));
}

// --- changes ------------------------------------------------------------------------------------------------

/// The numbers of vertices that are assigned.
enum class Assigned { points, weights, weighted_vectors };

[[noreturn]] void fail_at(VertexId v, ErrorCode code, const std::string& message) {
  fail(code, "point " + std::to_string(v.index) + ": " + message);
}

/// The vertex with these numbers instead of its old ones.
WeightedPoint assigned(const Space& space, VertexId v, const WeightedPoint& former, Assigned what, const double* in) {
  if (what == Assigned::weights) {
    if (space.is_plane()) return {former.x, former.y, in[0]};
    if (!(in[0] > -space.radius() * space.radius()))
      fail_at(v, ErrorCode::out_of_scale, "weight not above minus the square of the radius");
    return space.vertex_at(as_vector(former), in[0]);
  }
  if (space.is_plane()) return space.in_domain({in[0], in[1], former.w});
  const Vec3 p = {in[0], in[1], in[2]};
  if (what == Assigned::weighted_vectors) return as_point(p);
  constexpr double kOffRadius = 1e-6;  // as Mesh::build
  if (!(std::abs(length(p) - space.radius()) <= kOffRadius * space.radius()))
    fail_at(v, ErrorCode::not_on_sphere, "not at the radius of the sphere, to one part in a million");
  return space.vertex_at(p, space.weight(former));
}

/// Sets all vertices at once. If the result is no mesh, the mesh is unchanged.
void set_vertices(PyMesh& self, const Doubles& values, Assigned what) {
  const auto before = self.read();
  const Space& space = before->space();
  const std::size_t per = what == Assigned::weights ? 1 : space.is_plane() ? 2 : 3;
  if (static_cast<std::size_t>(values.size()) != per * before->n_vertices()) {
    fail(ErrorCode::size_mismatch, std::string(what == Assigned::weights ? "weights: " : "points: ") + "expected " +
                                       std::to_string(before->n_vertices()) + ", found " +
                                       std::to_string(static_cast<std::size_t>(values.size()) / per));
  }
  Mesh mesh = *before;
  const double* in = values.data();
  for (const VertexId v : mesh.vertices()) {
    const std::span<const double> own(in, per);
    const std::string kind = what == Assigned::weights ? "weight" : "coordinates";
    if (!std::all_of(own.begin(), own.end(), [](double x) { return std::isfinite(x); }))
      fail_at(v, ErrorCode::not_finite, kind + " not finite");
    const bool exact =
        what == Assigned::weights ? is_exact_weight(in[0]) : std::all_of(own.begin(), own.end(), is_exact_coordinate);
    if (!exact) fail_at(v, ErrorCode::out_of_scale, kind + " out of the range of exact arithmetic");
    mesh.set_point(v, assigned(space, v, mesh.point(v), what, in));
    in += per;
  }
  for (const TriangleId t : mesh.triangles()) {
    if (what == Assigned::weights) break;
    const auto [p, q, r] = mesh.points(t);
    const bool fits = space.are_near(p, q) && space.are_near(q, r) && space.are_near(r, p);
    if (fits && orientation(space, p, q, r) == Sign::positive) continue;
    fail(ErrorCode::zero_area, "triangle " + std::to_string(t.index) + " is not counter-clockwise at these points");
  }
  self.replace(std::move(mesh), {});
}

/// The mesh whose marks will change. Error: erased triangles.
std::shared_ptr<const Mesh> to_mark(const PyMesh& self) { return self.read(); }
std::shared_ptr<const Mesh> to_mark(const PySurface& self) { return connectivity_of(self); }

/// Calls f with the mesh for changes.
template <class F>
void change(PyMesh& self, const F& f) {
  f(self.change());
}
template <class F>
void change(PySurface& self, const F& f) {
  const Run run(self.running);
  surfaces::SurfaceMesh mesh = self.mesh();
  f(mesh);
  replace(self, std::move(mesh));
}

template <class AnyMesh>
void set_fixed(AnyMesh& self, const Int64s& vertices) {
  std::vector<VertexId> ids;
  for (const std::int64_t v : as_span<std::int64_t>(vertices)) ids.push_back(vertex_id(*to_mark(self), v));
  change(self, [&](auto& mesh) {
    for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, false);
    for (const VertexId v : ids) mesh.set_fixed(v, true);
  });
}

template <class AnyMesh>
void set_constrained(AnyMesh& self, const Int64s& edges, bool constrained) {
  std::vector<HalfedgeId> halfedges;
  const auto before = to_mark(self);
  for (const auto& [a, b] : as_span<std::array<std::int64_t, 2>>(edges)) {
    const VertexId from = vertex_id(*before, a), to = vertex_id(*before, b);
    HalfedgeId h = before->find_halfedge(from, to);
    if (!h.valid()) h = before->find_halfedge(to, from);
    if (!h.valid()) {
      fail(ErrorCode::missing_edge, "the mesh has no edge " + std::to_string(a) + "-" + std::to_string(b));
    }
    halfedges.push_back(h);
  }
  change(self, [&](auto& mesh) {
    for (const HalfedgeId h : halfedges) mesh.set_constrained(h, constrained);
  });
}

void bind_space(py::class_<PyMesh>& type) {
  type.def("memory_bytes", [](const PyMesh& self) { return self.read_with_erased()->memory_bytes(); });
  type.def("require_plane",
           [](const PyMesh& self, const std::string& what) { require_plane(*self.read_with_erased(), what); });
  type.def("require_no_period",
           [](const PyMesh& self, const std::string& what) { require_no_period(*self.read_with_erased(), what); });
  type.def("period", [](const PyMesh& self) {
    const Vec2 period = self.read_with_erased()->space().period();
    return py::make_tuple(period.x, period.y);
  });
  type.def("radius", [](const PyMesh& self) { return self.read_with_erased()->space().radius(); });
  type.def("weighted_vectors", [](const PyMesh& self) { return weighted_vectors_of(self.read_with_erased()); });
  type.def("points", [](const PyMesh& self) { return points_of(self.read_with_erased()); });
}

void bind_changes(py::class_<PyMesh>& type) {
  type.def("set_points", [](PyMesh& self, const Doubles& points) { set_vertices(self, points, Assigned::points); });
  type.def("set_weights", [](PyMesh& self, const Doubles& weights) { set_vertices(self, weights, Assigned::weights); });
  type.def("set_weighted_vectors",
           [](PyMesh& self, const Doubles& points) { set_vertices(self, points, Assigned::weighted_vectors); });
  type.def("compact", [](PyMesh& self) { return to_python(self.compact()); });
  type.def("replace", [](PyMesh& self, const PyMesh& other) { self.assign(other); });
}

void bind_state(py::class_<PyMesh>& type) {
  type.def("validate", [](const PyMesh& self) { return to_python(self.read_with_erased()->validate()); });
  type.def("has_data", [](const PyMesh& self) {
    const auto& source = self.source();
    return source && source->file.point_data.size() + source->file.triangles.data.size() > 0;
  });
  define_data_rules(type);
  type.def("version", [](const PyMesh& self) { return self.version(); });
  type.def("copy", [](const PyMesh& self) { return self.copy(); });
  type.def("equal", [](const PyMesh& self, const PyMesh& other) {
    return *self.read_with_erased() == *other.read_with_erased();
  });
}

}  // namespace

/// The mesh in the metric, without the file of the original, whose points and data belong to the original places.
std::unique_ptr<PyMesh> map_mesh(const PyMesh& self, const py::object& tensor) {
  const Metric metric = metric_from(tensor);
  const auto mesh = self.read();
  const py::gil_scoped_release release;
  return std::make_unique<PyMesh>(or_raise(mapped(*mesh, metric)).mesh);
}

std::unique_ptr<PyMesh> map_mesh_back(const PyMesh& changed, const PyMesh& original, const py::object& tensor,
                                      const Int64s& numbers) {
  const Metric metric = metric_from(tensor);
  const auto mesh = changed.read(), before = original.read();
  const auto given = as_span<std::int64_t>(numbers);
  if (given.empty() && mesh->n_vertices() != before->n_vertices()) {
    fail(ErrorCode::size_mismatch, "vertices: the mesh has " + std::to_string(mesh->n_vertices()) + ", the original " +
                                       std::to_string(before->n_vertices()) + "; say which is which");
  }
  if (!given.empty() && given.size() != mesh->n_vertices()) {
    fail(ErrorCode::size_mismatch, "vertices: expected " + std::to_string(mesh->n_vertices()) + " numbers, found " +
                                       std::to_string(given.size()));
  }
  IdVector<VertexId, VertexId> vertices;
  for (const std::int64_t number : given) vertices.push_back(number < 0 ? VertexId() : vertex_id(*before, number));
  auto result = std::make_unique<PyMesh>(original.copy());
  const MetricMesh pieces = or_raise(mapped(*before, metric));
  result->replace(or_raise(mapped_back(with_mesh(pieces, *mesh, vertices), *before, pieces, vertices)).mesh, vertices);
  return result;
}

template <class AnyMesh>
void define_triangles(py::class_<AnyMesh>& type) {
  type.def("n_vertices", [](const AnyMesh& self) { return connectivity_of(self)->n_vertices(); });
  type.def("n_triangles", [](const AnyMesh& self) { return connectivity_of(self)->n_triangles(); });
  type.def("n_edges", [](const AnyMesh& self) { return connectivity_of(self)->n_edges(); });
  type.def("weights", [](const AnyMesh& self) { return weights_of(connectivity_of(self)); });
  type.def("triangles", [](const AnyMesh& self) { return triangles_of(connectivity_of(self)); });
  type.def("twins", [](const AnyMesh& self) { return twins_of(connectivity_of(self)); });
  type.def("regions", [](const AnyMesh& self) { return regions_of(*connectivity_of(self)); });
  type.def("fixed", [](const AnyMesh& self) { return fixed_of(*connectivity_of(self)); });
  type.def("edges", [](const AnyMesh& self) {
    const auto mesh = connectivity_of(self);
    return edges_of(*mesh, [](HalfedgeId) { return true; });
  });
  type.def("boundary_edges", [](const AnyMesh& self) {
    const auto mesh = connectivity_of(self);
    return edges_of(*mesh, [&](HalfedgeId h) { return mesh->is_boundary(h); });
  });
  type.def("constrained_edges", [](const AnyMesh& self) {
    const auto mesh = connectivity_of(self);
    return edges_of(*mesh, [&](HalfedgeId h) { return mesh->is_constrained(h); });
  });
  type.def("set_fixed", set_fixed<AnyMesh>);
  type.def("set_constrained", set_constrained<AnyMesh>);
  type.def("find_halfedge", [](const AnyMesh& self, std::int64_t a, std::int64_t b) {
    const auto mesh = connectivity_of(self);
    return to_python(mesh->find_halfedge(vertex_id(*mesh, a), vertex_id(*mesh, b)));
  });
  type.def("star", [](const AnyMesh& self, std::int64_t v) {
    const auto mesh = connectivity_of(self);
    std::vector<HalfedgeId> star;
    if (const VertexId id = vertex_id(*mesh, v); !mesh->is_isolated(id)) {
      for (const HalfedgeId h : mesh->star(id)) star.push_back(h);
    }
    return to_python(star);
  });
}
template void define_triangles(py::class_<PyMesh>&);
template void define_triangles(py::class_<PySurface>&);

void bind_mesh(py::module_& m) {
  m.def("mapped", map_mesh);
  m.def("mapped_back", map_mesh_back);
  m.def("mesh_from_arrays", mesh_from_arrays);
  py::class_<PyMesh> type(m, "Mesh");
  define_triangles(type);
  bind_space(type);
  bind_changes(type);
  bind_state(type);
}

}  // namespace temper::python

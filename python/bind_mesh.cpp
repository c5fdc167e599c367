// Meshes from arrays and files, and back: mesh.hpp, io.hpp, generate.hpp.
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "bind.hpp"
#include "temper/generate.hpp"
#include "temper/geometry.hpp"

namespace temper::python {
namespace {

// --- from arrays --------------------------------------------------------------------------------------------

/// Vertex numbers of 64 bits as the 32 bits of the library. Those that do not fit are of no vertex; the others are
/// checked by whoever knows how many there are.
template <std::size_t n>
std::vector<std::array<std::int32_t, n>> narrow(const Int64s& array, const char* kind) {
  const auto wide = as_span<std::array<std::int64_t, n>>(array);
  std::vector<std::array<std::int32_t, n>> result(wide.size());
  for (std::size_t i = 0; i < wide.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      if (wide[i][k] < INT32_MIN || wide[i][k] > INT32_MAX) {
        fail(ErrorCode::index_out_of_range, std::string(kind) + " " + std::to_string(i) + " uses vertex " +
                                                std::to_string(wide[i][k]) + ", which no mesh has");
      }
      result[i][k] = static_cast<std::int32_t>(wide[i][k]);
    }
  }
  return result;
}

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
  std::optional<Expected<BuiltMesh>> built;
  {
    const py::gil_scoped_release release;
    const auto executor = make_threads(count);
    input.executor = executor.get();
    built = Mesh::build(input);
  }
  BuiltMesh result = or_raise(*std::move(built));
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

/// Nobody is to think that writing to a copy changes the mesh.
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
    places.push_back(lifted(mesh->weight(v) == 0 ? p : mesh->space().with_weight(p, 0)));
  }
  return read_only(rows_of<double>(std::span<const Vec3>(places)));
}

py::array lifted_points_of(const std::shared_ptr<const Mesh>& mesh) {
  if (mesh->space().is_plane()) {
    fail(ErrorCode::unsupported, "lifted_points: the mesh is one of the plane; its vertices are points and weights");
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

/// The edges that `wanted` says, each once, from the halfedge that stands for it.
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
enum class Assigned { points, weights, lifted_points };

[[noreturn]] void fail_at(VertexId v, ErrorCode code, const std::string& message) {
  fail(code, "point " + std::to_string(v.index) + ": " + message);
}

/// The vertex with these numbers of its own instead of those that it had.
WeightedPoint assigned(const Space& space, VertexId v, const WeightedPoint& former, Assigned what, const double* in) {
  if (what == Assigned::weights) {
    if (space.is_plane()) return {former.x, former.y, in[0]};
    if (!(in[0] > -space.radius() * space.radius()))
      fail_at(v, ErrorCode::out_of_scale, "weight not above minus the square of the radius");
    return space.vertex_at(lifted(former), in[0]);
  }
  if (space.is_plane()) return space.in_domain({in[0], in[1], former.w});
  const Vec3 p = {in[0], in[1], in[2]};
  if (what == Assigned::lifted_points) return as_point(p);
  constexpr double kOffRadius = 1e-6;  // as Mesh::build
  if (!(std::abs(length(p) - space.radius()) <= kOffRadius * space.radius()))
    fail_at(v, ErrorCode::not_on_sphere, "not at the radius of the sphere, to one part in a million");
  return space.vertex_at(p, space.weight(former));
}

/// Sets all vertices at once; a mesh that is none then is left as it was.
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

void set_fixed(PyMesh& self, const Int64s& vertices) {
  std::vector<VertexId> ids;
  for (const std::int64_t v : as_span<std::int64_t>(vertices)) ids.push_back(vertex_id(*self.read(), v));
  Mesh& mesh = self.change();
  for (const VertexId v : mesh.vertices()) mesh.set_fixed(v, false);
  for (const VertexId v : ids) mesh.set_fixed(v, true);
}

void set_constrained(PyMesh& self, const Int64s& edges, bool constrained) {
  std::vector<HalfedgeId> halfedges;
  const auto before = self.read();
  for (const auto& [a, b] : as_span<std::array<std::int64_t, 2>>(edges)) {
    const VertexId from = vertex_id(*before, a), to = vertex_id(*before, b);
    HalfedgeId h = before->find_halfedge(from, to);
    if (!h.valid()) h = before->find_halfedge(to, from);
    if (!h.valid()) {
      fail(ErrorCode::missing_edge, "the mesh has no edge " + std::to_string(a) + "-" + std::to_string(b));
    }
    halfedges.push_back(h);
  }
  Mesh& mesh = self.change();
  for (const HalfedgeId h : halfedges) mesh.set_constrained(h, constrained);
}

void bind_mesh_class(py::module_& m) {
  py::class_<PyMesh> type(m, "Mesh");
  type.def("n_vertices", [](const PyMesh& self) { return self.read_with_erased()->n_vertices(); });
  type.def("n_triangles", [](const PyMesh& self) { return self.read_with_erased()->n_triangles(); });
  type.def("n_edges", [](const PyMesh& self) { return self.read_with_erased()->n_edges(); });
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
  type.def("lifted_points", [](const PyMesh& self) { return lifted_points_of(self.read_with_erased()); });
  type.def("points", [](const PyMesh& self) { return points_of(self.read_with_erased()); });
  type.def("weights", [](const PyMesh& self) { return weights_of(self.read_with_erased()); });
  type.def("triangles", [](const PyMesh& self) { return triangles_of(self.read_with_erased()); });
  type.def("twins", [](const PyMesh& self) { return twins_of(self.read_with_erased()); });
  type.def("regions", [](const PyMesh& self) { return regions_of(*self.read_with_erased()); });
  type.def("fixed", [](const PyMesh& self) { return fixed_of(*self.read_with_erased()); });
  type.def("edges", [](const PyMesh& self) {
    const auto mesh = self.read_with_erased();
    return edges_of(*mesh, [](HalfedgeId) { return true; });
  });
  type.def("boundary_edges", [](const PyMesh& self) {
    const auto mesh = self.read_with_erased();
    return edges_of(*mesh, [&](HalfedgeId h) { return mesh->is_boundary(h); });
  });
  type.def("constrained_edges", [](const PyMesh& self) {
    const auto mesh = self.read_with_erased();
    return edges_of(*mesh, [&](HalfedgeId h) { return mesh->is_constrained(h); });
  });
  type.def("set_points", [](PyMesh& self, const Doubles& points) { set_vertices(self, points, Assigned::points); });
  type.def("set_weights", [](PyMesh& self, const Doubles& weights) { set_vertices(self, weights, Assigned::weights); });
  type.def("set_lifted_points",
           [](PyMesh& self, const Doubles& points) { set_vertices(self, points, Assigned::lifted_points); });
  type.def("set_fixed", set_fixed);
  type.def("set_constrained", set_constrained);
  type.def("find_halfedge", [](const PyMesh& self, std::int64_t a, std::int64_t b) {
    const auto mesh = self.read_with_erased();
    return to_python(mesh->find_halfedge(vertex_id(*mesh, a), vertex_id(*mesh, b)));
  });
  type.def("star", [](const PyMesh& self, std::int64_t v) {
    const auto mesh = self.read_with_erased();
    std::vector<HalfedgeId> star;
    if (const VertexId id = vertex_id(*mesh, v); !mesh->is_isolated(id)) {
      for (const HalfedgeId h : mesh->star(id)) star.push_back(h);
    }
    return to_python(star);
  });
  type.def("validate", [](const PyMesh& self) { return to_python(self.read_with_erased()->validate()); });
  type.def("compact", [](PyMesh& self) { return to_python(self.compact()); });
  type.def("replace", [](PyMesh& self, const PyMesh& other) { self.assign(other); });
  type.def("has_data", [](const PyMesh& self) {
    const auto& source = self.source();
    return source && source->file.point_data.size() + source->file.cell_data.size() > 0;
  });
  type.def("version", [](const PyMesh& self) { return self.version(); });
  type.def("copy", [](const PyMesh& self) { return self.copy(); });
  type.def("equal", [](const PyMesh& self, const PyMesh& other) {
    return *self.read_with_erased() == *other.read_with_erased();
  });
}

// --- files ------------------------------------------------------------------------------------------------------

py::object to_python_array(const io::DataArray& data) {
  return std::visit(
      [&data](const auto& values) -> py::object {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const auto n = static_cast<py::ssize_t>(values.size());
        if (data.components == 1) return py::array(py::dtype::of<T>(), Shape{n}, values.data());
        return py::array(py::dtype::of<T>(), Shape{n / data.components, py::ssize_t{data.components}}, values.data());
      },
      data.values);
}

py::dict to_python_dict(const std::vector<io::DataArray>& arrays) {
  py::dict dict;
  for (const io::DataArray& array : arrays) dict[py::str(array.name)] = to_python_array(array);
  return dict;
}

template <class T>
bool take_values(io::DataArray& data, const py::array& array) {
  if (!array.dtype().is(py::dtype::of<T>()) && !array.dtype().equal(py::dtype::of<T>())) return false;
  const auto same = py::array_t<T, py::array::c_style | py::array::forcecast>(array);
  data.values = std::vector<T>(same.data(), same.data() + same.size());
  return true;
}

/// One- or two-dimensional arrays of the types that files have; the Python package has turned others into these.
io::DataArray from_python_array(const std::string& name, const py::array& array) {
  io::DataArray data{name, array.ndim() > 1 ? static_cast<int>(array.shape(1)) : 1, {}};
  const bool taken = take_values<double>(data, array) || take_values<float>(data, array) ||
                     take_values<std::int64_t>(data, array) || take_values<std::int32_t>(data, array) ||
                     take_values<std::uint8_t>(data, array) || take_values<std::int8_t>(data, array) ||
                     take_values<std::int16_t>(data, array) || take_values<std::uint16_t>(data, array) ||
                     take_values<std::uint32_t>(data, array) || take_values<std::uint64_t>(data, array);
  if (!taken) throw py::type_error("data '" + name + "': " + std::string(py::str(array.dtype())) + " is not supported");
  return data;
}

/// The same of so many rows.
io::DataArray from_python_array(const std::string& name, const py::array& array, std::size_t size, const char* kind) {
  if (static_cast<std::size_t>(array.shape(0)) != size) {
    fail(ErrorCode::size_mismatch, std::string(kind) + " '" + name + "': expected " + std::to_string(size) +
                                       " values, found " + std::to_string(array.shape(0)));
  }
  return from_python_array(name, array);
}

std::vector<io::DataArray> from_python_dict(const py::dict& dict, std::size_t size, const char* kind) {
  std::vector<io::DataArray> arrays;
  for (const auto& [name, value] : dict)
    arrays.push_back(from_python_array(name.cast<std::string>(), value.cast<py::array>(), size, kind));
  return arrays;
}

template <class T, class Array>
std::vector<T> copy_of(const Array& array) {
  const auto values = as_span<T>(array);
  return {values.begin(), values.end()};
}

/// A file, on the map of the projection when one is named, and the mesh in it.
std::shared_ptr<Source> source_of(io::MeshFile file, const std::string& projection,
                                  const std::vector<std::string>& fixed_tags, Executor* executor) {
  auto source = std::make_shared<Source>();
  source->file = std::move(file);
  const py::gil_scoped_release release;
  if (!projection.empty()) or_raise(io::project(source->file, projection));
  auto loaded = io::make_mesh(source->file, fixed_tags, executor);
  if (!loaded) throw BadInput{loaded.error()};
  source->loaded = *std::move(loaded);
  io::release_geometry(source->file, source->loaded);  // else it would be held twice
  return source;
}

/// The mesh of a file, with the rest of the file behind it, and the warnings.
py::tuple load(io::MeshFile file, const std::string& projection, const std::vector<std::string>& fixed_tags,
               Executor* executor) {
  const auto source = source_of(std::move(file), projection, fixed_tags, executor);
  std::vector<std::string> warnings = source->file.warnings;
  source->file.warnings.clear();
  warnings.insert(warnings.end(), source->loaded.warnings.begin(), source->loaded.warnings.end());
  Mesh mesh = std::move(source->loaded.mesh);
  source->loaded.mesh = Mesh();
  return py::make_tuple(std::make_unique<PyMesh>(std::move(mesh), source), to_python(warnings));
}

std::vector<std::string> strings_from(const py::sequence& sequence) {
  std::vector<std::string> strings;
  for (const auto& item : sequence) strings.push_back(item.cast<std::string>());
  return strings;
}

/// The file of a mesh, and what became of its data.
struct UpdatedFile {
  io::MeshFile file;
  io::DataReport data;
};

/// The one that the mesh came from, updated, or a new one. Without the GIL it takes a copy of the mesh that was made
/// with it, which shares the memory: others may change the mesh meanwhile.
UpdatedFile updated_file_of(const PyMesh& self, Executor* executor) {
  const auto mesh = self.read();
  if (!self.source()) return {io::from_mesh(*mesh), {}};
  UpdatedFile result{self.source()->file, {}};
  result.data = io::update(result.file, self.source()->loaded, *mesh, self.origin(), {self.data_rules(), executor});
  return result;
}

io::MeshFile file_of(const PyMesh& self, Executor* executor = nullptr) { return updated_file_of(self, executor).file; }

/// Sets an array of point data or cell data, or with None takes it away: the mesh is as if it came from such a file.
void set_data(PyMesh& self, bool of_points, const std::string& name, const py::object& values) {
  const std::uint64_t version = self.version();
  io::MeshFile file = file_of(self);
  std::vector<io::DataArray>& arrays = of_points ? file.point_data : file.cell_data;
  auto array = std::find_if(arrays.begin(), arrays.end(), [&](const io::DataArray& a) { return a.name == name; });
  if (values.is_none()) {
    if (array == arrays.end()) throw py::key_error(name);
    arrays.erase(array);
  } else {
    if (array == arrays.end()) array = arrays.insert(array, io::DataArray());
    *array = from_python_array(name, values.cast<py::array>(), of_points ? file.points.size() : file.triangles.size(),
                               of_points ? "point data" : "cell data");
  }
  const auto source = source_of(std::move(file), {}, {}, nullptr);
  source->loaded.mesh = Mesh();
  if (self.version() != version) {
    fail(ErrorCode::unsupported, "data '" + name + "' are as they were: another thread changed the mesh meanwhile");
  }
  self.set_source(source);
}

io::DataRules data_rules_from(const PyMesh& self, const py::sequence& words) {
  const auto rules = io::parse_data_rules(strings_from(words));
  if (!rules) throw BadInput{rules.error()};
  or_raise(io::check_data_rules(*rules, self.source() ? self.source()->file : io::MeshFile()));
  return *rules;
}

/// The words of the rules that a mesh has.
std::vector<std::string> data_words(const PyMesh& self) {
  const auto spell = [](io::DataRule rule) { return std::string(rule == io::DataRule::keep ? "keep" : "interpolate"); };
  std::vector<std::string> words = {spell(self.data_rules().rule)};
  for (const auto& [name, rule] : self.data_rules().exceptions) words.push_back(spell(rule) + "=" + name);
  return words;
}

py::dict data_report(const PyMesh& self, const py::object& threads) {
  const auto executor = make_threads(threads_from(threads));
  const PyMesh same = self.copy();
  io::DataReport r;
  {
    const py::gil_scoped_release release;
    r = updated_file_of(same, executor.get()).data;
  }
  return Record()("points", r.points)("points_moved", r.points_moved)("distance", r.distance)(
             "points_inserted", r.points_inserted)("interpolated", r.interpolated)("kept", r.kept)(
             "dropped", r.dropped)("triangles", r.triangles)("triangles_changed", r.triangles_changed)("of_triangles",
                                                                                                       r.of_triangles)
      .dict;
}

py::dict file_as_dict(const PyMesh& self) {
  const PyMesh same = self.copy();
  io::MeshFile file;
  {
    const py::gil_scoped_release release;
    file = file_of(same);
  }
  py::list names;
  for (const io::PhysicalName& n : file.names) names.append(py::make_tuple(n.dimension, n.tag, n.name));
  std::vector<Vec3> places = file.sphere_points;
  if (file.sphere_radius == 0) {
    for (const Vec2 p : file.points) places.push_back({p.x, p.y, file.z});
  }
  return Record()("points", rows_of<double>(std::span<const Vec3>(places)))("weights", file.weights)(
             "triangles", rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 3>>(file.triangles)))(
             "regions", array_of<std::int32_t>(file.regions))(
             "lines", rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 2>>(file.lines)))(
             "line_tags", array_of<std::int32_t>(file.line_tags))("marked_points",
                                                                  array_of<std::int32_t>(file.marked_points))(
             "point_tags", array_of<std::int32_t>(file.point_tags))("names", py::object(names))(
             "point_data", py::object(to_python_dict(file.point_data)))(
             "cell_data", py::object(to_python_dict(file.cell_data)))("line_data",
                                                                      py::object(to_python_dict(file.line_data)))(
             "marked_point_data", py::object(to_python_dict(file.marked_point_data)))(
             "field_data", py::object(to_python_dict(file.field_data)))("path", file.path)("format", file.format)(
             "warnings", file.warnings)
      .dict;
}

/// Vertex of each point that the mesh was made of, -1 where it is gone; None for a mesh that no file is behind.
py::object vertices_of_points(const PyMesh& self) {
  if (!self.source()) return py::none();
  const auto origin = self.origin();
  const io::VertexOfPoint& loaded = self.source()->loaded.vertex_of_point;
  std::vector<std::int32_t> now(loaded.n_kept(), -1);
  for (std::size_t v = 0; v < now.size() && origin.empty(); ++v) now[v] = static_cast<std::int32_t>(v);
  for (std::size_t i = 0; i < origin.size(); ++i) {
    const VertexId before = origin[VertexId(i)];
    if (before.valid()) now[before.index] = static_cast<std::int32_t>(i);
  }
  std::vector<std::int32_t> vertices;
  for (std::size_t p = 0; p < loaded.size(); ++p) {
    const std::int32_t v = loaded[p];
    vertices.push_back(v < 0 ? -1 : now[static_cast<std::size_t>(v)]);
  }
  return array_of<std::int32_t>(vertices);
}

template <std::size_t n>
void check_range(const std::vector<std::array<std::int32_t, n>>& cells, std::size_t n_points, const char* kind) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const std::int32_t p : cells[i]) {
      if (p >= 0 && static_cast<std::size_t>(p) < n_points) continue;
      fail(ErrorCode::index_out_of_range, std::string(kind) + " " + std::to_string(i) + " uses point " +
                                              std::to_string(p) + ", but there are " + std::to_string(n_points) +
                                              " points");
    }
  }
}

py::tuple mesh_from_file_arrays(const py::dict& d, const py::sequence& fixed_tags) {
  io::MeshFile file;
  const auto points = d["points"].cast<Doubles>();
  if (points.shape(1) == 3) {
    or_raise(io::set_points(file, copy_of<Vec3>(points)));
  } else {
    file.points = copy_of<Vec2>(points);
  }
  file.weights = copy_of<double>(d["weights"].cast<Doubles>());
  file.triangles = narrow<3>(d["triangles"].cast<Int64s>(), "triangle");
  file.regions = copy_of<std::int32_t>(d["regions"].cast<Int32s>());
  file.lines = narrow<2>(d["lines"].cast<Int64s>(), "line");
  file.line_tags = copy_of<std::int32_t>(d["line_tags"].cast<Int32s>());
  file.point_data = from_python_dict(d["point_data"].cast<py::dict>(), file.points.size(), "point data");
  file.cell_data = from_python_dict(d["cell_data"].cast<py::dict>(), file.triangles.size(), "cell data");
  file.line_data = from_python_dict(d["line_data"].cast<py::dict>(), file.lines.size(), "line data");
  const auto vertex_cells = narrow<1>(d["marked_points"].cast<Int64s>(), "vertex cell");
  check_range<1>(vertex_cells, file.points.size(), "vertex cell");
  for (const auto& [point] : vertex_cells) file.marked_points.push_back(point);
  file.point_tags = copy_of<std::int32_t>(d["point_tags"].cast<Int32s>());
  file.marked_point_data =
      from_python_dict(d["marked_point_data"].cast<py::dict>(), file.marked_points.size(), "data of vertex cells");
  check_range<3>(file.triangles, file.points.size(), "triangle");
  check_range<2>(file.lines, file.points.size(), "line");
  return load(std::move(file), {}, strings_from(fixed_tags), nullptr);
}

py::tuple read_file(const std::string& path, const py::sequence& fixed_tags, const std::string& projection,
                    const py::object& threads) {
  const auto tags = strings_from(fixed_tags);
  const auto executor = make_threads(threads_from(threads));
  std::optional<Expected<io::MeshFile>> file;
  {
    const py::gil_scoped_release release;
    file = io::read(path, {executor.get()});
  }
  return load(or_raise(*std::move(file)), projection, tags, executor.get());
}

py::object write_file(const std::string& path, const PyMesh& self, const std::string& format,
                      const std::string& encoding, bool triangle_quality, const py::object& threads) {
  const auto executor = make_threads(threads_from(threads));
  io::WriteOptions options;
  options.format = format;
  if (!encoding.empty()) options.encoding = from_name<io::Encoding>("encoding", encoding);
  options.triangle_quality = triangle_quality;
  options.executor = executor.get();
  const PyMesh same = self.copy();
  std::vector<std::string> warnings;
  {
    const py::gil_scoped_release release;
    const io::MeshFile file = file_of(same, executor.get());
    auto written = io::write(path, file, options);
    if (!written) throw BadInput{written.error()};
    warnings = file.warnings;
    warnings.insert(warnings.end(), written->begin(), written->end());
  }
  return to_python(warnings);
}

void bind_files(py::module_& m) {
  m.def("read", read_file);
  m.def("write", write_file);
  m.def("mesh_from_arrays", mesh_from_arrays);
  m.def("mesh_from_file_arrays", mesh_from_file_arrays);
  m.def("file_as_dict", file_as_dict);
  m.def("data_rules", [](const PyMesh& self) { return to_python(data_words(self)); });
  m.def("check_data_rules", [](const PyMesh& self, const py::sequence& words) { data_rules_from(self, words); });
  m.def("set_data_rules",
        [](PyMesh& self, const py::sequence& words) { self.set_data_rules(data_rules_from(self, words)); });
  m.def("data_report", data_report);
  m.def("set_data", set_data);
  m.def("vertices_of_points", vertices_of_points);
  m.def("write_text", [](const std::string& path, const std::string& text) { or_raise(io::write_text(path, text)); });
  m.def("formats", [] {
    py::list list;
    for (const io::Format& f : io::formats()) {
      list.append(
          Record()("name", f.name)("description", f.description)("suffixes", f.suffixes)("writes", f.writes)(
              "holds_weights", f.holds_weights)("holds_planes", f.holds_planes)("holds_spheres", f.holds_spheres)
              .dict);
    }
    return list;
  });
}

// --- examples -----------------------------------------------------------------------------------------------------

std::unique_ptr<PyMesh> made(Expected<Mesh> mesh) { return std::make_unique<PyMesh>(or_raise(std::move(mesh))); }

void bind_generate(py::module_& m) {
  m.def("constrained_delaunay", [](const Doubles& points, const Int64s& segments, bool carve) {
    const auto ends = narrow<2>(segments, "segment");
    std::optional<Expected<Mesh>> mesh;
    {
      const py::gil_scoped_release release;
      mesh = constrained_delaunay({as_span<Vec2>(points), ends, carve});
    }
    return made(*std::move(mesh));
  });
  m.def("sparse_horseshoe", [] { return std::make_unique<PyMesh>(sparse_horseshoe()); });
  m.def("letter_a", [] { return std::make_unique<PyMesh>(letter_a()); });
  m.def("horseshoe", [](int a, int b, double x0, double x1, double y0, double y1) {
    return made(horseshoe({a, b, {x0, x1}, {y0, y1}}));
  });
  m.def("single_triangle", [](double a, double b, double angle) { return made(single_triangle({a, b, angle})); });
  m.def("random_points", [](std::size_t vertices, std::uint64_t seed, const Doubles& polygon) {
    const auto corners = as_span<Vec2>(polygon);
    return made(random_points({vertices, seed, {corners.begin(), corners.end()}}));
  });
  m.def("spherical_delaunay", [](const Doubles& points, double radius) {
    std::optional<Expected<Mesh>> mesh;
    {
      const py::gil_scoped_release release;
      mesh = spherical_delaunay(as_span<Vec3>(points), radius);
    }
    return made(*std::move(mesh));
  });
  m.def("icosahedral", [](int level, double radius) { return made(icosahedral({level, radius})); });
  m.def("periodic_delaunay", [](const Doubles& points, double x, double y) {
    std::optional<Expected<Mesh>> mesh;
    {
      const py::gil_scoped_release release;
      mesh = periodic_delaunay(as_span<Vec2>(points), {x, y});
    }
    return made(*std::move(mesh));
  });
  m.def("random_periodic", [](std::size_t vertices, std::uint64_t seed, double x, double y) {
    return made(random_periodic({vertices, seed, {x, y}}));
  });
  m.def("periodic_hexagons", [](int nx, int ny, double distance, bool channel) {
    return made(periodic_hexagons({nx, ny, distance, channel}));
  });
  m.def("random_sphere", [](std::size_t vertices, std::uint64_t seed, double radius) {
    return made(random_sphere({vertices, seed, radius}));
  });
  m.def("graded_sphere",
        [](std::size_t vertices, double ratio, double lon, double lat, std::uint64_t seed, double radius) {
          return made(graded_sphere({vertices, ratio, {lon, lat}, seed, radius}));
        });
  m.def("graded_sphere_size",
        [](std::size_t vertices, double ratio, double lon, double lat, double radius, const Doubles& directions) {
          const GradedSphere shape = {.vertices = vertices, .ratio = ratio, .at = {lon, lat}, .radius = radius};
          std::vector<double> sizes;
          for (const Vec3 p : as_span<Vec3>(directions)) sizes.push_back(graded_sphere_size(shape, p));
          return to_python(sizes);
        });
  m.def("sheared_grid", [](int nx, int ny, double shear) { return made(sheared_grid({nx, ny, shear})); });
  m.def("annulus", [](double inner, double outer, int around, int rings, double jitter, std::uint64_t seed) {
    return made(annulus({inner, outer, around, rings, jitter, seed}));
  });
  m.def("airfoil", [](int around, double growth, std::uint64_t seed) { return made(airfoil({around, growth, seed})); });
  m.def("regular_polygon", [](int corners) { return made(regular_polygon({corners})); });
  m.def("wedge", [](double angle, int pieces, std::uint64_t seed) { return made(wedge({angle, pieces, seed})); });
  m.def("graded_points", [](double finest, double growth, std::uint64_t seed) {
    return made(graded_points({finest, growth, seed}));
  });
}

}  // namespace

/// It has no file behind it: what is written of one is where its points were.
std::unique_ptr<PyMesh> map_mesh(const PyMesh& self, const py::object& tensor) {
  const Metric metric = metric_from(tensor);
  const auto mesh = self.read();
  const py::gil_scoped_release release;
  return std::make_unique<PyMesh>(or_raise(mapped(*mesh, metric)));
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
  result->replace(or_raise(mapped_back(*mesh, *before, metric, vertices)), vertices);
  return result;
}

void bind_mesh(py::module_& m) {
  m.def("mapped", map_mesh);
  m.def("mapped_back", map_mesh_back);
  bind_mesh_class(m);
  bind_files(m);
  bind_generate(m);
}

}  // namespace temper::python

// The compiled half of the Python module: temper._temper. Its functions take and give plain values. The Python package
// around it has the signatures, defaults and documentation.
#include <algorithm>
#include <atomic>
#include <tuple>
#include <type_traits>

#include "bind.hpp"
#include "temper/detail/build_info.hpp"
#include "temper/detail/instruction_set.hpp"
#include "temper/detail/suggest.hpp"
#include "temper/detail/version.hpp"
#ifdef TEMPER_WITH_TBB
#include "temper/detail/tbb_executor.hpp"
#endif

namespace temper::python {

void fail(ErrorCode code, std::string message) { throw BadInput{{code, "", std::move(message)}}; }

py::array view(const py::dtype& type, Shape shape, Shape strides, const void* data, const py::object& owner) {
  py::array array(type, std::move(shape), std::move(strides), data, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

Metric metric_from(const py::handle& tensor) {
  const auto k = tensor.cast<py::sequence>();
  if (k.size() != 3)
    throw py::value_error("tensor: expected kxx, kxy, kyy, found " + std::to_string(k.size()) + " numbers");
  return or_raise(Metric::of({k[0].cast<double>(), k[1].cast<double>(), k[2].cast<double>()}));
}

namespace {

template <class K>
K tensor_at(const double* k) {
  if constexpr (std::is_same_v<K, Tensor>)
    return {k[0], k[1], k[2]};
  else
    return {k[0], k[1], k[2], k[3], k[4], k[5]};
}

template <class Metrics, class K>
Metrics metrics_of(const GivenTensors<K>& given) {
  return given.one ? Metrics(or_raise(MetricOf<K>::of(*given.one))) : or_raise(Metrics::of(given.of_cells));
}

}  // namespace

template <class K>
GivenTensors<K> tensors_from(const py::object& given) {
  constexpr std::size_t n = std::tuple_size_v<decltype(K().components())>;
  GivenTensors<K> tensors;
  const auto sequence = given.cast<py::sequence>();
  if (sequence.size() == n) {
    std::vector<double> k;
    for (const auto& component : sequence) k.push_back(component.cast<double>());
    tensors.one = or_raise(MetricOf<K>::of(tensor_at<K>(k.data()))).tensor();
    return tensors;
  }
  const auto [of_cells, weights] = given.cast<std::pair<Doubles, Doubles>>();
  const auto k = as_span<double>(of_cells);
  for (std::size_t t = 0; t + n <= k.size(); t += n) tensors.of_cells.push_back(tensor_at<K>(k.data() + t));
  const auto w = as_span<double>(weights);
  tensors.corner_weights.assign(w.begin(), w.end());
  return tensors;
}
template GivenTensors<Tensor> tensors_from(const py::object& given);
template GivenTensors<Tensor3> tensors_from(const py::object& given);

MetricMesh in_metric(const Mesh& mesh, const GivenTensors<Tensor>& given) {
  return or_raise(mapped(mesh, metrics_of<Metrics>(given), given.corner_weights));
}
tets::MetricMesh in_metric(const tets::TetMesh& mesh, const GivenTensors<Tensor3>& given) {
  return or_raise(mapped(mesh, metrics_of<tets::Metrics>(given), given.corner_weights));
}

py::object corner_weights_to_python(const std::vector<double>& weights, py::ssize_t corners) {
  if (weights.empty()) return py::none();
  py::array_t<double> array({static_cast<py::ssize_t>(weights.size()) / corners, corners});
  std::copy(weights.begin(), weights.end(), array.mutable_data());
  return array;
}

std::size_t choose(std::string_view option, std::string_view text, std::span<const std::string_view> names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  fail(ErrorCode::invalid_option, std::string(option) + ": expected one of " + join(names) + "; found '" +
                                      std::string(text) + "'" + did_you_mean(text, names));
}

LengthParameter length_parameter_from(const py::handle& value) {
  const auto pair = value.cast<py::tuple>();
  return {pair[0].cast<double>(), from_name<LengthScale>("scale", pair[1].cast<std::string>())};
}

// --- the mesh as Python holds it ------------------------------------------------------------------------

void refuse_while_running(bool running) {
  if (running) fail(ErrorCode::unsupported, "the mesh is being changed by a call that has not returned yet");
}

std::shared_ptr<const Mesh> PyMesh::read() const {
  if (erased_) fail(ErrorCode::unsupported, "the mesh has erased triangles: compact() drops them");
  return mesh_;
}

Mesh& PyMesh::change() {
  refuse_while_running();
  if (mesh_.use_count() > 1) mesh_ = std::make_shared<Mesh>(*mesh_);
  version_ = new_version();
  return *mesh_;
}

void PyMesh::replace(Mesh mesh, const IdVector<VertexId, VertexId>& vertices) {
  refuse_while_running();
  mesh_ = std::make_shared<Mesh>(std::move(mesh));
  compose(vertices);
  version_ = new_version();
  erased_ = false;
}

void PyMesh::assign(const PyMesh& other) {
  refuse_while_running();
  *this = other.copy();
  version_ = new_version();
}

void PyMesh::set_source(std::shared_ptr<const Source> source, IdVector<VertexId, VertexId> origin) {
  refuse_while_running();
  source_ = std::move(source);
  origin_ = std::move(origin);
  version_ = new_version();
}

std::uint64_t PyMesh::new_version() {
  static std::atomic<std::uint64_t> last = 0;  // meshes are also made without the GIL
  return ++last;
}

PyMesh PyMesh::copy() const {
  PyMesh copy = *this;
  copy.running_ = false;
  return copy;
}

IdVector<VertexId, VertexId> PyMesh::compact() {
  IdVector<VertexId, VertexId> vertices = change().compact().vertices;
  compose(vertices);
  erased_ = false;
  return vertices;
}

std::size_t PyMesh::n_vertices_of_source() const { return source_->loaded.vertex_of_point.n_kept(); }

IdVector<VertexId, VertexId> PyMesh::origin() const {
  const std::size_t n = mesh_->n_vertices();
  if (!source_ || (origin_.empty() && n == n_vertices_of_source())) return {};
  // Vertices that were inserted one by one follow.
  IdVector<VertexId, VertexId> origin = origin_;
  if (origin.empty()) {
    for (const VertexId v : IdRange<VertexId>(n_vertices_of_source())) origin.push_back(v);
  }
  origin.resize(n);
  return origin;
}

/// Converts numbers in the former state to numbers in the source.
void PyMesh::compose(const IdVector<VertexId, VertexId>& vertices) {
  if (vertices.empty() || !source_) return;
  const std::size_t known = origin_.empty() ? n_vertices_of_source() : origin_.size();
  IdVector<VertexId, VertexId> composed = vertices;
  for (VertexId& v : composed) {
    if (!v.valid() || v.index >= known) {
      v = VertexId();
    } else if (!origin_.empty()) {
      v = origin_[v];
    }
  }
  origin_ = std::move(composed);
}

void PyMesh::refuse_while_running() const { python::refuse_while_running(running_); }

Run::Run(bool& running) : running_(running) {
  refuse_while_running(running);
  running_ = true;
}

// --- threads, signals -----------------------------------------------------------------------------------

std::optional<std::size_t> threads_from(const py::handle& threads) {
  if (threads.is_none()) return std::nullopt;
  std::int64_t count = 0;
  try {
    count = threads.cast<std::int64_t>();
  } catch (const py::cast_error&) {
    throw py::type_error("threads: expected an integer or None, found " + std::string(py::repr(threads)));
  }
  if (count < 0) fail(ErrorCode::invalid_option, "threads: expected 0 or more, found " + std::to_string(count));
#ifdef TEMPER_WITH_TBB
  if (const std::size_t most = TbbExecutor::most_threads(); static_cast<std::size_t>(count) > most)
    fail(ErrorCode::invalid_option, "threads: expected at most " + std::to_string(most) +
                                        ", a few times the processors, found " + std::to_string(count) +
                                        ". Next: leave it out");
#endif
  return static_cast<std::size_t>(count);
}

std::unique_ptr<Executor> make_threads([[maybe_unused]] const std::optional<std::size_t>& threads) {
#ifdef TEMPER_WITH_TBB
  if (threads != std::size_t{1}) return std::make_unique<TbbExecutor>(threads.value_or(0));
#endif
  return nullptr;
}

bool Visitor::check_signals() {
  if (stopped()) return false;
  constexpr std::chrono::milliseconds kInterval(20);  // nobody notices it, and the GIL costs nothing
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kInterval) return true;
  last_ = now;
  return call([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return true;
  });
}

// --- ids ------------------------------------------------------------------------------------------------

namespace {

std::size_t checked(const char* kind, std::int64_t index, std::size_t size) {
  if (index >= 0 && static_cast<std::size_t>(index) < size) return static_cast<std::size_t>(index);
  fail(ErrorCode::index_out_of_range, std::string(kind) + " " + std::to_string(index) + ": expected 0 to " +
                                          std::to_string(static_cast<std::int64_t>(size) - 1));
}

void bind_build_info(py::module_& m) {
  const auto build = [] {
    py::dict info;
    for (const BuildFact& fact : build_info()) info[to_python(fact.name)] = to_python(fact.value);
    return info;
  };
  m.def(
      "build_info", build,
      "What `temper --version` prints, by the same names: \"version\", \"commit\" (\"unknown\" where it was not built\n"
      "in a clone), \"compiler\", \"processor\", \"instructions\", \"threads\", and the versions of libraries.\n\n"
      "libnetcdf and libhdf5 are looked for, and loaded, when this is asked.");
  const auto sets = [] {
    py::list list;
    for (const InstructionSet set : instruction_sets()) list.append(to_python(name(set)));
    return list;
  };
  m.def("instruction_sets", sets, "The instruction sets that this processor has code for, the fastest last.");
  m.def(
      "instruction_set", [] { return std::string(name(instruction_set())); }, "The instruction set in use.");
  const auto use = [](const std::string& wanted) {
    for (const InstructionSet set : instruction_sets()) {
      if (name(set) == wanted) return use_instruction_set(set);
    }
    return false;
  };
  m.def("use_instruction_set", use,
        "Uses another instruction set, by its name; False where there is none of that name.");
}

void raise_as_temper_error(const InputError& error) {
  const py::object type = py::module_::import("temper._errors").attr("TemperError");
  PyErr_SetObject(type.ptr(), type(std::string(name(error.code)), error.where, spelled(error.message)).ptr());
}

}  // namespace

void require_plane(const Mesh& mesh, std::string_view what) {
  if (auto error = expect_plane(mesh, what)) throw BadInput{*std::move(error)};
}

void require_no_period(const Mesh& mesh, std::string_view what) {
  if (auto error = expect_no_period(mesh, what)) throw BadInput{*std::move(error)};
}

VertexId vertex_id(const Mesh& mesh, std::int64_t index) {
  return VertexId(checked("vertex", index, mesh.n_vertices()));
}
TriangleId triangle_id(const Mesh& mesh, std::int64_t index) {
  const TriangleId t(checked("triangle", index, mesh.n_triangles()));
  if (mesh.is_erased(t)) fail(ErrorCode::index_out_of_range, "triangle " + std::to_string(index) + " is erased");
  return t;
}
HalfedgeId halfedge_id(const Mesh& mesh, std::int64_t index) {
  const HalfedgeId h(checked("halfedge", index, mesh.n_halfedges()));
  static_cast<void>(triangle_id(mesh, Mesh::triangle(h).index));
  return h;
}

}  // namespace temper::python

namespace temper::python {
namespace {

/// NumPy 2 has another memory layout of types, which pybind11 supports from 2.12 on. Before, arrays would silently be
/// zeros.
constexpr bool kKnowsNumPy2 = PYBIND11_VERSION_HEX >= 0x020C0000;

void refuse_unknown_numpy() {
  if (kKnowsNumPy2) return;
  const auto version = py::module_::import("numpy").attr("__version__").cast<std::string>();
  if (version.rfind("1.", 0) == 0) return;
  throw py::import_error("temper was built with a pybind11 before 2.12, which knows NumPy 1 only; found NumPy " +
                         version + ": install \"numpy<2\", or build temper with a newer pybind11");
}

}  // namespace
}  // namespace temper::python

PYBIND11_MODULE(_temper, m) {
  using namespace temper::python;
  refuse_unknown_numpy();
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const BadInput& bad) {
      raise_as_temper_error(bad.error);
    }
  });
  m.attr("__version__") = to_python(temper::version());
  bind_build_info(m);
  m.def("did_you_mean", [](const std::string& word, const py::sequence& names) {
    const std::vector<std::string> known = strings_from(names);
    return temper::did_you_mean(word, std::vector<std::string_view>(known.begin(), known.end()));
  });
  m.attr("knows_numpy_2") = kKnowsNumPy2;
  bind_mesh(m);
  bind_files(m);
  bind_tets(m);
  bind_surfaces(m);
  bind_generate(m);
  bind_geometry(m);
  bind_topology(m);
  bind_mesher(m);
  bind_optimize(m);
  bind_optimizer(m);
  bind_measure(m);
  bind_dec(m);
  bind_columns(m);
  bind_weights(m);
}

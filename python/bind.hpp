// The mesh as Python holds it, and the common parts of the binding files.
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "convert.hpp"
#include "temper/detail/cell_kinds.hpp"
#include "temper/detail/discretization_error.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/progress.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"
#include "temper/surfaces.hpp"
#include "temper/tets/quality.hpp"
#include "temper/tets/weights.hpp"

namespace temper::python {

/// The original file of a mesh: everything that is not in the mesh.
struct Source {
  io::MeshFile file;
  io::LoadedMesh loaded;  ///< Loaded mesh, whose mesh has been moved out
};

/// The rules by which data follow a mesh that changes.
struct MeshDataRules {
  io::DataRules of_points, of_cells = {io::DataRule::sample, {}};

  [[nodiscard]] io::UpdateOptions options(Executor* executor) const { return {of_points, executor, of_cells}; }
};

/// Error: the mesh is being changed.
void refuse_while_running(bool running);
/// While it lives, nothing else may change the mesh that has the flag.
class Run {
 public:
  explicit Run(bool& running);
  ~Run() { running_ = false; }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

 private:
  bool& running_;
};

/// A mesh that Python holds. The value is shared with arrays that view it and with calls that run without the GIL. If
/// it is shared, it is copied before a change: arrays keep their values.
class PyMesh {
 public:
  explicit PyMesh(Mesh mesh) : mesh_(std::make_shared<Mesh>(std::move(mesh))) {}
  PyMesh(Mesh mesh, std::shared_ptr<const Source> source)
      : mesh_(std::make_shared<Mesh>(std::move(mesh))), source_(std::move(source)) {}

  /// The mesh for reading. Error: erased triangles, which only topology can skip.
  [[nodiscard]] std::shared_ptr<const Mesh> read() const;
  [[nodiscard]] std::shared_ptr<const Mesh> read_with_erased() const { return mesh_; }
  /// The mesh for changes, not shared. Error: a run has not ended; it would overwrite the changes.
  [[nodiscard]] Mesh& change();
  /// Replaces the mesh by another. `vertices`: former number of each vertex, empty if they are the same. Errors as for
  /// changes.
  void replace(Mesh mesh, const IdVector<VertexId, VertexId>& vertices);
  /// Becomes the other mesh, with its file.
  void assign(const PyMesh& other);
  /// Attaches a file. `origin`: see origin(); empty: the points in triangles are the vertices.
  void set_source(std::shared_ptr<const Source> source, IdVector<VertexId, VertexId> origin = {});
  [[nodiscard]] PyMesh copy() const;
  void set_erased() { erased_ = true; }
  /// Drops everything that is erased. Returns the former numbers of the vertices.
  IdVector<VertexId, VertexId> compact();

  [[nodiscard]] const std::shared_ptr<const Source>& source() const { return source_; }
  /// Number of each vertex in the source; empty: the same numbers.
  [[nodiscard]] IdVector<VertexId, VertexId> origin() const;
  [[nodiscard]] const MeshDataRules& data_rules() const { return data_rules_; }
  void set_data_rules(MeshDataRules rules) { data_rules_ = std::move(rules); }
  /// The number of this state. Only copies of the mesh have the same number. A plan for one state does not fit another.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  [[nodiscard]] Run run() { return Run(running_); }

 private:
  void compose(const IdVector<VertexId, VertexId>& vertices);
  [[nodiscard]] std::size_t n_vertices_of_source() const;
  void refuse_while_running() const;
  [[nodiscard]] static std::uint64_t new_version();

  std::shared_ptr<Mesh> mesh_;
  std::shared_ptr<const Source> source_;
  IdVector<VertexId, VertexId> origin_;
  MeshDataRules data_rules_;
  std::uint64_t version_ = new_version();
  bool erased_ = false, running_ = false;
};

/// A mesh of points in space, and its file. Views and calls without the GIL share both, and a change replaces them.
template <class Loaded>
struct PySpaceMesh {
  std::shared_ptr<const io::MeshFile> file;
  std::shared_ptr<const Loaded> loaded;
  std::vector<std::int32_t> vertex_of_point;  ///< Present vertex of each point in the original file; −1: none
  MeshDataRules data_rules = {};
  std::uint64_t version = 0;  ///< Number of changes
  bool running = false;

  [[nodiscard]] const auto& mesh() const { return loaded->mesh; }
  [[nodiscard]] auto read() const { return std::shared_ptr<const decltype(Loaded::mesh)>(loaded, &loaded->mesh); }
};
using PyTetMesh = PySpaceMesh<io::LoadedTetMesh>;
using PySurface = PySpaceMesh<io::LoadedSurface>;

/// A triangulation of a surface whose edges were flipped on it, with its weights.
struct PyIntrinsic {
  std::shared_ptr<const surfaces::IntrinsicMesh> mesh;
};

/// The mesh gets a new state, with its file. `corner_weights`: of tetrahedra with several tensors.
io::DataReport replace(PyTetMesh& self, tets::TetMesh mesh, const tets::Origins& origins, Executor* executor,
                       const std::vector<double>& corner_weights = {});
io::DataReport replace(PySurface& self, surfaces::SurfaceMesh mesh, const IdVector<VertexId, VertexId>& vertices = {});

/// The mesh of a file, and the warnings.
[[nodiscard]] py::tuple load_tetrahedra(io::MeshFile file, Executor* executor);
[[nodiscard]] py::tuple load_surface(io::MeshFile file, const std::vector<std::string>& fixed_tags);

[[nodiscard]] constexpr CellKinds cells_of(const Mesh& /*mesh*/) { return CellKinds::triangles; }
[[nodiscard]] constexpr CellKinds cells_of(const tets::TetMesh& /*mesh*/) { return CellKinds::tetrahedra; }
[[nodiscard]] constexpr CellKinds cells_of(const surfaces::SurfaceMesh& /*mesh*/) { return CellKinds::surfaces; }

/// Halfedges, corners, flags and weights of triangles.
[[nodiscard]] inline std::shared_ptr<const Mesh> connectivity_of(const PyMesh& self) { return self.read_with_erased(); }
[[nodiscard]] inline std::shared_ptr<const Mesh> connectivity_of(const PySurface& self) {
  return {self.loaded, &self.mesh().connectivity()};
}

/// Returns the result of `work`, and releases the GIL meanwhile.
template <class Work>
auto aside(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

/// The executor for a number of threads. None: as many as the machine has. Returns null for one thread.
[[nodiscard]] std::unique_ptr<Executor> make_threads(const std::optional<std::size_t>& threads);
[[nodiscard]] std::optional<std::size_t> threads_from(const py::handle& threads);

/// Gives Python control from time to time while a call runs without the GIL: keyboard interrupts, and callbacks. The
/// first exception stops the run. It is raised when the run has ended and its result is in place.
class Visitor {
 public:
  /// Returns false to stop.
  [[nodiscard]] bool check_signals();
  /// Calls f with the GIL. Returns false if f raises, has raised before, or returns False.
  template <class F>
  bool call(const F& f) {
    if (stopped()) return false;
    const py::gil_scoped_acquire gil;
    try {
      return f();
    } catch (...) {  // also exceptions of pybind11: the library below is compiled without exceptions
      error_ = std::current_exception();
      return false;
    }
  }
  [[nodiscard]] bool stopped() const { return error_ != nullptr; }
  void raise() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::exception_ptr error_;
  std::chrono::steady_clock::time_point last_ = {};
};

/// Calls Python's observer, which may be None, and checks for Ctrl-C.
Observer observer_of(Visitor& visitor, const py::object& observer);

// Names of tags, as tuples of dimension, tag and name.
py::list physical_names_to_python(const std::vector<PhysicalName>& names);
std::vector<PhysicalName> physical_names_from(const py::handle& names);

/// The user's own problem: coefficient, source, and tuples of boundary edges (k, 2), value, and whether it is a flux.
DiffusionProblem problem_from(const py::tuple& given);

/// The metric of the three numbers of a diffusion tensor.
Metric metric_from(const py::handle& tensor);
/// Tensors as _tensor.py gives them: one for all cells, as three or six numbers, or a pair of one for each cell, (m, 3)
/// or (m, 6), and the weights of corners, (m, 3) or (m, 4) or empty.
template <class K>
struct GivenTensors {
  std::optional<K> one;
  std::vector<K> of_cells;
  std::vector<double> corner_weights;
};
template <class K>
GivenTensors<K> tensors_from(const py::object& given);
/// The mesh in the planes of its metrics.
MetricMesh in_metric(const Mesh& mesh, const GivenTensors<Tensor>& given);
tets::MetricMesh in_metric(const tets::TetMesh& mesh, const GivenTensors<Tensor3>& given);
/// The weights of the corners of each cell, (m, corners); None without interfaces.
py::object corner_weights_to_python(const std::vector<double>& weights, py::ssize_t corners = 3);
/// Finds weights of a mesh with tensors. Returns the report, whose weights are those of the vertices, and the weights
/// of the corners.
template <class Given, class AnyMesh, class Find>
std::pair<WeightReport, std::vector<double>> weights_in_metric(const AnyMesh& mesh, const Given& given,
                                                               const Find& find) {
  auto pieces = in_metric(mesh, given);
  WeightReport report = find(pieces);
  for (const VertexId v : pieces.mesh.vertices()) pieces.mesh.set_weight(v, report.weights[v]);
  report.weights.resize(mesh.n_vertices());
  return {std::move(report), or_raise(mapped_back(pieces, mesh, pieces)).corner_weights};
}

/// Raises unless the mesh lies in the plane, which `what` requires.
void require_plane(const Mesh& mesh, std::string_view what);
/// Raises for meshes of periodic planes.
void require_no_period(const Mesh& mesh, std::string_view what);

/// Gives a class of meshes the methods that read and set the rules of its data.
template <class AnyMesh>
void define_data_rules(py::class_<AnyMesh>& type);
/// Gives a class of meshes of triangles their arrays, searches and marks.
template <class AnyMesh>
void define_triangles(py::class_<AnyMesh>& type);

VertexId vertex_id(const Mesh& mesh, std::int64_t index);
TriangleId triangle_id(const Mesh& mesh, std::int64_t index);
HalfedgeId halfedge_id(const Mesh& mesh, std::int64_t index);

void bind_mesh(py::module_& m);
void bind_files(py::module_& m);
void bind_tets(py::module_& m);
void bind_surfaces(py::module_& m);
void bind_generate(py::module_& m);
void bind_geometry(py::module_& m);
void bind_topology(py::module_& m);
void bind_mesher(py::module_& m);
void bind_dec(py::module_& m);
void bind_columns(py::module_& m);
void bind_optimize(py::module_& m);
void bind_optimizer(py::module_& m);
void bind_measure(py::module_& m);
void bind_weights(py::module_& m);

}  // namespace temper::python

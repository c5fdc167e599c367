// The mesh as Python holds it, and what the files that bind it share.
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "convert.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/progress.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"

namespace temper::python {

/// The file that a mesh came from: all that is not in the mesh.
struct Source {
  io::MeshFile file;
  io::LoadedMesh loaded;  ///< its mesh is taken
};

/// A mesh that Python holds. The value is shared with arrays that look at it and with calls that run without the GIL,
/// and is copied before it is changed when anybody does: arrays keep what they showed.
class PyMesh {
 public:
  explicit PyMesh(Mesh mesh) : mesh_(std::make_shared<Mesh>(std::move(mesh))) {}
  PyMesh(Mesh mesh, std::shared_ptr<const Source> source)
      : mesh_(std::make_shared<Mesh>(std::move(mesh))), source_(std::move(source)) {}

  /// For reading. Error: erased triangles, which only topology knows how to pass over.
  [[nodiscard]] std::shared_ptr<const Mesh> read() const;
  [[nodiscard]] std::shared_ptr<const Mesh> read_with_erased() const { return mesh_; }
  /// For changes: not shared. Error: a run has not ended, which would overwrite them.
  [[nodiscard]] Mesh& change();
  /// Puts another mesh in place. `vertices`: former number of each vertex, empty when they are the same. Error as
  /// above.
  void replace(Mesh mesh, const IdVector<VertexId, VertexId>& vertices);
  /// Becomes the other, with its file.
  void assign(const PyMesh& other);
  /// Has this file behind it. `origin`: see origin(); empty: its points in triangles are the vertices.
  void set_source(std::shared_ptr<const Source> source, IdVector<VertexId, VertexId> origin = {});
  [[nodiscard]] PyMesh copy() const;
  void set_erased() { erased_ = true; }
  /// Drops what is erased; the former numbers of vertices.
  IdVector<VertexId, VertexId> compact();

  [[nodiscard]] const std::shared_ptr<const Source>& source() const { return source_; }
  /// Number in the source of each vertex; empty: the same.
  [[nodiscard]] IdVector<VertexId, VertexId> origin() const;
  /// How data of its points follow the vertices.
  [[nodiscard]] const io::DataRules& data_rules() const { return data_rules_; }
  void set_data_rules(io::DataRules rules) { data_rules_ = std::move(rules); }
  /// The number of this state, which no other mesh has but copies of it: what was planned for one state does not fit
  /// another.
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// While it lives nothing else may change the mesh.
  class Run {
   public:
    explicit Run(PyMesh& mesh);
    ~Run() { mesh_.running_ = false; }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

   private:
    PyMesh& mesh_;
  };

 private:
  void compose(const IdVector<VertexId, VertexId>& vertices);
  [[nodiscard]] std::size_t n_vertices_of_source() const;
  void refuse_while_running() const;
  [[nodiscard]] static std::uint64_t new_version();

  std::shared_ptr<Mesh> mesh_;
  std::shared_ptr<const Source> source_;
  IdVector<VertexId, VertexId> origin_;
  io::DataRules data_rules_;
  std::uint64_t version_ = new_version();
  bool erased_ = false, running_ = false;
};

/// What `work` makes, while Python goes on.
template <class Work>
auto aside(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

/// None: as many threads as the machine has. Null for one.
[[nodiscard]] std::unique_ptr<Executor> make_threads(const std::optional<std::size_t>& threads);
[[nodiscard]] std::optional<std::size_t> threads_from(const py::handle& threads);

/// Lets Python in while a call runs without the GIL: keyboard interrupts, and callbacks. The first exception stops the
/// run, and is raised when the run has ended and its result is in place.
class Visitor {
 public:
  /// False: stop.
  [[nodiscard]] bool check_signals();
  /// Calls f with the GIL; false when it has raised, now or before, and when it has returned False.
  template <class F>
  bool call(const F& f) {
    if (stopped()) return false;
    const py::gil_scoped_acquire gil;
    try {
      return f();
    } catch (...) {  // also what pybind11 throws: the library below is compiled without exceptions
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

/// Tells Python's observer, which may be None, and hears of Ctrl-C.
Observer observer_of(Visitor& visitor, const py::object& observer);

/// Of the three numbers of a diffusion tensor.
Metric metric_from(const py::handle& tensor);

/// Raises unless the mesh is one of the plane, which `what` takes alone.
void require_plane(const Mesh& mesh, std::string_view what);
/// Raises for meshes of periodic planes.
void require_no_period(const Mesh& mesh, std::string_view what);

VertexId vertex_id(const Mesh& mesh, std::int64_t index);
TriangleId triangle_id(const Mesh& mesh, std::int64_t index);
HalfedgeId halfedge_id(const Mesh& mesh, std::int64_t index);

void bind_mesh(py::module_& m);
void bind_files(py::module_& m);
void bind_generate(py::module_& m);
void bind_geometry(py::module_& m);
void bind_change(py::module_& m);
void bind_dec(py::module_& m);
void bind_optimize(py::module_& m);
void bind_measure(py::module_& m);
void bind_weights(py::module_& m);

}  // namespace temper::python

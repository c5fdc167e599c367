// Bindings of optimize and replay: options and listeners. The mesh gets its new state, whatever ended the run.
#include <cstdlib>
#include <string>

#include "bind.hpp"
#include "optimize_options.hpp"
#include "reports.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/trace.hpp"
#include "temper/solvers.hpp"

TEMPER_PYTHON_NAMES(temper::Snapshot::Moment, "start", "after_sweep", "before_flips", "after_flips");

namespace temper::python {
namespace {

class PythonCommunicator final : public Communicator {
 public:
  /// Uses an mpi4py Comm `communicator`: Get_size, Get_rank, bcast, Bcast and Abort.
  explicit PythonCommunicator(const py::object& communicator)
      : communicator_(communicator),
        size_(communicator.attr("Get_size")().cast<std::size_t>()),
        rank_(communicator.attr("Get_rank")().cast<std::size_t>()) {}

  [[nodiscard]] std::size_t size() const override { return size_; }
  [[nodiscard]] std::size_t rank() const override { return rank_; }

  /// If this fails, the other ranks would wait forever, and the library cannot pass exceptions. So it ends all ranks.
  void broadcast(std::string& bytes, std::size_t from) override {
    const py::gil_scoped_acquire gil;
    try {
      send_or_receive(bytes, from);
    } catch (py::error_already_set& error) {
      error.restore();
      PyErr_Print();
      end_all();
    } catch (...) {
      end_all();
    }
  }

 private:
  [[noreturn]] void end_all() const {
    try {
      communicator_.attr("Abort")(1);
    } catch (...) {  // this process ends, and MPI ends the others
    }
    std::abort();
  }

  void send_or_receive(std::string& bytes, std::size_t from) const {
    bytes.resize(communicator_.attr("bcast")(bytes.size(), py::arg("root") = from).cast<std::size_t>());
    in_pieces(bytes, [&](char* data, std::size_t count) {
      communicator_.attr("Bcast")(py::memoryview::from_memory(data, static_cast<py::ssize_t>(count)),
                                  py::arg("root") = from);
    });
  }

  const py::object& communicator_;
  std::size_t size_, rank_;
};

}  // namespace

Observer observer_of(Visitor& visitor, const py::object& observer) {
  return [&visitor, &observer](const Progress& progress) {
    bool go_on = visitor.check_signals();
    if (go_on && !observer.is_none()) {
      go_on = visitor.call([&] {
        const py::object answer = observer(report_to_python(progress));
        return !(answer.is(py::bool_(false)));
      });
    }
    return go_on ? Continue::yes : Continue::no;
  };
}

namespace {

/// Python's observers of a run. Each may be None.
struct Callbacks {
  py::object observer, tracer, snapshots;
};

void set_callbacks(OptimizeHooks& hooks, Visitor& visitor, const Callbacks& callbacks) {
  if (!callbacks.tracer.is_none()) {
    hooks.tracer = [&visitor, &callbacks](const TraceEvent& event) {
      static_cast<void>(visitor.call([&] {
        callbacks.tracer(report_to_python(event));
        return true;
      }));
    };
  }
  if (!callbacks.snapshots.is_none()) {
    hooks.snapshots = [&visitor, &callbacks](const Snapshot& s) {
      static_cast<void>(visitor.call([&] {
        callbacks.snapshots(
            Record()("moment", name_of(s.moment))("sweep", s.sweep)("outer", s.outer)("energy", s.energy)(
                "mesh", py::cast(std::make_unique<PyMesh>(s.mesh)))("vertices", s.vertices)
                .dict);
        return true;
      }));
    };
  }
}

}  // namespace

DiffusionProblem problem_from(const py::tuple& given) {
  const auto coefficient = given[0].cast<Doubles>(), source = given[1].cast<Doubles>();
  const auto k = as_span<double>(coefficient), f = as_span<double>(source);
  DiffusionProblem problem = {{k.begin(), k.end()}, {f.begin(), f.end()}, {}};
  for (const auto& item : given[2]) {
    const auto part = item.cast<py::tuple>();
    BoundaryValue& value = problem.boundary.emplace_back();
    const auto edges = part[0].cast<Int32s>();
    for (const auto& [a, b] : as_span<std::array<std::int32_t, 2>>(edges))
      value.edges.push_back({VertexId(static_cast<std::size_t>(a)), VertexId(static_cast<std::size_t>(b))});
    value.value = part[1].cast<double>();
    value.is_flux = part[2].cast<bool>();
  }
  return problem;
}

namespace {

std::optional<SizeField> size_field_from(const py::object& field) {
  if (field.is_none()) return std::nullopt;
  return field.cast<SizeField>();
}

/// The inputs of a run from Python, besides mesh and options. Each may be None.
struct RunArguments {
  py::object size_field, threads;
  Callbacks callbacks;
  py::object tensor;        ///< Tensors, as tensors_from() takes them
  py::object communicator;  ///< Communicator of mpi4py
  py::object depth;         ///< Water depth at each vertex
  py::object problem;       ///< Tuple of problem_from()
};

/// The mesh gets its new state, whatever ended the run. Exceptions of Python callbacks are raised after that.
py::object optimize_mesh(PyMesh& self, const py::dict& given, const RunArguments& arguments) {
  OptimizeOptions options = options_from(given);
  options.size_field = size_field_from(arguments.size_field);
  if (!arguments.depth.is_none()) {
    const auto depths = arguments.depth.cast<Doubles>();
    const auto values = as_span<double>(depths);
    options.guard.depth.assign(values.begin(), values.end());
  }
  const auto count = threads_from(arguments.threads);
  if (!arguments.tensor.is_none()) {
    GivenTensors<Tensor> tensors = tensors_from<Tensor>(arguments.tensor);
    options.tensor = tensors.one;
    options.triangle_tensors = std::move(tensors.of_cells);
    options.corner_weights = std::move(tensors.corner_weights);
  }
  Mesh mesh = *self.read();
  if (!arguments.problem.is_none()) options.problem = problem_from(arguments.problem);
  Visitor visitor;
  const Observer observer = observer_of(visitor, arguments.callbacks.observer);
  OptimizeHooks hooks;
  hooks.observer = observer;
  hooks.exclusive = true;  // this copy becomes the mesh
  hooks.solvers = solvers();
  std::optional<PythonCommunicator> communicator;
  if (!arguments.communicator.is_none()) hooks.communicator = &communicator.emplace(arguments.communicator);
  set_callbacks(hooks, visitor, arguments.callbacks);
  std::optional<Expected<OptimizeReport>> report;
  {
    const Run run = self.run();
    const py::gil_scoped_release release;
    const auto executor = make_threads(count);
    hooks.executor = executor.get();
    report = optimize(mesh, options, hooks);
  }
  if (report->has_value()) self.replace(std::move(mesh), (*report)->vertices);
  visitor.raise();
  if (!*report) throw BadInput{report->error()};
  return py::make_tuple(report_to_python(**report), corner_weights_to_python((*report)->corner_weights));
}

VertexId any_vertex(const py::handle& index) {
  const auto i = index.cast<std::int64_t>();
  return i < 0 ? VertexId() : VertexId(static_cast<std::size_t>(i));
}

TraceEvent event_from(const py::dict& d) {
  TraceEvent e;
  e.kind = static_cast<EventKind>(choose("kind", d["kind"].cast<std::string>(), words_of(EventKind())));
  e.sweep = d["sweep"].cast<int>();
  e.vertex = any_vertex(d["vertex"]);
  e.before = d["before"].cast<double>();
  e.after = d["after"].cast<double>();
  const auto point = d["point"].cast<py::sequence>();
  e.point = {point[0].cast<double>(), point[1].cast<double>(), point[2].cast<double>()};
  e.quad = ids_from<VertexId, 4>(d["quad"]);
  for (const auto& v : d["link"]) e.link.push_back(any_vertex(v));
  for (const auto& t : d["triangles"]) e.triangles.push_back(ids_from<VertexId, 3>(t));
  e.to_sweep = d["to_sweep"].cast<int>();
  return e;
}

}  // namespace

void bind_optimize(py::module_& m) {
  m.def("optimize", [](PyMesh& self, const py::dict& options, const py::object& size_field, const py::object& threads,
                       const py::object& observer, const py::object& tracer, const py::object& snapshots,
                       const py::object& tensor, const py::object& communicator, const py::object& depth,
                       const py::object& problem) {
    return optimize_mesh(self, options,
                         {size_field, threads, {observer, tracer, snapshots}, tensor, communicator, depth, problem});
  });
  m.def("problem_warnings", [](const PyMesh& self, const py::tuple& problem) {
    py::list sentences;
    for (const std::string& sentence : problem_warnings(*self.read(), problem_from(problem)))
      sentences.append(sentence);
    return sentences;
  });
  m.def("options_for", [](const std::string& target, const std::string& effort, const py::sequence& keep) {
    const std::vector<std::string> names = strings_from(keep);
    const std::vector<std::string_view> parts(names.begin(), names.end());
    return options_to_dict(or_raise(options_for(target, effort, parts)));
  });
  m.def("check_words", [](const py::dict& given, const std::string& target, const py::sequence& keep) {
    const OptimizeOptions options = options_from(given);
    or_raise(check_target(options, target));
    const std::vector<std::string> names = strings_from(keep);
    const std::vector<std::string_view> parts(names.begin(), names.end());
    or_raise(check_kept(options, parts));
  });
  m.def("check_cells", [](const py::dict& given, const std::string& target, const py::sequence& keep,
                          const py::sequence& options, const py::handle& mesh) {
    const std::vector<std::string> kept = strings_from(keep), set = strings_from(options);
    const std::vector<std::string_view> parts(kept.begin(), kept.end()), names(set.begin(), set.end());
    const CellKinds cells = py::isinstance<PyTetMesh>(mesh)   ? CellKinds::tetrahedra
                            : py::isinstance<PySurface>(mesh) ? CellKinds::surfaces
                                                              : CellKinds::triangles;
    or_raise(check_cells(options_from(given), {target, parts, names}, cells));
  });
  m.def("presets", [] {
    const auto rows = [](std::span<const Preset> presets) {
      py::dict sentences;
      for (const Preset& preset : presets) sentences[py::str(std::string(preset.name))] = std::string(preset.sentence);
      return sentences;
    };
    return Record()("target", py::object(rows(targets())))("effort", py::object(rows(efforts())))(
               "keep", py::object(rows(keeps())))
        .dict;
  });
  m.def("solver_targets", [] {
    py::dict targets;
    for (const SolverName& solver : solver_names()) {
      if (!solver.target.empty() && solver.target != solver.name)
        targets[py::str(std::string(solver.name))] = std::string(solver.target);
    }
    return targets;
  });
  m.def("option_table", option_table);
  m.def("idle_options", idle_options);
  m.def("replay", [](const PyMesh& input, const py::iterable& trace) {
    std::vector<TraceEvent> events;
    for (const auto& event : trace) events.push_back(event_from(event.cast<py::dict>()));
    const auto mesh = input.read();
    Replay again = or_raise(replay_with_vertices(*mesh, events));
    auto result = std::make_unique<PyMesh>(input.copy());
    result->replace(std::move(again.mesh), again.vertices);
    return py::make_tuple(std::move(result), to_python(again.vertices));
  });
}

}  // namespace temper::python

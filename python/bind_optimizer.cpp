// Binding of Optimizer: one call makes the changes that wait in Python, and updates the mesh. The mesh itself is all
// that is kept between calls.
#include <utility>

#include "bind.hpp"
#include "optimize_options.hpp"
#include "reports.hpp"
#include "temper/optimizer.hpp"
#include "temper/solvers.hpp"
#include "temper/tets/optimizer.hpp"

namespace temper::python {
namespace {

/// Numbers of vertices that Python has checked: none is negative.
std::vector<VertexId> vertices_from(const py::handle& numbers) {
  std::vector<VertexId> vertices;
  const auto array = numbers.cast<Int64s>();
  for (const std::int64_t v : as_span<std::int64_t>(array)) vertices.emplace_back(static_cast<std::size_t>(v));
  return vertices;
}

/// Gives an Optimizer the changes of a dict.
template <class AnyOptimizer>
void take_changes(AnyOptimizer& optimizer, const py::dict& waiting) {
  const auto moved = vertices_from(waiting["moved"]), weighed = vertices_from(waiting["weighed"]);
  const auto places = waiting["places"].cast<Doubles>(), weights = waiting["weights"].cast<Doubles>(),
             inserted = waiting["inserted"].cast<Doubles>();
  for (std::size_t i = 0; i < moved.size(); ++i) optimizer.move(moved[i], as_span<Vec3>(places)[i]);
  for (std::size_t i = 0; i < weighed.size(); ++i) optimizer.set_weight(weighed[i], as_span<double>(weights)[i]);
  for (const VertexId v : vertices_from(waiting["removed"])) optimizer.remove(v);
  for (const Vec3 place : as_span<Vec3>(inserted)) optimizer.insert(place);
}

template <class CellId>
py::dict difference_to_python(const MeshDifference<CellId>& difference) {
  std::vector<std::int32_t> cells;
  for (const CellId c : difference.cells) cells.push_back(static_cast<std::int32_t>(c.index));
  return Record()("vertices", difference.vertices)("moved", difference.moved)("weighed", difference.weighed)(
             "cells", py::object(array_of<std::int32_t>(cells)))("rows", difference.rows)
      .dict;
}

/// Checks options for a mesh of these cells.
void check_optimizer(const py::dict& options, bool is_of_tets) {
  if (is_of_tets) {
    static_cast<void>(or_raise(tets::Optimizer::make({}, options_from(options))));
  } else {
    static_cast<void>(or_raise(Optimizer::make({}, options_from(options))));
  }
}

/// The mesh gets its new state. An exception of the observer is raised after that.
py::tuple update_mesh(PyMesh& self, const py::dict& options, const py::dict& waiting, const py::object& threads,
                      const py::object& observer, const py::object& size_field) {
  auto optimizer = or_raise(Optimizer::make(*self.read(), options_from(options)));
  take_changes(optimizer, waiting);
  if (!size_field.is_none()) optimizer.resize(size_field.cast<SizeField>());
  Visitor visitor;
  OptimizeHooks hooks;
  hooks.observer = observer_of(visitor, observer);
  hooks.measures_sizes = false;
  hooks.solvers = solvers();
  const auto executor = make_threads(threads_from(threads));
  hooks.executor = executor.get();
  auto update = [&] {
    const Run run = self.run();
    return aside([&] { return optimizer.update(hooks); });
  }();
  const Optimizer::Update done = or_raise(std::move(update));
  self.replace(optimizer.mesh(), done.difference.vertices);
  visitor.raise();
  return py::make_tuple(report_to_python(done.report), difference_to_python(done.difference));
}

py::tuple update_tets(PyTetMesh& self, const py::dict& options, const py::dict& waiting, const py::object& threads,
                      const py::object& observer) {
  const OptimizeOptions given = options_from(options);
  auto optimizer = or_raise(tets::Optimizer::make(self.mesh(), given));
  take_changes(optimizer, waiting);
  Visitor visitor;
  const auto executor = make_threads(threads_from(threads));
  tets::OptimizeHooks hooks = {observer_of(visitor, observer), executor.get()};
  hooks.solvers = tets::solvers(given.scheme);
  const Run run(self.running);
  const tets::Optimizer::Update done = or_raise(aside([&] { return optimizer.update(hooks); }));
  replace(self, optimizer.mesh(), done.report.origins, executor.get());
  visitor.raise();
  return py::make_tuple(report_to_python(done.report), difference_to_python(done.difference));
}

}  // namespace

void bind_optimizer(py::module_& m) {
  m.def("check_optimizer", check_optimizer);
  m.def("update", update_mesh);
  m.def("tet_update", update_tets);
}

}  // namespace temper::python

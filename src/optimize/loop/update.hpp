// The update of an Optimizer, for triangles and for tetrahedra. Each mesh has functions of its own:
//
//   kinds_of(mesh)                       its kind of cells
//   changed(mesh, waiting, names)        the mesh with these changes, or an error
//   numbers_of(report)                   the numbers of the result before the run, empty if all are equal
//   difference(former, mesh, numbers)    where two meshes differ
#pragma once

#include <optional>
#include <utility>

#include "optimize/options/settings.hpp"
#include "optimize/run/numbers.hpp"
#include "temper/detail/cell_kinds.hpp"
#include "temper/optimizer.hpp"

namespace temper {

/// A mesh with changes. `Numbers`: the former numbers of vertices, or of tagged parts, too.
template <class MeshOf, class Numbers>
struct ChangedMesh {
  MeshOf mesh;
  Numbers numbers = {};  ///< before the changes; empty if all are equal
};

template <class MeshOf, class Hooks, class Report, class CellId>
auto OptimizerOf<MeshOf, Hooks, Report, CellId>::make(MeshOf mesh, OptimizeOptions options) -> Expected<OptimizerOf> {
  options.change = Change::least;
  if (auto right = check_together(options, kinds_of(mesh)); !right) return right.error();
  return OptimizerOf(std::move(mesh), std::move(options));
}

template <class MeshOf, class Hooks, class Report, class CellId>
auto OptimizerOf<MeshOf, Hooks, Report, CellId>::update(const Hooks& hooks, const InputNames* names)
    -> Expected<Update> {
  auto next = changed(mesh_, waiting_, names);
  if (!next) return next.error();
  Expected<Report> report = optimize(next->mesh, options_, hooks);
  if (!report) return report.error();
  Update update;
  update.report = *std::move(report);
  auto& numbers = numbers_of(update.report);
  numbers = numbers_before_both(numbers, next->numbers);
  update.difference = difference(mesh_, next->mesh, numbers);
  mesh_ = std::move(next->mesh);
  waiting_ = {};
  return update;
}

}  // namespace temper

#include "optimize/accuracy/accuracy_sizes.hpp"

#include <utility>

#include "mesh/blocks.hpp"
#include "size/averaged_sizes.hpp"

namespace temper {
namespace {

VertexSizes sizes_of_field(const Mesh& mesh, const SizeField& field, Executor* executor) {
  VertexSizes sizes(mesh.n_vertices());
  for_blocks(mesh.n_vertices(), executor, [&](std::size_t first, std::size_t last) {
    TriangleId hint;
    for (std::size_t i = first; i < last; ++i) {
      const SizeField::Sample sample = field.at(mesh.point(VertexId(i)), hint);
      sizes[VertexId(i)] = sample.size;
      hint = sample.triangle;
    }
  });
  return sizes;
}

}  // namespace

AccuracySizes::AccuracySizes(const Mesh& mesh, const IdVector<VertexId, VertexId>& numbers,
                             const std::optional<SizeField>& field, Executor* executor) {
  VertexSizes sizes =
      averaged_sizes(mesh, field ? sizes_of_field(mesh, *field, executor) : local_sizes(mesh, executor), executor);
  if (numbers.empty()) {
    input_ = std::move(sizes);
    return;
  }
  input_.resize(sizes.size());
  for (const VertexId v : mesh.vertices()) input_[numbers[v]] = sizes[v];
}

VertexSizes AccuracySizes::of(const WorkingCopy& work, Executor* executor) const {
  VertexSizes sizes(work.mesh.n_vertices());
  for_each_index(sizes.size(), executor, [&](std::size_t i) {
    const VertexId v(i), number = work.order->vertices[v];
    // Both scales are powers of two, so this is exact.
    sizes[v] = number.index < input_.size() ? input_[number] / work.units.scale : local_size(work.mesh, v);
  });
  return sizes;
}

VertexSizes AccuracySizes::lend(const WorkingCopy& work, Executor* executor) {
  VertexSizes lent = of(work, executor);
  if (!work.has_gaps && !work.has_inserted()) input_ = {};
  return lent;
}

void AccuracySizes::take_back(VertexSizes lent, const WorkingCopy& work, Executor* executor) {
  if (!input_.empty()) return;
  input_.resize(lent.size());
  for_each_index(lent.size(), executor, [&](std::size_t i) {
    input_[work.order->vertices[VertexId(i)]] = lent[VertexId(i)] * work.units.scale;
  });
}

VertexSizes AccuracySizes::in_user_units(const WorkingCopy& work, Executor* executor) const {
  VertexSizes sizes = of(work, executor);
  for (double& size : sizes) size *= work.units.scale;
  return sizes;
}

VertexSizes AccuracySizes::in_user_terms(const WorkingCopy& work, Executor* executor) const {
  const VertexSizes here = in_user_units(work, executor);
  std::vector<double> by_number(work.n_vertices_named, 0.0);  // 0: removed
  for (const VertexId v : work.mesh.vertices()) by_number[work.order->vertices[v].index] = here[v];
  VertexSizes sizes;
  sizes.reserve(here.size());
  for (const double size : by_number) {
    if (size > 0) sizes.push_back(size);
  }
  return sizes;
}

bool raise_floors(AccuracyDomain& domain, const Mesh& mesh, const AccuracyModel& model, Executor* executor) {
  AccuracyFloors& floors = domain.floors;
  std::size_t raised = floors.raise(mesh, model.margin, executor);
  if (model.keeps_lengths()) raised += floors.lengths.raise(mesh, local_sizes(mesh, executor), model, executor);
  return raised > 0;
}

}  // namespace temper

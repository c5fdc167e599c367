#include "optimize/accuracy/accuracy_sizes.hpp"

#include <utility>
#include <vector>

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

/// Gives each vertex the size of its number. Without a second array: the largest meshes have no room for it.
void renumber_in_place(VertexSizes& sizes, const IdVector<VertexId, VertexId>& numbers) {
  std::vector<bool> done(sizes.size());
  for (std::size_t first = 0; first < sizes.size(); ++first) {
    const double size_of_first = sizes[VertexId(first)];
    for (VertexId v(first); !done[v.index];) {  // once around its cycle
      done[v.index] = true;
      const VertexId number = numbers[v];
      sizes[v] = number == VertexId(first) ? size_of_first : sizes[number];
      v = number;
    }
  }
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
  if (!working_.empty()) return working_;
  VertexSizes sizes(work.mesh.n_vertices());
  for_each_index(sizes.size(), executor, [&](std::size_t i) {
    const VertexId v(i), number = work.order->vertices[v];
    // Both scales are powers of two, so this is exact.
    sizes[v] = number.index < input_.size() ? input_[number] / work.units.scale : local_size(work.mesh, v);
  });
  return sizes;
}

VertexSizes AccuracySizes::lend(const WorkingCopy& work, Executor* executor) {
  if (!working_.empty()) return std::exchange(working_, {});
  if (work.has_gaps || work.has_inserted()) return of(work, executor);
  VertexSizes lent = std::exchange(input_, {});
  renumber_in_place(lent, work.order->vertices);
  for (double& size : lent) size /= work.units.scale;
  return lent;
}

void AccuracySizes::take_back(VertexSizes lent) {
  if (input_.empty()) working_ = std::move(lent);
}

VertexSizes AccuracySizes::in_user_units(const WorkingCopy& work, Executor* executor) && {
  VertexSizes sizes = lend(work, executor);
  for (double& size : sizes) size *= work.units.scale;
  return sizes;
}

VertexSizes AccuracySizes::in_user_terms(const WorkingCopy& work, Executor* executor) && {
  const VertexSizes here = std::move(*this).in_user_units(work, executor);
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

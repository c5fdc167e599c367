#include "optimize/accuracy/accuracy_sizes.hpp"

#include <utility>

#include "mesh/blocks.hpp"
#include "size/local_sizes.hpp"

namespace temper {
namespace {

// Times that sizes are averaged with those of their neighbours: five are too few to quiet the noise of bad meshes, and
// twenty are no better.
constexpr int kSmoothings = 10;
// Neighbours that a vertex counts as by itself in an average.
constexpr double kOwnPart = 2;

double averaged(const Mesh& mesh, const VertexSizes& sizes, VertexId v) {
  double sum = kOwnPart * sizes[v], count = kOwnPart;
  const auto add = [&](VertexId u) {
    sum += sizes[u];
    ++count;
  };
  for (const HalfedgeId h : mesh.star(v)) {
    add(mesh.target(h));
    if (mesh.is_boundary(Mesh::prev(h))) add(mesh.opposite(h));
  }
  return sum / count;
}

VertexSizes smoothed(const Mesh& mesh, const Walk& walk, VertexSizes sizes, Executor* executor) {
  const std::size_t n = mesh.n_vertices();
  VertexSizes next(n);
  for (int k = 0; k < kSmoothings; ++k) {
    for_each_index(n, executor, [&](std::size_t i) { next[walk[i]] = averaged(mesh, sizes, walk[i]); });
    std::swap(sizes, next);
  }
  return sizes;
}

VertexSizes sizes_of_field(const Mesh& mesh, const Walk& walk, const SizeField& field, Executor* executor) {
  VertexSizes sizes(mesh.n_vertices());
  for_blocks(mesh.n_vertices(), executor, [&](std::size_t first, std::size_t last) {
    TriangleId hint;
    for (std::size_t i = first; i < last; ++i) {
      const SizeField::Sample sample = field.at(mesh.point(walk[i]), hint);
      sizes[walk[i]] = sample.size;
      hint = sample.triangle;
    }
  });
  return sizes;
}

VertexSizes wanted_sizes(const Mesh& input, const std::optional<SizeField>& field, Executor* executor) {
  const Walk walk(input, executor);
  return smoothed(input, walk,
                  field ? sizes_of_field(input, walk, *field, executor) : local_sizes(input, walk, executor), executor);
}

}  // namespace

AccuracySizes::AccuracySizes(const Mesh& input, const std::optional<SizeField>& field, Executor* executor)
    : input_(wanted_sizes(input, field, executor)) {}

VertexSizes AccuracySizes::of(const WorkingCopy& work, Executor* executor) const {
  VertexSizes sizes(work.mesh.n_vertices());
  for_each_index(sizes.size(), executor, [&](std::size_t i) {
    const VertexId v(i), number = work.order.vertices[v];
    // Both scales are powers of two, so exact.
    sizes[v] = number.index < input_.size() ? input_[number] / work.frame.scale : local_size(work.mesh, v);
  });
  return sizes;
}

VertexSizes AccuracySizes::in_user_terms(const WorkingCopy& work, Executor* executor) const {
  const VertexSizes here = of(work, executor);
  std::vector<double> by_number(work.n_vertices_named, 0.0);  // 0: removed
  for (const VertexId v : work.mesh.vertices()) by_number[work.order.vertices[v].index] = here[v] * work.frame.scale;
  VertexSizes sizes;
  sizes.reserve(here.size());
  for (const double size : by_number) {
    if (size > 0) sizes.push_back(size);
  }
  return sizes;
}

}  // namespace temper

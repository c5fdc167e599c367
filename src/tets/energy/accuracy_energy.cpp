#include "tets/energy/accuracy_energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_log.hpp"
#include "temper/detail/executor.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

constexpr std::size_t kTetsPerTask = 256;

/// Calls work(t) for all tetrahedra, on threads.
template <class Work>
void for_all(const TetMesh& mesh, Executor* executor, const Work& work) {
  const std::size_t n = mesh.n_tetrahedra(), tasks = (n + kTetsPerTask - 1) / kTetsPerTask;
  or_serial(executor).run(tasks, [&](std::size_t i) {
    for (std::size_t t = i * kTetsPerTask; t < std::min(n, (i + 1) * kTetsPerTask); ++t) work(TetId(t));
  });
}

double mean(const VertexSizes& sizes, std::span<const VertexId> vertices) {
  double sum = 0;
  for (const VertexId v : vertices) sum += sizes[v];
  return sum / static_cast<double>(vertices.size());
}

}  // namespace

AccuracyEnergy::AccuracyEnergy(const TetMesh& mesh, const VertexSizes& sizes, IdVector<TetId, double> floors,
                               const AccuracyModel& model)
    : elements_(mesh.n_tetrahedra()), barriers_(mesh.n_tetrahedra()), floors_(std::move(floors)) {
  const EdgeTable table(mesh, nullptr);
  std::vector<std::uint8_t> on_boundary(6 * mesh.n_tetrahedra(), 0);
  for (const HalffaceId h : mesh.halffaces()) {
    if (!mesh.is_boundary(h)) continue;
    const auto [a, b, c] = mesh.vertices(h);
    for (const auto& [i, j] : {std::pair(a, b), {b, c}, {c, a}}) on_boundary[*table.find(i, j)] = 1;
  }
  factors_.assign(6 * mesh.n_tetrahedra(), 0);
  const auto factor = [&](bool boundary, double inner, double outer, std::span<const VertexId> vertices) {
    const double s = mean(sizes, vertices);
    return (boundary ? outer : inner) / (s * s);
  };
  for (const TetId t : mesh.tetrahedra()) {
    const auto& corners = mesh.corners(t);
    for (std::size_t e = 0; e < 6; ++e) {
      const auto& [i, j, k, l] = kEdgeCorners[e];
      const std::array ends = {corners[std::size_t(i)], corners[std::size_t(j)]};
      const std::uint32_t number = *table.find(ends[0], ends[1]);
      factors_[number] = factor(on_boundary[number] != 0, model.edges, model.boundary_edges, ends);
      elements_[t].edges[e] = number;
    }
    const double s = mean(sizes, corners);
    barriers_[t] = floors_[t] == kNoFloor ? 0 : model.barrier * s * s * s;
  }
  for (const HalffaceId h : mesh.halffaces()) {
    if (!mesh.is_face_representative(h)) continue;
    const auto number = static_cast<std::uint32_t>(factors_.size());
    factors_.push_back(factor(mesh.is_boundary(h), model.faces, model.boundary_faces, mesh.vertices(h)));
    elements_[TetMesh::tetrahedron(h)].faces[h.index % 4] = number;
    const HalffaceId twin = mesh.twin(h);
    if (twin.valid()) elements_[TetMesh::tetrahedron(twin)].faces[twin.index % 4] = number;
  }
  const std::vector<Offset> sums = sums_of(parts_of(mesh, nullptr));
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    if (!(sums[i].volume > 0)) factors_[i] = 0;
  }
}

AccuracyEnergy::Parts AccuracyEnergy::parts_of(const TetMesh& mesh, Executor* executor) {
  Parts parts(mesh.n_tetrahedra());
  for_all(mesh, executor, [&](TetId t) { parts[t] = TetDuals(mesh, t).parts(); });
  return parts;
}

std::vector<Offset> AccuracyEnergy::sums_of(const Parts& parts) const {
  std::vector<Offset> sums(factors_.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const TetId t(i);
    for (std::size_t e = 0; e < 6; ++e) sums[elements_[t].edges[e]] = sums[elements_[t].edges[e]] + parts[t].edges[e];
    for (std::size_t f = 0; f < 4; ++f) sums[elements_[t].faces[f]] = sums[elements_[t].faces[f]] + parts[t].faces[f];
  }
  return sums;
}

AccuracyTotal AccuracyEnergy::of(const TetMesh& mesh, Gradient* gradient, Executor* executor) const {
  const Parts parts = parts_of(mesh, executor);
  std::vector<Offset> sums = sums_of(parts);
  AccuracyTotal total;
  for (const TetId t : mesh.tetrahedra()) {
    for (const double height : parts[t].height) {
      if (barriers_[t] == 0) break;
      const double room = height - floors_[t];
      total.barrier += room > 0 ? -barriers_[t] * portable_log(room) : HUGE_VAL;
    }
  }
  // From sums of V and N to the derivatives by them.
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (factors_[i] == 0) {  // maybe no numbers
      sums[i] = {};
      continue;
    }
    const auto [volume, moment] = sums[i];
    const double over = factors_[i] / volume, n2 = squared_length(moment);
    total.energy += over > 0 ? over * n2 : HUGE_VAL;
    sums[i] = {-over / volume * n2, 2 * over * moment};
  }
  if (gradient == nullptr) return total;
  IdVector<TetId, std::array<WeightedPoint, 4>> slopes(mesh.n_tetrahedra());
  for_all(mesh, executor, [&](TetId t) {
    TetParts by;
    for (std::size_t e = 0; e < 6; ++e) by.edges[e] = sums[elements_[t].edges[e]];
    for (std::size_t f = 0; f < 4; ++f) {
      by.faces[f] = sums[elements_[t].faces[f]];
      by.height[f] = -barriers_[t] / (parts[t].height[f] - floors_[t]);
    }
    slopes[t] = TetDuals(mesh, t).pulled_back(by);
  });
  *gradient = Gradient(mesh.n_vertices());
  for (const TetId t : mesh.tetrahedra()) add_to(*gradient, mesh.corners(t), slopes[t]);
  return total;
}

}  // namespace temper::tets

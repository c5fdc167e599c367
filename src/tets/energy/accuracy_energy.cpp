#include "tets/energy/accuracy_energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable_log.hpp"
#include "temper/detail/executor.hpp"
#include "temper/tets/geometry.hpp"
#include "tets/energy/star_kernel.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

double mean(const VertexSizes& sizes, std::span<const VertexId> vertices) {
  double sum = 0;
  for (const VertexId v : vertices) sum += sizes[v];
  return sum / static_cast<double>(vertices.size());
}

}  // namespace

double height_that_counts(const TetMesh& mesh, HalffaceId h, Criterion criterion) {
  const auto height = [&mesh](HalffaceId side) {
    const auto [p, q, r] = mesh.vertices(side);
    const Vec3 a = mesh.position(q) - mesh.position(p), b = mesh.position(r) - mesh.position(p);
    return signed_height(mesh.point(p), mesh.point(q), mesh.point(r), mesh.point(mesh.opposite(side))) /
           (kLengthOfArea * std::sqrt(length(cross(a, b))));
  };
  return height(h) + (has_joined_sides(mesh, h, criterion) ? height(mesh.twin(h)) : 0);
}

AccuracyEnergy::AccuracyEnergy(const TetMesh& mesh, const VertexSizes& sizes, Floors floors, const AccuracyModel& model,
                               Criterion criterion)
    : elements_(mesh.n_tetrahedra()), barriers_(mesh.n_halffaces()), floors_(std::move(floors)), criterion_(criterion) {
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
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      barriers_[h] = floors_[h] == kNoFloor ? 0 : model.barrier * s * s * s;
    }
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
  is_left_out_.resize(factors_.size());
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    if (factors_[i] == 0 || sums[i].volume > 0) continue;
    factors_[i] = 0;
    is_left_out_[i] = 1;
  }
}

bool AccuracyEnergy::leaves_out_part_of(TetId t) const {
  const auto is_out = [this](std::uint32_t element) { return is_left_out_[element] != 0; };
  const auto& [edges, faces] = elements_[t];
  return std::any_of(edges.begin(), edges.end(), is_out) || std::any_of(faces.begin(), faces.end(), is_out);
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

double AccuracyEnergy::barrier_of(const TetMesh& mesh, const Parts& parts, Floors& by_height) const {
  double sum = 0;
  const auto height = [&parts](HalffaceId h) { return parts[TetMesh::tetrahedron(h)].height[h.index % 4]; };
  for (const HalffaceId h : mesh.halffaces()) {
    if (barriers_[h] == 0) continue;
    const HalffaceId twin = has_joined_sides(mesh, h, criterion_) ? mesh.twin(h) : HalffaceId();
    const double room = height(h) + (twin.valid() ? height(twin) : 0) - floors_[h];
    sum += room > 0 ? -barriers_[h] * portable_log(room) : HUGE_VAL;
    by_height[h] -= barriers_[h] / room;
    if (twin.valid()) by_height[twin] -= barriers_[h] / room;
  }
  return sum;
}

AccuracyTotal AccuracyEnergy::of(const TetMesh& mesh, Gradient* gradient, Executor* executor) const {
  const Parts parts = parts_of(mesh, executor);
  std::vector<Offset> sums = sums_of(parts);
  AccuracyTotal total;
  Floors by_height(mesh.n_halffaces(), 0);
  total.barrier = barrier_of(mesh, parts, by_height);
  // From sums of V and N to the derivatives by them.
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (factors_[i] == 0) {  // maybe no numbers
      sums[i] = {};
      continue;
    }
    const auto [volume, moment] = sums[i];
    const double over = factors_[i] / volume, n2 = dot(moment, moment);
    total.energy += over > 0 ? over * n2 : HUGE_VAL;
    sums[i] = {-over / volume * n2, 2 * over * moment};
  }
  if (gradient == nullptr) return total;
  const auto by = [&](TetId t) {
    TetParts by_parts = {};
    for (std::size_t e = 0; e < 6; ++e) by_parts.edges[e] = sums[elements_[t].edges[e]];
    for (std::size_t f = 0; f < 4; ++f) {
      by_parts.faces[f] = sums[elements_[t].faces[f]];
      by_parts.height[f] = by_height[TetMesh::halfface(t, static_cast<int>(f))];
    }
    return by_parts;
  };
  *gradient = Gradient(mesh.n_vertices());
  add_pulled_back(*gradient, mesh, by, executor);
  return total;
}

}  // namespace temper::tets

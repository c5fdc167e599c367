// The criteria of targets, for tetrahedra.
#include "temper/tets/criterion.hpp"

#include <algorithm>

#include "base/sort_unique.hpp"
#include "mesh/blocks.hpp"
#include "tets/mesh/tables.hpp"
#include "tets/quality/coefficients.hpp"
#include "tets/quality/duals.hpp"

namespace temper::tets {
namespace {

template <class Violated>
std::vector<Violated> joined(const std::vector<std::vector<Violated>>& blocks) {
  std::vector<Violated> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

void append_cells(const TetMesh& mesh, const std::vector<ViolatedEdge>& edges, std::vector<TetId>& cells) {
  const VertexStars stars(mesh);
  for (const ViolatedEdge& edge : edges)
    stars.for_each_around(mesh, edge.vertices, [&cells](TetId t) { cells.push_back(t); });
}

}  // namespace

std::vector<ViolatedEdge> violated_edges(const TetMesh& mesh, Executor* executor) {
  const Coefficients coefficients(mesh, executor);
  std::vector<std::vector<ViolatedEdge>> blocks(coefficients.n_blocks());
  coefficients.visit(executor, [&](std::size_t b, const EdgeCoefficient& c) {
    if (c.sign == Sign::negative) blocks[b].push_back({c.vertices, c.kind, c.region, c.over_l});
  });
  return joined(blocks);
}

std::vector<ViolatedFace> violated_faces(const TetMesh& mesh, Executor* executor) {
  std::vector<std::vector<ViolatedFace>> blocks((mesh.n_halffaces() + kLoopBlock - 1) / kLoopBlock);
  for_blocks(mesh.n_halffaces(), executor, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!mesh.is_face_representative(HalffaceId(i))) continue;
      visit_duals(mesh, HalffaceId(i), [&](DualKind kind, HalffaceId h, Sign sign) {
        if (sign != Sign::positive)
          blocks[first / kLoopBlock].push_back({h, kind, dual_over_length(mesh, h, kind, sign)});
      });
    }
  });
  return joined(blocks);
}

std::vector<TetId> cells_at_violations(const TetMesh& mesh, Criterion criterion, Executor* executor) {
  std::vector<TetId> cells;
  if (criterion == Criterion::coefficients) {
    append_cells(mesh, violated_edges(mesh, executor), cells);
  } else if (criterion == Criterion::distances) {
    for (const ViolatedFace& violated : violated_faces(mesh, executor)) {
      cells.push_back(TetMesh::tetrahedron(violated.face));
      if (!mesh.is_boundary(violated.face)) cells.push_back(TetMesh::tetrahedron(mesh.twin(violated.face)));
    }
  } else {
    for (const TetId t : mesh.tetrahedra()) {
      if (!is_well_centered(mesh, t)) cells.push_back(t);
    }
  }
  sort_unique(cells);
  return cells;
}

bool meets(const TetMesh& mesh, Criterion criterion, Executor* executor) {
  if (criterion == Criterion::coefficients) return violated_edges(mesh, executor).empty();
  const auto is_violated = [&](std::size_t i) {
    const HalffaceId h(i);
    if (criterion == Criterion::well_centered) return height_sign(mesh, h) != Sign::positive;
    if (!mesh.is_face_representative(h)) return false;
    bool violated = false;
    visit_duals(mesh, h, [&](DualKind, HalffaceId, Sign sign) { violated = violated || sign != Sign::positive; });
    return violated;
  };
  return !first_index(mesh.n_halffaces(), executor, is_violated);
}

}  // namespace temper::tets

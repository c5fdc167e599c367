// The criteria of targets, in the plane and on the sphere.
#include "temper/detail/criterion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "geometry/surface.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesh/blocks.hpp"
#include "regularity/duals.hpp"

namespace temper {
namespace {

constexpr std::array<CriterionInfo, 3> kCriteria = {{
    {Criterion::well_centered, "well_centered", "each orthocenter is inside its cell, and each dual crosses its edge",
     "the diagonal Hodge stars, and meshes for any solver"},
    {Criterion::coefficients, "coefficients",
     "no edge has a negative coefficient, on the boundary and in each region alone, too", "unknowns at vertices"},
    {Criterion::distances, "distances",
     "each center has a positive distance from the next one, from the boundary and from interfaces",
     "unknowns in cells"},
}};

constexpr std::array<std::string_view, 3> kDualKinds = {"inside", "boundary", "region"};

bool is_upright(const Mesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.corners(t);
  return inlined::orientation(mesh, a, b, c) == Sign::positive;
}

/// A representative of an edge that is there.
bool is_edge(const Mesh& mesh, HalfedgeId h) {
  return mesh.is_edge_representative(h) && !mesh.is_erased(Mesh::triangle(h));
}

}  // namespace

std::span<const CriterionInfo> criteria_table() { return kCriteria; }
std::span<const std::string_view> words_of(Criterion /*criterion*/) {
  static constexpr std::array<std::string_view, 3> kNames = {kCriteria[0].name, kCriteria[1].name, kCriteria[2].name};
  return kNames;
}
std::string_view name(Criterion criterion) { return kCriteria[static_cast<std::size_t>(criterion)].name; }
std::string_view name(DualKind kind) { return kDualKinds[static_cast<std::size_t>(kind)]; }
std::span<const std::string_view> words_of(DualKind /*kind*/) { return kDualKinds; }

Criterion criterion_of(Scheme scheme) {
  if (scheme == Scheme::vertex) return Criterion::coefficients;
  return scheme == Scheme::cell ? Criterion::distances : Criterion::well_centered;
}

double with_sign(double rounded, Sign sign) {
  if (sign == Sign::zero) return 0;
  if (std::isnan(rounded)) return -std::numeric_limits<double>::infinity();
  return std::copysign(std::max(std::abs(rounded), std::numeric_limits<double>::min()), static_cast<double>(sign));
}

double dual_over_length(const Mesh& mesh, HalfedgeId h, DualKind kind, Sign sign) {
  const Space& space = mesh.space();
  const auto [a, b, c] = mesh.points(mesh.origin(h), mesh.target(h), mesh.opposite(h));
  double dual;
  if (kind == DualKind::inside)
    dual = dual_length(space, a, b, c, mesh.point(mesh.opposite(mesh.twin(h)), a));
  else
    dual = space.is_plane() ? signed_height(a, b, c)
                            : space.radius() * signed_height(as_vector(a), as_vector(b), as_vector(c));
  return with_sign(dual / distance(space, a, b), sign);
}

std::vector<ViolatedEdge> violated_edges(const Mesh& mesh, Criterion criterion, Executor* executor) {
  TEMPER_ASSERT(criterion != Criterion::well_centered);
  std::vector<std::vector<ViolatedEdge>> blocks((mesh.n_halfedges() + kLoopBlock - 1) / kLoopBlock);
  for_blocks(mesh.n_halfedges(), executor, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!is_edge(mesh, HalfedgeId(i))) continue;
      visit_duals(mesh, HalfedgeId(i), [&](DualKind kind, HalfedgeId h, Sign sign) {
        if (allows(criterion, sign)) return;
        blocks[first / kLoopBlock].push_back({h, kind, dual_over_length(mesh, h, kind, sign)});
      });
    }
  });
  std::vector<ViolatedEdge> all;
  for (const auto& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

std::vector<TriangleId> cells_at_violations(const Mesh& mesh, Criterion criterion, Executor* executor) {
  if (criterion == Criterion::well_centered) return bad_triangles(mesh);
  std::vector<TriangleId> cells;
  for (const ViolatedEdge& violated : violated_edges(mesh, criterion, executor)) {
    cells.push_back(Mesh::triangle(violated.edge));
    if (!mesh.is_boundary(violated.edge)) cells.push_back(Mesh::triangle(mesh.twin(violated.edge)));
  }
  for (const TriangleId t : mesh.triangles()) {
    if (!mesh.is_erased(t) && !is_upright(mesh, t)) cells.push_back(t);
  }
  sort_unique(cells);
  return cells;
}

bool meets(const Mesh& mesh, Criterion criterion, Executor* executor) {
  if (criterion == Criterion::well_centered)
    return !first_index(mesh.n_triangles(), executor, [&](std::size_t t) { return is_bad(mesh, TriangleId(t)); });
  const auto is_violated = [&](std::size_t i) {
    const HalfedgeId h(i);
    if (mesh.is_erased(Mesh::triangle(h))) return false;
    if (h.index % 3 == 0 && !is_upright(mesh, Mesh::triangle(h))) return true;
    if (!mesh.is_edge_representative(h)) return false;
    bool violated = false;
    visit_duals(mesh, h, [&](DualKind, HalfedgeId, Sign sign) { violated = violated || !allows(criterion, sign); });
    return violated;
  };
  return !first_index(mesh.n_halfedges(), executor, is_violated);
}

}  // namespace temper

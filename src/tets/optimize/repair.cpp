#include "tets/optimize/repair.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sort_unique.hpp"
#include "temper/tets/criterion.hpp"
#include "tets/energy/star.hpp"

namespace temper::tets {
namespace {

// Cones are judged by the energy at this γ.
constexpr double kGamma = 0.2;
// Newton steps of a new vertex before its cone is judged.
constexpr int kStepsOfNewVertex = 8;
// A gain below this part of the energy is none: else rounding could undo and redo a change.
constexpr double kLeastGain = 1e-3;

double regular_energy() {
  const auto face = link_face<double>({1, 1, 1, 0}, {-1, 1, -1, 0}, {1, -1, -1, 0});
  return tet_energy<double>(face, {-1, -1, 1}, 0, kGamma);
}

struct Judged {
  Filling filling;
  double gain = 0;
};

class Repairs {
 public:
  Repairs(const Draft& draft, const RepairOptions& options)
      : draft_(draft), mesh_(draft.mesh), options_(options), cavities_(draft.mesh) {}

  /// The candidates at t, the best first.
  std::vector<Judged> at(TetId t) {
    found_.clear();
    const auto& corners = mesh_.corners(t);
    insert(cavities_.of_tetrahedron(t));
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      if (const auto cavity = cavities_.of_face(h)) {
        insert(*cavity);
        connect(*cavity, {mesh_.opposite(h)});
      }
      if (options_.split_boundary) split(cavities_.to_split(h));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        if (options_.split_boundary) split(cavities_.to_split(t, corners[i], corners[j]));
        const auto ring = cavities_.of_edge(t, corners[i], corners[j]);
        if (!ring) continue;
        insert(*ring);
        std::vector<VertexId> around = vertices_of(*ring);
        std::erase_if(around, [&](VertexId v) { return v == corners[i] || v == corners[j]; });
        connect(*ring, around);
      }
      if (draft_.mobility_of(corners[i]) != Mobility::free) continue;
      if (const auto star = cavities_.of_vertex(corners[i])) connect(*star, vertices_of(*star), corners[i]);
    }
    std::stable_sort(found_.begin(), found_.end(), [](const Judged& a, const Judged& b) { return a.gain > b.gain; });
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::vector<VertexId> vertices_of(const Cavity& cavity) const {
    std::vector<VertexId> all;
    for (const HalffaceId h : cavity.faces) {
      for (const VertexId v : mesh_.vertices(h)) all.push_back(v);
    }
    sort_unique(all);
    return all;
  }
  [[nodiscard]] double excess(const std::vector<HalffaceId>& faces, const WeightedPoint& apex) const {
    double sum = 0;
    for (const HalffaceId h : faces) {
      const LinkFace<double> face = link_face(mesh_, h);
      sum += star_energy({&face, 1}, apex, kGamma) - regular_;
    }
    return sum;
  }
  [[nodiscard]] double excess(const Cavity& cavity) const {
    double sum = 0;
    for (const TetId t : cavity.tetrahedra) sum += energy_of(mesh_, t, kGamma) - regular_;
    return sum;
  }
  void judge(Filling filling, double before, const WeightedPoint& apex) {
    const double gain = before - excess(filling.base(mesh_), apex) + (filling.apex.valid() ? 0 : options_.allowance);
    if (gain > kLeastGain * before) found_.push_back({std::move(filling), gain});
  }
  /// Fills a cavity from each of some vertices.
  void connect(const Cavity& cavity, const std::vector<VertexId>& apexes, VertexId removed = {}) {
    const double before = excess(cavity);
    for (const VertexId v : apexes) {
      Filling filling{cavity, v, {}, removed};
      if (is_valid(mesh_, filling)) judge(std::move(filling), before, mesh_.point(v));
    }
  }
  void insert(const Cavity& cavity) {
    Filling filling{cavity, {}, {}, {}};
    WeightedPoint& p = filling.point;
    const std::vector<VertexId> corners = cavity.split.empty() ? vertices_of(cavity) : cavity.split;
    const double share = 1 / static_cast<double>(corners.size());
    for (const VertexId v : corners) {
      const WeightedPoint q = mesh_.point(v);
      p = {p.x + share * q.x, p.y + share * q.y, p.z + share * q.z, p.w + share * q.w};
    }
    if (!is_valid(mesh_, filling)) return;
    const Mobility mobility = cavity.split.empty() ? Mobility::free : Mobility::weight;
    for (int i = 0; i < kStepsOfNewVertex; ++i) p = improved(mesh_, cavity.faces, p, mobility, {kGamma, 1}, room_);
    const WeightedPoint apex = p;
    judge(std::move(filling), excess(cavity), apex);
  }
  /// Splits an edge or face, unless it may be on the border of a patch.
  void split(const std::optional<Cavity>& cavity) {
    const auto stays = [&](VertexId v) { return draft_.mobility_of(v) == Mobility::none; };
    if (cavity && !std::all_of(cavity->split.begin(), cavity->split.end(), stays)) insert(*cavity);
  }

  const Draft& draft_;
  const TetMesh& mesh_;
  RepairOptions options_;
  double regular_ = regular_energy();
  Cavities cavities_;
  std::vector<Judged> found_;
  std::vector<LinkLanes> room_;  // of steps of new vertices
};

}  // namespace

std::vector<Filling> repairs(const Draft& draft, const std::vector<TetId>& tetrahedra, const RepairOptions& options,
                             const MustStop& must_stop) {
  Repairs search(draft, options);
  std::vector<Judged> all;
  for (const TetId t : tetrahedra) {
    if (must_stop(0)) return {};
    std::vector<Judged> found = search.at(t);
    if (!found.empty()) all.push_back(std::move(found[options.rank % found.size()]));
  }
  std::stable_sort(all.begin(), all.end(), [](const Judged& a, const Judged& b) { return a.gain > b.gain; });
  IdVector<TetId, std::uint8_t> used(draft.mesh.n_tetrahedra());
  std::vector<Filling> chosen;
  for (Judged& one : all) {
    const auto& cavity = one.filling.cavity.tetrahedra;
    if (std::any_of(cavity.begin(), cavity.end(), [&](TetId t) { return used[t] != 0; })) continue;
    for (const TetId t : cavity) used[t] = 1;
    chosen.push_back(std::move(one.filling));
  }
  return chosen;
}

bool split_violated_edges(Draft& draft, Executor* executor) {
  const TetMesh& mesh = draft.mesh;
  std::vector<ViolatedEdge> edges = violated_edges(mesh, executor);
  std::erase_if(edges, [](const ViolatedEdge& e) { return e.kind == DualKind::inside; });
  std::stable_sort(edges.begin(), edges.end(),
                   [](const ViolatedEdge& a, const ViolatedEdge& b) { return a.dual_over_l2 < b.dual_over_l2; });
  const Cavities cavities(mesh);
  const VertexStars stars(mesh);
  IdVector<TetId, std::uint8_t> used(mesh.n_tetrahedra());
  std::vector<Filling> chosen;
  for (const ViolatedEdge& e : edges) {
    const auto [a, b] = e.vertices;
    TetId at_edge;
    stars.for_each_around(mesh, e.vertices, [&at_edge](TetId t) { at_edge = at_edge.valid() ? at_edge : t; });
    auto cavity = cavities.to_split(at_edge, a, b);
    if (!cavity) continue;
    const auto& around = cavity->tetrahedra;
    if (std::any_of(around.begin(), around.end(), [&](TetId t) { return used[t] != 0; })) continue;
    const WeightedPoint p = mesh.point(a), q = mesh.point(b);
    Filling filling{
        *std::move(cavity), {}, {0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z), 0.5 * (p.w + q.w)}, {}};
    if (!is_valid(mesh, filling)) continue;
    for (const TetId t : filling.cavity.tetrahedra) used[t] = 1;
    chosen.push_back(std::move(filling));
  }
  return !chosen.empty() && draft.fill(chosen);
}

}  // namespace temper::tets

#include "tets/optimize/repair.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/sort_unique.hpp"
#include "tets/energy/star.hpp"
#include "tets/optimize/sweeper.hpp"

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
  Repairs(const TetMesh& mesh, const IdVector<VertexId, Mobility>& mobility, double allowance)
      : mesh_(mesh), mobility_(mobility), allowance_(allowance), cavities_(mesh) {}

  /// The candidates at t, the best first.
  std::vector<Judged> at(TetId t) {
    found_.clear();
    const auto& corners = mesh_.corners(t);
    insert(cavities_.of_tetrahedron(t));
    for (int f = 0; f < 4; ++f) {
      const HalffaceId h = TetMesh::halfface(t, f);
      if (const auto cavity = cavities_.of_face(h)) {
        insert(*cavity);
        connect(*cavity, mesh_.opposite(h));
      }
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const auto ring = cavities_.of_edge(t, corners[i], corners[j]);
        if (!ring) continue;
        insert(*ring);
        for (const VertexId v : vertices_of(*ring)) {
          if (v != corners[i] && v != corners[j]) connect(*ring, v);
        }
      }
      if (mobility_[corners[i]] != Mobility::free) continue;
      const auto star = cavities_.of_vertex(corners[i]);
      if (!star) continue;
      for (const VertexId v : vertices_of(*star)) connect(*star, v, corners[i]);
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
  void judge(Filling filling, const WeightedPoint& apex) {
    const double before = excess(filling.cavity);
    const double gain = before - excess(filling.base(mesh_), apex) + (filling.apex.valid() ? 0 : allowance_);
    if (gain > kLeastGain * before) found_.push_back({std::move(filling), gain});
  }
  void connect(const Cavity& cavity, VertexId apex, VertexId removed = {}) {
    Filling filling{cavity, apex, {}, removed};
    if (is_valid(mesh_, filling)) judge(std::move(filling), mesh_.point(apex));
  }
  void insert(const Cavity& cavity) {
    Filling filling{cavity, {}, {}, {}};
    WeightedPoint& p = filling.point;
    const std::vector<VertexId> corners = vertices_of(cavity);
    const double share = 1 / static_cast<double>(corners.size());
    for (const VertexId v : corners) {
      const WeightedPoint q = mesh_.point(v);
      p = {p.x + share * q.x, p.y + share * q.y, p.z + share * q.z, p.w + share * q.w};
    }
    if (!is_valid(mesh_, filling)) return;
    for (int i = 0; i < kStepsOfNewVertex; ++i) p = improved(mesh_, cavity.faces, p, Mobility::free, {kGamma, 1});
    const WeightedPoint apex = p;
    judge(std::move(filling), apex);
  }

  const TetMesh& mesh_;
  const IdVector<VertexId, Mobility>& mobility_;
  double allowance_, regular_ = regular_energy();
  Cavities cavities_;
  std::vector<Judged> found_;
};

}  // namespace

std::vector<Filling> repairs(const TetMesh& mesh, const std::vector<TetId>& bad,
                             const IdVector<VertexId, Mobility>& mobility, const RepairOptions& options) {
  Repairs search(mesh, mobility, options.allowance);
  std::vector<Judged> all;
  for (const TetId t : bad) {
    if (options.must_stop && options.must_stop()) return {};
    std::vector<Judged> found = search.at(t);
    if (!found.empty()) all.push_back(std::move(found[options.rank % found.size()]));
  }
  std::stable_sort(all.begin(), all.end(), [](const Judged& a, const Judged& b) { return a.gain > b.gain; });
  IdVector<TetId, std::uint8_t> used(mesh.n_tetrahedra());
  std::vector<Filling> chosen;
  for (Judged& one : all) {
    const auto& cavity = one.filling.cavity.tetrahedra;
    if (std::any_of(cavity.begin(), cavity.end(), [&](TetId t) { return used[t] != 0; })) continue;
    for (const TetId t : cavity) used[t] = 1;
    chosen.push_back(std::move(one.filling));
  }
  return chosen;
}

}  // namespace temper::tets

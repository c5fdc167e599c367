#include "experiments/search_loop.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/line_search.hpp"
#include "experiments/minimise.hpp"
#include "temper/geometry.hpp"
#include "temper/regularity.hpp"

namespace temper::gallery {
namespace {

constexpr int kPositionSearches = 3;

/// A small generator for shuffles: what matters is that orders differ and repeat.
std::uint64_t next_random(std::uint64_t& state) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return state >> 33;
}

std::vector<VertexId> sequence_of(const Mesh& mesh, const VertexOrder& order) {
  std::vector<VertexId> sequence;
  for (const VertexId v : mesh.vertices()) sequence.push_back(v);
  if (order.order == SweepOrder::reverse) std::ranges::reverse(sequence);
  if (order.order == SweepOrder::random) {
    std::uint64_t state = order.seed;
    for (std::size_t i = sequence.size(); i > 1; --i) std::swap(sequence[i - 1], sequence[next_random(state) % i]);
  }
  return sequence;
}

std::size_t count_inverted(const Mesh& mesh) {
  std::size_t count = 0;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    if (orient2d(mesh.position(a), mesh.position(b), mesh.position(c)) != Sign::positive) ++count;
  }
  return count;
}

class Loop {
 public:
  Loop(const SearchLoop& loop, const Mesh& start, const VertexOrder& order)
      : loop_(loop), mesh_(start), sequence_(sequence_of(start, order)) {
    model_.kind = loop.energy;
    note("start");
  }

  std::vector<LoopStage> run(int sweeps) && {
    for (int i = 0; i < sweeps; ++i) {
      const bool was_tangled = tangled();
      overshoot_ = 1 + 0.1 * std::pow(0.1, i);
      sweep(std::to_string(i + 1));
      if (was_tangled) break;
    }
    return std::move(stages_);
  }

 private:
  [[nodiscard]] bool tangled() const { return stages_.back().inverted > 0; }

  void sweep(const std::string& number) {
    for (const VertexId v : sequence_) {
      if (loop_.positions) search_position(v);
      if (!loop_.all_positions_first) search_weight(v);
    }
    note("positions " + number);
    if (loop_.all_positions_first) {
      for (const VertexId v : sequence_) search_weight(v);
    }
    note("weights " + number);
    if (tangled()) return;
    const Restoration restored = restore_regularity(mesh_);
    note("flips " + number);
    for (const VertexId v : restored.hidden) {
      ++(mesh_.is_boundary(v) ? stages_.back().hidden_on_boundary : stages_.back().hidden_inside);
    }
  }

  void search_position(VertexId v) {
    if (mesh_.is_boundary(v)) return;
    for (int i = 0; i < kPositionSearches; ++i) {
      const VertexDerivatives here = vertex_energy(mesh_, model_, v);
      const Vec2 downhill{-here.gradient[0], -here.gradient[1]}, from = mesh_.position(v);
      if (!(squared_length(downhill) > 0) || !std::isfinite(here.value)) return;
      const Vec2 step = (patch_radius(mesh_, v) / length(downhill)) * downhill;
      const double limit = limited(position_flip_threshold(mesh_, v, step));
      if (!minimise(v, here.value, limit, [&](double t) { mesh_.set_position(v, from + t * step); })) return;
    }
  }

  void search_weight(VertexId v) {
    const VertexDerivatives here = vertex_energy(mesh_, model_, v);
    if (here.gradient[2] == 0 || !std::isfinite(here.value)) return;
    const double r = patch_radius(mesh_, v), from = mesh_.weight(v);
    const double direction = here.gradient[2] > 0 ? -1 : 1, reach = loop_.weight_reach * r * r;
    const double limit = limited(weight_flip_threshold(mesh_, v, direction) / reach);
    minimise(v, here.value, limit, [&](double t) { mesh_.set_weight(v, from + t * direction * reach); });
  }

  [[nodiscard]] double limited(double threshold) const {
    return loop_.limited ? std::min(1.0, overshoot_ * threshold) : 1.0;
  }

  /// Puts v to the best place of [0, limit], or back to 0. True when that lowers the energy.
  template <class Put>
  bool minimise(VertexId v, double before, double limit, Put&& put) {
    if (!(limit > 0)) return false;
    const auto energy = [&](double t) {
      put(t);
      return vertex_energy(mesh_, model_, v).value;
    };
    const double t = golden_minimum(energy, 0, limit, kSearchTolerance).at;
    if (energy(t) < before) return true;
    put(0);
    return false;
  }

  void note(const std::string& name) {
    LoopStage stage{name, mesh_, total_energy(mesh_, model_), count_inverted(mesh_), 0, 0, 0, 0};
    if (stage.inverted == 0) stage.non_regular = count_non_regular_edges(mesh_);
    for (const VertexId v : mesh_.vertices()) {
      stage.largest_weight = std::max(stage.largest_weight, std::abs(mesh_.weight(v)));
    }
    stages_.push_back(std::move(stage));
  }

  SearchLoop loop_;
  Mesh mesh_;
  EnergyModel model_;
  std::vector<VertexId> sequence_;
  double overshoot_ = 1.1;
  std::vector<LoopStage> stages_;
};

}  // namespace

std::vector<LoopStage> run_loop(const SearchLoop& loop, const Mesh& start, const VertexOrder& order, int sweeps) {
  return Loop(loop, start, order).run(sweeps);
}

}  // namespace temper::gallery

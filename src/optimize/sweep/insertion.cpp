#include "optimize/sweep/insertion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "optimize/step/removal.hpp"
#include "temper/detail/geometry.hpp"
#include "topology/locate.hpp"

namespace temper {
namespace {

struct Large {
  TriangleId triangle;
  double energy;
};

class Insertion {
 public:
  Insertion(WorkingCopy& work, Flipper& flipper, const Policy& policy, const EnergyModel& model)
      : work_(work), mesh_(work.mesh), flipper_(flipper), policy_(policy), model_(model) {}

  bool run() {
    bool inserted = false;
    const double limit = policy_.insertion_ratio * mean_energy();
    for (const auto& [t, energy] : larger_than(limit)) {
      if (own_energy(t) > limit && insert_at_orthocenter(t)) inserted = true;  // what came before may have changed it
    }
    return inserted;
  }

 private:
  [[nodiscard]] double own_energy(TriangleId t) const {
    const auto [a, b, c] = mesh_.corners(t);
    return triangle_energy(model_, mesh_.point(a), mesh_.point(b), mesh_.point(c));
  }
  [[nodiscard]] double mean_energy() const;
  [[nodiscard]] std::vector<Large> larger_than(double limit) const;
  bool insert_at_orthocenter(TriangleId t);

  WorkingCopy& work_;
  Mesh& mesh_;
  Flipper& flipper_;
  const Policy& policy_;
  const EnergyModel& model_;
  InsertionPlan plan_;
};

/// Of the magnitudes, since E_F may be negative; of those that are finite.
double Insertion::mean_energy() const {
  double sum = 0;
  std::size_t n = 0;
  for (const TriangleId t : mesh_.triangles()) {
    const double energy = std::abs(own_energy(t));
    if (std::isfinite(energy)) sum += energy, ++n;
  }
  return n == 0 ? 0 : sum / static_cast<double>(n);
}

std::vector<Large> Insertion::larger_than(double limit) const {
  std::vector<Large> large;
  for (const TriangleId t : mesh_.triangles()) {
    if (const double energy = own_energy(t); energy > limit) large.push_back({t, energy});
  }
  std::stable_sort(large.begin(), large.end(), [](const Large& a, const Large& b) { return a.energy > b.energy; });
  return large;
}

bool Insertion::insert_at_orthocenter(TriangleId t) {
  const auto [a, b, c] = mesh_.corners(t);
  const Vec2 o = work_.frame.snap(orthocenter(mesh_.point(a), mesh_.point(b), mesh_.point(c)));
  if (!std::isfinite(o.x) || !std::isfinite(o.y)) return false;
  const Location at = locate(mesh_, o, t);
  if (at.kind != Location::Kind::in_triangle) return false;
  const double w = interpolated_weight(mesh_, at.triangle, o);
  plan_ = plan_insertion(mesh_, {o.x, o.y, w}, at.triangle, std::move(plan_));
  if (plan_.status != InsertionStatus::possible) return false;
  const PatchComparison e = compare_patch(mesh_, model_, plan_, policy_.removal_measure);
  if (!e.better_with(policy_.removal_margin)) return false;
  flipper_.commit(work_, plan_, e.without, e.with);
  return true;
}

}  // namespace

bool insert_where_energy_is_large(WorkingCopy& work, Flipper& flipper, const Settings& settings,
                                  const EnergyModel& model) {
  return Insertion(work, flipper, settings.policy, model).run();
}

}  // namespace temper

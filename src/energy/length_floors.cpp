#include "energy/length_floors.hpp"

#include <algorithm>

#include "base/sum.hpp"
#include "energy/accuracy_star.hpp"
#include "mesh/edge_lengths.hpp"

namespace temper {
namespace {

// What is shorter than it should be stays longer than this part of what it is.
constexpr double kKeptLength = 0.9;
// By so much its barrier is higher after each sweep, up to that: less, and it stays where the energy holds it; more,
// and it pushes its neighbours below what they should have.
constexpr double kUrgency = 2, kMostUrgent = 100;
// So much more than what is asked for is aimed at, since the last sweep changes local sizes once more.
constexpr double kAim = 1.08;
// What has become longer by this part has gained.
constexpr double kGain = 1e-3;

double squared(double x) { return x * x; }

}  // namespace

std::size_t LengthFloors::raise(const Mesh& mesh, const IdVector<VertexId, double>& sizes, const AccuracyModel& model,
                                Executor* executor) {
  if (floors_.empty()) floors_.resize(mesh.n_halfedges());
  const auto raise_one = [&](HalfedgeId h) {
    const double s = sizes[mesh.origin(h)], t = sizes[mesh.target(h)], aim = kAim * 0.5 * (s + t);
    const double least_edge = aim * model.min_edge, least_dual = aim * model.min_dual;
    const auto [edge, dual] = edge_lengths(mesh, h);
    const bool lacks = edge <= least_edge || dual <= least_dual;
    const double usual = model.barrier / edge_scale(s, t);
    LengthBarrier<double>& floor = floors_[h];
    const LengthBarrier<double> before = floor;
    floor.factor = lacks ? std::min(kUrgency * std::max(before.factor, usual), kMostUrgent * usual) : usual;
    floor.l2 = std::max(before.l2, squared(std::min(least_edge, kKeptLength * edge)));
    floor.dual2 = std::max(before.dual2, squared(std::clamp(kKeptLength * dual, 0.0, least_dual)));
    return lacks && (floor.l2 > (1 + kGain) * before.l2 || floor.dual2 > (1 + kGain) * before.dual2);
  };
  return static_cast<std::size_t>(blockwise_sum(mesh.n_halfedges(), executor, [&](std::size_t i) {
    const HalfedgeId h(i);
    return mesh.is_edge_representative(h) && !mesh.is_boundary(h) && raise_one(h) ? 1.0 : 0.0;
  }));
}

}  // namespace temper

// The guard: measures that no run makes worse than in the input, or than a bound.
//
// Four measures are of triangles: the least angle, the length of an edge over the size of its two triangles, the ratio
// of their areas, and the time that a long wave takes to cross. Codes with explicit time steps or fluxes look at the
// worst of each over the mesh. A limit is the worse of bound and input, so a bound that the input misses is no goal.
//
// A change of the mesh replaces some triangles. The guard refuses it if the worst measure around it becomes worse, and
// is then beyond the limit. So good triangles may become worse as far as the limit, and the worst ones never do. Steps,
// flips, insertions and removals ask the guard; the judge (judge.hpp) counts the triangles beyond it in each candidate.
// Some changes ask nobody, such as the flips that make the input regular. The judge is for them.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "optimize/working/working_units.hpp"
#include "temper/optimize.hpp"
#include "temper/topology.hpp"

namespace temper {

/// Values of which the least counts: larger is better. None depends on weights.
struct GuardValues {
  enum Measure { sine, edge, areas, crossing, edge_crossing };  // sine of the least angle; edge/size squared; times [s]
  static constexpr std::size_t kMeasures = 5;
  std::array<double, kMeasures> value;

  GuardValues() { value.fill(std::numeric_limits<double>::infinity()); }
  /// Takes the worse of the two, measure by measure.
  void take(const GuardValues& other);
  /// Says whether no measure is worse than here and beyond the limit.
  [[nodiscard]] bool hold(const GuardValues& before, const GuardValues& limits) const;
};

/// The limits of a run. The field is in the user's units.
struct GuardLimits {
  GuardValues values;     ///< of the judge
  GuardValues for_steps;  ///< tighter by a margin, since other maps and units give slightly other values
  std::optional<SizeField> depth;
};

class Guard {
 public:
  /// The guard of a mesh in working units. Without limits it is off.
  Guard(const Mesh& mesh, const WorkingUnits& units, std::shared_ptr<const GuardLimits> limits);

  [[nodiscard]] bool on() const { return limits_ != nullptr; }

  /// Say whether these changes are within the guard: v moves to p, a plan is committed.
  [[nodiscard]] bool allows_move(VertexId v, const WeightedPoint& p);
  [[nodiscard]] bool allows(const RemovalPlan& plan);
  [[nodiscard]] bool allows(const InsertionPlan& plan);
  /// Call this if v has gone to the p of the last allows_move().
  void moved(VertexId v) {
    if (on() && has_depth()) depth_[v] = there_;
  }

  // The flips of one step. Call begin_flips() first, about_to_flip() before each flip, and allow_flips() at the end.
  void begin_flips();
  void about_to_flip(HalfedgeId h);
  [[nodiscard]] bool allow_flips() const;

  /// Returns the worst values of the mesh.
  [[nodiscard]] GuardValues worst(Executor* executor = nullptr) const;
  /// Returns the values at boundary edge h, if its triangle had a neighbor with this third corner.
  [[nodiscard]] GuardValues across(HalfedgeId h, const WeightedPoint& beyond) const;
  [[nodiscard]] const GuardValues& limits() const { return limits_->for_steps; }
  /// Counts the triangles that are beyond the limits, alone or with a neighbor.
  [[nodiscard]] std::size_t count_beyond(Executor* executor = nullptr) const;

  /// Follow a compaction of the mesh, and new vertices at its end.
  void renumber(const Compaction& kept);
  void grow();

 private:
  using Corners = std::array<VertexId, 3>;
  struct Triangle {
    double doubled_area = 0;
    std::array<double, 3> l2 = {};  // of the edges from corner k to k + 1
    double depth = 0;
  };
  /// A triangle of the mesh; or of plans, where the vertex `moving_` (invalid: a new one) is at `place_`.
  [[nodiscard]] Triangle triangle(const Corners& corners, bool of_plan = false) const;
  [[nodiscard]] Triangle triangle(TriangleId t) const { return triangle(mesh_.corners(t)); }
  [[nodiscard]] GuardValues alone(const Triangle& t) const;
  [[nodiscard]] static GuardValues of_pair(const Triangle& s, const Triangle& t, double l2);
  /// Returns the values of t and of its pairs with neighbors, except those that are listed.
  [[nodiscard]] GuardValues around(TriangleId t, std::span<const TriangleId> except = {}) const;
  [[nodiscard]] bool allows(std::span<const TriangleId> old, std::span<const Corners> fresh);
  [[nodiscard]] bool has_depth() const { return limits_->depth.has_value(); }
  [[nodiscard]] double depth_at(const WeightedPoint& p);

  const Mesh& mesh_;
  const WorkingUnits& units_;
  std::shared_ptr<const GuardLimits> limits_;
  IdVector<VertexId, double> depth_;  // if there are depths
  VertexId moving_;
  WeightedPoint place_;
  double there_ = 0;                 // depth at place_
  TriangleId near_;                  // of the field, at the last place
  std::vector<TriangleId> touched_;  // by flips
  GuardValues before_;               // of these
  std::vector<TriangleId> old_;
  std::vector<Corners> fresh_;
  std::vector<Triangle> shapes_;
};

/// Returns the limits for an input, by the options, or null if they set none.
[[nodiscard]] std::shared_ptr<const GuardLimits> guard_limits(const Mesh& input, const OptimizeOptions& options,
                                                              Executor* executor = nullptr);

/// Counts the triangles of a mesh that are beyond the limits. O(n).
[[nodiscard]] std::size_t count_beyond(const Mesh& mesh, const WorkingUnits& units,
                                       const std::shared_ptr<const GuardLimits>& limits, Executor* executor = nullptr);

}  // namespace temper

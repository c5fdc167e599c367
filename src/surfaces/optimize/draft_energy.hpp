// The energies of a draft, and their descent.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "base/descent.hpp"
#include "surfaces/optimize/accuracy.hpp"
#include "surfaces/optimize/closest_point.hpp"
#include "surfaces/optimize/draft.hpp"

namespace temper::surfaces {

/// The energy of a draft for Descent: the barriers of all triangles (barrier.hpp), or the energy of DraftAccuracy. A
/// vertex has three unknowns: two in its tangent plane, in units of its mean edge, and its weight, in units of the
/// square of that. A vertex of a line has one unknown along it in place of two.
class DraftEnergy {
 public:
  static constexpr std::size_t kUnknowns = 3;
  struct Value {
    double lowered = 0;
    std::vector<double> gradient;
  };

  /// Leaves out triangles whose normal is rounding, and holds their corners, in `draft` too.
  DraftEnergy(Draft& draft, double gamma);
  /// Holds the corners of triangles without a floor, too.
  DraftEnergy(Draft& draft, const AccuracyModel& model);

  [[nodiscard]] std::size_t n_elements() const { return draft_.triangles.size(); }
  [[nodiscard]] const std::array<VertexId, 3>& corners(std::size_t e) const { return draft_.triangles[e]; }
  /// The area along the first normal, over the first area; negative if the triangle folds over. With floors, at most
  /// the margin above the floor.
  [[nodiscard]] double room(std::size_t e) const;
  void place(const std::vector<double>& step, double part);
  [[nodiscard]] bool is_inside() const;
  [[nodiscard]] Value value() const;
  /// Steps begin where the points are now.
  void keep() { start_ = draft_.points; }

  /// Lowers the energy. `steps`: the most.
  void lower(int steps, const std::function<bool()>& must_stop);
  /// Takes moved vertices to the closest points of a surface, or of their lines, or back to where they were at first
  /// (go_back).
  void project(const ClosestPoints& surface, const TurnLimit& limit);

 private:
  /// Adds derivatives in a triangle to those by the unknowns.
  void add(std::size_t e, const CornerSlopes& slopes, std::vector<double>& gradient) const;
  [[nodiscard]] bool has_normal(std::size_t e) const { return normals_[e] != Vec3{}; }
  [[nodiscard]] Vec3 normal_of(std::size_t e, const IdVector<VertexId, WeightedPoint>& points) const {
    const auto& [a, b, c] = draft_.triangles[e];
    return surfaces::normal_of(points[a].position(), points[b].position(), points[c].position());
  }

  Draft& draft_;
  double gamma_;
  IdVector<VertexId, WeightedPoint> first_, start_;
  std::optional<DraftAccuracy> accuracy_;
  std::vector<Vec3> normals_;                         ///< Normals of the triangles at first, over their squares; or 0
  IdVector<VertexId, std::array<Vec3, 2>> tangents_;  ///< In units of the mean edge
  IdVector<VertexId, double> areas_;                  ///< Squares of the mean edges
};

}  // namespace temper::surfaces

// A surface, or a part of it, whose vertices move in their tangent planes and come back to the input surface.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/descent.hpp"
#include "surfaces/optimize/closest_point.hpp"
#include "surfaces/optimize/lines.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {

struct Draft {
  IdVector<VertexId, WeightedPoint> points;
  std::vector<std::array<VertexId, 3>> triangles;
  IdVector<VertexId, Track> tracks;         ///< Where a vertex may move
  IdVector<VertexId, std::uint8_t> weighs;  ///< Says whether its weight may change
  const Lines* lines = nullptr;             ///< For tracks that are lines
};

/// The direction of a; 0 if it has none.
[[nodiscard]] inline Vec3 unit(Vec3 a) { return squared_length(a) > 0 ? (1 / length(a)) * a : Vec3{}; }
[[nodiscard]] inline Vec3 normal_of(Vec3 a, Vec3 b, Vec3 c) { return cross(b - a, c - a); }

/// Twice the area over the square of the longest side: 0.87 for equilateral triangles.
[[nodiscard]] double width_of(const std::array<Vec3, 3>& triangle);
/// Widths below this are thin: a step makes no triangle thin, and no thin one thinner.
inline constexpr double kThin = 0.2;
[[nodiscard]] inline Vec3 normal_at(const SurfaceMesh& mesh, TriangleId t) {
  const auto [a, b, c] = mesh.points(t);
  return normal_of(a.position(), b.position(), c.position());
}
/// The angle by which the surface turns at an edge: between the normals of its triangles [degrees].
[[nodiscard]] double turn_deg(Vec3 normal, Vec3 other);

/// The largest turns that a step may make [degrees]. Without sharp turns of the input a surface cannot stay near it,
/// and bad triangles between them need others.
struct TurnLimit {
  double sharp = 180;     ///< At edges that do not turn more before the step
  double at_bad = 180;    ///< At the edges of triangles that are not well-centered before it
  double sharpest = 180;  ///< At edges that turn more than `sharp` before it
  [[nodiscard]] double at(double before, bool is_bad) const {
    return std::max({sharp, is_bad ? at_bad : 0, before > sharp ? sharpest : 0});
  }
};

/// Takes vertices back to their first places, until no triangle folds over or becomes thin, and no edge turns too much.
void go_back(Draft& draft, const IdVector<VertexId, WeightedPoint>& first, const TurnLimit& limit);

/// The sum of the energies of all triangles (barrier.hpp), as Descent needs it. A vertex has three unknowns: two in its
/// tangent plane, in units of its mean edge, and its weight, in units of the square of that. A vertex of a line has one
/// unknown along it in place of two.
class DraftEnergy {
 public:
  static constexpr std::size_t kUnknowns = 3;
  struct Value {
    double lowered = 0;
    std::vector<double> gradient;
  };

  DraftEnergy(Draft& draft, double gamma);

  [[nodiscard]] std::size_t n_elements() const { return draft_.triangles.size(); }
  [[nodiscard]] const std::array<VertexId, 3>& corners(std::size_t e) const { return draft_.triangles[e]; }
  /// The area along the first normal: a triangle that folds over has less than none.
  [[nodiscard]] double room(std::size_t e) const { return dot(normal_of(e, draft_.points), normals_[e]); }
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
  [[nodiscard]] Vec3 normal_of(std::size_t e, const IdVector<VertexId, WeightedPoint>& points) const {
    const auto& [a, b, c] = draft_.triangles[e];
    return surfaces::normal_of(points[a].position(), points[b].position(), points[c].position());
  }

  Draft& draft_;
  double gamma_;
  IdVector<VertexId, WeightedPoint> first_, start_;
  std::vector<Vec3> normals_;                         ///< Unit normals of the triangles at first
  IdVector<VertexId, std::array<Vec3, 2>> tangents_;  ///< In units of the mean edge
  IdVector<VertexId, double> areas_;                  ///< Square of that
};

}  // namespace temper::surfaces

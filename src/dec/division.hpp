// A triangle, divided among the vertices whose power cells meet it: the lower envelope of their power distances.
//
// Candidates are the corners of the triangle, then all neighbors of candidates that own some of it, until none is new.
// In a regular triangulation of a convex domain that is enough: if no neighbor beats a vertex at a point, no vertex
// does. A neighbor behind a reflex corner of the domain (more than half a turn in the fan of that corner) is left out.
// It lies behind a crack or a notch.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "dec/joint_polygons.hpp"
#include "temper/mesh.hpp"

namespace temper {

// A part of the mesh, seen as a plane near the origin. In the plane it is the part itself, moved, with the nearest
// images. On the sphere it is another plane next to the part. Rays from the center map places there and back, so that
// great circles are straight lines.

class Chart {
 public:
  Chart() = default;

  /// The plane of a triangle, from its corner 0. On the sphere it is the plane of the flat face PQR.
  [[nodiscard]] static Chart of_triangle(const Mesh& mesh, TriangleId t) {
    const auto [i, j, k] = mesh.corners(t);
    Chart chart(mesh, i);
    if (mesh.space().is_plane()) return chart;
    chart.weighted_origin_ = mesh.weighted_vector(i);
    const Vec3 along = mesh.weighted_vector(j) - mesh.weighted_vector(i);
    chart.turn(along, cross(along, mesh.weighted_vector(k) - mesh.weighted_vector(i)));
    return chart;
  }
  /// The plane around a vertex. On the sphere it touches there, and has the places less than a quarter turn away.
  [[nodiscard]] static Chart around(const Mesh& mesh, VertexId v) {
    Chart chart(mesh, v);
    if (mesh.space().is_plane()) return chart;
    const Vec3 p = mesh.weighted_vector(v);
    chart.weighted_origin_ = mesh.space().radius() / length(p) * p;
    const bool upright = std::abs(p.z) > 0.5 * length(p);
    chart.turn(cross(upright ? Vec3{1, 0, 0} : Vec3{0, 0, 1}, p), p);
    return chart;
  }

  /// A vertex as a weighted point of a triangle's plane: differences of power distances are the same as in the space.
  /// On the sphere x·P is greatest in the cell of P. Let P = O + e + n, n normal to the plane. Up to a term that all
  /// vertices share, −2 x·P is the power distance to e with the weight |e|² + 2 O·(P − O).
  [[nodiscard]] WeightedPoint of(const Mesh& mesh, VertexId v) const {
    if (mesh.space().is_plane()) {
      const Vec2 at = mesh.point(v, origin_).position() - origin_.position();
      return {at.x, at.y, mesh.weight(v)};
    }
    const Vec3 from_origin = mesh.weighted_vector(v) - weighted_origin_;
    const Vec2 at = {dot(e1_, from_origin), dot(e2_, from_origin)};
    return {at.x, at.y, squared_length(at) + 2 * dot(weighted_origin_, from_origin)};
  }

  /// A place of the sphere, in the plane around a vertex.
  [[nodiscard]] Vec2 of(Vec3 place) const {
    const double scale = squared_length(weighted_origin_) / dot(weighted_origin_, place);
    return {scale * dot(e1_, place), scale * dot(e2_, place)};
  }
  /// The ray of a place in the plane, not scaled to the radius.
  [[nodiscard]] Vec3 ray(Vec2 at) const { return weighted_origin_ + at.x * e1_ + at.y * e2_; }
  /// A place of another plane in this one, around a vertex.
  [[nodiscard]] Vec2 moved(const Chart& from, Vec2 at) const {
    if (!space_.is_plane()) return of(from.ray(at));
    return at + (space_.image(from.origin_, origin_).position() - origin_.position());
  }
  /// Says whether a place of another plane is in this one: with room, since places go to infinity at a quarter turn.
  [[nodiscard]] bool has(const Chart& from, Vec2 at) const {
    constexpr double kLeastCosine = 0.02;
    if (space_.is_plane()) return true;
    const Vec3 x = from.ray(at);
    return dot(weighted_origin_, x) > kLeastCosine * length(weighted_origin_) * length(x);
  }

 private:
  Chart(const Mesh& mesh, VertexId v) : space_(mesh.space()) {
    if (space_.is_plane()) origin_ = mesh.point(v);
  }
  void turn(Vec3 along, Vec3 normal) {
    e1_ = (1 / length(along)) * along;
    const Vec3 e2 = cross(normal, e1_);
    e2_ = (1 / length(e2)) * e2;
  }

  Space space_;
  WeightedPoint origin_;
  Vec3 weighted_origin_, e1_, e2_;
};

/// A corner of a piece, and one of two things along the side from it to the next corner.
struct PieceCorner {
  Vec2 at;           ///< in the plane of the triangle, from its corner 0
  VertexId against;  ///< the side is where the power distances to this vertex and to the owner are equal
  HalfedgeId along;  ///< the side is on this side of the triangle
};

/// The piece of a triangle, or of a polygon of triangles with one orthocenter, that a vertex owns: convex,
/// counter-clockwise.
struct CellPiece {
  VertexId owner;
  TriangleId triangle;  ///< of a polygon the largest one
  std::vector<PieceCorner> corners;
  double moved = 0;  ///< the farthest that a corner was moved onto the orthocenter of a polygon of triangles
};

/// The signed area of a polygon; `at` gives the place of a corner.
template <class Corner, class At>
[[nodiscard]] double area_of(const std::vector<Corner>& polygon, At&& at) {
  double doubled = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    doubled += cross(at(polygon[i - 1]) - at(polygon[0]), at(polygon[i]) - at(polygon[0]));
  }
  return 0.5 * doubled;
}
[[nodiscard]] inline double area_of(const std::vector<PieceCorner>& polygon) {
  return area_of(polygon, [](const PieceCorner& corner) { return corner.at; });
}

class TriangleDivider {
 public:
  TriangleDivider(const Mesh& mesh, const JointPolygons& joints) : mesh_(mesh), joints_(joints) {}
  /// The pieces of t, in the order in which their owners were found: its corners first. If t is part of a polygon with
  /// one orthocenter, those of the whole polygon.
  [[nodiscard]] std::vector<CellPiece> divide(TriangleId t);

 private:
  struct Candidate {
    VertexId vertex;
    Vec2 at;  // in the plane of the triangle
    double weight = 0;
    std::vector<PieceCorner> piece;
  };
  void add(VertexId v);
  [[nodiscard]] bool wins_anywhere(const Candidate& added, std::size_t others) const;
  void expand(std::size_t i);
  void clip(std::vector<PieceCorner>& piece, const Candidate& owner, const Candidate& other);
  void move_onto_orthocenter(CellPiece& piece) const;

  const Mesh& mesh_;
  const JointPolygons& joints_;
  std::vector<Candidate> candidates_;  // of the triangle at hand; storage is kept for the next
  std::size_t n_candidates_ = 0;
  std::vector<PieceCorner> whole_;  // the triangle
  std::vector<PieceCorner> scratch_;
  std::vector<double> sides_;  // of the corners of the polygon being clipped
  Chart chart_;
};

/// A simple polygon, counter-clockwise, in some chart.
using LocalPolygon = std::vector<Vec2>;
[[nodiscard]] inline double area_of(const LocalPolygon& polygon) {
  return area_of(polygon, [](Vec2 corner) { return corner; });
}

/// The union of pieces of one owner, in a chart that has them all. Pieces that meet along a side of a triangle become
/// one polygon. If this does not give simple polygons of the same area (a cell with a hole in it), the pieces stay as
/// they are.
[[nodiscard]] std::vector<LocalPolygon> join_pieces(const Mesh& mesh, const Chart& chart,
                                                    std::span<const CellPiece> pieces);

}  // namespace temper

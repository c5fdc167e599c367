#include "errors/surface_means.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "temper/surfaces.hpp"

namespace temper::error_detail {
namespace {

constexpr double kMostPiecesOfTriangle = 32;  // of a side; bounds the time at flat triangles
// Steps of differences in the frame: fields are waves of at most three radians, so errors are below 1e-10.
constexpr double kStep = 1e-3;
// As for fluxes: below this share of the edge, a dual edge has no length.
constexpr double kNoLength = 1e-10;

Vec3 gradient(const Field& field, Vec3 p) { return field.at(p).gradient; }

/// The mean of u over a triangle, by Gauss's rule in two directions.
double mean_over_triangle(const Field& field, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  const auto pieces = static_cast<int>(std::clamp(std::ceil(longest / kPiece), 1.0, kMostPiecesOfTriangle));
  const std::vector<GaussNode> nodes = gauss_nodes(pieces);
  double mean = 0;
  for (const GaussNode& i : nodes) {
    for (const GaussNode& j : nodes)
      mean += 2 * i.at * i.weight * j.weight * field.at(a + i.at * ((1 - j.at) * (b - a) + j.at * (c - a))).u;
  }
  return mean;
}

/// The second derivative along a unit vector.
double second_derivative(const Field& field, Vec3 p, Vec3 n) {
  const auto slope = [&](double step) {
    return dot(n, gradient(field, p + step * n) - gradient(field, p - step * n)) / (2 * step);
  };
  return (4 * slope(kStep) - slope(2 * kStep)) / 3;
}

/// An edge in one of its triangles, in the frame.
struct EdgeInTriangle {
  TriangleId triangle;
  double height;
  Vec3 from, to, middle, center;
  Vec3 along, left, normal;  ///< unit vectors; left: as seen by the whole surface, unfolded
  double at_from, at_to;     ///< lengths from the ends to the middle, with signs

  /// The mean gradient over a segment in the plane of the triangle: along the edge, and to its left.
  [[nodiscard]] Vec2 mean(const Field& field, Vec3 a, Vec3 b) const {
    Vec2 mean;
    along_segment({0, 0}, {length(b - a), 0}, [&](Vec2 at, double weight) {
      const double part = length(b - a) > 0 ? at.x / length(b - a) : 0;
      const Vec3 g = gradient(field, a + part * (b - a));
      mean = mean + weight * Vec2{dot(along, g), dot(left, g)};
    });
    return mean;
  }
};

/// Calls use(side) for the triangles at an edge: the right one, then the left one.
template <class Use>
void for_each_side(const Setting& s, EdgeId e, const Use& use) {
  const DecEdge& edge = s.dec.edges[e];
  const Vec3 from = s.vertex(edge.from), to = s.vertex(edge.to), middle = s.midpoint(e);
  const Vec3 along = Setting::unit(to - from);
  for (const auto& [t, height] : {std::pair(edge.right, edge.right_height), std::pair(edge.left, edge.left_height)}) {
    if (!t.valid()) continue;
    const auto [a, b, c] = s.surface->points(t);
    const Vec3 normal = Setting::unit(cross(b.position() - a.position(), c.position() - a.position()));
    use(EdgeInTriangle{t, s.length_in_frame(height), from, to, middle, s.orthocenter(t), along, cross(normal, along),
                       normal, s.length_in_frame(edge.crossing), s.length_in_frame(edge.length - edge.crossing)});
  }
}

/// Calls use(side, vertex, place of it, its signed distance to the middle) for the four parts of dual cells at an edge.
template <class Use>
void for_each_part(const Setting& s, EdgeId e, const Use& use) {
  const DecEdge& edge = s.dec.edges[e];
  for_each_side(s, e, [&](const EdgeInTriangle& side) {
    use(side, edge.from, side.from, side.at_from);
    use(side, edge.to, side.to, side.at_to);
  });
}

}  // namespace

EdgeMeans means_on_surface(const Setting& s, const Field& field, EdgeId e) {
  const DecEdge& edge = s.dec.edges[e];
  const double dual = s.length_in_frame(edge.dual_length);
  const bool has_length = std::abs(edge.dual_length) > kNoLength * edge.length;
  EdgeMeans means;
  for_each_side(s, e, [&](const EdgeInTriangle& side) {
    const double share = edge.is_boundary() ? 1 : has_length ? side.height / dual : 0.5;
    means.gradient = means.gradient + share * side.mean(field, side.from, side.to);
    const Vec3 first = has_length ? side.middle : side.center;
    means.dual_gradient = means.dual_gradient + share * side.mean(field, first, side.center);
  });
  return means;
}

std::vector<double> dual_cell_integrals_on_surface(const Setting& s, const Field& field) {
  std::vector<double> integrals(s.mesh.n_vertices(), 0.0);
  for (std::size_t i = 0; i < s.dec.edges.size(); ++i) {
    for_each_part(s, EdgeId(i), [&](const EdgeInTriangle& side, VertexId v, Vec3 p, double d) {
      integrals[v.index] += 0.5 * d * side.height * mean_over_triangle(field, {p, side.middle, side.center});
    });
  }
  return integrals;
}

std::vector<double> triangle_integrals_on_surface(const Setting& s, const Field& field) {
  std::vector<double> integrals;
  for (const TriangleId t : s.mesh.triangles()) {
    const auto [a, b, c] = s.mesh.corners(t);
    integrals.push_back(s.area_in_frame(s.dec.areas[t]) *
                        mean_over_triangle(field, {s.vertex(a), s.vertex(b), s.vertex(c)}));
  }
  return integrals;
}

std::vector<double> laplacians_on_surface(const Setting& s, const Field& field) {
  std::vector<double> integrals(s.mesh.n_vertices(), 0.0);
  for (std::size_t i = 0; i < s.dec.edges.size(); ++i) {
    const bool is_boundary = s.dec.edges[EdgeId(i)].is_boundary();
    for_each_part(s, EdgeId(i), [&](const EdgeInTriangle& side, VertexId v, Vec3 p, double d) {
      const double laplacian = field.at(p).laplacian - second_derivative(field, p, side.normal);
      integrals[v.index] += 0.5 * d * side.height * laplacian;
      // The outflow of the triangle adds to −Δu, so its inflow adds here.
      const double inwards = side.triangle == s.dec.edges[EdgeId(i)].left ? 1 : -1;
      if (!is_boundary) integrals[v.index] += d * inwards * side.mean(field, p, side.middle).y;
    });
  }
  return integrals;
}

}  // namespace temper::error_detail

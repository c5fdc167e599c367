#include "errors/adjoint.hpp"

#include <utility>

namespace temper::error_detail {
namespace {

using Gradient = IdVector<VertexId, WeightedPoint>;

void add_place(Gradient& gradient, VertexId v, Vec2 by) {
  gradient[v].x += by.x;
  gradient[v].y += by.y;
}

/// The derivatives by length, crossing and the two heights of an edge.
struct EdgeAdjoint {
  double length = 0, crossing = 0, left = 0, right = 0;
};

/// ★0 of the ends is d D/2 and (ℓ − d) D/2 with D = h_left + h_right. ★1 is P/ℓ with P = Σ K h, the flux ℓ/S with
/// S = Σ h/K.
EdgeAdjoint of_operators(const DecComplex& dec, const Adjoint& of, EdgeId e) {
  const DecEdge& edge = dec.edges[e];
  const double star1 = of.star1[e], flux = of.transmissibility[e], from = of.star0[edge.from], to = of.star0[edge.to];
  const double l = edge.length, d = edge.crossing, dual = edge.dual_length;
  const auto k_of = [&](TriangleId t) { return dec.coefficient.empty() || !t.valid() ? 1 : dec.coefficient[t]; };
  const double left = k_of(edge.left), right = k_of(edge.right);
  const bool plain = dec.coefficient.empty();
  const double parallel = plain ? dual : left * edge.left_height + right * edge.right_height;
  const double series = plain ? dual : edge.left_height / left + edge.right_height / right;
  EdgeAdjoint by;
  by.length = -star1 * parallel / (l * l) + 0.5 * dual * to;
  by.crossing = 0.5 * dual * (from - to);
  if (flux != 0) by.length += flux / series;
  const auto by_height = [&](TriangleId t, double k) {
    if (!t.valid()) return 0.0;
    const double by_dual = star1 * k / l + 0.5 * (d * from + (l - d) * to);
    return flux != 0 ? by_dual - flux * l / (series * series * k) : by_dual;
  };
  by.left = by_height(edge.left, left);
  by.right = by_height(edge.right, right);
  return by;
}

/// Derivatives on their way to the vertices.
struct PullBack {
  const Mesh& mesh;
  const DecComplex& dec;
  IdVector<TriangleId, Vec2> orthocenter;
  Gradient gradient = Gradient(mesh.n_vertices(), WeightedPoint{});

  void edge(const DecEdge& edge, EdgeAdjoint by);
  void triangle(TriangleId t, double by_area);
};

/// From an edge to its ends, and to the orthocenters on its sides.
void PullBack::edge(const DecEdge& edge, EdgeAdjoint by) {
  const Vec2 from = mesh.position(edge.from), e = mesh.position(edge.to) - from;
  const double l = edge.length;
  Vec2 by_e, by_from;
  const auto height = [&](TriangleId t, double h, double by_h, double side) {
    if (!t.valid()) return;
    by.length -= by_h * h / l;
    const double by_cross = side * by_h / l;  // of e × c
    const Vec2 c = dec.orthocenters[t] - from, by_c = by_cross * Vec2{-e.y, e.x};
    by_e = by_e + by_cross * Vec2{c.y, -c.x};
    orthocenter[t] = orthocenter[t] + by_c;
    by_from = by_from - by_c;
  };
  height(edge.left, edge.left_height, by.left, 1);
  height(edge.right, edge.right_height, by.right, -1);
  const double weights = by.crossing / (2 * l);
  gradient[edge.from].w += weights;
  gradient[edge.to].w -= weights;
  by.length += by.crossing * (1 - edge.crossing / l);  // d = (ℓ² + w_i − w_j)/(2ℓ)
  by_e = by_e + (by.length / l) * e;
  add_place(gradient, edge.to, by_e);
  add_place(gradient, edge.from, by_from - by_e);
}

/// From the orthocenter of a triangle, and its area, to its corners.
void PullBack::triangle(TriangleId t, double by_area) {
  const Vec2 by_orthocenter = orthocenter[t];
  const auto [i, j, k] = mesh.corners(t);
  const Vec2 p = mesh.position(i), e = mesh.position(j) - p, f = mesh.position(k) - p;
  const Vec2 c = dec.orthocenters[t] - p;
  const double twice_area = cross(e, f);
  // λ_1 e + λ_2 f = the derivative by c.
  const double first = cross(by_orthocenter, f) / twice_area, second = cross(e, by_orthocenter) / twice_area;
  const Vec2 by_e = first * (e - c) + 0.5 * by_area * Vec2{f.y, -f.x};
  const Vec2 by_f = second * (f - c) + 0.5 * by_area * Vec2{-e.y, e.x};
  gradient[i].w += 0.5 * (first + second);
  gradient[j].w -= 0.5 * first;
  gradient[k].w -= 0.5 * second;
  add_place(gradient, j, by_e);
  add_place(gradient, k, by_f);
  add_place(gradient, i, by_orthocenter - by_e - by_f);
}

}  // namespace

Adjoint::Adjoint(const Mesh& mesh, const DecComplex& dec)
    : VertexAdjoint(mesh.n_vertices(), dec.edges.size()),
      transmissibility(dec.edges.size(), 0.0),
      crossing(dec.edges.size(), 0.0),
      orthocenter(mesh.n_triangles(), Vec2{}),
      area(mesh.n_triangles(), 0.0) {}

void Adjoint::add(const Adjoint& other) {
  VertexAdjoint::add(other);
  add_all(transmissibility, other.transmissibility);
  add_all(crossing, other.crossing);
  add_all(orthocenter, other.orthocenter);
  add_all(area, other.area);
}

void Adjoint::add_star1(const DecComplex& dec, const std::vector<double>& v, const std::vector<double>& lambda) {
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    const std::size_t i = dec.edges[EdgeId(e)].from.index, j = dec.edges[EdgeId(e)].to.index;
    star1[EdgeId(e)] -= (lambda[i] - lambda[j]) * (v[i] - v[j]);
  }
}

void Adjoint::add_flux(const DecComplex& dec, const std::vector<double>& v, const std::vector<double>& lambda) {
  for (std::size_t e = 0; e < dec.edges.size(); ++e) {
    if (dec.edges[EdgeId(e)].is_boundary()) continue;
    const std::size_t k = dec.edges[EdgeId(e)].left.index, l = dec.edges[EdgeId(e)].right.index;
    transmissibility[EdgeId(e)] -= (lambda[k] - lambda[l]) * (v[k] - v[l]);
  }
}

Gradient pulled_back(const Mesh& mesh, const DecComplex& dec, const Adjoint& by) {
  PullBack back = {mesh, dec, by.orthocenter};
  for (const VertexId v : mesh.vertices()) add_place(back.gradient, v, by.vertex[v]);
  for (std::size_t i = 0; i < dec.edges.size(); ++i) {
    const EdgeId e(i);
    EdgeAdjoint of_edge = of_operators(dec, by, e);
    of_edge.crossing += by.crossing[e];
    back.edge(dec.edges[e], of_edge);
  }
  for (const TriangleId t : mesh.triangles()) back.triangle(t, by.area[t]);
  return std::move(back.gradient);
}

}  // namespace temper::error_detail

#include "experiments/hodge_error.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "experiments/domain.hpp"
#include "experiments/numbers.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/generate.hpp"
#include "temper/regularity.hpp"

namespace temper::gallery {
namespace {

constexpr double kAlpha[] = {1.0 / 4, 1.0 / 3, 1.0 / 12}, kBeta[] = {1.0 / 12, 1.0 / 3, 1.0 / 4};

using Density = std::function<double(Vec2)>;

/// A set with a uniform measure on it: a point, a segment or a polygon with a vertex inside, as nodes and their parts.
struct Measure {
  double size = 1;
  std::vector<Vec2> nodes;
  std::vector<double> parts;  ///< sum: 1
  [[nodiscard]] double mean(const Density& g) const {
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) sum += parts[i] * g(nodes[i]);
    return sum;
  }
};

Measure point(Vec2 p) { return {1, {p}, {1}}; }

/// Gauss's rule with four nodes: exact for polynomials of degree 7.
Measure segment(Vec2 a, Vec2 b) {
  constexpr double kNode[] = {0.8611363115940526, 0.3399810435848563},
                   kPart[] = {0.3478548451374538, 0.6521451548625461};
  Measure m{length(b - a), {}, {}};
  for (std::size_t i = 0; i < 2; ++i) {
    for (const double side : {-1.0, 1.0}) {
      m.nodes.push_back(a + ((1 + side * kNode[i]) / 2) * (b - a));
      m.parts.push_back(kPart[i] / 2);
    }
  }
  return m;
}

/// Triangles center–corner–corner, each cut in sixteen, with the rule of edge midpoints: exact for degree 2.
Measure star_shaped(Vec2 center, const std::vector<Vec2>& corners) {
  constexpr int kCuts = 4;
  Measure m{0, {}, {}};
  std::vector<double> sizes;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 u = corners[i] - center, v = corners[(i + 1) % corners.size()] - center;
    const double area = cross(u, v) / 2;
    m.size += area;
    const auto at = [&](double s, double t) { return center + (s / kCuts) * u + (t / kCuts) * v; };
    const auto add = [&](Vec2 a, Vec2 b, Vec2 c) {
      for (const Vec2 node : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {
        m.nodes.push_back(node);
        sizes.push_back(area / (3 * kCuts * kCuts));
      }
    };
    for (int s = 0; s < kCuts; ++s) {
      for (int t = 0; s + t < kCuts; ++t) {
        add(at(s, t), at(s + 1, t), at(s, t + 1));
        if (s + t + 1 < kCuts) add(at(s + 1, t), at(s + 1, t + 1), at(s, t + 1));
      }
    }
  }
  for (const double size : sizes) m.parts.push_back(size / m.size);
  return m;
}

/// A simplex inside the mesh, its dual, and what eq. 2 says of the two.
struct Pair {
  Measure primal, dual;
  double energy = 0;
  Vec2 direction;  ///< of an edge
};

double half(int star, double d, double h) {
  const auto s = static_cast<std::size_t>(star);
  return kAlpha[s] * d * d * d * h + kBeta[s] * d * h * h * h;
}

/// Both half-edges of the edge of h in its triangle.
std::array<double, 2> halves(const Mesh& mesh, HalfedgeId e, int star) {
  const WeightedPoint p = mesh.point(mesh.origin(e)), q = mesh.point(mesh.target(e));
  const double h = signed_height(p, q, mesh.point(mesh.opposite(e)));
  return {half(star, dual_crossing(p, q), h), half(star, dual_crossing(q, p), h)};
}

std::vector<Pair> vertices_and_cells(const Mesh& mesh) {
  std::vector<Pair> pairs;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_boundary(v)) continue;
    Pair pair;
    std::vector<Vec2> cell;
    for (const HalfedgeId spoke : mesh.star(v)) {
      cell.push_back(orthocenter_of(mesh, Mesh::triangle(spoke)));
      pair.energy += halves(mesh, spoke, 0)[0] + halves(mesh, Mesh::next(Mesh::next(spoke)), 0)[1];
    }
    if (cross(cell[1] - cell[0], cell[2] - cell[1]) < 0) std::ranges::reverse(cell);
    pair.primal = point(mesh.position(v));
    Vec2 center;
    for (const Vec2 c : cell) center = center + (1.0 / static_cast<double>(cell.size())) * c;
    pair.dual = star_shaped(center, cell);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<Pair> edges_and_duals(const Mesh& mesh) {
  std::vector<Pair> pairs;
  for (const HalfedgeId e : mesh.halfedges()) {
    if (mesh.is_boundary(e) || mesh.twin(e) < e) continue;
    const Vec2 a = mesh.position(mesh.origin(e)), b = mesh.position(mesh.target(e));
    Pair pair{segment(a, b),
              segment(orthocenter_of(mesh, Mesh::triangle(e)), orthocenter_of(mesh, Mesh::triangle(mesh.twin(e)))), 0,
              (1 / length(b - a)) * (b - a)};
    for (const HalfedgeId side : {e, mesh.twin(e)}) {
      for (const double energy : halves(mesh, side, 1)) pair.energy += energy;
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<Pair> triangles_and_centers(const Mesh& mesh) {
  std::vector<Pair> pairs;
  for (const TriangleId t : mesh.triangles()) {
    const auto [a, b, c] = mesh.corners(t);
    const std::vector<Vec2> corners = {mesh.position(a), mesh.position(b), mesh.position(c)};
    Pair pair{star_shaped((1.0 / 3) * (corners[0] + corners[1] + corners[2]), corners),
              point(orthocenter_of(mesh, t)),
              0,
              {}};
    for (int k = 0; k < 3; ++k) {
      for (const double energy : halves(mesh, Mesh::halfedge(t, k), 2)) pair.energy += energy;
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<Pair> pairs_of(const Mesh& mesh, int star) {
  return star == 0 ? vertices_and_cells(mesh) : star == 1 ? edges_and_duals(mesh) : triangles_and_centers(mesh);
}

/// |*σ| |σ| times the cost of moving one measure to the other, each part of the one to all of the other.
double independent_cost(const Pair& pair) {
  double cost = 0;
  for (std::size_t i = 0; i < pair.primal.nodes.size(); ++i) {
    for (std::size_t j = 0; j < pair.dual.nodes.size(); ++j) {
      cost += pair.primal.parts[i] * pair.dual.parts[j] * squared_length(pair.primal.nodes[i] - pair.dual.nodes[j]);
    }
  }
  return pair.primal.size * pair.dual.size * cost;
}

/// The same, node by node: nodes of segments pair up in their order, or one of them turned around.
double monotone_cost(const Pair& pair, bool turned) {
  double cost = 0;
  for (std::size_t i = 0; i < pair.primal.nodes.size(); ++i) {
    const std::size_t j = turned ? i ^ 1U : i;  // nodes at −x and x follow each other
    cost += pair.primal.parts[i] * squared_length(pair.primal.nodes[i] - pair.dual.nodes[j]);
  }
  return pair.primal.size * pair.dual.size * cost;
}

}  // namespace

std::vector<Mesh> weighted_meshes(Effort effort) {
  constexpr double kWeight = 0.1;  // of the square of the mean edge
  const std::size_t vertices = effort == Effort::full ? 400 : 80;
  std::vector<Mesh> meshes;
  for (auto& made :
       {random_mesh({.vertices = vertices}), annulus({.around = 36, .rings = 5}), sheared_grid({12, 12, 0.4})}) {
    if (!made) continue;
    Mesh mesh = *made;
    double squares = 0, edges = 0;
    for (const HalfedgeId h : mesh.halfedges()) {
      squares += squared_length(mesh.position(mesh.target(h)) - mesh.position(mesh.origin(h)));
      edges += 1;
    }
    Random random(7);
    for (const VertexId v : mesh.vertices()) mesh.set_weight(v, random(-kWeight, kWeight) * squares / edges);
    restore_regularity(mesh, HiddenPolicy::remove);
    mesh.compact();
    if (count_non_regular_edges(mesh) == 0) meshes.push_back(std::move(mesh));
  }
  return meshes;
}

StarComparison compare_definition(const std::vector<Mesh>& meshes, int star) {
  StarComparison result;
  for (const Mesh& mesh : meshes) {
    const std::vector<Pair> pairs = pairs_of(mesh, star);
    double mean = 0;
    for (const Pair& pair : pairs) mean += pair.energy / static_cast<double>(pairs.size());
    for (const Pair& pair : pairs) {
      const double cost = independent_cost(pair), scale = pair.energy + 1e-6 * mean;
      ++result.simplices;
      result.worst = std::max(result.worst, std::abs(cost - pair.energy) / scale);
      if (star != 1) continue;
      for (const bool turned : {false, true}) {
        result.coupling = std::max(result.coupling, std::abs(monotone_cost(pair, turned) - cost) / scale);
      }
    }
  }
  return result;
}

ErrorBound error_over_bound(const std::vector<Mesh>& meshes, int star, std::size_t densities) {
  constexpr double kLongest = 2, kShortest = 0.3;  // waves, where edges are about 0.1
  ErrorBound bound{0, 0, 1e300};
  Random random(8);
  for (const Mesh& mesh : meshes) {
    const std::vector<Pair> pairs = pairs_of(mesh, star);
    double energy = 0;
    for (const Pair& pair : pairs) energy += pair.energy;
    for (std::size_t n = 0; n < densities; ++n) {
      const double frequency = 2 * std::numbers::pi / random(kShortest, kLongest), phase = random(0, 6.3);
      const double turn = random(0, 6.3), other = random(0, 6.3);
      const Vec2 wave = frequency * Vec2{std::cos(turn), std::sin(turn)}, form = {std::cos(other), std::sin(other)};
      const Density g = [=](Vec2 p) { return std::sin(dot(wave, p) + phase) / frequency; };
      double error = 0;
      for (const Pair& pair : pairs) {
        const double along = star == 1 ? dot(form, pair.direction) : 1;  // what of a 1-form an edge sees
        const double differ = along * (pair.primal.mean(g) - pair.dual.mean(g));
        error += pair.primal.size * pair.dual.size * differ * differ;
      }
      ++bound.cases;
      bound.worst = std::max(bound.worst, error / energy);
      bound.least = std::min(bound.least, error / energy);
    }
  }
  return bound;
}

}  // namespace temper::gallery

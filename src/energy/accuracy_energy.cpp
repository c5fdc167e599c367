#include "energy/accuracy_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/sum.hpp"
#include "geometry/predicates_inline.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/blocks.hpp"

namespace temper {
namespace {

constexpr double kOutside = std::numeric_limits<double>::infinity();
// What a triangle with less than ε keeps at least, of what it has: the barrier must be finite where it is.
constexpr double kKept = 0.9;
// Below this part of ℓ a height is mostly rounding, and so would be its logarithm.
constexpr double kLeastMargin = 1e-9;

double squared(double x) { return x * x; }

/// s_e⁻².
double edge_scale(double s, double t) { return 4 / squared(s + t); }

/// s_t².
double triangle_scale(double s, double t, double u) { return squared(s + t + u) / 9; }

/// (d_ij/ℓ − ε)(d_ji/ℓ − ε), y = δw/ℓ²; both are positive where this is, for an ε below ½ and |y| < 1.
double split_room(double y, double floor) { return squared(0.5 - floor) - 0.25 * y * y; }

/// Of a halfedge whose edge it stands for, and which is `inner` in its triangle.
double edge_energy(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, HalfedgeId h,
                   const EdgeShape& inner) {
  const VertexId a = mesh.origin(h), b = mesh.target(h);
  const HalfedgeId twin = mesh.twin(h);
  const double outer =
      twin.valid() ? triangle_shape(mesh.point(b), mesh.point(a), mesh.point(mesh.opposite(twin))).edges[0].g : 0;
  const AccuracyEdge edge{inner.l2, 1 / inner.l2, inner.g + outer, inner.g - outer, inner.dw * inner.dw};
  return edge_scale(sizes[a], sizes[b]) * edge_value(twin.valid() ? model.inner : model.boundary, edge);
}

/// Its sign and factor μ s_t² apart: the sum of logarithms is one of a product.
double triangle_logarithm(const TriangleShape& shape, double floor) {
  double heights = 1, splits = 1;
  for (const EdgeShape& e : shape.edges) {
    const double inverse_l2 = 1 / e.l2;
    heights *= e.g * inverse_l2 - floor;
    splits *= split_room(e.dw * inverse_l2, floor);
  }
  return 0.5 * portable_log(heights * heights * splits);
}

TriangleShape shape_of(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.corners(t);
  return triangle_shape(mesh.point(p), mesh.point(q), mesh.point(r));
}

/// Calls visit with the energy of each edge that a halfedge of t stands for.
template <class Visit>
void for_own_edges(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, TriangleId t,
                   const TriangleShape& shape, Visit&& visit) {
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId h = Mesh::halfedge(t, k);
    if (mesh.is_edge_representative(h)) {
      visit(edge_energy(mesh, sizes, model, h, shape.edges[static_cast<std::size_t>(k)]));
    }
  }
}

void add_outer_product(VertexDerivatives& sum, const std::array<double, 3>& u, const std::array<double, 3>& v) {
  std::size_t entry = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) sum.hessian[entry++] += u[i] * v[j];
  }
}

void add_gradient(VertexDerivatives& sum, double slope, const std::array<double, 3>& of) {
  for (std::size_t i = 0; i < 3; ++i) sum.gradient[i] += slope * of[i];
}

/// A triangle's part of the barrier at one of its edges.
struct EdgeBarrier {
  double factor, floor;  ///< m = μ s_t², ε
};

/// Of − m ln(g/L − ε), from the derivatives in g on one side and in L.
void add_height_barrier(EdgeSlopes& s, bool left, EdgeBarrier of, double l2, double inverse_l2, double g) {
  const auto [m, floor] = of;
  const double room = 1 / (g - floor * l2), by_g = -m * room, by_gg = m * room * room;
  (left ? s.left : s.right) += by_g;
  (left ? s.left_left : s.right_right) += by_gg;
  (left ? s.l_left : s.l_right) -= floor * by_gg;
  s.l += m * inverse_l2 - floor * by_g;
  s.l_l += floor * floor * by_gg - m * inverse_l2 * inverse_l2;
}

/// Of − ½ m ln((½ − ε)² − δw²/4L²), with Q = (½ − ε)² L² − δw²/4.
void add_split_barrier(EdgeSlopes& s, EdgeBarrier of, double l2, double inverse_l2, double dw) {
  const auto [m, floor] = of;
  const double k = squared(0.5 - floor), inverse_q = 1 / (k * l2 * l2 - 0.25 * dw * dw);
  const double m_q = m * inverse_q, m_qq = m_q * inverse_q;
  s.l += m * inverse_l2 - m_q * k * l2;
  s.dw += 0.25 * m_q * dw;
  s.l_l += 2 * m_qq * squared(k * l2) - m_q * k - m * inverse_l2 * inverse_l2;
  s.l_dw -= 0.5 * m_qq * k * l2 * dw;
  s.dw_dw += 0.25 * m_q + 0.125 * m_qq * dw * dw;
}

}  // namespace

AccuracyModel AccuracyModel::of(double alpha, double beta, double offset, double boundary_offset) {
  const double split = 0.75 * offset * alpha;
  AccuracyModel model;
  model.inner = {0.25 * alpha, 0.25 * beta, split, 0.75 * offset * beta};
  model.boundary = {0.25 * alpha, 0.25 * beta, split, 0.75 * boundary_offset * beta};
  return model;
}

double accuracy_energy(const Mesh& mesh, const VertexSizes& sizes, const AccuracyModel& model, Executor* executor) {
  return blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    double sum = 0;
    for_own_edges(mesh, sizes, model, t, shape_of(mesh, t), [&](double energy) { sum += std::abs(energy); });
    return sum;
  });
}

double triangle_margin(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) {
  const TriangleShape shape = triangle_shape(p, q, r);
  double least = shape.doubled_area > 0 ? kOutside : -kOutside;
  for (const EdgeShape& e : shape.edges) least = std::min({least, e.g / e.l2, 0.5 * (1 - std::abs(e.dw) / e.l2)});
  return least;
}

double triangle_margin(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.corners(t);
  return triangle_margin(mesh.point(p), mesh.point(q), mesh.point(r));
}

bool has_margins(const Mesh& mesh, double margin, Executor* executor) {
  return !first_index(mesh.n_triangles(), executor, [&](std::size_t i) {
    const auto [p, q, r] = mesh.corners(TriangleId(i));
    return !(triangle_margin(mesh, TriangleId(i)) > margin) ||
           !inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r));
  });
}

std::size_t AccuracyFloors::raise(const Mesh& mesh, double margin, Executor* executor) {
  const bool first = floor_.empty();
  if (first) floor_.resize(mesh.n_triangles(), 0.0);
  const auto raised = [&](TriangleId t) {
    if (first) {
      const auto [p, q, r] = mesh.corners(t);
      if (!inlined::is_well_centered(mesh.point(p), mesh.point(q), mesh.point(r))) return 0.0;
    } else if (!has(t) || floor_[t] == margin) {
      return floor_[t];
    }
    const double now = triangle_margin(mesh, t);
    if (first && now < kLeastMargin) return 0.0;
    return now > margin ? margin : std::max(floor_[t], kKept * now);
  };
  return static_cast<std::size_t>(blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    const double before = std::exchange(floor_[t], raised(t));
    return floor_[t] > before ? 1.0 : 0.0;
  }));
}

AccuracyTotal accuracy_total(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                             const AccuracyModel& model, Executor* executor) {
  std::vector<double> barriers((mesh.n_triangles() + kBlockSize - 1) / kBlockSize, 0.0);
  const double energy = sum_of_blocks(mesh.n_triangles(), executor, [&](std::size_t block) {
    double sum = 0, barrier = 0;
    const std::size_t end = std::min(mesh.n_triangles(), (block + 1) * kBlockSize);
    for (std::size_t i = block * kBlockSize; i < end; ++i) {
      const TriangleId t(i);
      const TriangleShape shape = shape_of(mesh, t);
      for_own_edges(mesh, sizes, model, t, shape, [&](double of_edge) { sum += of_edge; });
      if (!floors.has(t)) continue;
      const auto [p, q, r] = mesh.corners(t);
      barrier -= triangle_scale(sizes[p], sizes[q], sizes[r]) * triangle_logarithm(shape, floors[t]);
    }
    barriers[block] = model.barrier * barrier;
    return sum;
  });
  return {energy, pairwise_sum(barriers)};
}

bool AccuracyPatch::gather(const Mesh& mesh, const VertexSizes& sizes, const AccuracyFloors& floors,
                           const AccuracyModel& model, VertexId v) {
  model_ = &model;
  closed_ = !mesh.is_boundary(v);
  arms_.clear();
  wedges_.clear();
  const double own = sizes[v];
  const auto add_arm_to = [&](VertexId u) {
    Arm& arm = arms_.emplace_back();
    arm.q = mesh.point(u);
    arm.scale = edge_scale(own, sizes[u]);
  };
  VertexId last;
  for (const HalfedgeId h : mesh.star(v)) {
    const TriangleId t = Mesh::triangle(h);
    const HalfedgeId link = Mesh::next(h), across = mesh.twin(link);
    if (!floors.has(t) || (across.valid() && !floors.has(Mesh::triangle(across)))) return false;
    const VertexId a = mesh.target(h), b = last = mesh.opposite(h);
    const WeightedPoint q = mesh.point(a), r = mesh.point(b);
    add_arm_to(a);
    Wedge& wedge = wedges_.emplace_back();
    wedge.floor = floors[t];
    wedge.barrier = model.barrier * triangle_scale(own, sizes[a], sizes[b]);
    wedge.scale = edge_scale(sizes[a], sizes[b]);
    wedge.x = r.x - q.x, wedge.y = r.y - q.y;
    wedge.l2 = wedge.x * wedge.x + wedge.y * wedge.y;
    wedge.inverse_l2 = 1 / wedge.l2;
    const double dw = q.w - r.w;
    wedge.dw2 = dw * dw;
    wedge.split_room = split_room(dw * wedge.inverse_l2, wedge.floor);
    wedge.boundary = !across.valid();
    if (across.valid()) wedge.outer = triangle_shape(r, q, mesh.point(mesh.opposite(across))).edges[0].g;
  }
  if (!closed_) add_arm_to(last);
  return true;
}

const EdgeWeights& AccuracyPatch::weights_of_arm(std::size_t i) const {
  return !closed_ && (i == 0 || i + 1 == arms_.size()) ? model_->boundary : model_->inner;
}

void AccuracyPatch::place(const WeightedPoint& p) {
  for (Arm& arm : arms_) {
    arm.x = arm.q.x - p.x, arm.y = arm.q.y - p.y;
    arm.l2 = arm.x * arm.x + arm.y * arm.y;
    arm.inverse_l2 = 1 / arm.l2;
    arm.dw = p.w - arm.q.w;
  }
}

AccuracyEdge AccuracyPatch::link_edge(const Wedge& t) const {
  return {t.l2, t.inverse_l2, t.link_g + t.outer, t.link_g - t.outer, t.dw2};
}

/// Finds the heights of triangle i; returns its barrier and the energy of its link edge, or +∞.
double AccuracyPatch::add_wedge(std::size_t i) {
  Arm &a = arms_[i], &b = arms_[next(i)];
  Wedge& t = wedges_[i];
  const double area = a.x * b.y - a.y * b.x;
  if (!(area > 0)) return kOutside;
  t.inverse_area = 1 / area;
  const double ab = a.x * b.x + a.y * b.y;
  const double ua = 0.5 * (a.l2 + a.dw), ub = 0.5 * (b.l2 + b.dw);
  a.left = (ub * a.l2 - ua * ab) * t.inverse_area;
  b.right = (ua * b.l2 - ub * ab) * t.inverse_area;
  t.link_g = area - a.left - b.right;
  const double ha = a.left * a.inverse_l2 - t.floor, hb = b.right * b.inverse_l2 - t.floor;
  const double hc = t.link_g * t.inverse_l2 - t.floor;
  const double ya = a.dw * a.inverse_l2, yb = b.dw * b.inverse_l2;
  const double da = split_room(ya, t.floor), db = split_room(yb, t.floor);
  if (!(ha > 0 && hb > 0 && hc > 0 && da > 0 && db > 0)) return kOutside;
  const double heights = ha * hb * hc;
  const double logarithm = portable_log(heights * heights * (da * db * t.split_room));
  return t.scale * edge_value(t.boundary ? model_->boundary : model_->inner, link_edge(t)) -
         0.5 * t.barrier * logarithm;
}

double AccuracyPatch::value(const WeightedPoint& p) {
  place(p);
  value_ = 0;
  for (std::size_t i = 0; i < wedges_.size(); ++i) {
    value_ += add_wedge(i);
    if (!(value_ < kOutside)) return value_ = kOutside;
  }
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    const Arm& a = arms_[i];
    const AccuracyEdge edge{a.l2, a.inverse_l2, a.left + a.right, a.left - a.right, a.dw * a.dw};
    value_ += a.scale * edge_value(weights_of_arm(i), edge);
  }
  return value_;
}

/// The derivatives of all that belongs to spoke i in its own terms.
void AccuracyPatch::find_slopes(std::size_t i) {
  Arm& a = arms_[i];
  const AccuracyEdge edge{a.l2, a.inverse_l2, a.left + a.right, a.left - a.right, a.dw * a.dw};
  EdgeWeights weights = weights_of_arm(i);
  for (double* w : {&weights.length, &weights.dual, &weights.split, &weights.height}) *w *= a.scale;
  a.slopes = edge_slopes(weights, edge, a.dw);
  const auto add_barrier = [&](const Wedge& t, bool left) {
    add_height_barrier(a.slopes, left, {t.barrier, t.floor}, a.l2, a.inverse_l2, left ? a.left : a.right);
    add_split_barrier(a.slopes, {t.barrier, t.floor}, a.l2, a.inverse_l2, a.dw);
  };
  const std::size_t n = wedges_.size();
  if (i < n) add_barrier(wedges_[i], true);
  if (closed_ || i > 0) add_barrier(wedges_[i > 0 ? i - 1 : n - 1], false);
}

/// The derivatives of the heights of triangle i, and what their Hessians give. With a, b the spokes, c = b − a,
/// m = (−c_y, c_x) = ∇S, and the orthocenter o = center + ω, the vectors
///
///     ω̂ = (ω_x, ω_y, ½)    ĉ = (c_x, c_y, 0)    m̂ = (m_x, m_y, 0)    I = diag(1, 1, 0)    k = a·c/S    κ = |c|²/S
///
/// in (x, y, w) give: a step of the center moves o by − m (ω̂ · step)/S, along the radical line of the link edge, so
///
///     ∇g_link  = − κ ω̂                             ∇²g_link  = κ I + κ (m̂ ω̂ᵀ + ω̂ m̂ᵀ)/S
///     ∇g_left  = (a_y − ω_y, ω_x − a_x, 0) − k ω̂    ∇²g_left  = k I + (ω̂ (ĉ + k m̂)ᵀ + (ĉ + k m̂) ω̂ᵀ)/S
///     ∇g_right = m̂ − ∇g_left − ∇g_link              ∇²g_right = − ∇²g_left − ∇²g_link          (the three sum to S)
void AccuracyPatch::add_triangle(std::size_t i, VertexDerivatives& sum) {
  Arm &a = arms_[i], &b = arms_[next(i)];
  const Wedge& t = wedges_[i];
  const double ua = 0.5 * (a.l2 + a.dw), ub = 0.5 * (b.l2 + b.dw), inv = t.inverse_area;
  const Vector o = {(ua * b.y - ub * a.y) * inv, (ub * a.x - ua * b.x) * inv, 0.5};
  const double k = (a.x * t.x + a.y * t.y) * inv, kappa = t.l2 * inv;
  Vector to_link;
  for (std::size_t j = 0; j < 3; ++j) to_link[j] = -kappa * o[j];
  a.to_left = {a.y - o[1] - k * o[0], o[0] - a.x - k * o[1], -k * o[2]};
  b.to_right = {-t.y - a.to_left[0] - to_link[0], t.x - a.to_left[1] - to_link[1], -a.to_left[2] - to_link[2]};

  EdgeWeights weights = t.boundary ? model_->boundary : model_->inner;
  for (double* w : {&weights.length, &weights.dual, &weights.split, &weights.height}) *w *= t.scale;
  EdgeSlopes link = edge_slopes(weights, link_edge(t), 0);  // what depends on δw is constant there
  add_height_barrier(link, true, {t.barrier, t.floor}, t.l2, t.inverse_l2, t.link_g);
  add_gradient(sum, link.left, to_link);
  Vector curved;
  for (std::size_t j = 0; j < 3; ++j) curved[j] = link.left_left * to_link[j];
  add_outer_product(sum, curved, to_link);

  const double left = a.slopes.left - b.slopes.right, across = link.left - b.slopes.right;
  const double on_c = left * inv, on_m = (left * k + across * kappa) * inv;
  const Vector v = {on_c * t.x - on_m * t.y, on_c * t.y + on_m * t.x, 0};
  add_outer_product(sum, o, v);
  add_outer_product(sum, v, o);
  const double round = left * k + across * kappa;
  sum.hessian[0] += round;
  sum.hessian[3] += round;
}

/// The chain rule in L, left, right and δw; ∇L = −2 (x, y, 0), ∇²L = 2 I, ∇δw = (0, 0, 1).
void AccuracyPatch::add_arm(const Arm& a, VertexDerivatives& sum) const {
  const EdgeSlopes& s = a.slopes;
  const Vector to_l = {-2 * a.x, -2 * a.y, 0};
  add_gradient(sum, s.l, to_l);
  add_gradient(sum, s.left, a.to_left);
  add_gradient(sum, s.right, a.to_right);
  sum.gradient[2] += s.dw;
  Vector by_l, by_left, by_right;
  for (std::size_t j = 0; j < 3; ++j) {
    by_l[j] = s.l_l * to_l[j] + s.l_left * a.to_left[j] + s.l_right * a.to_right[j];
    by_left[j] = s.l_left * to_l[j] + s.left_left * a.to_left[j] + s.left_right * a.to_right[j];
    by_right[j] = s.l_right * to_l[j] + s.left_right * a.to_left[j] + s.right_right * a.to_right[j];
  }
  by_l[2] += s.l_dw;
  by_left[2] += s.side_dw;
  by_right[2] += s.side_dw;
  add_outer_product(sum, to_l, by_l);
  add_outer_product(sum, a.to_left, by_left);
  add_outer_product(sum, a.to_right, by_right);
  // ∇δw = (0, 0, 1): of what it is multiplied with, the upper half of the Hessian holds the last number alone.
  sum.hessian[5] += s.side_dw * (a.to_left[2] + a.to_right[2]) + s.dw_dw;
  sum.hessian[0] += 2 * s.l;
  sum.hessian[3] += 2 * s.l;
}

VertexDerivatives AccuracyPatch::derivatives() {
  VertexDerivatives sum;
  sum.value = value_;
  sum.feasible = true;
  for (std::size_t i = 0; i < arms_.size(); ++i) {
    arms_[i].to_left = arms_[i].to_right = {};
    find_slopes(i);
  }
  for (std::size_t i = 0; i < wedges_.size(); ++i) add_triangle(i, sum);
  for (const Arm& arm : arms_) add_arm(arm, sum);
  return sum;
}

bool AccuracyPatch::is_well_centered(const WeightedPoint& p) const {
  for (std::size_t i = 0; i < wedges_.size(); ++i) {
    if (!inlined::is_well_centered(p, arms_[i].q, arms_[next(i)].q)) return false;
  }
  return true;
}

double AccuracyPatch::shortest_spoke(const WeightedPoint& p) const {
  double least = kOutside;
  for (const Arm& arm : arms_) least = std::min(least, squared_length(arm.q.position() - p.position()));
  return std::sqrt(least);
}

}  // namespace temper

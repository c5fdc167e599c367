#include "optimize/sweep/part_system.hpp"

#include <algorithm>
#include <cmath>

#include "optimize/sweep/semidefinite.hpp"

namespace temper {
namespace {

// A triangle whose gradient, scaled by the root of its doubled area, is larger than this is far from equilibrium: its
// Hessian says little there, and where it has negative eigenvalues it would spoil the step of the whole part. One or
// two per cent are at first.
constexpr double kUnbalanced = 20;
// Pivots of D below this part of the diagonal entry are raised to it.
constexpr double kPivotFloor = 1e-8;
// The largest entry: where a triangle is about to leave the domain, a float may be too small. Its equations mean
// little.
constexpr double kMostEntry = 1e30;

using Matrix3 = std::array<double, 9>;  // row by row

Float4 single(double x, double y, double w) {
  return {Float4::Floats{static_cast<float>(x), static_cast<float>(y), static_cast<float>(w), 0}};
}

Movable movable_of(Mobility mobility, Unknowns unknowns) {
  const bool weight = mobility != Mobility::frozen && unknowns != Unknowns::positions;
  const bool position = mobility == Mobility::free && unknowns != Unknowns::weights;  // sliding is for sweeps
  if (position) return weight ? Movable::all : Movable::position;
  return weight ? Movable::weight : Movable::nothing;
}

Matrix6 hessian_of(const TriangleHessians& hessians, std::size_t lane) {
  Matrix6 h;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) h[i][j] = h[j][i] = hessians.hessian[hessian_entry(i, j)][lane];
  }
  return h;
}

/// Works in numbers that are scaled by R, R, R² with R² the doubled area.
void project_if_unbalanced(const TriangleHessians& hessians, std::size_t lane, Matrix6& h) {
  const double r2 = hessians.doubled_area[lane];
  const auto square = [&](std::size_t i) { return hessians.gradient[i][lane] * hessians.gradient[i][lane]; };
  const double norm2 = r2 * (square(0) + square(1) + square(3) + square(4)) + r2 * r2 * (square(2) + square(5));
  if (!(norm2 > kUnbalanced * kUnbalanced)) return;
  const double r = std::sqrt(r2);
  const std::array<double, 6> unit = {r, r, r2, r, r, r2};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) h[i][j] *= unit[i] * unit[j];
  }
  make_semidefinite(h);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) h[i][j] /= unit[i] * unit[j];
  }
}

Matrix3 block_of(const Matrix6& h, std::size_t row, std::size_t column) {
  Matrix3 b;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) b[3 * i + j] = h[row + i][column + j];
  }
  return b;
}

Matrix3 transposed(const Matrix3& b) { return {b[0], b[3], b[6], b[1], b[4], b[7], b[2], b[5], b[8]}; }

Matrix3 minus_sum(const Matrix3& a, const Matrix3& b) {
  Matrix3 sum;
  for (std::size_t k = 0; k < 9; ++k) sum[k] = -a[k] - b[k];
  return sum;
}

}  // namespace

void PartSystem::gather(const Mesh& mesh, const IdVector<VertexId, Mobility>& mobility, Unknowns unknowns,
                        const Part& part) {
  part_ = part;
  find_movable(mesh, mobility, unknowns);
  triangles_.clear();
  matrix_.start.clear();
  matrix_.column.clear();
  for (std::size_t i = 0; i < size(); ++i) add_row(mesh, i);
  matrix_.start.push_back(static_cast<std::uint32_t>(matrix_.column.size()));
}

void PartSystem::find_movable(const Mesh& mesh, const IdVector<VertexId, Mobility>& mobility, Unknowns unknowns) {
  movable_.clear();
  unit_.clear();
  for (std::size_t i = part_.first.index; i < part_.last.index; ++i) {
    const VertexId v(i);
    Movable movable = mesh.is_isolated(v) ? Movable::nothing : movable_of(mobility[v], unknowns);
    double unit = 1;
    if (movable != Movable::nothing) {
      for (const HalfedgeId h : mesh.star(v)) {
        if (part_.contains(mesh.target(h)) && part_.contains(mesh.opposite(h))) continue;
        movable = Movable::nothing;
        break;
      }
    }
    if (movable != Movable::nothing) {
      unit = length(mesh.position(mesh.target(mesh.outgoing(v))) - mesh.position(v));
    }
    movable_.push_back(movable);
    unit_.push_back(unit);
  }
}

/// The columns of row i, and the triangles of which vertex(i) is the first corner that moves.
void PartSystem::add_row(const Mesh& mesh, std::size_t i) {
  const VertexId v = vertex(i);
  const std::size_t begin = matrix_.column.size();
  const auto add = [&](VertexId u) {
    if (moves(u)) matrix_.column.push_back(static_cast<std::uint32_t>(index(u)));
  };
  if (moves(v)) {
    HalfedgeId last;
    for (const HalfedgeId h : mesh.star(v)) {
      const VertexId q = mesh.target(h), r = mesh.opposite(h);
      add(q);
      if (!(q < v && moves(q)) && !(r < v && moves(r))) triangles_.push_back(Mesh::triangle(h));
      last = h;
    }
    if (mesh.is_boundary(v)) add(mesh.opposite(last));
  }
  const auto columns = matrix_.column.begin() + static_cast<std::ptrdiff_t>(begin);
  std::sort(columns, matrix_.column.end());
  const auto upper = std::lower_bound(columns, matrix_.column.end(), static_cast<std::uint32_t>(i));
  matrix_.start.push_back(static_cast<std::uint32_t>(begin));
  matrix_.start.push_back(static_cast<std::uint32_t>(upper - matrix_.column.begin()));
}

/// The entry of a column, looked for in its row from `begin` on.
std::size_t PartSystem::entry(std::size_t begin, std::size_t column) const {
  while (matrix_.column[begin] != column) ++begin;
  return begin;
}

std::size_t PartSystem::load(const Mesh& mesh, std::size_t begin, TriangleLanes& lanes) const {
  const std::size_t n = std::min(kLanes, triangles_.size() - begin);
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto [p, q, r] = mesh.points(triangles_[begin + std::min(lane, n - 1)]);
    lanes.p.set(lane, p);
    lanes.q.set(lane, q);
    lanes.r.set(lane, r);
  }
  return n;
}

double PartSystem::assemble(const Mesh& mesh, const EdgeFormula& formula) {
  matrix_.clear_blocks();
  diagonal_.assign(size(), {});
  gradient_.assign(size(), {});
  const auto kernel = triangle_hessians();
  double energy = 0;
  TriangleLanes lanes;
  TriangleHessians hessians;
  for (std::size_t begin = 0; begin < triangles_.size(); begin += kLanes) {
    const std::size_t n = load(mesh, begin, lanes);
    constexpr unsigned kAll = (1U << kLanes) - 1;
    if (kernel(formula, lanes, hessians) != kAll) return kInfinity;
    energy += star_kernels(mesh.space()).barrier_sum(formula, lanes, n);  // as trials are measured, to the last bit
    for (std::size_t lane = 0; lane < n; ++lane) add_triangle(mesh.corners(triangles_[begin + lane]), hessians, lane);
  }
  normalise();
  return energy;
}

void PartSystem::add_triangle(const std::array<VertexId, 3>& corners, const TriangleHessians& hessians,
                              std::size_t lane) {
  Matrix6 h = hessian_of(hessians, lane);
  project_if_unbalanced(hessians, lane, h);
  const std::array<std::size_t, 3> at = {index(corners[0]), index(corners[1]), index(corners[2])};
  const Matrix3 qq = block_of(h, 0, 0), qr = block_of(h, 0, 3), rr = block_of(h, 3, 3);
  const Matrix3 qp = minus_sum(qq, qr), rp = minus_sum(transposed(qr), rr);
  const std::array<Matrix3, 3> own = {minus_sum(qp, rp), qq, rr};
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<double, 6>& d = diagonal_[at[c]];
    const Matrix3& b = own[c];
    d[0] += b[0], d[1] += b[3], d[2] += b[4], d[3] += b[6], d[4] += b[7], d[5] += b[8];
    for (std::size_t k = 0; k < 3; ++k) {
      const double q = hessians.gradient[k][lane], r = hessians.gradient[3 + k][lane];
      gradient_[at[c]][k] += c == 0 ? -q - r : c == 1 ? q : r;
    }
  }
  add_pair(at[1], at[0], qp);
  add_pair(at[2], at[0], rp);
  add_pair(at[1], at[2], qr);
}

/// Adds a block of rows i and columns j to U.
void PartSystem::add_pair(std::size_t i, std::size_t j, const Matrix3& block) {
  if (movable_[i] == Movable::nothing || movable_[j] == Movable::nothing) return;
  if (j < i) return add_pair(j, i, transposed(block));
  const double u = unit_[i], v = unit_[j];
  const std::array<double, 3> rows = {u, u, u * u}, columns = {v, v, v * v};
  float* to = matrix_.block(entry(matrix_.begin_upper(i), j));
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t r = 0; r < 3; ++r) {
      to[3 * c + r] += static_cast<float>(std::clamp(rows[r] * columns[c] * block[3 * r + c], -kMostEntry, kMostEntry));
    }
  }
}

/// C⁻¹ H C⁻ᵀ and −C⁻¹ g.
void PartSystem::normalise() {
  right_side_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) factorise(i);
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t k = matrix_.begin_upper(i); k < matrix_.end_upper(i); ++k) normalise_block(i, k);
  }
}

/// Cholesky's factors of D, inverted. Rows of what does not move are 0, and so are all where D is of no use.
void PartSystem::factorise(std::size_t i) {
  std::array<double, 6> d = diagonal_[i];
  const double u = unit_[i];
  const std::array<double, 6> units = {u * u, u * u, u * u, u * u * u, u * u * u, u * u * u * u};
  for (std::size_t k = 0; k < 6; ++k) d[k] *= units[k];
  std::array<double, 6>& c = diagonal_[i];
  c = {};
  const bool useful = d[0] > 0 && d[2] > 0 && d[5] > 0;
  const Movable movable = useful ? movable_[i] : Movable::nothing;
  if (movable == Movable::weight) c[5] = 1 / std::sqrt(d[5]);
  if (movable == Movable::position || movable == Movable::all) {
    const double l00 = std::sqrt(d[0]), l10 = d[1] / l00;
    const double l11 = std::sqrt(std::max(d[2] - l10 * l10, kPivotFloor * d[2]));
    c[0] = 1 / l00, c[2] = 1 / l11, c[1] = -l10 * c[0] * c[2];
    if (movable == Movable::all) {
      const double l20 = d[3] / l00, l21 = (d[4] - l20 * l10) / l11;
      c[5] = 1 / std::sqrt(std::max(d[5] - l20 * l20 - l21 * l21, kPivotFloor * d[5]));
      c[4] = -l21 * c[2] * c[5];
      c[3] = -(l20 * c[0] + l21 * c[1]) * c[5];
    }
  }
  const double x = u * gradient_[i][0], y = u * gradient_[i][1], w = u * u * gradient_[i][2];
  right_side_[i] = single(-c[0] * x, -c[1] * x - c[2] * y, -c[3] * x - c[4] * y - c[5] * w);
}

/// C_i⁻¹ H_ij C_j⁻ᵀ into U, and transposed into L.
void PartSystem::normalise_block(std::size_t i, std::size_t k) {
  const std::size_t j = matrix_.column[k];
  const std::array<double, 6>&a = diagonal_[i], &b = diagonal_[j];
  float* upper = matrix_.block(k);
  Matrix3 left, both;  // C_i⁻¹ H, and times C_j⁻ᵀ
  for (std::size_t c = 0; c < 3; ++c) {
    const float* h = upper + 3 * c;
    const double x = static_cast<double>(h[0]), y = static_cast<double>(h[1]), w = static_cast<double>(h[2]);
    left[c] = a[0] * x;
    left[3 + c] = a[1] * x + a[2] * y;
    left[6 + c] = a[3] * x + a[4] * y + a[5] * w;
  }
  for (std::size_t r = 0; r < 9; r += 3) {
    both[r] = left[r] * b[0];
    both[r + 1] = left[r] * b[1] + left[r + 1] * b[2];
    both[r + 2] = left[r] * b[3] + left[r + 1] * b[4] + left[r + 2] * b[5];
  }
  float* lower = matrix_.block(entry(matrix_.begin_lower(j), i));
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) upper[3 * c + r] = lower[3 * r + c] = static_cast<float>(both[3 * r + c]);
  }
}

void PartSystem::solve() { solution_ = &solver_.solve(matrix_, right_side_); }

std::array<double, 3> PartSystem::step(std::size_t i) const {
  const Float4& z = (*solution_)[i];
  const std::array<double, 6>& c = diagonal_[i];
  const double x = static_cast<double>(z[0]), y = static_cast<double>(z[1]), w = static_cast<double>(z[2]);
  const double u = unit_[i];
  return {u * (c[0] * x + c[1] * y + c[3] * w), u * (c[2] * y + c[4] * w), u * u * c[5] * w};
}

}  // namespace temper

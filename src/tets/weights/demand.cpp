#include "tets/weights/demand.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "base/sort_unique.hpp"
#include "temper/tets/weights.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

using Kind = WeightConstraint::Kind;

}  // namespace

TetDemand::TetDemand(const TetMesh& mesh, Constraints constraints)
    : Demand(Space(), constraints, constraints == Constraints::completely_well_centered, Kind::dual_of_face),
      mesh_(mesh),
      star_start_(mesh.n_vertices() + 1, 0),
      star_(4 * mesh.n_tetrahedra()) {
  for (const TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) ++star_start_[v.index];
  }
  if (allows_zero()) surface_ = SurfaceRows(mesh);
  std::uint32_t sum = 0;
  for (std::uint32_t& start : star_start_) sum += start, start = sum;
  for (const TetId t : mesh.tetrahedra()) {
    for (const VertexId v : mesh.corners(t)) star_[--star_start_[v.index]] = t;
  }
}

TetDemand::TetDemand(const MetricMesh& pieces, Constraints constraints) : TetDemand(pieces.mesh, constraints) {
  if (!pieces.is_cut()) return;
  pieces_ = &pieces;
  std::vector<std::array<VertexId, 2>> copies;
  for (const VertexId v : mesh_.vertices()) {
    if (pieces.first_copy(v) != v) copies.push_back({pieces.first_copy(v), v});
  }
  seams_ = Seams(n_vertices(), copies, equations_of_seams(pieces));
}

std::vector<WeightConstraint> equations_of_seams(const MetricMesh& pieces) {
  std::vector<WeightConstraint> equations;
  for (const SeamFace& seam : seams_of(pieces)) {
    const auto [one, other] = corners_of(pieces, seam);
    for (std::size_t k = 0; k < 3; ++k) {
      using Edge = std::array<VertexId, 2>;
      const std::size_t next = (k + 1) % 3;
      Edge here = {one[k], one[next]}, there = {other[k], other[next]};
      if (here[1] < here[0]) std::swap(here[0], here[1]), std::swap(there[0], there[1]);
      if (std::ranges::min(there) < here[0]) std::swap(here, there);
      if (here[1] < here[0]) std::swap(here[0], here[1]), std::swap(there[0], there[1]);
      equations.push_back({Kind::equal_crossing, here[0], here[1], there[0], there[1]});
    }
  }
  const auto key = [](const WeightConstraint& c) { return std::tie(c.p, c.q, c.r, c.s); };
  const auto before = [&](const WeightConstraint& a, const WeightConstraint& b) { return key(a) < key(b); };
  std::sort(equations.begin(), equations.end(), before);
  equations.erase(std::unique(equations.begin(), equations.end()), equations.end());
  return equations;
}

void TetDemand::add_corners(CellId cell, std::vector<VertexId>& corners) const {
  for (const VertexId v : mesh_.corners(TetId(cell.index))) corners.push_back(v);
}

void TetDemand::add_cells_around(VertexId v, std::vector<CellId>& cells) const {
  seams_.for_each_copy(v, [&](VertexId copy) {
    for (const TetId t : star(copy)) cells.emplace_back(t.index);
  });
}

void TetDemand::add_vertices_across(VertexId v, std::vector<VertexId>& vertices) const {
  for (const TetId t : star(v)) {
    const HalffaceId outer = mesh_.halfface_opposite(t, v);
    if (!mesh_.is_boundary(outer)) vertices.push_back(mesh_.opposite(mesh_.twin(outer)));
    for (const std::uint32_t row : surface_.of(t)) {
      const auto& [kind, p, q, r, s, unused] = surface_.constraint(row);
      if (kind == Kind::dual && (v == r || v == s)) vertices.push_back(v == r ? s : r);
    }
  }
}

std::vector<WeightEdge> TetDemand::edges_of(std::span<const CellId> cells) const {
  std::vector<std::array<VertexId, 2>> ends;
  ends.reserve(6 * cells.size());
  for (const CellId cell : cells) {
    const auto& corners = mesh_.corners(TetId(cell.index));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j)
        ends.push_back({std::min(corners[i], corners[j]), std::max(corners[i], corners[j])});
    }
  }
  sort_unique(ends);
  std::vector<WeightEdge> edges;
  edges.reserve(ends.size());
  for (const auto& [p, q] : ends) edges.push_back({p, q, squared_length(mesh_.position(q) - mesh_.position(p))});
  return edges;
}

WeightConstraint TetDemand::over_face(HalffaceId h) const {
  const auto [p, q, r] = mesh_.vertices(h);
  return {Kind::height_over_face, p, q, r, mesh_.opposite(h)};
}

WeightConstraint TetDemand::dual(HalffaceId h) const {
  const auto [p, q, r] = mesh_.vertices(h);
  return {Kind::dual_of_face, p, q, r, mesh_.opposite(h), mesh_.opposite(mesh_.twin(h))};
}

std::vector<WeightConstraint> TetDemand::constraints_of(std::span<const CellId> cells, bool rim) const {
  std::vector<WeightConstraint> all;
  const auto for_each_side = [&](const auto& use) {
    for (const CellId cell : cells) {
      for (int f = 0; f < 4; ++f) use(TetMesh::halfface(TetId(cell.index), f));
    }
  };
  const auto is_across = [&](HalffaceId h) {
    return !mesh_.is_boundary(h) &&
           std::binary_search(cells.begin(), cells.end(), CellId(TetMesh::tetrahedron(mesh_.twin(h)).index));
  };
  for_each_side([&](HalffaceId h) {
    if (has_heights() || (has_outer_heights() && mesh_.bounds_region(h))) all.push_back(over_face(h));
  });
  if (has_crossings()) {
    for_each_side([&](HalffaceId h) {
      if (!mesh_.is_face_representative(h) && is_across(h)) return;
      const auto [p, q, r] = mesh_.vertices(h);
      for (const auto& [a, b, c] : {std::tuple(p, q, r), {q, r, p}, {r, p, q}}) all.push_back({Kind::height, a, b, c});
    });
    for (const auto& [p, q, length] : edges_of(cells))
      all.push_back(split_constraint(p, q)), all.push_back(split_constraint(q, p));
  }
  if (has_duals()) {
    for_each_side([&](HalffaceId h) {
      if (mesh_.is_boundary(h)) return;
      const bool both = is_across(h);
      if (both ? mesh_.is_face_representative(h) : rim) all.push_back(dual(h));
    });
  }
  add_surface_rows(cells, rim, all);
  return all;
}

void TetDemand::add_surface_rows(std::span<const CellId> cells, bool rim, std::vector<WeightConstraint>& all) const {
  std::vector<std::uint32_t> rows;
  for (const CellId cell : cells) {
    const auto of_cell = surface_.of(TetId(cell.index));
    rows.insert(rows.end(), of_cell.begin(), of_cell.end());
  }
  sort_unique(rows);
  const auto has = [&](TetId t) { return std::binary_search(cells.begin(), cells.end(), CellId(t.index)); };
  for (const std::uint32_t row : rows) {
    if (rim || surface_.has_all(mesh_, row, has)) all.push_back(surface_.constraint(row));
  }
}

std::vector<WeightConstraint> TetDemand::equations_of(std::span<const CellId> cells) const {
  if (seams_.empty()) return {};
  return seams_.equations_among(vertices_of(*this, cells));
}

void TetDemand::settle(VertexWeights& weights) const {
  seams_.settle(weights, [this](const WeightConstraint& c) { return linear_form(c); });
}

LinearForm TetDemand::form_over_face(VertexId p, VertexId q, VertexId r, VertexId s) const {
  const Vec3 origin = mesh_.position(p);
  const std::array<Vec3, 3> to = {mesh_.position(q) - origin, mesh_.position(r) - origin, mesh_.position(s) - origin};
  const Vec3 n = cross(to[0], to[1]);
  const double twice_area = length(n);
  const double scale = 0.5 / (twice_area * dot(n, to[2]) * length_of_area(0.5 * twice_area));
  LinearForm form = {4, {p, q, r, s}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double factor = scale * dot(n, cross(to[(k + 1) % 3], to[(k + 2) % 3]));
    form.coefficients[k + 1] = -factor;
    form.coefficients[0] += factor;
    form.constant += factor * squared_length(to[k]);
  }
  return form;
}

// The weight of p has no influence if the other four vertices are coplanar. Rounding must not give it one: weights of
// 2^53 ℓ² would seem to help. Smaller influences than the one dropped are within the reach of certificates.
LinearForm TetDemand::dual_form(const WeightConstraint& c) const {
  constexpr double kNoInfluence = 0x1p-44;
  const LinearForm up = form_over_face(c.p, c.q, c.r, c.s), down = form_over_face(c.p, c.r, c.q, c.t);
  const auto& [a, b] = std::tie(up.coefficients, down.coefficients);
  LinearForm form = {
      5, {c.p, c.q, c.r, c.s, c.t}, {a[0] + b[0], a[1] + b[2], a[2] + b[1], a[3], b[3]}, up.constant + down.constant};
  double largest = 0;
  for (const double x : {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]}) largest = std::max(largest, std::abs(x));
  for (double& x : form.coefficients) {
    if (std::abs(x) <= kNoInfluence * largest) x = 0;
  }
  return form;
}

LinearForm TetDemand::surface_form(const WeightConstraint& c) const {
  const Vec3 p = mesh_.position(c.p), q = mesh_.position(c.q), r = mesh_.position(c.r), s = mesh_.position(c.s);
  const Vec3 up = cross(q - p, r - p), down = cross(s - p, q - p);
  const double cosine = dot(up, down) / (length(up) * length(down));
  const LinearForm left = height_form(c, q - p, r - p, r - q, length(up));
  const LinearForm right = height_form(c, p - q, s - q, s - p, length(down));
  const auto& [a, b] = std::tie(left.coefficients, right.coefficients);
  return {4,
          {c.p, c.q, c.r, c.s},
          {cosine * a[0] + b[1], cosine * a[1] + b[0], cosine * a[2], b[2]},
          cosine * left.constant + right.constant};
}

LinearForm TetDemand::linear_form(const WeightConstraint& c) const {
  if (c.kind == Kind::height_over_face) return form_over_face(c.p, c.q, c.r, c.s);
  if (c.kind == Kind::dual_of_face) return dual_form(c);
  if (c.kind == Kind::dual) return surface_form(c);
  const Vec3 pq = mesh_.position(c.q) - mesh_.position(c.p);
  if (c.kind == Kind::crossing) return crossing_form(c, pq);
  if (c.kind == Kind::equal_crossing) return equal_crossing_form(c, pq, mesh_.position(c.s) - mesh_.position(c.r));
  const Vec3 pr = mesh_.position(c.r) - mesh_.position(c.p);
  return height_form(c, pq, pr, mesh_.position(c.r) - mesh_.position(c.q), length(cross(pq, pr)));
}

double TetDemand::scale_of_polynomial(const WeightConstraint& c) const {
  const Vec3 p = mesh_.position(c.p), pq = mesh_.position(c.q) - p;
  if (c.kind == Kind::crossing) return 2 * squared_length(pq);
  if (c.kind == Kind::equal_crossing)
    return 2 * squared_length(pq) * squared_length(mesh_.position(c.s) - mesh_.position(c.r));
  const Vec3 n = cross(pq, mesh_.position(c.r) - p);
  const double twice_area = length(n);
  if (c.kind == Kind::height) return 2 * squared_length(pq) * twice_area;
  if (c.kind == Kind::dual) return 2 * twice_area * twice_area * length(cross(pq, mesh_.position(c.s) - p));
  const double volumes = dot(n, mesh_.position(c.s) - p), side = length_of_area(0.5 * twice_area);
  if (c.kind == Kind::height_over_face) return 2 * side * twice_area * volumes;
  return -2 * side * volumes * dot(n, mesh_.position(c.t) - p) / twice_area;
}

bool TetDemand::is_kept(CellId cell, const VertexWeights& weights) const {
  const auto at = [&](VertexId v) {
    WeightedPoint point = mesh_.point(v);
    point.w = weights[v];
    return point;
  };
  const auto sign_of = [&](const WeightConstraint& c) {
    switch (c.kind) {
      case Kind::height_over_face:
      case Kind::dual:  // the same polynomial
        return signed_height_sign(at(c.p), at(c.q), at(c.r), at(c.s));
      case Kind::dual_of_face:
        return -power_test(at(c.p), at(c.q), at(c.r), at(c.s), at(c.t));
      case Kind::height:
        return signed_height_sign(at(c.p), at(c.q), at(c.r));
      default:
        return dual_crossing_sign(at(c.p), at(c.q));
    }
  };
  const std::vector<WeightConstraint> all = constraints_of({&cell, 1}, true);
  return std::all_of(all.begin(), all.end(), [&](const auto& c) { return is_good(sign_of(c)); });
}

double TetDemand::margin_of(CellId cell, const VertexWeights& weights) const {
  double margin = kUnbounded;
  for (const WeightConstraint& c : constraints_of({&cell, 1}, true))
    margin = std::min(margin, counted(c, value_of(linear_form(c), [&](VertexId v) { return weights[v]; })));
  return margin;
}

double TetDemand::angle_deg(const WeightConstraint& /*constraint*/) const { return 0; }

double TetDemand::reach(VertexId p, VertexId q, std::span<const VertexId> corners) const {
  const auto distance = [&](VertexId a, VertexId b) { return squared_length(mesh_.position(b) - mesh_.position(a)); };
  double most = has_duals() ? (1 + 2 * kCrossingReach) * distance(p, q) : distance(p, q);
  for (const VertexId r : corners) {
    if (has_heights() && !has_crossings()) most = std::max(most, std::abs(distance(p, r) - distance(q, r)));
  }
  return most;
}

CertificateCheck TetDemand::check(const Certificate& certificate) const {
  return pieces_ != nullptr ? check_certificate(*pieces_, certificate) : check_certificate(mesh_, certificate);
}

}  // namespace temper::tets

// The exact check of a certificate on tetrahedra (feasibility/certificate_sum.hpp). It shares no code with the builder
// of the programs. M is a double, all else is exact.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "feasibility/certificate_sum.hpp"
#include "temper/tets/weights.hpp"

namespace temper::tets {
namespace {

using namespace certified;

// As in the plane: the product of six differences and a multiplier must be a multiple of 2^-1074. The product has
// 6 · (75 + 53) + 250 + 53 = 1071 bits.
constexpr double kLeastCoordinate = 0x1p-75;
// A product of M, a margin and a multiplier has 600 + 53 + 20 + 53 + 250 + 53 = 1029 bits. The margin of a smaller M
// counts as 0, which is weaker.
constexpr double kLeastM = 0x1p-600;
constexpr std::array<int, 6> kDegrees = {4, 2, 6, 6, 5, 4};

bool counts(Constraints constraints, Kind kind) {
  if (kind == Kind::equal_crossing) return constraints != Constraints::heights_only;
  switch (constraints) {
    case Constraints::well_centered:
      return kind == Kind::height_over_face;
    case Constraints::completely_well_centered:
      return kind == Kind::height_over_face || kind == Kind::height || kind == Kind::crossing;
    case Constraints::regular:
      return kind == Kind::dual_of_face;
    case Constraints::coefficients:
      return kind != Kind::crossing;
    case Constraints::distances:
      return kind == Kind::dual_of_face || kind == Kind::height_over_face;
    case Constraints::heights_only:
      return false;
  }
  return false;
}

Vec3 place_of(const TetMesh& mesh, const Scale& scale, VertexId v) {
  const Vec3 p = mesh.position(v);
  return {scale.coordinate(p.x), scale.coordinate(p.y), scale.coordinate(p.z)};
}
Vector3 vector_between(const TetMesh& mesh, const Scale& scale, VertexId a, VertexId b) {
  const Vec3 p = place_of(mesh, scale, a), q = place_of(mesh, scale, b);
  return {Number::difference(q.x, p.x), Number::difference(q.y, p.y), Number::difference(q.z, p.z)};
}

/// The edges, faces and tetrahedra of the mesh between some vertices.
class Parts {
 public:
  Parts(const TetMesh& mesh, const Certificate& certificate) : mesh_(mesh) {
    std::vector<std::uint8_t> marked(mesh.n_vertices(), 0);
    for (const auto& term : certificate.terms) {
      for_each_vertex(term.constraint, [&](VertexId v) {
        if (v.index < marked.size()) marked[v.index] = 1;
      });
    }
    for (const TetId t : mesh.tetrahedra()) {
      std::array<VertexId, 4> corners = mesh.corners(t);
      const auto last =
          std::partition(corners.begin(), corners.end(), [&](VertexId v) { return marked[v.index] != 0; });
      std::fill(last, corners.end(), VertexId());
      std::sort(corners.begin(), corners.end());
      add(corners);
    }
  }
  /// Says whether the valid ones of these, at least two, are distinct corners of one tetrahedron.
  [[nodiscard]] bool has(std::array<VertexId, 4> vertices) const {
    std::sort(vertices.begin(), vertices.end());
    return parts_.count(vertices) > 0;
  }
  [[nodiscard]] bool has_positive(VertexId p, VertexId q, VertexId r, VertexId s) const {
    return std::max({p, q, r, s}).valid() && has({p, q, r, s}) &&
           orientation(mesh_.position(p), mesh_.position(q), mesh_.position(r), mesh_.position(s)) == Sign::positive;
  }

 private:
  /// A part, and the parts with one vertex less.
  void add(const std::array<VertexId, 4>& part) {
    if (!part[1].valid() || !parts_.insert(part).second) return;
    for (std::size_t k = 0; k < 4 && part[k].valid(); ++k) {
      std::array<VertexId, 4> face = part;
      face[k] = VertexId();
      std::sort(face.begin(), face.end());
      add(face);
    }
  }

  const TetMesh& mesh_;
  std::set<std::array<VertexId, 4>> parts_;  ///< sorted; invalid ids are last
};

bool is_of(const Parts& parts, const WeightConstraint& c) {
  switch (c.kind) {
    case Kind::crossing:
      return std::max(c.p, c.q).valid() && parts.has({c.p, c.q, VertexId(), VertexId()}) && !c.r.valid() &&
             !c.s.valid() && !c.t.valid();
    case Kind::height:
      return std::max({c.p, c.q, c.r}).valid() && parts.has({c.p, c.q, c.r, VertexId()}) && !c.s.valid() &&
             !c.t.valid();
    case Kind::height_over_face:
      return parts.has_positive(c.p, c.q, c.r, c.s) && !c.t.valid();
    case Kind::dual_of_face:
      return parts.has_positive(c.p, c.q, c.r, c.s) && parts.has_positive(c.p, c.r, c.q, c.t);
    case Kind::dual:
    case Kind::equal_crossing:
      return false;
  }
  return false;
}

/// The faces of the surface and of interfaces between regions, and their edges.
class Surface {
 public:
  Surface(const TetMesh& mesh, const Scale& scale) : mesh_(mesh), scale_(scale) {
    for (const HalffaceId h : mesh.halffaces()) {
      if (!mesh.bounds_region(h) || !mesh.is_face_representative(h)) continue;
      const auto [a, b, c] = mesh.vertices(h);
      thirds_[sorted(a, b)].push_back(c);
      thirds_[sorted(b, c)].push_back(a);
      thirds_[sorted(c, a)].push_back(b);
    }
  }
  /// Says whether the constraint of coefficients or distances is one of the surface, if it is about it.
  [[nodiscard]] bool has(const WeightConstraint& c) const {
    if (c.kind == Kind::dual_of_face) return true;
    const auto at = thirds_.find(sorted(c.p, c.q));
    if (at == thirds_.end()) return false;
    const std::vector<VertexId>& thirds = at->second;
    const bool has_r = std::find(thirds.begin(), thirds.end(), c.r) != thirds.end();
    if (c.kind == Kind::height_over_face) return has_r;
    const bool flat = thirds.size() == 2 && are_flat(c.p, c.q, thirds[0], thirds[1]);
    if (c.kind == Kind::height) return has_r && !flat && !c.s.valid() && !c.t.valid();
    return has_r && flat && c.s != c.r && (c.s == thirds[0] || c.s == thirds[1]) && !c.t.valid();
  }

 private:
  static std::array<VertexId, 2> sorted(VertexId a, VertexId b) { return {std::min(a, b), std::max(a, b)}; }

  /// kFlatCosineSquared, by exact numbers.
  [[nodiscard]] bool are_flat(VertexId p, VertexId q, VertexId r, VertexId s) const {
    constexpr double kCosineSquared = 127.0 / 128;
    const Vector3 pq = vector_between(mesh_, scale_, p, q);
    const Vector3 up = cross(pq, vector_between(mesh_, scale_, p, r)),
                  down = cross(vector_between(mesh_, scale_, p, s), pq);
    const Number both = dot(up, down);
    return both.sign() == Sign::positive &&
           (both * both - Number(kCosineSquared) * (dot(up, up) * dot(down, down))).sign() != Sign::negative;
  }

  const TetMesh& mesh_;
  const Scale& scale_;
  std::map<std::array<VertexId, 2>, std::vector<VertexId>> thirds_;  ///< the third corners of the faces at each edge
};

/// The edges of interface faces.
class SeamEdges {
 public:
  SeamEdges() = default;
  explicit SeamEdges(const MetricMesh& pieces) {
    for (const SeamFace& seam : seams_of(pieces)) {
      const auto [one, other] = corners_of(pieces, seam);
      for (std::size_t i = 0; i < 3; ++i) {
        for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3}) {
          same_.insert({one[i], one[j], other[i], other[j]});
          same_.insert({other[i], other[j], one[i], one[j]});
          tetrahedra_.try_emplace({one[i], one[j]}, pieces.mesh.corners(TetMesh::tetrahedron(seam.one)));
          tetrahedra_.try_emplace({other[i], other[j]}, pieces.mesh.corners(TetMesh::tetrahedron(seam.other)));
        }
      }
    }
  }
  /// Says whether c is the equation of one of them.
  [[nodiscard]] bool has(const WeightConstraint& c) const {
    return same_.count({c.p, c.q, c.r, c.s}) > 0 && !c.t.valid();
  }
  /// The corners of a tetrahedron at such an edge; none if ab is not one.
  [[nodiscard]] std::span<const VertexId> corners_at(VertexId a, VertexId b) const {
    const auto found = tetrahedra_.find({a, b});
    return found == tetrahedra_.end() ? std::span<const VertexId>() : found->second;
  }

 private:
  std::set<std::array<VertexId, 4>> same_;  ///< p, q, r, s: rs is pq on the other side
  std::map<std::array<VertexId, 2>, std::array<VertexId, 4>> tetrahedra_;
};

/// Says whether the terms are constraints of the mesh.
bool are_of(const TetMesh& mesh, const SeamEdges& seams, const Certificate& certificate, const Scale& scale) {
  const Parts parts(mesh, certificate);
  const auto is_one = [&](const auto& term) {
    const WeightConstraint& c = term.constraint;
    return counts(certificate.constraints, c.kind) &&
           (c.kind == Kind::equal_crossing ? seams.has(c) : c.kind == Kind::dual || is_of(parts, c));
  };
  if (!std::all_of(certificate.terms.begin(), certificate.terms.end(), is_one)) return false;
  if (!assumes_reach(certificate.constraints) || certificate.constraints == Constraints::regular) return true;
  const Surface surface(mesh, scale);
  return std::all_of(certificate.terms.begin(), certificate.terms.end(), [&](const auto& term) {
    return term.constraint.kind == Kind::equal_crossing || surface.has(term.constraint);
  });
}

/// The terms of the sum.
class TetTerms : public WeightDifferences {
 public:
  static constexpr Kind kInnerDual = Kind::dual_of_face;

  TetTerms(const TetMesh& mesh, const SeamEdges& seams, const Scale& scale, Constraints constraints)
      : mesh_(mesh), seams_(seams), scale_(scale), constraints_(constraints) {}

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double margin) const {
    const Vector3 q = from_to(c.p, c.q);
    if (c.kind == Kind::crossing) return polynomial_of_crossing(q, margin);
    if (c.kind == Kind::equal_crossing) return polynomial_of_equal_crossing(q, from_to(c.r, c.s));
    const Vector3 r = from_to(c.p, c.r);
    Polynomial n = c.kind == Kind::height         ? polynomial_of_height(q, r, from_to(c.q, c.r))
                   : c.kind == Kind::dual_of_face ? dual_of_face(q, r, from_to(c.p, c.s), from_to(c.p, c.t))
                                                  : height_over_face(q, r, from_to(c.p, c.s));
    const double m = margin == 0 ? 0 : m_of(c);
    if (m >= kLeastM) n.constant += -(Number(margin) * Number(m));
    return n;
  }
  /// b of an edge of a cell with these other corners. Where all orthocenters are inside, the difference of the weights
  /// is linear in the orthocenter, and so greatest at a corner.
  [[nodiscard]] std::optional<Number> bound(VertexId a, VertexId b, std::span<const VertexId> others) const {
    Number most = squared_distance(a, b);
    if (assumes_reach(constraints_)) return Number(kWeightReach) * most;
    if (constraints_ == Constraints::completely_well_centered) return most;
    if (others.empty()) others = seams_.corners_at(a, b);  // an equation names the edge alone
    for (const VertexId v : others) {
      if (v == a || v == b) continue;
      Number across = abs(squared_distance(a, v) - squared_distance(b, v));
      if ((across - most).sign() == Sign::positive) most = std::move(across);
    }
    return most;
  }

 private:
  /// Σ λ_v at_v for the vertices after p.
  template <std::size_t n>
  static Polynomial sum_of_lifts(const std::array<Vector3, n>& to, const std::array<Number, n>& at) {
    Polynomial sum;
    for (std::size_t k = 0; k < n; ++k) {
      sum.coefficients[0] += at[k];
      sum.coefficients[k + 1] = -at[k];
      sum.constant += dot(to[k], to[k]) * at[k];
    }
    return sum;
  }
  static Polynomial height_over_face(const Vector3& q, const Vector3& r, const Vector3& s) {
    const Vector3 n = cross(q, r);
    return sum_of_lifts<3>({q, r, s}, {dot(n, cross(r, s)), dot(n, cross(s, q)), dot(n, n)});
  }
  static Polynomial dual_of_face(const Vector3& q, const Vector3& r, const Vector3& s, const Vector3& t) {
    const Vector3 n = cross(q, r), st = cross(s, t);
    return sum_of_lifts<4>({q, r, s, t}, {-dot(r, st), dot(q, st), -dot(n, t), dot(n, s)});
  }
  [[nodiscard]] double m_of(const WeightConstraint& c) const {
    const Vec3 p = at(c.p), pq = at(c.q) - p, n = temper::cross(pq, at(c.r) - p);
    const double twice_area = length(n), side = std::sqrt(2 / std::numbers::sqrt3 * twice_area);
    if (c.kind == Kind::height) return 2 * squared_length(pq) * twice_area;
    const double volumes = std::abs(temper::dot(n, at(c.s) - p));
    if (c.kind == Kind::height_over_face) return 2 * side * twice_area * volumes;
    return 2 * side * volumes * std::abs(temper::dot(n, at(c.t) - p)) / twice_area;
  }
  [[nodiscard]] Vec3 at(VertexId v) const { return place_of(mesh_, scale_, v); }
  [[nodiscard]] Vector3 from_to(VertexId a, VertexId b) const { return vector_between(mesh_, scale_, a, b); }
  [[nodiscard]] Number squared_distance(VertexId a, VertexId b) const {
    const Vector3 edge = from_to(a, b);
    return dot(edge, edge);
  }

  const TetMesh& mesh_;
  const SeamEdges& seams_;
  const Scale& scale_;
  Constraints constraints_;
};

CertificateCheck check_with(const TetMesh& mesh, const SeamEdges& seams, const Certificate& certificate) {
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  const auto position = [&](VertexId v) { return v.index < mesh.n_vertices() ? mesh.position(v) : Vec3{}; };
  const Scale scale = scale_of(certificate, kDegrees, kLeastCoordinate, position);
  if (!are_of(mesh, seams, certificate, scale)) return CertificateCheck::not_of_this_mesh;
  return check_sum(TetTerms(mesh, seams, scale, certificate.constraints), certificate, scale);
}

}  // namespace

CertificateCheck check_certificate(const TetMesh& mesh, const Certificate& certificate) {
  return check_with(mesh, SeamEdges(), certificate);
}

CertificateCheck check_certificate(const MetricMesh& pieces, const Certificate& certificate) {
  return check_with(pieces.mesh, SeamEdges(pieces), certificate);
}

}  // namespace temper::tets

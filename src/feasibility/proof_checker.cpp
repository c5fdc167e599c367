#include "feasibility/proof_checker.hpp"

#include <array>
#include <map>

#include "base/box.hpp"
#include "feasibility/certificate_sum.hpp"
#include "temper/feasibility.hpp"

namespace temper {
namespace {

using namespace certified;

/// The terms of a lemma. Weights of vertices that see each other differ by less than a bound: along the segment pq the
/// gradient of the lifted function is twice an orthocenter, and orthocenters lie in their triangles. So w_q − w_p is a
/// mean of |oq|² − |op|² = (q − p)·(p + q − 2 o) over points o in the domain. With crossings the bound is |pq|².
class LemmaTerms : public WeightDifferences {
 public:
  LemmaTerms(const Mesh& mesh, const Scale& scale, Constraints constraints)
      : mesh_(mesh), scale_(scale), constraints_(constraints) {
    PlaneBox box;
    for (const VertexId v : mesh.vertices()) box.add(mesh.position(v));
    const Vec2 size = box.high - box.low;
    size_ = {scale.coordinate(size.x), scale.coordinate(size.y)};
  }

  [[nodiscard]] Polynomial polynomial_of(const WeightConstraint& c, double /*margin*/) const {
    const Vector2 pq = from_to(c.p, c.q);
    if (c.kind == Kind::crossing) return polynomial_of_crossing(pq, 0);
    return polynomial_of_height(pq, from_to(c.p, c.r), from_to(c.q, c.r));
  }
  [[nodiscard]] std::optional<Number> bound(VertexId a, VertexId b, std::span<const VertexId> /*others*/) const {
    const Vector2 ab = from_to(a, b);
    if (constraints_ == Constraints::well_centered) return dot(ab, ab);
    const auto length = [](const Number& x) { return std::abs(x.approximation()); };
    return Number(2 * (length(ab.x) * size_.x + length(ab.y) * size_.y) * kRoundedUp);
  }

 private:
  [[nodiscard]] Vec2 at(VertexId v) const {
    const Vec2 p = mesh_.position(v);
    return {scale_.coordinate(p.x), scale_.coordinate(p.y)};
  }
  [[nodiscard]] Vector2 from_to(VertexId a, VertexId b) const { return difference(at(b), at(a)); }

  const Mesh& mesh_;
  const Scale& scale_;
  Constraints constraints_;
  Vec2 size_;  ///< of the box of all vertices
};

}  // namespace

bool ProofChecker::has(const Lemma& lemma, VertexId a, VertexId b) const {
  if (sight_.must_be_edge(a, b)) return true;
  return std::find(lemma.edges.begin(), lemma.edges.end(), edge_between(a, b)) != lemma.edges.end();
}

bool ProofChecker::is_crossed(const Lemma& lemma, VertexId a, VertexId b) const {
  return std::any_of(lemma.edges.begin(), lemma.edges.end(), [&](const ProofEdge& e) {
    return sight_.can_be_edge(e[0], e[1]) && sight_.cross(a, b, e[0], e[1]);
  });
}

/// Says whether all triangulations with the lemma's edges keep the constraint.
bool ProofChecker::is_of(const Lemma& lemma, const WeightConstraint& c) const {
  if (c.t.valid() || c.s.valid()) return false;
  const auto is_vertex = [&](VertexId v) { return v.index < mesh_.n_vertices(); };
  if (!is_vertex(c.p) || !is_vertex(c.q) || c.p == c.q) return false;
  if (c.kind == Kind::crossing) {
    return constraints_ == Constraints::well_centered && !c.r.valid() && sight_.see_each_other(c.p, c.q);
  }
  return c.kind == Kind::height && is_vertex(c.r) && has(lemma, c.p, c.q) && sight_.holds_triangle(c.p, c.q, c.r);
}

CertificateCheck ProofChecker::check_sum_of(const Lemma& lemma) const {
  Certificate certificate;
  certificate.constraints = constraints_;
  certificate.terms = lemma.terms;
  if (!has_good_multipliers(certificate)) return CertificateCheck::bad_multiplier;
  for (const auto& term : lemma.terms) {
    if (!is_of(lemma, term.constraint)) return CertificateCheck::not_of_this_mesh;
  }
  const Scale scale = scale_of(certificate, {4, 2, 4}, kLeastInPlane, [&](VertexId v) {
    const Vec2 p = mesh_.position(v);
    return Vec3{p.x, p.y, 0};
  });
  return check_sum(LemmaTerms(mesh_, scale, constraints_), certificate, scale);
}

CertificateCheck ProofChecker::check_cases(const Lemma& lemma, std::span<const Lemma> earlier) const {
  const VertexId a = lemma.side[0], b = lemma.side[1];
  if (std::max(a, b).index >= mesh_.n_vertices() || a == b || !has(lemma, a, b))
    return CertificateCheck::not_of_this_mesh;
  const bool is_outside = mesh_.find_halfedge(b, a).valid() && !mesh_.find_halfedge(a, b).valid();
  if (is_outside) return CertificateCheck::not_of_this_mesh;
  for (const VertexId x : mesh_.vertices()) {
    if (x == a || x == b || !sight_.can_be_triangle(a, b, x)) continue;
    if (is_crossed(lemma, a, x) || is_crossed(lemma, b, x)) continue;
    const auto at =
        std::find_if(lemma.cases.begin(), lemma.cases.end(), [&](const Lemma::Case& c) { return c.apex == x; });
    if (at == lemma.cases.end() || at->lemma >= earlier.size()) return CertificateCheck::proves_nothing;
    const std::vector<ProofEdge>& edges = earlier[at->lemma].edges;
    const bool applies = std::all_of(edges.begin(), edges.end(), [&](const ProofEdge& e) {
      return e == edge_between(a, x) || e == edge_between(b, x) || has(lemma, e[0], e[1]);
    });
    if (!applies) return CertificateCheck::proves_nothing;
  }
  return CertificateCheck::proves;
}

CertificateCheck ProofChecker::check(const Lemma& lemma, std::span<const Lemma> earlier) const {
  for (const ProofEdge& e : lemma.edges) {
    const bool are_vertices = e[0] < e[1] && e[1].index < mesh_.n_vertices();
    if (!are_vertices || !sight_.can_be_edge(e[0], e[1])) return CertificateCheck::not_of_this_mesh;
  }
  return lemma.terms.empty() ? check_cases(lemma, earlier) : check_sum_of(lemma);
}

CertificateCheck check_proof(const Mesh& mesh, const ConnectivityProof& proof) {
  const bool has_proofs =
      proof.constraints == Constraints::well_centered || proof.constraints == Constraints::heights_only;
  if (!has_proofs || mesh.n_vertices() > kMostVerticesOfCompleteSearch) return CertificateCheck::not_of_this_mesh;
  const Sight sight(mesh);
  const ProofChecker checker(mesh, sight, proof.constraints);
  for (std::size_t i = 0; i < proof.lemmas.size(); ++i) {
    const CertificateCheck check = checker.check(proof.lemmas[i], std::span(proof.lemmas).first(i));
    if (check != CertificateCheck::proves) return check;
  }
  const bool is_whole = !proof.lemmas.empty() && proof.lemmas.back().edges.empty();
  return is_whole ? CertificateCheck::proves : CertificateCheck::proves_nothing;
}

}  // namespace temper

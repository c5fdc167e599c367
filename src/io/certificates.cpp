#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>

#include "io/text/failure.hpp"
#include "temper/detail/certificate_io.hpp"
#include "temper/tets/weights.hpp"

namespace temper::io {
namespace {

using Json = nlohmann::ordered_json;
using TermKind = WeightConstraint::Kind;

constexpr int kCertificateVersion = 1;

/// Reads members; errors name the wrong member of the wrong term.
class CertificateReader {
 public:
  CertificateReader(std::string where, const VertexOfPoint& vertex_of_point, std::string_view cell)
      : file_(std::move(where)), vertex_of_point_(vertex_of_point), cell_(cell) {}

  AnyCertificate read(const Json& json) {
    if (!json.is_object() || !json.contains("temper_certificate")) {
      fail("expected a certificate of temper weights, found no \"temper_certificate\"");
    }
    if (json["temper_certificate"] != kCertificateVersion) {
      fail("expected version ", kCertificateVersion, " of \"temper_certificate\", found ",
           json["temper_certificate"].dump());
    }
    if (json.contains("goal"))
      fail("it is about the best weights, and temper checks proofs that there are none. Next: bench/check_best.py");
    if (json.contains("lemmas")) return read_proof(json);
    Certificate certificate;
    certificate.margin = number(json, "margin");
    if (json.contains("constraints")) certificate.constraints = constraints(json["constraints"]);
    certificate.terms = read_terms(json);
    return certificate;
  }

 private:
  template <class... Parts>
  [[noreturn]] void fail(const Parts&... message) const {
    io::fail(ErrorCode::syntax, file_, where_, message...);
  }
  const Json& member(const Json& json, const char* key) const {
    if (!json.is_object() || !json.contains(key)) fail("there is no \"", key, "\"");
    return json[key];
  }
  double number(const Json& json, const char* key) const {
    const Json& value = member(json, key);
    if (!value.is_number()) fail("expected \"", key, "\" to be a number, found ", value.dump());
    return value.get<double>();
  }
  Constraints constraints(const Json& value) const {
    std::string names;
    for (const auto& rows : {constraints_table(), tets::constraints_table()}) {
      for (const ConstraintsInfo& row : rows) {
        if (value == row.name) return row.constraints;
        if (names.find(row.name) == std::string::npos) names += (names.empty() ? "" : ", ") + std::string(row.name);
      }
    }
    fail("expected \"constraints\" to be one of ", names, ", found ", value.dump());
  }
  VertexId vertex(const Json& value) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= vertex_of_point_.size()) {
      fail("expected a point, 0 to ", vertex_of_point_.size() - 1, ", found ", value.dump());
    }
    const std::int32_t v = vertex_of_point_[value.get<std::size_t>()];
    if (v < 0) fail("point ", value.dump(), " is in no ", cell_);
    return VertexId(static_cast<std::size_t>(v));
  }
  template <std::size_t n>
  std::array<VertexId, n> vertices(const Json& json, const char* key) const {
    const Json& list = member(json, key);
    if (!list.is_array() || list.size() != n) fail("expected \"", key, "\" to be ", n, " points");
    std::array<VertexId, n> result;
    for (std::size_t i = 0; i < n; ++i) result[i] = vertex(list[i]);
    return result;
  }
  const Json& array(const Json& json, const char* key) const {
    const Json& list = member(json, key);
    if (!list.is_array()) fail("expected \"", key, "\" to be an array");
    return list;
  }
  std::vector<Certificate::Term> read_terms(const Json& json) {
    std::vector<Certificate::Term> terms;
    const std::string before = where_;
    for (const Json& term : array(json, "terms")) {
      where_ = text(before, "term ", terms.size(), ": ");
      terms.push_back(read_term(term));
    }
    where_ = before;
    return terms;
  }
  ConnectivityProof read_proof(const Json& json) {
    ConnectivityProof proof;
    if (json.contains("constraints")) proof.constraints = constraints(json["constraints"]);
    for (const Json& lemma : array(json, "lemmas")) {
      where_ = text("lemma ", proof.lemmas.size(), ": ");
      proof.lemmas.push_back(read_lemma(lemma));
    }
    return proof;
  }
  ConnectivityProof::Lemma read_lemma(const Json& json) {
    ConnectivityProof::Lemma lemma;
    for (const Json& edge : array(json, "edges")) {
      if (!edge.is_array() || edge.size() != 2) fail("expected an edge to be 2 points");
      const VertexId a = vertex(edge[0]), b = vertex(edge[1]);
      lemma.edges.push_back({std::min(a, b), std::max(a, b)});
    }
    if (json.contains("terms")) {
      lemma.terms = read_terms(json);
      return lemma;
    }
    lemma.side = vertices<2>(json, "side");
    for (const Json& apex : array(json, "cases")) {
      const Json& number_of_lemma = member(apex, "lemma");
      if (!number_of_lemma.is_number_unsigned()) fail("expected \"lemma\" to be the number of a lemma");
      lemma.cases.push_back({vertex(member(apex, "apex")), number_of_lemma.get<std::size_t>()});
    }
    return lemma;
  }
  Certificate::Term read_term(const Json& json) const {
    const Json& kind = member(json, "kind");
    const double multiplier = number(json, "multiplier");
    if (kind == "height_over_face" || kind == "dual_of_face") {
      const auto [p, q, r] = vertices<3>(json, "face");
      const VertexId s = remaining(vertices<4>(json, "tetrahedron"), {p, q, r}, "tetrahedron");
      if (kind == "height_over_face") return {{TermKind::height_over_face, p, q, r, s}, multiplier};
      return {{TermKind::dual_of_face, p, q, r, s, vertex(member(json, "across"))}, multiplier};
    }
    const auto [p, q] = vertices<2>(json, "edge");
    if (kind == "crossing") return {{TermKind::crossing, p, q, VertexId()}, multiplier};
    if (kind == "equal_crossing") {
      const auto [r, s] = vertices<2>(json, "across");
      return {{TermKind::equal_crossing, p, q, r, s}, multiplier};
    }
    if (kind != "height" && kind != "dual") {
      fail(
          "expected \"kind\" to be \"height\", \"crossing\", \"dual\", \"height_over_face\", \"dual_of_face\" or "
          "\"equal_crossing\", found ",
          kind.dump());
    }
    const VertexId r = remaining(vertices<3>(json, "triangle"), {p, q}, "triangle");
    if (kind == "height") return {{TermKind::height, p, q, r}, multiplier};
    return {{TermKind::dual, p, q, r, vertex(member(json, "across"))}, multiplier};
  }
  /// The corner that is none of the others.
  VertexId remaining(std::span<const VertexId> corners, std::initializer_list<VertexId> others, const char* key) const {
    for (const VertexId v : corners) {
      if (std::find(others.begin(), others.end(), v) == others.end()) return v;
    }
    fail("\"", key, "\" has no ", others.size() == 2 ? "third" : "fourth", " corner");
  }

  std::string file_, where_;  // the file, and the part of it
  const VertexOfPoint& vertex_of_point_;
  std::string_view cell_;
};

Json constraint_json(const WeightConstraint& constraint, std::span<const std::size_t> points) {
  const auto point = [&](VertexId v) { return points.empty() ? std::size_t{v.index} : points[v.index]; };
  const auto& [kind, p, q, r, s, t] = constraint;
  const bool of_face = kind == TermKind::height_over_face || kind == TermKind::dual_of_face;
  Json json;
  json["kind"] = name(kind);
  if (kind == TermKind::equal_crossing) {
    json["edge"] = {point(p), point(q)};
    json["across"] = {point(r), point(s)};
    return json;
  }
  if (of_face) {
    json["tetrahedron"] = {point(p), point(q), point(r), point(s)};
  } else if (kind != TermKind::crossing) {
    json["triangle"] = {point(p), point(q), point(r)};
  }
  if (kind == TermKind::dual || kind == TermKind::dual_of_face) json["across"] = point(of_face ? t : s);
  if (of_face) {
    json["face"] = {point(p), point(q), point(r)};
  } else {
    json["edge"] = {point(p), point(q)};
  }
  return json;
}

Json terms_json(const std::vector<Certificate::Term>& terms, std::span<const std::size_t> points) {
  Json json = Json::array();
  for (const auto& [constraint, multiplier] : terms) {
    json.push_back(constraint_json(constraint, points));
    json.back()["multiplier"] = multiplier;
  }
  return json;
}

/// The copies whose numbers the terms have.
Json copies_json(const std::vector<Certificate::Term>& terms, std::span<const std::size_t> points,
                 std::span<const CopyOfPoint> copies) {
  std::set<std::size_t> used;
  for (const auto& [c, multiplier] : terms) {
    for (const VertexId v : {c.p, c.q, c.r, c.s, c.t}) {
      if (v.valid()) used.insert(points.empty() ? std::size_t{v.index} : points[v.index]);
    }
  }
  Json json = Json::array();
  for (const CopyOfPoint& copy : copies) {
    if (used.contains(copy.number)) json.push_back({copy.number, copy.point, copy.cell});
  }
  return json;
}

}  // namespace

std::string certificate_to_json(const Certificate& certificate, std::span<const std::size_t> points,
                                std::span<const CopyOfPoint> copies) {
  Json json = {{"temper_certificate", kCertificateVersion},
               {"constraints", name(certificate.constraints)},
               {"margin", certificate.margin}};
  if (Json used = copies_json(certificate.terms, points, copies); !used.empty()) json["copies"] = std::move(used);
  json["terms"] = terms_json(certificate.terms, points);
  return json.dump(2) + "\n";
}

std::string optimality_to_json(const WeightReport& report, const Space& space, std::span<const std::size_t> points) {
  const Optimality& proof = *report.optimality;
  Json json = {{"temper_certificate", kCertificateVersion},
               {"constraints", name(proof.constraints)},
               {"margin", proof.margin},
               {"goal", proof.goal == WeightGoal::center ? "center" : "accuracy"},
               {"objective", proof.objective},
               {"gap", proof.gap}};
  if (space.radius() > 0) {
    json["radius"] = space.radius();
    json["weights"] = Json::array();
    for (std::size_t i = 0; i < report.weights.size(); ++i)
      json["weights"].push_back({points.empty() ? i : points[i], report.weights[VertexId(i)]});
  }
  if (space.is_periodic()) json["period"] = {space.period().x, space.period().y};
  if (!proof.offsets.empty()) json["offsets"] = Json::array();
  for (const OffsetTerm& term : proof.offsets) {
    Json offset = constraint_json(term.at, points);
    offset["factor"] = term.factor;
    offset["target"] = term.target;
    json["offsets"].push_back(std::move(offset));
  }
  json["terms"] = terms_json(proof.terms, points);
  return json.dump(1) + "\n";
}

std::string certificate_to_json(const ConnectivityProof& proof, std::span<const std::size_t> points) {
  const auto point = [&](VertexId v) { return points.empty() ? std::size_t{v.index} : points[v.index]; };
  const auto edge = [&](const ConnectivityProof::Edge& e) { return Json::array({point(e[0]), point(e[1])}); };
  std::string lemmas;  // a line each: there may be thousands
  for (const ConnectivityProof::Lemma& lemma : proof.lemmas) {
    Json json;
    json["edges"] = Json::array();
    for (const ConnectivityProof::Edge& e : lemma.edges) json["edges"].push_back(edge(e));
    if (!lemma.terms.empty()) {
      json["terms"] = terms_json(lemma.terms, points);
    } else {
      json["side"] = edge(lemma.side);
      json["cases"] = Json::array();
      for (const auto& [apex, number] : lemma.cases) {
        json["cases"].push_back({{"apex", point(apex)}, {"lemma", number}});
      }
    }
    lemmas += (lemmas.empty() ? "\n  " : ",\n  ") + json.dump();
  }
  return text("{\"temper_certificate\": ", kCertificateVersion, ", \"constraints\": \"", name(proof.constraints),
              "\", \"lemmas\": [", lemmas, "\n]}\n");
}

Expected<AnyCertificate> certificate_from_json(std::string_view text, const VertexOfPoint& vertex_of_point,
                                               const std::string& where, std::string_view cell) {
  return guarded<AnyCertificate>(where, [&] {
    if (is_too_deep(text)) fail(ErrorCode::syntax, where, "nested more than ", kDeepestJson, " deep");
    Json json;
    try {
      json = Json::parse(text);
    } catch (const Json::parse_error& error) {
      fail(ErrorCode::syntax, where, "not JSON: byte ", error.byte);
    } catch (const Json::out_of_range&) {
      fail(ErrorCode::syntax, where, "holds a number beyond what a double can hold");
    }
    return CertificateReader(where, vertex_of_point, cell).read(json);
  });
}

bool is_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kDeepestJson) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

}  // namespace temper::io

#include "files/certificate_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "exit.hpp"
#include "files/input.hpp"
#include "temper/tets/weights.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;
using Kind = WeightConstraint::Kind;

constexpr int kVersion = 1;

std::string text_of(const std::string& path) {
  std::ifstream file = open_text(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!text) throw Failure(Exit::bad_input, path + ": cannot be read, or empty");
  return text.str();
}

/// Reads members; errors name the wrong member of the wrong term.
class Reader {
 public:
  Reader(std::string path, const io::VertexOfPoint& vertex_of_point, std::string_view cell)
      : path_(std::move(path)), vertex_of_point_(vertex_of_point), cell_(cell) {}

  AnyCertificate read(const Json& json) {
    if (!json.is_object() || !json.contains("temper_certificate")) {
      fail("expected a certificate of temper weights, found no \"temper_certificate\"");
    }
    if (json["temper_certificate"] != kVersion) {
      fail(fmt::format("expected version {} of \"temper_certificate\", found {}", kVersion,
                       json["temper_certificate"].dump()));
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
  [[noreturn]] void fail(const std::string& message) const {
    throw Failure(Exit::bad_input, fmt::format("{}: {}{}", path_, where_, message));
  }
  const Json& member(const Json& json, const char* key) const {
    if (!json.is_object() || !json.contains(key)) fail(fmt::format("there is no \"{}\"", key));
    return json[key];
  }
  double number(const Json& json, const char* key) const {
    const Json& value = member(json, key);
    if (!value.is_number()) fail(fmt::format("expected \"{}\" to be a number, found {}", key, value.dump()));
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
    fail(fmt::format("expected \"constraints\" to be one of {}, found {}", names, value.dump()));
  }
  VertexId vertex(const Json& value) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= vertex_of_point_.size()) {
      fail(fmt::format("expected a point, 0 to {}, found {}", vertex_of_point_.size() - 1, value.dump()));
    }
    const std::int32_t v = vertex_of_point_[value.get<std::size_t>()];
    if (v < 0) fail(fmt::format("point {} is in no {}", value.dump(), cell_));
    return VertexId(static_cast<std::size_t>(v));
  }
  template <std::size_t n>
  std::array<VertexId, n> vertices(const Json& json, const char* key) const {
    const Json& list = member(json, key);
    if (!list.is_array() || list.size() != n) fail(fmt::format("expected \"{}\" to be {} points", key, n));
    std::array<VertexId, n> result;
    for (std::size_t i = 0; i < n; ++i) result[i] = vertex(list[i]);
    return result;
  }
  const Json& array(const Json& json, const char* key) const {
    const Json& list = member(json, key);
    if (!list.is_array()) fail(fmt::format("expected \"{}\" to be an array", key));
    return list;
  }
  std::vector<Certificate::Term> read_terms(const Json& json) {
    std::vector<Certificate::Term> terms;
    const std::string before = where_;
    for (const Json& term : array(json, "terms")) {
      where_ = fmt::format("{}term {}: ", before, terms.size());
      terms.push_back(read_term(term));
    }
    where_ = before;
    return terms;
  }
  ConnectivityProof read_proof(const Json& json) {
    ConnectivityProof proof;
    if (json.contains("constraints")) proof.constraints = constraints(json["constraints"]);
    for (const Json& lemma : array(json, "lemmas")) {
      where_ = fmt::format("lemma {}: ", proof.lemmas.size());
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
      if (kind == "height_over_face") return {{Kind::height_over_face, p, q, r, s}, multiplier};
      return {{Kind::dual_of_face, p, q, r, s, vertex(member(json, "across"))}, multiplier};
    }
    const auto [p, q] = vertices<2>(json, "edge");
    if (kind == "crossing") return {{Kind::crossing, p, q, VertexId()}, multiplier};
    if (kind != "height" && kind != "dual") {
      fail(
          fmt::format("expected \"kind\" to be \"height\", \"crossing\", \"dual\", \"height_over_face\" or "
                      "\"dual_of_face\", found {}",
                      kind.dump()));
    }
    const VertexId r = remaining(vertices<3>(json, "triangle"), {p, q}, "triangle");
    if (kind == "height") return {{Kind::height, p, q, r}, multiplier};
    return {{Kind::dual, p, q, r, vertex(member(json, "across"))}, multiplier};
  }
  /// The corner that is none of the others.
  VertexId remaining(std::span<const VertexId> corners, std::initializer_list<VertexId> others, const char* key) const {
    for (const VertexId v : corners) {
      if (std::find(others.begin(), others.end(), v) == others.end()) return v;
    }
    fail(fmt::format("\"{}\" has no {} corner", key, others.size() == 2 ? "third" : "fourth"));
  }

  std::string path_, where_;
  const io::VertexOfPoint& vertex_of_point_;
  std::string_view cell_;
};

}  // namespace

namespace {

Json constraint_json(const WeightConstraint& constraint, const std::vector<std::size_t>& points) {
  const auto point = [&](VertexId v) { return points.empty() ? std::size_t{v.index} : points[v.index]; };
  const auto& [kind, p, q, r, s, t] = constraint;
  const bool of_face = kind == Kind::height_over_face || kind == Kind::dual_of_face;
  Json json;
  json["kind"] = name(kind);
  if (of_face) {
    json["tetrahedron"] = {point(p), point(q), point(r), point(s)};
  } else if (kind != Kind::crossing) {
    json["triangle"] = {point(p), point(q), point(r)};
  }
  if (kind == Kind::dual || kind == Kind::dual_of_face) json["across"] = point(of_face ? t : s);
  if (of_face) {
    json["face"] = {point(p), point(q), point(r)};
  } else {
    json["edge"] = {point(p), point(q)};
  }
  return json;
}

Json terms_json(const std::vector<Certificate::Term>& terms, const std::vector<std::size_t>& points) {
  Json json = Json::array();
  for (const auto& [constraint, multiplier] : terms) {
    json.push_back(constraint_json(constraint, points));
    json.back()["multiplier"] = multiplier;
  }
  return json;
}

}  // namespace

Json certificate_json(const Certificate& certificate, const std::vector<std::size_t>& points) {
  return {{"temper_certificate", kVersion},
          {"constraints", name(certificate.constraints)},
          {"margin", certificate.margin},
          {"terms", terms_json(certificate.terms, points)}};
}

std::string optimality_text(const WeightReport& report, const Space& space, const std::vector<std::size_t>& points) {
  const Optimality& proof = *report.optimality;
  Json json = {{"temper_certificate", kVersion}, {"constraints", name(proof.constraints)},
               {"margin", proof.margin},         {"goal", proof.goal == WeightGoal::center ? "center" : "accuracy"},
               {"objective", proof.objective},   {"gap", proof.gap}};
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

std::string certificate_text(const Certificate& certificate, const std::vector<std::size_t>& points) {
  return certificate_json(certificate, points).dump(2) + "\n";
}

std::string proof_text(const ConnectivityProof& proof, const std::vector<std::size_t>& points) {
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
  return fmt::format("{{\"temper_certificate\": {}, \"constraints\": \"{}\", \"lemmas\": [{}\n]}}\n", kVersion,
                     name(proof.constraints), lemmas);
}

AnyCertificate read_certificate(const std::string& path, const io::VertexOfPoint& vertex_of_point,
                                std::string_view cell) {
  const std::string text = text_of(path);
  const auto fail = [&](const std::string& why) -> Failure { return {Exit::bad_input, path + ": " + why}; };
  if (is_too_deep(text)) throw fail(fmt::format("nested more than {} deep", kDeepestJson));
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw fail(fmt::format("not JSON: byte {}", error.byte));
  } catch (const Json::out_of_range&) {
    throw fail("holds a number beyond what a double can hold");
  }
  return Reader(path, vertex_of_point, cell).read(json);
}

}  // namespace temper::app

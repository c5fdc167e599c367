#include "files/certificate_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "exit.hpp"
#include "files/input.hpp"

namespace temper::app {
namespace {

using Json = nlohmann::ordered_json;
using Kind = WeightConstraint::Kind;

constexpr int kVersion = 1;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Failure(Exit::bad_input, fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  std::ostringstream text;
  text << file.rdbuf();
  if (!text) throw Failure(Exit::bad_input, path + ": cannot be read, or empty");
  return text.str();
}

/// Reads members; errors name the wrong member of the wrong term.
class Reader {
 public:
  Reader(std::string path, const Input& input) : path_(std::move(path)), input_(input) {}

  Certificate read(const Json& json) {
    if (!json.is_object() || !json.contains("temper_certificate")) {
      fail("expected a certificate of temper weights, found no \"temper_certificate\"");
    }
    if (json["temper_certificate"] != kVersion) {
      fail(fmt::format("expected version {} of \"temper_certificate\", found {}", kVersion,
                       json["temper_certificate"].dump()));
    }
    Certificate certificate;
    certificate.margin = number(json, "margin");
    if (json.contains("constraints")) certificate.constraints = constraints(json["constraints"]);
    const Json& terms = member(json, "terms");
    if (!terms.is_array()) fail("expected \"terms\" to be an array");
    for (const Json& term : terms) {
      where_ = fmt::format("term {}: ", certificate.terms.size());
      certificate.terms.push_back(read_term(term));
    }
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
    for (const ConstraintsInfo& row : constraints_table()) {
      if (value == row.name) return row.constraints;
      names += (names.empty() ? "" : ", ") + std::string(row.name);
    }
    fail(fmt::format("expected \"constraints\" to be one of {}, found {}", names, value.dump()));
  }
  VertexId vertex(const Json& value) const {
    const auto& vertex_of_point = input_.loaded.vertex_of_point;
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= vertex_of_point.size()) {
      fail(fmt::format("expected a point, 0 to {}, found {}", vertex_of_point.size() - 1, value.dump()));
    }
    const std::int32_t v = vertex_of_point[value.get<std::size_t>()];
    if (v < 0) fail(fmt::format("point {} is in no triangle", value.dump()));
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
  Certificate::Term read_term(const Json& json) const {
    const Json& kind = member(json, "kind");
    const auto [p, q] = vertices<2>(json, "edge");
    const double multiplier = number(json, "multiplier");
    if (kind == "crossing") return {{Kind::crossing, p, q, VertexId()}, multiplier};
    if (kind != "height" && kind != "dual") {
      fail(fmt::format("expected \"kind\" to be \"height\", \"crossing\" or \"dual\", found {}", kind.dump()));
    }
    for (const VertexId r : vertices<3>(json, "triangle")) {
      if (r == p || r == q) continue;
      if (kind == "height") return {{Kind::height, p, q, r}, multiplier};
      return {{Kind::dual, p, q, r, vertex(member(json, "across"))}, multiplier};
    }
    fail("\"triangle\" has no third corner");
  }

  std::string path_, where_;
  const Input& input_;
};

}  // namespace

Json certificate_json(const Certificate& certificate, const Input& input) {
  const auto point = [&](VertexId v) { return input.points.empty() ? std::size_t{v.index} : input.points[v.index]; };
  Json terms = Json::array();
  for (const auto& [constraint, multiplier] : certificate.terms) {
    const auto [kind, p, q, r, s, t] = constraint;
    Json term;
    term["kind"] = name(kind);
    if (kind != Kind::crossing) term["triangle"] = {point(p), point(q), point(r)};
    if (kind == Kind::dual) term["across"] = point(s);
    term["edge"] = {point(p), point(q)};
    term["multiplier"] = multiplier;
    terms.push_back(std::move(term));
  }
  return {{"temper_certificate", kVersion},
          {"constraints", name(certificate.constraints)},
          {"margin", certificate.margin},
          {"terms", std::move(terms)}};
}

std::string certificate_text(const Certificate& certificate, const Input& input) {
  return certificate_json(certificate, input).dump(2) + "\n";
}

Certificate read_certificate(const std::string& path, const Input& input) {
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
  return Reader(path, input).read(json);
}

}  // namespace temper::app

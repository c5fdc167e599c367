// See records.hpp.
#include "records.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <variant>

#include "temper/detail/optimize_table.hpp"
#include "temper/feasibility.hpp"

namespace temper::wasm {
namespace {

constexpr std::string_view kScales[] = {"absolute", "relative"};               // LengthScale
constexpr std::string_view kTreatments[] = {"as_is", "absolute", "mirrored"};  // BoundaryTreatment

/// The value of an enum by its name.
template <class Enum, std::size_t n>
Enum from_name(std::string_view option, std::string_view text, const std::string_view (&names)[n]) {
  const auto* found = std::find(std::begin(names), std::end(names), text);
  if (found != std::end(names)) return static_cast<Enum>(found - std::begin(names));
  std::string message(option);
  message += ": expected one of ";
  for (const std::string_view name : names) message += (&name == &names[0] ? "" : ", ") + std::string(name);
  fail(ErrorCode::invalid_option, message + "; found '" + std::string(text) + "'");
}

// --- options ------------------------------------------------------------------------------------------------------

/// Choices that are numbers: star: 1.
bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}
Json choice(std::string_view name) { return is_number(name) ? Json(std::stoi(std::string(name))) : Json(name); }

Json to_json(const LengthParameter& s) {
  return {{"value", number(s.value)}, {"scale", kScales[static_cast<std::size_t>(s.scale)]}};
}

Json to_json(const OptionValue& value) {
  return std::visit(
      [](const auto& v) -> Json {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, VertexId>) {
          return number(v);
        } else if constexpr (std::is_same_v<T, std::string_view>) {
          return choice(v);
        } else if constexpr (std::is_same_v<T, LengthParameter>) {
          return to_json(v);
        } else {
          return v;
        }
      },
      value);
}

/// The TypeScript type of an option, for errors.
std::string type_of(const OptionRow& row) {
  const auto plain = [&row]() -> std::string {
    switch (row.kind) {
      case OptionKind::length_parameter:
        return "LengthParameterLike";
      case OptionKind::choice: {
        std::string list;
        for (const std::string_view each : row.choices) list += (list.empty() ? "" : " | ") + choice(each).dump();
        return list;
      }
      default:
        return "number";
    }
  };
  return plain() + (row.optional ? " | null" : "");
}

/// Throws Json::exception when the type is wrong. `text` keeps the name of a choice.
OptionValue value_from(const OptionRow& row, const Json& given, std::string& text) {
  if (given.is_null()) return {};
  const auto whole = [&given] {
    if (given.is_number_integer()) return given.get<std::int64_t>();
    const double value = given.get<double>();
    const auto rounded = static_cast<std::int64_t>(value);
    if (static_cast<double>(rounded) != value) throw WrongType{};
    return rounded;
  };
  switch (row.kind) {
    case OptionKind::count:
      return whole();
    case OptionKind::number:
      if (!given.is_number()) throw WrongType{};
      return given.get<double>();
    case OptionKind::choice:
      text = given.is_number() ? std::to_string(whole()) : given.get<std::string>();
      return std::string_view(text);
    case OptionKind::length_parameter:
      return length_parameter_from(row.name, given);
    case OptionKind::vertex: {
      const std::int64_t v = whole();
      return v < 0 ? OptionValue(v) : OptionValue(VertexId(static_cast<std::size_t>(v)));
    }
  }
  return {};
}

/// Numbers that JSON has not come marked, as they go.
Json unmarked(const Json& given) {
  if (!given.is_string()) return given;
  for (const double special : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()}) {
    if (given == number(special)) return Json(special);
  }
  return given;
}

/// Throws WrongType if there is no such option, or if the value has another type.
void set_option(OptimizeOptions& options, const std::string& key, const Json& value) {
  const OptionRow* row = find_option(key);
  if (row == nullptr || !fits(row->cells, CellKinds::triangles)) throw WrongType{"there is no option " + key};
  std::string text;
  const auto wrong = [&] { return WrongType{key + ": expected " + type_of(*row) + ", found " + value.dump()}; };
  OptionValue taken;
  try {
    taken = value_from(*row, unmarked(value), text);
  } catch (const Json::exception&) {
    throw wrong();
  } catch (const WrongType&) {
    throw wrong();
  }
  if (const Expected<void> good = check_option(*row, taken); !good) throw BadInput{spelled(good.error())};
  row->set(options, taken);
}

// --- reports --------------------------------------------------------------------------------------------------------

Json to_json(const Certificate& certificate) {
  Json terms = Json::array();
  for (const auto& [c, multiplier] : certificate.terms) {
    const Json constraint = {
        {"kind", name(c.kind)}, {"p", number(c.p)}, {"q", number(c.q)}, {"r", number(c.r)}, {"s", number(c.s)}};
    terms.push_back({constraint, number(multiplier)});
  }
  return {{"margin", number(certificate.margin)}, {"terms", terms}, {"constraints", name(certificate.constraints)}};
}

/// Makes JSON of each kind of value.
struct Maker {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(bool value) const { return value; }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(double value) const { return number(value); }
  Json operator()(VertexId v) const { return number(v); }
  Json operator()(const Certificate* proof) const { return to_json(*proof); }
  Json operator()(const std::string& text) const { return text; }
  Json operator()(const NumberedText& text) const { return text.text; }
  Json operator()(const TextWithOptions& text) const { return spelled(text.text); }
  Json operator()(const ReportView& report) const { return json_of(report); }
  Json operator()(const FieldList& values) const {
    Json json = Json::array();
    for (const FieldValue& value : values.items) json.push_back(std::visit(*this, value.is));
    return json;
  }
  template <class T>
  Json operator()(std::span<const T> values) const {
    Json json = Json::array();
    for (const T& value : values) {
      if constexpr (std::is_same_v<T, std::size_t>)
        json.push_back(value);
      else
        json.push_back(number(value));
    }
    return json;
  }
};

VertexId vertex(const Json& given) {
  const auto v = given.get<std::int64_t>();
  return v < 0 ? VertexId() : VertexId(static_cast<std::size_t>(v));
}

}  // namespace

LengthParameter length_parameter_from(std::string_view name, const Json& given) {
  const Json plain = unmarked(given);
  if (plain.is_number()) return {plain.get<double>(), LengthScale::relative};
  if (!plain.is_object() || !plain.contains("value") || !plain.contains("scale")) throw WrongType{};
  return {unmarked(plain["value"]).get<double>(),
          from_name<LengthScale>(name, plain["scale"].get<std::string>(), kScales)};
}

EnergyModel model_from(const Json& given) {
  constexpr std::string_view kNames[] = {"energy", "star", "boundary_treatment", "gamma", "h0", "wall"};
  expect_names(given, kNames);
  EnergyModel model;
  std::string energy(energy_info(model.kind).name), treatment(kTreatments[0]);
  int star = static_cast<int>(model.star);
  take(given, "energy", energy), take(given, "star", star), take(given, "boundary_treatment", treatment);
  take(given, "wall", model.wall);
  model.kind = or_fail(find_energy(energy)).kind;
  if (star < 0 || star > 2) fail(ErrorCode::invalid_option, "star: expected 0, 1 or 2, found " + std::to_string(star));
  model.star = static_cast<Star>(star);
  model.boundary_treatment = from_name<BoundaryTreatment>("boundary_treatment", treatment, kTreatments);
  if (given.contains("gamma")) model.gamma = length_parameter_from("gamma", given["gamma"]);
  if (given.contains("h0")) model.h0 = length_parameter_from("h0", given["h0"]);
  return model;
}

OptimizeOptions options_from(const Json& given) {
  std::string target(targets().front().name), effort = "normal";
  std::vector<std::string> keep;
  Json changes = Json::object();
  for (const auto& [key, value] : given.items()) {
    if (key == "target") {
      take(given, "target", target);
    } else if (key == "effort") {
      take(given, "effort", effort);
    } else if (key == "keep" && value.is_string()) {
      keep.push_back(value.get<std::string>());
    } else if (key == "keep") {
      take(given, "keep", keep);
    } else if (key == "options") {
      take(given, "options", changes);
    } else if (key != "boundary" && key != "time_limit") {
      throw WrongType{find_option(key) == nullptr ? "there is no argument " + key
                                                  : key + " is one of the options: {options: {" + key + ": VALUE}}"};
    }
  }
  const std::vector<std::string_view> parts(keep.begin(), keep.end());
  OptimizeOptions options = or_fail(options_for(target, effort, parts));
  for (const auto& [key, value] : changes.items()) set_option(options, key, value);
  for (const char* key : {"boundary", "time_limit"}) {
    if (given.contains(key)) set_option(options, key, given[key]);
  }
  or_fail(check_kept(options, parts));
  return options;
}

std::string spelled(std::string_view text) {
  return spell_options(text, [](const OptionRow& row, std::string_view value) {
    const std::string name(row.name);
    if (value.empty()) return name;
    return name + ": " + (row.kind == OptionKind::choice ? choice(value).dump() : std::string(value));
  });
}

InputError spelled(InputError error) {
  error.message = spelled(std::string_view(error.message));
  return error;
}

Json json_of(const ReportView& report) {
  Json json = Json::object();
  for (const ReportRow& row : report.table->rows)
    json[std::string(row.key)] = std::visit(Maker(), row.of(report.report.get()).is);
  return json;
}

TraceEvent event_from(const Json& given) {
  TraceEvent e;
  const auto kind = given.at("kind").get<std::string>();
  const std::span<const std::string_view> kinds = words_of(EventKind());
  const auto known = std::find(kinds.begin(), kinds.end(), kind);
  if (known == kinds.end()) fail(ErrorCode::trace_mismatch, "there is no kind of event '" + kind + "'");
  e.kind = static_cast<EventKind>(known - kinds.begin());
  e.sweep = given.at("sweep").get<int>();
  e.vertex = vertex(given.at("vertex"));
  e.before = unmarked(given.at("before")).get<double>();
  e.after = unmarked(given.at("after")).get<double>();
  const auto point = given.at("point").get<std::array<double, 3>>();
  e.point = {point[0], point[1], point[2]};
  for (std::size_t i = 0; i < 4; ++i) e.quad[i] = vertex(given.at("quad").at(i));
  for (const Json& v : given.at("link")) e.link.push_back(vertex(v));
  for (const Json& t : given.at("triangles"))
    e.triangles.push_back({vertex(t.at(0)), vertex(t.at(1)), vertex(t.at(2))});
  e.to_sweep = given.at("to_sweep").get<int>();
  return e;
}

Json option_table() {
  Json table = Json::array();
  for (const OptionGroup& group : option_groups()) {
    for (const OptionRow& row : group.rows) {
      if (!fits(row.cells, CellKinds::triangles)) continue;
      Json choices = Json::array();
      for (const std::string_view each : row.choices) choices.push_back(choice(each));
      table.push_back({{"name", row.name},
                       {"group", group.title},
                       {"sentence", spelled(row.sentence)},
                       {"choices", choices},
                       {"optional", row.optional},
                       {"range", option_range_text(row)},
                       {"absent", spelled(row.absent)},
                       {"default", to_json(row.get({}))}});
    }
  }
  return table;
}

Json to_json(const OptimizeOptions& options) {
  Json json;
  for (const OptionRow& row : option_rows()) {
    if (fits(row.cells, CellKinds::triangles)) json[std::string(row.name)] = to_json(row.get(options));
  }
  return json;
}

Json preset_table() {
  const auto rows = [](std::span<const Preset> presets) {
    Json list = Json::array();
    for (const Preset& p : presets)
      list.push_back({{"name", p.name}, {"sentence", p.sentence}, {"research", p.research}});
    return list;
  };
  return {{"target", rows(targets())}, {"effort", rows(efforts())}, {"keep", rows(keeps())}};
}

Json energy_table() {
  Json rows = Json::array();
  for (const EnergyInfo& e : energies()) {
    rows.push_back({{"name", e.name},
                    {"formula", e.formula},
                    {"boundary_treatment", kTreatments[static_cast<std::size_t>(e.boundary_treatment)]},
                    {"barrier", e.barrier},
                    {"softened_by_gamma", e.softened_by_gamma},
                    {"softened_by_h0", e.softened_by_h0},
                    {"length_exponent", e.length_exponent},
                    {"signed_by_dual", e.signed_by_dual},
                    {"normalized", e.normalized},
                    {"positions_alone", e.positions_alone}});
  }
  return rows;
}

}  // namespace temper::wasm

// A report is a table: each of its fields is one row, with key, sentence, unit and member.
//
//     report_table<SweepRecord>("SweepRecord", "One sweep over all vertices.", {
//         {"sweep", "Number of the sweep; 0 is the input", "", &SweepRecord::sweep},
//         {"seconds", "Time since the start of the optimization", "s", &SweepRecord::seconds}})
//
// JSON, Python's records and npm's records are loops over these rows. The schema, the classes of Python and the
// interfaces of TypeScript are written from them (scripts/docs/records.py). The type of a field comes from its member.
// A report is a struct with a function `table_of(const Report*)`, an enum one with a function `words_of(Enum)`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "temper/detail/ids.hpp"
#include "temper/detail/vec.hpp"

namespace temper {

struct Certificate;
struct ReportTable;

/// The type of a field: a value, or a list of such values, or a list of lists.
struct FieldType {
  enum class Kind {
    flag,    ///< true or false
    count,   ///< Whole number, at least 0
    whole,   ///< Whole number
    number,  ///< May be infinite or NaN
    text,
    vertex,   ///< Number of a vertex; invalid: there is none
    element,  ///< Number of a triangle, a tetrahedron or a halfedge; −1: there is none
    certificate,
    record,  ///< Report with a table of its own
  };
  Kind kind = Kind::number;
  bool optional = false;                     ///< The value may be absent
  std::vector<std::size_t> sizes = {};       ///< Lengths of lists, outermost first; 0: any length
  std::vector<std::string_view> words = {};  ///< All texts that are possible; empty: any text
  const ReportTable& (*record)() = nullptr;  ///< Table of a record
};

/// A text that names vertices by number, as in "edge 3-9". A front end may put in other numbers.
struct NumberedText {
  std::string text;
};
/// A text that names options as `spell_options` takes them. A front end spells them as its users do.
struct TextWithOptions {
  std::string text;
};

/// A report and its table. The report must exist as long as the view, unless the view owns it.
struct ReportView {
  const ReportTable* table;
  std::shared_ptr<const void> report;
};

struct FieldValue;
/// A list of values, of a fixed length (vertices of a triangle) or not.
struct FieldList {
  std::vector<FieldValue> items;
  bool is_fixed = false;
};

/// The value of a field. Long arrays are views of the report's own memory; no value is: std::monostate.
struct FieldValue {
  std::variant<std::monostate, bool, std::int64_t, double, std::string, NumberedText, TextWithOptions, VertexId,
               std::span<const VertexId>, std::span<const TriangleId>, std::span<const std::size_t>,
               std::span<const double>, const Certificate*, FieldList, ReportView>
      is;
};

/// The front ends that show a field.
enum class ShownIn {
  everywhere,
  libraries,  ///< Python and npm, and not the program's JSON
  by_key,     ///< Everywhere, but not in the text of a report
  if_any,     ///< Everywhere, but JSON has the key only if there is a value
};

/// Where a field is shown, and how.
struct Display {
  ShownIn shown = ShownIn::everywhere;
  std::string_view label = {};  ///< Label in tables for people; empty: these do not have the field

  Display() = default;
  Display(ShownIn where, std::string_view text = {}) : shown(where), label(text) {}  // NOLINT: a row names either
  Display(const char* text) : label(text) {}                                         // NOLINT
};

/// A row of the table of a report.
struct ReportRow {
  std::string_view key;       ///< Name in JSON, Python and npm
  std::string_view sentence;  ///< Meaning, in words; may be empty if the key says it
  std::string_view unit;      ///< "s", "length", "degrees"; or empty
  FieldType type;
  std::function<FieldValue(const void* report)> of;
  Display display = {};
};

/// The table of a report. Without a name it is a dictionary, whose values are all of one type.
struct ReportTable {
  std::string_view name;  ///< Name of the class in Python and of the interface in TypeScript
  std::string_view sentence;
  std::vector<ReportRow> rows;
};

// --- types and values of members ---------------------------------------------------------------------------------

template <class T>
struct FieldTraits;

template <class T>
[[nodiscard]] FieldType field_type() {
  return FieldTraits<std::remove_cvref_t<T>>::type();
}
template <class T>
[[nodiscard]] FieldValue field_value(const T& value) {
  return FieldTraits<T>::value(value);
}
/// A view of a report that exists elsewhere.
template <class Report>
[[nodiscard]] ReportView view_of(const Report& report) {
  return {&table_of(&report), std::shared_ptr<const void>(std::shared_ptr<const void>(), &report)};
}

/// A type that FieldValue can hold.
template <FieldType::Kind kind, class Stored>
struct PlainTraits {
  static FieldType type() { return {.kind = kind}; }
  template <class T>
  static FieldValue value(const T& value) {
    return {Stored(value)};
  }
};
template <>
struct FieldTraits<bool> : PlainTraits<FieldType::Kind::flag, bool> {};
template <>
struct FieldTraits<int> : PlainTraits<FieldType::Kind::whole, std::int64_t> {};
template <>
struct FieldTraits<std::size_t> : PlainTraits<FieldType::Kind::count, std::int64_t> {};
template <>
struct FieldTraits<double> : PlainTraits<FieldType::Kind::number, double> {};
template <>
struct FieldTraits<std::string> : PlainTraits<FieldType::Kind::text, std::string> {};
template <>
struct FieldTraits<std::string_view> : PlainTraits<FieldType::Kind::text, std::string> {};
template <>
struct FieldTraits<NumberedText> : PlainTraits<FieldType::Kind::text, NumberedText> {};
template <>
struct FieldTraits<TextWithOptions> : PlainTraits<FieldType::Kind::text, TextWithOptions> {};
template <>
struct FieldTraits<VertexId> : PlainTraits<FieldType::Kind::vertex, VertexId> {};

template <class Tag>
struct FieldTraits<Id<Tag>> {
  static FieldType type() { return {.kind = FieldType::Kind::element}; }
  static FieldValue value(Id<Tag> id) { return {id.valid() ? std::int64_t{id.index} : std::int64_t{-1}}; }
};

/// A proof, which each front end writes in its own form.
template <>
struct FieldTraits<Certificate> {
  static FieldType type() { return {.kind = FieldType::Kind::certificate}; }
  static FieldValue value(const Certificate& certificate) { return {&certificate}; }
};

template <class T>
struct FieldTraits<std::optional<T>> {
  static FieldType type() {
    FieldType type = field_type<T>();
    type.optional = true;
    return type;
  }
  static FieldValue value(const std::optional<T>& value) { return value ? field_value(*value) : FieldValue(); }
};

template <class T>
[[nodiscard]] FieldType list_type(std::size_t size) {
  FieldType type = field_type<T>();
  type.sizes.insert(type.sizes.begin(), size);
  return type;
}
template <class Range>
[[nodiscard]] FieldList field_list(const Range& range, bool is_fixed) {
  FieldList list = {{}, is_fixed};
  for (const auto& item : range) list.items.push_back(field_value(item));
  return list;
}

template <class T>
struct FieldTraits<std::vector<T>> {
  static FieldType type() { return list_type<T>(0); }
  static FieldValue value(const std::vector<T>& values) {
    using Span = std::span<const T>;
    if constexpr (std::is_constructible_v<decltype(FieldValue::is), std::in_place_type_t<Span>, Span>)
      return {Span(values)};
    else
      return {field_list(values, false)};
  }
};
template <class IdType, class T>
struct FieldTraits<IdVector<IdType, T>> : FieldTraits<std::vector<T>> {
  static FieldValue value(const IdVector<IdType, T>& values) { return field_value(values.raw()); }
};
template <class T, std::size_t n>
struct FieldTraits<std::array<T, n>> {
  static FieldType type() { return list_type<T>(n); }
  static FieldValue value(const std::array<T, n>& values) { return {field_list(values, true)}; }
};

template <>
struct FieldTraits<Vec2> : FieldTraits<std::array<double, 2>> {
  static FieldValue value(Vec2 p) { return field_value(std::array{p.x, p.y}); }
};
template <>
struct FieldTraits<Vec3> : FieldTraits<std::array<double, 3>> {
  static FieldValue value(Vec3 p) { return field_value(std::array{p.x, p.y, p.z}); }
};
template <>
struct FieldTraits<WeightedPoint> : FieldTraits<std::array<double, 3>> {
  static FieldValue value(const WeightedPoint& p) { return field_value(std::array{p.x, p.y, p.w}); }
};

template <class T>
requires std::is_enum_v<T>
struct FieldTraits<T> {
  static FieldType type() {
    const std::span<const std::string_view> words = words_of(T());
    return {.kind = FieldType::Kind::text, .words = {words.begin(), words.end()}};
  }
  static FieldValue value(T value) { return {std::string(name(value))}; }
};

/// A report.
template <class T>
struct FieldTraits {
  static FieldType type() {
    return {.kind = FieldType::Kind::record,
            .record = []() -> const ReportTable& { return table_of(static_cast<const T*>(nullptr)); }};
  }
  static FieldValue value(const T& report) { return {view_of(report)}; }
};

// --- tables ------------------------------------------------------------------------------------------------------

/// The value of a field that a function computes. It owns what it refers to.
template <class T>
[[nodiscard]] FieldValue owned_value(T value) {
  if constexpr (requires { table_of(static_cast<const T*>(nullptr)); }) {
    const auto owner = std::make_shared<const T>(std::move(value));
    return {ReportView{&table_of(owner.get()), owner}};
  } else {
    return field_value(value);
  }
}
template <class T>
[[nodiscard]] FieldValue owned_value(std::optional<T> value) {
  return value ? owned_value(*std::move(value)) : FieldValue();
}
template <class T>
[[nodiscard]] FieldValue owned_value(std::vector<T> values) {
  FieldList list;
  for (T& value : values) list.items.push_back(owned_value(std::move(value)));
  return {std::move(list)};
}

/// A row that is made from a member of a report, or from a function of a report.
template <class Report>
struct Field : ReportRow {
  template <class Of>
  Field(std::string_view name, std::string_view meaning, std::string_view in, Of member, Display how = {})
      : ReportRow{name,
                  meaning,
                  in,
                  field_type<std::invoke_result_t<Of, const Report&>>(),
                  [member](const void* report) -> FieldValue {
                    const Report& whole = *static_cast<const Report*>(report);
                    if constexpr (std::is_lvalue_reference_v<std::invoke_result_t<Of, const Report&>>)
                      return field_value(std::invoke(member, whole));
                    else
                      return owned_value(std::invoke(member, whole));
                  },
                  how} {}
};

/// The table of a report, from its rows.
template <class Report>
[[nodiscard]] ReportTable report_table(std::string_view name, std::string_view sentence,
                                       std::initializer_list<Field<Report>> fields) {
  return {name, sentence, {fields.begin(), fields.end()}};
}

/// The rows of a report that is a part of another one, as rows of that.
template <class Report, class Part>
[[nodiscard]] std::vector<ReportRow> rows_of_part(Part part) {
  using Inner = std::remove_cvref_t<std::invoke_result_t<Part, const Report&>>;
  std::vector<ReportRow> rows = table_of(static_cast<const Inner*>(nullptr)).rows;
  for (ReportRow& row : rows) {
    row.of = [of = std::move(row.of), part](const void* report) {
      return of(&part(*static_cast<const Report*>(report)));
    };
  }
  return rows;
}

}  // namespace temper

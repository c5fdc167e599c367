// Measures of a mesh that are gathered from its elements, as a sum, or as the least or the largest of a value.
//
// A row of a table has the words of a measure, the member of the report, and a function of one element. The type of the
// function's argument says of which elements: of each triangle, of each edge, … A pass over a mesh hands each element
// to all rows, and merges the sums of blocks in their order. Rows are a tuple, so the loops over them are unrolled.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "temper/quality.hpp"

namespace temper::gathered {

/// The words of a row, as MeasureRow has them. The key is the name of the member.
struct Words {
  std::string_view alias, label, community, definition;
  std::optional<double> wanted = {};
};

/// A sum of counts or values, the share of triangles or tetrahedra for which the function is true, or an extreme.
enum class How { sum, share, least, largest };

[[nodiscard]] constexpr Preference better(How how) {
  constexpr Preference kOf[] = {Preference::equal, Preference::larger, Preference::larger, Preference::less};
  return kOf[static_cast<std::size_t>(how)];
}

/// A row. If its function is null, other code measures it.
template <class Report, How how, auto member, class OfElement>
struct Row {
  using Value = std::remove_cvref_t<decltype(std::declval<Report>().*member)>;
  static constexpr bool is_count = std::is_integral_v<Value>;

  MeasureRow<Report> row;
  OfElement of_element;

  /// The value before the first element.
  static void begin(Report& report) {
    if constexpr (how == How::least) report.*member = std::numeric_limits<double>::infinity();
    if constexpr (how == How::largest) report.*member = -std::numeric_limits<double>::infinity();
  }
  /// Takes the element if the function does.
  template <class Element>
  void add(Report& report, const Element& element) const {
    if constexpr (std::is_invocable_v<const OfElement&, const Element&>) take(report, Value(of_element(element)));
  }
  static void merge(Report& report, const Report& other) {
    if constexpr (!std::is_null_pointer_v<OfElement>) take(report, other.*member);
  }
  /// The value after the last element. In a mesh without triangles or tetrahedra it is 0.
  static void end(Report& report, std::size_t n_cells) {
    if constexpr (how == How::sum) return;
    if (n_cells == 0) report.*member = 0;
    if constexpr (how == How::share) {
      if (n_cells > 0) report.*member /= static_cast<double>(n_cells);
    }
  }

 private:
  static void take(Report& report, Value value) {
    Value& all = report.*member;
    all = how == How::least ? std::min(all, value) : how == How::largest ? std::max(all, value) : all + value;
  }
};

/// A row of a table; TEMPER_MEASURE gives the key.
template <class Report, How how, auto member, class OfElement = std::nullptr_t>
[[nodiscard]] constexpr auto row(std::string_view key, const Words& w, OfElement of_element = {}) {
  using Made = Row<Report, how, member, OfElement>;
  constexpr auto kValue = [](const Report& report) { return static_cast<double>(report.*member); };
  return Made{{key, w.alias, w.label, w.community, w.definition, better(how), Made::is_count, w.wanted, kValue},
              of_element};
}
#define TEMPER_MEASURE(how, member, ...) \
  gathered::row<Quality, gathered::How::how, &Quality::member>(#member, __VA_ARGS__)

/// The dual of an element, or a part of it.
struct Dual {
  DualKind kind;
  Sign sign;      ///< exact
  double over_l;  ///< length over the length of the element, with this sign
};
template <class Element = Dual>
[[nodiscard]] constexpr auto is_negative(DualKind kind) {
  return [kind](const Element& e) { return e.kind == kind && e.sign == Sign::negative; };
}
[[nodiscard]] constexpr auto is_not_positive(DualKind kind) {
  return [kind](const Dual& dual) { return dual.kind == kind && dual.sign != Sign::positive; };
}

/// What the rows of a table gather.
template <class Report, const auto& rows>
struct Sums {
  Report report;

  Sums() {
    each([this](const auto& row) { row.begin(report); });
  }
  template <class Element>
  void add(const Element& element) {
    each([&](const auto& row) { row.add(report, element); });
  }
  void merge(const Sums& other) {
    each([&](const auto& row) { row.merge(report, other.report); });
  }
  void end(std::size_t n_cells) {
    each([&](const auto& row) { row.end(report, n_cells); });
  }

 private:
  template <class Use>
  static void each(const Use& use) {
    std::apply([&](const auto&... row) { (use(row), ...); }, rows);
  }
};

/// The rows for all who do not measure.
template <const auto& rows>
[[nodiscard]] auto plain_rows() {
  static constexpr auto kPlain = std::apply([](const auto&... row) { return std::array{row.row...}; }, rows);
  return std::span(kPlain);
}

}  // namespace temper::gathered

// Errors as numbers in a row: means over fields, ratios of two meshes, orders over a family.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "errors/poisson.hpp"
#include "temper/surface_errors.hpp"

namespace temper {
namespace {

template <std::size_t star>
double& star_l2(OperatorErrors& e) {
  return e.star[star].l2;
}
template <std::size_t star>
double& star_max(OperatorErrors& e) {
  return e.star[star].max;
}
double& poisson_l2(OperatorErrors& e) { return e.poisson.l2; }
double& poisson_max(OperatorErrors& e) { return e.poisson.max; }
double& flux_l2(OperatorErrors& e) { return e.flux.l2; }
double& flux_max(OperatorErrors& e) { return e.flux.max; }

/// Reads a number of constant errors, from a copy of all ten.
template <double& (*at)(OperatorErrors&)>
double value_of(const OperatorErrors& errors) {
  OperatorErrors copy = errors;
  return at(copy);
}

template <double& (*at)(OperatorErrors&)>
constexpr ErrorMeasure measure_row(std::string_view key, std::string_view label) {
  return {key, label, value_of<at>, at};
}

constexpr std::array<ErrorMeasure, 10> kMeasures = {{
    measure_row<star_l2<0>>("star0.l2", "★0, L2"),
    measure_row<star_max<0>>("star0.max", "★0, maximum"),
    measure_row<star_l2<1>>("star1.l2", "★1, L2"),
    measure_row<star_max<1>>("star1.max", "★1, maximum"),
    measure_row<star_l2<2>>("star2.l2", "★2, L2"),
    measure_row<star_max<2>>("star2.max", "★2, maximum"),
    measure_row<poisson_l2>("poisson.l2", "Poisson at vertices, L2"),
    measure_row<poisson_max>("poisson.max", "Poisson at vertices, maximum"),
    measure_row<flux_l2>("flux.l2", "two-point flux, L2"),
    measure_row<flux_max>("flux.max", "two-point flux, maximum"),
}};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

// Relative errors below this are rounding: five-point stars are exact for quadratic fields.
constexpr double kRounding = 1e-12;

/// Slope of −log2(error) over the number of the level. This is the order against edge length, which each level halves.
double order_of(const std::vector<double>& errors) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t level = 0; level < errors.size(); ++level) {
    if (!(errors[level] > kRounding) || !std::isfinite(errors[level])) continue;
    const double i = static_cast<double>(level), log = -std::log2(errors[level]);
    n += 1, x += i, y += log, xx += i * i, xy += i * log;
  }
  return n < 2 ? kUndefined : (n * xy - x * y) / (n * xx - x * x);
}

double ratio(double after, double before) {
  if (after == before) return 1;
  if (before == 0) return kInfinity;
  return std::isfinite(before) ? after / before : 0;
}

/// finish(Σ start(value), n) of each measure.
template <class Start, class Finish>
OperatorErrors mean(std::span<const FieldErrors> fields, std::optional<FieldGroup> group, const Start& start,
                    const Finish& finish) {
  OperatorErrors result;
  for (const ErrorMeasure& measure : kMeasures) {
    double sum = 0, n = 0;
    for (const FieldErrors& row : fields) {
      if (group && row.field.group != *group) continue;
      sum += start(measure.of(row.errors));
      n += 1;
    }
    measure.at(result) = finish(sum, n);
  }
  return result;
}

double sum_of(std::span<const double> values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// The geometric mean. Values that are nearly exact, or 0, count as a small part of the sum.
double geometric_mean_of(std::span<const double> values) {
  const double least = 1e-8 * sum_of(values);
  double sum = 0;
  for (const double value : values) sum += std::log(std::max(value, least));
  return std::exp(sum / static_cast<double>(values.size()));
}

/// Appends of(squares over the fields), for each norm of the errors that the scheme is meant to lower.
void append_squared_errors(std::vector<double>& squared, std::span<const FieldErrors> fields, Scheme scheme,
                           double (*of)(std::span<const double>)) {
  for (const ErrorMeasure& measure : kMeasures) {
    const bool at_vertices = measure.key.starts_with("poisson."), in_cells = measure.key.starts_with("flux.");
    const bool of_stars = !at_vertices && !in_cells;
    if (of_stars != (scheme == Scheme::stars)) continue;
    if ((at_vertices && scheme == Scheme::cell) || (in_cells && scheme == Scheme::vertex)) continue;
    std::vector<double> squares;
    for (const FieldErrors& row : fields) squares.push_back(measure.of(row.errors) * measure.of(row.errors));
    squared.push_back(of(squares));
  }
}

}  // namespace

std::span<const ErrorMeasure> error_measures() { return kMeasures; }

OperatorErrors geometric_mean(std::span<const FieldErrors> fields, std::optional<FieldGroup> group) {
  return mean(
      fields, group, [](double value) { return std::log(value); },
      [](double sum, double n) {
        // An error of zero does not compensate an infinite one.
        return n == 0 ? 1 : std::isnan(sum) ? kInfinity : std::exp(sum / n);
      });
}

OperatorErrors arithmetic_mean(std::span<const FieldErrors> fields, std::optional<FieldGroup> group) {
  return mean(
      fields, group, [](double value) { return value; },
      [](double sum, double n) { return n == 0 ? kUndefined : sum / n; });
}

Expected<std::vector<FieldErrors>> error_ratios(const ErrorReport& after, const ErrorReport& before) {
  return error_detail::field_ratios(after.fields, before.fields, after.frame == before.frame);
}

std::vector<double> squared_solver_errors(const Mesh& mesh, Scheme scheme, Executor* executor) {
  std::vector<double> squared;
  const auto report = measure_errors(mesh, {.fields = {std::string(name(FieldGroup::chosen))}, .executor = executor});
  if (report) append_squared_errors(squared, report->fields, scheme, sum_of);
  return squared;
}

std::vector<double> surfaces::squared_solver_errors(const SurfaceMesh& mesh, Scheme scheme) {
  std::vector<double> squared;
  const auto report = measure_errors(mesh, {.fields = {std::string(name(FieldGroup::chosen))}});
  if (!report) return squared;
  append_squared_errors(squared, report->fields, scheme, sum_of);
  append_squared_errors(squared, report->fields, scheme, geometric_mean_of);
  return squared;
}

namespace error_detail {

Expected<std::vector<FieldErrors>> field_ratios(std::span<const FieldErrors> after, std::span<const FieldErrors> before,
                                                bool same_frame) {
  const bool same = same_frame && std::equal(after.begin(), after.end(), before.begin(), before.end(),
                                             [](const auto& a, const auto& b) { return a.field.name == b.field.name; });
  if (!same) return InputError{ErrorCode::invalid_option, "", "errors of other fields, or of another frame"};
  std::vector<FieldErrors> ratios(after.begin(), after.end());
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    for (const ErrorMeasure& measure : kMeasures)
      measure.at(ratios[i].errors) = ratio(measure.of(after[i].errors), measure.of(before[i].errors));
  }
  return ratios;
}

std::vector<FieldErrors> convergence_orders(const std::vector<ErrorLevel>& levels) {
  std::vector<FieldErrors> orders = levels.front().fields;
  for (std::size_t field = 0; field < orders.size(); ++field) {
    for (const ErrorMeasure& measure : kMeasures) {
      std::vector<double> errors;
      errors.reserve(levels.size());
      for (const ErrorLevel& level : levels) errors.push_back(measure.of(level.fields[field].errors));
      measure.at(orders[field].errors) = order_of(errors);
    }
  }
  return orders;
}

}  // namespace error_detail
}  // namespace temper

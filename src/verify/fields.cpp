#include "verify/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "verify/gauss.hpp"

namespace temper {
namespace verify_detail {
namespace {

/// amplitude · sin(k · p + phase). Cosines are a quarter turn ahead.
FieldValue wave(Vec2 p, double amplitude, Vec2 k, double phase) {
  const double angle = dot(k, p) + phase;
  const double s = amplitude * std::sin(angle), c = amplitude * std::cos(angle);
  return {s, c * k, -squared_length(k) * s, -c / k.x};
}
constexpr double kQuarter = 0.5 * std::numbers::pi;

FieldValue sum(const FieldValue& a, const FieldValue& b) {
  return {a.u + b.u, a.gradient + b.gradient, a.laplacian + b.laplacian, a.antiderivative + b.antiderivative};
}

FieldValue product(Vec2 p) {  // sin a cos b = (sin(a + b) + sin(a − b)) / 2
  return sum(wave(p, 0.5, {2.1, 1.7}, 0.1), wave(p, 0.5, {2.1, -1.7}, 0.5));
}
FieldValue oblique(Vec2 p) { return wave(p, 1, {1.3, 2.2}, 0.5); }
FieldValue counter(Vec2 p) { return wave(p, 1, {2.4, -1.1}, kQuarter - 0.4); }
FieldValue quadratic(Vec2 p) {
  const auto [x, y] = p;
  return {0.6 * x * x - 0.8 * x * y + 0.5 * y * y + 0.3 * x,
          {1.2 * x - 0.8 * y + 0.3, -0.8 * x + y},
          2.2,
          x * (0.2 * x * x - 0.4 * x * y + 0.5 * y * y + 0.15 * x)};
}

FieldValue crossed(Vec2 p) {  // sin a sin b = (cos(a − b) − cos(a + b)) / 2
  return sum(wave(p, 0.5, {1.2, -2.6}, kQuarter - 1.4), wave(p, -0.5, {1.2, 2.6}, kQuarter - 0.2));
}
FieldValue two_waves(Vec2 p) { return sum(wave(p, 1, {0.7, -2.9}, kQuarter + 0.1), wave(p, 0.5, {2.7, 0.9}, 0)); }
FieldValue harmonic(Vec2 p) {
  const double e = std::exp(p.x), c = e * std::cos(p.y), s = e * std::sin(p.y);
  return {c, {c, -s}, 0, c};
}
FieldValue cubic(Vec2 p) {
  const auto [x, y] = p;
  return {x * x * x - 1.5 * x * y * y + x * x * y + 0.5 * y * y,
          {3 * x * x - 1.5 * y * y + 2 * x * y, -3 * x * y + x * x + y},
          3 * x + 2 * y + 1,
          x * (0.25 * x * x * x - 0.75 * x * y * y + x * x * y / 3 + 0.5 * y * y)};
}
FieldValue bump(Vec2 p) {
  const double x = p.x + 0.1, y = p.y - 0.2;
  const double across = std::exp(-2 * y * y), u = std::exp(-2 * x * x) * across;
  const double root = std::sqrt(2.0);
  return {u,
          {-4 * x * u, -4 * y * u},
          (16 * (x * x + y * y) - 8) * u,
          across * std::erf(root * x) / (root * std::numbers::inv_sqrtpi * 2)};
}

FieldValue linear(Vec2 p) {
  return {0.7 * p.x - 0.4 * p.y + 0.2, {0.7, -0.4}, 0, p.x * (0.35 * p.x - 0.4 * p.y + 0.2)};
}

constexpr std::array<Field, 10> kFields = {{
    {{"product", FieldGroup::chosen, "sin(2.1 x + 0.3) cos(1.7 y - 0.2)"}, product},
    {{"oblique", FieldGroup::chosen, "sin(1.3 x + 2.2 y + 0.5)"}, oblique},
    {{"counter", FieldGroup::chosen, "cos(2.4 x - 1.1 y - 0.4)"}, counter},
    {{"quadratic", FieldGroup::chosen, "0.6 x^2 - 0.8 x y + 0.5 y^2 + 0.3 x"}, quadratic},
    {{"crossed", FieldGroup::held_back, "sin(1.2 x - 0.8) sin(2.6 y + 0.6)"}, crossed},
    {{"two-waves", FieldGroup::held_back, "cos(0.7 x - 2.9 y + 0.1) + 0.5 sin(2.7 x + 0.9 y)"}, two_waves},
    {{"harmonic", FieldGroup::held_back, "exp(x) cos(y)"}, harmonic},
    {{"cubic", FieldGroup::held_back, "x^3 - 1.5 x y^2 + x^2 y + 0.5 y^2"}, cubic},
    {{"bump", FieldGroup::held_back, "exp(-2 (x + 0.1)^2 - 2 (y - 0.2)^2)"}, bump},
    {{"linear", FieldGroup::exact, "0.7 x - 0.4 y + 0.2"}, linear},
}};

bool asks_for(std::string_view word, const VerifyField& field) {
  if (word == "all") return field.group != FieldGroup::exact;
  return word == field.name || word == name(field.group);
}

std::string known_fields() {
  std::string text = "all, chosen, held-back, exact";
  for (const Field& f : kFields) text += ", " + std::string(f.field.name);
  return text;
}

}  // namespace

std::span<const Field> all_fields() { return kFields; }

FieldSize size_of(const Field& field) {
  constexpr int kPieces = 8;  // of each side, so that the rule's error is that of rounding
  FieldSize sum;
  const auto nodes = gauss_nodes(kPieces);
  for (const GaussNode& i : nodes) {
    for (const GaussNode& j : nodes) {
      const FieldValue value = field.at({2 * i.at - 1, 2 * j.at - 1});
      sum.value += i.weight * j.weight * value.u * value.u;
      sum.gradient += i.weight * j.weight * squared_length(value.gradient);
    }
  }
  return {std::sqrt(sum.value), std::sqrt(sum.gradient)};
}

Expected<std::vector<Field>> select_fields(const std::vector<std::string>& names) {
  const std::vector<std::string> asked = names.empty() ? std::vector<std::string>{"all"} : names;
  std::array<bool, kFields.size()> wanted = {};
  for (const std::string& word : asked) {
    bool known = false;
    for (std::size_t i = 0; i < kFields.size(); ++i) {
      if (!asks_for(word, kFields[i].field)) continue;
      wanted[i] = known = true;
    }
    if (!known) {
      return InputError{ErrorCode::invalid_option, "", "no field '" + word + "'; there are " + known_fields()};
    }
  }
  std::vector<Field> fields;
  for (std::size_t i = 0; i < kFields.size(); ++i) {
    if (wanted[i]) fields.push_back(kFields[i]);
  }
  return fields;
}

}  // namespace verify_detail

std::string_view name(FieldGroup group) {
  switch (group) {
    case FieldGroup::chosen:
      return "chosen";
    case FieldGroup::held_back:
      return "held-back";
    case FieldGroup::exact:
      return "exact";
  }
  return "";
}

std::span<const VerifyField> verify_fields() {
  static constexpr auto kPublic = [] {
    std::array<VerifyField, verify_detail::kFields.size()> fields = {};
    for (std::size_t i = 0; i < fields.size(); ++i) fields[i] = verify_detail::kFields[i].field;
    return fields;
  }();
  return kPublic;
}

}  // namespace temper

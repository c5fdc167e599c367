#include "errors/fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "temper/tets/errors.hpp"

namespace temper {
namespace error_detail {
namespace {

/// amplitude · sin(k · p + phase). Cosines are a quarter turn ahead.
FieldValue wave(Place at, double amplitude, Vec2 k, double phase) {
  const Vec2 p = {at.x, at.y};
  const double angle = dot(k, p) + phase;
  const double s = amplitude * std::sin(angle), c = amplitude * std::cos(angle);
  return {s, {c * k.x, c * k.y}, -squared_length(k) * s, {-c / k.x}};
}
constexpr double kQuarter = 0.5 * std::numbers::pi;

FieldValue sum(const FieldValue& a, const FieldValue& b) {
  return {a.u + b.u, a.gradient + b.gradient, a.laplacian + b.laplacian, a.potential + b.potential};
}

FieldValue product(Place p) {  // sin a cos b = (sin(a + b) + sin(a − b)) / 2
  return sum(wave(p, 0.5, {2.1, 1.7}, 0.1), wave(p, 0.5, {2.1, -1.7}, 0.5));
}
FieldValue oblique(Place p) { return wave(p, 1, {1.3, 2.2}, 0.5); }
FieldValue counter(Place p) { return wave(p, 1, {2.4, -1.1}, kQuarter - 0.4); }
FieldValue quadratic(Place p) {
  const double x = p.x, y = p.y;
  return {0.6 * x * x - 0.8 * x * y + 0.5 * y * y + 0.3 * x,
          {1.2 * x - 0.8 * y + 0.3, -0.8 * x + y},
          2.2,
          {x * (0.2 * x * x - 0.4 * x * y + 0.5 * y * y + 0.15 * x)}};
}

FieldValue crossed(Place p) {  // sin a sin b = (cos(a − b) − cos(a + b)) / 2
  return sum(wave(p, 0.5, {1.2, -2.6}, kQuarter - 1.4), wave(p, -0.5, {1.2, 2.6}, kQuarter - 0.2));
}
FieldValue two_waves(Place p) { return sum(wave(p, 1, {0.7, -2.9}, kQuarter + 0.1), wave(p, 0.5, {2.7, 0.9}, 0)); }
FieldValue harmonic(Place p) {
  const double e = std::exp(p.x), c = e * std::cos(p.y), s = e * std::sin(p.y);
  return {c, {c, -s}, 0, {c}};
}
FieldValue cubic(Place p) {
  const double x = p.x, y = p.y;
  return {x * x * x - 1.5 * x * y * y + x * x * y + 0.5 * y * y,
          {3 * x * x - 1.5 * y * y + 2 * x * y, -3 * x * y + x * x + y},
          3 * x + 2 * y + 1,
          {x * (0.25 * x * x * x - 0.75 * x * y * y + x * x * y / 3 + 0.5 * y * y)}};
}
FieldValue bump(Place p) {
  const double x = p.x + 0.1, y = p.y - 0.2;
  const double across = std::exp(-2 * y * y), u = std::exp(-2 * x * x) * across;
  const double root = std::sqrt(2.0);
  return {u,
          {-4 * x * u, -4 * y * u},
          (16 * (x * x + y * y) - 8) * u,
          {across * std::erf(root * x) / (root * std::numbers::inv_sqrtpi * 2)}};
}

FieldValue linear(Place p) {
  return {0.7 * p.x - 0.4 * p.y + 0.2, {0.7, -0.4}, 0, {p.x * (0.35 * p.x - 0.4 * p.y + 0.2)}};
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

// --- in space, for tetrahedra ------------------------------------------------------------------------------------

/// amplitude · sin(k · p + phase); without a potential, which only measures in the plane need.
FieldValue wave(Place p, double amplitude, Vec3 k, double phase) {
  const double angle = dot(k, p) + phase;
  const double s = amplitude * std::sin(angle), c = amplitude * std::cos(angle);
  return {s, c * k, -squared_length(k) * s, {}};
}

FieldValue rising(Place p) { return wave(p, 1, Vec3{0.6, -0.8, 2.3}, 1.1); }
FieldValue slanted(Place p) { return wave(p, 1, Vec3{1.3, 2.2, -0.9}, 0.5); }
FieldValue opposed(Place p) { return wave(p, 1, Vec3{2.4, -1.1, 0.7}, kQuarter - 0.4); }
FieldValue paraboloid(Place p) {
  const auto [x, y, z] = static_cast<const Vec3&>(p);
  return {0.6 * x * x - 0.8 * x * y + 0.5 * y * z - 0.4 * z * z + 0.3 * x,
          {1.2 * x - 0.8 * y + 0.3, -0.8 * x + 0.5 * z, 0.5 * y - 0.8 * z},
          0.4,
          {}};
}
FieldValue pair_of_waves(Place p) {
  return sum(wave(p, 1, Vec3{0.7, -2.1, 1.9}, kQuarter + 0.1), wave(p, 0.5, Vec3{2.3, 0.9, -0.8}, 0));
}
FieldValue steep_wave(Place p) { return wave(p, 1, Vec3{-1.6, 1.5, 2.1}, 0.8); }
FieldValue harmonic_in_space(Place p) {
  const double e = std::exp(p.x), angle = 0.6 * p.y + 0.8 * p.z, c = e * std::cos(angle), s = e * std::sin(angle);
  return {c, {c, -0.6 * s, -0.8 * s}, 0, {}};
}
FieldValue linear_in_space(Place p) { return {0.7 * p.x - 0.4 * p.y + 0.5 * p.z + 0.2, {0.7, -0.4, 0.5}, 0, {}}; }

constexpr Field in_space(std::string_view name, FieldGroup group, std::string_view formula, FieldValue (*at)(Place)) {
  Field field = {{name, group, formula}, at};
  field.in_space = true;
  return field;
}
constexpr std::array<Field, 8> kSpaceFields = {{
    in_space("oblique", FieldGroup::chosen, "sin(1.3 x + 2.2 y - 0.9 z + 0.5)", slanted),
    in_space("counter", FieldGroup::chosen, "cos(2.4 x - 1.1 y + 0.7 z - 0.4)", opposed),
    in_space("rising", FieldGroup::chosen, "sin(0.6 x - 0.8 y + 2.3 z + 1.1)", rising),
    in_space("quadratic", FieldGroup::chosen, "0.6 x^2 - 0.8 x y + 0.5 y z - 0.4 z^2 + 0.3 x", paraboloid),
    in_space("two-waves", FieldGroup::held_back, "cos(0.7 x - 2.1 y + 1.9 z + 0.1) + 0.5 sin(2.3 x + 0.9 y - 0.8 z)",
             pair_of_waves),
    in_space("steep", FieldGroup::held_back, "sin(-1.6 x + 1.5 y + 2.1 z + 0.8)", steep_wave),
    in_space("harmonic", FieldGroup::held_back, "exp(x) cos(0.6 y + 0.8 z)", harmonic_in_space),
    in_space("linear", FieldGroup::exact, "0.7 x - 0.4 y + 0.5 z + 0.2", linear_in_space),
}};

// --- on the sphere -----------------------------------------------------------------------------------------------

/// A homogeneous harmonic polynomial of some degree, and its gradient.
struct Polynomial {
  int degree;
  double value;
  Vec3 gradient;
};

/// The axes of a turned frame, by the quaternion 1 + 2i + 3j + 4k: no axis of a mesh is one of them.
constexpr std::array<Vec3, 3> kAxes = {
    {{-2.0 / 3, 2.0 / 15, 11.0 / 15}, {2.0 / 3, -1.0 / 3, 2.0 / 3}, {1.0 / 3, 14.0 / 15, 2.0 / 15}}};

/// On the unit sphere the gradient of P is the part of ∇P that is tangent, ∇P − l P p. As ΔP = −l(l + 1) P, the
/// divergence of −∇P/(l(l + 1)) is P.
template <class... Polynomials>
FieldValue harmonics(Place p, const Polynomials&... terms) {
  FieldValue sum;
  const auto add = [&](const Polynomial& t) {
    const Vec3 turned = t.gradient.x * kAxes[0] + t.gradient.y * kAxes[1] + t.gradient.z * kAxes[2];
    const Vec3 gradient = turned - (t.degree * t.value) * p;
    const double eigenvalue = t.degree * (t.degree + 1);
    sum.u += t.value;
    sum.gradient = sum.gradient + gradient;
    sum.laplacian -= eigenvalue * t.value;
    sum.potential = sum.potential + (-1 / eigenvalue) * gradient;
  };
  (add(terms), ...);
  return sum;
}

Vec3 turned(Place p) { return {dot(kAxes[0], p), dot(kAxes[1], p), dot(kAxes[2], p)}; }

Polynomial degree_1(Vec3 q) { return {1, q.x + 0.5 * q.z, {1, 0, 0.5}}; }
Polynomial zonal_2(Vec3 q) { return {2, q.z * q.z - 0.5 * (q.x * q.x + q.y * q.y), {-q.x, -q.y, 2 * q.z}}; }
Polynomial tesseral_2(Vec3 q) { return {2, 2 * q.x * q.z, {2 * q.z, 0, 2 * q.x}}; }
Polynomial zonal_3(Vec3 q) {
  const auto [x, y, z] = q;
  return {3, z * (z * z - 1.5 * (x * x + y * y)), {-3 * x * z, -3 * y * z, 3 * z * z - 1.5 * (x * x + y * y)}};
}
Polynomial sectoral_3(Vec3 q) {
  const auto [x, y, z] = q;
  return {3, x * (x * x - 3 * y * y), {3 * (x * x - y * y), -6 * x * y, 0}};
}
Polynomial tesseral_3(Vec3 q) { return {3, 3 * q.x * q.y * q.z, {3 * q.y * q.z, 3 * q.x * q.z, 3 * q.x * q.y}}; }
Polynomial tesseral_4(Vec3 q) {
  const auto [x, y, z] = q;
  return {4,
          x * y * (6 * z * z - x * x - y * y),
          {y * (6 * z * z - 3 * x * x - y * y), x * (6 * z * z - x * x - 3 * y * y), 12 * x * y * z}};
}
Polynomial sectoral_4(Vec3 q) {
  const auto [x, y, z] = q;
  return {4, 4 * x * y * (x * x - y * y), {4 * y * (3 * x * x - y * y), 4 * x * (x * x - 3 * y * y), 0}};
}

FieldValue axial(Place p) { return harmonics(p, zonal_2(turned(p))); }
FieldValue saddle(Place p) { return harmonics(p, sectoral_3(turned(p))); }
FieldValue quilt(Place p) { return harmonics(p, tesseral_4(turned(p))); }
FieldValue tilted(Place p) {
  const Vec3 q = turned(p);
  return harmonics(p, degree_1(q), tesseral_2(q));
}
FieldValue belts(Place p) { return harmonics(p, zonal_3(turned(p))); }
FieldValue octants(Place p) { return harmonics(p, tesseral_3(turned(p))); }
FieldValue petals(Place p) { return harmonics(p, sectoral_4(turned(p))); }
FieldValue mixed(Place p) {
  const Vec3 q = turned(p);
  return harmonics(p, degree_1(q), zonal_2(q), tesseral_3(q), sectoral_4(q));
}

constexpr std::array<Field, 8> kSphereFields = {{
    {{"axial", FieldGroup::chosen, "z^2 - (x^2 + y^2)/2"}, axial, SpaceKind::sphere},
    {{"saddle", FieldGroup::chosen, "x^3 - 3 x y^2"}, saddle, SpaceKind::sphere},
    {{"quilt", FieldGroup::chosen, "x y (6 z^2 - x^2 - y^2)"}, quilt, SpaceKind::sphere},
    {{"tilted", FieldGroup::chosen, "x + z/2 + 2 x z"}, tilted, SpaceKind::sphere},
    {{"belts", FieldGroup::held_back, "z^3 - 3/2 z (x^2 + y^2)"}, belts, SpaceKind::sphere},
    {{"octants", FieldGroup::held_back, "3 x y z"}, octants, SpaceKind::sphere},
    {{"petals", FieldGroup::held_back, "4 x y (x^2 - y^2)"}, petals, SpaceKind::sphere},
    {{"mixed", FieldGroup::held_back, "x + z/2 + axial + octants + petals"}, mixed, SpaceKind::sphere},
}};

// --- in a periodic plane -----------------------------------------------------------------------------------------

constexpr std::array<FourierMode, 1> kZonal = {{{1, 1, 0, 0.2}}};
constexpr std::array<FourierMode, 1> kMeridional = {{{1, 0, 1, kQuarter - 0.3}}};
constexpr std::array<FourierMode, 1> kDiagonal = {{{1, 1, 1, 0.4}}};
constexpr std::array<FourierMode, 2> kRidges = {{{1, 1, 0, 0}, {0.5, 1, -1, 0.6}}};
constexpr std::array<FourierMode, 1> kShort = {{{1, 2, 1, 0.9}}};
constexpr std::array<FourierMode, 1> kSteep = {{{1, 1, -2, kQuarter + 0.2}}};
// sin a sin b = (cos(a − b) − cos(a + b)) / 2
constexpr std::array<FourierMode, 2> kEddies = {{{0.5, 1, -1, kQuarter + 0.8}, {-0.5, 1, 1, kQuarter - 0.2}}};
constexpr std::array<FourierMode, 3> kSpectrum = {{{1, 1, 0, 0.7}, {0.5, 0, 1, kQuarter + 0.1}, {0.25, 2, -1, 0}}};

constexpr Field fourier(std::string_view name, FieldGroup group, std::string_view formula,
                        std::span<const FourierMode> modes) {
  return {{name, group, formula}, nullptr, SpaceKind::periodic_plane, modes};
}
constexpr std::array<Field, 8> kPeriodicFields = {{
    fourier("zonal", FieldGroup::chosen, "sin(x + 0.2)", kZonal),
    fourier("meridional", FieldGroup::chosen, "cos(y - 0.3)", kMeridional),
    fourier("diagonal", FieldGroup::chosen, "sin(x + y + 0.4)", kDiagonal),
    fourier("ridges", FieldGroup::chosen, "sin(x) + 0.5 sin(x - y + 0.6)", kRidges),
    fourier("short", FieldGroup::held_back, "sin(2 x + y + 0.9)", kShort),
    fourier("steep", FieldGroup::held_back, "cos(x - 2 y + 0.2)", kSteep),
    fourier("eddies", FieldGroup::held_back, "sin(x + 0.3) sin(y - 0.5)", kEddies),
    fourier("spectrum", FieldGroup::held_back, "sin(x + 0.7) + 0.5 cos(y + 0.1) + 0.25 sin(2 x - y)", kSpectrum),
}};

/// For a mode, the divergence of −cos(k · p + phase) k/|k|² is the mode.
FieldValue value_of(const FourierMode& mode, Vec2 wave, Place p) {
  const Vec2 k = {mode.m * wave.x, mode.n * wave.y};
  const double angle = k.x * p.x + k.y * p.y + mode.phase, squared = squared_length(k);
  const double s = mode.amplitude * std::sin(angle), c = mode.amplitude * std::cos(angle);
  return {s, {c * k.x, c * k.y, 0}, -squared * s, {-c * k.x / squared, -c * k.y / squared, 0}};
}

/// Different modes are orthogonal over two periods.
FieldSize size_of_modes(const Field& field) {
  FieldSize sum;
  for (const FourierMode& mode : field.modes) {
    const Vec2 k = {mode.m * field.wave.x, mode.n * field.wave.y};
    sum.value += 0.5 * mode.amplitude * mode.amplitude;
    sum.gradient += 0.5 * mode.amplitude * mode.amplitude * squared_length(k);
  }
  return {std::sqrt(sum.value), std::sqrt(sum.gradient)};
}

constexpr int kPieces = 8;  // of each side, so that the rule's error is rounding

FieldSize size_in_plane(const Field& field) {
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

FieldSize size_in_space(const Field& field) {
  FieldSize sum;
  const auto nodes = gauss_nodes(2);  // of each side: waves of space are not longer, and a rule has n³ points
  for (const GaussNode& i : nodes) {
    for (const GaussNode& j : nodes) {
      for (const GaussNode& k : nodes) {
        const FieldValue value = field.at({2 * i.at - 1, 2 * j.at - 1, 2 * k.at - 1});
        sum.value += i.weight * j.weight * k.weight * value.u * value.u;
        sum.gradient += i.weight * j.weight * k.weight * squared_length(value.gradient);
      }
    }
  }
  return {std::sqrt(sum.value), std::sqrt(sum.gradient)};
}

/// Gauss's rule in z, which measures area, and equal steps in longitude: exact for polynomials.
FieldSize size_on_sphere(const Field& field) {
  constexpr int kSteps = 32;
  FieldSize sum;
  for (const GaussNode& i : gauss_nodes(kPieces)) {
    const double z = 2 * i.at - 1, across = std::sqrt(1 - z * z);
    for (int step = 0; step < kSteps; ++step) {
      const double longitude = 2 * std::numbers::pi * step / kSteps;
      const FieldValue value = field.at({across * std::cos(longitude), across * std::sin(longitude), z});
      sum.value += i.weight / kSteps * value.u * value.u;
      sum.gradient += i.weight / kSteps * squared_length(value.gradient);
    }
  }
  return {std::sqrt(sum.value), std::sqrt(sum.gradient)};
}

}  // namespace

FieldValue Field::at(Place p) const {
  if (space != SpaceKind::periodic_plane) return in_frame(p);
  FieldValue all;
  for (const FourierMode& mode : modes) all = sum(all, value_of(mode, wave, p));
  return all;
}

std::span<const Field> all_fields(SpaceKind space) {
  if (space == SpaceKind::plane) return kFields;
  if (space == SpaceKind::sphere) return kSphereFields;
  return kPeriodicFields;
}

std::span<const Field> fields_of_space() { return kSpaceFields; }

FieldSize size_of(const Field& field) {
  if (field.in_space) return size_in_space(field);
  if (field.space == SpaceKind::plane) return size_in_plane(field);
  return field.space == SpaceKind::sphere ? size_on_sphere(field) : size_of_modes(field);
}

Vec2 first_waves(const Space& space, const FieldFrame& frame) {
  const auto wave = [&](double period) {
    return period > 0 ? 2 * std::numbers::pi * frame.half_size / period : std::numbers::pi;
  };
  return {wave(space.period().x), wave(space.period().y)};
}

}  // namespace error_detail

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

namespace {

template <std::size_t n>
constexpr std::array<ErrorField, n> public_part(const std::array<error_detail::Field, n>& all) {
  std::array<ErrorField, n> fields = {};
  for (std::size_t i = 0; i < n; ++i) fields[i] = all[i].field;
  return fields;
}

}  // namespace

std::span<const ErrorField> error_fields(SpaceKind space) {
  static constexpr auto kPlane = public_part(error_detail::kFields);
  static constexpr auto kSphere = public_part(error_detail::kSphereFields);
  static constexpr auto kPeriodic = public_part(error_detail::kPeriodicFields);
  if (space == SpaceKind::plane) return kPlane;
  if (space == SpaceKind::sphere) return kSphere;
  return kPeriodic;
}

std::span<const ErrorField> tets::error_fields() {
  static constexpr auto kSpace = public_part(error_detail::kSpaceFields);
  return kSpace;
}

}  // namespace temper

// The manufactured solutions: each says four things of itself, which must agree.
#include "errors/fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/lattice.hpp"

namespace temper::error_detail {
namespace {

std::vector<Vec2> places() {
  std::vector<Vec2> points;
  test::Noise noise(7);
  for (int i = 0; i < 20; ++i) points.push_back({1.5 * noise(), 1.5 * noise()});
  return points;
}

TEST(ErrorFields, DerivativesAndAntiderivativeAgreeWithDifferences) {
  constexpr double kStep = 1e-3;  // fourth order: 1e-12 times some derivative
  const auto derivative = [](const auto& of, Vec2 p, Vec2 step) {
    return (8 * (of(p + step) - of(p - step)) - (of(p + 2.0 * step) - of(p - 2.0 * step))) / (12 * kStep);
  };
  for (const Field& field : all_fields()) {
    for (const Vec2 p : places()) {
      const Vec2 dx{kStep, 0}, dy{0, kStep};
      const auto u = [&](Vec2 q) { return field.at(q).u; };
      const auto ux = [&](Vec2 q) { return field.at(q).gradient.x; };
      const auto uy = [&](Vec2 q) { return field.at(q).gradient.y; };
      const auto whole = [&](Vec2 q) { return field.at(q).potential.x; };
      const FieldValue value = field.at(p);
      EXPECT_NEAR(derivative(u, p, dx), value.gradient.x, 1e-8) << field.field.name;
      EXPECT_NEAR(derivative(u, p, dy), value.gradient.y, 1e-8) << field.field.name;
      EXPECT_NEAR(derivative(ux, p, dx) + derivative(uy, p, dy), value.laplacian, 1e-7) << field.field.name;
      EXPECT_NEAR(derivative(whole, p, dx), value.u, 1e-8) << field.field.name;
    }
  }
}

TEST(ErrorFields, OfTheSphereAreEigenfunctionsSummed) {
  constexpr double kStep = 1e-3;
  test::Noise noise(7);
  for (const Field& field : all_fields(SpaceKind::sphere)) {
    for (int round = 0; round < 20; ++round) {
      const Vec3 p = Vec3{noise(), noise(), noise()}, up = (1 / length(p)) * p;
      const Vec3 a = cross(up, {0.3, -0.5, 0.8}), x = (1 / length(a)) * a, y = cross(up, x);
      // Along the great circle to a unit tangent vector.
      const auto at = [&](Vec3 t, double angle) { return field.at(std::cos(angle) * up + std::sin(angle) * t); };
      const auto derivative = [&](Vec3 t, const auto& of) {
        return (8 * (of(t, kStep) - of(t, -kStep)) - (of(t, 2 * kStep) - of(t, -2 * kStep))) / (12 * kStep);
      };
      const auto u = [&](Vec3 t, double angle) { return at(t, angle).u; };
      // The component along the circle, whose derivatives sum to the divergence.
      const auto along = [](Vec3 t, Vec3 from, double angle) { return std::cos(angle) * t - std::sin(angle) * from; };
      const auto gradient = [&](Vec3 t, double angle) { return dot(along(t, up, angle), at(t, angle).gradient); };
      const auto potential = [&](Vec3 t, double angle) { return dot(along(t, up, angle), at(t, angle).potential); };
      const FieldValue value = field.at(up);
      EXPECT_NEAR(dot(value.gradient, up), 0, 1e-13);
      EXPECT_NEAR(dot(value.potential, up), 0, 1e-13);
      EXPECT_NEAR(derivative(x, u), dot(value.gradient, x), 1e-8) << field.field.name;
      EXPECT_NEAR(derivative(y, u), dot(value.gradient, y), 1e-8) << field.field.name;
      EXPECT_NEAR(derivative(x, gradient) + derivative(y, gradient), value.laplacian, 1e-7) << field.field.name;
      EXPECT_NEAR(derivative(x, potential) + derivative(y, potential), value.u, 1e-8) << field.field.name;
    }
  }
}

TEST(ErrorFields, AreTheFormulasTheyAreCalledBy) {
  const double x = 0.3, y = -0.7;
  const std::vector<double> values = {std::sin(2.1 * x + 0.3) * std::cos(1.7 * y - 0.2),
                                      std::sin(1.3 * x + 2.2 * y + 0.5),
                                      std::cos(2.4 * x - 1.1 * y - 0.4),
                                      0.6 * x * x - 0.8 * x * y + 0.5 * y * y + 0.3 * x,
                                      std::sin(1.2 * x - 0.8) * std::sin(2.6 * y + 0.6),
                                      std::cos(0.7 * x - 2.9 * y + 0.1) + 0.5 * std::sin(2.7 * x + 0.9 * y),
                                      std::exp(x) * std::cos(y),
                                      x * x * x - 1.5 * x * y * y + x * x * y + 0.5 * y * y,
                                      std::exp(-2 * (x + 0.1) * (x + 0.1) - 2 * (y - 0.2) * (y - 0.2)),
                                      0.7 * x - 0.4 * y + 0.2};
  ASSERT_EQ(all_fields().size(), values.size());
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(all_fields()[i].at({x, y}).u, values[i], 1e-14) << all_fields()[i].field.name;
    EXPECT_EQ(error_fields()[i].name, all_fields()[i].field.name);
    names.insert(error_fields()[i].name);
  }
  EXPECT_EQ(names.size(), values.size());
}

TEST(ErrorFields, SizesAreRootMeanSquaresOverTheSquare) {
  constexpr int kSide = 400;
  for (const Field& field : all_fields()) {
    double value = 0, gradient = 0;
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j) {
        const FieldValue at = field.at({2 * (i + 0.5) / kSide - 1, 2 * (j + 0.5) / kSide - 1});
        value += at.u * at.u / kSide / kSide;
        gradient += squared_length(at.gradient) / kSide / kSide;
      }
    }
    EXPECT_NEAR(size_of(field).value, std::sqrt(value), 1e-4) << field.field.name;
    EXPECT_NEAR(size_of(field).gradient, std::sqrt(gradient), 1e-4) << field.field.name;
  }
}

TEST(ErrorFields, AreSelectedByNameAndByGroup) {
  const auto names = [](const std::vector<std::string>& asked) {
    std::string text;
    const auto fields = select_fields(asked);
    if (!fields) return fields.error().message;
    for (const Field& field : *fields) text += std::string(field.field.name) + " ";
    return text;
  };
  EXPECT_EQ(names({"chosen"}), "product oblique counter quadratic ");
  EXPECT_EQ(names({"held-back"}), "crossed two-waves harmonic cubic bump ");
  EXPECT_EQ(names({}), names({"all"}));
  EXPECT_EQ(names({}), names({"held-back", "chosen", "bump"}));
  EXPECT_EQ(names({"exact"}), "linear ");
  EXPECT_EQ(names({"bump", "oblique", "bump"}), "oblique bump ");
  EXPECT_TRUE(names({"chosen", "sine"}).starts_with("no field 'sine'; the fields are all, chosen, held-back"));
}

TEST(ErrorQuadrature, IsExactForDegreeSevenAndAMeanAtAPoint) {
  for (int degree = 0; degree <= 7; ++degree) {
    for (const Vec2 end : {Vec2{0.1, 0}, Vec2{3.3, 0}, Vec2{0, 0}}) {
      double mean = 0;
      along_segment({0, 0}, end, [&](Vec2 p, double weight) { mean += weight * std::pow(p.x, degree); });
      EXPECT_NEAR(mean, std::pow(end.x, degree) / (degree + 1), 1e-13 * (1 + std::pow(end.x, degree)));
    }
  }
}

TEST(ErrorQuadrature, EndsWhereTheSegmentDoesNot) {
  std::size_t samples = 0;
  along_segment({0, 0}, {1e300, HUGE_VAL}, [&](Vec2, double) { ++samples; });
  EXPECT_EQ(samples, 4 * static_cast<std::size_t>(kMostPieces));
}

}  // namespace
}  // namespace temper::error_detail

// Descent by L-BFGS: its directions, and its steps for all points of a mesh at once.
#include "base/descent.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "temper/detail/ids.hpp"

namespace temper {
namespace {

/// ½ xᵀ A x with A = diag(1, 2, …, n): the gradient.
std::vector<double> gradient_at(const std::vector<double>& x) {
  std::vector<double> g = x;
  for (std::size_t i = 0; i < g.size(); ++i) g[i] *= static_cast<double>(i + 1);
  return g;
}

TEST(Descent, WithExactSearchesEndsAQuadraticFunctionInAsManyStepsAsUnknowns) {
  std::vector<double> x = {1, -2, 0.5, 3, -1};
  Descent descent;
  for (std::size_t step = 0; step < x.size(); ++step) {
    const std::vector<double> g = gradient_at(x);
    std::vector<double> d = descent.direction(g);
    EXPECT_LT(dot(d, g), 0);
    const double t = -dot(d, g) / dot(d, gradient_at(d));
    for (std::size_t i = 0; i < x.size(); ++i) d[i] *= t, x[i] += d[i];
    std::vector<double> change = gradient_at(x);
    for (std::size_t i = 0; i < x.size(); ++i) change[i] -= g[i];
    descent.learn(d, change);
  }
  EXPECT_LT(largest(x), 1e-10);
}

TEST(Descent, LearnsNothingFromStepsWithoutCurvature) {
  Descent descent;
  descent.learn({1, 0}, {-1, 0});
  EXPECT_TRUE(descent.knows_nothing());
  descent.learn({1, 0}, {2, 0});
  EXPECT_FALSE(descent.knows_nothing());
  EXPECT_EQ(descent.direction({2, 0}), (std::vector<double>{-1, 0}));
  descent.forget();
  EXPECT_TRUE(descent.knows_nothing());
}

/// Points on a line that are drawn to 0. Elements are pairs of neighbors, and their room is the distance.
struct Chain {
  static constexpr std::size_t kUnknowns = 1;
  struct Value {
    double lowered = 0;
    std::vector<double> gradient;
  };

  std::vector<double> before, at;
  double limit = std::numeric_limits<double>::infinity();  // points beyond it are outside
  bool is_last_step = false;                               // then there is no gradient

  explicit Chain(std::vector<double> x) : before(x), at(std::move(x)) {}
  [[nodiscard]] std::size_t n_elements() const { return at.size() - 1; }
  [[nodiscard]] std::array<VertexId, 2> corners(std::size_t e) const { return {VertexId(e), VertexId(e + 1)}; }
  [[nodiscard]] double room(std::size_t e) const { return at[e + 1] - at[e]; }
  void place(const std::vector<double>& step, double t) {
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = before[i] + t * step[i];
  }
  [[nodiscard]] bool is_inside() const { return at.front() < limit; }
  [[nodiscard]] Value value() const {
    Value v = {0, is_last_step ? std::vector<double>{} : at};
    for (const double x : at) v.lowered += 0.5 * x * x;
    return v;
  }
};

TEST(Descent, TakesStepsThatLowerTheFunctionAndKeepAPartOfEachRoom) {
  Chain chain({1, 1.01, 3, 4});
  Descent descent;
  Chain::Value now = chain.value();
  for (int i = 0; i < 20; ++i) {
    chain.before = chain.at;
    const Chain start = chain;
    const double lowered = now.lowered;
    if (descent.take_step(chain, now, nullptr, [] { return false; }) != Descent::Outcome::taken) continue;
    EXPECT_LT(now.lowered, lowered);
    EXPECT_EQ(now.gradient, chain.at);
    for (std::size_t e = 0; e < chain.n_elements(); ++e) EXPECT_GE(chain.room(e), 0.19 * start.room(e));
    for (std::size_t p = 0; p < chain.at.size(); ++p) EXPECT_LE(std::abs(chain.at[p] - start.at[p]), 0.3 + 1e-12);
  }
  EXPECT_LT(now.lowered, 0.5);
}

TEST(Descent, LearnsNothingFromTheLastStep) {
  Chain chain({1, 2, 3});
  Descent descent;
  Chain::Value now = chain.value();
  const double lowered = now.lowered;
  chain.is_last_step = true;
  EXPECT_EQ(descent.take_step(chain, now, nullptr, [] { return false; }), Descent::Outcome::taken);
  EXPECT_LT(now.lowered, lowered);
  EXPECT_TRUE(descent.knows_nothing());
}

TEST(Descent, LeavesPointsWhereTheyWereIfNoStepIsTaken) {
  const std::vector<double> x = {1, 2, 3};
  Chain chain(x);
  Descent descent;
  Chain::Value now = chain.value();
  EXPECT_EQ(descent.take_step(chain, now, nullptr, [] { return true; }), Descent::Outcome::stopped);
  EXPECT_EQ(chain.at, x);
  chain.limit = 0;  // nothing is inside
  EXPECT_EQ(descent.take_step(chain, now, nullptr, [] { return false; }), Descent::Outcome::stuck);
  EXPECT_EQ(chain.at, x);
  descent.learn({1, 0, 0}, {1, 0, 0});
  EXPECT_EQ(descent.take_step(chain, now, nullptr, [] { return false; }), Descent::Outcome::none);
  EXPECT_TRUE(descent.knows_nothing());
  EXPECT_EQ(chain.at, x);
  chain.limit = std::numeric_limits<double>::infinity();
  for (const double slope : {chain.limit, -chain.limit, std::nan("")}) {
    now.gradient[1] = slope;
    EXPECT_EQ(descent.take_step(chain, now, nullptr, [] { return false; }), Descent::Outcome::stuck);
    EXPECT_EQ(chain.at, x);
  }
}

TEST(LogObjective, HasTheDerivativesOfItsValue) {
  const std::vector<double> start = {2, 0.5};
  const auto value = [&](double a, double b, double total) { return log_objective({a, b}, start, total, 3).value; };
  const LogObjective here = log_objective({1.5, 0.25}, start, 0.7, 3);
  EXPECT_NEAR(here.value, std::log((1.5 / 2 + 0.25 / 0.5) / 2) + 3 * std::log(0.7), 1e-14);
  constexpr double kStep = 1e-5;
  const auto slope = [&](double above, double below) { return (above - below) / (2 * kStep); };
  EXPECT_NEAR(here.by_error[0], slope(value(1.5 + kStep, 0.25, 0.7), value(1.5 - kStep, 0.25, 0.7)), 1e-8);
  EXPECT_NEAR(here.by_error[1], slope(value(1.5, 0.25 + kStep, 0.7), value(1.5, 0.25 - kStep, 0.7)), 1e-8);
  EXPECT_NEAR(here.by_total, slope(value(1.5, 0.25, 0.7 + kStep), value(1.5, 0.25, 0.7 - kStep)), 1e-8);
}

}  // namespace
}  // namespace temper

// Sine and cosine from additions and multiplications alone. They have the same bits on every machine, unlike the
// functions of C libraries.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

namespace temper {

struct SineCosine {
  double sine = 0, cosine = 0;
};

/// Sine and cosine of x in radians, to 2e-16 where |x| < 1e6. Beyond, x is first taken modulo the double next to 2π,
/// with an error as large as the rounding of x.
inline SineCosine sine_cosine(double x) {
  constexpr double kRound = 0x1.8p52;  // added and taken away, it leaves a whole number
  constexpr double kQuarter[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};  // sum π/2; 33 bits each
  if (!(std::abs(x) < 1e6)) {
    if (!std::isfinite(x)) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
    x = std::fmod(x, 2 * std::numbers::pi);
  }
  const double quarters = (x * (2 / std::numbers::pi) + kRound) - kRound;
  const double r = ((x - quarters * kQuarter[0]) - quarters * kQuarter[1]) - quarters * kQuarter[2];
  // Taylor's series on [−π/4, π/4]; the first omitted terms are below 3e-18.
  constexpr double kSine[] = {-1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
                              -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};
  constexpr double kCosine[] = {-0.5,           1.0 / 24,        -1.0 / 720,         1.0 / 40320,
                                -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
  const double z = r * r, zz = z * z;
  const auto series = [z, zz](const double(&k)[8]) {
    return (k[0] + k[1] * z) + zz * ((k[2] + k[3] * z) + zz * ((k[4] + k[5] * z) + zz * (k[6] + k[7] * z)));
  };
  const double s = r + r * z * series(kSine), c = 1 + z * series(kCosine);
  const int quarter = static_cast<int>(quarters);
  const double sine = (quarter & 1) != 0 ? c : s, cosine = (quarter & 1) != 0 ? s : c;
  return {(quarter & 2) != 0 ? -sine : sine, ((quarter + 1) & 2) != 0 ? -cosine : cosine};
}

/// The angle in [0, π/2] of a cosine in [0, 1], to 7e-5 of itself: Abramowitz and Stegun, 4.4.45.
inline double rough_acute_angle(double cosine) {
  return std::sqrt(1 - cosine) * (1.5707288 + cosine * (-0.2121144 + cosine * (0.0742610 - cosine * 0.0187293)));
}

/// The angle in [0, π] of this cosine, which is first clamped to [−1, 1]. Its cosine is x to 1e-15.
inline double arc_cosine(double x) {
  const double t = std::fmin(std::abs(x), 1.0);
  double angle = rough_acute_angle(t);  // Newton's iteration squares the error
  for (int i = 0; i < 2 && angle > 0; ++i) {
    const SineCosine at = sine_cosine(angle);
    angle += (at.cosine - t) / at.sine;
  }
  return x < 0 ? std::numbers::pi - angle : angle;
}

}  // namespace temper

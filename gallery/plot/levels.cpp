#include "plot/levels.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "plot/axes.hpp"
#include "plot/ticks.hpp"

namespace temper {
namespace {

constexpr int kDigits = 2;  // significant ones of a level chosen by quantile

std::vector<double> finite_sorted(std::span<const double> values) {
  std::vector<double> sorted;
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double v) { return std::isfinite(v); });
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

std::vector<double> linear_levels(double low, double high, double n) {
  std::vector<double> levels;
  for (const Tick& tick : linear_ticks(drawable({low, high}, false), n).ticks) levels.push_back(tick.value);
  return levels;
}

// 1, 2, 5 times powers of ten up to the largest magnitude, from as small as n levels allow.
std::vector<double> geometric_levels(double low, double high, std::size_t n) {
  const std::size_t sides = (low < 0 ? 1u : 0u) + (high > 0 ? 1u : 0u);
  const std::size_t per_side = std::max<std::size_t>(1, n / std::max<std::size_t>(1, sides));
  std::vector<double> levels;
  if (low < 0 && high > 0) levels.push_back(0);
  for (const double sign : {-1.0, 1.0}) {
    const double most = sign < 0 ? -low : high, least = std::max(0.0, sign < 0 ? -high : low);
    if (!(most > 0)) continue;
    std::size_t taken = 0;
    for (int k = static_cast<int>(std::floor(std::log10(most))); taken < per_side && k > -300; --k) {
      for (const double m : {5.0, 2.0, 1.0}) {
        const double level = k >= 0 ? m * std::pow(10.0, k) : m / std::pow(10.0, -k);
        if (level > most || level < least || taken == per_side) continue;
        levels.push_back(sign * level);
        ++taken;
      }
      if (std::pow(10.0, k) < least) break;
    }
  }
  return levels;
}

// The nearest number of few digits.
double rounded(double value) {
  char buffer[64];
  const auto text = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific, kDigits - 1);
  double result = value;
  std::from_chars(buffer, text.ptr, result);
  return result;
}

std::vector<double> quantile_levels(const std::vector<double>& sorted, std::size_t n) {
  std::vector<double> levels;
  for (std::size_t k = 1; k <= n; ++k) {
    const double at = static_cast<double>(k) / static_cast<double>(n + 1) * static_cast<double>(sorted.size() - 1);
    levels.push_back(rounded(sorted[static_cast<std::size_t>(at)]));
  }
  return levels;
}

std::vector<double> chosen(const ContourPlot& plot) {
  if (!plot.levels.empty()) return finite_sorted(plot.levels);
  const std::vector<double> sorted = finite_sorted(plot.values);
  const std::size_t n = std::max<std::size_t>(1, plot.n_levels);
  if (sorted.empty() || !(sorted.front() < sorted.back())) return {};
  const double low = sorted.front(), high = sorted.back();
  switch (plot.spacing) {
    case LevelSpacing::linear:
      return linear_levels(low, high, static_cast<double>(n));
    case LevelSpacing::geometric:
      return geometric_levels(low, high, n);
    case LevelSpacing::quantile:
      break;
  }
  return quantile_levels(sorted, n);
}

}  // namespace

std::vector<double> choose_levels(const ContourPlot& plot) {
  std::vector<double> levels = chosen(plot);
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

std::string Rgb::text() const {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text = "#";
  for (const double part : {r, g, b}) {
    const auto byte = static_cast<std::size_t>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
    text += kHex[byte / 16];
    text += kHex[byte % 16];
  }
  return text;
}

Rgb band_color(double t) {
  constexpr std::array<Rgb, 6> kStops = {Rgb{1.00, 0.98, 0.86}, {0.84, 0.92, 0.74}, {0.60, 0.81, 0.73},
                                         {0.33, 0.65, 0.71},    {0.17, 0.45, 0.62}, {0.12, 0.24, 0.45}};
  const double at = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double s = at - static_cast<double>(i);
  const Rgb &a = kStops[i], &b = kStops[i + 1];
  return {a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b)};
}

}  // namespace temper

// Means of former cells, and what closes the sums.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/assert.hpp"
#include "geometry/expansion.hpp"
#include "temper/detail/transfer.hpp"

namespace temper {
namespace {

// Changes of the size of a region below this are rounding.
constexpr double kSameSize = 1e-12;
// What is missing below this share of the integral of |u| is rounding: cells that have not changed keep their values.
constexpr double kRounding = 0x1p-50;

/// A sum with its rounding errors, which are added at the end.
class Sum {
 public:
  void add(double x) {
    const exact::TwoTerms s = exact::two_sum(high_, x);
    high_ = s.high, low_ += s.low;
  }
  [[nodiscard]] double value() const { return high_ + low_; }

 private:
  double high_ = 0, low_ = 0;
};

/// The bounds of a value.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  void add(const Range& other) { low = std::min(low, other.low), high = std::max(high, other.high); }
  [[nodiscard]] double clamp(double x) const { return std::clamp(x, low, high); }
};

/// Integrals over a region, or over the domain.
struct Integrals {
  Sum size, values, magnitudes;
  void add(double part, double value) {
    size.add(part), values.add(part * value), magnitudes.add(part * std::abs(value));
  }
};

/// Conserves one array.
class Transfer {
 public:
  Transfer(const CellOverlaps& overlaps, std::span<const double> former) : overlaps_(overlaps), former_(former) {}
  Conserved run();

 private:
  struct Region {
    Integrals former, now;
    Range range;                       // of former values
    std::vector<std::uint32_t> cells;  // that have no part elsewhere
    [[nodiscard]] double missing() const { return former.values.value() - now.values.value(); }
    [[nodiscard]] double magnitude() const { return former.magnitudes.value(); }
    [[nodiscard]] double growth() const { return now.size.value() - former.size.value(); }
  };
  std::size_t number_of(std::int32_t region);
  void measure_former();
  void find_cells();
  void take_means();
  [[nodiscard]] double mean_of(std::size_t part, Range& range) const;
  void measure_now();
  void close(const Region& region);
  template <class TargetOf>
  double fill(double missing, const std::vector<std::uint32_t>& cells, const TargetOf& target_of);
  void multiply(double missing, const std::vector<std::uint32_t>& cells);
  [[nodiscard]] double beyond() const;

  const CellOverlaps& overlaps_;
  std::span<const double> former_;
  std::map<std::int32_t, std::size_t> numbers_;  // of regions
  std::vector<Region> regions_;
  Region domain_;
  std::vector<double> sizes_;  // of the cells
  std::vector<double> values_;
  std::vector<Range> bounds_;  // of what each cell has taken
};

std::size_t Transfer::number_of(std::int32_t region) {
  const auto [at, is_new] = numbers_.emplace(region, regions_.size());
  if (is_new) regions_.emplace_back();
  return at->second;
}

void Transfer::measure_former() {
  for (const CellPart& part : overlaps_.former) {
    const double value = former_[part.cell];
    for (Region* region : {&regions_[number_of(part.region)], &domain_})
      region->former.add(part.size, value), region->range.add(value);
  }
}

void Transfer::find_cells() {
  const std::vector<CellPart>& parts = overlaps_.parts;
  sizes_.assign(overlaps_.n_cells, 0.0);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::uint32_t cell = parts[p].cell;
    sizes_[cell] += parts[p].size;
    const bool is_first = p == 0 || parts[p - 1].cell != cell;
    const bool is_last = p + 1 == parts.size() || parts[p + 1].cell != cell;
    if (is_first) domain_.cells.push_back(cell);
    if (is_first && is_last) regions_[number_of(parts[p].region)].cells.push_back(cell);
  }
}

/// The mean over what is covered of a part.
double Transfer::mean_of(std::size_t part, Range& range) const {
  const std::size_t first = overlaps_.starts[part], last = overlaps_.starts[part + 1];
  double covered = 0, sum = 0;
  for (std::size_t s = first; s < last; ++s) {
    const CellShare& share = overlaps_.shares[s];
    if (share.size > 0) range.add(former_[share.former]);
    covered += share.size, sum += share.size * former_[share.former];
  }
  if (covered > 0) return range.clamp(sum / covered);
  range.add(former_[overlaps_.shares[first].former]);  // the nearest
  return range.low;
}

void Transfer::take_means() {
  const std::vector<CellPart>& parts = overlaps_.parts;
  values_.assign(overlaps_.n_cells, 0.0), bounds_.assign(overlaps_.n_cells, {});
  for (std::size_t p = 0; p < parts.size();) {
    const std::uint32_t cell = parts[p].cell;
    double sum = 0, last = 0;
    for (; p < parts.size() && parts[p].cell == cell; ++p) {
      Range range;
      last = mean_of(p, range);
      sum += parts[p].size * last;
      bounds_[cell].add(range);
    }
    values_[cell] = bounds_[cell].clamp(sizes_[cell] > 0 ? sum / sizes_[cell] : last);
  }
}

void Transfer::measure_now() {
  domain_.now = {};
  for (Region& region : regions_) region.now = {};
  for (const CellPart& part : overlaps_.parts) {
    for (Region* region : {&regions_[number_of(part.region)], &domain_}) region->now.add(part.size, values_[part.cell]);
  }
}

/// Moves the values of cells towards targets, all by the same part of the way. Returns what is still missing.
template <class TargetOf>
double Transfer::fill(double missing, const std::vector<std::uint32_t>& cells, const TargetOf& target_of) {
  const auto way = [&](std::uint32_t c) {
    const double to_target = target_of(c) - values_[c];
    return (missing > 0) == (to_target > 0) ? to_target : 0;
  };
  Sum all;
  for (const std::uint32_t c : cells) all.add(sizes_[c] * way(c));
  if (all.value() == 0) return missing;
  const double part = std::min(1.0, missing / all.value());
  for (const std::uint32_t c : cells) {
    if (way(c) == 0) continue;
    const double from = values_[c], to = target_of(c);
    values_[c] = part == 1 ? to : std::clamp(from + part * (to - from), std::min(from, to), std::max(from, to));
  }
  return missing - part * all.value();
}

/// Positive values stay positive, and zeros stay.
void Transfer::multiply(double missing, const std::vector<std::uint32_t>& cells) {
  Sum all;
  for (const std::uint32_t c : cells) all.add(sizes_[c] * std::abs(values_[c]));
  if (all.value() == 0) return;
  const double part = missing / all.value();
  for (const std::uint32_t c : cells) values_[c] += part * std::abs(values_[c]);
}

/// Within the bounds of each cell; then, unless only rounding is missing, within the range of the region. Only a
/// region of another size leaves its range.
void Transfer::close(const Region& region) {
  double missing = region.missing();
  if (missing == 0) return;
  const double rounding = kRounding * region.magnitude();
  missing =
      fill(missing, region.cells, [&](std::uint32_t c) { return missing > 0 ? bounds_[c].high : bounds_[c].low; });
  if (!(std::abs(missing) > rounding)) return;
  missing =
      fill(missing, region.cells, [&](std::uint32_t) { return missing > 0 ? region.range.high : region.range.low; });
  if (std::abs(missing) > rounding && std::abs(region.growth()) > kSameSize * region.former.size.value())
    multiply(missing, region.cells);
}

double Transfer::beyond() const {
  double most = 0;
  for (const std::uint32_t c : domain_.cells)
    most = std::max(most, std::abs(values_[c] - domain_.range.clamp(values_[c])));
  const double largest = std::max(std::abs(domain_.range.low), std::abs(domain_.range.high));
  return most == 0 ? 0 : most / largest;
}

Conserved Transfer::run() {
  TEMPER_ASSERT(overlaps_.starts.size() == overlaps_.parts.size() + 1);
  measure_former();
  find_cells();
  take_means();
  measure_now();
  for (const Region& region : regions_) close(region);
  measure_now();
  close(domain_);
  measure_now();
  Conserved result;
  result.beyond = beyond();
  result.values = std::move(values_);
  const auto change = [](const Region& region) {
    return region.magnitude() == 0 ? 0 : std::abs(region.missing()) / region.magnitude();
  };
  for (const Region& region : regions_) result.change = std::max(result.change, change(region));
  result.change = std::max(result.change, change(domain_));
  return result;
}

}  // namespace

Conserved conserve(const CellOverlaps& overlaps, std::span<const double> former) {
  return Transfer(overlaps, former).run();
}

}  // namespace temper

#include "mesher/refusals.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "base/text.hpp"
#include "mesher/estimate.hpp"

namespace temper::mesher {
namespace {

/// Two digits, not less than the value.
std::string two_digits(double value) {
  if (value == 0) return "0";
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", std::ceil(value / unit) * unit);
  return to_text(std::strtod(text, nullptr));  // 20000 rather than 2e+04
}

/// A place below the tolerance is in a sharp corner. Its width grows with the tolerance, and five times that is
/// enough.
double closing_tolerance(const Problem& problem, double width) {
  const double within = problem.tolerance,
               corner = width < within ? std::min(5 * within * (within / width), problem.wanted.most) : 0;
  return std::max({1.05 * width, 4 * within, 4 * problem.rounding, corner});
}

/// Looks for a place that is nearer to an edge than the narrowest one so far.
void find_narrowest(const Problem& problem, const Arrangement& arrangement, std::optional<Gap>& narrowest) {
  const BoundingBoxTree tree = tree_of_edges(problem.surface, arrangement);
  for (std::size_t p = 0; p < arrangement.places.size() && narrowest; ++p) {
    const NearEdge near = nearest_edge(problem.surface, arrangement, tree, p, narrowest->width);
    if (near.edge == NearEdge::kNone) continue;
    narrowest = {near.distance, arrangement.places[p], {near.edge, Gap::kPoint + static_cast<std::uint32_t>(p)}};
  }
}

}  // namespace

double most_triangles(const MesherOptions& options) {
  constexpr double kMostOfMesh = 1.4e9;
  const double most = std::min(static_cast<double>(options.most_triangles), kMostOfMesh);
  return options.memory ? std::min(most, triangles_within(*options.memory)) : most;
}

InputError refused(const MesherOptions& options, double triangles, const std::string& what, const std::string& advice) {
  const MeshEstimate estimate = estimate_of(triangles);
  const bool no_memory = options.memory && !(triangles <= triangles_within(*options.memory));
  return invalid(what + " would make about " + estimate.triangles_text() + " triangles" +
                 (no_memory ? ", which need about " + estimate.memory_text() + " of memory, but " +
                                  MeshEstimate{0, static_cast<double>(*options.memory)}.memory_text() + " are free"
                            : "; at most " + estimate_of(most_triangles(options)).triangles_text() + " are made") +
                 ". Next: " + advice);
}

std::optional<std::string> sizes_that_fit(const Problem& problem, double expected,
                                          const std::function<double(double)>& count, const Deadline& deadline) {
  constexpr double kRoom = 0.8;      // of the largest number: the estimate has errors
  constexpr double kAtLeast = 1.05;  // times, for each try
  constexpr double kFine = 1e-3;     // of the extent: short edges matter less
  constexpr int kTries = 8;
  const double most = kRoom * most_triangles(problem.options);
  if (most < 1) return "more memory";
  if (problem.options.field) {
    return std::isfinite(expected) ? "sizes " + two_digits(std::sqrt(expected / most)) + " times as large"
                                   : std::string("larger sizes");
  }
  const double largest = problem.wanted.most;
  const double fine =
      kFine * (problem.is_closed() ? problem.surface.space().radius() : length(problem.box.high - problem.box.low));
  // The least of two guesses: short edges make triangles at any size.
  double size = std::max(largest, std::min(fine * std::sqrt(count(fine) / most), largest * std::sqrt(expected / most)));
  for (int i = 0; i < kTries && std::isfinite(size) && !deadline.stopped(); ++i) {
    const double triangles = count(size);
    if (triangles <= most) return "a size of " + two_digits(size) + " or more";
    size *= std::max(kAtLeast, std::sqrt(triangles / most));
  }
  return {};
}

std::string narrow_text(const Problem& problem, const Arrangement& arrangement, const std::optional<Gap>& narrowest,
                        double far) {
  if (!narrowest || narrowest->width > far * problem.wanted.most) return {};
  const OutlineNames& names = problem.names;
  const auto side = [&](std::uint32_t s) {
    if (s < Gap::kPoint) return names.segment(arrangement.edges[s].segment);
    const std::uint32_t point = arrangement.point[s - Gap::kPoint];
    return point == Arrangement::kNoPoint ? std::string("a crossing") : names.point(point);
  };
  const auto [one, other] = narrowest->sides;
  const bool edge = one == other;
  return "the outline " + (edge ? "has an edge of " : std::string("is narrow: ")) + two_digits(narrowest->width) +
         " at " + problem.text(narrowest->at) + ", " +
         (edge ? side(one) : "between " + side(one) + " and " + side(other)) +
         ". Next: if that is a mistake, join it by --snap " + two_digits(closing_tolerance(problem, narrowest->width));
}

InputError stopped(const std::string& doing, const std::string& narrow) {
  return {ErrorCode::stopped, "",
          "the run stopped without a mesh, while the outline was " + doing + "; " +
              (narrow.empty() ? "sizes far below the sizes of the outline, and narrow places along its long edges, "
                                "take many triangles. Next: larger sizes, or more time"
                              : narrow + "; or more time")};
}

InputError too_fine(const Problem& problem, const Arrangement& arrangement, std::optional<Gap> narrowest,
                    const InputError& error) {
  find_narrowest(problem, arrangement, narrowest);
  const std::string narrow = narrow_text(problem, arrangement, narrowest, std::numeric_limits<double>::infinity());
  return {ErrorCode::out_of_scale, "",
          "the outline has places too narrow for the precision of its coordinates (" + error.message + "); " +
              (narrow.empty() ? "Next: larger sizes" : narrow)};
}

InputError too_coarse(const Problem& problem) {
  return invalid("edges of " + to_text(problem.wanted.most) + " are too long for a sphere of radius " +
                 to_text(problem.surface.space().radius()));
}

InputError too_many(const std::string& narrow) {
  return {narrow.empty() ? ErrorCode::invalid_option : ErrorCode::out_of_scale, "",
          "short edges and narrow places of the outline, with this grade, would make too many edges and triangles" +
              (narrow.empty() ? std::string() : "; " + narrow)};
}

}  // namespace temper::mesher

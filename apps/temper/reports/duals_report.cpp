// Verdicts on duals, for the targets that need no well-centered mesh.
#include <fmt/format.h>

#include <array>

#include "console.hpp"
#include "reports/quality_report.hpp"

namespace temper::app {
namespace {

std::string coordinates_text(Vec2 at) { return fmt::format("{:.9g}, {:.9g}", at.x, at.y); }
std::string coordinates_text(Vec3 at) { return fmt::format("{:.9g}, {:.9g}, {:.9g}", at.x, at.y, at.z); }
std::string coordinates_text(const EdgePlace& place) {
  return place.z ? coordinates_text(Vec3{place.at.x, place.at.y, *place.z}) : coordinates_text(place.at);
}

/// The duals that a criterion does not allow, and the worst.
template <std::size_t n, class Place>
struct DualsOf {
  std::size_t inside, boundary, region;
  double least;
  std::array<VertexId, n> vertices;
  Place at;
};
template <class Text>
std::string with_duals(const Quality& q, Criterion criterion, const Text& text) {
  const EdgePlace& place = q.min_coefficient_place;
  if (criterion == Criterion::coefficients)
    return text(DualsOf<2, EdgePlace>{q.non_regular_edges, q.negative_boundary_duals, q.negative_region_coefficients,
                                      q.min_coefficient, place.vertices, place});
  return text(DualsOf<2, EdgePlace>{q.nonpositive_distances, q.nonpositive_boundary_distances,
                                    q.nonpositive_region_distances, q.min_coefficient, place.vertices, place});
}
template <class Text>
std::string with_duals(const tets::Quality& q, Criterion criterion, const Text& text) {
  if (criterion == Criterion::coefficients)
    return text(DualsOf<2, Vec3>{q.negative_coefficients, q.negative_boundary_coefficients,
                                 q.negative_region_coefficients, q.min_coefficient, q.min_coefficient_place.vertices,
                                 q.min_coefficient_place.at});
  return text(DualsOf<3, Vec3>{q.nonpositive_distances, q.nonpositive_boundary_distances,
                               q.nonpositive_region_distances, q.min_distance, q.min_distance_place.vertices,
                               q.min_distance_place.at});
}

}  // namespace

std::string count_of_duals(std::size_t violations, Criterion criterion) {
  if (criterion == Criterion::coefficients)
    return violations == 0 ? "no edge has a negative coefficient"
                           : plural(violations, "coefficient is", "coefficients are") + " bad (negative)";
  return violations == 0 ? "all distances between centers are positive"
                         : plural(violations, "distance between centers is", "distances between centers are") +
                               " bad (not positive)";
}

std::string next_step(const std::string& path, const std::string& projection, Criterion criterion,
                      std::string_view target) {
  if (io::is_stream(path)) return {};
  const std::string command = "Next: " + command_line("explain", path, projection);
  return command + (criterion == Criterion::well_centered ? "\n" : fmt::format(" --for {}\n", target));
}

template <class Subject>
std::string target_verdict(const typename Subject::Quality& quality, const InputOf<Subject>& input,
                           Criterion criterion) {
  if (criterion == Criterion::well_centered) return verdict(quality);
  const std::size_t all = violations(quality, criterion);
  if (all == 0)
    return fmt::format("{}: a solver with {} can use this mesh as it is", count_of_duals(0, criterion),
                       criteria_table()[static_cast<std::size_t>(criterion)].needed_by);
  return with_duals(quality, criterion, [&](const auto& duals) {
    const std::size_t n = duals.inside + duals.boundary + duals.region;
    const bool coefficients = criterion == Criterion::coefficients;
    std::string text = fmt::format("{}: {} inside, {} {} the boundary, {} {}", count_of_duals(n, criterion),
                                   duals.inside, duals.boundary, coefficients ? "on" : "from", duals.region,
                                   coefficients ? "of one region alone" : "from interfaces");
    text += fmt::format("; the least{} is {:.4g} at {} {} ({})", over_length<Subject>(criterion), duals.least,
                        duals.vertices.size() == 2 ? "edge" : "face", input.vertex_numbers(duals.vertices, "-"),
                        coordinates_text(duals.at));
    if (all > n) text += fmt::format("; {} inverted", plural(all - n, Subject::element, Subject::elements));
    return text;
  });
}

#define TEMPER_MAKE(S) template std::string target_verdict(const S::Quality&, const InputOf<S>&, Criterion);
TEMPER_EACH_SUBJECT(TEMPER_MAKE)
#undef TEMPER_MAKE

}  // namespace temper::app

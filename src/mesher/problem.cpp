// The extent, the tolerances and the largest size follow from the outline and the options.
#include "mesher/problem.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "temper/detail/geometry.hpp"

namespace temper::mesher {
namespace {

std::string kind_of(const Space& space) {
  switch (space.kind()) {
    case SpaceKind::plane:
      return "the plane";
    case SpaceKind::periodic_plane:
      return "a periodic plane";
    default:
      return "a sphere of radius " + to_text(space.radius());
  }
}

std::optional<InputError> check_options(const MesherOptions& options, const Space& space) {
  const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
  if (options.field && !(options.field->mesh().space() == space)) {
    return invalid("the size field is for " + kind_of(options.field->mesh().space()) + ", but the outline is for " +
                   kind_of(space));
  }
  const bool few = options.points == MeshPoints::few;
  if (few && !space.is_plane())
    return invalid("meshes with few points are for the plane; on the sphere expected a size");
  if (few && !options.optimize)
    return invalid("a mesh with few points needs the optimization; expected options for it");
  if (!few && !positive(options.size) && !(options.field && options.size == 0)) {
    return invalid("expected a size above 0, found " + std::to_string(options.size));
  }
  if (!positive(options.grade)) {
    return invalid("expected a grade above 0, found " + std::to_string(options.grade));
  }
  for (const RegionSize& r : options.region_sizes) {
    if (!positive(r.size)) {
      return invalid("expected a size above 0 for region " + std::to_string(r.region) + ", found " +
                     std::to_string(r.size));
    }
  }
  if (options.snap && !(*options.snap >= 0 && std::isfinite(*options.snap))) {
    return invalid("expected a tolerance of joins of 0 or more, found " + std::to_string(*options.snap));
  }
  if (!(options.drop_below >= 0)) return invalid("expected an extent of 0 or more to drop rings below");
  if (!(options.time_limit >= 0)) return invalid("expected a time limit of 0 or more seconds");
  if (options.attempts < 1) return invalid("expected at least one attempt");
  return {};
}

BoundingBox box_of_all(const std::vector<Vec3>& places) {
  if (places.empty()) return {};
  BoundingBox box = {places[0], places[0]};
  for (const Vec3 p : places) box = united(box, {p, p});
  return box;
}

WantedSize wanted_size(const MesherOptions& options, const BoundingBox& box) {
  if (options.points == MeshPoints::few)
    return {length(box.high - box.low), nullptr};  // nothing is divided for its size
  if (!options.field) return {options.size, nullptr};
  double most = 0;
  for (const VertexId v : options.field->mesh().vertices()) most = std::max(most, options.field->at(v));
  return {options.size > 0 ? std::min(options.size, most) : most, &*options.field};
}

double rounding_of(const Problem& problem) {
  constexpr double kLeastOfRadius = 1e-8, kOfCoordinate = 1e-15;
  if (problem.is_closed()) return kLeastOfRadius * problem.surface.space().radius();
  const auto [low, high] = problem.box;
  return kOfCoordinate * std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
}

double tolerance_of(const Problem& problem) {
  constexpr double kOfExtent = 1e-9, kOfRadius = 1e-7;
  const MesherOptions& options = problem.options;
  if (problem.is_closed())
    return std::max(problem.rounding, options.snap.value_or(kOfRadius * problem.surface.space().radius()));
  if (problem.points.empty() || (options.snap == 0 && !options.split_crossings)) return 0;
  return std::max(problem.rounding, options.snap.value_or(kOfExtent * length(problem.box.high - problem.box.low)));
}

}  // namespace

std::string Problem::text(Vec3 place) const {
  const Vec2 p = names.in_file(surface.space().as_shown(place));
  return "(" + to_text(p.x) + ", " + to_text(p.y) + ")";
}

Problem make_problem(const Space& space, const Outline& outline, std::vector<Vec3> points, const MesherOptions& options,
                     const OptimizeHooks& hooks) {
  const BoundingBox box = box_of_all(points);
  Problem problem{Surface(space), outline, names_of(outline),        std::move(points), options,
                  hooks,          box,     wanted_size(options, box)};
  problem.rounding = rounding_of(problem);
  problem.tolerance = tolerance_of(problem);
  return problem;
}

std::optional<InputError> check(const Problem& problem) {
  if (auto error = check_options(problem.options, problem.surface.space())) return error;
  return check_sizes(problem.outline);
}

const OutlineNames& names_of(const Outline& outline) {
  static const OutlineNames from_zero;
  return outline.names ? *outline.names : from_zero;
}

std::string name_of_tag(const Outline& outline, int dimension, std::int32_t tag) {
  const auto named = std::find_if(outline.groups.begin(), outline.groups.end(),
                                  [&](const PhysicalName& g) { return g.dimension == dimension && g.tag == tag; });
  return named == outline.groups.end() ? "tag " + std::to_string(tag) : "'" + named->name + "'";
}

std::optional<InputError> check_tags(const std::vector<OutlineTag>& tags, const std::string& what, std::size_t n) {
  for (const OutlineTag& tag : tags) {
    if (tag.element >= 0 && static_cast<std::size_t>(tag.element) < n) continue;
    std::string message = "tag " + std::to_string(tag.tag) + " is for ";
    message.append(what).append(" ").append(std::to_string(tag.element));
    message.append(", but the outline has ").append(std::to_string(n)).append(" ").append(what).append("s");
    return InputError{ErrorCode::index_out_of_range, "", std::move(message)};
  }
  return {};
}

std::optional<InputError> check_sizes(const Outline& outline) {
  const OutlineNames& names = names_of(outline);
  const auto n = static_cast<std::int64_t>(outline.points.size());
  for (const OutlineSize& s : outline.sizes) {
    for (const std::int32_t p : s.points) {
      if (p >= 0 && p < n) continue;
      return InputError{ErrorCode::index_out_of_range, "",
                        "size " + to_text(s.size) + " is for point " + std::to_string(p) + ", but the outline has " +
                            std::to_string(n) + " points"};
    }
    if (s.size > 0 && std::isfinite(s.size)) continue;
    const auto p = static_cast<std::size_t>(s.points[0]);
    return InputError{ErrorCode::invalid_option, names.point_where(p),
                      names.point(p) + " has size " + to_text(s.size) + "; expected a finite, positive length"};
  }
  return {};
}

std::vector<std::uint8_t> alone(const Outline& outline) {
  std::vector<std::uint8_t> alone(outline.points.size(), 1);
  for (const OutlineSegment& s : outline.segments) {
    for (const std::int32_t end : s.ends) alone[static_cast<std::size_t>(end)] = 0;
  }
  return alone;
}

}  // namespace temper::mesher

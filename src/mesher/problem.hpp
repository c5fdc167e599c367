// What is to be meshed. Each step of the mesher reads it; none changes it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/bounding_boxes.hpp"
#include "geometry/surface.hpp"
#include "mesher/graded_size.hpp"
#include "temper/mesher.hpp"

namespace temper::mesher {

struct Problem {
  Surface surface;
  const Outline& outline;
  const OutlineNames& names;  ///< of the outline, or names that count from 0
  std::vector<Vec3> points;   ///< places of the outline's points
  const MesherOptions& options;
  const OptimizeHooks& hooks;
  BoundingBox box;       ///< of the points
  WantedSize wanted;     ///< with few points: the extent of the outline
  double rounding = 0;   ///< least tolerance that joins what rounding moved apart
  double tolerance = 0;  ///< of joins. On a sphere the square of a weighted vector has no digits for shorter edges

  [[nodiscard]] Vec3 point(std::int32_t i) const { return points[static_cast<std::size_t>(i)]; }
  [[nodiscard]] bool is_closed() const { return surface.space().is_closed(); }
  [[nodiscard]] bool has_few_points() const { return options.points == MeshPoints::few; }
  /// "(8.5, 53.25)": a place in the coordinates of the file.
  [[nodiscard]] std::string text(Vec3 place) const;
};

/// `points`: places of the outline's points. The result refers to the outline, the options and the hooks.
[[nodiscard]] Problem make_problem(const Space& space, const Outline& outline, std::vector<Vec3> points,
                                   const MesherOptions& options, const OptimizeHooks& hooks);

/// An error of the options, or of the sizes of the outline.
[[nodiscard]] std::optional<InputError> check(const Problem& problem);

/// An error if a tag is for none of the n elements of the outline.
[[nodiscard]] std::optional<InputError> check_tags(const std::vector<OutlineTag>& tags, const std::string& what,
                                                   std::size_t n);

/// An error if a size is for no point of the outline, or no length.
[[nodiscard]] std::optional<InputError> check_sizes(const Outline& outline);

/// The names of the outline, or names that count from 0.
[[nodiscard]] const OutlineNames& names_of(const Outline& outline);

/// "'river'", or "tag 5" without a name.
[[nodiscard]] std::string name_of_tag(const Outline& outline, int dimension, std::int32_t tag);

/// Says for each point of the outline whether no segment ends there.
[[nodiscard]] std::vector<std::uint8_t> alone(const Outline& outline);

/// An error of the options.
[[nodiscard]] inline InputError invalid(const std::string& message) { return {ErrorCode::invalid_option, "", message}; }

}  // namespace temper::mesher

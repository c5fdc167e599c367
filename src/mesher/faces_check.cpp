// Lines that cannot become faces, with place and reason.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/text.hpp"
#include "mesher/corridors.hpp"
#include "mesher/face_nodes.hpp"
#include "mesher/outline_check.hpp"
#include "mesher/triangulated.hpp"

namespace temper::mesher {
namespace {

/// The edges at a place of the outline.
struct Meeting {
  std::vector<std::size_t> faces, lines;
};

std::vector<Meeting> meetings(const Arrangement& arrangement) {
  std::vector<Meeting> all(arrangement.places.size());
  for (std::size_t i = 0; i < arrangement.edges.size(); ++i) {
    for (const std::int32_t end : arrangement.edges[i].ends) {
      Meeting& at = all[static_cast<std::size_t>(end)];
      (arrangement.edges[i].as == LineKind::faces ? at.faces : at.lines).push_back(i);
    }
  }
  return all;
}

/// "'fault'" or "segment 5".
std::string name_of_edge(const Problem& problem, const OutlineEdge& edge) {
  return edge.tags.empty() ? problem.names.segment(edge.segment) : name_of_tag(problem.outline, 1, edge.tags.front());
}

struct Refusal {
  std::string what, next;  ///< what is wrong, and what to do
};

InputError at_face(const Problem& problem, const Domain& domain, std::size_t edge, Vec3 place, const Refusal& refusal) {
  const OutlineEdge& e = domain.arrangement.edges[edge];
  return {ErrorCode::unsupported, problem.names.segment_where(e.segment),
          name_of_edge(problem, e) + ", which becomes faces, " + refusal.what + " at " + problem.text(place) +
              ". Next: " + refusal.next};
}

/// Cells have no center on their faces.
std::optional<InputError> check_points(const Problem& problem, const Domain& domain, const std::vector<Meeting>& all) {
  std::vector<std::uint8_t> stays = alone(problem.outline);
  for (const OutlineTag& p : problem.outline.point_tags) stays[static_cast<std::size_t>(p.element)] = 1;
  for (std::size_t i = 0; i < stays.size(); ++i) {
    const std::int32_t place = domain.arrangement.place_of_point[i];
    if (stays[i] == 0 || place < 0 || all[static_cast<std::size_t>(place)].faces.empty()) continue;
    return at_face(problem, domain, all[static_cast<std::size_t>(place)].faces.front(), domain.arrangement.place(place),
                   {"passes through " + problem.names.point(i) + ", which needs a cell with its center there,",
                    "move one of them, or leave the line edges"});
  }
  return {};
}

/// The direction in which an edge leaves a place, of length 1.
Vec3 direction_of(const Problem& problem, const Arrangement& arrangement, std::size_t edge, std::size_t place) {
  const auto [a, b] = arrangement.edges[edge].ends;
  return problem.surface.direction(arrangement.places[place],
                                   arrangement.place(static_cast<std::size_t>(std::int64_t{a}) == place ? b : a));
}

/// Says whether the two lines at a place turn there.
bool turn(const Problem& problem, const Arrangement& arrangement, std::size_t place, const Meeting& at) {
  constexpr double kStraight = 1e-6;  // radians
  return length(direction_of(problem, arrangement, at.lines[0], place) +
                direction_of(problem, arrangement, at.lines[1], place)) >= kStraight;
}

/// Lines that nearly coincide would have cells much smaller than their distance, all along.
std::optional<InputError> check_angles(const Problem& problem, const Domain& domain, std::size_t place,
                                       const Meeting& at) {
  constexpr double kLeast = 1;  // degrees
  const Arrangement& arrangement = domain.arrangement;
  const auto angle = [&](std::size_t e, std::size_t f) {
    const Vec3 u = direction_of(problem, arrangement, e, place), v = direction_of(problem, arrangement, f, place);
    return 2 * std::asin(std::min(1.0, 0.5 * length(u - v))) * 180 / std::numbers::pi;
  };
  for (std::size_t i = 0; i < at.faces.size(); ++i) {
    std::vector<std::size_t> others(at.faces.begin() + static_cast<std::ptrdiff_t>(i) + 1, at.faces.end());
    others.insert(others.end(), at.lines.begin(), at.lines.end());
    for (const std::size_t other : others) {
      const double degrees = angle(at.faces[i], other);
      if (degrees >= kLeast) continue;
      return at_face(problem, domain, at.faces[i], arrangement.places[place],
                     {"meets " + name_of_edge(problem, arrangement.edges[other]) + " at an angle of " +
                          to_text(std::round(100 * degrees) / 100) + " degrees, where at least 1 degree must be,",
                      "a larger angle, or one line in the place of two that nearly coincide"});
    }
  }
  return {};
}

/// Says whether an edge has the outside on one side, or another region.
bool is_border(const Domain& domain, std::size_t edge) {
  const auto [left, right] = domain.areas.sides[edge];
  return left == kOutside || right == kOutside || domain.area(left).region != domain.area(right).region;
}

/// The boundary, and a border between regions that stays edges, must be straight at a face: the face crosses one of
/// their edges. Another line cuts its bend there.
std::optional<InputError> check_lines(const Problem& problem, const Domain& domain, std::size_t place,
                                      const Meeting& at) {
  const Arrangement& arrangement = domain.arrangement;
  const Vec3 p = arrangement.places[place];
  if (at.lines.size() > 2) {
    return at_face(problem, domain, at.faces.front(), p,
                   {"meets " + std::to_string(at.lines.size()) + " edges of other lines, where two at most can be,",
                    "end the line elsewhere"});
  }
  if (at.lines.size() < 2 || !is_border(domain, at.lines[0]) || !turn(problem, arrangement, place, at)) return {};
  const std::array<std::int32_t, 2>& sides = domain.areas.sides[at.lines[0]];
  if (std::ranges::find(sides, kOutside) != sides.end()) {
    return at_face(problem, domain, at.faces.front(), p,
                   {"ends at a corner of the boundary, where a cell has its center,",
                    "end it on a straight part of the boundary"});
  }
  return at_face(problem, domain, at.faces.front(), p,
                 {"meets the border " + name_of_edge(problem, arrangement.edges[at.lines[0]]) +
                      " where that bends, and not only where it is straight,",
                  "move the bend away from the line that becomes faces, or make the border faces, too"});
}

}  // namespace

std::optional<InputError> check_faces(const Problem& problem, const Domain& domain) {
  const auto& edges = domain.arrangement.edges;
  const auto first = std::ranges::find(edges, LineKind::faces, &OutlineEdge::as);
  if (first == edges.end()) return {};
  const auto edge = static_cast<std::size_t>(first - edges.begin());
  if (problem.is_closed() || problem.has_few_points()) {
    return at_face(problem, domain, edge, domain.arrangement.ends(edge)[0],
                   {problem.is_closed() ? "begins on a sphere, where no lines become faces,"
                                        : "begins in a mesh with few points, where no lines become faces,",
                    problem.is_closed() ? "a projection, or leave the line edges" : "a size, or leave the line edges"});
  }
  const std::vector<Meeting> all = meetings(domain.arrangement);
  if (auto error = check_points(problem, domain, all)) return error;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].faces.empty()) continue;
    if (auto error = check_lines(problem, domain, i, all[i])) return error;
    if (auto error = check_angles(problem, domain, i, all[i])) return error;
  }
  return {};
}

void warn_of_lines_at_faces(const Problem& problem, Domain& domain) {
  Arrangement& arrangement = domain.arrangement;
  const std::vector<Meeting> all = meetings(arrangement);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Meeting& at = all[i];
    if (at.faces.empty() || at.lines.empty()) continue;
    const bool ends = at.lines.size() == 1;
    if (!ends && !turn(problem, arrangement, i, at)) continue;
    arrangement.warnings.push_back(
        name_of_edge(problem, arrangement.edges[at.lines[0]]) + (ends ? " ends on " : " bends on ") +
        name_of_edge(problem, arrangement.edges[at.faces[0]]) + " at " + problem.text(arrangement.places[i]) +
        (ends ? ": in the mesh it ends at the center of the cell before this face"
              : ": in the mesh it goes straight between the centers of the cells on both sides of the bend"));
  }
}

InputError no_room_for_faces(const Problem& problem, const Domain& domain, Vec3 place) {
  std::size_t nearest = 0;
  double least = -1;
  for (std::size_t i = 0; i < domain.arrangement.edges.size(); ++i) {
    if (domain.arrangement.edges[i].as != LineKind::faces) continue;
    const auto [a, b] = domain.arrangement.ends(i);
    const double squared = problem.surface.squared_distance(place, a, b);
    if (least < 0 || squared < least) least = squared, nearest = i;
  }
  return at_face(
      problem, domain, nearest, place,
      {"has no room for cells on both sides", "a larger distance or angle to other lines, or leave it edges"});
}

}  // namespace temper::mesher

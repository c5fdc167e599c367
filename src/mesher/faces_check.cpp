// Lines that cannot become faces, with place and reason.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/text.hpp"
#include "mesher/corridors.hpp"
#include "mesher/face_nodes.hpp"
#include "mesher/outline_check.hpp"

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

/// A line that stays edges must be straight at a face: the face crosses one of its edges.
std::optional<InputError> check_lines(const Problem& problem, const Domain& domain, std::size_t place,
                                      const Meeting& at) {
  constexpr double kStraight = 1e-6;  // radians
  const Arrangement& arrangement = domain.arrangement;
  const Vec3 p = arrangement.places[place];
  const std::string other = at.lines.empty() ? "" : name_of_edge(problem, arrangement.edges[at.lines.front()]);
  const auto is_boundary = [&](std::size_t e) {
    return std::ranges::find(domain.areas.sides[e], kOutside) != domain.areas.sides[e].end();
  };
  if (at.lines.size() > 2) {
    return at_face(problem, domain, at.faces.front(), p,
                   {"meets " + std::to_string(at.lines.size()) + " edges of other lines, where two at most can be,",
                    "end the line elsewhere"});
  }
  if (at.lines.size() < 2) return {};
  const auto direction = [&](std::size_t e) {
    const auto [a, b] = arrangement.edges[e].ends;
    return problem.surface.direction(p, arrangement.place(static_cast<std::size_t>(std::int64_t{a}) == place ? b : a));
  };
  const Vec3 u = direction(at.lines[0]), v = direction(at.lines[1]);
  if (length(u + v) < kStraight) return {};
  if (is_boundary(at.lines[0])) {
    return at_face(problem, domain, at.faces.front(), p,
                   {"ends at a corner of the boundary, where a cell has its center,",
                    "end it on a straight part of the boundary"});
  }
  return at_face(problem, domain, at.faces.front(), p,
                 {"meets " + other + " where that bends, and not only where it is straight,",
                  "move the bend away from the line that becomes faces"});
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
  }
  return {};
}

void warn_of_ends_on_faces(const Problem& problem, Domain& domain) {
  Arrangement& arrangement = domain.arrangement;
  const std::vector<Meeting> all = meetings(arrangement);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].faces.empty() || all[i].lines.size() != 1) continue;
    arrangement.warnings.push_back(name_of_edge(problem, arrangement.edges[all[i].lines[0]]) + " ends on " +
                                   name_of_edge(problem, arrangement.edges[all[i].faces[0]]) + " at " +
                                   problem.text(arrangement.places[i]) +
                                   ": in the mesh it ends at the center of the cell before this face");
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

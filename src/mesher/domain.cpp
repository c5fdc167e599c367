// Arranges the outline, finds its areas, drops edges with nothing on either side, divides touching fans.
#include "mesher/domain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesher/refusals.hpp"

namespace temper::mesher {
namespace {

/// Leaves out edges with nothing to mesh on either side.
void leave_out_edges(Domain& domain) {
  auto& edges = domain.arrangement.edges;
  auto& sides = domain.areas.sides;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (sides[i][0] == kOutside && sides[i][1] == kOutside) continue;
    if (kept != i) edges[kept] = std::move(edges[i]);
    sides[kept++] = sides[i];
  }
  edges.resize(kept);
  sides.resize(kept);
}

/// An end of an edge, seen from its place.
struct Spoke {
  std::size_t edge, end;  // 0 or 1
  double angle;
  bool left, right;  // is the inside there?
};

std::vector<Spoke> spokes_at(const Surface& surface, const Domain& domain, std::span<const std::size_t> ends) {
  const Arrangement& arrangement = domain.arrangement;
  const auto& sides = domain.areas.sides;
  std::vector<Spoke> spokes;
  for (const std::size_t i : ends) {
    const std::size_t edge = i / 2, end = i % 2;
    const std::array<Vec3, 2> at = arrangement.ends(edge);
    const Vec3 p = at[end], d = surface.direction(p, at[1 - end]), first = surface.some_direction(p);
    spokes.push_back({edge, end, std::atan2(dot(d, surface.to_the_left(first, p)), dot(d, first)),
                      sides[edge][end] != kOutside, sides[edge][1 - end] != kOutside});
  }
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& s, const Spoke& t) {
    return s.angle < t.angle || (s.angle == t.angle && s.edge < t.edge);
  });
  return spokes;
}

/// The direction in the middle of the fan that begins with a spoke.
double middle_of_fan(std::span<const Spoke> spokes, std::size_t begin) {
  const double from = spokes[begin].angle;
  double half = 0;  // of the angle of the fan
  for (std::size_t k = begin + 1; k <= spokes.size(); ++k) {
    const Spoke& last = spokes[k % spokes.size()];
    half = 0.5 * (last.angle - from + (last.angle < from ? 2 * std::numbers::pi : 0));
    if (!last.left) break;
  }
  return from + half;
}

bool begins_fan(const Spoke& s) { return s.left && !s.right; }

//        \  1  /
//         a   b         Fans 1 and 2 of the inside touch at p. Fan 1 keeps p. The edges around fan 2 get p′.
//  outside  p  outside
//         d p′ c
//        /  2  \  .
void split_at(const Problem& problem, std::size_t p, std::span<const Spoke> spokes, Arrangement& arrangement) {
  auto to = static_cast<std::int32_t>(p);
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    if (begins_fan(spokes[k]) && k > 0) {
      const Surface& surface = problem.surface;
      const Vec3 at = arrangement.places[p], x = surface.some_direction(at), y = surface.to_the_left(x, at);
      const double angle = middle_of_fan(spokes, k);
      to = static_cast<std::int32_t>(arrangement.places.size());
      arrangement.places.push_back(
          surface.below(at + (0.5 * problem.tolerance) * (std::cos(angle) * x + std::sin(angle) * y)));
      arrangement.point.push_back(Arrangement::kNoPoint);
      arrangement.origin.push_back(static_cast<std::int32_t>(p));
    }
    arrangement.edges[spokes[k].edge].ends[spokes[k].end] = to;
  }
}

InputError touching(const Problem& problem, Vec3 place, std::size_t one, std::size_t other) {
  return {ErrorCode::non_manifold_vertex, problem.names.segment_where(one),
          "the domain touches itself at " + problem.text(place) + ", a point of " + problem.names.segment(one) +
              " and " + problem.names.segment(other) + ". Next: a tolerance --snap above 0 divides it there"};
}

std::optional<InputError> split_touching(const Problem& problem, Domain& domain) {
  auto& [arrangement, areas] = domain;
  const std::size_t n = arrangement.places.size();
  std::vector<std::vector<std::size_t>> ends(n);  // twice the edge, and which end
  std::vector<std::uint32_t> fans(n, 0);
  for (std::size_t i = 0; i < arrangement.edges.size(); ++i) {
    for (const std::size_t end : {0, 1}) {
      const auto p = static_cast<std::size_t>(arrangement.edges[i].ends[end]);
      ends[p].push_back(2 * i + end);
      if (areas.sides[i][end] != kOutside && areas.sides[i][1 - end] == kOutside) ++fans[p];
    }
  }
  std::size_t split = 0, first = 0;
  for (std::size_t p = 0; p < n; ++p) {
    if (fans[p] < 2) continue;
    std::vector<Spoke> spokes = spokes_at(problem.surface, domain, ends[p]);
    const std::size_t one = arrangement.edges[spokes.front().edge].segment;
    std::rotate(spokes.begin(), std::find_if(spokes.begin(), spokes.end(), begins_fan), spokes.end());
    if (problem.tolerance == 0)
      return touching(problem, arrangement.places[p], one, arrangement.edges[spokes.front().edge].segment);
    if (split++ == 0) first = p;
    split_at(problem, p, spokes, arrangement);
  }
  if (split > 0) {
    arrangement.notes.push_back("points where the domain touched itself, and was divided: " + std::to_string(split) +
                                "; the first is " + problem.text(arrangement.places[first]));
  }
  return {};
}

/// The boundary of the domain stays edges. Lines alone are told of: a border of a region may be on the boundary.
void keep_boundary_edges(Domain& domain) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < domain.arrangement.edges.size(); ++i) {
    OutlineEdge& edge = domain.arrangement.edges[i];
    const auto [left, right] = domain.areas.sides[i];
    if (edge.as != LineKind::faces || (left != kOutside && right != kOutside)) continue;
    edge.as = LineKind::edges;
    n += edge.parts.empty() ? 1 : 0;
  }
  if (n > 0) {
    domain.arrangement.notes.push_back("edges of the boundary that stay edges, although their line becomes faces: " +
                                       std::to_string(n));
  }
}

}  // namespace

Expected<Domain> find_domain(const Problem& problem, Deadline& deadline) {
  deadline.begin("joining points");
  Expected<Arrangement> arrangement = arrange(problem, deadline);
  if (deadline.stopped()) return stopped("joined");
  if (!arrangement) return arrangement.error();
  deadline.begin("finding areas");
  Expected<Areas> areas = find_areas(problem, *arrangement, deadline);
  if (deadline.stopped()) return stopped("searched for areas");
  if (!areas) return areas.error();
  Domain domain = {*std::move(arrangement), *std::move(areas)};
  leave_out_edges(domain);
  keep_boundary_edges(domain);
  if (auto error = split_touching(problem, domain)) return *std::move(error);
  return domain;
}

}  // namespace temper::mesher

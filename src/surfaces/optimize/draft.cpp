#include "surfaces/optimize/draft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace temper::surfaces {
namespace {

// The least cosine between the normals of a triangle before and after its vertices moved.
constexpr double kLeastCosine = 0.3;

std::array<Vec3, 3> places_of(const std::array<VertexId, 3>& corners, const IdVector<VertexId, WeightedPoint>& points) {
  return {points[corners[0]].position(), points[corners[1]].position(), points[corners[2]].position()};
}

/// Says whether a triangle still faces the way that it did, and has not become thin.
bool has_kept_shape(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& after) {
  const Vec3 n = normal_of(before[0], before[1], before[2]), m = normal_of(after[0], after[1], after[2]);
  return dot(n, m) >= kLeastCosine * length(n) * length(m) && width_of(after) >= std::min(kThin, width_of(before));
}

}  // namespace

std::vector<DraftEdge> edges_of(const std::vector<std::array<VertexId, 3>>& triangles) {
  struct Found {
    std::array<VertexId, 2> ends;
    DraftEdge::Side side;
  };
  std::vector<Found> found;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = triangles[t][(k + 1) % 3], b = triangles[t][(k + 2) % 3];
      found.push_back({{std::min(a, b), std::max(a, b)}, {t, k}});
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.ends < b.ends; });
  std::vector<DraftEdge> edges;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool has_other = i + 1 < found.size() && found[i].ends == found[i + 1].ends;
    edges.push_back({{found[i].side, found[has_other ? i + 1 : i].side}, !has_other});
    i += has_other ? 1 : 0;
  }
  return edges;
}

double width_of(const std::array<Vec3, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const double longest = std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
  return length(normal_of(a, b, c)) / longest;
}

double turn_deg(Vec3 normal, Vec3 other) {
  return std::atan2(length(cross(normal, other)), dot(normal, other)) * (180 / std::numbers::pi);
}

void go_back(Draft& draft, const IdVector<VertexId, WeightedPoint>& first, const TurnLimit& limit) {
  std::vector<std::array<std::size_t, 2>> neighbors;
  for (const DraftEdge& edge : limit.sharp < 180 ? edges_of(draft.triangles) : std::vector<DraftEdge>()) {
    if (!edge.is_boundary) neighbors.push_back({edge.sides[0].triangle, edge.sides[1].triangle});
  }
  const auto undo = [&](std::size_t t) {
    bool changed = false;
    for (const VertexId v : draft.triangles[t]) {
      const Vec3 p = first[v].position();
      changed = changed || draft.points[v].position() != p;
      draft.points[v] = {p.x, p.y, p.z, draft.points[v].w};
    }
    return changed;
  };
  const auto turn = [&](const std::array<std::size_t, 2>& sides, const IdVector<VertexId, WeightedPoint>& points) {
    const auto normal = [&](std::size_t t) {
      const auto [a, b, c] = places_of(draft.triangles[t], points);
      return normal_of(a, b, c);
    };
    return turn_deg(normal(sides[0]), normal(sides[1]));
  };
  const auto is_bad = [&](std::size_t t) {
    const auto& [a, b, c] = draft.triangles[t];
    return !is_well_centered(first[a], first[b], first[c]);
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t t = 0; t < draft.triangles.size(); ++t) {
      const std::array<VertexId, 3>& corners = draft.triangles[t];
      if (!has_kept_shape(places_of(corners, first), places_of(corners, draft.points))) changed = undo(t) || changed;
    }
    for (const std::array<std::size_t, 2>& sides : neighbors) {
      const double now = turn(sides, draft.points);
      if (now <= limit.sharp || now <= limit.at(turn(sides, first), is_bad(sides[0]) || is_bad(sides[1]))) continue;
      for (const std::size_t t : sides) changed = undo(t) || changed;
    }
  }
}

}  // namespace temper::surfaces

#include "surfaces/optimize/draft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "surfaces/optimize/barrier.hpp"

namespace temper::surfaces {
namespace {

// Steps that lower the mean energy of a triangle by less than this are not worth their time.
constexpr double kSmallGain = 1e-5;
// The least cosine between the normals of a triangle before and after its vertices moved.
constexpr double kLeastCosine = 0.3;

/// Two unit vectors across a normal.
std::array<Vec3, 2> tangents_of(Vec3 normal) {
  const Vec3 axis = std::abs(normal.x) < 0.6 * length(normal) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 one = cross(normal, axis), unit = (1 / length(one)) * one, other = cross(normal, unit);
  return {unit, (1 / length(other)) * other};
}

std::array<Vec3, 3> places_of(const std::array<VertexId, 3>& corners, const IdVector<VertexId, WeightedPoint>& points) {
  return {points[corners[0]].position(), points[corners[1]].position(), points[corners[2]].position()};
}

/// Says whether a triangle still faces the way that it did, and has not become thin.
bool has_kept_shape(const std::array<Vec3, 3>& before, const std::array<Vec3, 3>& after) {
  const Vec3 n = normal_of(before[0], before[1], before[2]), m = normal_of(after[0], after[1], after[2]);
  return dot(n, m) >= kLeastCosine * length(n) * length(m) && width_of(after) >= std::min(kThin, width_of(before));
}

/// The pairs of triangles with a common edge.
std::vector<std::array<std::size_t, 2>> neighbors_of(const std::vector<std::array<VertexId, 3>>& triangles) {
  std::vector<std::pair<std::array<VertexId, 2>, std::size_t>> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i - 1].first == sides[i].first) pairs.push_back({sides[i - 1].second, sides[i].second});
  }
  return pairs;
}

}  // namespace

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
  if (limit.sharp < 180) neighbors = neighbors_of(draft.triangles);
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

DraftEnergy::DraftEnergy(Draft& draft, double gamma)
    : draft_(draft), gamma_(gamma), first_(draft.points), start_(draft.points) {
  const std::size_t n = draft.points.size();
  IdVector<VertexId, Vec3> normals(n);
  IdVector<VertexId, double> lengths(n, 0.0), counts(n, 0.0);
  for (std::size_t e = 0; e < n_elements(); ++e) {
    const Vec3 normal = normal_of(e, first_);
    normals_.push_back((1 / length(normal)) * normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = corners(e)[k], b = corners(e)[(k + 1) % 3];
      normals[a] = normals[a] + normal;
      const double l = length(first_[b].position() - first_[a].position());
      lengths[a] += l, lengths[b] += l;
      counts[a] += 1, counts[b] += 1;
    }
  }
  for (const VertexId v : IdRange<VertexId>(n)) {
    const double unit = counts[v] > 0 ? lengths[v] / counts[v] : 1;
    const bool is_flat = !(squared_length(normals[v]) > 0);
    const auto [one, other] = tangents_of(is_flat ? Vec3{0, 0, 1} : normals[v]);
    const Track track = draft.tracks[v];
    const bool slides = track != kFree && track != kHeld;
    tangents_.push_back(slides ? std::array{unit * draft.lines->direction(track, first_[v].position()), Vec3{}}
                               : std::array{unit * one, unit * other});
    areas_.push_back(unit * unit);
  }
}

void DraftEnergy::place(const std::vector<double>& step, double part) {
  for (std::size_t i = 0; i < start_.size(); ++i) {
    const VertexId v(i);
    WeightedPoint p = start_[v];
    if (draft_.tracks[v] != kHeld) {
      const auto& [one, other] = tangents_[v];
      const Vec3 at = p.position() + (part * step[3 * i]) * one + (part * step[3 * i + 1]) * other;
      p.x = at.x, p.y = at.y, p.z = at.z;
    }
    if (draft_.weighs[v] != 0) p.w += part * step[3 * i + 2] * areas_[v];
    draft_.points[v] = p;
  }
}

bool DraftEnergy::is_inside() const {
  for (std::size_t e = 0; e < n_elements(); ++e) {
    if (!(room(e) > 0)) return false;
  }
  return true;
}

DraftEnergy::Value DraftEnergy::value() const {
  Value sum;
  sum.gradient.assign(kUnknowns * draft_.points.size(), 0);
  for (const std::array<VertexId, 3>& t : draft_.triangles) {
    const BarrierValue e = barrier({draft_.points[t[0]], draft_.points[t[1]], draft_.points[t[2]]}, gamma_);
    sum.lowered += e.value;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = t[k];
      double* const slope = sum.gradient.data() + kUnknowns * v.index;
      if (draft_.tracks[v] != kHeld) {
        slope[0] += dot(e.by_corner[k], tangents_[v][0]);
        slope[1] += dot(e.by_corner[k], tangents_[v][1]);
      }
      if (draft_.weighs[v] != 0) slope[2] += e.by_weight[k] * areas_[v];
    }
  }
  return sum;
}

void DraftEnergy::lower(int steps, const std::function<bool()>& must_stop) {
  Descent descent;
  Value now = value();
  for (int i = 0; i < steps; ++i) {
    const double before = now.lowered;
    const Descent::Outcome outcome = descent.take_step(*this, now, nullptr, must_stop);
    keep();
    if (outcome == Descent::Outcome::stuck || outcome == Descent::Outcome::stopped) return;
    const double gain = before - now.lowered;
    if (outcome == Descent::Outcome::taken && gain < kSmallGain * static_cast<double>(n_elements())) return;
  }
}

void DraftEnergy::project(const ClosestPoints& surface, const TurnLimit& limit) {
  for (const VertexId v : IdRange<VertexId>(first_.size())) {
    if (draft_.tracks[v] == kHeld) continue;
    const Vec3 p = draft_.points[v].position();
    const Vec3 at = draft_.tracks[v] == kFree ? surface.find(p).at : draft_.lines->closest(draft_.tracks[v], p);
    draft_.points[v] = {at.x, at.y, at.z, draft_.points[v].w};
  }
  go_back(draft_, first_, limit);
  keep();
}

}  // namespace temper::surfaces

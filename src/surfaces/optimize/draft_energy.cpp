// One descent moves points and changes weights, because most bad triangles need both.
#include "surfaces/optimize/draft_energy.hpp"

#include <algorithm>
#include <cmath>

#include "surfaces/optimize/barrier.hpp"

namespace temper::surfaces {
namespace {

// A step must lower the mean energy of a triangle by this, or the accuracy energy by this part.
constexpr double kSmallGain = 1e-5;
// Below this width the derivatives of a triangle are so large that no other vertex would move.
constexpr double kLeastWidth = 1e-9;

/// Two unit vectors across a normal.
std::array<Vec3, 2> tangents_of(Vec3 normal) {
  const Vec3 axis = std::abs(normal.x) < 0.6 * length(normal) ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 one = cross(normal, axis), unit = (1 / length(one)) * one, other = cross(normal, unit);
  return {unit, (1 / length(other)) * other};
}

}  // namespace

DraftEnergy::DraftEnergy(Draft& draft, double gamma)
    : draft_(draft), gamma_(gamma), first_(draft.points), start_(draft.points) {
  const std::size_t n = draft.points.size();
  IdVector<VertexId, Vec3> normals(n);
  IdVector<VertexId, double> lengths(n, 0.0), counts(n, 0.0);
  for (std::size_t e = 0; e < n_elements(); ++e) {
    const auto [p, q, r] = draft.corners(e);
    const bool is_sliver = !(width_of({p.position(), q.position(), r.position()}) > kLeastWidth);
    const Vec3 normal = is_sliver ? Vec3{} : normal_of(e, first_);
    normals_.push_back(is_sliver ? normal : (1 / squared_length(normal)) * normal);
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = corners(e)[k], b = corners(e)[(k + 1) % 3];
      if (is_sliver) draft.tracks[a] = kHeld;
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

DraftEnergy::DraftEnergy(Draft& draft, const AccuracyModel& model) : DraftEnergy(draft, 0) {
  accuracy_ = DraftAccuracy(draft, model);
  for (std::size_t e = 0; e < n_elements(); ++e) {
    if (accuracy_->has_floor(e)) continue;
    for (const VertexId v : corners(e)) draft_.tracks[v] = kHeld, draft_.weighs[v] = 0;
  }
}

double DraftEnergy::room(std::size_t e) const {
  const double area = dot(normal_of(e, draft_.points), normals_[e]);
  return accuracy_ && accuracy_->has_floor(e) ? std::min(area, accuracy_->room(draft_, e)) : area;
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
    if (has_normal(e) && !(room(e) > 0)) return false;
  }
  return true;
}

DraftEnergy::Value DraftEnergy::value() const {
  Value sum;
  std::vector<CornerSlopes> slopes;
  if (accuracy_) sum.lowered = accuracy_->value(draft_, slopes);
  sum.gradient.assign(kUnknowns * draft_.points.size(), 0);
  for (std::size_t e = 0; e < n_elements(); ++e) {
    if (!has_normal(e)) continue;
    if (!accuracy_) {
      const BarrierValue of = barrier(draft_.corners(e), gamma_);
      sum.lowered += of.value;
      add(e, of, sum.gradient);
    } else {
      add(e, slopes[e], sum.gradient);
    }
  }
  return sum;
}

void DraftEnergy::add(std::size_t e, const CornerSlopes& slopes, std::vector<double>& gradient) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = corners(e)[k];
    double* const slope = gradient.data() + kUnknowns * v.index;
    if (draft_.tracks[v] != kHeld) {
      slope[0] += dot(slopes.by_corner[k], tangents_[v][0]);
      slope[1] += dot(slopes.by_corner[k], tangents_[v][1]);
    }
    if (draft_.weighs[v] != 0) slope[2] += slopes.by_weight[k] * areas_[v];
  }
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
    const double unit = accuracy_ ? before : static_cast<double>(n_elements());
    if (outcome == Descent::Outcome::taken && gain < kSmallGain * unit) return;
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

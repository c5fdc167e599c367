#include "optimize/flips/size_band.hpp"

#include <algorithm>

#include "optimize/working/working_copy.hpp"
#include "size/star_area.hpp"

namespace temper {

SizeBand::SizeBand(const Mesh& mesh, const WorkingUnits& units, const std::optional<SizeField>& field,
                   std::optional<double> band)
    : mesh_(mesh), units_(units) {
  if (!field || !band) return;
  field_ = field;
  squared_band_ = *band * *band;
  grow();
}

/// Returns the squared factor by which a vertex is above or below its band; 1 inside.
double SizeBand::excess(double squared_size, double squared_field) const {
  const double ratio = squared_size / squared_field;
  return std::max({squared_band_, ratio, 1 / ratio});
}

bool SizeBand::allows(const Patch& patch, Vec2 p) {
  const VertexId v = patch.center;
  const WeightedPoint user = units_.to_user({p.x, p.y, 0});
  const SizeField::Sample sample = field_->at(user.position(), triangle_[v]);
  const double field = sample.size / units_.scale;
  there_ = sample.triangle;
  there_squared_ = field * field;

  double own = 0;
  const Vec2 here = mesh_.position(v), step = p - here;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    own += cross(patch.q(i).position() - here, patch.r(i).position() - here);
  }
  own = StarArea{own, static_cast<int>(patch.size())}.squared_size();
  if (excess(own, there_squared_) > excess(own, squared_field_[v])) return false;

  // The doubled area of triangle (v, q, r) grows by cross(r − q, step). A neighbor has two of these triangles, and one
  // at the ends of an open patch.
  const std::size_t n = patch.size();
  for (std::size_t i = 0; i < patch.link.size(); ++i) {
    const Vec2 q = patch.q(i).position();
    double gain = 0;
    if (i < n) gain += cross(patch.r(i).position() - q, step);
    if (i > 0 || patch.closed) gain += cross(q - patch.q(i > 0 ? i - 1 : n - 1).position(), step);
    StarArea star = star_area(mesh_, patch.link[i]);
    const double target = squared_field_[patch.link[i]];
    const double before = excess(star.squared_size(), target);
    star.doubled += gain;
    if (excess(star.squared_size(), target) > before) return false;
  }
  return true;
}

void SizeBand::about_to_flip(HalfedgeId h) {
  for (const VertexId v : {mesh_.origin(h), mesh_.target(h), mesh_.opposite(h), mesh_.opposite(mesh_.twin(h))}) {
    const bool seen = std::any_of(touched_.begin(), touched_.end(), [v](const auto& t) { return t.first == v; });
    if (!seen) touched_.emplace_back(v, excess(v));
  }
}

bool SizeBand::allow_flips() const {
  return std::all_of(touched_.begin(), touched_.end(),
                     [this](const auto& touched) { return excess(touched.first) <= touched.second; });
}

double SizeBand::excess(VertexId v) const { return excess(star_area(mesh_, v).squared_size(), squared_field_[v]); }

void SizeBand::grow() {
  if (!on()) return;
  const VertexId first(squared_field_.size());
  squared_field_.resize(mesh_.n_vertices());
  triangle_.resize(mesh_.n_vertices());
  TriangleId hint = first.index > 0 ? triangle_[VertexId(first.index - 1)] : TriangleId();
  for (const VertexId v : IdRange<VertexId>(first, VertexId(mesh_.n_vertices()))) {
    const SizeField::Sample sample = field_->at(units_.to_user(mesh_.point(v)).position(), hint);
    const double field = sample.size / units_.scale;
    squared_field_[v] = field * field;
    triangle_[v] = hint = sample.triangle;  // the next vertex on the curve is near
  }
}

void SizeBand::renumber(const Compaction& kept) {
  if (!on()) return;
  squared_field_ = kept_of(squared_field_, kept.vertices);
  triangle_ = kept_of(triangle_, kept.vertices);
}

}  // namespace temper

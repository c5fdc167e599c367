#include "surfaces/optimize/patch.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/sort_unique.hpp"
#include "surfaces/optimize/draft_energy.hpp"
#include "surfaces/optimize/flips.hpp"
#include "temper/topology.hpp"

namespace temper::surfaces {
namespace {

constexpr double kGammas[] = {0.1, 0.03, 0.01};
constexpr int kStepsOfPatch = 25;
constexpr double kLeastPart = 0.2;    // of an edge of a crease, between one of its ends and the new vertex
constexpr double kLeastFacing = 0.5;  // least cosine between new normals and the mean of the old ones

/// Arrays for SurfaceMesh::build.
struct Arrays {
  std::vector<Vec3> points;
  std::vector<double> weights;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> regions, fixed;
  std::vector<std::array<std::int32_t, 2>> constrained;

  void add(const WeightedPoint& p) { points.push_back(p.position()), weights.push_back(p.w); }
  [[nodiscard]] std::optional<SurfaceMesh> build() const {
    SurfaceInput in;
    in.points = points;
    in.weights = weights;
    in.triangles = triangles;
    in.regions = regions;
    in.fixed_vertices = fixed;
    in.constrained_edges = constrained;
    auto built = SurfaceMesh::build(in);
    if (!built) return std::nullopt;
    return std::move(built->mesh);
  }
};

bool is_in(const Edges& edges, const std::array<VertexId, 2>& edge) {
  return std::binary_search(edges.begin(), edges.end(), edge);
}

std::int32_t number(VertexId v) { return static_cast<std::int32_t>(v.index); }

}  // namespace

Patch::Patch(const State& state, TriangleId center, int rings) : state_(state) {
  draft_.lines = state.lines;
  const Mesh& mesh = state.mesh.connectivity();
  const auto corners = mesh.corners(center);
  std::vector<VertexId> vertices(corners.begin(), corners.end());
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<VertexId> inner = vertices;
    for (const VertexId v : inner) {
      for (const HalfedgeId h : mesh.star(v)) {
        vertices.push_back(mesh.target(h));
        vertices.push_back(mesh.opposite(h));
      }
    }
    sort_unique(vertices);
    if (ring + 1 < rings) continue;
    for (const VertexId v : inner) {
      for (const HalfedgeId h : mesh.star(v)) cells_.push_back(Mesh::triangle(h));
    }
  }
  sort_unique(cells_);
  const auto local = [&](VertexId v) {
    return VertexId(static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin()));
  };
  center_ = {local(corners[0]), local(corners[1]), local(corners[2])};
  global_ = vertices;
  for (const TriangleId t : cells_) {
    const auto [a, b, c] = mesh.corners(t);
    draft_.triangles.push_back({local(a), local(b), local(c)});
    regions_.push_back(mesh.region(t));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k);
      const VertexId p = local(mesh.origin(h)), q = local(mesh.target(h));
      if (mesh.is_constrained(h)) constrained_.push_back(ascending(p, q));
    }
  }
  sort_unique(constrained_);
  for (const VertexId v : vertices) {
    bool is_inside = true;
    for (const HalfedgeId h : mesh.star(v))
      is_inside = is_inside && std::binary_search(cells_.begin(), cells_.end(), Mesh::triangle(h));
    draft_.points.push_back(state.mesh.point(v));
    draft_.tracks.push_back(is_inside ? state.tracks[v] : kHeld);
    draft_.weighs.push_back(is_inside && !mesh.is_frozen(v) ? 1 : 0);
  }
}

std::optional<Patch::Side> Patch::side(VertexId a, VertexId b) const {
  for (std::size_t t = 0; t < draft_.triangles.size(); ++t) {
    const Corners& c = draft_.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      if (c[k] == a && c[(k + 1) % 3] == b) return Side{t, c[(k + 2) % 3]};
    }
  }
  return std::nullopt;
}

bool Patch::has_edge(VertexId a, VertexId b) const {
  if (side(a, b) || side(b, a)) return true;
  const VertexId p = global_[a.index], q = global_[b.index];
  const Mesh& mesh = state_.mesh.connectivity();
  return p.valid() && q.valid() && draft_.tracks[a] == kHeld && draft_.tracks[b] == kHeld &&
         (mesh.find_halfedge(p, q).valid() || mesh.find_halfedge(q, p).valid());
}

bool Patch::is_locked(VertexId a, VertexId b) const { return is_in(constrained_, ascending(a, b)); }

bool Patch::is_crease(VertexId a, VertexId b) const {
  return is_in(state_.creases, ascending(global_[a.index], global_[b.index]));
}

std::vector<VertexId> Patch::neighbors(VertexId v) const {
  std::vector<VertexId> all;
  for (const Corners& t : draft_.triangles) {
    if (std::find(t.begin(), t.end(), v) == t.end()) continue;
    for (const VertexId u : t) {
      if (u != v) all.push_back(u);
    }
  }
  sort_unique(all);
  return all;
}

std::vector<Edit> Patch::edits() const {
  std::vector<Edit> all = {{}};
  for (const Edit::Kind kind : {Edit::Kind::flip, Edit::Kind::split}) {
    for (std::size_t k = 0; k < 3; ++k) all.push_back({kind, center_[k], center_[(k + 1) % 3]});
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3})
      all.push_back({Edit::Kind::collapse, center_[k], center_[other]});
  }
  for (const VertexId v : center_) {
    for (const VertexId u : neighbors(v)) {
      if (std::find(center_.begin(), center_.end(), u) != center_.end()) continue;
      all.push_back({Edit::Kind::collapse, v, u});
      all.push_back({Edit::Kind::flip, v, u});
    }
  }
  return all;
}

bool Patch::make(const Edit& edit, const Nearness& nearness) {
  switch (edit.kind) {
    case Edit::Kind::none:
      return true;
    case Edit::Kind::flip:
      return flip(edit.from, edit.to);
    case Edit::Kind::split:
      return split(edit.from, edit.to, nearness);
    case Edit::Kind::collapse:
      return collapse(edit.from, edit.to);
  }
  return false;
}

bool Patch::flip(VertexId a, VertexId b) {
  const auto left = side(a, b), right = side(b, a);
  if (!left || !right || is_locked(a, b)) return false;
  const VertexId c = left->across, d = right->across;
  if (c == d || has_edge(c, d)) return false;
  Corners &s = draft_.triangles[left->triangle], &t = draft_.triangles[right->triangle];
  const Vec3 n = normal(s), m = normal(t), mean = unit(n) + unit(m);
  const Corners one = {d, c, a}, other = {c, d, b};
  for (const Corners& made : {one, other}) {
    if (!(dot(normal(made), mean) > kLeastFacing * length(normal(made)) * length(mean))) return false;
  }
  s = one, t = other;
  return true;
}

bool Patch::split(VertexId a, VertexId b, const Nearness& nearness) {
  const auto left = side(a, b), right = side(b, a);
  if (!left || !right || (is_locked(a, b) && !is_crease(a, b))) return false;
  const VertexId c = left->across, d = right->across, m(global_.size());
  if (is_crease(a, b)) cut_ = {a, b, m};
  const Vec3 ab = place(b) - place(a);
  const double l2 = squared_length(ab);
  const double part = cut_ ? std::clamp(dot(place(c) - place(a), ab) / l2, kLeastPart, 1 - kLeastPart) : 0.5;
  const Track track = cut_ ? std::max(track_of(a), track_of(b)) : kFree;
  const Vec3 near = place(a) + part * ab;
  const Vec3 at = track >= 0 ? state_.lines->closest(track, near) : nearness.input().find(near).at;
  draft_.points.push_back({at.x, at.y, at.z, split_weight(draft_.points[a].w, draft_.points[b].w, l2, part)});
  draft_.tracks.push_back(track);
  draft_.weighs.push_back(1);
  global_.emplace_back();
  draft_.triangles[left->triangle] = {a, m, c};
  draft_.triangles[right->triangle] = {b, m, d};
  draft_.triangles.push_back({m, b, c});
  draft_.triangles.push_back({m, a, d});
  regions_.push_back(regions_[left->triangle]);
  regions_.push_back(regions_[right->triangle]);
  return true;
}

bool Patch::collapse(VertexId a, VertexId b) {
  const auto left = side(a, b), right = side(b, a);
  if (!left || !right || draft_.tracks[a] != kFree || is_locked(a, b)) return false;
  const std::vector<VertexId> of_a = neighbors(a);
  const auto is_common = [&](VertexId v) { return v != a && v != b && has_edge(v, b); };
  if (std::count_if(of_a.begin(), of_a.end(), is_common) != 2) return false;
  std::vector<Corners> triangles;
  std::vector<std::int32_t> regions;
  for (std::size_t t = 0; t < draft_.triangles.size(); ++t) {
    if (t == left->triangle || t == right->triangle) continue;
    Corners corners = draft_.triangles[t];
    const Vec3 before = normal(corners);
    std::replace(corners.begin(), corners.end(), a, b);
    const Vec3 after = normal(corners);
    if (!(dot(before, after) > kLeastFacing * length(before) * length(after))) return false;
    triangles.push_back(corners);
    regions.push_back(regions_[t]);
  }
  draft_.triangles = std::move(triangles);
  regions_ = std::move(regions);
  return true;
}

void Patch::descend(const Run& run) {
  const IdVector<VertexId, Track> tracks = draft_.tracks;
  for (const double gamma : kGammas) {
    DraftEnergy energy(draft_, gamma);
    energy.lower(kStepsOfPatch, [&run] { return run.must_stop(); });
    energy.project(run.nearness.input(), {});
  }
  // Projections lower margins, so the weights alone follow.
  draft_.tracks.assign(tracks.size(), kHeld);
  for (const double gamma : kGammas)
    DraftEnergy(draft_, gamma).lower(kStepsOfPatch, [&run] { return run.must_stop(); });
  draft_.tracks = tracks;
}

std::optional<std::size_t> Patch::bad(const Run& run) const {
  Arrays arrays;
  std::vector<std::int32_t> numbers(global_.size(), -1);
  for (std::size_t t = 0; t < draft_.triangles.size(); ++t) {
    const auto& [a, b, c] = draft_.triangles[t];
    if (!run.nearness.is_near({place(a), place(b), place(c)})) return std::nullopt;
    arrays.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId v = draft_.triangles[t][k];
      std::int32_t& n = numbers[v.index];
      if (n < 0) {
        n = static_cast<std::int32_t>(arrays.points.size());
        arrays.add(draft_.points[v]);
      }
      arrays.triangles.back()[k] = n;
    }
  }
  arrays.regions = regions_;
  const std::optional<SurfaceMesh> mesh = arrays.build();
  if (!mesh || turns_of(*mesh, 0).largest_deg > run.limit.sharpest) return std::nullopt;
  return run.bad(*mesh);
}

Edges Patch::creases(const std::vector<VertexId>& number_of_local) const {
  Edges all = state_.creases;
  if (!cut_) return all;
  const auto in_mesh = [&](std::size_t k) { return number_of_local[(*cut_)[k].index]; };
  all.erase(std::find(all.begin(), all.end(), ascending(in_mesh(0), in_mesh(1))));
  all.push_back({in_mesh(0), in_mesh(2)});
  all.push_back({in_mesh(1), in_mesh(2)});
  return all;
}

std::optional<State> Patch::applied() const {
  const Mesh& old = state_.mesh.connectivity();
  IdVector<VertexId, WeightedPoint> points;
  for (const VertexId v : state_.mesh.vertices()) points.push_back(state_.mesh.point(v));
  std::vector<VertexId> number_of_local;
  std::size_t n = points.size();
  for (std::size_t i = 0; i < global_.size(); ++i) {
    const VertexId v = global_[i].valid() ? global_[i] : VertexId(n++);
    if (!global_[i].valid()) points.push_back({});
    points[v] = draft_.points[VertexId(i)];
    number_of_local.push_back(v);
  }
  std::vector<Corners> triangles;
  Arrays arrays;
  for (const TriangleId t : state_.mesh.triangles()) {
    if (std::binary_search(cells_.begin(), cells_.end(), t)) continue;
    triangles.push_back(old.corners(t));
    arrays.regions.push_back(old.region(t));
  }
  for (std::size_t t = 0; t < draft_.triangles.size(); ++t) {
    const auto& [a, b, c] = draft_.triangles[t];
    triangles.push_back({number_of_local[a.index], number_of_local[b.index], number_of_local[c.index]});
    arrays.regions.push_back(regions_[t]);
  }
  IdVector<VertexId, VertexId> kept(points.size());
  for (const Corners& t : triangles) {
    for (const VertexId v : t) kept[v] = v;
  }
  State next;
  next.lines = state_.lines;
  for (const VertexId v : IdRange<VertexId>(points.size())) {
    if (!kept[v].valid()) continue;
    kept[v] = VertexId(arrays.points.size());
    arrays.add(points[v]);
    const bool is_new = v.index >= old.n_vertices();
    next.tracks.push_back(is_new ? draft_.tracks[VertexId(global_.size() - 1)] : state_.tracks[v]);
    next.origins.push_back(is_new ? VertexId() : state_.origins[v]);
    if (!is_new && old.is_fixed(v)) arrays.fixed.push_back(number(kept[v]));
  }
  for (const auto& [a, b, c] : triangles)
    arrays.triangles.push_back({number(kept[a]), number(kept[b]), number(kept[c])});
  next.repairs = state_.repairs;
  next.creases = creases(number_of_local);
  for (auto& [a, b] : next.creases) {
    a = kept[a], b = kept[b];
    arrays.constrained.push_back({number(a), number(b)});
  }
  std::sort(next.creases.begin(), next.creases.end());
  for (const HalfedgeId h : old.halfedges()) {
    const std::array<VertexId, 2> edge = ascending(old.origin(h), old.target(h));
    if (old.is_constrained(h) && old.is_edge_representative(h) && !is_in(state_.creases, edge))
      arrays.constrained.push_back({number(kept[edge[0]]), number(kept[edge[1]])});
  }
  std::optional<SurfaceMesh> mesh = arrays.build();
  if (!mesh) return std::nullopt;
  next.mesh = *std::move(mesh);
  return next;
}

}  // namespace temper::surfaces

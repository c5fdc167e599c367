#include "tets/energy/accuracy_star.hpp"

#include <algorithm>
#include <cmath>

#include "base/portable_log.hpp"
#include "tets/energy/sloped.hpp"

namespace temper::tets {
namespace {

Weighted<double> weighted(const WeightedPoint& p) { return {{p.x, p.y, p.z}, p.w}; }

template <class T>
Vector<T> constant(const Vector<double>& v) {
  return {T(v.x), T(v.y), T(v.z)};
}
template <class T>
Weighted<T> constant(const Weighted<double>& p) {
  return {constant<T>(p.at), T(p.w)};
}
template <class T>
Offset<T> constant(const Offset<double>& o) {
  return {T(o.volume), constant<T>(o.moment)};
}

template <class T>
Vector<T> centroid(const Weighted<T>& p, const Weighted<T>& q, const Weighted<T>& r) {
  return T(1.0 / 3) * (p.at + q.at + r.at);
}
template <class T>
Vector<T> normal(const Weighted<T>& p, const Weighted<T>& q, const Weighted<T>& r) {
  return cross(q.at - p.at, r.at - p.at);
}

/// The corners of a tetrahedron by a halfface and the opposite corner, from an origin.
std::array<Weighted<double>, 4> corners(const TetMesh& mesh, const std::array<VertexId, 4>& vertices,
                                        const Vector<double>& origin) {
  std::array<Weighted<double>, 4> all;
  for (std::size_t k = 0; k < 4; ++k) {
    all[k] = weighted(mesh.point(vertices[k]));
    all[k].at = all[k].at - origin;
  }
  return all;
}

/// The part of face h in its tetrahedron.
Offset<double> face_part(const TetMesh& mesh, HalffaceId h, const Vector<double>& origin) {
  const auto [i, j, k] = mesh.vertices(h);
  const auto [p, q, r, s] = corners(mesh, {i, j, k, mesh.opposite(h)}, origin);
  const Vector<double> n = normal(p, q, r), center = orthocenter(p, q, r);
  return face_part(n, center, centroid(p, q, r), orthocenter(p, s, n, center));
}

/// The part of edge ij in the positive tetrahedron ijkl.
Offset<double> edge_part(const TetMesh& mesh, const std::array<VertexId, 4>& ijkl, const Vector<double>& origin) {
  const auto [p, q, r, s] = corners(mesh, ijkl, origin);
  const Vector<double> n = normal(p, q, r), center = orthocenter(p, q, r);
  return edge_part(p, q, center, orthocenter(p, s, n, center), orthocenter(p, q, s));
}

/// The tetrahedra around edge ab beyond its face h = abc, up to those of v or the boundary.
struct Fan {
  Offset<double> sum = {};
  bool on_boundary = false;

  Fan(const TetMesh& mesh, HalffaceId h, VertexId v, const std::array<VertexId, 3>& abc, const Vector<double>& origin) {
    const auto [a, b, first] = abc;
    VertexId c = first;
    for (HalffaceId beyond = mesh.twin(h);; beyond = mesh.twin(h)) {
      on_boundary = !beyond.valid();
      if (on_boundary || mesh.opposite(beyond) == v) return;
      const VertexId d = mesh.opposite(beyond);
      sum = sum + edge_part(mesh, {b, a, c, d}, origin);
      h = mesh.halfface_opposite(TetMesh::tetrahedron(beyond), c);
      c = d;
    }
  }
};

double over_size(double inner, double boundary, bool on_boundary, double size) {
  return (on_boundary ? boundary : inner) / (size * size);
}

}  // namespace

std::size_t AccuracyStar::add_spoke(const TetMesh& mesh, VertexId v) {
  const auto known = std::find_if(spokes_.begin(), spokes_.end(), [v](const Spoke& s) { return s.vertex == v; });
  if (known != spokes_.end()) return static_cast<std::size_t>(known - spokes_.begin());
  Weighted<double> end = weighted(mesh.point(v));
  end.at = end.at - origin_;
  spokes_.push_back({end, v});
  return spokes_.size() - 1;
}

std::size_t AccuracyStar::add_side(std::size_t from, std::size_t to) {
  const auto known =
      std::find_if(sides_.begin(), sides_.end(), [&](const Side& s) { return s.from == to && s.to == from; });
  if (known != sides_.end()) return static_cast<std::size_t>(known - sides_.begin());
  sides_.push_back({from, to});
  return sides_.size() - 1;
}

void AccuracyStar::gather(const TetMesh& mesh, VertexId v, std::span<const HalffaceId> link,
                          const AccuracyDomain& domain, const AccuracyModel& model) {
  center_ = v;
  origin_ = weighted(mesh.point(v)).at;
  spokes_.clear(), sides_.clear(), tets_.clear();
  for (const HalffaceId h : link) add_tetrahedron(mesh, h, domain, model);
  const VertexSizes& sizes = domain.sizes;
  const double here = sizes[v];
  for (Side& s : sides_) {
    Spoke &from = spokes_[s.from], &to = spokes_[s.to];
    const double ends = sizes[from.vertex] + sizes[to.vertex];
    const bool face_on_boundary = s.tetrahedra == 1;
    s.edge_factor = over_size(model.edges, model.boundary_edges, s.edge_on_boundary, ends / 2);
    s.face_factor = over_size(model.faces, model.boundary_faces, face_on_boundary, (ends + here) / 3);
    from.on_boundary |= face_on_boundary, to.on_boundary |= face_on_boundary;
  }
  for (Spoke& s : spokes_)
    s.factor = over_size(model.edges, model.boundary_edges, s.on_boundary, (sizes[s.vertex] + here) / 2);
}

void AccuracyStar::add_tetrahedron(const TetMesh& mesh, HalffaceId h, const AccuracyDomain& domain,
                                   const AccuracyModel& model) {
  const VertexSizes& sizes = domain.sizes;
  const auto vertices = mesh.vertices(h);
  Tet& t = tets_.emplace_back();
  for (std::size_t k = 0; k < 3; ++k) t.spokes[k] = add_spoke(mesh, vertices[k]);
  const auto& [q, r, s] = std::array{spokes_[t.spokes[0]].end, spokes_[t.spokes[1]].end, spokes_[t.spokes[2]].end};
  t.normal = normal(q, r, s), t.center = orthocenter(q, r, s), t.centroid = centroid(q, r, s);
  const double area2 = std::sqrt(dot(t.normal, t.normal));
  t.over_height = 2 / (kLengthOfArea * area2 * std::sqrt(area2));
  const double sum = sizes[vertices[0]] + sizes[vertices[1]] + sizes[vertices[2]], size = (sum + sizes[center_]) / 4;
  t.factor = over_size(model.faces, model.boundary_faces, mesh.is_boundary(h), sum / 3);
  t.barrier = model.barrier * size * size * size;
  t.floor = domain.floors[TetMesh::tetrahedron(h)];
  t.is_own = std::all_of(vertices.begin(), vertices.end(), [this](VertexId v) { return center_ < v; });
  if (t.factor > 0 && !mesh.is_boundary(h)) t.beyond = face_part(mesh, mesh.twin(h), origin_);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    t.sides[k] = add_side(t.spokes[k], t.spokes[next]);
    Side& side = sides_[t.sides[k]];
    const bool is_first = ++side.tetrahedra == 1;
    // The first walk meets all other tetrahedra of the edge, unless it ends at the boundary.
    if (model.edges == 0 || (!is_first && !side.edge_on_boundary)) continue;
    const Fan fan(mesh, h, center_, {vertices[k], vertices[next], vertices[(k + 2) % 3]}, origin_);
    side.beyond = side.beyond + fan.sum;
    side.edge_on_boundary = fan.on_boundary;
  }
}

/// Calls element(factor, V and N, whether the vertex is the least of the element) for all edges and faces, and height(
/// tetrahedron, h/ℓ) for all tetrahedra and their faces.
template <class T, class Elements, class Heights>
void AccuracyStar::visit(const Weighted<T>& p, Elements&& element, Heights&& height) const {
  using std::sqrt;
  struct OfSide {
    Vector<T> normal, center, centroid;
    Offset<T> face, edge;
    T over_height;  // h/ℓ is this times V of the part
  };
  const auto over_height = [](const Vector<T>& normal) {
    const T area2 = sqrt(dot(normal, normal));
    return T(2 / kLengthOfArea) / (area2 * sqrt(area2));
  };
  thread_local std::vector<Weighted<T>> ends;
  thread_local std::vector<Offset<T>> spokes;
  thread_local std::vector<OfSide> sides;
  const Offset<T> none = constant<T>(Offset<double>{});
  ends.clear(), sides.clear();
  spokes.assign(spokes_.size(), none);
  for (const Spoke& s : spokes_) ends.push_back(constant<T>(s.end));
  for (const Side& s : sides_) {
    const Weighted<T>&q = ends[s.from], &r = ends[s.to];
    const Vector<T> n = normal(p, r, q);
    sides.push_back({n, orthocenter(p, q, r), centroid(p, q, r), none, constant<T>(s.beyond), over_height(n)});
  }
  for (const Tet& t : tets_) {
    const Vector<T> center = constant<T>(t.center), normal = constant<T>(t.normal);
    const Vector<T> o = orthocenter(ends[t.spokes[0]], p, normal, center);
    const Offset<T> link = face_part(normal, center, constant<T>(t.centroid), o);
    height(t, T(t.over_height) * link.volume);
    element(t.factor, link + constant<T>(t.beyond), false);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t from = t.spokes[k], to = t.spokes[(k + 1) % 3];
      const Vector<T>& before = sides[t.sides[(k + 2) % 3]].center;
      OfSide& side = sides[t.sides[k]];
      // The normal of the side leads into the tetrahedron in which it was found first.
      const bool inward = sides_[t.sides[k]].from == from;
      const Offset<T> part = face_part(inward ? side.normal : T(-1) * side.normal, side.center, side.centroid, o);
      height(t, side.over_height * part.volume);
      side.face = side.face + part;
      side.edge = side.edge + edge_part(ends[from], ends[to], center, o, side.center);
      spokes[from] = spokes[from] + edge_part(p, ends[from], before, o, side.center);
    }
  }
  for (std::size_t i = 0; i < spokes_.size(); ++i) element(spokes_[i].factor, spokes[i], center_ < spokes_[i].vertex);
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& s = sides_[i];
    element(s.edge_factor, sides[i].edge, false);
    element(s.face_factor, sides[i].face, center_ < spokes_[s.from].vertex && center_ < spokes_[s.to].vertex);
  }
}

namespace {

double energy_of(double factor, const Offset<double>& o) {
  if (factor == 0) return 0;
  return o.volume > 0 ? factor * dot(o.moment, o.moment) / o.volume : HUGE_VAL;
}

double barrier_of(double factor, double room) { return room > 0 ? -factor * portable_log(room) : HUGE_VAL; }

}  // namespace

double AccuracyStar::value(const WeightedPoint& p) const {
  double sum = 0;
  visit(
      at(p), [&](double factor, const Offset<double>& o, bool) { sum += energy_of(factor, o); },
      [&](const Tet& t, double height) { sum += barrier_of(t.barrier, height - t.floor); });
  return std::isnan(sum) ? HUGE_VAL : sum;
}

AccuracyTotal AccuracyStar::own(const WeightedPoint& p) const {
  AccuracyTotal total;
  visit(
      at(p),
      [&](double factor, const Offset<double>& o, bool own) {
        total.energy += own && o.volume > 0 ? energy_of(factor, o) : 0;
      },
      [&](const Tet& t, double height) { total.barrier += t.is_own ? barrier_of(t.barrier, height - t.floor) : 0; });
  return total;
}

PointDerivatives<double> AccuracyStar::derivatives(const WeightedPoint& point) const {
  const auto [p, w] = at(point);
  const Weighted<Sloped> unknowns = {{Sloped(p.x, 0), Sloped(p.y, 1), Sloped(p.z, 2)}, Sloped(w, 3)};
  PointDerivatives<double> d = {};
  visit(
      unknowns,
      [&d](double factor, const Offset<Sloped>& o, bool) {
        const double volume = o.volume.value;
        if (factor == 0) return;
        if (!(volume > 0)) d.value = HUGE_VAL;
        // Each component of N²/V is the square of N/√V.
        for (const Sloped& n : {o.moment.x, o.moment.y, o.moment.z}) {
          const double ratio = n.value / volume;
          const PointVector<double> slope = n.gradient() + -0.5 * ratio * o.volume.gradient();
          d.value += factor * n.value * ratio;
          d.gradient = d.gradient + 2 * factor * ratio * slope;
          d.hessian.add_square(2 * factor / volume, slope);
        }
      },
      [&d](const Tet& t, const Sloped& height) {
        const double room = height.value - t.floor;
        d.value += barrier_of(t.barrier, room);
        d.gradient = d.gradient + -t.barrier / room * height.gradient();
        d.hessian.add_square(t.barrier / (room * room), height.gradient());
      });
  return d;
}

}  // namespace temper::tets

// Flooding finds components of triangles between edges; then one of four rules decides which of them are inside.
#include "mesher/areas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "generate/triangulation.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/projection.hpp"
#include "temper/generate.hpp"
#include "topology/locate.hpp"

namespace temper::mesher {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// The triangulation of the convex hull, and for every halfedge on a piece that piece.
struct Hull {
  Mesh mesh;
  IdVector<HalfedgeId, std::uint32_t> piece;
};

Expected<generate::Triangulation> delaunay_of(const Surface& surface, const std::vector<Vec3>& places,
                                              const std::function<bool()>& stop) {
  if (surface.space().is_closed()) return generate::triangulate_sphere(places, surface.space().radius(), stop);
  std::vector<Vec2> points;
  points.reserve(places.size());
  for (const Vec3 p : places) points.push_back({p.x, p.y});
  return generate::triangulate_points(points, stop);
}

Expected<Hull> triangulate_hull(const Surface& surface, const std::vector<Vec3>& points,
                                const std::vector<Piece>& pieces, Deadline& deadline) {
  std::vector<std::array<std::int32_t, 2>> segments;
  segments.reserve(pieces.size());
  for (const Piece& p : pieces) {
    segments.push_back({static_cast<std::int32_t>(p.ends[0]), static_cast<std::int32_t>(p.ends[1])});
  }
  const auto stop = [&] { return deadline.asked_to_stop(); };
  Expected<generate::Triangulation> triangulation = delaunay_of(surface, points, stop);
  if (!triangulation) return triangulation.error();
  if (auto error = generate::insert_segments(*triangulation, segments, stop)) return *error;
  Expected<Mesh> mesh = generate::in_input_order(*std::move(triangulation), [&] { return deadline.ask(); });
  if (!mesh) return mesh.error();
  if (deadline.ask()) return generate::stopped_error();
  Hull hull{*std::move(mesh), {}};
  hull.piece.resize(hull.mesh.n_halfedges(), kNone);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const VertexId a(pieces[i].ends[0]), b(pieces[i].ends[1]);
    for (const HalfedgeId h : {hull.mesh.find_halfedge(a, b), hull.mesh.find_halfedge(b, a)}) {
      if (h.valid()) hull.piece[h] = static_cast<std::uint32_t>(i);
    }
  }
  return hull;
}

/// Calls f(h) for the halfedges of a triangle.
template <class F>
void each_halfedge(TriangleId t, const F& f) {
  for (int k = 0; k < 3; ++k) f(Mesh::halfedge(t, k));
}

class AreaFinder {
 public:
  AreaFinder(const Surface& surface, const Outline& outline, const Arrangement& arrangement,
             const MesherOptions& options, double largest, Deadline& deadline)
      : surface_(surface),
        outline_(outline),
        arrangement_(arrangement),
        names_(names_of(outline)),
        edges_(arrangement.edges),
        options_(options),
        largest_(largest),
        deadline_(deadline) {}

  Expected<Areas> run() {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const auto& ends = edges_[i].ends;
      pieces.push_back(
          {{static_cast<std::uint32_t>(ends[0]), static_cast<std::uint32_t>(ends[1])}, static_cast<std::uint32_t>(i)});
    }
    Expected<Hull> hull = triangulate_hull(surface_, arrangement_.places, pieces, deadline_);
    if (!hull) return hull.error();
    hull_ = *std::move(hull);
    find_components();
    if (const Error error = take_by_rule()) return *error;
    if (std::find(inside_.begin(), inside_.end(), std::uint8_t{1}) == inside_.end()) return nothing_enclosed();
    if (const auto region_error = take_regions()) return *region_error;
    return collect();
  }

 private:
  using Error = std::optional<InputError>;

  Error take_by_rule() {
    if (surface_.space().is_closed()) return take_smaller_sides();
    if (!outline_.parts.empty()) return take_parts();
    return takes_turns() ? take_turns() : take_all();
  }

  [[nodiscard]] bool takes_turns() const {
    if (options_.enclosed != Enclosed::by_points) return options_.enclosed == Enclosed::alternate;
    return outline_.holes.empty() && outline_.regions.empty();
  }

  void find_components() {
    const Mesh& mesh = hull_.mesh;
    component_.resize(mesh.n_triangles(), kNone);
    std::vector<TriangleId> stack;
    for (const TriangleId seed : mesh.triangles()) {
      if (component_[seed] != kNone) continue;
      component_[seed] = n_components_;
      stack.push_back(seed);
      while (!stack.empty()) {
        const TriangleId t = stack.back();
        stack.pop_back();
        each_halfedge(t, [&](HalfedgeId h) {
          if (hull_.piece[h] != kNone || mesh.is_boundary(h)) return;
          const TriangleId next = Mesh::triangle(mesh.twin(h));
          if (component_[next] != kNone) return;
          component_[next] = n_components_;
          stack.push_back(next);
        });
      }
      ++n_components_;
    }
    inside_.assign(n_components_, 0);
    region_.assign(n_components_, 0);
    size_.assign(n_components_, largest_);
    extent_.assign(n_components_, 0);
    neighbors_.resize(n_components_);
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_boundary(h)) {
        from_outside_.emplace_back(component(h), hull_.piece[h]);
      } else if (hull_.piece[h] != kNone) {
        neighbors_[component(h)].emplace_back(component(mesh.twin(h)), hull_.piece[h]);
      }
    }
  }
  [[nodiscard]] std::uint32_t component(HalfedgeId h) const { return component_[Mesh::triangle(h)]; }

  /// The depth of each component: the least number of edges between it and the outside of the hull.
  [[nodiscard]] std::vector<std::uint32_t> depths() const {
    std::vector<std::uint32_t> depth(n_components_, kNone), here, beyond;
    for (const auto& [c, piece] : from_outside_) (piece == kNone ? here : beyond).push_back(c);
    for (std::uint32_t level = 0; !here.empty() || !beyond.empty(); ++level) {
      while (!here.empty()) {
        const std::uint32_t c = here.back();
        here.pop_back();
        if (depth[c] != kNone) continue;
        depth[c] = level;
        for (const auto& [next, piece] : neighbors_[c]) beyond.push_back(next);
      }
      std::swap(here, beyond);
    }
    return depth;
  }

  Error take_turns() {
    const auto depth = depths();
    std::vector<std::size_t> holes;
    for (std::size_t c = 0; c < n_components_; ++c) {
      inside_[c] = depth[c] % 2;
      if (depth[c] > 0 && inside_[c] == 0) holes.push_back(c);
    }
    if (options_.enclosed == Enclosed::by_points && !holes.empty()) warn_of(holes);
    return {};
  }

  /// The user may have meant inner loops as lines. Only a point of a hole or region would say so.
  void warn_of(const std::vector<std::size_t>& holes) {
    const bool one = holes.size() == 1;
    warning_ = (one ? "1 enclosed area is" : std::to_string(holes.size()) + " enclosed areas are") + " left out as " +
               (one ? "a hole" : "holes") + ", the first" + near(holes.front()) +
               ", because the outline has no points of holes or regions. Next: --enclosed all meshes " +
               (one ? "it" : "them") + "; --enclosed alternate leaves " + (one ? "it" : "them") +
               " out without this warning";
  }

  Error take_all() {
    const auto depth = depths();
    for (std::size_t c = 0; c < n_components_; ++c) inside_[c] = depth[c] > 0 ? 1 : 0;
    for (std::size_t i = 0; i < outline_.holes.size(); ++i) {
      const auto error = [&](const std::string& what) {
        return InputError{ErrorCode::unused_point, names_.hole_where(i), names_.hole(i) + " " + what};
      };
      const std::uint32_t c = locate(outline_.holes[i]);
      if (c == kNone || depth[c] == 0) return error("lies outside; expected a place that segments enclose");
      inside_[c] = 0;
    }
    return {};
  }

  using Parts = std::vector<std::vector<std::int32_t>>;

  /// Each component's parts. They differ from the parts of the next component by the parts of the edge between them.
  /// `from`: the first components, whose parts are the parts of the edge before them.
  [[nodiscard]] Parts parts_from(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& first) const {
    Parts parts(n_components_);
    std::vector<std::uint8_t> known(n_components_, 0);
    std::vector<std::uint32_t> queue;
    const auto enter = [&](std::uint32_t c, const std::vector<std::int32_t>& from, std::uint32_t piece) {
      if (known[c] != 0) return;
      known[c] = 1;
      parts[c] = piece == kNone ? from : odd_ones(from, edges_[piece].parts);
      queue.push_back(c);
    };
    for (const auto& [c, piece] : first) enter(c, {}, piece);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t c = queue[i];
      for (const auto& [next, piece] : neighbors_[c]) enter(next, parts[c], piece);
    }
    return parts;
  }

  /// The elements in exactly one of two sorted lists.
  [[nodiscard]] static std::vector<std::int32_t> odd_ones(const std::vector<std::int32_t>& one,
                                                          const std::vector<std::int32_t>& other) {
    std::vector<std::int32_t> result;
    std::set_symmetric_difference(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(result));
    return result;
  }

  Error take_parts() {
    Parts parts = parts_from(from_outside_);
    if (Error error = take_rings(parts)) return error;
    for (std::size_t c = 0; c < n_components_; ++c) {
      if (!parts[c].empty()) {
        if (Error error = take(c, parts[c])) return error;
      }
    }
    return {};
  }

  /// Takes the rings out of the parts of components: what a hole encloses is in its shell, and in no other hole of it.
  Error take_rings(Parts& parts) const {
    const auto n = static_cast<std::int32_t>(outline_.parts.size());
    for (std::size_t c = 0; c < n_components_; ++c) {
      const auto first = std::lower_bound(parts[c].begin(), parts[c].end(), n);
      const std::vector<std::int32_t> around(first, parts[c].end());
      parts[c].erase(first, parts[c].end());
      std::vector<std::pair<std::int32_t, std::int32_t>> holes;  // shell and hole
      for (const std::int32_t ring : around) {
        const std::int32_t shell = outline_.rings[static_cast<std::size_t>(ring - n)].shell;
        if (shell < 0) continue;
        if (!std::binary_search(around.begin(), around.end(), shell + n))
          return ring_error(ring - n, "lies outside " + names_.ring(static_cast<std::size_t>(shell)) + near(c) +
                                          "; expected a hole inside its polygon. Next: correct the polygon, or make "
                                          "the ring a polygon of its own");
        holes.emplace_back(shell, ring - n);
      }
      std::sort(holes.begin(), holes.end());
      for (std::size_t i = 1; i < holes.size(); ++i) {
        if (holes[i].first != holes[i - 1].first) continue;
        return ring_error(holes[i].second, "overlaps " + names_.ring(static_cast<std::size_t>(holes[i - 1].second)) +
                                               near(c) + "; expected each hole once. Next: leave one of them out");
      }
    }
    return {};
  }
  [[nodiscard]] InputError ring_error(std::int32_t ring, const std::string& what) const {
    const auto i = static_cast<std::size_t>(ring);
    const auto& segments = outline_.rings[i].segments;
    return {ErrorCode::overlap,
            segments.empty() ? std::string() : names_.segment_where(static_cast<std::size_t>(segments[0])),
            names_.ring(i) + " " + what};
  }

  /// Puts a component into one part, with the properties of that part.
  Error take(std::size_t c, const std::vector<std::int32_t>& parts) {
    const OutlinePart& part = outline_.parts[static_cast<std::size_t>(parts[0])];
    inside_[c] = 1;
    region_[c] = part.region;
    size_[c] = std::min(size_[c], part.size.value_or(size_[c]));
    return parts.size() > 1 ? Error(overlap(c, parts)) : Error();
  }

  [[nodiscard]] InputError overlap(std::size_t c, const std::vector<std::int32_t>& parts) const {
    const auto name = [&](std::size_t k) { return names_.part(static_cast<std::size_t>(parts[k])); };
    return {ErrorCode::overlap, part_where(parts[1]),
            name(0) + " and " + name(1) + " overlap" + near(c) +
                "; expected parts that share their borders only. Next: cut one of them out of the other"};
  }

  /// The place of the first segment of a part, for messages.
  [[nodiscard]] std::string part_where(std::int32_t part) const {
    const auto& segments = outline_.parts[static_cast<std::size_t>(part)].segments;
    return segments.empty() ? std::string() : names_.segment_where(static_cast<std::size_t>(segments[0]));
  }

  /// The sphere has no outside: of the two sides that the segments of a part separate, the smaller one is in the part.
  /// If parts are meshed, only they are inside; parts that are cut out never are.
  Error take_smaller_sides() {
    if (!outline_.holes.empty())
      return InputError{ErrorCode::unsupported, names_.hole_where(0),
                        names_.hole(0) + " is for the plane; on the sphere nested loops take turns"};
    Parts parts = parts_from({{0, kNone}});
    extent_ = component_areas();
    if (Error error = turn_to_smaller_sides(parts)) return error;
    if (Error error = take_rings(parts)) return error;
    const auto is_cut = [&](std::int32_t i) { return outline_.parts[static_cast<std::size_t>(i)].cut; };
    const bool all = std::all_of(outline_.parts.begin(), outline_.parts.end(), [](const auto& p) { return p.cut; });
    for (std::size_t c = 0; c < n_components_; ++c) {
      const auto first_cut = std::stable_partition(parts[c].begin(), parts[c].end(), std::not_fn(is_cut));
      const std::vector<std::int32_t> kept(parts[c].begin(), first_cut), cut(first_cut, parts[c].end());
      if (cut.size() > 1) return overlap(c, cut);
      if (!cut.empty()) continue;
      if (all) {
        inside_[c] = 1;
      } else if (!kept.empty()) {
        if (Error error = take(c, kept)) return error;
      }
    }
    return {};
  }

  /// The area of each component, as a part of the sphere.
  [[nodiscard]] std::vector<double> component_areas() const {
    std::vector<double> area(n_components_, 0);
    for (const TriangleId t : hull_.mesh.triangles()) {
      const auto [a, b, c] = hull_.mesh.corners(t);
      const Mesh& mesh = hull_.mesh;
      area[component_[t]] += solid_angle(mesh.weighted_vector(a), mesh.weighted_vector(b), mesh.weighted_vector(c)) /
                             (4 * std::numbers::pi);
    }
    return area;
  }

  Error turn_to_smaller_sides(Parts& parts) const {
    constexpr double kHalf = 1e-6;  // of the sphere: a loop that is nearer to half of it says nothing
    const std::size_t n_parts = outline_.parts.size();
    std::vector<double> enclosed(n_parts + outline_.rings.size(), 0);
    for (std::size_t c = 0; c < n_components_; ++c) {
      for (const std::int32_t part : parts[c]) enclosed[static_cast<std::size_t>(part)] += extent_[c];
    }
    std::vector<std::int32_t> turned;
    for (std::size_t i = 0; i < enclosed.size(); ++i) {
      const auto part = static_cast<std::int32_t>(i);
      if (enclosed[i] > 0.5) turned.push_back(part);
      if (i >= n_parts || arrangement_.kept[i] == 0) continue;
      const auto error = [&](ErrorCode code, const std::string& what) {
        return InputError{code, part_where(part), names_.part(i) + " " + what};
      };
      if (enclosed[i] == 0)
        return error(ErrorCode::zero_area, "encloses nothing of the sphere; expected a ring with an area");
      if (std::abs(enclosed[i] - 0.5) < kHalf)
        return error(ErrorCode::out_of_scale,
                     "divides the sphere into halves; expected a smaller side, which is what it encloses");
    }
    for (auto& of_component : parts) of_component = odd_ones(of_component, turned);
    return {};
  }

  /// " near (x, y)": a corner of the component, in the coordinates of the file.
  [[nodiscard]] std::string near(std::size_t c) const {
    for (const TriangleId t : hull_.mesh.triangles()) {
      if (component_[t] != c) continue;
      return " near " + text_of(surface_, names_, surface_.place(hull_.mesh.point(hull_.mesh.corners(t)[0])));
    }
    return {};
  }

  Error take_regions() {
    std::vector<std::size_t> given(n_components_, kNone);
    for (std::size_t i = 0; i < outline_.regions.size(); ++i) {
      const OutlineRegion& region = outline_.regions[i];
      const auto error = [&](const std::string& what) {
        return InputError{ErrorCode::unused_point, names_.region_where(i), names_.region(i) + " " + what};
      };
      const std::uint32_t c = locate(region.at);
      if (c == kNone || inside_[c] == 0) return error("lies outside; expected a place inside the outline");
      if (given[c] != kNone && region_[c] != region.region) {
        return error("lies in the same area as " + names_.region(given[c]) + "; expected one region in each area");
      }
      given[c] = i;
      region_[c] = region.region;
      if (region.size) size_[c] = std::min(size_[c], *region.size);
    }
    for (std::size_t c = 0; c < n_components_; ++c) {
      for (const RegionSize& r : options_.region_sizes) {
        if (r.region == region_[c]) size_[c] = std::min(size_[c], r.size);
      }
    }
    return {};
  }

  /// The component of a place, or none outside the hull. A place on an edge belongs to one of its sides. The search
  /// starts at the last one.
  [[nodiscard]] std::uint32_t locate(Vec2 p) {
    const WeightedPoint vertex = surface_.space().is_closed() ? as_point(direction_of(p)) : WeightedPoint{p.x, p.y, 0};
    const Location at = temper::locate(hull_.mesh, vertex, located_);
    if (at.kind == Location::Kind::outside) return kNone;
    located_ = at.triangle;
    return component_[at.triangle];
  }

  [[nodiscard]] InputError nothing_enclosed() const {
    if (surface_.space().is_closed())
      return {ErrorCode::empty_input, "", "nothing of the sphere is left to mesh; expected an area outside the coasts"};
    std::vector<std::uint32_t> degree(arrangement_.places.size(), 0);
    for (const OutlineEdge& e : edges_) {
      for (const std::int32_t end : e.ends) ++degree[static_cast<std::size_t>(end)];
    }
    for (std::size_t i = 0; i < degree.size(); ++i) {
      const std::uint32_t point = arrangement_.point[i];
      if (degree[i] != 1 || point == Arrangement::kNoPoint) continue;
      return {ErrorCode::empty_input, names_.point_where(point),
              "the outline is not closed: it encloses nothing, and at " + names_.point(point) + " at " +
                  text_of(surface_, names_, arrangement_.places[i]) +
                  " only one segment ends. Next: end it on another segment, or close the line"};
    }
    return {ErrorCode::empty_input, "", "the outline encloses nothing but holes; expected an area to mesh"};
  }

  [[nodiscard]] Areas collect() const {
    Areas result;
    result.warning = warning_;
    std::vector<std::int32_t> number(n_components_, kOutside);
    for (std::size_t c = 0; c < n_components_; ++c) {
      if (inside_[c] == 0) continue;
      number[c] = static_cast<std::int32_t>(result.areas.size());
      result.areas.push_back({region_[c], size_[c], extent_[c]});
    }
    for (const OutlineEdge& e : edges_) {
      const VertexId a(static_cast<std::size_t>(e.ends[0])), b(static_cast<std::size_t>(e.ends[1]));
      const auto side = [&](VertexId from, VertexId to) {
        const HalfedgeId h = hull_.mesh.find_halfedge(from, to);
        return h.valid() ? number[component(h)] : kOutside;
      };
      result.sides.push_back({side(a, b), side(b, a)});
    }
    return result;
  }

  const Surface& surface_;
  const Outline& outline_;
  const Arrangement& arrangement_;
  const OutlineNames& names_;
  const std::vector<OutlineEdge>& edges_;
  const MesherOptions& options_;
  double largest_;
  Deadline& deadline_;
  Hull hull_;
  TriangleId located_ = TriangleId(0);
  IdVector<TriangleId, std::uint32_t> component_;
  std::uint32_t n_components_ = 0;
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> neighbors_;  // component, and the edge between
  std::vector<std::pair<std::uint32_t, std::uint32_t>> from_outside_;            // the same, from beyond the hull
  std::vector<std::uint8_t> inside_;
  std::vector<std::int32_t> region_;
  std::vector<double> size_, extent_;
  std::optional<std::string> warning_;
};

}  // namespace

Expected<Areas> find_areas(const Surface& surface, const Outline& outline, const Arrangement& arrangement,
                           const MesherOptions& options, double largest, Deadline& deadline) {
  return AreaFinder(surface, outline, arrangement, options, largest, deadline).run();
}

namespace {

/// An end of an edge, seen from its place.
struct Spoke {
  std::size_t edge, end;  // 0 or 1
  double angle;
  bool left, right;  // is the inside there?
};

std::vector<Spoke> spokes_at(const Surface& surface, const Arrangement& arrangement, const Areas& areas,
                             std::span<const std::size_t> ends) {
  std::vector<Spoke> spokes;
  for (const std::size_t i : ends) {
    const std::size_t edge = i / 2, end = i % 2;
    const auto at = [&](std::size_t k) {
      return arrangement.places[static_cast<std::size_t>(arrangement.edges[edge].ends[k])];
    };
    const Vec3 p = at(end), d = surface.direction(p, at(1 - end)), first = surface.some_direction(p);
    spokes.push_back({edge, end, std::atan2(dot(d, surface.to_the_left(first, p)), dot(d, first)),
                      areas.sides[edge][end] != kOutside, areas.sides[edge][1 - end] != kOutside});
  }
  std::sort(spokes.begin(), spokes.end(), [](const Spoke& s, const Spoke& t) {
    return s.angle < t.angle || (s.angle == t.angle && s.edge < t.edge);
  });
  return spokes;
}

}  // namespace

//        \  1  /
//         a   b         Fans 1 and 2 of the inside touch at p. Fan 1 keeps p. The edges around fan 2 get p′.
//  outside  p  outside
//         d p′ c
//        /  2  \  .
std::optional<InputError> split_touching(const Surface& surface, Arrangement& arrangement, const Areas& areas,
                                         double within, const OutlineNames& names) {
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
    const std::vector<Spoke> spokes = spokes_at(surface, arrangement, areas, ends[p]);
    const auto begins = [](const Spoke& s) { return s.left && !s.right; };
    const auto start = static_cast<std::size_t>(std::find_if(spokes.begin(), spokes.end(), begins) - spokes.begin());
    if (within == 0) {
      const std::size_t one = arrangement.edges[spokes.front().edge].segment,
                        other = arrangement.edges[spokes[start].edge].segment;
      return InputError{ErrorCode::non_manifold_vertex, names.segment_where(one),
                        "the domain touches itself at " + text_of(surface, names, arrangement.places[p]) +
                            ", a point of " + names.segment(one) + " and " + names.segment(other) +
                            ". Next: a tolerance --snap above 0 divides it there"};
    }
    if (split++ == 0) first = p;
    std::int32_t to = static_cast<std::int32_t>(p);
    for (std::size_t k = 0; k < spokes.size(); ++k) {
      const Spoke& spoke = spokes[(start + k) % spokes.size()];
      if (begins(spoke) && k > 0) {
        double half = 0;  // of the angle of the fan
        for (std::size_t m = k + 1; m <= spokes.size(); ++m) {
          const Spoke& last = spokes[(start + m) % spokes.size()];
          half = 0.5 * (last.angle - spoke.angle + (last.angle < spoke.angle ? 2 * std::numbers::pi : 0));
          if (!last.left) break;
        }
        const Vec3 at = arrangement.places[p], x = surface.some_direction(at), y = surface.to_the_left(x, at);
        const double angle = spoke.angle + half;
        to = static_cast<std::int32_t>(arrangement.places.size());
        arrangement.places.push_back(surface.below(at + (0.5 * within) * (std::cos(angle) * x + std::sin(angle) * y)));
        arrangement.point.push_back(Arrangement::kNoPoint);
        arrangement.origin.push_back(static_cast<std::int32_t>(p));
      }
      arrangement.edges[spoke.edge].ends[spoke.end] = to;
    }
  }
  if (split > 0) {
    arrangement.notes.push_back("points where the domain touched itself, and was divided: " + std::to_string(split) +
                                "; the first is " + text_of(surface, names, arrangement.places[first]));
  }
  return {};
}

Expected<Triangulated> triangulate(const Surface& surface, const DividedOutline& divided,
                                   const std::vector<Vec3>& further, const Areas& areas, Deadline& deadline) {
  std::vector<Vec3> points = divided.points;
  points.insert(points.end(), further.begin(), further.end());
  Expected<Hull> hull = triangulate_hull(surface, points, divided.pieces, deadline);
  if (!hull) return hull.error();
  Triangulated result{std::move(hull->mesh), {}, std::move(hull->piece)};
  const Mesh& mesh = result.mesh;
  const bool whole_sphere = divided.pieces.empty();
  result.area.resize(mesh.n_triangles(), whole_sphere ? 0 : kOutside);
  IdVector<TriangleId, std::uint8_t> known(mesh.n_triangles(), 0);
  std::vector<TriangleId> stack;
  constexpr std::size_t kAtATime = 1 << 16;  // steps, before the deadline is asked
  for (const HalfedgeId h : mesh.halfedges()) {
    if (h.index % kAtATime == 0 && deadline.ask()) break;
    if (result.piece[h] == kNone) continue;
    const Piece& piece = divided.pieces[result.piece[h]];
    const bool along = mesh.origin(h).index == piece.ends[0];
    const TriangleId t = Mesh::triangle(h);
    if (known[t] == 0) stack.push_back(t);
    known[t] = 1;
    result.area[t] = areas.sides[piece.edge][along ? 0 : 1];
  }
  while (!stack.empty()) {
    const TriangleId t = stack.back();
    stack.pop_back();
    if (t.index % kAtATime == 0 && deadline.ask()) break;
    each_halfedge(t, [&](HalfedgeId h) {
      if (result.piece[h] != kNone || mesh.is_boundary(h)) return;
      const TriangleId next = Mesh::triangle(mesh.twin(h));
      if (known[next] != 0) return;
      known[next] = 1;
      result.area[next] = result.area[t];
      stack.push_back(next);
    });
  }
  if (deadline.stopped()) return generate::stopped_error();
  return result;
}

}  // namespace temper::mesher

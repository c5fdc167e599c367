// One of four rules decides which components of triangles are inside.
#include "mesher/areas.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>

#include "mesher/components.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/projection.hpp"
#include "topology/locate.hpp"

namespace temper::mesher {
namespace {

using Error = std::optional<InputError>;

InputError nothing_enclosed(const Problem& problem, const Arrangement& arrangement) {
  if (problem.is_closed())
    return {ErrorCode::empty_input, "", "nothing of the sphere is left to mesh; expected an area outside the coasts"};
  std::vector<std::uint32_t> degree(arrangement.places.size(), 0);
  for (const OutlineEdge& e : arrangement.edges) {
    for (const std::int32_t end : e.ends) ++degree[static_cast<std::size_t>(end)];
  }
  for (std::size_t i = 0; i < degree.size(); ++i) {
    const std::uint32_t point = arrangement.point[i];
    if (degree[i] != 1 || point == Arrangement::kNoPoint) continue;
    return {ErrorCode::empty_input, problem.names.point_where(point),
            "the outline is not closed: it encloses nothing, and at " + problem.names.point(point) + " at " +
                problem.text(arrangement.places[i]) +
                " only one segment ends. Next: end it on another segment, or close the line"};
  }
  return {ErrorCode::empty_input, problem.outline.holes.empty() ? "" : problem.names.hole_where(0),
          "the outline encloses nothing but holes; expected an area to mesh"};
}

/// The place of the first segment of a part, for messages.
std::string part_where(const Problem& problem, std::int32_t part) {
  const auto& segments = problem.outline.parts[static_cast<std::size_t>(part)].segments;
  return segments.empty() ? std::string() : problem.names.segment_where(static_cast<std::size_t>(segments[0]));
}

Error turn_to_smaller_sides(const Problem& problem, const std::vector<std::uint8_t>& kept,
                            const std::vector<double>& extents, Parts& parts) {
  constexpr double kHalf = 1e-6;  // of the sphere: a loop that is nearer to half of it says nothing
  const std::size_t n_parts = problem.outline.parts.size();
  std::vector<double> enclosed(n_parts + problem.outline.rings.size(), 0);
  for (std::size_t c = 0; c < extents.size(); ++c) {
    for (const std::int32_t part : parts[c]) enclosed[static_cast<std::size_t>(part)] += extents[c];
  }
  std::vector<std::int32_t> turned;
  for (std::size_t i = 0; i < enclosed.size(); ++i) {
    const auto part = static_cast<std::int32_t>(i);
    if (enclosed[i] > 0.5) turned.push_back(part);
    if (i >= n_parts || kept[i] == 0) continue;
    const auto error = [&](ErrorCode code, const std::string& what) {
      return InputError{code, part_where(problem, part), problem.names.part(i) + " " + what};
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

class AreaFinder {
 public:
  AreaFinder(const Problem& problem, const Arrangement& arrangement, const Components& components)
      : problem_(problem),
        outline_(problem.outline),
        arrangement_(arrangement),
        components_(components),
        inside_(components.size(), 0),
        area_(components.size(), Area{0, problem.wanted.most, 0}) {}

  Expected<Areas> run() {
    if (const Error error = take_by_rule()) return *error;
    if (std::find(inside_.begin(), inside_.end(), std::uint8_t{1}) == inside_.end())
      return nothing_enclosed(problem_, arrangement_);
    if (const auto region_error = take_regions()) return *region_error;
    return collect();
  }

 private:
  Error take_by_rule() {
    if (problem_.is_closed()) return take_smaller_sides();
    if (!outline_.parts.empty()) return take_parts();
    return takes_turns() ? take_turns() : take_all();
  }

  [[nodiscard]] bool takes_turns() const {
    if (problem_.options.enclosed != Enclosed::by_points) return problem_.options.enclosed == Enclosed::alternate;
    return outline_.holes.empty() && outline_.regions.empty();
  }

  Error take_turns() {
    const auto depth = depths(components_);
    std::vector<std::size_t> holes;
    for (std::size_t c = 0; c < components_.size(); ++c) {
      inside_[c] = depth[c] % 2;
      if (depth[c] > 0 && inside_[c] == 0) holes.push_back(c);
    }
    if (problem_.options.enclosed == Enclosed::by_points && !holes.empty()) warn_of(holes);
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
    const auto depth = depths(components_);
    for (std::size_t c = 0; c < components_.size(); ++c) inside_[c] = depth[c] > 0 ? 1 : 0;
    for (std::size_t i = 0; i < outline_.holes.size(); ++i) {
      const auto error = [&](const std::string& what) {
        return InputError{ErrorCode::unused_point, problem_.names.hole_where(i), problem_.names.hole(i) + " " + what};
      };
      const std::uint32_t c = locate(outline_.holes[i]);
      if (c == Components::kNone || depth[c] == 0) return error("lies outside; expected a place that segments enclose");
      inside_[c] = 0;
    }
    return {};
  }

  Error take_parts() {
    Parts parts = parts_from(components_, components_.from_outside, arrangement_.edges);
    if (Error error = take_rings(parts)) return error;
    for (std::size_t c = 0; c < components_.size(); ++c) {
      if (!parts[c].empty()) {
        if (Error error = take(c, parts[c])) return error;
      }
    }
    return {};
  }

  /// Takes the rings out of the parts of components: what a hole encloses is in its shell, and in no other hole of it.
  Error take_rings(Parts& parts) const {
    const auto n = static_cast<std::int32_t>(outline_.parts.size());
    for (std::size_t c = 0; c < components_.size(); ++c) {
      const auto first = std::lower_bound(parts[c].begin(), parts[c].end(), n);
      const std::vector<std::int32_t> around(first, parts[c].end());
      parts[c].erase(first, parts[c].end());
      std::vector<std::pair<std::int32_t, std::int32_t>> holes;  // shell and hole
      for (const std::int32_t ring : around) {
        const std::int32_t shell = outline_.rings[static_cast<std::size_t>(ring - n)].shell;
        if (shell < 0) continue;
        if (!std::binary_search(around.begin(), around.end(), shell + n))
          return ring_error(ring - n, "lies outside " + problem_.names.ring(static_cast<std::size_t>(shell)) + near(c) +
                                          "; expected a hole inside its polygon. Next: correct the polygon, or make "
                                          "the ring a polygon of its own");
        holes.emplace_back(shell, ring - n);
      }
      std::sort(holes.begin(), holes.end());
      for (std::size_t i = 1; i < holes.size(); ++i) {
        if (holes[i].first != holes[i - 1].first) continue;
        return ring_error(holes[i].second, "overlaps " +
                                               problem_.names.ring(static_cast<std::size_t>(holes[i - 1].second)) +
                                               near(c) + "; expected each hole once. Next: leave one of them out");
      }
    }
    return {};
  }
  [[nodiscard]] InputError ring_error(std::int32_t ring, const std::string& what) const {
    const auto i = static_cast<std::size_t>(ring);
    const auto& segments = outline_.rings[i].segments;
    return {ErrorCode::overlap,
            segments.empty() ? std::string() : problem_.names.segment_where(static_cast<std::size_t>(segments[0])),
            problem_.names.ring(i) + " " + what};
  }

  /// Puts a component into one part, with the properties of that part.
  Error take(std::size_t c, const std::vector<std::int32_t>& parts) {
    const OutlinePart& part = outline_.parts[static_cast<std::size_t>(parts[0])];
    inside_[c] = 1;
    area_[c].region = part.region;
    area_[c].size = std::min(area_[c].size, part.size.value_or(area_[c].size));
    return parts.size() > 1 ? Error(overlap(c, parts)) : Error();
  }

  [[nodiscard]] InputError overlap(std::size_t c, const std::vector<std::int32_t>& parts) const {
    const auto name = [&](std::size_t k) { return problem_.names.part(static_cast<std::size_t>(parts[k])); };
    return {ErrorCode::overlap, part_where(problem_, parts[1]),
            name(0) + " and " + name(1) + " overlap" + near(c) +
                "; expected parts that share their borders only. Next: cut one of them out of the other"};
  }

  /// The sphere has no outside: of the two sides that the segments of a part separate, the smaller one is in the part.
  /// If parts are meshed, only they are inside; parts that are cut out never are.
  Error take_smaller_sides() {
    if (!outline_.holes.empty())
      return InputError{ErrorCode::unsupported, problem_.names.hole_where(0),
                        problem_.names.hole(0) + " is for the plane; on the sphere nested loops take turns"};
    Parts parts = parts_from(components_, {{0, kNoPiece}}, arrangement_.edges);
    const std::vector<double> extents = parts_of_sphere(components_);
    for (std::size_t c = 0; c < extents.size(); ++c) area_[c].extent = extents[c];
    if (Error error = turn_to_smaller_sides(problem_, arrangement_.kept, extents, parts)) return error;
    if (Error error = take_rings(parts)) return error;
    const auto is_cut = [&](std::int32_t i) { return outline_.parts[static_cast<std::size_t>(i)].cut; };
    const bool all = std::all_of(outline_.parts.begin(), outline_.parts.end(), [](const auto& p) { return p.cut; });
    for (std::size_t c = 0; c < components_.size(); ++c) {
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

  /// " near (x, y)": a corner of the component, in the coordinates of the file.
  [[nodiscard]] std::string near(std::size_t c) const {
    for (const TriangleId t : components_.hull.mesh.triangles()) {
      if (components_.of[t] != c) continue;
      return " near " +
             problem_.text(problem_.surface.place(components_.hull.mesh.point(components_.hull.mesh.corners(t)[0])));
    }
    return {};
  }

  Error take_regions() {
    std::vector<std::size_t> given(components_.size(), Components::kNone);
    for (std::size_t i = 0; i < outline_.regions.size(); ++i) {
      const OutlineRegion& region = outline_.regions[i];
      const auto error = [&](const std::string& what) {
        return InputError{ErrorCode::unused_point, problem_.names.region_where(i),
                          problem_.names.region(i) + " " + what};
      };
      const std::uint32_t c = locate(region.at);
      if (c == Components::kNone || inside_[c] == 0) return error("lies outside; expected a place inside the outline");
      if (given[c] != Components::kNone && area_[c].region != region.region) {
        return error("lies in the same area as " + problem_.names.region(given[c]) +
                     "; expected one region in each area");
      }
      given[c] = i;
      area_[c].region = region.region;
      if (region.size) area_[c].size = std::min(area_[c].size, *region.size);
    }
    for (const RegionSize& r : problem_.options.region_sizes) {
      std::set<std::int32_t> others;
      bool is_used = false;
      for (std::size_t c = 0; c < components_.size(); ++c) {
        if (inside_[c] == 0) continue;
        others.insert(area_[c].region);
        if (r.region != area_[c].region) continue;
        is_used = true;
        area_[c].size = std::min(area_[c].size, r.size);
      }
      if (!is_used) return unknown_region(r.region, others);
    }
    return {};
  }

  static InputError unknown_region(std::int32_t region, const std::set<std::int32_t>& known) {
    std::string list;
    for (const std::int32_t k : known) list += (list.empty() ? "" : ", ") + std::to_string(k);
    return invalid("a size is given for region " + std::to_string(region) +
                   "; expected one of the regions of the outline: " + list);
  }

  /// The component of a place, or none outside the hull. A place on an edge belongs to one of its sides. The search
  /// starts at the last one.
  [[nodiscard]] std::uint32_t locate(Vec2 p) {
    const WeightedPoint vertex = problem_.is_closed() ? as_point(direction_of(p)) : WeightedPoint{p.x, p.y, 0};
    const Location at = temper::locate(components_.hull.mesh, vertex, located_);
    if (at.kind == Location::Kind::outside) return Components::kNone;
    located_ = at.triangle;
    return components_.of[at.triangle];
  }

  [[nodiscard]] Areas collect() const {
    Areas result;
    result.warning = warning_;
    std::vector<std::int32_t> number(components_.size(), kOutside);
    for (std::size_t c = 0; c < components_.size(); ++c) {
      if (inside_[c] == 0) continue;
      number[c] = static_cast<std::int32_t>(result.areas.size());
      result.areas.push_back(area_[c]);
    }
    for (const OutlineEdge& e : arrangement_.edges) {
      const VertexId a(static_cast<std::size_t>(e.ends[0])), b(static_cast<std::size_t>(e.ends[1]));
      const auto side = [&](VertexId from, VertexId to) {
        const HalfedgeId h = components_.hull.mesh.find_halfedge(from, to);
        return h.valid() ? number[components_.at(h)] : kOutside;
      };
      result.sides.push_back({side(a, b), side(b, a)});
    }
    return result;
  }

  const Problem& problem_;
  const Outline& outline_;
  const Arrangement& arrangement_;
  const Components& components_;
  TriangleId located_ = TriangleId(0);
  std::vector<std::uint8_t> inside_;  // of each component
  std::vector<Area> area_;
  std::optional<std::string> warning_;
};

}  // namespace

Expected<Areas> find_areas(const Problem& problem, const Arrangement& arrangement, Deadline& deadline) {
  const Expected<Components> components = find_components(problem.surface, arrangement, deadline);
  if (!components && components.error().code == ErrorCode::zero_area)
    return InputError{ErrorCode::zero_area, problem.names.point_where(0),
                      components.error().message + "; expected an outline that encloses an area"};
  if (!components) return components.error();
  return AreaFinder(problem, arrangement, *components).run();
}

}  // namespace temper::mesher

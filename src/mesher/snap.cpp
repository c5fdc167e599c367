// Rounds of joins and divisions, then of crossings that remain.
//
// Why it ends. Joins make places fewer. A division at p replaces ab by ap and pb. All places are at least the tolerance
// r apart, p is at most r from ab, and its foot at least 0.75 r from both ends (else p and that end are joined):
//
//          p            |ab|² − |ap|² = 2 t u + u² − h² ≥ (3 · 0.75² − 1) r² > 0.68 r²
//        / | \          .
//      /   h  \         So each part is shorter than the divided one, by a least amount. Crossings become places,
//    a - t - u b        which are at least r apart, too.
#include "mesher/snap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "geometry/bounding_boxes.hpp"

namespace temper::mesher {
namespace {

constexpr double kEnd = 0.75;  // of the tolerance: see above
// Parts that are shorter than this many tolerances are divided at one place in a round. So parts always get shorter.
constexpr double kShort = 4;
// Relative to the radius. One place in several conventions of longitude has points this near. Such joins do not count.
constexpr double kRoundingOfDegrees = 1e-13;
// Each round finds the crossings that the parts of the last one make. Nearly always one is enough.
constexpr int kCrossingRounds = 100;

using Ends = std::array<Vec3, 2>;

/// Two great circles meet twice: arcs cross only if c and a are on opposite sides of each other's arc.
bool cross(const Surface& surface, const Ends& one, const Ends& other) {
  const auto [a, b] = one;
  const auto [c, d] = other;
  const Sign of_c = surface.orientation(a, b, c);
  return of_c != Sign::zero && surface.orientation(a, b, d) == -of_c && surface.orientation(c, d, a) == -of_c &&
         surface.orientation(c, d, b) == of_c;
}

Vec3 crossing_of(const Surface& surface, const Ends& one, const Ends& other) {
  const auto [a, b] = one;
  const auto [c, d] = other;
  if (surface.is_plane()) {
    const double part = temper::cross(c - a, d - c).z / temper::cross(b - a, d - c).z;
    return a + std::clamp(part, 0.0, 1.0) * (b - a);
  }
  const Vec3 normal = temper::cross(c, d - c);
  const double of_a = dot(normal, a - c), of_b = dot(normal, b - c);
  return surface.below(a + std::clamp(of_a / (of_a - of_b), 0.0, 1.0) * (b - a));
}

class Snapper {
 public:
  Snapper(const Surface& surface, std::vector<Vec3> places, std::vector<SegmentPart> segments,
          const SnapOptions& options, Deadline& deadline)
      : surface_(surface),
        options_(options),
        deadline_(deadline),
        segments_(std::move(segments)),
        rounding_(surface.is_plane() ? 0 : kRoundingOfDegrees * surface.space().radius()) {
    result_.places = std::move(places);
    result_.parts = segments_;
    result_.joined.resize(n_places());
    std::iota(result_.joined.begin(), result_.joined.end(), 0);
    for (std::size_t i = 0; i < options.ignored.size(); ++i) {
      if (options.ignored[i] != 0) result_.joined[i] = -1;
    }
    counted_.resize(n_places(), 0);
    fresh_.assign(segments_.size(), 1);
  }

  Snapped run() {
    index_places();
    join_places(0);
    move_parts();
    for (int round = 0; round < kCrossingRounds; ++round) {
      while (divide_at_places()) {
      }
      if (deadline_.stopped() || !divide_at_crossings()) break;
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::size_t n_places() const { return result_.places.size(); }
  [[nodiscard]] Vec3 at(std::int32_t i) const { return result_.places[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Ends ends(const SegmentPart& part) const { return {at(part.ends[0]), at(part.ends[1])}; }
  [[nodiscard]] std::int32_t& joined(std::int32_t i) { return result_.joined[static_cast<std::size_t>(i)]; }
  [[nodiscard]] std::int32_t find(std::int32_t i) {
    while (joined(i) != i) i = joined(i) = joined(joined(i));
    return i;
  }

  void index_places() {
    std::vector<BoundingBox> boxes;
    boxes.reserve(n_places());
    for (const Vec3 p : result_.places) boxes.push_back({p, p});
    tree_ = BoundingBoxTree(boxes);
  }

  void count(std::int32_t place, double distance) {
    const auto i = static_cast<std::size_t>(place);
    if (distance < rounding_ || i >= counted_.size()) return;
    if (counted_[i] == 0) ++result_.joins;
    counted_[i] = 1;
    if (result_.farthest >= 0 && distance <= result_.largest) return;
    result_.largest = distance;
    result_.farthest = place;
  }

  /// Joins each place from `first` on to the nearest one before it that is within the tolerance.
  void join_places(std::size_t first) {
    if (options_.within == 0) return;
    for (std::size_t i = first; i < n_places() && !deadline_.asked_to_stop(); ++i) {
      if (result_.joined[i] < 0) continue;
      const Vec3 p = result_.places[i];
      double least = options_.within;
      std::int32_t nearest = -1;
      tree_.visit(BoundingBox{p, p}.grown(options_.within), [&](std::size_t j) {
        const auto place = static_cast<std::int32_t>(j);
        if (j >= i || joined(place) != place) return true;
        const double distance = length(p - result_.places[j]);
        if (distance > least || (distance == least && nearest >= 0 && place > nearest)) return true;
        least = distance;
        nearest = place;
        return true;
      });
      if (nearest < 0) continue;
      const auto place = static_cast<std::int32_t>(i);
      joined(place) = nearest;
      count(place, least);
    }
  }

  /// A place that a part passes.
  struct Passed {
    std::int32_t place;
    double along;     // from the first end
    double distance;  // 0 if it is exactly on the part
  };

  [[nodiscard]] std::vector<Passed> places_on(const SegmentPart& part) {
    std::vector<Passed> passed;
    const Vec3 a = at(part.ends[0]), b = at(part.ends[1]);
    tree_.visit(box_around(surface_, a, b).grown(options_.within), [&](std::size_t i) {
      const auto p = static_cast<std::int32_t>(i);
      if (p == part.ends[0] || p == part.ends[1] || joined(p) != p) return !deadline_.asked_to_stop();
      const Vec3 x = result_.places[i];
      const double distance = std::sqrt(surface_.squared_distance(x, a, b));
      const bool exact = surface_.orientation(a, b, x) == Sign::zero && surface_.is_between(x, a, b);
      if (exact || distance <= options_.within) {
        passed.push_back({p, surface_.part_below(a, b, x) * surface_.distance(a, b), exact ? 0 : distance});
      }
      return !deadline_.asked_to_stop();
    });
    std::sort(passed.begin(), passed.end(), [](const Passed& p, const Passed& q) {
      return p.along < q.along || (p.along == q.along && p.place < q.place);
    });
    return passed;
  }

  /// Divides new parts at the places that they pass. Returns false if there is none.
  bool divide_at_places() {
    std::vector<SegmentPart> parts;
    std::vector<std::uint8_t> fresh;
    std::vector<std::array<std::int32_t, 2>> joins;
    bool changed = false;
    for (std::size_t i = 0; i < result_.parts.size(); ++i) {
      const SegmentPart part = result_.parts[i];
      std::vector<std::int32_t> through;
      if (fresh_[i] != 0 && !deadline_.asked_to_stop()) through = divisions(part, joins);
      changed = changed || !through.empty();
      append(parts, fresh, part, through);
    }
    result_.parts = std::move(parts);
    fresh_ = std::move(fresh);
    for (const auto& [p, q] : joins) {
      const std::int32_t one = find(p), other = find(q);
      joined(std::max(one, other)) = std::min(one, other);
    }
    if (!joins.empty()) move_parts();
    return (changed || !joins.empty()) && !deadline_.stopped();
  }

  /// The places that divide a part, in their order. Places next to an end are joined to it.
  std::vector<std::int32_t> divisions(const SegmentPart& part, std::vector<std::array<std::int32_t, 2>>& joins) {
    std::vector<Passed> passed = places_on(part);
    const double whole = surface_.distance(at(part.ends[0]), at(part.ends[1])), end = kEnd * options_.within;
    const auto at_end = [&](const Passed& p) {
      if (p.along >= end && whole - p.along >= end) return false;
      const std::int32_t to = part.ends[p.along < whole - p.along ? 0 : 1];
      joins.push_back({p.place, to});
      count(std::max(p.place, to), length(at(p.place) - at(to)));
      return true;
    };
    passed.erase(std::remove_if(passed.begin(), passed.end(), at_end), passed.end());
    if (whole < kShort * options_.within && passed.size() > 1) {
      passed = {*std::min_element(passed.begin(), passed.end(),
                                  [](const Passed& p, const Passed& q) { return p.distance < q.distance; })};
    }
    std::vector<std::int32_t> through;
    for (const Passed& p : passed) {
      through.push_back(p.place);
      if (p.distance > 0) count(p.place, p.distance);
    }
    return through;
  }

  static void append(std::vector<SegmentPart>& parts, std::vector<std::uint8_t>& fresh, const SegmentPart& part,
                     const std::vector<std::int32_t>& through) {
    std::int32_t from = part.ends[0];
    const auto add = [&](std::int32_t to) {
      if (to == from) return;
      parts.push_back({{from, to}, part.segment});
      fresh.push_back(through.empty() ? 0 : 1);
      from = to;
    };
    for (const std::int32_t place : through) add(place);
    add(part.ends[1]);
  }

  /// Moves the ends of parts to the places that they are joined to. Parts of no length go.
  void move_parts() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < result_.parts.size(); ++i) {
      SegmentPart part = result_.parts[i];
      for (std::int32_t& end : part.ends) end = find(end);
      const bool moved = part.ends != result_.parts[i].ends;
      if (part.ends[0] == part.ends[1]) continue;
      fresh_[kept] = moved ? 1 : fresh_[i];
      result_.parts[kept++] = part;
    }
    result_.parts.resize(kept);
    fresh_.resize(kept);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(n_places()); ++i) {
      if (joined(i) >= 0) joined(i) = find(i);
    }
  }

  /// Divides parts where they cross. Returns false if there is no crossing, or one to report.
  bool divide_at_crossings() {
    std::vector<BoundingBox> boxes;
    boxes.reserve(result_.parts.size());
    for (const SegmentPart& part : result_.parts) {
      const auto [a, b] = ends(part);
      boxes.push_back(box_around(surface_, a, b));
    }
    const BoundingBoxTree tree(boxes);
    std::vector<std::array<std::size_t, 2>> pairs;
    for (std::size_t i = 0; i < boxes.size() && !deadline_.asked_to_stop(); ++i) {
      tree.visit(boxes[i], [&](std::size_t j) {
        if (j > i && cross(surface_, ends(result_.parts[i]), ends(result_.parts[j]))) pairs.push_back({i, j});
        return !deadline_.asked_to_stop();
      });
    }
    if (pairs.empty() || deadline_.stopped()) return false;
    std::sort(pairs.begin(), pairs.end());
    const std::size_t first = n_places();
    std::vector<std::vector<std::int32_t>> through(boxes.size());
    for (const auto& [i, j] : pairs) {
      const SegmentPart &one = result_.parts[i], &other = result_.parts[j];
      const Vec3 place = crossing_of(surface_, ends(one), ends(other));
      if (!options_.split_crossings && cross(surface_, ends(segments_[one.segment]), ends(segments_[other.segment]))) {
        result_.crossing = {one.segment, other.segment, place};
        return false;
      }
      for (const std::size_t k : {i, j}) through[k].push_back(static_cast<std::int32_t>(n_places()));
      result_.joined.push_back(static_cast<std::int32_t>(n_places()));
      result_.places.push_back(place);
    }
    index_places();
    join_places(first);
    divide_through(through);
    return true;
  }

  void divide_through(std::vector<std::vector<std::int32_t>>& through) {
    std::vector<SegmentPart> parts;
    std::vector<std::uint8_t> fresh;
    for (std::size_t i = 0; i < through.size(); ++i) {
      const SegmentPart part = result_.parts[i];
      const auto along = [&](std::int32_t p) { return surface_.part_below(at(part.ends[0]), at(part.ends[1]), at(p)); };
      for (std::int32_t& place : through[i]) place = find(place);
      std::sort(through[i].begin(), through[i].end(),
                [&](std::int32_t p, std::int32_t q) { return along(p) < along(q); });
      append(parts, fresh, part, through[i]);
    }
    result_.parts = std::move(parts);
    fresh_.assign(result_.parts.size(), 1);  // for the new places
  }

  const Surface& surface_;
  const SnapOptions& options_;
  Deadline& deadline_;
  std::vector<SegmentPart> segments_;  // as given
  double rounding_;
  Snapped result_;
  BoundingBoxTree tree_;               // of places
  std::vector<std::uint8_t> counted_;  // given places that were joined
  std::vector<std::uint8_t> fresh_;    // parts that were not searched for places yet
};

}  // namespace

Snapped snap(const Surface& surface, std::vector<Vec3> places, std::vector<SegmentPart> segments,
             const SnapOptions& options, Deadline& deadline) {
  return Snapper(surface, std::move(places), std::move(segments), options, deadline).run();
}

}  // namespace temper::mesher

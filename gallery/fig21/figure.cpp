// Figure 21: the energy around vertex a while it is optimized from either state of the oscillation, as the searches see
// it (extrapolated beyond the flip) and as it is once the flips are carried out.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "experiments/line_search.hpp"
#include "experiments/oscillating_horseshoe.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/regularity.hpp"

namespace temper::gallery::fig21 {
namespace {

using Triangles = std::set<std::array<VertexId, 3>>;

std::array<VertexId, 3> sorted_corners(const Mesh& mesh, TriangleId t) {
  auto corners = mesh.corners(t);
  std::sort(corners.begin(), corners.end());
  return corners;
}

Triangles triangles_of(const Mesh& mesh) {
  Triangles all;
  for (const TriangleId t : mesh.triangles()) all.insert(sorted_corners(mesh, t));
  return all;
}

/// Share of one triangle in E_∂T ★1: (d_ij³ h + d_ij h³) / 3 over its half-edges, |h| on the boundary.
double triangle_share(const Mesh& mesh, TriangleId t) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const HalfedgeId e = Mesh::halfedge(t, k);
    const WeightedPoint p = mesh.point(mesh.origin(e)), q = mesh.point(mesh.target(e));
    double h = signed_height(p, q, mesh.point(mesh.opposite(e)));
    if (mesh.is_boundary(e)) h = std::abs(h);
    for (const double d : {dual_crossing(p, q), dual_crossing(q, p)}) sum += (d * d * d * h + d * h * h * h) / 3;
  }
  return sum;
}

/// The same with vertex a elsewhere.
struct Place {
  Vec2 at;
  double extrapolated = 0;  ///< connectivity of the start
  double exact = 0;         ///< after the flips that a's place asks for
};

/// One direction of the oscillation: a alone is optimized from a regular mesh.
class Direction {
 public:
  Direction(const Moment& start, VertexId a) : mesh_(start.mesh), a_(start.find(a)) {
    searches_ = line_searches(mesh_, energy_dt(), a_);
    flip_at_ = searches_.empty() ? kNoThreshold : position_flip_threshold(mesh_, a_, step(0));
    find_region();
  }

  [[nodiscard]] const std::vector<LineSearch>& searches() const { return searches_; }
  /// The same with another patch radius.
  [[nodiscard]] std::vector<LineSearch> searches_within(SearchRadius radius) const {
    return line_searches(mesh_, energy_dt(), a_, radius);
  }
  [[nodiscard]] Vec2 step(std::size_t i) const { return searches_[i].to - searches_[i].from; }
  /// Multiple of the first search's step at which the first edge must flip.
  [[nodiscard]] double flip_at() const { return flip_at_; }

  [[nodiscard]] Place place(Vec2 p) const {
    Mesh moved = mesh_;
    moved.set_position(a_, p);
    Place there{p};
    for (const TriangleId t : region_) there.extrapolated += triangle_share(moved, t);
    const double before = total_energy(moved, energy_dt());
    restore_regularity(moved);
    there.exact = there.extrapolated + total_energy(moved, energy_dt()) - before;
    return there;
  }
  [[nodiscard]] Place on_search(std::size_t i, double t) const { return place(searches_[i].from + t * step(i)); }
  [[nodiscard]] Place first() const { return on_search(0, 0); }
  [[nodiscard]] Place last() const { return on_search(searches_.size() - 1, 1); }

 private:
  /// The patch of a, and the triangles beyond it that the flips at the end of the searches replace.
  void find_region() {
    Mesh ended = mesh_;
    if (!searches_.empty()) ended.set_position(a_, searches_.back().to);
    restore_regularity(ended);
    const Triangles after = triangles_of(ended);
    for (const TriangleId t : mesh_.triangles()) {
      const auto corners = sorted_corners(mesh_, t);
      const bool around = std::ranges::find(corners, a_) != corners.end();
      if (around || !after.contains(corners)) region_.push_back(t);
    }
  }

  Mesh mesh_;
  VertexId a_;
  std::vector<LineSearch> searches_;
  double flip_at_ = kNoThreshold;
  std::vector<TriangleId> region_;
};

/// There and back: from the state of lower energy, and from the other.
struct Cycle {
  Direction there, back;
};

const Cycle& cycle() {
  static const Cycle found = [] {
    const auto flipped = oscillating_run().all(Snapshot::Moment::after_flips);
    const VertexId a = oscillating_vertices()[0];
    const Moment &one = *flipped[flipped.size() - 2], &other = *flipped.back();
    const bool one_is_lower = one.energy < other.energy;
    return Cycle{Direction(one_is_lower ? one : other, a), Direction(one_is_lower ? other : one, a)};
  }();
  return found;
}

// --- the plot ------------------------------------------------------------------------------------------

constexpr int kSamples = 60;  // a search
constexpr std::array<const char*, 3> kThere = {"#08306b", "#2171b5", "#6baed6"};
constexpr std::array<const char*, 3> kBack = {"#67000d", "#cb181d", "#fb6a4a"};
constexpr const char* kExact = "#7b3fa0";
constexpr const char* kJump = "#777777";

Series search_series(const Direction& d, std::size_t i, const std::string& name, const char* color) {
  Series series{name, {}, SeriesStyle::line, color};
  for (int k = 0; k <= kSamples; ++k) {
    const Place p = d.on_search(i, static_cast<double>(k) / kSamples);
    series.points.push_back({p.at.x, p.extrapolated});
  }
  return series;
}

Series exact_series(const Direction& d, const std::string& name, SeriesStyle style) {
  Series series{name, {}, style, kExact};
  for (int k = 0; k <= kSamples; ++k) {
    const Place p = d.on_search(0, static_cast<double>(k) / kSamples);
    series.points.push_back({p.at.x, p.exact});
  }
  return series;
}

Series jump_series(const Direction& d, const std::string& name) {
  const Place end = d.last();
  return {name, {{end.at.x, end.extrapolated}, {end.at.x, end.exact}}, SeriesStyle::dashed, kJump};
}

void add_direction(const Direction& d, const std::string& name, const std::array<const char*, 3>& colors,
                   LinePlot& plot) {
  for (std::size_t i = 0; i < d.searches().size(); ++i) {
    plot.series.push_back(search_series(d, i, name + ", search " + std::to_string(i + 1), colors[i]));
  }
  const Place flip = d.on_search(0, d.flip_at());
  plot.marks.push_back({{flip.at.x, flip.extrapolated}, ""});
}

Picture curves() {
  const auto& [there, back] = cycle();
  LinePlot plot;
  plot.title = "Energy around a while a is optimized";
  plot.x_label = "x of a";
  plot.y_label = "E_{∂T} of the region";
  plot.width = 760, plot.height = 460;
  plot.legend = LegendPlace::outside;
  plot.series.push_back(exact_series(there, "true, outwards", SeriesStyle::line));
  plot.series.push_back(exact_series(back, "true, inwards", SeriesStyle::dashed));
  add_direction(there, "outwards", kThere, plot);
  add_direction(back, "inwards", kBack, plot);
  plot.series.push_back(jump_series(there, "flips"));
  plot.series.push_back(jump_series(back, ""));
  return {
      "fig21", line_plot_svg(plot),
      "E_∂T of the region that the flips change, against the place of a along its line searches. Blue: outwards, from "
      "the state of lower energy; red: back. Both go on with the connectivity they began with; purple is the energy of "
      "the first search with flips carried out. Dots: where the first edge must flip. Gray: what the flips at the end "
      "add."};
}

Table energies() {
  Table t{"Energy of the triangles around a and of those that its flips replace, a alone moving.",
          {"direction", "start", "extrapolated", "after flips", "paper: start", "extrapolated", "after flips"},
          {}};
  const auto row = [&](const char* name, const Direction& d, std::array<const char*, 3> paper) {
    t.rows.push_back({name, digits(d.first().extrapolated), digits(d.last().extrapolated), digits(d.last().exact),
                      paper[0], paper[1], paper[2]});
  };
  row("outwards", cycle().there, {"1.14", "0.986", "1.49"});
  row("inwards", cycle().back, {"1.49", "1.09", "1.14"});
  return t;
}

// --- the claims ----------------------------------------------------------------------------------------

Claim one_search_leaves_regularity() {
  const double there = cycle().there.flip_at(), back = cycle().back.flip_at();
  return {"21",
          "From either state one line search moves a to where the mesh is not regular.",
          "a single line-search is sufficient",
          "the first flip is due at " + digits(there, 3) + " of the first search outwards and at " + digits(back, 3) +
              " inwards",
          there < 1 && back < 1,
          "The flip threshold along the search, as a part of its length."};
}

bool near(double ours, double paper) {
  constexpr double kNear = 0.1;  // relative: the meshes beyond the patch differ
  return std::abs(ours - paper) <= kNear * paper;
}

Claim energies_go_down_and_up() {
  const double start = cycle().there.first().extrapolated, end = cycle().there.last().extrapolated;
  const double flipped = cycle().there.last().exact, back = cycle().back.last().extrapolated;
  return {
      "21",
      "Optimizing a lowers the extrapolated energy, but flips raise the true one above that of the start; optimizing "
      "again leads back.",
      "1.14 → 0.986, 1.49 after flips; back to 1.09",
      digits(start, 3) + " → " + digits(end, 3) + ", " + digits(flipped, 3) + " after flips; back to " +
          digits(back, 3),
      end < start && start < flipped && back < flipped && near(start, 1.14) && near(end, 0.986) &&
          near(flipped, 1.49) && near(back, 1.09),
      "Each within 10 % of the paper's, and in its order. Three line searches of a alone from the last two meshes of "
      "figure 20."};
}

Claim flip_is_a_minimum() {
  constexpr double kBeside = 0.02;  // of the search, on both sides
  const Direction& d = cycle().there;
  const double before = d.on_search(0, d.flip_at() - kBeside).exact, at = d.on_search(0, d.flip_at()).exact;
  const double after = d.on_search(0, d.flip_at() + kBeside).exact;
  double least = at;
  for (int k = 0; k <= kSamples; ++k) least = std::min(least, d.on_search(0, static_cast<double>(k) / kSamples).exact);
  return {"21",
          "The flip point is a local minimum of the true energy.",
          "upper branches of the blue and purple curves",
          digits(before, 5) + ", " + digits(at, 5) + ", " + digits(after, 5) + " just before, at and just after it",
          at < before && at < after,
          "Along the first search outwards, " + digits(kBeside, 1) + " of its length to either side. The least of " +
              std::to_string(kSamples + 1) + " samples along the whole search is " + digits(least, 5) + "."};
}

/// Part of the searches' length on which the mesh is not regular.
double extrapolated_part(const Direction& d) {
  constexpr double kRounding = 1e-9;  // of sums of a few hundred terms of order 1
  double all = 0, extrapolated = 0;
  for (std::size_t i = 0; i < d.searches().size(); ++i) {
    const double piece = length(d.step(i)) / kSamples;
    for (int k = 0; k < kSamples; ++k) {
      const Place p = d.on_search(i, (k + 0.5) / kSamples);
      all += piece;
      if (std::abs(p.exact - p.extrapolated) > kRounding) extrapolated += piece;
    }
  }
  return extrapolated / all;
}

Claim mostly_extrapolated() {
  const double there = extrapolated_part(cycle().there), back = extrapolated_part(cycle().back);
  return {"21",
          "In each direction most of the optimization is based on extrapolated energies.",
          "most, in each direction",
          digits(100 * there, 3) + " % of a's way outwards and " + digits(100 * back, 3) + " % inwards",
          there > 0.5 && back > 0.5,
          "The part of the length of the three searches on which flips would change the energy."};
}

Claim first_search_ends_at_its_limit() {
  constexpr double kEnd = 0.999;  // of the interval
  const auto parts = [](const Direction& d, SearchRadius radius) {
    std::vector<double> found;
    for (const LineSearch& search : d.searches_within(radius)) found.push_back(search.part);
    return found;
  };
  const auto as_claimed = [](const std::vector<double>& part) {
    return part.size() == 3 && part[0] > kEnd && part[1] < kEnd && part[2] < kEnd;
  };
  const auto text = [](const std::vector<double>& part) {
    std::string all;
    for (const double p : part) all += (all.empty() ? "" : ", ") + digits(p, 2);
    return all;
  };
  const auto both = [&](SearchRadius radius) {
    return text(parts(cycle().there, radius)) + " outwards and " + text(parts(cycle().back, radius)) + " inwards";
  };
  const std::vector<double> there = parts(cycle().there, SearchRadius::min);
  const std::vector<double> back = parts(cycle().back, SearchRadius::min);
  return {
      "21",
      "Of the three searches for vertex a the first stops at its limit, the other two at minima.",
      "the first search stops at its limit",
      "up to the nearest neighbor they end at " + both(SearchRadius::min) +
          " of their limits; up to the root mean "
          "square distance at " +
          both(SearchRadius::rms),
      as_claimed(there) && as_claimed(back),
      "The limit is \"the patch radius\", which the paper does not define, cut at 0.9 of the way to an inversion. Up "
      "to the farthest neighbor " +
          both(SearchRadius::max) + "."};
}

std::string place_text(Vec2 p) { return "(" + digits(p.x, 3) + ", " + digits(p.y, 3) + ")"; }

Claim places_of_the_states(Effort effort) {
  std::size_t runs = 0, a_leftmost = 0, b_leftmost = 0;
  for (const OrderedRun& r : oscillations_by_order(effort)) {
    const Oscillation& o = r.oscillation;
    if (!as_in_the_paper(o)) continue;
    ++runs;
    a_leftmost += o.places_low[0].x < o.places_high[0].x;
    b_leftmost += o.places_low[1].x < o.places_high[1].x;
  }
  const Oscillation shown = oscillation_of(oscillating_run());
  return {
      "21",
      "In the state of less energy a, the vertex of the left arm, is at its leftmost place.",
      "left-most: 1.14; right-most: 0.986, then 1.49",
      "a is at " + place_text(shown.places_low[0]) + " in the state of less energy and at " +
          place_text(shown.places_high[0]) + " in the other; leftmost in the former in " + digits(a_leftmost) + " of " +
          digits(runs) + " runs, b of the right arm in " + digits(b_leftmost),
      runs > 0 && 2 * a_leftmost > runs,
      "The runs of figure 20 that end in two states with the paper's energies, whatever their vertex order. In both "
      "arms the vertex stands inwards in the state of less energy: the energies are those of the paper, and its "
      "places those of b, at " +
          place_text(shown.places_low[1]) + " and " + place_text(shown.places_high[1]) + "."};
}

}  // namespace

Page make(Effort effort) {
  return {{curves()},
          {energies()},
          {one_search_leaves_regularity(), energies_go_down_and_up(), flip_is_a_minimum(), mostly_extrapolated(),
           first_search_ends_at_its_limit(), places_of_the_states(effort)}};
}

}  // namespace temper::gallery::fig21

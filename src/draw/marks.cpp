#include "draw/marks.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "draw/painter.hpp"
#include "temper/detail/geometry.hpp"

namespace temper {
namespace {

constexpr double kRingWidth = 0.09, kPeriodWidth = 0.1;  // of the font size
constexpr double kNearCoincident = 0.05;  // of the mean of the other edges around: nothing to see between the two ends
constexpr double kRingRadius = 0.35, kDotRadius = 0.28;  // of the font size
constexpr double kFontPerEdge = 0.22, kLeastFont = 3;

double edge_length(const Mesh& mesh, HalfedgeId h) {
  const WeightedPoint a = mesh.point(mesh.origin(h)), b = mesh.point(mesh.target(h), a);
  return distance(mesh.space(), a, b);
}

class MarkPainter : public Painter {
 public:
  MarkPainter(const Mesh& mesh, const Viewport& viewport, const DrawOptions& options)
      : Painter(viewport, options), mesh_(mesh) {}

  Panel paint() {
    mark_fixed();
    draw_periods();
    if (options_.near_coincident) ring_near_coincident();
    if (options_.vertex_numbers) number_vertices();
    return std::move(panel_);
  }

 private:
  /// Vertices of lines and of the boundary are known by these.
  void mark_fixed() {
    PathText path;
    for (const VertexId v : mesh_.vertices()) {
      if (!mesh_.is_fixed(v) || mesh_.is_frozen(v) || is_on_line(v)) continue;
      if (const auto at = seen(mesh_.point(v)))
        path.circle(viewport_.grid(*at), viewport_.steps(kDotRadius * viewport_.em));
    }
    panel_.fixed = !path.empty();
    stroke(path, "halo", "#ffffff", 2 * kRingWidth * viewport_.em);
    fill(path, "fixed", Palette::outline);
  }
  [[nodiscard]] bool is_on_line(VertexId v) const {
    if (mesh_.is_isolated(v) || mesh_.is_boundary(v)) return true;
    for (const HalfedgeId h : mesh_.star(v)) {
      if (mesh_.is_constrained(h)) return true;
    }
    return false;
  }

  /// Fades what repeats the domain, and marks the lines at which a period begins again.
  void draw_periods() {
    if (!mesh_.space().is_periodic()) return;
    PathText path;
    const auto [x, y] = mesh_.space().period();
    const Box& box = viewport_.clip;
    const Box domain = {{x > 0 ? 0 : box.low.x, y > 0 ? 0 : box.low.y},
                        {x > 0 ? x : box.high.x, y > 0 ? y : box.high.y}};
    const auto line = [&](Vec2 a, Vec2 b) { path.segment(viewport_.grid(a), viewport_.grid(b)); };
    for (const double at : {domain.low.x, domain.high.x}) {
      if (x > 0) line({at, domain.low.y}, {at, domain.high.y});
    }
    for (const double at : {domain.low.y, domain.high.y}) {
      if (y > 0) line({domain.low.x, at}, {domain.high.x, at});
    }
    PathText beyond;
    for (const Box& b : {box, domain}) {
      beyond.move_to(viewport_.grid(b.low));
      beyond.line_to(viewport_.grid({b.high.x, b.low.y}));
      beyond.line_to(viewport_.grid(b.high));
      beyond.line_to(viewport_.grid({b.low.x, b.high.y}));
      beyond.close();
    }
    panel_.svg += "<path class=\"beyond\" fill=\"#ffffff\" fill-opacity=\"0.65\" fill-rule=\"evenodd\" d=\"" +
                  beyond.text() + "\"/>\n";
    const double width = kPeriodWidth * viewport_.em;
    stroke(path, "period", Palette::outline, width, dashes(width).c_str());
  }

  void ring_near_coincident() {
    PathText path;
    for (HalfedgeId h : mesh_.halfedges()) {
      if (!mesh_.is_edge_representative(h) || !nearly_collapsed(h)) continue;
      const WeightedPoint a = mesh_.point(mesh_.origin(h)), b = mesh_.point(mesh_.target(h), a);
      if (const auto middle = seen({0.5 * (a.x + b.x), 0.5 * (a.y + b.y), 0.5 * (a.w + b.w)})) {
        path.circle(viewport_.grid(*middle), viewport_.steps(kRingRadius * viewport_.em));
      }
    }
    panel_.rings = !path.empty();
    stroke(path, "near-coincident", Palette::warning, kRingWidth * viewport_.em);
  }

  [[nodiscard]] bool nearly_collapsed(HalfedgeId h) const {
    double around = 0;
    int edges = 0;
    for (HalfedgeId side : {h, mesh_.twin(h)}) {
      if (!side.valid()) continue;
      for (HalfedgeId other : {Mesh::next(side), Mesh::prev(side)}) {
        around += edge_length(mesh_, other);
        ++edges;
      }
    }
    return edge_length(mesh_, h) * edges < kNearCoincident * around;
  }

  void number_vertices() {
    const double size = std::clamp(kFontPerEdge * viewport_.edge, kLeastFont, viewport_.em) / viewport_.unit;
    panel_.svg += "<g class=\"numbers\" font-size=\"" + short_number(size) + "\" fill=\"#000000\" stroke=\"#ffffff\"" +
                  " stroke-width=\"" + short_number(size / 4) + "\" paint-order=\"stroke\">\n";
    for (VertexId v : mesh_.vertices()) {
      const auto place = seen(mesh_.point(v));
      if (!place) continue;
      const GridPoint at = viewport_.grid(*place);
      panel_.svg += "<text x=\"" + std::to_string(at.x + std::llround(size / 4)) + "\" y=\"" +
                    std::to_string(at.y - std::llround(size / 4)) + "\">" + std::to_string(v.index) + "</text>\n";
    }
    panel_.svg += "</g>\n";
  }

  const Mesh& mesh_;
};

}  // namespace

Panel draw_marks(const Mesh& mesh, const Viewport& viewport, const DrawOptions& options) {
  return MarkPainter(mesh, viewport, options).paint();
}

}  // namespace temper

#include "draw/panel.hpp"

#include <algorithm>
#include <cmath>

#include "draw/face_lines.hpp"
#include "draw/marks.hpp"
#include "draw/painter.hpp"
#include "draw/text.hpp"
#include "draw/viewport.hpp"
#include "geometry/surface.hpp"
#include "quality/measure.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

constexpr double kDualTimes = 2.2, kNegativeTimes = 3.5;
constexpr double kHatchPeriod = 0.25, kLeastHatch = 0.15, kMostHatch = 0.36;  // of an edge; of the font size

/// The shifts from the mesh to its images that a picture of the domain and its margin shows.
std::vector<Vec2> shifts_of(const Space& space) {
  const auto [x, y] = space.period();
  std::vector<Vec2> shifts = {{0, 0}};
  for (const double dx : {0.0, -x, x}) {
    for (const double dy : {0.0, -y, y}) {
      const Vec2 shift = {dx, dy};
      if (std::find(shifts.begin(), shifts.end(), shift) == shifts.end()) shifts.push_back(shift);
    }
  }
  return shifts;
}

/// The duals of a mesh: its own, or those of its pieces in the planes of tensors, as points of the mesh's space.
class DualPlaces {
 public:
  DualPlaces(const Mesh& mesh, const MetricMesh* pieces)
      : pieces_(pieces), measured_(pieces != nullptr ? pieces->mesh : mesh) {}

  /// The mesh in whose planes duals are perpendicular to edges.
  [[nodiscard]] const Mesh& measured() const { return measured_; }
  [[nodiscard]] bool is_negative(HalfedgeId h) const {
    if (!measured_.is_boundary(h)) return !is_regular(measured_, h);
    return measure_triangle(measured_, Mesh::triangle(h)).h_sign[h.index % 3] == Sign::negative;
  }
  [[nodiscard]] WeightedPoint center(TriangleId t) const {
    const auto [a, b, c] = measured_.points(t);
    return in_plane(t, orthocenter(measured_.space(), a, b, c));
  }
  [[nodiscard]] WeightedPoint weighted_midpoint(HalfedgeId h) const {
    const WeightedPoint a = measured_.point(measured_.origin(h)), b = measured_.point(measured_.target(h), a);
    return in_plane(Mesh::triangle(h), temper::weighted_midpoint(measured_.space(), a, b));
  }

 private:
  [[nodiscard]] WeightedPoint in_plane(TriangleId t, const WeightedPoint& p) const {
    if (pieces_ == nullptr) return p;
    const Vec2 at = pieces_->metric(t).from_metric(p.position());
    return {at.x, at.y, p.w};
  }

  const MetricMesh* pieces_;
  const Mesh& measured_;
};

class PanelPainter : public Painter {
 public:
  PanelPainter(const Mesh& mesh, const Viewport& viewport, const DrawOptions& options, std::size_t number)
      : Painter(viewport, options),
        mesh_(mesh),
        duals_(mesh, options.pieces.empty() ? nullptr : &options.pieces[number]),
        number_(number),
        shifts_(shifts_of(mesh.space())) {}

  Panel paint() {
    panel_.elements = mesh_.n_triangles();
    draw_globe();
    fill_triangles();
    if (options_.cells) fill_cells();
    if (options_.primal) draw_edges();
    draw_face_lines();
    if (options_.dual && detailed_) draw_dual();
    if (options_.weights && detailed_ && options_.pieces.empty()) draw_weights();
    add_marks();
    return std::move(panel_);
  }

 private:
  void add_line(PathText& path, const WeightedPoint& p, const WeightedPoint& q) const {
    const std::vector<Vec2> line = viewport_.view.line(p, q);
    for (const Vec2 shift : shifts_) {
      for (std::size_t i = 1; i < line.size(); ++i) add_segment(path, {shift + line[i - 1], shift + line[i]});
    }
  }
  /// Draws the images that meet the box.
  void add_circle(PathText& path, const WeightedPoint& p, double radius) const {
    for (const Vec2 shift : shifts_) {
      if (!viewport_.view.is_flat() || !meets(shift + p.position(), radius, viewport_.box)) continue;
      path.circle(viewport_.grid(shift + p.position()), viewport_.steps(radius * viewport_.scale));
    }
    if (viewport_.view.is_flat() || !seen(p, radius)) return;
    const std::vector<WeightedPoint> around = viewport_.view.circle(p, radius);
    for (std::size_t i = 0; i < around.size(); ++i) add_line(path, around[i], around[(i + 1) % around.size()]);
  }
  void add_triangle(PathText& path, TriangleId t) const {
    const std::vector<Vec2> whole = viewport_.view.polygon(mesh_.points(t));
    for (const Vec2 shift : shifts_) {
      std::vector<Vec2> polygon = whole;
      for (Vec2& p : polygon) p = shift + p;
      add_polygon(path, std::move(polygon));
    }
  }

  void fill_triangles() {
    const ColorScale scale = options_.colors ? scale_of(*options_.colors) : kMargins;
    Fills fills;
    for (TriangleId t : mesh_.triangles()) {
      const TriangleMeasure measure = measure_triangle(duals_.measured(), t);
      const bool good = measure.well_centered();
      panel_.bad += good ? 0 : 1;
      if (options_.cells || (!options_.colors && !options_.fill)) continue;
      const double value = options_.colors ? options_.colors->values[number_][t] : measure.margin();
      if (!options_.colors && !good) {
        add_triangle(fills.bad, t);
      } else if (!std::isnan(value)) {
        add_triangle(fills.colors[scale.color(value)], t);
      }
    }
    fill(fills);
  }

  void fill_cells() {
    const CellPolygons& cells = options_.cells->panels[number_];
    const std::vector<std::int32_t> regions = regions_of(*options_.cells);
    std::array<PathText, kRegionColors.size()> paths;
    for (std::size_t p = 0; p < cells.n_polygons(); ++p) {
      const auto region = std::ranges::lower_bound(regions, cells.regions[cells.cells[p]]);
      PathText& path = paths[static_cast<std::size_t>(region - regions.begin()) % paths.size()];
      for (const Vec2 shift : shifts_) {
        std::vector<Vec2> polygon;
        for (const std::uint32_t corner : cells.polygon(p)) polygon.push_back(shift + cells.points[corner]);
        add_polygon(path, std::move(polygon));
      }
    }
    for (std::size_t i = 0; i < paths.size(); ++i) fill(paths[i], "region", kRegionColors[i]);
  }

  void draw_globe() {
    if (viewport_.view.is_flat()) return;
    PathText path;
    path.circle(viewport_.grid({0, 0}), viewport_.steps(viewport_.view.radius() * viewport_.scale));
    fill(path, "limb", Palette::outside);
  }

  void draw_edges() {
    PathText plain, kept;
    for (HalfedgeId h : mesh_.halfedges()) {
      if (!mesh_.is_edge_representative(h)) continue;
      const bool outline = mesh_.is_unflippable(h) && !is_beside_face(mesh_, h);
      if (!outline && (options_.cells || !viewport_.shows_edges())) continue;
      const WeightedPoint from = mesh_.point(mesh_.origin(h));
      add_line(outline ? kept : plain, from, mesh_.point(mesh_.target(h), from));
    }
    stroke_edges(plain, kept);
  }

  void draw_face_lines() {
    if (!options_.cells || number_ >= options_.cells->lines.size()) return;
    const Panel lines = draw_lines(options_.cells->lines[number_], viewport_, options_);
    panel_.svg += lines.svg;
    panel_.faces = lines.faces;
  }

  void add_marks() {
    const Panel marks = draw_marks(mesh_, viewport_, options_);
    panel_.svg += marks.svg;
    panel_.fixed = marks.fixed;
    panel_.rings = marks.rings;
  }

  // Dual edges run between the orthocenters on both sides, or from an orthocenter to the weighted midpoint of an edge
  // of the boundary, or of an interface between tensors.
  void draw_dual() {
    IdVector<TriangleId, WeightedPoint> centers(mesh_.n_triangles());
    for (TriangleId t : mesh_.triangles()) centers[t] = duals_.center(t);
    PathText positive, negative;
    for (HalfedgeId h : mesh_.halfedges()) {
      if (!duals_.measured().is_edge_representative(h)) continue;
      const TriangleId here = Mesh::triangle(h), there = Mesh::triangle(mesh_.twin(h));
      const WeightedPoint near = mesh_.point(mesh_.origin(h));
      add_line(duals_.is_negative(h) ? negative : positive, beside(near, here, centers[here]),
               duals_.measured().is_boundary(h) ? duals_.weighted_midpoint(h) : beside(near, there, centers[there]));
    }
    panel_.dual = !positive.empty();
    panel_.negative_dual = !negative.empty();
    stroke(positive, "dual", Palette::dual, kDualTimes * primal_width());
    const double width = kNegativeTimes * primal_width();
    stroke(negative, "halo", "#ffffff", 2 * width);
    stroke(negative, "dual-negative", Palette::warning, width, dashes(width / 2).c_str());
  }

  /// The center of a triangle: the image with a corner near a point.
  [[nodiscard]] WeightedPoint beside(const WeightedPoint& near, TriangleId t, const WeightedPoint& center) const {
    if (!mesh_.space().is_periodic()) return center;
    const WeightedPoint corner = mesh_.point(mesh_.corners(t)[0]), image = mesh_.space().image(corner, near);
    return {center.x + (image.x - corner.x), center.y + (image.y - corner.y), center.w};
  }
  void draw_weights() {
    PathText positive, negative;
    for (VertexId v : mesh_.vertices()) {
      const double radius = std::sqrt(std::abs(mesh_.weight(v))) * options_.weight_scale;
      if (radius == 0 || !std::isfinite(radius)) continue;
      add_circle(mesh_.weight(v) > 0 ? positive : negative, mesh_.point(v), radius);
    }
    panel_.positive = !positive.empty();
    panel_.negative = !negative.empty();
    const double width = 1.5 * primal_width();
    stroke(positive, "weight-positive", Palette::positive, width);
    stroke(negative, "weight-negative", Palette::negative, width, dashes(width).c_str());
  }

  const Mesh& mesh_;
  DualPlaces duals_;
  std::size_t number_;
  std::vector<Vec2> shifts_;
};

class SectionPainter : public Painter {
 public:
  using Painter::Painter;

  Panel paint(const Section& section) {
    Fills fills;
    PathText plain, kept;
    for (const Section::Piece& piece : section.pieces) {
      const bool is_polygon = piece.corners.size() > 2;
      panel_.elements += is_polygon;
      panel_.bad += is_polygon && piece.bad;
      if (options_.fill && is_polygon)
        add_polygon(piece.bad ? fills.bad : fills.colors[section.scale.color(piece.margin)], piece.corners);
      for (std::size_t i = 0; i < piece.corners.size(); ++i) {
        const Segment side = {piece.corners[i], piece.corners[(i + 1) % piece.corners.size()]};
        if (piece.sides[i] == Section::Side::kept) add_segment(kept, side);
        if (piece.sides[i] == Section::Side::plain && viewport_.shows_edges()) add_segment(plain, side);
      }
    }
    fill(fills);
    if (options_.primal) stroke_edges(plain, kept);
    return std::move(panel_);
  }
};

}  // namespace

ColorScale scale_of(const TriangleColors& colors) {
  ColorScale scale;
  scale.reversed = colors.better == Preference::less;
  for (const auto& values : colors.values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      scale.low = std::min(scale.low, value);
      scale.high = std::max(scale.high, value);
    }
  }
  return scale;
}

std::vector<std::int32_t> regions_of(const RegionCells& cells) {
  std::vector<std::int32_t> regions;
  for (const CellPolygons& panel : cells.panels)
    regions.insert(regions.end(), panel.regions.begin(), panel.regions.end());
  std::ranges::sort(regions);
  regions.erase(std::unique(regions.begin(), regions.end()), regions.end());
  return regions;
}

std::size_t ColorScale::color(double value) const {
  constexpr std::size_t kLast = kScaleColors.size() - 1;
  std::size_t color = 0;
  if (value >= high && value > low) {
    color = kLast;
  } else if (value > low) {
    const double at = (value - low) / (high - low) * static_cast<double>(kScaleColors.size());
    color = std::min(static_cast<std::size_t>(at), kLast);
  }
  return reversed ? kLast - color : color;
}

namespace {

constexpr double kPattern = 4;  // its units for a stripe and a gap

double hatch_scale(const Viewport& viewport, double per_pixel) {
  const double em = viewport.em, period = std::clamp(kHatchPeriod * viewport.edge, kLeastHatch * em, kMostHatch * em);
  return period / kPattern * per_pixel;
}
// The id tells the scale: a page may have pictures of several.
std::string hatch_id(const Viewport& viewport, double per_pixel) {
  return "bad-" + short_number(hatch_scale(viewport, per_pixel));
}

}  // namespace

std::string hatching(const Viewport& viewport, double per_pixel) {
  return "<pattern id=\"" + hatch_id(viewport, per_pixel) +
         "\" width=\"4\" height=\"4\" patternUnits=\"userSpaceOnUse\" patternTransform=\"scale(" +
         short_number(hatch_scale(viewport, per_pixel)) +
         ") rotate(45)\"><rect width=\"4\" height=\"4\" fill=\"#ffffff\"/><rect width=\"2\" height=\"4\" fill=\"" +
         Palette::warning + "\"/></pattern>\n";
}

std::string hatched(const Viewport& viewport, double per_pixel) {
  return "url(#" + hatch_id(viewport, per_pixel) + ")";
}

namespace {

/// Clips a panel to its rectangle, which `framed` draws.
Panel framed_panel(Panel panel, const Viewport& viewport, bool framed, const std::string& id) {
  const std::string size =
      "width=\"" + short_number(viewport.width) + "\" height=\"" + short_number(viewport.height) + "\"";
  panel.svg = "<clipPath id=\"" + id + "\"><rect " + size + "/></clipPath>\n<g clip-path=\"url(#" + id +
              ")\">\n<g transform=\"scale(" + short_number(viewport.unit) + ")\" stroke-linejoin=\"round\">\n" +
              panel.svg + "</g>\n</g>\n";
  if (framed) panel.svg += "<rect " + size + " fill=\"none\" stroke=\"" + Palette::frame + "\"/>\n";
  return panel;
}

}  // namespace

Panel draw_panel(const Mesh& mesh, const Viewport& viewport, const DrawOptions& options, std::size_t number,
                 const std::string& id) {
  const bool framed = options.zoom.has_value() || mesh.space().is_periodic();
  return framed_panel(PanelPainter(mesh, viewport, options, number).paint(), viewport, framed, id);
}

Panel draw_panel(const Section& section, const Viewport& viewport, const DrawOptions& options, const std::string& id) {
  return framed_panel(SectionPainter(viewport, options).paint(section), viewport, options.zoom.has_value(), id);
}

}  // namespace temper

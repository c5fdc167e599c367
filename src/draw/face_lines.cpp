#include "draw/face_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "draw/painter.hpp"

namespace temper {
namespace {

class FaceLinePainter : public Painter {
 public:
  using Painter::Painter;

  Panel paint(const std::vector<FaceLine>& lines) {
    constexpr double kFaceWidth = 0.22;  // of the font size
    PathText path;
    std::string names;
    for (const FaceLine& line : lines) {
      for (const auto& [from, to] : line.pieces) add_segment(path, {from, to});
      const auto at = place_of_name(line);
      if (!at) continue;
      names += "<text x=\"" + std::to_string(at->x) + "\" y=\"" + std::to_string(at->y) + "\">" + xml_text(line.name) +
               "</text>\n";
    }
    panel_.faces = !path.empty();
    stroke(path, "face", Palette::outline, kFaceWidth * viewport_.em, "stroke-linecap=\"round\" ");
    if (names.empty()) return std::move(panel_);
    const double size = viewport_.em / viewport_.unit;
    panel_.svg += std::string("<g class=\"names\" text-anchor=\"middle\" font-size=\"") + short_number(size) +
                  "\" fill=\"" + Palette::outline + "\" stroke=\"#ffffff\" stroke-width=\"" + short_number(size / 4) +
                  "\" paint-order=\"stroke\">\n" + names + "</g>\n";
    return std::move(panel_);
  }

 private:
  /// The middle of the name: above the middle piece that the picture shows, and inside the panel.
  [[nodiscard]] std::optional<GridPoint> place_of_name(const FaceLine& line) const {
    constexpr double kAbove = 0.5;  // of the font size
    std::vector<Vec2> middles;
    for (const auto& [from, to] : line.pieces) {
      const Vec2 middle = 0.5 * (from + to);
      if (meets(middle, 0, viewport_.box)) middles.push_back(middle);
    }
    if (line.name.empty() || middles.empty()) return std::nullopt;
    GridPoint at = viewport_.grid(middles[middles.size() / 2]);
    const double half = 0.5 * text_width(line.name, viewport_.em), most = std::max(half, viewport_.width - half);
    at.x = std::llround(std::clamp(static_cast<double>(at.x) * viewport_.unit, half, most) / viewport_.unit);
    at.y -= std::llround(kAbove * viewport_.em / viewport_.unit);
    return at;
  }
};

/// Says whether a triangle is in the polygon around an end of a face.
bool is_in_polygon(const Mesh& mesh, TriangleId t) {
  return std::ranges::any_of(std::array{0, 1, 2}, [&](int k) {
    const HalfedgeId side = Mesh::halfedge(t, k);
    return mesh.is_face(side) || mesh.is_joint(side);
  });
}

}  // namespace

Panel draw_lines(const std::vector<FaceLine>& lines, const Viewport& viewport, const DrawOptions& options) {
  return FaceLinePainter(viewport, options).paint(lines);
}

bool is_beside_face(const Mesh& mesh, HalfedgeId h) {
  if (mesh.is_boundary(h)) return false;
  if (mesh.is_face(h) || mesh.is_joint(h)) return true;
  return mesh.is_frozen(mesh.origin(h)) && mesh.is_frozen(mesh.target(h)) &&
         is_in_polygon(mesh, Mesh::triangle(h)) != is_in_polygon(mesh, Mesh::triangle(mesh.twin(h)));
}

}  // namespace temper

// Pictures of surfaces: the triangles in view, projected along the direction of view.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "draw/section.hpp"
#include "temper/surfaces.hpp"

namespace temper::surfaces {
namespace {

constexpr Vec2 kUsualView = {-60, 30};
constexpr ColorScale kSurfaceMargins = {0, 0.3};  // an equilateral triangle without weights has 0.289

/// Coordinates of the picture: to the right, up, and towards the viewer.
class View {
 public:
  explicit View(Vec2 lon_lat) {
    const double lon = lon_lat.x * (std::numbers::pi / 180), lat = lon_lat.y * (std::numbers::pi / 180);
    right_ = {-std::sin(lon), std::cos(lon), 0};
    towards_ = {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
    up_ = cross(towards_, right_);
  }
  [[nodiscard]] Vec3 at(Vec3 p) const { return {dot(p, right_), dot(p, up_), dot(p, towards_)}; }

 private:
  Vec3 right_, up_, towards_;
};

using Projected = std::array<Vec3, 3>;

Vec2 flat(Vec3 p) { return {p.x, p.y}; }

/// The triangles of a picture in the cells of a grid, to find those that hide a point.
class Hiders {
 public:
  explicit Hiders(const std::vector<Projected>& triangles) : triangles_(triangles) {
    low_ = high_ = flat(triangles[0][0]);
    for (const Projected& t : triangles) {
      for (const Vec3 p : t) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
      }
    }
    n_ = 1 + static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles.size())));
    cells_.resize(n_ * n_);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const auto& [p, q, r] = triangles[i];
      const auto [left, right] = std::minmax({p.x, q.x, r.x});
      const auto [bottom, top] = std::minmax({p.y, q.y, r.y});
      for (std::size_t row = row_of(bottom); row <= row_of(top); ++row) {
        for (std::size_t column = column_of(left); column <= column_of(right); ++column)
          cells_[row * n_ + column].push_back(i);
      }
    }
  }

  /// Says whether another triangle is in front of the centroid of triangle i.
  [[nodiscard]] bool hides(std::size_t i) const {
    const Vec3 p = (1.0 / 3) * (triangles_[i][0] + triangles_[i][1] + triangles_[i][2]);
    return std::ranges::any_of(cells_[row_of(p.y) * n_ + column_of(p.x)],
                               [&](std::size_t j) { return j != i && is_in_front(triangles_[j], p); });
  }

 private:
  [[nodiscard]] std::size_t cell_of(double at, double low, double high) const {
    if (!(high > low)) return 0;
    return std::min(n_ - 1, static_cast<std::size_t>((at - low) / (high - low) * static_cast<double>(n_)));
  }
  [[nodiscard]] std::size_t column_of(double x) const { return cell_of(x, low_.x, high_.x); }
  [[nodiscard]] std::size_t row_of(double y) const { return cell_of(y, low_.y, high_.y); }
  static bool is_in_front(const Projected& t, Vec3 p) {
    const auto share = [&](Vec3 a, Vec3 b) { return cross(flat(a) - flat(p), flat(b) - flat(p)); };
    const double r = share(t[0], t[1]), s = share(t[1], t[2]), q = share(t[2], t[0]), sum = r + s + q;
    if (sum == 0 || r / sum <= 0 || s / sum <= 0 || q / sum <= 0) return false;
    return (r * t[2].z + s * t[0].z + q * t[1].z) / sum > p.z;
  }

  const std::vector<Projected>& triangles_;
  Vec2 low_, high_;
  std::size_t n_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

Section section_of(const SurfaceMesh& mesh, const DrawOptions& options) {
  const View view(options.view.value_or(kUsualView));
  std::vector<Projected> all;
  for (const TriangleId t : mesh.triangles()) {
    const auto [p, q, r] = mesh.points(t);
    all.push_back({view.at(p.position()), view.at(q.position()), view.at(r.position())});
  }
  Section section;
  section.scale = kSurfaceMargins;
  section.element = "triangle";
  section.where = "triangles in view bad";
  if (all.empty()) return section;
  const Hiders hiders(all);
  IdVector<TriangleId, std::uint8_t> shown;
  for (std::size_t i = 0; i < all.size(); ++i) shown.push_back(hiders.hides(i) ? 0 : 1);
  const Mesh& connectivity = mesh.connectivity();
  for (const TriangleId t : mesh.triangles()) {
    if (shown[t] == 0) continue;
    const TriangleQuality measured = triangle_quality(mesh, t);
    Section::Piece piece;
    piece.margin = std::min(measured.min_h_over_l, measured.min_d_over_l);
    piece.bad = !measured.well_centered;
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(t, k), other = connectivity.twin(h);
      const bool is_first =
          !other.valid() || connectivity.is_edge_representative(h) || shown[Mesh::triangle(other)] == 0;
      piece.corners.push_back(flat(all[t.index][static_cast<std::size_t>(k)]));
      piece.sides.push_back(!is_first                        ? Section::Side::none
                            : connectivity.is_unflippable(h) ? Section::Side::kept
                                                             : Section::Side::plain);
    }
    section.pieces.push_back(std::move(piece));
  }
  return section;
}

}  // namespace

std::string draw_svg(const SurfaceMesh& mesh, const DrawOptions& options) {
  const std::array<Section, 1> sections = {section_of(mesh, options)};
  return draw_sections_svg(sections, options);
}

std::string draw_before_after_svg(const SurfaceMesh& before, const SurfaceMesh& after, const DrawOptions& options) {
  std::array<Section, 2> sections = {section_of(before, options), section_of(after, options)};
  sections[0].name = "before";
  sections[1].name = "after";
  return draw_sections_svg(sections, options);
}

}  // namespace temper::surfaces

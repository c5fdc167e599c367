// See document.hpp.
#include "io/formats/document.hpp"

#include <cmath>

#include "io/conversion/globe.hpp"
#include "io/formats/format.hpp"

namespace temper::io {

Document new_document(const std::string& path) { return {MeshFile{}, std::make_shared<FileNames>(path)}; }

namespace {

void check_range(const Document& d, std::int32_t point, const std::string& element, const std::string& where) {
  const auto n = d.file.points.size();
  if (point >= 0 && static_cast<std::size_t>(point) < n) return;
  fail(ErrorCode::index_out_of_range, where,
       text(element, " uses vertex ", d.names->points[point], ", but the file has ", n, " vertices, numbered from ",
            d.names->points[0]));
}

void check_ranges(const Document& d) {
  const MeshFile& f = d.file;
  const auto outside = [n = f.points.size()](std::int32_t p) { return p < 0 || static_cast<std::size_t>(p) >= n; };
  for (std::size_t t = 0; t < f.triangles.size(); ++t) {
    for (const std::int32_t p : f.triangles[t]) {
      if (outside(p)) check_range(d, p, d.names->triangle(t), d.names->triangle_where(t));
    }
  }
  for (std::size_t l = 0; l < f.lines.size(); ++l) {
    for (const std::int32_t p : f.lines[l]) {
      if (outside(p)) check_range(d, p, d.names->line(l), d.names->line_where(l));
    }
  }
  for (const std::int32_t p : f.marked_points) {
    if (outside(p)) check_range(d, p, "a marked point", d.names->path);
  }
}

/// Points on one parallel of a sphere are in a plane, too: nothing in the file settles which is meant.
void warn_of_parallel(Document& d) {
  std::vector<Vec3> places;
  for (const Vec2 p : d.file.points) places.push_back({p.x, p.y, d.z});
  const auto radius = common_radius(places);
  if (!radius) return;
  d.file.warnings.push_back(text(d.names->path, ": all points have z = ", d.z, " and are ", *radius,
                                 " from the origin: taken for a mesh in a plane, though they are also on one parallel "
                                 "of a sphere"));
}

}  // namespace

void check(Document& d) {
  const MeshFile& f = d.file;
  if (f.points.empty()) fail(ErrorCode::empty_input, d.names->path, "the file has no points");
  if (f.triangles.empty()) {
    // Other programs call JIGSAW's outlines meshes, too.
    const bool outline = f.format == "jigsaw" && !f.lines.empty();
    fail(ErrorCode::empty_input, d.names->path,
         text("the file has no triangles", outline ? ": it is an outline, for `temper mesh` to mesh" : ""));
  }
  check_ranges(d);
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const Vec2 p = f.points[i];
    if (std::isfinite(p.x) && std::isfinite(p.y)) continue;
    fail(ErrorCode::not_finite, d.names->point_where(i),
         text(d.names->point(i), " has coordinates (", p.x, ", ", p.y, "), expected finite numbers"));
  }
  if (!std::isfinite(d.z))
    fail(ErrorCode::not_finite, d.names->point_where(0), text(d.names->point(0), " has z = ", d.z));
  d.file.set_z(d.z);
  if (!d.heights.empty()) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < f.points.size(); ++i) places.push_back({f.points[i].x, f.points[i].y, d.heights[i]});
    const bool is_periodic = f.periodic() != nullptr;
    settle_points(d.file, std::move(places), *d.names);
    if (is_periodic && f.sphere() != nullptr)
      fail(ErrorCode::unsupported, d.names->path, "has periods and points on a sphere; expected points of a plane");
  } else if (d.z != 0 && f.sphere() == nullptr) {
    warn_of_parallel(d);
  }
  for (std::size_t i = 0; i < f.weights.size(); ++i) {
    if (std::isfinite(f.weights[i])) continue;
    fail(ErrorCode::not_finite, d.names->point_where(i),
         text(d.names->point(i), " has weight ", f.weights[i], ", expected a finite number"));
  }
}

void refuse_element(const std::string& where, std::int64_t number, std::string_view kind) {
  fail(ErrorCode::unsupported, where,
       text("element ", number, kind.starts_with('e') ? " is an " : " is a ", kind,
            "; temper reads meshes of linear triangles, with lines and points as tags"));
}

}  // namespace temper::io

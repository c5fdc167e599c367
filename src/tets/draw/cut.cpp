#include "tets/draw/cut.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>

#include "base/text.hpp"
#include "geometry/bounding_boxes.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets {
namespace {

constexpr ColorScale kTetMargins = {0, 0.2};  // a regular tetrahedron without weights has 0.204
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr std::array<std::array<int, 2>, 3> kPicture = {{{1, 2}, {0, 2}, {0, 1}}};  // to the right and up

double along(Vec3 p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Corner indices of a tetrahedron: an edge from a corner below the plane to one that is not.
struct Crossing {
  std::size_t below, other;
};

/// The corner of a tetrahedron that two of its edges do not have, if they share an end.
std::size_t missing(const Crossing& a, const Crossing& b) {
  std::array<bool, 4> has = {};
  for (const std::size_t corner : {a.below, a.other, b.below, b.other}) has[corner] = true;
  return static_cast<std::size_t>(std::find(has.begin(), has.end(), false) - has.begin());
}

class Cutter {
 public:
  Cutter(const TetMesh& mesh, const Plane& plane) : mesh_(mesh), plane_(plane) {}

  /// The polygon of a tetrahedron, without corners if the plane misses it.
  [[nodiscard]] CutTet polygon(TetId t) const {
    CutTet result;
    result.tetrahedron = t;
    const std::vector<Crossing> crossings = crossings_of(t);
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const Crossing &here = crossings[i], &next = crossings[(i + 1) % crossings.size()];
      if (same_vertex_on_plane(t, here, next)) continue;
      result.corners.push_back(place(t, here));
      result.faces.push_back(TetMesh::halfface(t, static_cast<int>(missing(here, next))));
    }
    if (result.corners.size() < 2) result.corners.clear();
    return result;
  }

 private:
  [[nodiscard]] double height(TetId t, std::size_t corner) const {
    return along(mesh_.position(mesh_.corners(t)[corner]), plane_.axis);
  }
  [[nodiscard]] std::vector<Crossing> crossings_of(TetId t) const {
    std::vector<std::size_t> below, others;
    for (std::size_t k = 0; k < 4; ++k) (height(t, k) < plane_.at ? below : others).push_back(k);
    std::vector<Crossing> crossings;
    for (const std::size_t b : below) {
      for (const std::size_t o : others) crossings.push_back({b, o});
      std::reverse(others.begin(), others.end());
    }
    return crossings;
  }
  /// Says whether both edges end in the same vertex on the plane: the side between them has no length.
  [[nodiscard]] bool same_vertex_on_plane(TetId t, const Crossing& a, const Crossing& b) const {
    return a.other == b.other && height(t, a.other) == plane_.at;
  }
  [[nodiscard]] Vec2 place(TetId t, const Crossing& c) const {
    const Vec3 p = mesh_.position(mesh_.corners(t)[c.below]), q = mesh_.position(mesh_.corners(t)[c.other]);
    const double part = (plane_.at - height(t, c.below)) / (height(t, c.other) - height(t, c.below));
    const auto [right, up] = kPicture[static_cast<std::size_t>(plane_.axis)];
    const Vec3 at = (1 - part) * p + part * q;
    return {along(at, right), along(at, up)};
  }

  const TetMesh& mesh_;
  const Plane& plane_;
};

}  // namespace

std::vector<CutTet> cut(const TetMesh& mesh, const Plane& plane) {
  const Cutter cutter(mesh, plane);
  std::vector<CutTet> pieces;
  for (const TetId t : mesh.tetrahedra()) {
    CutTet piece = cutter.polygon(t);
    if (!piece.corners.empty()) pieces.push_back(std::move(piece));
  }
  return pieces;
}

Section section_of(const TetMesh& mesh, const Plane& plane, const TetMesh& measured) {
  const std::vector<CutTet> pieces = cut(mesh, plane);
  Section section;
  section.scale = kTetMargins;
  section.element = "tetrahedron";
  std::array<char, 32> at;
  std::snprintf(at.data(), at.size(), "%.6g", plane.at);
  section.where = std::string("tetrahedra bad at ") + kAxes[static_cast<std::size_t>(plane.axis)] + " = " + at.data();
  section.pieces.reserve(pieces.size());
  for (const CutTet& piece : pieces) {
    const TetMeasure measure = measure_tetrahedron(measured.points(piece.tetrahedron));
    std::vector<Section::Side> sides;
    for (const HalffaceId h : piece.faces) {
      sides.push_back(!mesh.is_face_representative(h) ? Section::Side::none
                      : mesh.bounds_region(h)         ? Section::Side::kept
                                                      : Section::Side::plain);
    }
    section.pieces.push_back({piece.corners, std::move(sides), measure.margin(), !measure.orthocenter_inside()});
  }
  return section;
}

Plane middle_plane(const TetMesh& mesh, int axis) {
  const BoundingBox box = bounding_box(mesh);
  return {axis, 0.5 * (along(box.low, axis) + along(box.high, axis))};
}

Plane middle_plane(const TetMesh& mesh) {
  const BoundingBox box = bounding_box(mesh);
  int shortest = 2;
  for (const int axis : {1, 0}) {
    if (along(box.high - box.low, axis) < along(box.high - box.low, shortest)) shortest = axis;
  }
  return middle_plane(mesh, shortest);
}

Expected<Plane> plane_through(const TetMesh& mesh, int axis, double at) {
  const BoundingBox box = bounding_box(mesh);
  const double low = along(box.low, axis), high = along(box.high, axis);
  if (low < at && at <= high) return Plane{axis, at};
  const std::string name = kAxes[static_cast<std::size_t>(axis)];
  return InputError{ErrorCode::invalid_option, "",
                    "the plane " + name + "=" + to_text(at) + " misses the mesh, which has " + name + " from " +
                        rounded(low, 9) + " to " + rounded(high, 9) + ". Next: " + name + "=" +
                        rounded(middle_plane(mesh, axis).at, 9)};
}

std::string draw_svg(const TetMesh& mesh, const Plane& plane, const DrawOptions& options,
                     std::span<const MetricMesh> pieces) {
  const std::array<Section, 1> sections = {section_of(mesh, plane, pieces.empty() ? mesh : pieces[0].mesh)};
  return draw_sections_svg(sections, options);
}

std::string draw_before_after_svg(const TetMesh& before, const TetMesh& after, const Plane& plane,
                                  const DrawOptions& options, std::span<const MetricMesh> pieces) {
  std::array<Section, 2> sections = {section_of(before, plane, pieces.empty() ? before : pieces[0].mesh),
                                     section_of(after, plane, pieces.empty() ? after : pieces[1].mesh)};
  sections[0].name = "before";
  sections[1].name = "after";
  return draw_sections_svg(sections, options);
}

}  // namespace temper::tets

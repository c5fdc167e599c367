// In the constrained Delaunay triangulation of the divided outline alone every edge inside spans a gap, and every
// triangle on a piece measures the distance to what is across. Neighbours along the outline are no gap, unless their
// corner is sharp.
#include "mesher/narrow.hpp"

#include <algorithm>
#include <cmath>

namespace temper::mesher {
namespace {

// Two rows of equilateral triangles across a gap have edges of 0.577 of it.
constexpr double kOfGap = 0.6;
// A size that is less than this part of the present one is new.
constexpr double kLess = 0.9;

class Narrow {
 public:
  Narrow(const DividedOutline& divided, const Triangulated& triangulated, const GradedSize& size)
      : divided_(divided), mesh_(triangulated.mesh), triangulated_(triangulated), size_(size) {
    around_.resize(divided.points.size());
    for (const Piece& p : divided.pieces) {
      around_[p.ends[0]].push_back(p.ends[1]);
      around_[p.ends[1]].push_back(p.ends[0]);
    }
  }

  std::vector<SizeSource> run(Deadline& deadline) {
    for (const HalfedgeId h : mesh_.halfedges()) {
      if (deadline.asked_to_stop()) break;
      if (triangulated_.area[Mesh::triangle(h)] == kOutside) continue;
      if (triangulated_.piece[h] != Triangulated::kNoPiece) {
        across(h);
      } else if (mesh_.is_edge_representative(h)) {
        along(h);
      }
    }
    return std::move(sources_);
  }

 private:
  /// Not one of the outline, but of the triangulation that surrounds a sphere.
  [[nodiscard]] bool helps(VertexId v) const { return v.index >= divided_.points.size(); }
  [[nodiscard]] Vec3 at(VertexId v) const { return divided_.points[v.index]; }
  [[nodiscard]] bool isolated(VertexId v) const { return around_[v.index].empty(); }

  void add(Vec3 p, double size) {
    if (size < kLess * size_(p)) sources_.push_back({p, size});
  }

  /// Both are ends of pieces at one point, where those do not make a sharp corner.
  [[nodiscard]] bool neighbours(VertexId a, VertexId b) const {
    for (const std::uint32_t c : around_[a.index]) {
      for (const std::uint32_t d : around_[b.index]) {
        if (c != d) continue;
        const Vec3 to_a = at(a) - divided_.points[c], to_b = at(b) - divided_.points[c];
        if (dot(to_a, to_b) <= kSharpCosine * length(to_a) * length(to_b)) return true;
      }
    }
    return false;
  }

  /// An edge from vertex to vertex through the inside.
  void along(HalfedgeId h) {
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    if (helps(a) || helps(b) || neighbours(a, b)) return;
    const double gap = length(at(b) - at(a));
    const double size = isolated(a) || isolated(b) ? gap : kOfGap * gap;
    add(at(a), size);
    add(at(b), size);
  }

  /// A triangle on a piece: from the piece to what is across.
  void across(HalfedgeId h) {
    const VertexId a = mesh_.origin(h), b = mesh_.target(h), c = mesh_.opposite(h);
    if (helps(c) || triangulated_.piece[Mesh::next(h)] != Triangulated::kNoPiece ||
        triangulated_.piece[Mesh::prev(h)] != Triangulated::kNoPiece || neighbours(a, c) || neighbours(b, c))
      return;
    const Vec3 ab = at(b) - at(a);
    const double part = dot(at(c) - at(a), ab) / squared_length(ab);
    if (part <= 0 || part >= 1) return;  // the gap is that to a or b
    const Vec3 foot = at(a) + part * ab;
    const double gap = length(at(c) - foot);
    const double size = isolated(c) ? gap : kOfGap * gap;
    add(foot, size);
    add(at(c), size);
  }

  const DividedOutline& divided_;
  const Mesh& mesh_;
  const Triangulated& triangulated_;
  const GradedSize& size_;
  std::vector<std::vector<std::uint32_t>> around_;
  std::vector<SizeSource> sources_;
};

}  // namespace

std::vector<SizeSource> narrow_places(const DividedOutline& divided, const Triangulated& triangulated,
                                      const GradedSize& size, Deadline& deadline) {
  return Narrow(divided, triangulated, size).run(deadline);
}

}  // namespace temper::mesher

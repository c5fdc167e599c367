#include "topology/cavity.hpp"

#include <cstddef>
#include <limits>

#include "mesh/predicates.hpp"

namespace temper {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
// Stars of more than a dozen triangles are rare; tables for twice that many fit into nine kilobytes of stack.
constexpr std::size_t kSmall = 24;

/// n values of memory that is on the stack when n is small.
template <class T, std::size_t N>
class Scratch {
 public:
  explicit Scratch(std::size_t n) {
    if (n > N) large_.resize(n);
  }
  T& operator[](std::size_t i) { return large_.empty() ? small_[i] : large_[i]; }

 private:
  std::array<T, N> small_;
  std::vector<T> large_;
};

/// The best triangulation of the part of the polygon from i to j: its volume, and the apex over its closing edge.
struct Part {
  double volume;
  std::size_t apex;
};

class BestTriangulation {
 public:
  BestTriangulation(const Mesh& mesh, std::span<const VertexId> polygon, const WeightedPoint& origin)
      : mesh_(mesh), polygon_(polygon), n_(polygon.size()), lifted_(n_), parts_(n_ * n_) {
    for (std::size_t i = 0; i < n_; ++i) {
      const WeightedPoint p = mesh.point(polygon[i], origin);
      const double x = p.x - origin.x, y = p.y - origin.y, w = p.w - origin.w;
      lifted_[i] = {x, y, mesh.space().is_plane() ? x * x + y * y - w : w};
    }
    for (std::size_t i = 0; i + 1 < n_; ++i) part(i, i + 1) = {0, i};
    for (std::size_t length = 2; length < n_; ++length) {
      for (std::size_t i = 0; i + length < n_; ++i) part(i, i + length) = best(i, i + length);
    }
  }

  [[nodiscard]] bool exists() { return part(0, n_ - 1).volume < kNone; }

  void append(std::size_t i, std::size_t j, std::vector<std::array<VertexId, 3>>& triangles) {
    if (j - i < 2) return;
    const std::size_t m = part(i, j).apex;
    triangles.push_back({polygon_[i], polygon_[m], polygon_[j]});
    append(i, m, triangles);
    append(m, j, triangles);
  }

 private:
  Part& part(std::size_t i, std::size_t j) { return parts_[i * n_ + j]; }

  /// Ties go to the smallest apex: what is best then depends on the order of the polygon alone.
  Part best(std::size_t i, std::size_t j) {
    Part least = {kNone, i};
    const bool closes_polygon = i == 0 && j == n_ - 1;
    if (!closes_polygon && has_edge(mesh_, polygon_[i], polygon_[j])) return least;
    for (std::size_t m = i + 1; m < j; ++m) {
      const double rest = part(i, m).volume + part(m, j).volume;
      if (!(rest < kNone) || !is_counter_clockwise(i, m, j)) continue;
      const double volume = rest + volume_under(i, m, j);
      if (volume < least.volume) least = {volume, m};
    }
    return least;
  }

  [[nodiscard]] bool is_counter_clockwise(std::size_t i, std::size_t m, std::size_t j) const {
    return inlined::orientation(mesh_, polygon_[i], polygon_[m], polygon_[j]) == Sign::positive;
  }

  /// Six times the volume between triangle imj and the plane z = 0. On the sphere the surface of least volume is the
  /// farthest out: minus that of the tetrahedron of imj and the origin, which is no constant apart from that with the
  /// center of the sphere.
  [[nodiscard]] double volume_under(std::size_t i, std::size_t m, std::size_t j) {
    const Vec3 a = lifted_[i], b = lifted_[m], c = lifted_[j];
    if (!mesh_.space().is_plane()) return -dot(a, cross(b, c));
    const double doubled_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return doubled_area * (a.z + b.z + c.z);
  }

  const Mesh& mesh_;
  std::span<const VertexId> polygon_;
  std::size_t n_;
  Scratch<Vec3, kSmall> lifted_;          // seen from the origin: in the plane with the height on the lifted surface
  Scratch<Part, kSmall * kSmall> parts_;  // of i < j alone; the rest is never looked at
};

}  // namespace

bool has_edge(const Mesh& mesh, VertexId a, VertexId b) {
  return mesh.find_halfedge(a, b).valid() || mesh.find_halfedge(b, a).valid();
}

bool triangulate_cavity(const Mesh& mesh, std::span<const VertexId> polygon, const WeightedPoint& origin,
                        std::vector<std::array<VertexId, 3>>& triangles) {
  if (polygon.size() < 3) return false;
  BestTriangulation best(mesh, polygon, origin);
  if (!best.exists()) return false;
  best.append(0, polygon.size() - 1, triangles);
  return true;
}

}  // namespace temper

#include "topology/cavity.hpp"

#include <cstddef>
#include <limits>

#include "geometry/in_space.hpp"
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
      lifted_[i] = on_lifted_surface(mesh.space(), mesh.point(polygon[i], origin), origin);
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
      const double volume = rest + volume_under(mesh_.space(), lifted_[i], lifted_[m], lifted_[j]);
      if (volume < least.volume) least = {volume, m};
    }
    return least;
  }

  [[nodiscard]] bool is_counter_clockwise(std::size_t i, std::size_t m, std::size_t j) const {
    return inlined::orientation(mesh_, polygon_[i], polygon_[m], polygon_[j]) == Sign::positive;
  }

  const Mesh& mesh_;
  std::span<const VertexId> polygon_;
  std::size_t n_;
  Scratch<Vec3, kSmall> lifted_;          // on_lifted_surface()
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

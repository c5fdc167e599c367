// The triangles that are furthest from well-centered, and a sentence on each that says why.
//
// Triangles are ranked by the least of their h/ℓ and d/ℓ, ties by number, so that the list does not depend
// on how the mesh was cut into blocks.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "quality/measure.hpp"
#include "temper/mesh.hpp"
#include "temper/quality.hpp"

namespace temper {

struct Ranked {
  double margin = 0;
  TriangleId triangle;
  friend bool operator<(const Ranked& a, const Ranked& b) {
    return a.margin != b.margin ? a.margin < b.margin : a.triangle < b.triangle;
  }
};

/// The first n in rank of everything offered.
class WorstList {
 public:
  explicit WorstList(std::size_t n) : n_(n) {}
  void offer(Ranked candidate);
  void merge(const WorstList& other);
  [[nodiscard]] std::vector<Ranked> sorted() const;

 private:
  std::size_t n_;
  std::vector<Ranked> heap_;  // the best ranked of the list on top
};

/// The entry of the report on one triangle; `why` in these numbers, or counted from 0.
[[nodiscard]] WorstTriangle describe(const Mesh& mesh, TriangleId t, const InputNames* names = nullptr);

/// The centroid of a triangle, as reports give it.
[[nodiscard]] Vec2 middle_of(const Mesh& mesh, TriangleId t);

/// The number by which reports call a vertex or a triangle: the last word of its name, "12" of "point 12".
[[nodiscard]] std::string number_of(VertexId v, const InputNames* names);
[[nodiscard]] std::string number_of(TriangleId t, const InputNames* names);
/// "0.1234", and "138.3°": as many digits as people read.
[[nodiscard]] std::string rounded(double value);
[[nodiscard]] std::string degrees(double angle);

}  // namespace temper

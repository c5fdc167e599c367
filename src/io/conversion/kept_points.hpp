// The points of a file that are vertices of its mesh: the corners of its cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/failure.hpp"
#include "io/text/names.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// For each of n points: is it the corner of a cell? Numbers out of range count for nothing.
template <int dimension>
[[nodiscard]] std::vector<bool> corners_among(std::size_t n, const Cells<dimension>& cells) {
  std::vector<bool> used(n);
  for (const auto& cell : cells) {
    for (const std::int32_t p : cell) {
      if (p >= 0 && static_cast<std::size_t>(p) < n) used[static_cast<std::size_t>(p)] = true;
    }
  }
  return used;
}

/// Points that are dropped, in words; nothing if there are none. `cell`: "triangle" or "tetrahedron".
[[nodiscard]] inline std::optional<std::string> warning_of_unused(const VertexOfPoint& vertices,
                                                                  const InputNames& names, std::string_view cell) {
  const std::size_t n = vertices.size() - vertices.n_kept();
  if (n == 0) return {};
  std::vector<std::string> dropped;
  for (std::size_t p = 0; p < vertices.size() && dropped.size() < kNamed; ++p) {
    if (vertices[p] < 0) dropped.push_back(names.point(p));
  }
  return listed(n, text(n == 1 ? "point of no " : "points of no ", cell, n == 1 ? " is dropped" : " are dropped"),
                dropped);
}

/// The values of the points that are left.
template <class T>
[[nodiscard]] std::vector<T> kept(const std::vector<T>& of_points, const VertexOfPoint& vertices) {
  if (vertices.n_kept() == vertices.size()) return of_points;
  std::vector<T> left;
  for (std::size_t p = 0; p < std::min(of_points.size(), vertices.size()); ++p) {
    if (vertices[p] >= 0) left.push_back(of_points[p]);
  }
  return left;
}

/// Elements in the numbers of the vertices. Numbers out of range stay out of range, for the mesh to refuse.
template <std::size_t n>
[[nodiscard]] std::vector<std::array<std::int32_t, n>> renumbered(std::vector<std::array<std::int32_t, n>> elements,
                                                                  const VertexOfPoint& vertices) {
  if (vertices.n_kept() == vertices.size()) return elements;
  for (auto& element : elements) {
    for (std::int32_t& p : element)
      p = p >= 0 && static_cast<std::size_t>(p) < vertices.size() ? vertices[static_cast<std::size_t>(p)]
                                                                  : std::int32_t{-1};
  }
  return elements;
}

/// The names of the points that are left. `Names`: InputNames, or those of tetrahedra.
template <class Names>
class KeptNames : public Names {
 public:
  KeptNames(const Names& all, const VertexOfPoint& vertices) : all_(all) {
    for (std::size_t p = 0; p < vertices.size() && vertices.n_kept() < vertices.size(); ++p) {
      if (vertices[p] >= 0) points_.push_back(p);
    }
  }
  [[nodiscard]] const Names& all() const { return all_; }
  [[nodiscard]] std::string point(std::size_t i) const override { return all_.point(kept(i)); }
  [[nodiscard]] std::string point_where(std::size_t i) const override { return all_.point_where(kept(i)); }

 private:
  [[nodiscard]] std::size_t kept(std::size_t i) const { return i < points_.size() ? points_[i] : i; }
  const Names& all_;
  std::vector<std::size_t> points_;  // empty: all
};

class KeptTriangleNames final : public KeptNames<InputNames> {
 public:
  using KeptNames::KeptNames;
  [[nodiscard]] std::string triangle(std::size_t i) const override { return all().triangle(i); }
  [[nodiscard]] std::string triangle_where(std::size_t i) const override { return all().triangle_where(i); }
};

}  // namespace temper::io

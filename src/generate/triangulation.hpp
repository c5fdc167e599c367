// The stages of a constrained Delaunay triangulation: points, segments, carving, numbering.
//
// During construction vertices are numbered in the order of their insertion, which keeps neighbors near in memory.
// `number` has the user's numbers, which break all ties. So the triangulation depends on the points and the segments
// alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "regularity/lawson.hpp"
#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper::generate {

struct Triangulation {
  Mesh mesh;
  std::vector<std::uint32_t> number;  ///< of each vertex: the index of its point
  std::vector<VertexId> vertex;       ///< of each point
  std::size_t steps = 0;              ///< from triangle to triangle, on the way to the places of points

  [[nodiscard]] auto conflict_test() const {
    return PerturbedPowerTest{[this](VertexId v) { return number[v.index]; }};
  }
  [[nodiscard]] std::string name(VertexId v) const { return "point " + std::to_string(number[v.index]); }
};

/// Order of insertion: rounds of doubling size, drawn at random, each along the Hilbert curve. The first rounds give
/// the walks a coarse map of the whole domain; within a round the next point is near the last.
[[nodiscard]] std::vector<std::uint32_t> insertion_order(std::span<const Vec2> points);
[[nodiscard]] std::vector<std::uint32_t> insertion_order(std::span<const Vec3> points);

/// The error after `stop` has ended the work.
[[nodiscard]] inline InputError stopped_error() {
  return {ErrorCode::stopped, "", "the triangulation was stopped before its end"};
}

/// The Delaunay triangulation of the convex hull. `stop` is called at each point.
[[nodiscard]] Expected<Triangulation> triangulate_points(std::span<const Vec2> points,
                                                         const std::function<bool()>& stop = {});

/// The Delaunay triangulation of points of the sphere of this radius. If they leave half of it empty, up to four
/// vertices without a point are added, numbered after the points.
[[nodiscard]] Expected<Triangulation> triangulate_sphere(std::span<const Vec3> points, double radius,
                                                         const std::function<bool()>& stop = {});

/// Makes the segments edges, or chains of edges where points lie on them, and constrains those.
[[nodiscard]] std::optional<InputError> insert_segments(Triangulation& triangulation,
                                                        std::span<const std::array<std::int32_t, 2>> segments,
                                                        const std::function<bool()>& stop = {});

/// Erases the triangles outside the segments and in holes.
[[nodiscard]] std::optional<InputError> carve(Triangulation& triangulation);

/// The mesh with the user's numbers. `stop` is called a few times.
[[nodiscard]] Expected<Mesh> in_input_order(Triangulation triangulation, const std::function<bool()>& stop = {});

}  // namespace temper::generate

// The pieces that cells have in a triangle.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "dec/division.hpp"
#include "temper/detail/cells.hpp"
#include "temper/mesh.hpp"
#include "transfer/convex.hpp"

namespace temper {

/// A piece of a cell: corners from `begin` to `end` of its triangle's.
struct RayPiece {
  std::uint32_t cell = 0, begin = 0, end = 0;
  double negligible = 0;  ///< overlaps of this area are rounding
  RayCircle circle;
};

/// A triangle of a mesh and its pieces. In the plane they are as seen from an origin.
struct CutTriangle {
  WeightedPoint origin;
  RayPolygon triangle;
  RayPolygon corners;
  std::vector<RayPiece> pieces;

  [[nodiscard]] std::span<const Vec3> polygon(const RayPiece& piece) const {
    return std::span(corners).subspan(piece.begin, piece.end - piece.begin);
  }
};

/// Cuts the triangles of a mesh, and keeps what it has cut: neighbors ask for the same ones.
class TriangleCuts {
 public:
  TriangleCuts(const Mesh& mesh, const JointPolygons& joints, CellsOf of)
      : mesh_(mesh), joints_(joints), of_(of), divider_(mesh, joints) {}

  [[nodiscard]] CutTriangle cut(TriangleId t);
  [[nodiscard]] const CutTriangle& kept(TriangleId t) {
    const auto [at, is_new] = kept_.try_emplace(t.index);
    if (is_new) at->second = cut(t);
    return at->second;
  }

 private:
  void cut_for_vertices(TriangleId t, CutTriangle& cut);
  void add(CutTriangle& cut, std::uint32_t cell, const RayPolygon& polygon) const;

  const Mesh& mesh_;
  const JointPolygons& joints_;
  CellsOf of_;
  TriangleDivider divider_;
  PolygonCutter cutter_;
  RayPolygon polygon_;
  std::unordered_map<std::uint32_t, CutTriangle> kept_;
};

}  // namespace temper

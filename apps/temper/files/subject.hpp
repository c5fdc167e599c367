// Meshes of triangles and of tetrahedra differ in these types and nouns.
//
// A verb is written once, as a template over a Subject. All else that differs are functions with one name for both
// kinds: quality(), measure_errors(), brief_text(), … So a further kind of cells is one more Subject, and those
// functions.
#pragma once

#include <string_view>

#include "temper/detail/cell_kinds.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::app {

struct Triangles {
  using Mesh = temper::Mesh;
  using Loaded = io::LoadedMesh;
  using Element = TriangleId;
  using Quality = temper::Quality;
  using OptimizeReport = temper::OptimizeReport;
  static constexpr CellKinds cells = CellKinds::triangles;
  static constexpr int dimension = 2;
  static constexpr std::string_view element = "triangle", elements = "triangles";
  static constexpr auto cells_of_file = &io::MeshFile::triangles;
  static constexpr bool runs_on_all_ranks = true;
};

struct Tetrahedra {
  using Mesh = tets::TetMesh;
  using Loaded = io::LoadedTetMesh;
  using Element = tets::TetId;
  using Quality = tets::Quality;
  using OptimizeReport = tets::OptimizeReport;
  static constexpr CellKinds cells = CellKinds::tetrahedra;
  static constexpr int dimension = 3;
  static constexpr std::string_view element = "tetrahedron", elements = "tetrahedra";
  static constexpr auto cells_of_file = &io::MeshFile::tetrahedra;
  static constexpr bool runs_on_all_ranks = false;
};

[[nodiscard]] inline CellKinds cells_of(const io::MeshFile& file) {
  return file.dimension() == Tetrahedra::dimension ? Tetrahedra::cells : Triangles::cells;
}

}  // namespace temper::app

// The kinds of cells that a mesh may have, each as a Subject: its types, and its nouns.
//
// A verb is written once, as a template over a Subject. All else that differs are functions with one name for all
// kinds: quality(), measure_errors(), rows of brief_text(), … So a further kind of cells is one more Subject, and those
// functions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

#include "temper/detail/cell_kinds.hpp"
#include "temper/detail/tensor.hpp"
#include "temper/io.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/surfaces.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"
#include "temper/tets/tensor.hpp"
#include "temper/tets/weights.hpp"

namespace temper {
struct ErrorReport;
namespace tets {
struct ErrorReport;
}
namespace surfaces {
struct ErrorReport;
}
}  // namespace temper

namespace temper::app {

struct Triangles {
  using Mesh = temper::Mesh;
  using Loaded = io::LoadedMesh;
  using Element = TriangleId;
  using Tensor = temper::Tensor;
  using Metrics = temper::Metrics;
  using Pieces = temper::MetricMesh;
  using WholeMesh = temper::WholeMesh;
  using Quality = temper::Quality;
  using OptimizeReport = temper::OptimizeReport;
  using ErrorReport = temper::ErrorReport;
  static constexpr CellKinds cells = CellKinds::triangles;
  static constexpr int dimension = 2;
  static constexpr std::string_view element = "triangle", elements = "triangles";
  static constexpr std::string_view link = "edge", links = "edges";  ///< between two elements
  static constexpr std::string_view angle = "angle";
  static constexpr std::string_view tensor = "KXX,KXY,KYY";
  static constexpr auto cells_of_file = &io::MeshFile::triangles;
  static constexpr auto measures = &temper::quality_measures;
  static constexpr auto constraints = &temper::constraints_table;
  static constexpr std::string_view length_of_constraints = "edge length l";
  static constexpr bool runs_on_all_ranks = true;
  static const ReportTable& table_of_data(const io::DataReport* report) { return table_of(report); }
};

struct Tetrahedra {
  using Mesh = tets::TetMesh;
  using Loaded = io::LoadedTetMesh;
  using Element = tets::TetId;
  using Tensor = temper::Tensor3;
  using Metrics = tets::Metrics;
  using Pieces = tets::MetricMesh;
  using WholeMesh = tets::WholeMesh;
  using Quality = tets::Quality;
  using OptimizeReport = tets::OptimizeReport;
  using ErrorReport = tets::ErrorReport;
  static constexpr CellKinds cells = CellKinds::tetrahedra;
  static constexpr int dimension = 3;
  static constexpr std::string_view element = "tetrahedron", elements = "tetrahedra";
  static constexpr std::string_view link = "face", links = "faces";
  static constexpr std::string_view angle = "dihedral";
  static constexpr std::string_view tensor = "KXX,KXY,KXZ,KYY,KYZ,KZZ";
  static constexpr auto cells_of_file = &io::MeshFile::tetrahedra;
  static constexpr auto measures = &tets::quality_measures;
  static constexpr auto constraints = &tets::constraints_table;
  static constexpr std::string_view length_of_constraints = "the side l of an equilateral triangle of a face's area";
  static constexpr bool runs_on_all_ranks = false;
  static const ReportTable& table_of_data(const io::DataReport* report) { return table_for_tetrahedra(report); }
};

/// Triangles of a curved surface. They have no tensors.
struct Surfaces {
  using Mesh = surfaces::SurfaceMesh;
  using Loaded = io::LoadedSurface;
  using Element = TriangleId;
  using Quality = surfaces::Quality;
  using OptimizeReport = surfaces::SurfaceReport;
  using ErrorReport = surfaces::ErrorReport;
  static constexpr CellKinds cells = CellKinds::surfaces;
  static constexpr int dimension = 2;
  static constexpr std::string_view element = "triangle", elements = "triangles";
  static constexpr std::string_view link = "edge", links = "edges";
  static constexpr std::string_view angle = "angle";
  static constexpr auto cells_of_file = &io::MeshFile::triangles;
  static constexpr auto measures = &surfaces::quality_measures;
  static constexpr auto constraints = &temper::constraints_table;
  static constexpr std::string_view length_of_constraints = Triangles::length_of_constraints;
  static constexpr bool runs_on_all_ranks = false;
  static const ReportTable& table_of_data(const io::DataReport* report) { return table_of(report); }
};

/// F(Subject) for each kind: sources of templates make them for all kinds with it.
#define TEMPER_EACH_SUBJECT(F) TEMPER_EACH_FLAT_SUBJECT(F) F(Surfaces)
/// F(Subject) for each kind that has tensors.
#define TEMPER_EACH_FLAT_SUBJECT(F) F(Triangles) F(Tetrahedra)
template <class Subject>
inline constexpr bool is_flat_subject = !std::is_same_v<Subject, Surfaces>;

/// The kinds, the first of which is meant when nothing is said.
inline constexpr CellKinds kEachKind[] = {Triangles::cells, Tetrahedra::cells, Surfaces::cells};

/// Calls f with the Subject of these cells.
template <class F>
decltype(auto) with_subject(CellKinds cells, const F& f) {
  return cells == Tetrahedra::cells ? f(Tetrahedra()) : cells == Surfaces::cells ? f(Surfaces()) : f(Triangles());
}
/// The Subject of a mesh or of its quality.
template <class Part, class Subject>
inline constexpr bool is_part_of =
    std::is_same_v<Part, typename Subject::Mesh> || std::is_same_v<Part, typename Subject::Quality>;
template <class Part>
using SubjectOf = std::conditional_t<is_part_of<Part, Tetrahedra>, Tetrahedra,
                                     std::conditional_t<is_part_of<Part, Surfaces>, Surfaces, Triangles>>;

[[nodiscard]] inline CellKinds cells_of(const io::MeshFile& file) {
  return file.dimension() == Tetrahedra::dimension ? Tetrahedra::cells
         : file.is_surface()                       ? Surfaces::cells
                                                   : Triangles::cells;
}

/// "triangles or tetrahedra", for help.
[[nodiscard]] inline std::string any_elements(const std::string& word = "or") {
  return std::string(Triangles::elements) + " " + word + " " + std::string(Tetrahedra::elements);
}
/// "triangle or tetrahedron"
[[nodiscard]] inline std::string any_element() {
  return std::string(Triangles::element) + " or " + std::string(Tetrahedra::element);
}

/// The numbers of a tensor, for errors.
[[nodiscard]] inline std::string any_tensor() {
  return "three numbers " + std::string(Triangles::tensor) + ", or for " + std::string(Tetrahedra::elements) +
         " six numbers " + std::string(Tetrahedra::tensor);
}
/// What a tensor is for cells that are not of the first kind, for help.
[[nodiscard]] inline std::string other_tensors() {
  return "For " + std::string(Tetrahedra::elements) + " a tensor is " + std::string(Tetrahedra::tensor) +
         ", and axes are k11,k22,k33. ";
}

[[nodiscard]] inline auto elements_of(const Mesh& mesh) { return mesh.triangles(); }
[[nodiscard]] inline auto elements_of(const tets::TetMesh& mesh) { return mesh.tetrahedra(); }
[[nodiscard]] inline auto elements_of(const surfaces::SurfaceMesh& mesh) { return mesh.triangles(); }
[[nodiscard]] inline std::size_t n_elements(const Mesh& mesh) { return mesh.n_triangles(); }
[[nodiscard]] inline std::size_t n_elements(const tets::TetMesh& mesh) { return mesh.n_tetrahedra(); }
[[nodiscard]] inline std::size_t n_elements(const surfaces::SurfaceMesh& mesh) { return mesh.n_triangles(); }
/// The number of elements of the mesh that a report is about.
template <class Report>
[[nodiscard]] std::size_t n_elements(const Report& report) {
  if constexpr (requires { report.tetrahedra; })
    return report.tetrahedra;
  else
    return report.triangles;
}
/// The number of links of that mesh whose dual is negative.
template <class Report>
[[nodiscard]] std::size_t n_irregular_links(const Report& report) {
  if constexpr (requires { report.non_regular_faces; })
    return report.non_regular_faces;
  else
    return report.non_regular_edges;
}

}  // namespace temper::app

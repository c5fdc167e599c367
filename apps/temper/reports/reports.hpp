// The reports of verbs, as text for people and as JSON.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/input.hpp"
#include "files/tensor_option.hpp"
#include "options/options.hpp"
#include "reports/quality_report.hpp"
#include "temper/dec.hpp"
#include "temper/detail/columns.hpp"
#include "temper/detail/connectivity.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/report.hpp"
#include "temper/detail/size.hpp"
#include "temper/explain.hpp"
#include "temper/feasibility.hpp"
#include "temper/io.hpp"
#include "temper/mesher.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/tets/explain.hpp"
#include "temper/tets/operators.hpp"

namespace temper::app {

/// The tables of reports and options as JSON, for `temper --help=tables`.
[[nodiscard]] std::string tables_json();

/// Widths of a table for people.
struct LineWidths {
  std::size_t label = 34, value = 16;
};
[[nodiscard]] std::string text_line(std::string_view label, std::string_view value, LineWidths columns = {});
/// A line per row that has a label and a value.
[[nodiscard]] std::string labeled_text(const ReportView& report, LineWidths columns = {});

// The reports of `temper operators` on the operators it wrote: as text, as JSON, and as warnings.

struct DecRecord {
  std::string path;  ///< of the mesh
  const DecSummary& summary;
  const PowerCells& cells;
  const Columns* columns;  ///< null: without layers
  std::vector<std::string> files;
};
struct TetDecRecord {
  std::string path;
  const tets::DecSummary& summary;
  std::vector<std::string> files;
};
[[nodiscard]] const ReportTable& table_of(const DecRecord*);
[[nodiscard]] const ReportTable& table_of(const TetDecRecord*);

[[nodiscard]] std::string dec_text(const DecRecord& record);
[[nodiscard]] std::string dec_text(const TetDecRecord& record);
[[nodiscard]] std::string dec_json(const DecRecord& record);
[[nodiscard]] std::string dec_json(const TetDecRecord& record);
/// The verdict on signs that is a warning: how many coefficients are not positive, and what to do. Empty: all are. It
/// is the first line of the text.
[[nodiscard]] std::string dec_trouble(const DecRecord& record);
[[nodiscard]] std::string dec_trouble(const TetDecRecord& record);
/// Other warnings for the author of a solver: none for a well-centered mesh.
[[nodiscard]] std::vector<std::string> dec_warnings(const DecRecord& record);
[[nodiscard]] std::vector<std::string> dec_warnings(const TetDecRecord& record);

// The reports of `temper explain`: text for people, and JSON.

/// Counts, then one paragraph per reason: at most `limit` conflicts, and `limit` groups that only lack weights.
[[nodiscard]] std::string explanation_text(const Explanation& explanation, const Input& input, std::size_t limit,
                                           const TextStyle& style);
/// Counts, then one paragraph per reason of the explanation, which has at most `limit`.
[[nodiscard]] std::string explanation_text(const tets::Explanation& explanation, const TetInput& input,
                                           std::size_t limit, const TextStyle& style);
[[nodiscard]] std::string explanation_text(const surfaces::Explanation& explanation, const SurfaceInput& input,
                                           std::size_t limit, const TextStyle& style);
/// The number of violations, then one paragraph per reason.
template <class Subject>
[[nodiscard]] std::string explanation_text(const DualExplanation& explanation, const InputOf<Subject>& input,
                                           const TextStyle& style);
/// All reasons. Vertices and elements are counted from 0, in the texts too.
[[nodiscard]] std::string explanation_json(const DualExplanation& explanation, std::span<const std::size_t> points);
/// `numbers`: of vertices in certificates.
[[nodiscard]] std::string explanation_json(const Explanation& explanation, const Input& input,
                                           const CopyNumbers& numbers);
[[nodiscard]] std::string explanation_json(const tets::Explanation& explanation, const TetInput& input);
[[nodiscard]] std::string explanation_json(const surfaces::Explanation& explanation, const SurfaceInput& input);

// The reports of `temper weights`: text for people, and JSON.

struct WeightsRecord {
  std::string_view mode;
  const WeightOptions& options;
  const ConstraintsInfo& constraints;
  const WeightReport& report;
  std::string_view path;                                             ///< of the mesh
  std::string size;                                                  ///< "12 vertices, 10 triangles"
  Space space;                                                       ///< of the mesh
  const std::vector<std::size_t>& points;                            ///< of Input or TetInput
  std::function<std::string(const WeightConstraint&)> text;          ///< constraint_text
  std::function<TriangleId(const WeightConstraint&)> triangle = {};  ///< of a height, in meshes of triangles
  const ConnectivityReport* search = nullptr;                        ///< with --connectivity search
  std::string_view output = {};                                      ///< empty: not written
  std::string_view certificate = {};                                 ///< the same
  CopyNumbers numbers = {};                                          ///< in certificates
  const surfaces::IntrinsicWeights* intrinsic = nullptr;             ///< with --flips intrinsic
};

[[nodiscard]] std::string weights_text(const WeightsRecord& record);
[[nodiscard]] std::string weights_json(const WeightsRecord& record);

/// "h over edge 3-9 of triangle 17 (angle of 138.3 degrees at vertex 10)", in the file's numbers.
[[nodiscard]] std::string constraint_text(const WeightConstraint& constraint, const Input& input, const Mesh& mesh);
[[nodiscard]] std::string constraint_text(const WeightConstraint& constraint, const TetInput& input,
                                          const tets::TetMesh& mesh);
[[nodiscard]] std::string constraint_text(const WeightConstraint& constraint, const SurfaceInput& input,
                                          const surfaces::SurfaceMesh& mesh);
/// The text names a triangle by its number in the intrinsic triangulation.
[[nodiscard]] std::string constraint_text(const WeightConstraint& constraint, const SurfaceInput& input,
                                          const surfaces::IntrinsicMesh& mesh);
/// The triangle of a height.
[[nodiscard]] TriangleId triangle_of(const Mesh& mesh, const WeightConstraint& constraint);

// The reports of `temper mesh` on the mesh it made: as text, and as JSON.

/// The place of points in longitude and latitude: on a map, on the sphere, or none.
struct MapUsed {
  std::optional<Projection> projection = {};
  double radius = 0;                          ///< of the sphere
  double covered = 0;                         ///< the part of the sphere that is meshed
  std::vector<Vec2> lon_lat = {};             ///< of the outlines' points, as they were given
  double least_scale = 1, largest_scale = 1;  ///< length on the map over length on the globe, over all vertices
};

/// "outline", "coast" or "lines", and the outline itself.
struct NamedOutline {
  const char* name;
  io::OutlineFile file;
};

struct MeshRecord {
  std::string command;
  const std::vector<NamedOutline>& inputs;
  const MapUsed& map;
  const OutlineMesh& made;
  const Quality& quality;
};

/// "stereographic:7.5,51", as --projection takes it.
[[nodiscard]] std::string spell(const Projection& projection);

[[nodiscard]] std::string mesh_text(const MeshRecord& record);
[[nodiscard]] std::string mesh_json(const MeshRecord& record);

// Sizes, for optimize: the changes of sizes by a run, for people.

/// Rows of the table of `temper optimize`, below the rows of comparison_text.
[[nodiscard]] std::string size_text(const SizeChange& size);

// Data of points and triangles, for optimize and replay: the given rules, and the results for the data.

/// The words of --point-data and --cell-data.
struct DataWords {
  std::vector<std::string> of_points, of_cells;
};
/// Adds both options. Their words are checked as they come.
void add_data_rules(Command& command, DataWords& words);
/// The rules for the data of a file. Failure if one names no array of its, or does not fit the array.
[[nodiscard]] io::UpdateOptions data_rules(const DataWords& words, const std::string& path,
                                           const std::vector<io::DataArray>& point_data,
                                           const std::vector<io::DataArray>& cell_data);
[[nodiscard]] inline io::UpdateOptions with_threads(io::UpdateOptions options, Executor* threads) {
  options.executor = threads;
  return options;
}

/// Lines of `temper optimize`; none if nothing moved that carries data. `one`, `several`: the elements.
[[nodiscard]] std::string data_text(const io::DataReport& report, std::string_view one, std::string_view several);

}  // namespace temper::app

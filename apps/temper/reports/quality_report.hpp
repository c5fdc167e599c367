// Reports on a mesh or on two, before and after: as text, as JSON and as a page of HTML.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "files/input.hpp"
#include "options/options.hpp"
#include "options/requirement.hpp"
#include "temper/io.hpp"
#include "temper/optimize.hpp"
#include "temper/quality.hpp"
#include "temper/tets/optimize.hpp"
#include "temper/tets/quality.hpp"

namespace temper::app {

// Reports for people: tables, histograms made of bars, the worst triangles in the numbers of their file.

/// Columns of the tables of `temper check` and `temper optimize`.
inline constexpr std::size_t kLabelColumns = 30, kNumberColumns = 14;

/// The style of text that suits the terminal.
struct TextStyle {
  bool utf8 = true;  ///< else bars and symbols in ASCII
  std::size_t columns = 100;
};
/// The style by the locale and the terminal.
[[nodiscard]] TextStyle text_style();

/// The library's sentences, for a terminal without UTF-8.
[[nodiscard]] std::string in_ascii(std::string text);

/// Counts, margins, all energies, histograms, the worst elements: `temper check --details`.
template <class Subject>
[[nodiscard]] std::string quality_text(const typename Subject::Quality& quality, const InputOf<Subject>& input,
                                       const TextStyle& style);

/// Counts and margins, before and after: `temper optimize --details`.
template <class AnyQuality>
[[nodiscard]] std::string comparison_text(const AnyQuality& before, const AnyQuality& after);
/// Further rows of it: the energies of one star.
[[nodiscard]] std::string energies_text(const Quality& before, const Quality& after, int star, const TextStyle& style);

/// The few numbers that most users need, of a mesh, or before and after a run.
template <class AnyQuality>
[[nodiscard]] std::string brief_text(const AnyQuality& quality);
template <class AnyQuality>
[[nodiscard]] std::string brief_text(const AnyQuality& before, const AnyQuality& after);

/// Says how much a surface turns at its edges, before and after a run.
[[nodiscard]] std::string turns_text(const surfaces::Turns& before, const surfaces::Turns& after);

/// "46 of 96 triangles are not well-centered, every edge is regular"
template <class AnyQuality>
[[nodiscard]] std::string verdict(const AnyQuality& quality);
/// The verdict for a target. Of duals it has their counts, and the place of the worst; or it says that a solver can use
/// the mesh as it is.
template <class Subject>
[[nodiscard]] std::string target_verdict(const typename Subject::Quality& quality, const InputOf<Subject>& input,
                                         Criterion criterion);
/// " over length", if numbers in reports are: a coefficient of triangles has no unit.
template <class Subject>
[[nodiscard]] constexpr std::string_view over_length(Criterion criterion) {
  return criterion == Criterion::coefficients && Subject::dimension == 2 ? "" : " over length";
}
/// "no edge has a negative coefficient", or "2 coefficients are bad (negative)". Also for distances.
[[nodiscard]] std::string count_of_duals(std::size_t violations, Criterion criterion);
/// "2 of 9 triangles are bad (not well-centered)", or "all 9 triangles are well-centered".
template <class Subject>
[[nodiscard]] std::string well_centered(std::size_t bad, std::size_t elements);

/// The size of a mesh: "5 vertices, 2 triangles". It may say how many vertices are inside.
template <class MeshOrQuality>
[[nodiscard]] std::string mesh_size(const MeshOrQuality& of);

/// "Next: temper explain out.vtu", for the target if its criterion is about duals; empty for a stream.
[[nodiscard]] std::string next_step(const std::string& path, const std::string& projection, Criterion criterion,
                                    std::string_view target);

/// Quadrilaterals, which are two triangles each.
[[nodiscard]] std::size_t count_quadrilaterals(const Mesh& mesh);
/// "4 of these triangles are halves of 2 quadrilaterals", a line; empty if there are none.
[[nodiscard]] std::string halves_text(const Mesh& mesh);
template <class Mesh>
[[nodiscard]] std::string halves_text(const Mesh& /*mesh*/) {
  return {};
}

/// Takes the places in a report from the map of a file to its degrees.
void show_places_of_file(Quality& quality, const Input& input);
template <class AnyQuality, class AnyInputOf>
void show_places_of_file(const AnyQuality& /*quality*/, const AnyInputOf& /*input*/) {}

// Reports as JSON, for programs. Infinite energies are null. Vertices and triangles count from 0, in the order of the
// file's arrays (points[i] of any reader), not in the numbers of a format.

/// The first number of a report: it changes when a key is removed or its meaning changes. docs/schema has the keys.
inline constexpr int kSchema = 1;

/// The criterion of a target, and the number of its violations in a mesh.
struct Verdict {
  std::string target;
  Criterion criterion = Criterion::well_centered;
  std::size_t violations = 0;
};
[[nodiscard]] const ReportTable& table_of(const Verdict*);

/// `temper check --json`: the numbers of a mesh, the verdict, and the outcomes of --require. `points`: mesh vertex →
/// point of the file; empty when they are the same.
template <class AnyQuality>
[[nodiscard]] std::string check_json(const std::string& path, const AnyQuality& quality,
                                     std::span<const std::size_t> points, const Verdict& verdict,
                                     std::span<const Outcome> outcomes);
/// One JSON text made of several.
[[nodiscard]] std::string json_list(std::span<const std::string> reports);

/// Everything in the report of `temper optimize --write`.
template <class Subject>
struct RunRecord {
  std::string command;
  std::string options;   ///< JSON: options that were given, which --options reads
  std::string settings;  ///< JSON: all options with their values
  const typename Subject::Quality& before;
  std::span<const std::size_t> points_before;  ///< of IN; OUT has the points of the mesh
  const typename Subject::Quality& after;
  const typename Subject::OptimizeReport& report;
  const io::DataReport& data;
  std::span<const Outcome> outcomes;  ///< of --require, on `after`
  std::vector<std::string> warnings;
  std::string solver_errors = {};  ///< JSON, of --measure-errors; or nothing
};
template <class Subject>
[[nodiscard]] std::string optimize_json(const RunRecord<Subject>& record);

/// The history of `temper optimize --write`: a header and one line per sweep.
[[nodiscard]] std::string history_csv(std::span<const SweepRecord> history);

// The page of `--write` of check and optimize: the HTML report (temper/detail/html.hpp). It has the numbers of the JSON
// reports, the reasons of temper explain, and the command to run again. Nothing in it depends on the time a run
// took.

/// `quality`: with the list of the worst elements for the page.
template <class Subject>
[[nodiscard]] std::string check_html(const std::string& command, const InputOf<Subject>& input,
                                     const typename Subject::Quality& quality);

/// `before`, `mesh`: of record.before and after. The file of the input is the output's by now.
template <class Subject>
struct RunPage {
  const RunRecord<Subject>& record;
  const InputOf<Subject>& input;
  const typename Subject::Mesh& before;
  const typename Subject::Mesh& mesh;
};
template <class Subject>
[[nodiscard]] std::string optimize_html(const RunPage<Subject>& page);

}  // namespace temper::app

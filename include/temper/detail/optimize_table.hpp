// The table of options: one row for each option that can be given as a value. Range checks, the command line, reports,
// warnings, Python and the documentation loop over it. So a new option is a field of OptimizeOptions or of one of its
// groups, and a row of src/optimize/options/table.cpp.
//
// In sentences, notes and errors an option is in back quotes: `boundary` or `boundary=split`. Each front end replaces
// it by its own spelling (spell_options).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "temper/detail/cell_kinds.hpp"
#include "temper/detail/criterion.hpp"
#include "temper/detail/error.hpp"
#include "temper/optimize.hpp"

namespace temper {

enum class OptionKind { count, number, choice, length_parameter, vertex };

/// The value of any option. monostate means absent; text is the name of a choice.
using OptionValue = std::variant<std::monostate, std::int64_t, double, std::string_view, LengthParameter, VertexId>;

/// Numbers from low to high. If open, these two are excluded.
struct OptionRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open = false;
};

/// Another option that this option needs to have an effect.
struct OptionNeed {
  std::string_view option;  ///< Name of the other option; empty: no need
  /// Values of which it must have one, such as "newton|alternating"; empty: any value except none.
  std::string_view values;
  bool (*holds)(const OptimizeOptions&) = nullptr;  ///< Test for needs that the value alone does not decide
};

struct OptionRow {
  std::string_view name = {};      ///< Name as in C++ and Python, but flat: accuracy.sweeps is accuracy_sweeps
  std::string_view sentence = {};  ///< Effect of the option, in ASCII
  OptionKind kind = OptionKind::number;
  CellKinds cells = CellKinds::triangles;          ///< Cells of the meshes that the option is for
  std::span<const std::string_view> choices = {};  ///< Names of the choices, for OptionKind::choice
  /// Choices for one kind of cells, such as "F|BP"; empty: all.
  std::string_view for_triangles = {}, for_tetrahedra = {}, for_surfaces = {};
  OptionRange range = {};                 ///< Range of counts, numbers and length_parameters
  bool optional = false;                  ///< Option may be absent
  bool common = false;                    ///< Option has a flag of its own in the program
  bool research = false;                  ///< Option is a switch of the paper, for the study of methods
  std::string_view absent_name = "auto";  ///< Text for an absent value; "auto": temper chooses
  std::string_view absent = {};           ///< Meaning of an absent value
  std::array<OptionNeed, 3> needs = {};
  OptionValue (*get)(const OptimizeOptions&) = nullptr;
  void (*set)(OptimizeOptions&,
              const OptionValue&) = nullptr;  ///< Sets the option to a value that check_option() accepts
};

struct OptionGroup {
  std::string_view title;
  std::span<const OptionRow> rows;
};

/// A word of a user that sets several options.
struct Preset {
  std::string_view name;
  std::string_view sentence;  ///< Who needs it and what it does, in ASCII
  CellKinds cells;            ///< Cells of the meshes that it is for
  void (*apply)(OptimizeOptions&);
  bool research = false;           ///< Preset is for the study of methods
  std::string_view synonyms = {};  ///< Words, with blanks between them, that people take for this one
};

/// A solver by name, and its target.
struct SolverName {
  std::string_view name;
  std::string_view target;     ///< Empty: the solver has several uses
  std::string_view uses = {};  ///< Targets of a solver with several uses, and when to take each
};
/// The solvers that stand for a target.
[[nodiscard]] std::span<const SolverName> solver_names();
/// Returns the solver with this name, or null. Case, blanks and hyphens do not matter.
[[nodiscard]] const SolverName* find_solver(std::string_view name);
/// Returns the name of the target that a word is, or that a solver stands for.
[[nodiscard]] Expected<std::string_view> target_named(std::string_view word);
/// "; did you mean 'quick'?" for a word that is none of these. Empty: no name and no synonym is near.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const Preset> presets);

/// The targets: solvers and other uses of a mesh. The first is the default.
[[nodiscard]] std::span<const Preset> targets();
/// The efforts: how much time a run may take. "normal" is the default.
[[nodiscard]] std::span<const Preset> efforts();
/// The parts of a mesh that a run can keep.
[[nodiscard]] std::span<const Preset> keeps();
/// Returns an error if an option contradicts the use that the target stands for: its scheme, or that weights stay.
[[nodiscard]] Expected<void> check_target(const OptimizeOptions& options, std::string_view target);
/// Returns the criterion of a target, which is one of targets(). Targets that keep weights have measures of their own,
/// beside well_centered.
[[nodiscard]] Criterion criterion_of_target(std::string_view target);
/// Returns the criterion of options, which is that of the target with these options.
[[nodiscard]] Criterion criterion_of(const OptimizeOptions& options);
/// Returns an error if options change a part of the mesh to keep.
[[nodiscard]] Expected<void> check_kept(const OptimizeOptions& options, std::span<const std::string_view> keep);

/// The names that a user gave.
struct GivenNames {
  std::string_view target = "any";
  std::span<const std::string_view> keep = {}, options = {};
};
/// Returns an error for the first of these that is for other cells than the mesh has. Options at their default pass.
[[nodiscard]] Expected<void> check_cells(const OptimizeOptions& options, const GivenNames& given, CellKinds cells);

/// Returns the table.
[[nodiscard]] std::span<const OptionGroup> option_groups();
/// Returns all rows of the table.
[[nodiscard]] std::span<const OptionRow> option_rows();
/// Returns the row with this name, or null.
[[nodiscard]] const OptionRow* find_option(std::string_view name);

/// Returns an error if the option may not have this value.
[[nodiscard]] Expected<void> check_option(const OptionRow& row, const OptionValue& value);
/// Returns an error for the first option with a value that it may not have in a mesh of these cells. Options for other
/// cells alone are not looked at.
[[nodiscard]] Expected<void> check_options(const OptimizeOptions& options, CellKinds cells);

/// Returns the value as text: "4", "newton", "auto".
[[nodiscard]] std::string option_text(const OptionRow& row, const OptionValue& value);
/// Returns the allowed values as text: "at least 2", "newton, golden or alternating".
[[nodiscard]] std::string option_range_text(const OptionRow& row);
/// Returns the need that the options do not satisfy, such as "`boundary=split`"; empty if this option has an effect.
[[nodiscard]] std::string missing_need(const OptionRow& row, const OptimizeOptions& options);

/// The spelling of an option and a value in a front end. The value may be empty.
using OptionSpelling = std::function<std::string(const OptionRow& row, std::string_view value)>;
/// Replaces each option in back quotes by the front end's spelling.
[[nodiscard]] std::string spell_options(std::string_view text, const OptionSpelling& spell);

}  // namespace temper

// The user's own problem −div(K grad u) = f: K on triangles, f at vertices, values on parts of the boundary by name.
#pragma once

#include <string>
#include <vector>

#include "files/input.hpp"
#include "help/command.hpp"
#include "temper/detail/discretization_error.hpp"

namespace temper::app {

/// Adds --coefficient.
void add_coefficient(Command& command, std::string& target);

/// The coefficient of each element; empty if the text is. Failure if the file has no such data, or if a region has no
/// value or is not in the file.
template <class Subject>
[[nodiscard]] std::vector<double> read_coefficient(const Command& command, const std::string& text,
                                                   const InputOf<Subject>& input);

/// The options of a problem, as text.
struct ProblemOptions {
  std::string dirichlet, neumann, source, coefficient;

  [[nodiscard]] bool given() const { return !dirichlet.empty(); }
};

/// Adds --dirichlet, --neumann, --source and --coefficient. `effect` is a sentence of the help: what the verb does
/// with the problem.
void add_problem(Command& command, ProblemOptions& options, const std::string& effect);

/// Refuses the other options of a problem without --dirichlet.
void expect_complete(const Command& command, const ProblemOptions& options);

/// The problem on a mesh. Failure if a name is no part of the boundary, no data or no region.
[[nodiscard]] DiffusionProblem read_problem(const Command& command, const ProblemOptions& options, const Input& input);

}  // namespace temper::app

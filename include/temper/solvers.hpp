// What this build of temper has to solve linear programs and systems of equations with, for OptimizeHooks::solvers:
//
//     auto report = temper::optimize(mesh, {.target = temper::Scheme::vertex}, {.solvers = temper::solvers()});
//
// A library of its own (temper::solvers), because it links Clp and uses Eigen if the build has them.
#pragma once

#include "temper/optimize.hpp"

namespace temper {

/// Clp's linear programs and the model of solver errors by Eigen; each is empty if the build lacks the library.
[[nodiscard]] Solvers solvers();

}  // namespace temper

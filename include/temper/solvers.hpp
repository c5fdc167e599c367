// Solvers of linear programs and of systems of equations in this build, for OptimizeHooks::solvers:
//
//     auto report = temper::optimize(mesh, {.scheme = temper::Scheme::vertex}, {.solvers = temper::solvers()});
//
// They have their own library, temper::solvers. It links Clp, and uses Eigen if the build has it.
#pragma once

#include <memory>

#include "temper/optimize.hpp"
#include "temper/surfaces.hpp"
#include "temper/tets/optimize.hpp"

namespace temper {

/// Clp's linear programs, and the model of solver errors by Eigen. Each is empty if the build lacks the library.
[[nodiscard]] Solvers solvers();

}  // namespace temper

namespace temper::tets {

/// Clp, the convex programs of temper/detail/lp.hpp, and the model of the errors of a scheme by Eigen. Each is empty if
/// the build lacks the library; the model is also if the scheme has none.
[[nodiscard]] Solvers solvers(Scheme scheme);

}  // namespace temper::tets

namespace temper::surfaces {

/// Returns SurfaceOptions::squared_errors, which uses Eigen. Empty if the build lacks it.
[[nodiscard]] SquaredErrors squared_errors();

}  // namespace temper::surfaces

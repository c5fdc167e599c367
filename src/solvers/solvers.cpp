#include "temper/solvers.hpp"

#ifdef TEMPER_WITH_LP
#include "temper/detail/lp.hpp"
#endif
#ifdef TEMPER_WITH_ERRORS
#include "temper/errors.hpp"
#include "temper/surface_errors.hpp"
#include "temper/tets/errors.hpp"
#endif

namespace temper {

Solvers solvers() {
  Solvers all;
#ifdef TEMPER_WITH_LP
  all.lp = [] { return clp_solver(); };
#endif
#ifdef TEMPER_WITH_ERRORS
  all.discretization_error = [](const Mesh& mesh, const OptimizeOptions& options, const InputNames* names) {
    const DiffusionProblem* const problem = options.problem ? &*options.problem : nullptr;
    return make_discretization_error(mesh, {.scheme = options.scheme, .problem = problem, .names = names});
  };
  all.squared_errors = squared_solver_errors;
#endif
  return all;
}

}  // namespace temper

namespace temper::tets {

Solvers solvers([[maybe_unused]] Scheme scheme) {
  Solvers all;
#ifdef TEMPER_WITH_LP
  all.lp = [] { return clp_solver(); };
  all.convex = [] { return interior_point_solver(); };
#endif
#ifdef TEMPER_WITH_ERRORS
  all.error = make_discretization_error(scheme);
#endif
  return all;
}

}  // namespace temper::tets

namespace temper::surfaces {

SquaredErrors squared_errors() {
#ifdef TEMPER_WITH_ERRORS
  return squared_solver_errors;
#else
  return {};
#endif
}

}  // namespace temper::surfaces

#include "temper/solvers.hpp"

#ifdef TEMPER_WITH_LP
#include "temper/detail/lp.hpp"
#endif
#ifdef TEMPER_WITH_ERRORS
#include "temper/errors.hpp"
#endif

namespace temper {

Solvers solvers() {
  Solvers all;
#ifdef TEMPER_WITH_LP
  all.lp = [] { return clp_solver(); };
#endif
#ifdef TEMPER_WITH_ERRORS
  all.discretization_error = [](const Mesh& mesh, Scheme scheme) {
    return make_discretization_error(mesh, {.scheme = scheme});
  };
#endif
  return all;
}

}  // namespace temper

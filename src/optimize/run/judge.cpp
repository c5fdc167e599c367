#include "optimize/run/judge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/sum.hpp"
#include "energy/whole_mesh.hpp"
#include "geometry/triangle_kernel.hpp"
#include "mesh/bad_triangles.hpp"
#include "mesh/blocks.hpp"
#include "optimize/flips/guard.hpp"
#include "optimize/run/run.hpp"
#include "temper/detail/size.hpp"
#include "temper/regularity.hpp"

namespace temper {
namespace {

double missing(double length, double least) {
  const double part = length < least ? 1 - std::max(length, 0.0) / least : 0;
  return part * part;
}

/// Returns the term of the inner edge that h represents, or 0. `sizes`: local sizes, if they are known.
template <class... Sizes>
double missing_of(const Mesh& mesh, const AccuracyModel& model, HalfedgeId h, const Sizes&... sizes) {
  if (mesh.is_erased(Mesh::triangle(h)) || mesh.is_boundary(h) || !mesh.is_edge_representative(h)) return 0;
  const auto [edge, dual] = relative_lengths(mesh, sizes..., h);
  return missing(edge, model.min_edge) + missing(dual, model.min_dual);
}

}  // namespace

double missing_lengths(const Mesh& mesh, const AccuracyModel& model, Executor* executor) {
  if (!model.keeps_lengths()) return 0;
  const IdVector<VertexId, double> sizes = local_sizes(mesh, executor);
  return blockwise_sum(mesh.n_halfedges(), executor,
                       [&](std::size_t i) { return missing_of(mesh, model, HalfedgeId(i), sizes); });
}

bool lacks_length(const Mesh& mesh, TriangleId t, const AccuracyModel& model) {
  const auto lacks = [&](int k) { return missing_of(mesh, model, Mesh::halfedge(t, k)) > 0; };
  return model.keeps_lengths() && (lacks(0) || lacks(1) || lacks(2));
}

std::vector<TriangleId> triangles_lacking_length(const Mesh& mesh, const AccuracyModel& model) {
  std::vector<TriangleId> lacking;
  if (!model.keeps_lengths()) return lacking;
  const IdVector<VertexId, double> sizes = local_sizes(mesh);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (missing_of(mesh, model, h, sizes) > 0) lacking.push_back(Mesh::triangle(h));
  }
  lacking.erase(std::unique(lacking.begin(), lacking.end()), lacking.end());
  return lacking;
}

double violation_of(const Mesh& mesh, TriangleId t) {
  const auto [p, q, r] = mesh.points(t);
  double worst = 0;
  for (const EdgeShape& e : triangle_shape(mesh.space(), p, q, r).edges) {
    worst = std::max({worst, -e.g / e.l2, 0.5 * (std::abs(e.dw) / e.l2 - 1)});
  }
  return worst;
}
double worst_violation(const Mesh& mesh, Executor* executor) {
  std::vector<double> of_blocks((mesh.n_triangles() + kLoopBlock - 1) / kLoopBlock);
  for_blocks(mesh.n_triangles(), executor, [&](std::size_t first, std::size_t last) {
    double& worst = of_blocks[first / kLoopBlock];
    for (const TriangleId t : IdRange<TriangleId>(TriangleId(first), TriangleId(last))) {
      if (is_bad(mesh, t)) worst = std::max(worst, violation_of(mesh, t));
    }
  });
  return of_blocks.empty() ? 0 : *std::ranges::max_element(of_blocks);
}

std::size_t count_worse(const Mesh& mesh, double limit, Executor* executor) {
  constexpr double kRounding = 1e-9;  // of another unit, or another order of corners
  if (!std::isfinite(limit)) return 0;
  return static_cast<std::size_t>(blockwise_sum(mesh.n_triangles(), executor, [&](std::size_t i) {
    const TriangleId t(i);
    return is_bad(mesh, t) && violation_of(mesh, t) > limit + kRounding * (1 + limit) ? 1.0 : 0.0;
  }));
}

bool has_all_for_accuracy(const Mesh& mesh, const Settings& settings) {
  return has_margins(mesh, settings.accuracy.margin, settings.executor()) &&
         missing_lengths(mesh, settings.accuracy, settings.executor()) == 0;
}

bool replaces(const MeshScore& now, const MeshScore& best, Requirement required) {
  if (now.beyond_guard != best.beyond_guard) return now.beyond_guard < best.beyond_guard;
  const bool fewer_bad = std::pair(now.violations, now.bad) < std::pair(best.violations, best.bad);
  if (required == Requirement::fewer_bad) return fewer_bad;
  if (best < now) return false;
  return required == Requirement::not_worse || fewer_bad || now.missing_lengths < best.missing_lengths;
}

bool replaces(const WorkingCopy& now, const WorkingCopy& best, Requirement required, const Settings& settings,
              const EnergyModel& model) {
  return replaces(score(now.mesh, settings, model, nullptr, now.units),
                  score(best.mesh, settings, model, nullptr, best.units), required);
}

bool is_judged_by_errors(std::size_t n_vertices, const Space& space, const Settings& settings) {
  const OptimizeOptions& o = settings.options;
  const bool is_free = !o.objective && settings.objective != Objective::energy && o.accuracy.sweeps > 0 &&
                       o.unknowns != Unknowns::positions && o.boundary != BoundaryVertices::split && !o.problem;
  return is_free && o.change == Change::all && o.scheme != Scheme::stars && settings.hooks.solvers.squared_errors &&
         !settings.accuracy.keeps_lengths() && space.kind() == SpaceKind::plane &&
         n_vertices <= static_cast<std::size_t>(std::min(o.solver_error.most_vertices, kMostJudgedVertices));
}

bool is_sound(const Mesh& input, const MeshScore& counts, const Settings& settings) {
  const Criterion criterion = criterion_of(settings.options.scheme);
  if (criterion != Criterion::well_centered) return meets(input, criterion, settings.executor());
  const double margin = settings.options.accuracy.margin.value_or(scheme_weights(Scheme::vertex).margin);  // the least
  return counts == MeshScore{} && has_margins(input, margin, settings.executor());
}

bool meets_limits_of_client(const Mesh& input, const Settings& settings) {
  const Client client = settings.options.guard.client;
  if (client == Client::none || client == Client::fem || settings.objective == Objective::energy) return false;
  GuardLimits measured;
  measured.has_flow = client == Client::dflowfm;
  GuardValues wanted;
  wanted.value.fill(-kInfinity);
  if (measured.has_flow) {
    wanted.value[GuardValues::orthogonality] = -kAdvisedOrthogonality;
    wanted.value[GuardValues::link] = kSmallFlowLink;
  } else {
    constexpr double kRoundedCosine = 1e-9;  // of a right angle in coordinates of double precision
    wanted.value[GuardValues::cosine] = 1 - kRoundedCosine;
    if (client == Client::mpas && count_bad(input, settings.executor()) > 0) return false;
    if (missing_lengths(input, settings.accuracy, settings.executor()) > 0) return false;
  }
  WorkingUnits same;
  same.space = input.space();
  const Guard guard(input, same, std::make_shared<const GuardLimits>(std::move(measured)));
  return guard.worst(settings.executor()).are_within(wanted);
}

ErrorJudge::ErrorJudge(const Mesh& input, const Settings& settings) : settings_(settings), of_input_(squared(input)) {}

std::vector<double> ErrorJudge::squared(const Mesh& mesh) const {
  return settings_.hooks.solvers.squared_errors(mesh, settings_.options.scheme, settings_.executor());
}

double ErrorJudge::largest_ratio(const Mesh& mesh) const { return temper::largest_ratio(squared(mesh), of_input_); }

double largest_ratio(const std::vector<double>& of_mesh, const std::vector<double>& of_input) {
  double largest = 0;
  for (std::size_t i = 0; i < std::min(of_mesh.size(), of_input.size()); ++i) {
    largest = std::max(largest, of_mesh[i] == of_input[i] ? 1 : of_mesh[i] / of_input[i]);
  }
  return std::sqrt(largest);
}

double root_mean_square(const std::vector<double>& squared_errors) {
  if (squared_errors.empty()) return kInfinity;
  double sum = 0;
  for (const double error : squared_errors) sum += std::log(error);
  return std::exp(0.5 * sum / static_cast<double>(squared_errors.size()));
}

MeshScore count(const Mesh& mesh, const Settings& settings, const WorkingUnits& units) {
  return {count_beyond(mesh, units, settings.guard, settings.executor()) +
              count_worse(mesh, settings.worst_violation, settings.executor()),
          settings.policy.allows_inversion() ? count_inverted(mesh) : 0,
          count_non_regular_edges(mesh, false, settings.executor()),
          settings.counts_violations() ? count_violations(mesh, settings) : 0, count_bad(mesh, settings.executor())};
}

bool is_unfinished(const Mesh& mesh, const Settings& settings) {
  if (settings.criterion == Criterion::well_centered) return count_bad(mesh, settings.executor()) > 0;
  return !meets(mesh, settings.criterion, settings.executor());
}

std::size_t count_violations(const Mesh& mesh, const Settings& settings) {
  if (settings.criterion == Criterion::well_centered) return count_bad(mesh, settings.executor());
  return violated_edges(mesh, settings.criterion, settings.executor()).size();
}

MeshScore score(const Mesh& mesh, const Settings& settings, const EnergyModel& model, const VertexSizes* sizes,
                const WorkingUnits& units) {
  return score(mesh, count(mesh, settings, units), settings, model, sizes);
}

namespace {

/// Completes a score except for margins and energy.
MeshScore without_energy(const Mesh& mesh, const MeshScore& counts, const Settings& settings) {
  MeshScore s = counts;
  if (settings.policy.keeps_hidden()) s.non_regular = 0;
  if (!settings.energy().barrier) s.bad = 0;
  s.missing_lengths = missing_lengths(mesh, settings.accuracy, settings.executor());
  return s;
}

}  // namespace

MeshScore score(const Mesh& mesh, const MeshScore& counts, const Settings& settings, const EnergyModel& model,
                const VertexSizes* sizes) {
  Executor* const executor = settings.executor();
  if (sizes != nullptr) {
    const bool by_error = settings.errors != nullptr;
    return score(mesh, counts, settings,
                 by_error ? root_mean_square(settings.errors->errors(mesh, nullptr, executor))
                          : accuracy_energy(mesh, *sizes, settings.accuracy, executor));
  }
  MeshScore s = without_energy(mesh, counts, settings);
  s.energy = total_energy(mesh, model, executor);
  return s;
}

MeshScore score(const Mesh& mesh, const MeshScore& counts, const Settings& settings, double energy) {
  MeshScore s = without_energy(mesh, counts, settings);
  s.lacks_margins = !has_margins(mesh, settings.accuracy.margin, settings.executor());
  s.energy = energy;
  return s;
}

}  // namespace temper

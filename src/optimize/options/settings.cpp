#include "optimize/options/settings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mesh/bad_triangles.hpp"
#include "temper/detail/faces.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper {
namespace {

InputError invalid(const std::string& message) { return {ErrorCode::invalid_option, {}, message}; }

LengthParameter in_working_units(LengthParameter s, const WorkingUnits& units) {
  if (s.scale == LengthScale::absolute) s.value /= units.scale;
  return s;
}

/// A combination that options must not have, the sentence of its error, and the cells of the meshes that it is about.
struct Rule {
  bool broken;
  std::string sentence;
  CellKinds cells = CellKinds::triangles;
};
using Rules = std::vector<Rule>;

/// Options that contradict deferred updates.
Rules rules_of_updates(const OptimizeOptions& o) {
  const PaperSwitches& p = o.paper;
  const bool all_deferred = p.position_updates == Updates::deferred;
  const bool weights_deferred = p.weight_updates == Updates::deferred;
  const std::string deferred = all_deferred ? "`position_updates=deferred`" : "`weight_updates=deferred`";
  return {
      {all_deferred && o.unknowns == Unknowns::positions_and_weights && !weights_deferred,
       "`position_updates=deferred` takes all unknowns from the sweep before; expected `weight_updates=deferred` too, "
       "or `unknowns=positions`"},
      {all_deferred && o.size_band,
       "`size_band` needs `position_updates=immediate`: where all move at once sizes are known afterwards"},
      {weights_deferred && p.solver == Solver::newton && !all_deferred,
       "deferred weight updates need positions and weights in turn; expected `solver=alternating` or `solver=golden`"},
      {(all_deferred || weights_deferred) && o.flips == Flips::none,
       deferred + " keeps edges regular by flips alone; expected `flips=immediate` or `flips=deferred`"},
      {all_deferred && p.visits == Visits::twice,
       "`visits=twice` shows weights the new positions, which `position_updates=deferred` keeps from them; expected "
       "`visits=once`"},
  };
}

/// Options that contradict the rules against inverted triangles.
Rules rules_of_inversions(const OptimizeOptions& o) {
  const Inversion inversion = o.paper.inversion;
  const EnergyInfo& last = energy_info(o.energy);
  const EnergyInfo& first = energy_info(o.paper.first_energy.value_or(o.energy));
  return {
      {inversion == Inversion::allow && o.flips != Flips::deferred,
       "`inversion=allow` needs `flips=deferred`, since edges cannot be flipped among inverted triangles; or "
       "`inversion=refuse`"},
      {inversion == Inversion::infinite && !(last.barrier && first.barrier),
       "`inversion=infinite` is for barriers, which energy " + std::string((last.barrier ? first : last).name) +
           " is not; expected `inversion=refuse` or `inversion=allow`"},
      {inversion != Inversion::refuse && o.boundary == BoundaryVertices::slide,
       "`boundary=slide` needs `inversion=refuse`: where triangles may be inverted nothing keeps vertices from passing "
       "a corner"},
      {inversion != Inversion::refuse && o.size_band,
       "`size_band` needs `inversion=refuse`: inverted triangles have no size"},
  };
}

/// Options that contradict coarsening.
Rules rules_of_coarsening(const OptimizeOptions& o) {
  if (!o.coarsen) return {};
  const GuardOptions& g = o.guard;
  return {
      {!energy_info(o.energy).barrier,
       "`coarsen` needs a barrier, which makes triangles well-centered; expected `energy=BP`, `energy=BHs` or "
       "`energy=BH`"},
      {o.flips == Flips::none,
       "`coarsen` changes the connectivity, which `flips=none` keeps; expected `coarsen=none` or `flips=immediate`"},
      {o.unknowns == Unknowns::weights,
       "`coarsen` moves vertices, which `unknowns=weights` keeps in place; expected `coarsen=none` or "
       "`unknowns=positions_and_weights`"},
      {o.size_band.has_value(),
       "`coarsen` makes sizes larger, which `size_band` forbids; expected `coarsen=none` or `size_band=none`"},
      {g.angle > 0 || g.edge > 0 || g.areas || g.length || g.step || g.client != Client::none,
       "`coarsen` makes a coarser mesh, which the guard does not judge; expected a target without a guard"},
      {o.paper.inversion == Inversion::allow || o.paper.hidden == HiddenPolicy::keep,
       "`coarsen` needs regular meshes; expected `inversion=refuse` and `hidden=undo`"},
  };
}

/// Other options that contradict each other, or the accuracy objective.
Rules rules_of_combinations(const OptimizeOptions& o) {
  const bool for_accuracy = objective_of(o) != Objective::energy;
  const EnergyInfo& energy = energy_info(o.energy);
  const std::string changes_connectivity =
      " changes the connectivity, which `flips=none` keeps; expected `flips=immediate` or `flips=deferred`";
  return {
      {o.star == Star::all && !for_accuracy, "`star=all` is for `objective=accuracy`; of an energy expected 0, 1 or 2"},
      {o.flips == Flips::none && o.paper.insertion_from, "`insertion_from`" + changes_connectivity},
      {o.paper.insertion_from && o.size_band,
       "`size_band` does not hold what `insertion_from` inserts; expected one of the two"},
      {o.flips == Flips::none && o.boundary == BoundaryVertices::split, "`boundary=split`" + changes_connectivity},
      {for_accuracy && !energy.barrier,
       "`objective=accuracy` begins with an energy that makes triangles well-centered, which " +
           std::string(energy.name) + " does not; expected `energy=BP`, `energy=BHs` or `energy=BH`"},
      {for_accuracy && o.paper.inversion != Inversion::refuse,
       "`objective=accuracy` needs `inversion=refuse`: its second phase is for well-centered triangles"},
  };
}

/// Options that contradict a run that changes the least.
Rules rules_of_least_change(const OptimizeOptions& o) {
  if (o.change == Change::all) return {};
  OptimizeOptions by_default = o;
  by_default.objective.reset();
  return {
      {objective_of(by_default) == Objective::energy || o.objective == Objective::energy,
       "`change=least` repairs places with energy BP; expected its default, and no switch of the paper but `order` and "
       "`seed`"},
      {o.objective == Objective::solver_error || o.problem,
       "`change=least` lowers no error; expected `change=all` for `objective=solver_error` and for a problem"},
      {o.flips != Flips::immediate, "`change=least` needs `flips=immediate`, since it makes edges regular"},
      {o.coarsen.has_value(), "`coarsen` looks for another mesh; expected `change=all`"},
  };
}

/// Options that contradict each other in meshes of tetrahedra.
Rules rules_of_tetrahedra(const OptimizeOptions& o) {
  constexpr auto kTetrahedra = CellKinds::tetrahedra;
  const bool is_hot = o.energy == EnergyKind::F;
  const bool for_scheme = o.scheme == Scheme::vertex || o.scheme == Scheme::cell;
  const bool may_insert = o.unknowns == Unknowns::positions_and_weights && o.flips != Flips::none;
  return {
      {o.tensor || !o.triangle_tensors.empty(),
       "tensors of triangles are given for tetrahedra. Next: give `tetrahedra_tensors`", kTetrahedra},
      {!o.tetrahedra_tensors.empty(),
       "tensors of tetrahedra are given for triangles. Next: give `tensor` or "
       "`triangle_tensors`",
       CellKinds::triangles},
      {!is_hot && o.star != Star::one, "`star` needs `energy=F` for tetrahedra. Next: add it", kTetrahedra},
      {is_hot && for_scheme,
       "`energy=F` and the target vertex or cell lower different things. Next: leave one of them out", kTetrahedra},
      {o.boundary == BoundaryVertices::split && !(may_insert && o.tets.repair_trials > 0),
       "`boundary=split` inserts vertices, which keep=positions, weights or edges and effort=quick forbid. Next: leave "
       "one of them out",
       kTetrahedra},
  };
}

/// Returns the first vertex with another weight than vertex 0, if there is one.
VertexId first_of_other_weight(const Mesh& mesh) {
  for (const VertexId v : mesh.vertices()) {
    if (mesh.weight(v) != mesh.weight(VertexId(0))) return v;
  }
  return {};
}

/// For one scheme the first sweeps lower E_ODT, unless the user chose others. These sweeps flip edges that keep errors
/// large; sweeps inside the well-centered set cannot. Among 5, 10 and 50, this number gives the best errors and sizes.
/// Six whose steps may cross flips are faster, but leave small margins and bad places on graded meshes.
constexpr int kSweepsOfOdt = 10;

bool begins_with_odt(const Settings& s, const Mesh& mesh) {
  const OptimizeOptions& o = s.options;
  const bool newton = s.policy.solver == Solver::newton && s.policy.flips_at_once() && !s.policy.defers_updates();
  return s.objective != Objective::energy && o.scheme != Scheme::all && !o.paper.first_energy &&
         mesh.space().kind() == SpaceKind::plane && o.unknowns != Unknowns::weights && newton &&
         !first_of_other_weight(mesh).valid();
}

/// Checks the anchor vertex, and weights, which some energies do not use.
std::optional<InputError> check_vertices(const OptimizeOptions& o, const Mesh& mesh) {
  if (o.paper.anchor.valid() && o.paper.anchor.index >= mesh.n_vertices()) {
    return invalid("`anchor` is vertex " + std::to_string(o.paper.anchor.index) + ", but the mesh has " +
                   std::to_string(mesh.n_vertices()) + " vertices");
  }
  const auto first_energy = o.paper.first_energy;
  const bool first = first_energy && energy_info(*first_energy).positions_alone;
  const EnergyInfo& energy = energy_info(first ? *first_energy : o.energy);
  if (!energy.positions_alone) return std::nullopt;
  const std::string name = (first ? "`first_energy=" : "`energy=") + std::string(energy.name) + "`";
  if (o.unknowns == Unknowns::weights) {
    return invalid(name + " is of positions alone; expected `unknowns=positions`");
  }
  if (const VertexId v = first_of_other_weight(mesh); v.valid()) {
    return invalid(name + " is for meshes without weights, or with equal ones; vertex " + std::to_string(v.index) +
                   " has another weight than vertex 0");
  }
  return std::nullopt;
}

/// Refuses options that the sphere or periodic planes do not have.
std::optional<InputError> check_space(const OptimizeOptions& o, const Mesh& mesh) {
  const auto name = [](const Mesh& m) {
    constexpr const char* kNames[] = {"the plane", "the sphere", "a periodic plane"};
    return std::string(kNames[static_cast<std::size_t>(m.space().kind())]);
  };
  if (o.size_field && name(o.size_field->mesh()) != name(mesh)) {
    return invalid("`size_field` is on a mesh of " + name(o.size_field->mesh()) + ", but the mesh is one of " +
                   name(mesh));
  }
  if (o.size_field && mesh.space().is_periodic() && !(o.size_field->mesh().space() == mesh.space())) {
    return invalid("`size_field` is on a mesh with other periods; expected those of the mesh");
  }
  if (mesh.space().kind() == SpaceKind::plane) return std::nullopt;
  const auto not_there = [&](const std::string& option, const std::string& expected) {
    return invalid("`" + option + "` is for meshes of the plane; " +
                   (mesh.space().is_plane() ? "where it is periodic expected " : "on the sphere expected ") + expected);
  };
  if (o.boundary == BoundaryVertices::split) return not_there("boundary=split", "`boundary=keep` or `boundary=slide`");
  if (o.size_band) return not_there("size_band", "none");
  if (o.coarsen) return not_there("coarsen", "none");
  if (o.paper.insertion_from) return not_there("insertion_from", "none");
  if (!mesh.space().is_periodic()) return std::nullopt;
  if (o.paper.inversion == Inversion::allow) return not_there("inversion=allow", "`inversion=refuse`");
  if (objective_of(o) == Objective::solver_error) return not_there("objective=solver_error", "`objective=accuracy`");
  return std::nullopt;
}

/// Says why a run does not lower the error of the user's own problem.
InputError no_use_of_problem(const OptimizeOptions& o, const Mesh& mesh) {
  OptimizeOptions more = o;
  more.solver_error.most_vertices = std::numeric_limits<int>::max();
  if (!wants_error_model(more, mesh) || o.objective == Objective::accuracy) {
    return invalid(
        "this run does not lower the error of a problem; expected the target vertex or cell (--for), the default "
        "objective and energy, and a mesh of the plane");
  }
  if (o.solver_error.most_vertices == 0) {
    return invalid(
        "the effort quick (`solver_error_vertices=0`) does not lower the error of a problem. Next: the effort normal "
        "(--effort normal)");
  }
  return invalid("the mesh has " + std::to_string(mesh.n_vertices()) +
                 " vertices, more than `solver_error_vertices=" + std::to_string(o.solver_error.most_vertices) +
                 "`. Next: `solver_error_vertices=" + std::to_string(mesh.n_vertices()) + "`, which is slow");
}

/// Adds the model of errors that the options need, if the build has one.
Expected<Settings> with_error_model(Settings s, const Mesh& mesh) {
  const OptimizeOptions& o = s.options;
  const bool wants = wants_error_model(o, mesh);
  if (o.problem && (!wants || o.objective == Objective::accuracy)) return no_use_of_problem(o, mesh);
  if (o.problem && !s.hooks.solvers.discretization_error) {
    return invalid(
        "this run cannot lower the error of a problem: it has no solvers. Next: take a build with Eigen, and in C++ "
        "temper::solvers()");
  }
  if (wants && s.hooks.solvers.discretization_error) {
    auto model = s.hooks.solvers.discretization_error(mesh, o, s.hooks.names);
    if (!model) return model.error();
    s.errors = *std::move(model);
  }
  if (s.objective == Objective::accuracy && !o.objective && wants) s.objective = Objective::solver_error;
  s.lacks_discretization_error = wants && s.errors == nullptr;
  if (s.lacks_discretization_error) s.objective = Objective::accuracy;
  return s;
}

}  // namespace

Expected<void> check_together(const OptimizeOptions& options, CellKinds cells) {
  if (auto right = check_options(options, cells); !right) return right;
  for (const auto rules : {rules_of_updates, rules_of_inversions, rules_of_combinations, rules_of_coarsening,
                           rules_of_least_change, rules_of_tetrahedra}) {
    for (const Rule& rule : rules(options)) {
      if (rule.broken && fits(rule.cells, cells)) return invalid(rule.sentence);
    }
  }
  return {};
}

Policy::Policy(const OptimizeOptions& o) : PaperSwitches(o.paper), flips(o.flips) {
  if (switch_at == 0) first_energy.reset();
}

/// A barrier prices every flip, so it needs no limit. HOT is continuous at a flip, so a step may go a little past it.
FlipLimit Policy::flip_limit_for(const EnergyInfo& energy) const {
  if (keeps_connectivity()) return FlipLimit::before;
  return flip_limit.value_or(energy.barrier ? FlipLimit::unlimited : FlipLimit::after);
}

AccuracyModel accuracy_model(const AccuracyOptions& a, Scheme scheme, Star star) {
  const auto i = static_cast<std::size_t>(star);
  const SchemeWeights preset = scheme_weights(scheme);
  AccuracyModel model = AccuracyModel::of(kAlpha[i], kBeta[i], a.offset_factor.value_or(preset.offset_factor),
                                          a.boundary_offset_factor.value_or(preset.boundary_offset_factor));
  model.margin = a.margin.value_or(preset.margin);
  model.barrier = a.barrier;
  model.min_edge = a.min_edge, model.min_dual = a.min_dual;
  return model;
}

SchemeWeights scheme_weights(Scheme scheme) {
  constexpr SchemeWeights kWeights[] = {{10, 5, 0.1}, {10, 0.5, 0.02}, {10, 30, 0.02}, {20, 18, 0.02}};
  return kWeights[static_cast<std::size_t>(scheme)];
}

Objective objective_of(const OptimizeOptions& o) {
  if (o.objective) return *o.objective;
  PaperSwitches plain;
  plain.order = o.paper.order;
  plain.seed = o.paper.seed;
  if (o.energy != EnergyKind::BP || !(o.paper == plain)) return Objective::energy;
  return Objective::accuracy;
}

bool may_lower_solver_error(const OptimizeOptions& o) {
  const Objective objective = objective_of(o);
  const bool of_one = o.change == Change::all && (o.scheme == Scheme::vertex || o.scheme == Scheme::cell);
  return objective == Objective::solver_error ||
         (objective == Objective::accuracy && of_one && o.solver_error.most_vertices > 0);
}

bool wants_error_model(const OptimizeOptions& o, const Mesh& mesh) {
  const bool fits = mesh.space().kind() == SpaceKind::plane &&
                    mesh.n_vertices() <= static_cast<std::size_t>(o.solver_error.most_vertices);
  return may_lower_solver_error(o) && (fits || objective_of(o) == Objective::solver_error);
}

std::vector<std::string> problem_warnings(const Mesh& mesh, const DiffusionProblem& problem) {
  std::size_t free = 0;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (problem.coefficient.empty() || mesh.is_unflippable(h) || !mesh.is_edge_representative(h)) continue;
    const auto k_of = [&](HalfedgeId side) { return problem.coefficient[Mesh::triangle(side).index]; };
    free += k_of(h) != k_of(mesh.twin(h)) ? 1 : 0;
  }
  if (free == 0) return {};
  return {"the coefficient changes across " + std::to_string(free) +
          (free == 1 ? " edge inside a region, which may move" : " edges inside a region, which may move") +
          ". Next: give each coefficient its own region"};
}

SweepState::SweepState(const Settings& s) : model(s.model), relaxation(s.policy.relaxation.value_or(kRelaxation)) {
  set_energy(model.kind, s.policy);
}

void SweepState::set_energy(EnergyKind kind, const Policy& policy) {
  energy = energy_info(kind);
  model.kind = kind;
  flip_limit = policy.flip_limit_for(energy);
}

double SweepState::energy_unit(const WorkingUnits& units) const {
  constexpr double kAccuracyExponent = 2;
  return std::pow(units.scale, accuracy_domain != nullptr ? kAccuracyExponent : energy.length_exponent);
}

Unknowns unknowns_of_sweep(const Settings& s, const EnergyInfo& energy, int sweep) {
  if (energy.positions_alone) return Unknowns::positions;
  const bool waits = s.options.unknowns == Unknowns::positions_and_weights && sweep < s.policy.weights_from;
  return waits ? Unknowns::positions : s.options.unknowns;
}

EnergyModel in_user_units(EnergyModel model, const WorkingUnits& units) {
  for (LengthParameter* s : {&model.gamma, &model.h0}) {
    if (s->scale == LengthScale::absolute) s->value *= units.scale;
  }
  return model;
}

Expected<Settings> make_settings(const OptimizeOptions& options, const Mesh& mesh, const WorkingUnits& units,
                                 const OptimizeHooks& hooks) {
  if (auto right = check_together(options, CellKinds::triangles); !right) return right.error();
  if (auto error = check_vertices(options, mesh)) return *std::move(error);
  if (auto error = check_space(options, mesh)) return *std::move(error);

  Settings s;
  s.options = options;
  if (has_quadrilaterals(mesh)) s.options.unknowns = Unknowns::positions;  // one center each, of equal weights
  if (options.coarsen && s.options.unknowns != options.unknowns) {
    return invalid("`coarsen` is for triangles, but the mesh has quadrilaterals; expected `coarsen=none`");
  }
  s.hooks = hooks;
  s.objective = objective_of(options);
  if (s.changes_least() || keeps_faces(mesh)) s.criterion = criterion_of(options);
  s.policy = Policy(options);
  if (begins_with_odt(s, mesh)) {
    s.policy.first_energy = EnergyKind::ODT;
    s.policy.switch_at = kSweepsOfOdt;
  }
  const PaperSwitches& p = options.paper;
  s.model.kind = options.energy;
  s.model.star = s.objective != Objective::energy ? Star::one : options.star;
  s.model.boundary_treatment = p.boundary_treatment;
  s.collapse_model = s.model;
  s.collapse_model.kind = p.collapse_energy;
  s.model.wall = !s.policy.allows_inversion();
  if (p.gamma) s.model.gamma = in_working_units(*p.gamma, units);
  if (p.h0) s.model.h0 = in_working_units(*p.h0, units);
  s.accuracy = accuracy_model(options.accuracy, options.scheme, options.star);
  if (hooks.solvers.lp) s.lp = hooks.solvers.lp();
  return with_error_model(std::move(s), mesh);
}

}  // namespace temper

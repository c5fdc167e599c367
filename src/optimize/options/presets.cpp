// Words of a user that set several options: the target of a mesh, the effort of a run, the parts of a mesh to keep.
// docs/explanation/measured.md has the measurements behind them.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/detail/suggest.hpp"

namespace temper {
namespace {

using Options = OptimizeOptions;
constexpr auto kForAll = CellKinds::all;
constexpr auto kForBoth = CellKinds::both;
constexpr auto kForTriangles = CellKinds::triangles;

/// Grading that --keep sizes allows: sizes stay within this factor of the sizes of the input.
constexpr double kBandOfSizes = 2;

/// Least lengths over the local size that solvers with explicit time steps need.
constexpr double kLongEdge = 0.75, kLongDual = 0.3;

/// Each repair counts as a sweep, and places without weights need many.
constexpr int kSweepsWithRepairs = 4000;

void move_positions_alone(Options& o) { o.unknowns = Unknowns::positions; }

/// For solvers that use circumcenters, or no dual: positions alone, with edges of at least these lengths.
void place_vertices(Options& o, double min_dual) {
  move_positions_alone(o);
  o.repair = Repair::vertices;
  o.max_sweeps = kSweepsWithRepairs;
  o.accuracy.min_edge = kLongEdge;
  o.accuracy.min_dual = min_dual;
}

/// No angle, edge, ratio of areas or time step becomes worse than in the input, and no measure of the client.
void keep_measures(Options& o, Client client) {
  o.guard.client = client;
  o.guard.angle = 60;
  o.guard.edge = 1;
  o.guard.areas = 1;
}

constexpr auto kTargets = std::to_array<Preset>({
    {"any", "Any solver on a dual mesh: large margins, smaller errors", kForAll, [](Options&) {}},
    {"valid", "Valid triangles alone: as any, but only bad places change", kForBoth,
     [](Options& o) { o.change = Change::least; }},
    {"vertex", "Unknowns at vertices: MODFLOW, DEVSIM, exterior calculus", kForAll,
     [](Options& o) { o.scheme = Scheme::vertex; }},
    {"cell", "Unknowns in triangles, two-point flux: PorePy, FiPy", kForAll,
     [](Options& o) { o.scheme = Scheme::cell; }},
    {"stars", "Diagonal Hodge stars of exterior calculus", CellKinds::all_triangles,
     [](Options& o) { o.scheme = Scheme::stars; }},
    {"mpas", "MPAS: no weights, centered edges; may add and remove vertices", kForTriangles,
     [](Options& o) {
       place_vertices(o, kLongDual);
       keep_measures(o, Client::mpas);
       o.star = Star::zero;
     }},
    {"dflowfm", "D-Flow FM: no weights, orthogonal; may add and remove vertices", kForTriangles,
     [](Options& o) {
       place_vertices(o, kLongDual);
       keep_measures(o, Client::dflowfm);
     }},
    {"adcirc", "ADCIRC, SCHISM: no weights, long edges; may add and remove vertices", kForTriangles,
     [](Options& o) {
       place_vertices(o, 0);
       keep_measures(o, Client::adcirc);
     }},
    {"fem", "Linear finite elements: no weights, good angles, the same vertices", kForTriangles,
     [](Options& o) {
       move_positions_alone(o);
       keep_measures(o, Client::fem);
       o.scheme = Scheme::vertex;
       o.objective = Objective::accuracy;
       o.accuracy.min_edge = kLongEdge;
     }},
    {"paper",
     "Algorithm 1 of the paper: golden section, deferred flips, collapses, the patch test, inversions, the first "
     "vertex as anchor and gamma 1",
     kForTriangles,
     [](Options& o) {
       o.flips = Flips::deferred;
       o.repair = Repair::none;
       PaperSwitches& p = o.paper;
       p.gamma = LengthParameter{1, LengthScale::absolute};
       p.solver = Solver::golden;
       p.inner = 0;
       p.flip_limit = FlipLimit::unlimited;
       p.inversion = Inversion::allow;
       p.hidden = HiddenPolicy::keep;
       p.order = SweepOrder::input;
       p.anchor = VertexId(0);
       p.collapse_from = 0;
       p.removal = Removal::patch;
       p.removal_measure = RemovalMeasure::sum;
       p.removal_margin = 0;
       p.removal_from = 0;
       p.stopping = StoppingRule::paper;
       p.tolerance = 1e-6;
     },
     true},
    {"odt",
     "Optimal Delaunay triangulation (Chen and Xu 2004): positions alone lower energy ODT. All weights must be equal",
     kForTriangles,
     [](Options& o) {
       move_positions_alone(o);
       o.energy = EnergyKind::ODT;
     },
     true},
    // The energy is the moment of the Voronoi cells about their vertices. Lloyd's iterations lower the same energy.
    {"cvt", "Centroidal Voronoi tessellation (Du, Faber and Gunzburger 1999): positions alone lower energy F of star 0",
     kForTriangles,
     [](Options& o) {
       move_positions_alone(o);
       o.energy = EnergyKind::F;
       o.star = Star::zero;
     },
     true},
});

constexpr auto kEfforts = std::to_array<Preset>({
    {"quick", "Few sweeps and repairs, in about half of the time", kForAll,
     [](Options& o) {
       o.accuracy.sweeps = std::min(o.accuracy.sweeps, 5);
       o.repair_trials = 2000;
       o.solver_error.most_vertices = 0;
       o.tets.repair_trials = o.tets.most_error_vertices = 0;
       o.tets.accuracy_steps = 30;
     },
     false, "fast faster fastest low lowest small min minimal short"},
    {"normal", "Sweeps until little is gained. Targets vertex and cell also lower the error of the solver itself",
     kForAll, [](Options&) {}, false, "default medium middle usual standard"},
    {"high", "More sweeps and repairs, which may add and remove vertices. More steps lower the solver's own error",
     kForAll,
     [](Options& o) {
       o.accuracy.sweeps = 200;
       o.accuracy.tolerance = 1e-7;
       o.repair = Repair::vertices;
       o.repair_trials = 100'000;
       o.solver_error.steps = 200;
       o.solver_error.most_vertices = 1'000'000;
       o.tets = {.repair_trials = 40,
                 .patches = Patches::each,
                 .small_margin = 0.01,
                 .accuracy_steps = 1000,
                 .most_error_vertices = 100'000};
     },
     false, "best better slow max maximal maximum thorough full long"},
});

constexpr auto kKeeps = std::to_array<Preset>({
    {"positions", "All vertices stay, and only weights change", kForAll,
     [](Options& o) {
       o.unknowns = Unknowns::weights;
       if (o.boundary == BoundaryVertices::slide) o.boundary = BoundaryVertices::keep;
     }},
    {"weights", "All weights stay, and only positions change", kForBoth, move_positions_alone},
    {"edges", "No edge flips", kForAll, [](Options& o) { o.flips = Flips::none; }},
    {"boundary", "Vertices of the boundary and of interfaces stay", kForAll,
     [](Options& o) {
       o.boundary = BoundaryVertices::keep;
       o.interfaces = InterfaceVertices::fixed;
     }},
    {"sizes", "Local sizes stay within a factor of 2", kForTriangles, [](Options& o) { o.size_band = kBandOfSizes; }},
});

/// The solvers of docs/howto/choose.md.
constexpr auto kSolvers = std::to_array<SolverName>({
    {"modflow", {}, "target vertex with power cells on the mesh, target cell with triangles as cells"},
    {"modflow6", {}, "target vertex with power cells on the mesh, target cell with triangles as cells"},
    {"tough", "vertex"},
    {"tough2", "vertex"},
    {"tough3", "vertex"},
    {"devsim", {}, "target vertex. Without temper's couples and volumes, also keep the weights (--keep weights)"},
    {"porepy", "cell"},
    {"fipy", "cell"},
    {"pydec", {}, "target vertex for functions, target stars for forms on edges or triangles"},
    {"decapodes", {}, "target vertex for functions, target stars for forms on edges or triangles"},
    {"landlab",
     {},
     "target vertex and weights that are kept (--for vertex --keep weights), since Landlab has no place for weights"},
    {"pytdgl",
     {},
     "target vertex and weights that are kept (--for vertex --keep weights), since pyTDGL has no place for weights"},
    {"mpas", "mpas"},
    {"d-flow-fm", "dflowfm"},
    {"adcirc", "adcirc"},
    {"schism", "adcirc"},
    {"scikit-fem", "fem"},
    {"skfem", "fem"},
    {"fenics", "fem"},
    {"mfem", "fem"},
    {"sfepy", "fem"},
});

/// Letters and digits alone, in lower case.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if ((lower >= 'a' && lower <= 'z') || (lower >= '0' && lower <= '9')) plain += lower;
  }
  return plain;
}

/// Returns the preset of this name, or an error that lists the names.
Expected<const Preset*> find(std::span<const Preset> presets, std::string_view what, std::string_view name) {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets) {
    if (preset.name == name) return &preset;
    names.push_back(preset.name);
  }
  return InputError{ErrorCode::invalid_option,
                    {},
                    std::string(what) + " is '" + std::string(name) + "'; expected one of " + join(names) +
                        did_you_mean(name, presets)};
}

InputError contradiction(const std::string& word, const OptionRow& row, const OptimizeOptions& options) {
  return {ErrorCode::invalid_option,
          {},
          word + " contradicts `" + std::string(row.name) + "=" + option_text(row, row.get(options)) +
              "`; expected one of the two"};
}

bool changes(const Preset& preset, Unknowns unknowns) {
  Options options;
  preset.apply(options);
  return options.unknowns == unknowns;
}

}  // namespace

std::span<const Preset> targets() { return kTargets; }
std::span<const Preset> efforts() { return kEfforts; }
std::span<const Preset> keeps() { return kKeeps; }
std::span<const SolverName> solver_names() { return kSolvers; }

const SolverName* find_solver(std::string_view name) {
  const std::string plain = plain_name(name);
  for (const SolverName& solver : kSolvers) {
    if (plain_name(solver.name) == plain) return &solver;
  }
  return nullptr;
}

std::string did_you_mean(std::string_view word, std::span<const Preset> presets) {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets) names.push_back(preset.name);
  if (presets.data() == kTargets.data()) {
    for (const SolverName& solver : kSolvers) names.push_back(solver.name);
  }
  for (const Preset& preset : presets) {
    const std::string padded = " " + std::string(preset.synonyms) + " ";
    if (!word.empty() && padded.find(" " + plain_name(word) + " ") != std::string::npos)
      return "; did you mean '" + std::string(preset.name) + "'?";
  }
  return did_you_mean(word, names);
}

Expected<std::string_view> target_named(std::string_view word) {
  const SolverName* const solver = find_solver(word);
  if (solver == nullptr) {
    const Expected<const Preset*> target = find(kTargets, "target", word);
    return target ? Expected<std::string_view>((*target)->name) : target.error();
  }
  if (!solver->target.empty()) return solver->target;
  return InputError{
      ErrorCode::invalid_option,
      {},
      "'" + std::string(word) + "' stands for no target of its own; expected " + std::string(solver->uses)};
}

Expected<OptimizeOptions> options_for(std::string_view target, std::string_view effort,
                                      std::span<const std::string_view> keep) {
  Options options;
  const Expected<std::string_view> named = target_named(target);
  if (!named) return named.error();
  const Expected<const Preset*> wanted = find(kTargets, "target", *named);
  (*wanted)->apply(options);
  const Expected<const Preset*> time = find(kEfforts, "effort", effort);
  if (!time) return time.error();
  if ((*wanted)->research && effort != "normal") {
    return InputError{ErrorCode::invalid_option,
                      {},
                      "effort '" + std::string(effort) + "' is not for target '" + std::string(target) +
                          "', which is a method of research; expected effort 'normal'"};
  }
  (*time)->apply(options);
  for (const std::string_view name : keep) {
    const Expected<const Preset*> part = find(kKeeps, "keep", name);
    if (!part) return part.error();
    const bool moves = options.unknowns == Unknowns::positions, weighs = options.unknowns == Unknowns::weights;
    if ((moves && changes(**part, Unknowns::weights)) || (weighs && changes(**part, Unknowns::positions))) {
      const bool by_target = changes(**wanted, Unknowns::positions);
      return InputError{ErrorCode::invalid_option,
                        {},
                        by_target ? "target '" + std::string(target) + "' moves positions and keeps weights, so that " +
                                        "positions cannot be kept; expected another target, or no 'positions' to keep"
                                  : "positions and weights are both to be kept, so that nothing can change; expected "
                                    "one of the two"};
    }
    (*part)->apply(options);
  }
  return options;
}

Expected<void> check_target(const OptimizeOptions& options, std::string_view target) {
  const Expected<OptimizeOptions> wanted = options_for(target);
  if (!wanted) return wanted.error();
  for (const std::string_view name : {"scheme", "unknowns"}) {
    const OptionRow& row = *find_option(name);
    const OptionValue value = row.get(*wanted);
    if (value == row.get({}) || value == row.get(options)) continue;
    return contradiction("target '" + std::string(target) + "', which stands for `" + std::string(name) + "=" +
                             option_text(row, value) + "`,",
                         row, options);
  }
  return {};
}

Criterion criterion_of_target(std::string_view target) {
  const Expected<OptimizeOptions> options = options_for(target);
  return options ? criterion_of(*options) : Criterion::well_centered;
}

Criterion criterion_of(const OptimizeOptions& options) {
  return options.unknowns == Unknowns::positions ? Criterion::well_centered : criterion_of(options.scheme);
}

Expected<void> check_kept(const OptimizeOptions& options, std::span<const std::string_view> keep) {
  for (const std::string_view name : keep) {
    const Expected<const Preset*> part = find(kKeeps, "keep", name);
    if (!part) return part.error();
    Options kept = options;
    (*part)->apply(kept);
    for (const OptionRow& row : option_rows()) {
      if (row.get(options) == row.get(kept)) continue;
      return contradiction("keep '" + std::string(name) + "'", row, options);
    }
  }
  return {};
}

}  // namespace temper

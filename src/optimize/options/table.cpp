// Each option once: name, effect, range, and options that it needs to have an effect. Its field has the default.
#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "energy/edge_kernels.hpp"
#include "optimize/options/settings.hpp"
#include "temper/detail/optimize_table.hpp"

namespace temper {
namespace {

// --- names of enumerators, in their order --------------------------------------------------------------

using Name = std::string_view;
using Options = OptimizeOptions;

constexpr auto names_of(EnergyKind) {
  std::array<Name, kEnergyKinds> names;
  for (std::size_t i = 0; i < kEnergyKinds; ++i) names[i] = kEnergies[i].name;
  return names;
}
constexpr auto names_of(Star) { return std::to_array<Name>({"0", "1", "2", "3", "all"}); }
constexpr auto names_of(BoundaryTreatment) { return std::to_array<Name>({"as_is", "absolute", "mirrored"}); }
constexpr auto names_of(Objective) { return std::to_array<Name>({"energy", "accuracy", "solver_error"}); }
constexpr auto names_of(Scheme) { return std::to_array<Name>({"all", "vertex", "cell", "stars"}); }
constexpr auto names_of(Solver) { return std::to_array<Name>({"newton", "golden", "alternating"}); }
constexpr auto names_of(Unknowns) { return std::to_array<Name>({"positions_and_weights", "positions", "weights"}); }
constexpr auto names_of(Flips) { return std::to_array<Name>({"immediate", "deferred", "none"}); }
constexpr auto names_of(FlipLimit) { return std::to_array<Name>({"unlimited", "before", "at", "after"}); }
constexpr auto names_of(Repair) { return std::to_array<Name>({"none", "perturb", "vertices"}); }
constexpr auto names_of(BoundaryVertices) { return std::to_array<Name>({"keep", "slide", "split"}); }
constexpr auto names_of(InterfaceVertices) { return std::to_array<Name>({"fixed", "sliding"}); }
constexpr auto names_of(Change) { return std::to_array<Name>({"all", "least"}); }
constexpr auto names_of(Updates) { return std::to_array<Name>({"immediate", "deferred"}); }
constexpr auto names_of(Visits) { return std::to_array<Name>({"once", "twice"}); }
constexpr auto names_of(SearchRadius) { return std::to_array<Name>({"rms", "max", "min"}); }
constexpr auto names_of(Removal) { return std::to_array<Name>({"none", "patch", "weight"}); }
constexpr auto names_of(RemovalMeasure) { return std::to_array<Name>({"sum", "mean", "excess"}); }
constexpr auto names_of(InsertionPlace) {
  return std::to_array<Name>({"best", "orthocenter", "circumcenter", "centroid"});
}
constexpr auto names_of(HiddenPolicy) { return std::to_array<Name>({"undo", "remove", "keep"}); }
constexpr auto names_of(Inversion) { return std::to_array<Name>({"refuse", "allow", "infinite"}); }
constexpr auto names_of(SweepOrder) { return std::to_array<Name>({"hilbert", "input", "reverse", "random"}); }
constexpr auto names_of(Client) { return std::to_array<Name>({"none", "fem", "adcirc", "dflowfm", "mpas"}); }
constexpr auto names_of(Patches) { return std::to_array<Name>({"shared", "each"}); }
constexpr auto names_of(StoppingRule) { return std::to_array<Name>({"relative", "paper"}); }
template <class Enum>
constexpr auto kNames = names_of(Enum());

// --- rows from fields ------------------------------------------------------------------------------------

template <class T>
struct Without {  // the type inside of an optional
  using Type = T;
  static constexpr bool optional = std::is_same_v<T, VertexId>;
};
template <class T>
struct Without<std::optional<T>> {
  using Type = T;
  static constexpr bool optional = true;
};

template <class T>
OptionValue value_of(const T& field) {
  if constexpr (std::is_enum_v<T>) {
    return kNames<T>[static_cast<std::size_t>(field)];
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<std::int64_t>(field);
  } else if constexpr (std::is_same_v<T, VertexId>) {
    return field.valid() ? OptionValue(field) : OptionValue();
  } else {
    return field;
  }
}
template <class T>
OptionValue value_of(const std::optional<T>& field) {
  return field ? value_of(*field) : OptionValue();
}

template <class T>
T field_of(const OptionValue& value) {
  if constexpr (std::is_enum_v<T>) {
    std::size_t i = 0;
    while (kNames<T>[i] != *std::get_if<Name>(&value)) ++i;
    return static_cast<T>(i);
  } else if constexpr (std::is_integral_v<T>) {
    return static_cast<T>(*std::get_if<std::int64_t>(&value));
  } else {
    return *std::get_if<T>(&value);
  }
}

template <class T>
constexpr OptionKind kind_of() {
  static_assert(!std::is_same_v<T, bool>, "a switch is an enum with two names");
  if (std::is_enum_v<T>) return OptionKind::choice;
  if (std::is_integral_v<T>) return OptionKind::count;
  if (std::is_same_v<T, LengthParameter>) return OptionKind::length_parameter;
  return std::is_same_v<T, VertexId> ? OptionKind::vertex : OptionKind::number;
}

/// The field at the end of a path of members.
template <auto... path>
constexpr auto& field(auto& options) {
  // clang-format off
  return (options .* ... .* path);
  // clang-format on
}

/// The row of the field at the end of a path.
template <auto... path>
constexpr OptionRow row(Name name, Name sentence, OptionRow more = {}) {
  using Field = std::remove_reference_t<decltype(field<path...>(std::declval<Options&>()))>;
  using T = typename Without<Field>::Type;
  more.name = name;
  more.sentence = sentence;
  more.kind = kind_of<T>();
  more.optional = Without<Field>::optional;
  more.research = (std::is_same_v<decltype(path), PaperSwitches OptimizeOptions::*> || ...);
  if constexpr (std::is_enum_v<T>) {
    if (more.choices.empty()) more.choices = kNames<T>;
  }
  if (more.kind == OptionKind::count) more.range.low = std::max(0.0, more.range.low);
  if (std::is_same_v<T, int>) more.range.high = std::numeric_limits<int>::max();
  more.get = [](const Options& o) { return value_of(field<path...>(o)); };
  more.set = [](Options& o, const OptionValue& value) {
    field<path...>(o) = std::holds_alternative<std::monostate>(value) ? Field() : Field(field_of<T>(value));
  };
  return more;
}

// --- the rows ----------------------------------------------------------------------------------------------

using Accuracy = AccuracyOptions;
using Error = SolverErrorOptions;
using Paper = PaperSwitches;
constexpr auto kAccuracy = &Options::accuracy;
constexpr auto kError = &Options::solver_error;
constexpr auto kPaper = &Options::paper;
constexpr auto kGuard = &Options::guard;
constexpr auto kTets = &Options::tets;
constexpr auto kSurfaces = &Options::surfaces;
constexpr auto kBoth = CellKinds::both;
constexpr auto kAll = CellKinds::all;

constexpr OptionRange at_least(double low) { return {.low = low}; }
constexpr OptionRange more_than(double low) { return {.low = low, .open = true}; }
constexpr OptionRange inside(double low, double high) { return {low, high, true}; }
constexpr OptionRange from_to(double low, double high) { return {low, high}; }

constexpr double kMostMargin = 0.25;                  // equilateral triangles have the largest h/ℓ, 0.289
constexpr double kMostEdge = 0.95, kMostDual = 0.55;  // equilateral triangles have 1 and 0.577 local sizes
constexpr double kLeastBoundaryRatio = 2;             // a cut in the middle leaves edges of half the length

/// "BH|BHs|BP": the energies that have the property.
template <bool EnergyInfo::*property>
constexpr auto kJoinedNames = [] {
  struct {
    std::array<char, 8 * kEnergyKinds> text{};
    std::size_t size = 0;
  } joined;
  for (const EnergyInfo& energy : kEnergies) {
    if (!(energy.*property)) continue;
    if (joined.size > 0) joined.text[joined.size++] = '|';
    for (const char c : energy.name) joined.text[joined.size++] = c;
  }
  return joined;
}();
template <bool EnergyInfo::*property>
constexpr OptionNeed kEnergyThat = {"energy", {kJoinedNames<property>.text.data(), kJoinedNames<property>.size}};

bool lowers_accuracy(const Options& o) { return objective_of(o) != Objective::energy; }
constexpr OptionNeed kForAccuracy = {"objective", "accuracy", lowers_accuracy};
constexpr OptionNeed kForError = {"objective", "solver_error", may_lower_solver_error};
constexpr OptionNeed kBarrier = kEnergyThat<&EnergyInfo::barrier>;
constexpr OptionNeed kDeferredFlips = {"flips", "deferred"};
constexpr OptionNeed kCollapses = {"collapse_from", ""};
constexpr OptionNeed kRemovals = {"removal", "patch|weight"};
constexpr OptionNeed kGolden = {"solver", "golden"};
constexpr OptionNeed kInsertions = {"insertion_from", ""};

bool limits_after_flips(const Options& o) {
  return Policy(o).flip_limit_for(energy_info(o.energy)) == FlipLimit::after;
}
bool inserts_vertices(const Options& o) { return o.repair == Repair::vertices || o.paper.insertion_from; }
bool compares_patches(const Options& o) { return o.paper.removal == Removal::patch || o.paper.insertion_from; }
bool makes_golden_searches(const Options& o) { return o.paper.solver == Solver::golden || o.paper.collapse_from; }

constexpr OptionRow kEnergyRows[] = {
    row<&Options::energy>("energy",
                          "Energy to lower. Barriers: BH, BHs, BP. HOT energies: F, T, dT. HOT energies over squared "
                          "areas: nF, nT, ndT. Optimal Delaunay triangulation: ODT",
                          {.cells = kBoth, .for_tetrahedra = "F|BP"}),
    row<&Options::star>("star",
                        "Hodge star whose error should be small. all: the three at once, except with "
                        "`objective=energy`. The first sweeps for accuracy always use star 1. Star 3 is for "
                        "tetrahedra, for which only `energy=F` has stars",
                        {.cells = kBoth, .for_triangles = "0|1|2|all", .for_tetrahedra = "0|1|2|3"}),
    row<kPaper, &Paper::gamma>("gamma", "Parameter gamma of E_BP",
                               {.range = more_than(0),
                                .absent = "gamma is relative to each edge. It shrinks to 0.003, from 1 if many "
                                          "triangles are bad, otherwise from 0.5",
                                .needs = {kEnergyThat<&EnergyInfo::softened_by_gamma>}}),
    row<kPaper, &Paper::h0>("h0", "Parameter -h0 of E_BHs, at least 0. E_BHs keeps h above h0",
                            {.range = at_least(0),
                             .absent = "h0 is just below the least h of the mesh. It rises with the least h",
                             .needs = {kEnergyThat<&EnergyInfo::softened_by_h0>}}),
    row<kPaper, &Paper::boundary_treatment>(
        "boundary_treatment",
        "Height of boundary edges in energies F and nF. `boundary_treatment=as_is`: h itself. absolute: |h|. mirrored: "
        "as if the mesh were mirrored there",
        {.needs = {{{"energy", "F|nF"}}}}),
    row<kPaper, &Paper::first_energy>("first_energy",
                                      "Energy that the first sweeps lower, before they switch to `energy`",
                                      {.absent = "`energy` from the first sweep on. If `scheme` is one scheme and a "
                                                 "mesh of the plane has no weights, ten sweeps lower ODT first"}),
    row<kPaper, &Paper::switch_at>("switch_at",
                                   "First sweep that lowers `energy` after `first_energy`, counted from 0. The switch "
                                   "comes earlier if the first energy has converged",
                                   {.needs = {{{"first_energy", ""}}}}),
};

constexpr OptionRow kAccuracyRows[] = {
    row<&Options::objective>(
        "objective",
        "Objective of the run. energy: lower `energy` to the end. accuracy: once all triangles are well-centered, "
        "lower the distances between the midpoints of edges and duals. With `objective=solver_error` a third phase "
        "lowers the error of the solver itself. It takes longer",
        {.absent =
             "accuracy. With `scheme=vertex` or `scheme=cell`, on a plane with at most `solver_error_vertices`, it is "
             "`objective=solver_error`. If `energy` is not BP, or a switch of the paper other than `order` and "
             "`seed` is set, it is energy"}),
    row<&Options::scheme>("scheme",
                          "Scheme of the solver. vertex: unknowns at vertices. cell: unknowns at orthocenters, "
                          "two-point flux. stars: diagonal Hodge stars. all: each of these, with larger margins",
                          {.cells = kAll, .for_tetrahedra = "all|vertex|cell", .needs = {kForAccuracy}}),
    row<&Options::change>("change",
                          "Part of the mesh that may change. least: only the places that violate what `scheme` needs. "
                          "All else stays, bit for bit, unless many places are bad, or stay bad",
                          {.cells = kBoth, .common = true}),
    row<kAccuracy, &Accuracy::margin>(
        "margin", "Least margin in every triangle: h/l, d/l and 1 - d/l stay above it",
        {.range = inside(0, kMostMargin), .absent = "0.1, or 0.02 if `scheme` is one scheme", .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::min_edge>("min_edge", "Least length of interior edges, as a multiple of the local size",
                                        {.range = from_to(0, kMostEdge), .common = true, .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::min_dual>("min_dual",
                                        "Least length of interior dual edges, as a multiple of the local size",
                                        {.range = from_to(0, kMostDual), .common = true, .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::offset_factor>(
        "offset_factor", "Factor of the offset between the midpoints of edge and dual. 1: HOT over the squared size",
        {.range = at_least(0), .absent = "10, or 20 for `scheme=stars`", .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::boundary_offset_factor>(
        "boundary_offset_factor", "Factor of the height of boundary edges, relative to HOT",
        {.range = at_least(0),
         .absent = "5 for `scheme=all`, 0.5 for vertex, 30 for cell, 18 for stars",
         .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::barrier>("barrier", "Factor of the logarithms that keep margins and least lengths",
                                       {.range = more_than(0), .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::sweeps>("accuracy_sweeps",
                                      "Largest number of sweeps for accuracy. They follow the sweeps for `energy`",
                                      {.needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::tolerance>(
        "accuracy_tolerance", "Relative tolerance for accuracy. The sweeps end when one gains less than this part",
        {.range = at_least(0), .needs = {kForAccuracy}}),
    row<kError, &Error::offset_share>("offset_share",
                                      "Factor of the accuracy objective, which is lowered together with the error of "
                                      "the solver. It keeps other errors from rising",
                                      {.range = at_least(0), .needs = {kForError}}),
    row<kError, &Error::steps>(
        "solver_error_steps",
        "Largest number of steps for the error of the solver. Each moves all vertices at once, after all other sweeps",
        {.needs = {kForError}}),
    row<kError, &Error::tolerance>(
        "solver_error_tolerance",
        "Relative tolerance for the error of the solver. The steps end when ten of them gain less than this part",
        {.range = at_least(0), .needs = {kForError}}),
    row<kError, &Error::most_vertices>(
        "solver_error_vertices",
        "Largest number of vertices for which the error of the solver is lowered, if `objective` is auto",
        {.needs = {kForAccuracy}}),
};

constexpr OptionRow kMoveRows[] = {
    row<kPaper, &Paper::solver>(
        "solver",
        "Method that improves one vertex. newton: Newton steps in position and weight together. golden: the paper's "
        "golden section. alternating: Newton in position, then in weight"),
    row<&Options::unknowns>("unknowns", "Unknowns that steps may change. The others keep their values",
                            {.cells = kAll, .for_surfaces = "positions_and_weights|weights"}),
    row<kPaper, &Paper::weights_from>("weights_from", "First sweep that changes weights, counted from 0",
                                      {.needs = {{{"unknowns", "positions_and_weights"}}}}),
    row<kPaper, &Paper::relaxation>("relaxation", "Over-relaxation of Newton steps",
                                    {.range = inside(0, 2),
                                     .absent = "1.7, or 1.97 while gamma shrinks from 1",
                                     .needs = {{{"solver", "newton|alternating"}}}}),
    row<kPaper, &Paper::search_radius>("search_radius",
                                       "Radius of golden section for positions. rms: root mean square distance to the "
                                       "neighbors. max: distance to the farthest one. min: distance to the nearest one",
                                       {.needs = {{{"solver", "golden", makes_golden_searches}}}}),
    row<kPaper, &Paper::weight_search_radius>(
        "weight_search_radius",
        "Radius of golden section for weights, as a multiple of the squared radius for positions",
        {.range = more_than(0), .needs = {kGolden}}),
    row<kPaper, &Paper::visits>(
        "visits", "Number of visits to each vertex in one sweep. twice: first all positions, then all weights",
        {.needs = {{{"unknowns", "positions_and_weights"}}}}),
    row<kPaper, &Paper::anchor>("anchor", "Vertex that has weight 0 after each sweep. All weights are shifted for this",
                                {.absent_name = "none", .absent = "weights are not shifted"}),
};

constexpr OptionRow kConnectivityRows[] = {
    row<&Options::flips>("flips",
                         "Time at which edges flip. immediate: at once. deferred: after the inner sweeps. none: never. "
                         "Then the connectivity stays, and no step may make an edge non-regular",
                         {.cells = kAll, .for_tetrahedra = "immediate|none", .for_surfaces = "immediate|none"}),
    row<kPaper, &Paper::flip_limit>(
        "flip_limit",
        "Limit of a step that makes an edge flip. The step ends before, at or after the flip, or is unlimited",
        {.absent = "unlimited for barriers, after for HOT", .needs = {{{"flips", "immediate|deferred"}}}}),
    row<kPaper, &Paper::overshoot>(
        "overshoot",
        "Length of a step with `flip_limit=after` in the first sweep, as a multiple of the way to the flip",
        {.range = more_than(0),
         .needs = {{{"flips", "immediate|deferred"}, {"flip_limit", "after", limits_after_flips}}}}),
    row<kPaper, &Paper::overshoot_factor>(
        "overshoot_factor",
        "Factor per sweep on the difference between the overshoot and 1. With factor 1 the overshoot is constant",
        {.range = {0, 1}, .needs = {{{"flips", "immediate|deferred"}, {"flip_limit", "after", limits_after_flips}}}}),
    row<&Options::repair>(
        "repair",
        "Treatment of triangles that stay invalid. none: nothing. perturb: sweep again with random moves, and find "
        "weights by a linear program. vertices: also remove and insert vertices. The best result is kept",
        {.needs = {{kBarrier, {"unknowns", "positions_and_weights|positions"}, {"flips", "immediate|deferred"}}}}),
    row<&Options::repair_trials>("repair_trials",
                                 "Largest number of edits that repairs try, 1 to 3 ms each. A linear program counts as "
                                 "20. On curved surfaces, repairs end after 1/33 of this number of edits without help",
                                 {.cells = CellKinds::all_triangles, .needs = {{{"repair", "perturb|vertices"}}}}),
    row<&Options::boundary>(
        "boundary",
        "Treatment of the boundary. keep: it stays bit for bit. slide: vertices may move along straight pieces; "
        "in tetrahedra also in planes, and on curved surfaces along boundary, creases and lines. Corners stay. split: "
        "cut long edges of the boundary or of interfaces, next to much shorter ones, before the sweeps, and with "
        "`repair=vertices` also where triangles stay bad. In tetrahedra, new vertices are on edges and faces, and only "
        "if a tetrahedron stays bad without them. The old vertices stay bit for bit",
        {.cells = kAll, .for_surfaces = "keep|slide", .common = true}),
    row<&Options::boundary_ratio>("boundary_ratio",
                                  "Largest ratio of the lengths of two boundary or interface edges that meet, with "
                                  "`boundary=split`. Longer edges are cut",
                                  {.range = at_least(kLeastBoundaryRatio), .needs = {{{"boundary", "split"}}}}),
    row<&Options::interfaces>("interfaces",
                              "Treatment of vertices on region interfaces and tagged lines. fixed: they stay. sliding: "
                              "they may move along straight lines"),
};

constexpr OptionRow kSizeRows[] = {
    row<&Options::size_band>(
        "size_band",
        "Size band B. No step moves the size at a vertex out of the range from 1/B to B times the size field",
        {.range = at_least(1), .absent_name = "none", .absent = "sizes are only reported"}),
    row<&Options::coarsen>(
        "coarsen",
        "Factor B of coarsening. The run searches for fewer vertices, and keeps all triangles well-centered. No "
        "removal "
        "makes the size at a vertex larger than B times the size field. The input's vertices on boundary and lines "
        "stay",
        {.range = at_least(1), .common = true, .absent_name = "none", .absent = "no coarsening"}),
    row<&Options::coarsen_moves>(
        "coarsen_moves",
        "Largest number of random moves of coarsening, 0.1 to 10 ms each. They follow the removal of single vertices",
        {.needs = {{{"coarsen", ""}}}}),
};

constexpr OptionRow kPaperRows[] = {
    row<kPaper, &Paper::inner>(
        "inner", "Largest number of sweeps before edges flip, with `flips=deferred`. 0: sweep until convergence",
        {.needs = {kDeferredFlips}}),
    row<kPaper, &Paper::outer>(
        "outer",
        "Largest number of rounds of sweeps and flips, with `flips=deferred`. 0: continue until no flips are needed",
        {.needs = {kDeferredFlips}}),
    row<kPaper, &Paper::weight_updates>("weight_updates",
                                        "Time at which neighbors see a new weight. immediate: at once. deferred: after "
                                        "the sweep. With `solver=newton`, positions must then be deferred too"),
    row<kPaper, &Paper::position_updates>(
        "position_updates",
        "Time at which neighbors see a new position. immediate: at once. deferred: after the sweep. All unknowns are "
        "then from the sweep before, so weights that move need `weight_updates=deferred`"),
    row<kPaper, &Paper::collapse_from>(
        "collapse_from", "First sweep with collapses of short edges, counted from 0. It is i_c of Algorithm 2",
        {.absent_name = "none", .absent = "no collapses"}),
    row<kPaper, &Paper::collapse_energy>("collapse_energy", "Energy E_c of collapses, which draws a vertex to an edge",
                                         {.choices = std::span(kNames<EnergyKind>).first<3>(), .needs = {kCollapses}}),
    row<kPaper, &Paper::collapse_ratio>("collapse_ratio",
                                        "Ratio below which a vertex collapses. It is the distance from the least E_c "
                                        "to the nearest neighbor, over the shorter link edge at that neighbor",
                                        {.range = inside(0, 1), .needs = {kCollapses}}),
    row<kPaper, &Paper::removal>("removal",
                                 "Removal of vertices. patch: if the patch is better without the vertex. This is line "
                                 "15 of Algorithm 1. weight: if the weight is far below its neighbors' weights"),
    row<kPaper, &Paper::removal_measure>(
        "removal_measure",
        "Measure that compares patches. sum: total energy, as in the paper. mean: energy per triangle. excess: energy "
        "above the energy of equilateral triangles",
        {.needs = {{{"removal", "patch", compares_patches}}}}),
    row<kPaper, &Paper::removal_margin>("removal_margin",
                                        "Relative gain of the patch that a removal or an insertion needs",
                                        {.range = at_least(0), .needs = {{{"removal", "patch", compares_patches}}}}),
    row<kPaper, &Paper::hidden_threshold>("hidden_threshold",
                                          "Threshold of `removal=weight`. It is the distance of a weight below the "
                                          "mean weight of its neighbors, over their mean squared distance",
                                          {.range = more_than(0), .needs = {{{"removal", "weight"}}}}),
    row<kPaper, &Paper::removal_from>("removal_from", "First sweep with removals, counted from 0",
                                      {.needs = {kRemovals}}),
    row<kPaper, &Paper::insertion_from>("insertion_from",
                                        "First sweep after which vertices are inserted, counted from 0. They go to "
                                        "triangles of large energy, if that makes the mesh better",
                                        {.absent_name = "none", .absent = "no insertions"}),
    row<kPaper, &Paper::insertion_ratio>("insertion_ratio",
                                         "Ratio to the mean energy of a triangle, above which an energy is large",
                                         {.range = more_than(1), .needs = {kInsertions}}),
    row<kPaper, &Paper::insertion_place>("insertion_place",
                                         "Place of new vertices in triangles of large energy, and of repairs in bad "
                                         "triangles. best: the orthocenter; repairs try several places",
                                         {.needs = {{{"repair", "vertices", inserts_vertices}}}}),
    row<kPaper, &Paper::hidden>("hidden",
                                "Treatment of vertices that weights hide. undo: undo the step. remove: remove the "
                                "vertex. keep: keep the vertex and report it"),
    row<kPaper, &Paper::inversion>("inversion",
                                   "Treatment of steps that turn a triangle over. refuse: refused. allow: allowed as "
                                   "in the paper, with `flips=deferred`. infinite: barriers are infinite there. "
                                   "Searches may then pass over such places, but never end there"),
    row<kPaper, &Paper::order>("order", "Order in which a sweep visits the vertices"),
};

constexpr OptionRow kStoppingRows[] = {
    row<&Options::max_sweeps>("max_sweeps", "Largest number of sweeps over the vertices", {.cells = kBoth}),
    row<kPaper, &Paper::tolerance>("tolerance", "Tolerance. The sweeps end when one gains less than this",
                                   {.range = at_least(0)}),
    row<kPaper, &Paper::stopping>("stopping",
                                  "Measure of the gain of a sweep. relative: relative to the energy. paper: change of "
                                  "the mean energy per triangle, absolute"),
    row<&Options::time_limit>("time_limit", "Time limit of the run in seconds. 0: no limit",
                              {.cells = kAll, .range = at_least(0), .common = true}),
    row<kPaper, &Paper::seed>("seed",
                              "Seed of the jitter that frees symmetric grids, of repairs, and of `order=random`"),
};

constexpr OptionRow kGuardRows[] = {
    row<kGuard, &GuardOptions::client>("guard",
                                       "Solver whose measures the guard keeps. No measure of it becomes worse than in "
                                       "the input. If the input meets the limits of "
                                       "D-Flow FM, ADCIRC or MPAS, it comes back",
                                       {.needs = {kForAccuracy}}),
    row<kGuard, &GuardOptions::angle>(
        "guard_angle",
        "Bound of the guard for the least angle a in degrees, and 180 - 2a for the largest one. The least angle never "
        "falls below it, or below the least one of "
        "the input if that is smaller. 60: the input's. 0: no limit. For tetrahedra it is about dihedral angles, and "
        "bounds the least alone",
        {.cells = kBoth, .range = from_to(0, 60), .needs = {kForAccuracy}}),
    row<kGuard, &GuardOptions::edge>("guard_edge",
                                     "Bound of the guard for the least length of an inner edge over the size of its "
                                     "triangles, not over the local size. 1: the input's. 0: no limit",
                                     {.range = from_to(0, 1), .needs = {kForAccuracy}}),
    row<kGuard, &GuardOptions::areas>("guard_areas",
                                      "Bound of the guard for the largest ratio of the areas of two triangles that "
                                      "share an edge",
                                      {.range = at_least(1), .absent = "no limit", .needs = {kForAccuracy}}),
    row<kGuard, &GuardOptions::length>("guard_length",
                                       "Bound of the guard for the shortest edge, in the unit of the coordinates",
                                       {.range = at_least(0),
                                        .absent = "the shortest edge of the input, if there is another limit",
                                        .needs = {kForAccuracy}}),
    row<kGuard, &GuardOptions::step>(
        "guard_step",
        "Bound of the guard for the time in seconds in which a long wave crosses a triangle or an edge. It holds if "
        "the mesh has point data with the name depth",
        {.range = at_least(0),
         .absent = "the shortest time of the input, if there is another limit",
         .needs = {kForAccuracy}}),
};

constexpr auto kForTetrahedra = CellKinds::tetrahedra;

constexpr OptionRow kTetrahedraRows[] = {
    row<kTets, &TetrahedraOptions::repair_trials>(
        "tets_repair_trials",
        "Number of trials in vain in one patch. After four patches a place is left as it is. 0: the connectivity stays",
        {.cells = kForTetrahedra}),
    row<kTets, &TetrahedraOptions::patches>("tets_patches",
                                            "Places of trials. shared: bad tetrahedra near each other have trials "
                                            "together. each: each bad tetrahedron has trials of its own",
                                            {.cells = kForTetrahedra}),
    row<kTets, &TetrahedraOptions::small_margin>(
        "tets_small_margin", "Least h/l. Tetrahedra with a smaller one are improved in trials, too, if none is bad",
        {.cells = kForTetrahedra, .range = at_least(0)}),
    row<kTets, &TetrahedraOptions::accuracy_steps>(
        "tets_accuracy_steps",
        "Largest number of steps that lower the errors of `scheme`. `energy=F` has at most 32 steps",
        {.cells = kForTetrahedra}),
    row<kTets, &TetrahedraOptions::most_error_vertices>(
        "tets_error_vertices", "Largest number of vertices for which the error of the solver is lowered",
        {.cells = kForTetrahedra}),
};

constexpr auto kForSurfaces = CellKinds::surfaces;

constexpr OptionRow kSurfaceRows[] = {
    row<kSurfaces, &CurvedSurfaceOptions::distance>(
        "surface_distance",
        "Largest distance between the input surface and the result, in parts of the diagonal of the bounding box. "
        "0: rounding, so that vertices move and edges flip in planes alone",
        {.cells = kForSurfaces, .range = {0, 1}, .common = true}),
    row<kSurfaces, &CurvedSurfaceOptions::crease_angle>(
        "crease_angle",
        "Angle of creases in degrees. A crease is an edge whose triangles turn by more. Its vertices stay, or slide "
        "along creases with `boundary=slide`",
        {.cells = kForSurfaces, .range = from_to(1, 180), .common = true}),
};

constexpr OptionGroup kGroups[] = {
    {"Energy", kEnergyRows},
    {"Accuracy", kAccuracyRows},
    {"Moves", kMoveRows},
    {"Connectivity and constraints", kConnectivityRows},
    {"Size", kSizeRows},
    {"The paper's switches", kPaperRows},
    {"Stopping", kStoppingRows},
    {"Guard", kGuardRows},
    {"Tetrahedra", kTetrahedraRows},
    {"Curved surfaces", kSurfaceRows},
};

}  // namespace

std::span<const std::string_view> words_of(Objective) { return kNames<Objective>; }
std::string_view name(Objective objective) { return kNames<Objective>[static_cast<std::size_t>(objective)]; }

std::span<const OptionGroup> option_groups() { return kGroups; }

std::span<const OptionRow> option_rows() {
  static const std::vector<OptionRow> all = [] {
    std::vector<OptionRow> rows;
    for (const OptionGroup& group : kGroups) rows.insert(rows.end(), group.rows.begin(), group.rows.end());
    return rows;
  }();
  return all;
}

}  // namespace temper

// Each option once: name, effect, range, and options that it needs to have an effect. Its field has the default.
#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <utility>

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
constexpr auto names_of(Star) { return std::to_array<Name>({"0", "1", "2", "all"}); }
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
constexpr auto names_of(Updates) { return std::to_array<Name>({"immediate", "deferred"}); }
constexpr auto names_of(Visits) { return std::to_array<Name>({"once", "twice"}); }
constexpr auto names_of(SearchRadius) { return std::to_array<Name>({"rms", "max", "min"}); }
constexpr auto names_of(Removal) { return std::to_array<Name>({"none", "patch", "weight"}); }
constexpr auto names_of(RemovalMeasure) { return std::to_array<Name>({"sum", "mean", "excess"}); }
constexpr auto names_of(HiddenPolicy) { return std::to_array<Name>({"undo", "remove", "keep"}); }
constexpr auto names_of(Inversion) { return std::to_array<Name>({"refuse", "allow", "infinite"}); }
constexpr auto names_of(SweepOrder) { return std::to_array<Name>({"hilbert", "input", "reverse", "random"}); }
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
constexpr OptionNeed kForError = {"objective", "solver_error"};
constexpr OptionNeed kBarrier = kEnergyThat<&EnergyInfo::barrier>;
constexpr OptionNeed kDeferredFlips = {"flips", "deferred"};
constexpr OptionNeed kCollapses = {"collapse_from", ""};
constexpr OptionNeed kRemovals = {"removal", "patch|weight"};
constexpr OptionNeed kGolden = {"solver", "golden"};
constexpr OptionNeed kInsertions = {"insertion_from", ""};

bool limits_after_flips(const Options& o) {
  return Policy(o).flip_limit_for(energy_info(o.energy)) == FlipLimit::after;
}
bool compares_patches(const Options& o) { return o.paper.removal == Removal::patch || o.paper.insertion_from; }
bool makes_golden_searches(const Options& o) { return o.paper.solver == Solver::golden || o.paper.collapse_from; }

constexpr OptionRow kEnergyRows[] = {
    row<&Options::energy>("energy",
                          "what to minimize: a barrier (BH, BHs, BP), a HOT energy (F, T, dT), one of these over "
                          "squared areas (nF, nT, ndT), or what optimal Delaunay triangulations do (ODT)"),
    row<&Options::star>("star",
                        "Hodge star whose error is to be small. all: the three at once, with `objective=accuracy`, "
                        "which begins with sweeps for star 1 whatever this is"),
    row<kPaper, &Paper::gamma>(
        "gamma", "gamma of E_BP",
        {.range = more_than(0),
         .absent = "relative to each edge, shrinking from 0.5, or 1 where many triangles are bad, to 0.003",
         .needs = {kEnergyThat<&EnergyInfo::softened_by_gamma>}}),
    row<kPaper, &Paper::h0>("h0", "how far below zero E_BHs lets h go (-h0 of the paper, so >= 0)",
                            {.range = at_least(0),
                             .absent = "just beyond the least h of the mesh, following it up",
                             .needs = {kEnergyThat<&EnergyInfo::softened_by_h0>}}),
    row<kPaper, &Paper::boundary_treatment>(
        "boundary_treatment",
        "of energy F: the h of boundary edges as it is, |h|, or as if the mesh were mirrored there",
        {.needs = {{{"energy", "F|nF"}}}}),
    row<kPaper, &Paper::first_energy>("first_energy",
                                      "what the first sweeps lower instead, before they switch to `energy`",
                                      {.absent = "`energy` from the first sweep on; ODT for ten sweeps `target` one "
                                                 "scheme on a mesh of the plane without weights"}),
    row<kPaper, &Paper::switch_at>("switch_at",
                                   "of `first_energy`: the first sweep that lowers `energy`, from 0; an earlier one "
                                   "when the first energy has converged",
                                   {.needs = {{{"first_energy", ""}}}}),
};

constexpr OptionRow kAccuracyRows[] = {
    row<&Options::objective>(
        "objective",
        "energy: lowers `energy` to the end; accuracy: lowers the distances between the midpoints of edges and of "
        "duals, "
        "once all triangles are well-centered; solver_error: then lowers the error of the solver itself, and takes "
        "longer",
        {.common = true,
         .absent =
             "accuracy; solver_error with `target` vertex or cell on a plane of at most 20000 vertices; energy if "
             "`energy` is not BP or has switches of its own"}),
    row<&Options::target>(
        "target",
        "what the mesh is for. vertex: unknowns at vertices; cell: unknowns at orthocenters (two-point flux); stars: "
        "diagonal Hodge stars; all: each of them, with larger margins",
        {.common = true, .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::margin>(
        "margin", "of accuracy: h/l, d/l and 1 - d/l stay above it in every triangle",
        {.range = inside(0, kMostMargin), .absent = "0.1, but 0.02 `target` one scheme", .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::min_edge>("min_edge",
                                        "of accuracy: least length of interior edges, over the local size; 0: none",
                                        {.range = from_to(0, kMostEdge), .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::min_dual>("min_dual",
                                        "of accuracy: the same of their dual edges, whose lengths bound time steps",
                                        {.range = from_to(0, kMostDual), .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::offset_factor>(
        "offset_factor",
        "of accuracy: how many times as much as in HOT the offset of the middles counts; 1: HOT over size squared",
        {.range = at_least(0), .absent = "10, but 20 for stars", .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::boundary_offset_factor>(
        "boundary_offset_factor", "of accuracy: the same of the height of boundary edges",
        {.range = at_least(0), .absent = "5; for vertex 0.5, cell 30, stars 18", .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::barrier>("barrier", "of accuracy: factor of the logarithms that keep the margin",
                                       {.range = more_than(0), .needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::sweeps>("accuracy_sweeps", "of accuracy: at most this many, after those for the energy",
                                      {.needs = {kForAccuracy}}),
    row<kAccuracy, &Accuracy::tolerance>("accuracy_tolerance",
                                         "of accuracy: stop when a sweep gains less than this part",
                                         {.range = at_least(0), .needs = {kForAccuracy}}),
    row<kError, &Error::offset_share>(
        "offset_share", "of error: how much the offset of the middles counts beside it, which other errors go with",
        {.range = at_least(0), .needs = {kForError}}),
    row<kError, &Error::steps>("solver_error_steps",
                               "of error: at most this many, of all vertices at once, after the others",
                               {.needs = {kForError}}),
    row<kError, &Error::tolerance>("solver_error_tolerance", "of error: stop when ten steps gain less than this part",
                                   {.range = at_least(0), .needs = {kForError}}),
};

constexpr OptionRow kMoveRows[] = {
    row<kPaper, &Paper::solver>(
        "solver",
        "Newton steps in position and weight together; the paper's golden section; Newton in position, then weight"),
    row<&Options::unknowns>("unknowns", "what steps may change; the others stay as they are", {.common = true}),
    row<kPaper, &Paper::weights_from>("weights_from", "first sweep that changes weights, from 0",
                                      {.needs = {{{"unknowns", "positions_and_weights"}}}}),
    row<kPaper, &Paper::relaxation>("relaxation", "over-relaxation of Newton steps",
                                    {.range = inside(0, 2),
                                     .absent = "1.7, but 1.97 while gamma shrinks from 1",
                                     .needs = {{{"solver", "newton|alternating"}}}}),
    row<kPaper, &Paper::search_radius>("search_radius",
                                       "how far golden section searches for a position: the root mean square distance "
                                       "to the neighbors, or that of the farthest or the nearest",
                                       {.needs = {{{"solver", "golden", makes_golden_searches}}}}),
    row<kPaper, &Paper::weight_search_radius>(
        "weight_search_radius", "how far golden section searches for a weight, relative to the search radius squared",
        {.range = more_than(0), .needs = {kGolden}}),
    row<kPaper, &Paper::visits>("visits",
                                "a sweep visits each vertex once, or twice: all positions first, then all weights",
                                {.needs = {{{"unknowns", "positions_and_weights"}}}}),
    row<kPaper, &Paper::anchor>("anchor", "shift the weights after each sweep so that this vertex has weight 0",
                                {.absent_name = "none", .absent = "they stay"}),
};

constexpr OptionRow kConnectivityRows[] = {
    row<&Options::flips>("flips",
                         "flip edges at once, after the inner sweeps, or never: then the connectivity stays, and no "
                         "step may make an edge non-regular"),
    row<kPaper, &Paper::flip_limit>(
        "flip_limit", "how far a step may go past the point where an edge flips",
        {.absent = "unlimited for barriers, after for HOT", .needs = {{{"flips", "immediate|deferred"}}}}),
    row<kPaper, &Paper::overshoot>(
        "overshoot", "of `flip_limit=after`: where steps end, relative to the way to the flip, at first",
        {.range = more_than(0),
         .needs = {{{"flips", "immediate|deferred"}, {"flip_limit", "after", limits_after_flips}}}}),
    row<kPaper, &Paper::overshoot_factor>(
        "overshoot_factor", "by which what the overshoot is above or below 1 shrinks each sweep; 1: it is constant",
        {.range = {0, 1}, .needs = {{{"flips", "immediate|deferred"}, {"flip_limit", "after", limits_after_flips}}}}),
    row<&Options::repair>(
        "repair",
        "where sweeps leave triangles bad: nothing; sweep again and kick vertices there, and find weights by a linear "
        "program; remove and insert vertices there, too, and keep what cures most",
        {.common = true,
         .needs = {{kBarrier, {"unknowns", "positions_and_weights|positions"}, {"flips", "immediate|deferred"}}}}),
    row<&Options::repair_trials>("repair_trials",
                                 "at most so many edits are tried, 1 to 3 ms each; a linear program counts as 20",
                                 {.needs = {{{"repair", "perturb|vertices"}}}}),
    row<&Options::boundary>(
        "boundary",
        "keep: the domain's boundary stays bit for bit; slide: vertices of its straight pieces, never corners, may "
        "move along them; split: edges of boundary and interfaces much longer than one they meet are cut before the "
        "sweeps, and the vertices that were there stay bit for bit",
        {.common = true}),
    row<&Options::boundary_ratio>("boundary_ratio",
                                  "of `boundary=split`: how many times as long an edge may be as one it meets",
                                  {.range = at_least(kLeastBoundaryRatio), .needs = {{{"boundary", "split"}}}}),
    row<&Options::interfaces>("interfaces",
                              "vertices of straight region interfaces and tagged lines stay, or may move along them"),
};

constexpr OptionRow kSizeRows[] = {
    row<&Options::size_band>("size_band",
                             "B: no step takes the size at a vertex out of the size field's 1/B to B times",
                             {.range = at_least(1), .absent_name = "none", .absent = "sizes are only reported"}),
};

constexpr OptionRow kPaperRows[] = {
    row<kPaper, &Paper::inner>(
        "inner", "with deferred flips: at most so many sweeps before edges are flipped; 0: until they converge",
        {.needs = {kDeferredFlips}}),
    row<kPaper, &Paper::outer>(
        "outer", "with deferred flips: at most so many rounds of sweeps and flips; 0: until no flips are needed",
        {.needs = {kDeferredFlips}}),
    row<kPaper, &Paper::weight_updates>(
        "weight_updates",
        "a new weight is seen by its neighbors at once, or after the sweep (not with `solver=newton`)"),
    row<kPaper, &Paper::position_updates>("position_updates",
                                          "the same of positions; deferred, with `weight_updates=deferred` where "
                                          "weights move: all unknowns are those of the sweep before"),
    row<kPaper, &Paper::collapse_from>("collapse_from",
                                       "i_c: first sweep with short-edge collapses, from 0 (Algorithm 2)",
                                       {.absent_name = "none", .absent = "no collapses"}),
    row<kPaper, &Paper::collapse_energy>("collapse_energy", "E_c, which draws a vertex to an edge",
                                         {.choices = std::span(kNames<EnergyKind>).first<3>(), .needs = {kCollapses}}),
    row<kPaper, &Paper::collapse_ratio>(
        "collapse_ratio",
        "collapse a vertex that E_c wants this near its neighbor, relative to that one's shorter edge beside",
        {.range = inside(0, 1), .needs = {kCollapses}}),
    row<kPaper, &Paper::removal>("removal",
                                 "patch: remove a vertex when its patch is better without it (Algorithm 1, line 15); "
                                 "weight: when its weight is far below its neighbors'"),
    row<kPaper, &Paper::removal_measure>(
        "removal_measure",
        "by what patches are compared: energy summed (the paper), per triangle, or above equilateral triangles",
        {.needs = {{{"removal", "patch", compares_patches}}}}),
    row<kPaper, &Paper::removal_margin>("removal_margin", "by which part the patch must be better",
                                        {.range = at_least(0), .needs = {{{"removal", "patch", compares_patches}}}}),
    row<kPaper, &Paper::hidden_threshold>(
        "hidden_threshold",
        "of `removal=weight`: how far below the mean of its neighbors', relative to their mean squared distance",
        {.range = more_than(0), .needs = {{{"removal", "weight"}}}}),
    row<kPaper, &Paper::removal_from>("removal_from", "first sweep with removals, from 0", {.needs = {kRemovals}}),
    row<kPaper, &Paper::insertion_from>("insertion_from",
                                        "first sweep after which vertices are inserted at the orthocenters of "
                                        "triangles of large energy, where that makes the mesh better, from 0",
                                        {.absent_name = "none", .absent = "no insertions"}),
    row<kPaper, &Paper::insertion_ratio>("insertion_ratio", "how many times the mean energy of a triangle is large",
                                         {.range = more_than(1), .needs = {kInsertions}}),
    row<kPaper, &Paper::hidden>("hidden", "what weights hide: undo the step, remove the vertex, or keep and report it"),
    row<kPaper, &Paper::inversion>(
        "inversion",
        "steps that turn a triangle over are refused, or allowed as in the paper (with deferred flips); infinite: "
        "where a triangle is turned over a barrier is, so that searches step over such places, but not onto them"),
    row<kPaper, &Paper::order>("order", "in which a sweep visits the vertices"),
};

constexpr OptionRow kStoppingRows[] = {
    row<&Options::max_sweeps>("max_sweeps", "at most this many sweeps over the vertices"),
    row<kPaper, &Paper::tolerance>("tolerance", "stop when a sweep gains less than this", {.range = at_least(0)}),
    row<kPaper, &Paper::stopping>(
        "stopping", "the gain relative to the energy, or the paper's: mean energy per triangle, absolute"),
    row<&Options::time_limit>("time_limit", "stop after this many seconds; 0: no limit",
                              {.range = at_least(0), .common = true}),
    row<kPaper, &Paper::seed>("seed", "of the jitter that frees symmetric grids, of repairs, and of `order=random`"),
};

constexpr OptionGroup kGroups[] = {
    {"Energy", kEnergyRows},     {"Accuracy", kAccuracyRows},
    {"Moves", kMoveRows},        {"Connectivity and constraints", kConnectivityRows},
    {"Size", kSizeRows},         {"The paper's switches", kPaperRows},
    {"Stopping", kStoppingRows},
};

}  // namespace

std::string_view name(Objective objective) { return kNames<Objective>[static_cast<std::size_t>(objective)]; }

std::span<const OptionGroup> option_groups() { return kGroups; }

std::span<const Method> methods() {
  static constexpr Method kMethods[] = {
      {"production", "temper's own", [] { return OptimizeOptions(); }},
      {"paper",
       "Algorithm 1 of the paper with golden section, deferred flips, collapses, the patch test, inversions allowed, "
       "the first vertex as anchor and gamma 1",
       paper_method},
      {"odt", "optimal Delaunay triangulation: energy ODT of the positions alone", odt_method},
      {"cvt", "centroidal Voronoi tessellation: energy F of star 0, of the positions alone", cvt_method},
  };
  return kMethods;
}

}  // namespace temper

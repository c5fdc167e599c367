// The search over connectivities: weights first, flips after, until the margin stops growing.
//
//   weights of the best margin → Lawson's flips → best margin     if greater: continue with this mesh
//   else, if there is no margin: a short complete search          if it finds weights: continue with their mesh
//   else for each flip that breaks the proof of the margin        if the greatest is greater: continue with it
//   else, if there is no margin: the complete search              if it finds weights: continue with their mesh
//   else done
#include "temper/detail/connectivity.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "base/assert.hpp"
#include "base/sort_unique.hpp"
#include "feasibility/certify.hpp"
#include "feasibility/complete_search.hpp"
#include "feasibility/constraints.hpp"
#include "feasibility/region.hpp"
#include "mesh/bad_triangles.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"
#include "topology/rings.hpp"

namespace temper {
namespace {

// Margins that differ by less are equal: ten times the possible sum of the solver's tolerance on each row.
constexpr double kGrowth = 1e-7;

// The complete search is short at first: most meshes need less, and local search is faster for some others.
constexpr std::size_t kShortSearch = 1000, kNoLimit = ~std::size_t{0};

/// The best margin of a connectivity, the weights that attain it, and the constraints in the proof that it is the
/// greatest.
struct Optimum {
  double margin = kUnbounded;
  IdVector<VertexId, double> weights;
  std::vector<WeightConstraint> proof;
};

class ConnectivitySearch {
 public:
  ConnectivitySearch(const Mesh& mesh, LpSolver& solver, const ConnectivityOptions& options)
      : solver_(solver), options_(options) {
    report_.mesh = mesh;
  }

  ConnectivityReport run() {
    if (auto first = optimum_of(report_.mesh)) {
      best_ = *std::move(first);
      report_.before = best_.margin;
      report_.end = SearchEnd::no_better_neighbor;
      while (try_regular() || try_complete(short_, kShortSearch) || try_flips() || try_complete(long_, kNoLimit)) {
      }
      report_.margin = best_.margin;
      report_.weights = std::move(best_.weights);
    }
    return std::move(report_);
  }

 private:
  [[nodiscard]] bool is_over() const {
    return report_.end == SearchEnd::stopped || report_.end == SearchEnd::none_exists ||
           report_.end == SearchEnd::limit;
  }

  /// The optimum, each component on its own. Nothing when the solver fails, or the search is over.
  std::optional<Optimum> optimum_of(const Mesh& mesh) {
    if (options_.stop && options_.stop()) report_.end = SearchEnd::stopped;
    if (is_over()) return std::nullopt;
    if (report_.programs == options_.programs) {
      report_.end = SearchEnd::limit;
      return std::nullopt;
    }
    ++report_.programs;
    Optimum optimum;
    optimum.weights = IdVector<VertexId, double>(mesh.n_vertices(), 0.0);
    const TriangleDemand demand(mesh, options_.constraints);
    for (const Region& component : components_of(demand)) {
      Bound bound = bound_margin(demand, component.cells, solver_);
      if (bound.best.status != LpStatus::optimal) return std::nullopt;
      for (std::size_t i = 0; i < bound.best.vertices.size(); ++i) {
        optimum.weights[bound.best.vertices[i]] = bound.best.weights[i];
      }
      // A flip may make a triangle so flat that its heights are below the solver's tolerance: the attained margin
      // counts.
      const double margin = std::min(bound.best.margin, attained(demand, component.cells, optimum.weights));
      if (margin >= optimum.margin) continue;
      optimum.margin = margin;
      optimum.proof = std::move(bound.best.tight);
    }
    return optimum;
  }

  [[nodiscard]] static double attained(const Demand& demand, std::span<const CellId> cells,
                                       const VertexWeights& weights) {
    double margin = kUnbounded;
    for (const CellId cell : cells) margin = std::min(margin, demand.margin_of(cell, weights));
    return margin;
  }

  [[nodiscard]] bool is_greater(double margin) const { return margin > best_.margin + kGrowth; }

  void take(Mesh mesh, Optimum optimum, ConnectivityStep::Kind kind, std::size_t flips) {
    report_.steps.push_back({kind, flips, optimum.margin});
    report_.mesh = std::move(mesh);
    best_ = std::move(optimum);
  }

  /// Takes the regular triangulation of the weights if its best margin is greater.
  bool take_regular(const VertexWeights& weights, ConnectivityStep::Kind kind) {
    Mesh trial = report_.mesh;
    for (const VertexId v : trial.vertices()) trial.set_weight(v, weights[v]);
    const std::size_t flips = restore_regularity(trial, HiddenPolicy::undo).flips;
    if (flips == 0) return false;
    for (const VertexId v : trial.vertices()) trial.set_point(v, report_.mesh.point(v));
    auto optimum = optimum_of(trial);
    if (!optimum || !is_greater(optimum->margin)) return false;
    take(std::move(trial), *std::move(optimum), kind, flips);
    return true;
  }

  bool try_regular() { return take_regular(best_.weights, ConnectivityStep::Kind::regular); }

  /// The complete search, once, for small meshes of the plane that have no margin. It ends after `most_calls` calls
  /// of stop.
  bool try_complete(bool& was_tried, std::size_t most_calls) {
    const Mesh& mesh = report_.mesh;
    if (is_over() || best_.margin >= kNoMargin || std::exchange(was_tried, true)) return false;
    if (!mesh.space().is_plane() || mesh.n_vertices() > kMostVerticesOfCompleteSearch) return false;
    std::size_t calls = 0;
    const auto is_asked_to_stop = [&] { return options_.stop && options_.stop(); };
    CompleteSearchResult result =
        search_completely(mesh, options_.constraints, [&] { return ++calls > most_calls || is_asked_to_stop(); });
    report_.bound = std::min(report_.bound, result.bound);
    report_.complete_programs += result.programs;
    report_.proof = std::move(result.proof);
    switch (result.end) {
      case CompleteSearchResult::End::found:
        return take_regular(result.weights, ConnectivityStep::Kind::complete);
      case CompleteSearchResult::End::none:
        report_.end = SearchEnd::none_exists;
        return false;
      case CompleteSearchResult::End::stopped:
        if (calls <= most_calls) report_.end = SearchEnd::stopped;
        return false;
      case CompleteSearchResult::End::undecided:
        return false;
    }
    return false;
  }

  bool try_flips() {
    if (is_over()) return false;
    std::optional<Optimum> best;
    Mesh best_mesh;
    for (const HalfedgeId h : flips_that_break_the_proof()) {
      Mesh trial = report_.mesh;
      flip(trial, h);
      if (is_ruled_out(trial, {Mesh::triangle(h), Mesh::triangle(report_.mesh.twin(h))})) continue;
      auto optimum = optimum_of(trial);
      if (!optimum || !is_greater(optimum->margin)) continue;
      if (best && optimum->margin <= best->margin + kGrowth) continue;
      best = std::move(optimum);
      best_mesh = std::move(trial);
    }
    if (!best) return false;
    take(std::move(best_mesh), *std::move(best), ConnectivityStep::Kind::flip, 1);
    return true;
  }

  /// The edges that can be flipped, of the proof's triangles and of its crossings; each once, by its vertices.
  [[nodiscard]] std::vector<HalfedgeId> flips_that_break_the_proof() const {
    const Mesh& mesh = report_.mesh;
    std::vector<std::pair<std::array<VertexId, 2>, HalfedgeId>> edges;
    const auto add = [&](VertexId a, VertexId b) {
      const HalfedgeId h = mesh.find_halfedge(std::min(a, b), std::max(a, b));
      if (!h.valid() || mesh.is_boundary(h) || can_flip(mesh, h) != FlipStatus::possible) return;
      edges.push_back({{std::min(a, b), std::max(a, b)}, h});
    };
    for (const WeightConstraint& c : best_.proof) {
      add(c.p, c.q);
      if (c.kind == WeightConstraint::Kind::height) add(c.q, c.r), add(c.r, c.p);
    }
    sort_unique(edges);
    std::vector<HalfedgeId> halfedges;
    halfedges.reserve(edges.size());
    for (const auto& [vertices, h] : edges) halfedges.push_back(h);
    return halfedges;
  }

  /// The triangles around the flipped edge, the rest left out, bound the margin from above.
  [[nodiscard]] bool is_ruled_out(const Mesh& flipped, const std::array<TriangleId, 2>& changed) const {
    const Bound bound = bound_margin(TriangleDemand(flipped, options_.constraints),
                                     as_cells(triangles_around(flipped, changed)), solver_);
    return bound.best.status == LpStatus::optimal && !is_greater(bound.best.margin);
  }

  LpSolver& solver_;
  const ConnectivityOptions& options_;
  Optimum best_;
  bool short_ = false, long_ = false;  ///< whether the complete search was tried
  ConnectivityReport report_;
};

}  // namespace

std::string_view name(ConnectivityStep::Kind kind) {
  constexpr std::array<std::string_view, 3> kNames = {"regular", "flip", "complete"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view name(SearchEnd end) {
  constexpr std::array<std::string_view, 5> kNames = {"no_better_neighbor", "none_exists", "limit", "stopped",
                                                      "failed"};
  return kNames[static_cast<std::size_t>(end)];
}

Expected<ConnectivityReport> best_connectivity(const Mesh& mesh, LpSolver& solver, const ConnectivityOptions& options) {
  TEMPER_ASSERT_SLOW(!has_erased_triangles(mesh));
  if (auto error = expect_no_period(mesh, "best_connectivity()")) return *std::move(error);
  if (options.constraints != Constraints::well_centered && options.constraints != Constraints::heights_only) {
    const std::string why =
        options.constraints == Constraints::regular ? ": every regular triangulation keeps them" : "";
    return InputError{
        ErrorCode::invalid_option, "",
        "constraints: expected well_centered or heights_only, found " + std::string(name(options.constraints)) + why};
  }
  return ConnectivitySearch(mesh, solver, options).run();
}

}  // namespace temper

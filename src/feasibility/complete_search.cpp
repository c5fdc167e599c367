#include "feasibility/complete_search.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "base/sort_unique.hpp"
#include "feasibility/certify.hpp"
#include "feasibility/edge_rows.hpp"
#include "feasibility/proof_checker.hpp"

namespace temper {
namespace {

using LemmaId = std::size_t;

constexpr std::size_t kShort = 3;  // lemmas with more edges are left out when apexes are only counted
constexpr double kGoodSide = 4;    // factor of the number of apexes, for a side where weights are good

class CompleteSearch {
 public:
  CompleteSearch(const Mesh& mesh, Constraints constraints, const std::function<bool()>& stop)
      : mesh_(mesh),
        constraints_(constraints),
        stop_(stop),
        sight_(mesh),
        checker_(mesh, sight_, constraints),
        rows_(mesh, sight_, constraints),
        pairs_(mesh.n_vertices() * mesh.n_vertices()) {
    ranges_.push_back(rows_.of_pairs());
    std::vector<ProofEdge> of_all;  // sorted, so that the search does not depend on the connectivity of the mesh
    for (const HalfedgeId h : mesh.halfedges()) {
      if (mesh.is_unflippable(h)) of_all.push_back(edge_between(mesh.origin(h), mesh.target(h)));
    }
    sort_unique(of_all);
    for (const ProofEdge& e : of_all) push(e);
  }

  CompleteSearchResult run() {
    MarginSimplex program(rows_.all(), rows_.n_weights());
    std::optional<LemmaId> lemma = refute(program, ranges_);
    if (!lemma && !is_over()) {
      result_.bound = program.margin();
      root_.emplace(program);
      n_root_ranges_ = ranges_.size();
      lemma = continue_with(program);
    }
    if (lemma) {
      result_.end = CompleteSearchResult::End::none;
      result_.bound = 0;
      keep_needed_lemmas(*lemma);
    } else if (stopped_) {
      result_.end = CompleteSearchResult::End::stopped;
    } else if (found_) {
      result_.end = CompleteSearchResult::End::found;
    }
    return std::move(result_);
  }

 private:
  using Side = std::array<VertexId, 2>;  ///< the left side of the edge from the first vertex to the second
  enum class Tested : std::uint8_t { no, alive, dead };

  /// The knowledge about two vertices: about their edge, and about the left side from the first to the second.
  struct Pair {
    bool is_known = false;              ///< an edge
    Tested tested = Tested::no;         ///< without the rows of other chosen edges
    std::vector<LemmaId> lemmas;        ///< that name the edge
    bool has_apexes = false;            ///< whether `apexes` was made
    std::vector<VertexId> apexes = {};  ///< that the triangle on this side has in some triangulation
  };

  [[nodiscard]] Pair& pair(VertexId a, VertexId b) { return pairs_[a.index * mesh_.n_vertices() + b.index]; }
  [[nodiscard]] const Pair& pair(VertexId a, VertexId b) const {
    return pairs_[a.index * mesh_.n_vertices() + b.index];
  }
  [[nodiscard]] Pair& pair(const ProofEdge& e) { return pair(e[0], e[1]); }
  [[nodiscard]] bool is_known(const ProofEdge& e) const { return pair(e[0], e[1]).is_known; }
  [[nodiscard]] bool is_over() const { return found_ || stopped_; }

  void push(const ProofEdge& e) {
    pair(e).is_known = true;
    known_.push_back(e);
    ranges_.push_back(rows_.of_edge(e[0], e[1]));
  }
  void pop() {
    pair(known_.back()).is_known = false;
    known_.pop_back();
    ranges_.pop_back();
  }

  const std::vector<VertexId>& apexes(const Side& side) {
    Pair& of_side = pair(side[0], side[1]);
    if (!std::exchange(of_side.has_apexes, true)) {
      for (const VertexId x : mesh_.vertices()) {
        if (x != side[0] && x != side[1] && sight_.can_be_triangle(side[0], side[1], x)) of_side.apexes.push_back(x);
      }
    }
    return of_side.apexes;
  }

  // --- lemmas --------------------------------------------------------------------------------------

  LemmaId store(Lemma lemma) {
    for (const ProofEdge& e : lemma.edges) pair(e).lemmas.push_back(lemmas_.size());
    lemmas_.push_back(std::move(lemma));
    return lemmas_.size() - 1;
  }

  /// The lemma of a program without margin; nothing if the exact check does not accept it.
  std::optional<LemmaId> lemma_of(const MarginSimplex& program) {
    double largest = 0;
    program.for_each_multiplier([&](std::size_t /*row*/, double y) { largest = std::max(largest, y); });
    for (const double dropped : {1e-9, 1e-12, 1e-15}) {  // as in certify()
      Lemma lemma;
      program.for_each_multiplier([&](std::size_t row, double y) {
        if (!(y > dropped * largest)) return;
        lemma.terms.push_back(rows_.term(row, y));
        const WeightConstraint& c = lemma.terms.back().constraint;
        if (rows_.needs_edge(row) && !sight_.must_be_edge(c.p, c.q)) lemma.edges.push_back(edge_between(c.p, c.q));
      });
      sort_unique(lemma.edges);
      if (checker_.check(lemma, lemmas_) == CertificateCheck::proves) return store(std::move(lemma));
    }
    return std::nullopt;
  }

  /// Solves a program. Returns its lemma if it has no margin. If rounding spoils the lemma, the program is solved once
  /// more from its first basis.
  std::optional<LemmaId> refute(MarginSimplex& program, std::span<const EdgeRows::Range> ranges) {
    ++result_.programs;
    for (const bool again : {false, true}) {
      if (again) program.restart();
      const MarginSimplex::End end = program.solve(ranges, stop_);
      if (end == MarginSimplex::End::stopped) stopped_ = true;
      if (stopped_ || (end == MarginSimplex::End::optimal && program.margin() >= kNoMargin)) break;
      if (end == MarginSimplex::End::failed) continue;
      if (const auto lemma = lemma_of(program)) return lemma;
    }
    return std::nullopt;
  }

  /// Returns a lemma that excludes the triangle with the apex x, and has at most `most_edges` edges.
  [[nodiscard]] std::optional<LemmaId> lemma_against(const Side& side, VertexId x, std::size_t most_edges) const {
    const ProofEdge ax = edge_between(side[0], x), bx = edge_between(side[1], x);
    const auto holds = [&](const ProofEdge& e) { return is_known(e) || e == ax || e == bx; };
    for (const ProofEdge& added : {ax, bx}) {
      if (is_known(added)) continue;
      for (const LemmaId i : pair(added[0], added[1]).lemmas) {
        const std::vector<ProofEdge>& edges = lemmas_[i].edges;
        if (edges.size() <= most_edges && std::all_of(edges.begin(), edges.end(), holds)) return i;
      }
    }
    return std::nullopt;
  }

  // --- apexes --------------------------------------------------------------------------------------

  [[nodiscard]] std::optional<ProofEdge> known_across(const ProofEdge& e) const {
    if (is_known(e)) return std::nullopt;
    const auto at = std::find_if(known_.begin(), known_.end(),
                                 [&](const ProofEdge& other) { return sight_.cross(e[0], e[1], other[0], other[1]); });
    return at == known_.end() ? std::nullopt : std::optional(*at);
  }

  /// Says whether the edge alone has no margin, in all triangulations.
  bool is_dead(const ProofEdge& e) {
    if (sight_.must_be_edge(e[0], e[1])) return false;
    Tested& tested = pair(e).tested;
    if (tested == Tested::no && !is_over()) {
      MarginSimplex program = *root_;
      std::vector<EdgeRows::Range> ranges(ranges_.begin(),
                                          ranges_.begin() + static_cast<std::ptrdiff_t>(n_root_ranges_));
      ranges.push_back(rows_.of_edge(e[0], e[1]));
      tested = refute(program, ranges) ? Tested::dead : Tested::alive;
    }
    return tested == Tested::dead;
  }

  [[nodiscard]] bool is_open(const Side& side) {
    const auto& [a, b] = side;
    if (!mesh_.find_halfedge(a, b).valid() && mesh_.find_halfedge(b, a).valid()) return false;  // outside
    const std::vector<VertexId>& all = apexes(side);
    return std::none_of(all.begin(), all.end(), [&](VertexId x) {
      return is_known(edge_between(side[0], x)) && is_known(edge_between(side[1], x));
    });
  }

  std::size_t count_apexes(const Side& side) {
    const std::vector<VertexId>& all = apexes(side);
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](VertexId x) {
      const ProofEdge ax = edge_between(side[0], x), bx = edge_between(side[1], x);
      return !known_across(ax) && !known_across(bx) && !is_dead(ax) && !is_dead(bx) && !lemma_against(side, x, kShort);
    }));
  }

  /// The side without triangle that has the fewest apexes for each lemma that names its edge. Sides whose triangle in
  /// the regular triangulation breaks the constraints are preferred.
  std::optional<Side> open_side(const MarginSimplex& program) {
    std::optional<Side> best;
    double least = kUnbounded;
    for (const ProofEdge& e : known_) {
      for (const Side& side : {Side{e[0], e[1]}, Side{e[1], e[0]}}) {
        if (!is_open(side)) continue;
        const std::vector<VertexId> order = by_height(side, program);
        const bool is_kept = !order.empty() && keeps(side, order.front(), program);
        const auto n_lemmas = static_cast<double>(pair(e).lemmas.size());
        const double score = (is_kept ? kGoodSide : 1) * static_cast<double>(count_apexes(side)) / (1 + n_lemmas);
        if (score < least) best = side, least = score;
        if (score == 0) return best;
      }
    }
    return best;
  }

  /// Says whether the triangle on a side keeps the constraints with the weights of the program, up to rounding.
  [[nodiscard]] bool keeps(const Side& side, VertexId x, const MarginSimplex& program) const {
    const auto weight = [&](VertexId v) { return rows_.weight(program, v); };
    const std::array<VertexId, 3> corners = {side[0], side[1], x};
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId p = corners[k], q = corners[(k + 1) % 3], r = corners[(k + 2) % 3];
      if (value_of(linear_form(mesh_, {WeightConstraint::Kind::height, p, q, r}), weight) <= 0) return false;
      if (constraints_ == Constraints::heights_only) continue;
      const double crossing = value_of(linear_form(mesh_, split_constraint(p, q)), weight);
      if (crossing <= 0 || crossing >= 1) return false;
    }
    return true;
  }

  /// Returns the apexes of a side. The apex of the regular triangulation comes first: it has the lowest orthocenter.
  std::vector<VertexId> by_height(const Side& side, const MarginSimplex& program) {
    std::vector<std::pair<double, VertexId>> order;
    for (const VertexId x : apexes(side)) {
      const LinearForm form = linear_form(mesh_, {WeightConstraint::Kind::height, side[0], side[1], x});
      order.emplace_back(value_of(form, [&](VertexId v) { return rows_.weight(program, v); }), x);
    }
    std::sort(order.begin(), order.end());
    std::vector<VertexId> sorted;
    sorted.reserve(order.size());
    for (const auto& [height, x] : order) sorted.push_back(x);
    return sorted;
  }

  // --- search --------------------------------------------------------------------------------------

  /// Returns a lemma whose edges are all known, if there is one.
  std::optional<LemmaId> explore(const MarginSimplex& before) {
    if (stop_ && stop_()) stopped_ = true;
    if (stopped_) return std::nullopt;
    MarginSimplex program = before;
    if (const auto lemma = refute(program, ranges_)) return lemma;
    return continue_with(program);
  }

  std::optional<LemmaId> continue_with(const MarginSimplex& program) {
    if (is_over()) return std::nullopt;
    if (const auto side = open_side(program)) return is_over() ? std::nullopt : branch(*side, program);
    take(program);
    return std::nullopt;
  }

  std::optional<LemmaId> branch(const Side& side, const MarginSimplex& program) {
    const auto [a, b] = side;
    Lemma lemma;
    lemma.side = side;
    bool is_proved = true;
    const auto need = [&](const ProofEdge& e) {
      if (!sight_.must_be_edge(e[0], e[1])) lemma.edges.push_back(e);
    };
    need(edge_between(a, b));
    for (const VertexId x : by_height(side, program)) {
      const ProofEdge ax = edge_between(a, x), bx = edge_between(b, x);
      const auto across_ax = known_across(ax), across_bx = known_across(bx);
      if (across_ax || across_bx) {
        need(across_ax ? *across_ax : *across_bx);
        continue;
      }
      std::optional<LemmaId> against = lemma_against(side, x, known_.size());
      if (!against) {
        against = explore_with({ax, bx}, program);
        if (is_over()) return std::nullopt;
        if (!against) {
          is_proved = false;
          continue;
        }
        const std::vector<ProofEdge>& edges = lemmas_[*against].edges;
        if (std::all_of(edges.begin(), edges.end(), [&](const ProofEdge& e) { return is_known(e); })) return against;
      }
      for (const ProofEdge& e : lemmas_[*against].edges) {
        if (e != ax && e != bx) need(e);
      }
      lemma.cases.push_back({x, *against});
    }
    if (!is_proved) return std::nullopt;
    sort_unique(lemma.edges);
    return store(std::move(lemma));
  }

  std::optional<LemmaId> explore_with(const std::array<ProofEdge, 2>& edges, const MarginSimplex& program) {
    const std::size_t before = known_.size();
    for (const ProofEdge& e : edges) {
      if (!is_known(e)) push(e);
    }
    const auto lemma = explore(program);
    while (known_.size() > before) pop();
    return lemma;
  }

  /// Takes the weights of a whole triangulation, if its triangles keep the constraints exactly.
  void take(const MarginSimplex& program) {
    const auto at = [&](VertexId v) {
      const Vec2 p = mesh_.position(v);
      return WeightedPoint{p.x, p.y, rows_.weight(program, v)};
    };
    for (const ProofEdge& e : known_) {
      for (const Side& side : {Side{e[0], e[1]}, Side{e[1], e[0]}}) {
        for (const VertexId x : apexes(side)) {
          if (!is_known(edge_between(side[0], x)) || !is_known(edge_between(side[1], x))) continue;
          if (!keeps(at(side[0]), at(side[1]), at(x))) return;
        }
      }
    }
    found_ = true;
    result_.weights = IdVector<VertexId, double>(mesh_.n_vertices(), 0.0);
    for (const VertexId v : mesh_.vertices()) result_.weights[v] = rows_.weight(program, v);
  }

  /// Says whether the triangle keeps the constraints of the edge pq.
  [[nodiscard]] bool keeps(const WeightedPoint& p, const WeightedPoint& q, const WeightedPoint& r) const {
    if (constraints_ == Constraints::well_centered) return is_well_centered(mesh_.space(), p, q, r);
    return signed_height_sign(mesh_.space(), p, q, r) == Sign::positive;
  }

  void keep_needed_lemmas(LemmaId last) {
    std::vector<std::uint8_t> is_needed(last + 1, 0);
    is_needed[last] = 1;
    for (LemmaId i = last + 1; i-- > 0;) {
      if (is_needed[i] == 0) continue;
      for (const Lemma::Case& c : lemmas_[i].cases) is_needed[c.lemma] = 1;
    }
    std::vector<LemmaId> number(last + 1, 0);
    for (LemmaId i = 0; i <= last; ++i) {
      if (is_needed[i] == 0) continue;
      for (Lemma::Case& c : lemmas_[i].cases) c.lemma = number[c.lemma];
      number[i] = result_.proof.lemmas.size();
      result_.proof.lemmas.push_back(std::move(lemmas_[i]));
    }
    result_.proof.constraints = constraints_;
  }

  const Mesh& mesh_;
  Constraints constraints_;
  const std::function<bool()>& stop_;
  Sight sight_;
  ProofChecker checker_;
  EdgeRows rows_;
  std::vector<Pair> pairs_;
  std::vector<ProofEdge> known_;         ///< edges of all triangulations, then the chosen edges in their order
  std::vector<EdgeRows::Range> ranges_;  ///< of pairs, then of the known edges
  std::optional<MarginSimplex> root_;    ///< the program of the edges of all triangulations
  std::size_t n_root_ranges_ = 0;
  std::vector<Lemma> lemmas_;
  bool found_ = false, stopped_ = false;
  CompleteSearchResult result_;
};

}  // namespace

CompleteSearchResult search_completely(const Mesh& mesh, Constraints constraints, const std::function<bool()>& stop) {
  return CompleteSearch(mesh, constraints, stop).run();
}

}  // namespace temper

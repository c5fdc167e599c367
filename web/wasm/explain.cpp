// Explanations. The linear programs are solved on the side of JavaScript, by a solver of its own.
#include "temper/explain.hpp"

#include <utility>
#include <vector>

#include "answer.hpp"
#include "held_mesh.hpp"
#include "records.hpp"

namespace temper::wasm {
namespace {

/// Solves the problem: writes x and the multipliers, and returns the number of an LpStatus.
TEMPER_IMPORT(solve_lp)
int solve_lp(std::size_t columns, std::size_t rows, std::size_t entries, const double* cost, const double* column_lower,
             const double* column_upper, const double* row_lower, const double* row_upper, const int* row_start,
             const int* column, const double* value, double* primal, double* dual);
/// How many of the bad triangles are explained; 0 stops.
TEMPER_IMPORT(explained) int report_explained(std::size_t done, std::size_t all);

class SolverOutside final : public LpSolver {
 public:
  LpSolution solve(const LpProblem& p) override {
    LpSolution solution;
    std::vector<double> primal(p.n_columns()), dual(p.n_rows());
    solution.status =
        status_of(solve_lp(p.n_columns(), p.n_rows(), p.value.size(), p.cost.data(), p.column_lower.data(),
                           p.column_upper.data(), p.row_lower.data(), p.row_upper.data(), p.row_start.data(),
                           p.column.data(), p.value.data(), primal.data(), dual.data()));
    if (solution.status != LpStatus::optimal) return solution;
    for (std::size_t c = 0; c < p.n_columns(); ++c) solution.objective += p.cost[c] * primal[c];
    solution.primal = std::move(primal);
    solution.dual = std::move(dual);
    return solution;
  }

 private:
  static LpStatus status_of(int number) {
    constexpr LpStatus kAll[] = {LpStatus::optimal, LpStatus::infeasible, LpStatus::unbounded};
    return number >= 0 && number < 3 ? kAll[number] : LpStatus::failed;
  }
};

template <class Tag>
Json numbers(const std::vector<Id<Tag>>& ids) {
  Json list = Json::array();
  for (const Id<Tag> id : ids) list.push_back(number(id));
  return list;
}
Json place(Vec2 at) { return Json::array({number(at.x), number(at.y)}); }

Json to_json(const Mesh& mesh, const EdgeConflict& c) {
  return {{"edge", {number(mesh.origin(c.edge)), number(mesh.target(c.edge))}},
          {"halfedge", number(c.edge)},
          {"near_u", number(c.near_u)},
          {"near_v", number(c.near_v)},
          {"a", number(c.a)},
          {"b", number(c.b)},
          {"sum", number(c.sum)},
          {"split_at", number(c.split_at)}};
}

Json to_json(const Certificate& certificate) {
  Json terms = Json::array();
  for (const auto& [c, multiplier] : certificate.terms) {
    const Json constraint = {
        {"kind", name(c.kind)}, {"p", number(c.p)}, {"q", number(c.q)}, {"r", number(c.r)}, {"s", number(c.s)}};
    terms.push_back({constraint, number(multiplier)});
  }
  return {{"margin", number(certificate.margin)}, {"terms", terms}, {"constraints", name(certificate.constraints)}};
}

Json to_json(const CrossingSide& side) {
  return {{"triangles", numbers(side.triangles)},
          {"from_", number(side.from)},
          {"to", number(side.to)},
          {"widest", number(side.widest)},
          {"angle_deg", number(side.angle_deg)}};
}

Json to_json(const CrossingConflict& c) {
  return {{"p", number(c.p)},
          {"q", number(c.q)},
          {"length", number(c.length)},
          {"left", to_json(c.left)},
          {"right", to_json(c.right)}};
}

Json to_json(const FanCenter& c) {
  return {{"vertex", number(c.vertex)},
          {"on_boundary", c.on_boundary},
          {"angle_deg", number(c.angle_deg)},
          {"shortest", number(c.shortest)},
          {"longest", number(c.longest)},
          {"shortest_length", number(c.shortest_length)},
          {"longest_length", number(c.longest_length)}};
}

Json to_json(const Mesh& mesh, const Cure& c) {
  return {{"action", name(c.action)},
          {"text", cure_text(mesh, c)},
          {"edge", numbers(c.edge)},
          {"vertex", number(c.vertex)},
          {"triangle", number(c.triangle)},
          {"at", place(c.at)},
          {"verified", c.verified},
          {"conflict_only", c.conflict_only},
          {"triangles", c.triangles},
          {"ends_conflict", c.ends_conflict},
          {"left_out", c.left_out},
          {"margin", number(c.margin)},
          {"changed", c.changed}};
}

Json to_json(const Mesh& mesh, const Reason& r) {
  Json cures = Json::array();
  for (const Cure& cure : r.cures) cures.push_back(to_json(mesh, cure));
  return {{"kind", name(r.kind)},
          {"text", reason_text(mesh, r)},
          {"bad", numbers(r.bad)},
          {"conflict", numbers(r.conflict)},
          {"must_split", r.must_split ? to_json(mesh, *r.must_split) : Json(nullptr)},
          {"certificate", to_json(r.certificate)},
          {"margin", number(r.margin)},
          {"each", r.each},
          {"checked", r.checked},
          {"crossing", r.crossing ? to_json(*r.crossing) : Json(nullptr)},
          {"center", r.center ? to_json(*r.center) : Json(nullptr)},
          {"free", numbers(r.free)},
          {"least_margin", number(r.least_margin)},
          {"at", place(r.at)},
          {"cures_searched", r.cures_searched},
          {"cures", cures}};
}

}  // namespace

/// The answer is the explanation.
TEMPER_EXPORT(mesh_explain) int mesh_explain(const HeldMesh* held, const char* given, std::size_t size) {
  return done([&] {
    constexpr std::string_view kNames[] = {"cures", "whole"};
    const Json wanted = parse({given, size});
    expect_names(wanted, kNames);
    ExplainOptions options;
    take(wanted, "cures", options.cures), take(wanted, "whole", options.whole);
    options.progress = [](std::size_t done, std::size_t all) {
      return report_explained(done, all) != 0 ? Continue::yes : Continue::no;
    };
    SolverOutside solver;
    const Mesh& mesh = held->mesh;
    const Explanation why = or_fail(explain(mesh, solver, options));
    Json reasons = Json::array();
    for (const Reason& reason : why.reasons) reasons.push_back(to_json(mesh, reason));
    answer(Json{{"triangles", why.triangles},
                {"bad", why.bad},
                {"verdict", name(why.verdict)},
                {"changed", why.changed},
                {"margin", number(why.margin)},
                {"reasons", reasons}});
  });
}

}  // namespace temper::wasm

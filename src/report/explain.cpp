// The tables of explanations: reasons, conflicts and cures.
#include "temper/explain.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "temper/detail/geometry.hpp"
#include "temper/detail/report.hpp"

namespace temper {

const ReportTable& table_of(const DualReason*) {
  static const ReportTable table = report_table<DualReason>(
      "DualReason", "A dual that a criterion does not allow, with the reason.",
      {{"vertices", "Vertices of its edge or face", "", &DualReason::vertices},
       {"kind", "Kind of the dual; region: its part in one region", "", &DualReason::kind},
       {"over_l", "Signed length of the dual over ℓ of the edge or face; signed area of the dual over ℓ²", "",
        &DualReason::over_l},
       {"at", "Centroid of the edge or face; on a sphere longitude and latitude [degrees], and 0", "", &DualReason::at},
       {"why", "The reason: heights, and the angles across", "",
        [](const DualReason& r) { return NumberedText{r.why}; }}});
  return table;
}

const ReportTable& table_of(const DualExplanation*) {
  static const ReportTable table = report_table<DualExplanation>(
      "DualExplanation", "The violations of a criterion of duals.",
      {{"criterion", "The criterion", "", &DualExplanation::criterion},
       {"violations", "Number of duals that the criterion does not allow", "", &DualExplanation::violations},
       {"reasons", "Reasons, the worst first", "", &DualExplanation::reasons}});
  return table;
}
namespace {

using Pair = std::array<VertexId, 2>;

/// A reason, and what its sentence needs besides.
struct ReasonReport {
  const Mesh& mesh;
  const Reason& reason;
  const InputNames* names;
};

struct CureReport {
  const Mesh& mesh;
  const Cure& cure;
  const InputNames* names;
};

/// Members of the reason or cure of a report.
template <class T>
auto of(T Reason::*member) {
  return [member](const ReasonReport& r) -> const T& { return r.reason.*member; };
}
template <class T>
auto of(T Cure::*member) {
  return [member](const CureReport& r) -> const T& { return r.cure.*member; };
}
template <class T>
auto of(T Explanation::*member) {
  return [member](const ExplanationReport& r) -> const T& { return r.explanation.*member; };
}

template <class IdType>
std::optional<IdType> if_valid(IdType id) {
  return id.valid() ? std::optional(id) : std::nullopt;
}

/// Says whether a cure has a place of its own.
bool is_placed(const Cure& cure) {
  using Action = Cure::Action;
  return cure.action != Action::find_weights && cure.action != Action::optimize && cure.action != Action::flip_edge;
}

const ReportTable& table_of(const CureReport*) {
  using R = CureReport;
  static const ReportTable table = report_table<R>(
      "Cure", "A change that would cure a reason.",
      {{"action", "Kind of the change", "", of(&Cure::action)},
       {"edge", "Edge that is flipped or split", "",
        [](const R& r) {
          return r.cure.edge.empty() ? std::nullopt : std::optional<Pair>({r.cure.edge[0], r.cure.edge[1]});
        }},
       {"vertex", "Vertex that is moved", "", [](const R& r) { return if_valid(r.cure.vertex); }},
       {"triangle", "Triangle that gets a vertex", "", [](const R& r) { return if_valid(r.cure.triangle); }},
       {"at", "Place of the change; on the sphere longitude and latitude [degrees]", "",
        [](const R& r) { return is_placed(r.cure) ? std::optional(r.cure.at) : std::nullopt; }},
       {"verified",
        "A trial on a copy succeeded: the triangles of the neighborhood then have weights that make them "
        "well-centered, checked exactly",
        "", of(&Cure::verified)},
       {"conflict_only", "Only the triangles of the conflict, and those that the change touches, were tested", "",
        of(&Cure::conflict_only)},
       {"ends_conflict", "For a split: neither half of the edge must be split again, checked exactly", "",
        of(&Cure::ends_conflict)},
       {"margin", "Best margin of h/ℓ and d/ℓ after the cure", "",
        [](const R& r) { return r.cure.verified ? std::optional(r.cure.margin) : std::nullopt; }},
       {"margin_of", "Number of triangles that `margin` is for", "", of(&Cure::triangles)},
       {"left_out", "Number of bad triangles nearby that belong to other conflicts and were not tested", "",
        of(&Cure::left_out)},
       {"weights_changed", "For find_weights: number of nonzero weights around the bad triangles", "",
        of(&Cure::changed), ShownIn::libraries},
       {"text", "The cure in one sentence", "", [](const R& r) { return cure_text(r.mesh, r.cure, r.names); }}});
  return table;
}

}  // namespace

namespace {

double length_of(const EdgeConflictReport& r) {
  const VertexId u = r.mesh.origin(r.conflict.edge), v = r.mesh.target(r.conflict.edge);
  return distance(r.mesh.space(), r.mesh.point(u), r.mesh.point(v));
}

}  // namespace

const ReportTable& table_of(const EdgeConflictReport*) {
  using R = EdgeConflictReport;
  static const ReportTable table = report_table<R>(
      "EdgeConflict",
      "An edge u → v with contradictory vertices: one requires that the dual crosses it near u, another near v.",
      {{"edge", "Vertices u and v", "",
        [](const R& r) {
          return Pair{r.mesh.origin(r.conflict.edge), r.mesh.target(r.conflict.edge)};
        }},
       {"halfedge", "Halfedge from u to v", "", [](const R& r) { return r.conflict.edge; }, ShownIn::libraries},
       {"length", "Length of the edge", "length", length_of},
       {"near", "The vertex that requires a crossing near u, and the one near v", "",
        [](const R& r) {
          return Pair{r.conflict.near_u, r.conflict.near_v};
        }},
       {"within", "Largest distances of these crossings from u, and from v", "length",
        [](const R& r) {
          return std::array<double, 2>{r.conflict.a * length_of(r), r.conflict.b * length_of(r)};
        }},
       {"sum", "Sum of these distances over the length: at most 1 if there is no place for the crossing", "",
        [](const R& r) { return r.conflict.sum; }},
       {"split_at", "Part of the way from u: the middle of what is left, but at least 0.2 from each end", "",
        [](const R& r) { return r.conflict.split_at; }, ShownIn::libraries}});
  return table;
}

const ReportTable& table_of(const CrossingSide*) {
  using S = CrossingSide;
  static const ReportTable table = report_table<S>(
      "CrossingSide",
      "One side of the edge of a conflict: the interval in which well-centered triangles let the dual cross the edge.",
      {{"triangles", "Triangles of this side; the first one has the edge", "", &S::triangles},
       {"from", "Begin of the interval, as a distance from the edge's first vertex, exclusive", "length", &S::from},
       {"to", "End of the interval", "length", &S::to},
       {"widest_at", "Vertex of the largest angle of these triangles", "", &S::widest},
       {"angle_deg", "Largest angle of these triangles", "degrees", &S::angle_deg}});
  return table;
}

const ReportTable& table_of(const CrossingConflict*) {
  using C = CrossingConflict;
  static const ReportTable table =
      report_table<C>("CrossingConflict", "An edge whose two sides have disjoint intervals.",
                      {{"edge", "Vertices p and q of the edge", "",
                        [](const C& c) {
                          return Pair{c.p, c.q};
                        }},
                       {"length", "Length of the edge", "length", &C::length},
                       {"left", "Left side of p → q", "", &C::left},
                       {"right", "Right side of p → q", "", &C::right}});
  return table;
}

const ReportTable& table_of(const FanCenter*) {
  using C = FanCenter;
  static const ReportTable table =
      report_table<C>("FanCenter", "The common corner of the triangles of a fan.",
                      {{"vertex", "The corner", "", &C::vertex},
                       {"on_boundary", "The corner is on the boundary", "", &C::on_boundary},
                       {"angle_deg", "Angle of the domain at a boundary vertex; else 360", "degrees", &C::angle_deg},
                       {"shortest_edge", "Shortest edge of the fan at the corner", "",
                        [](const C& c) {
                          return Pair{c.vertex, c.shortest};
                        }},
                       {"shortest_length", "Its length", "length", &C::shortest_length},
                       {"longest_edge", "Longest edge of the fan at the corner", "",
                        [](const C& c) {
                          return Pair{c.vertex, c.longest};
                        }},
                       {"longest_length", "Its length", "length", &C::longest_length}});
  return table;
}

namespace {

/// The rows of a reason about proofs and cures.
std::vector<Field<ReasonReport>> proof_rows() {
  using R = ReasonReport;
  return {
      {"crossing", "Crossings, for edge, fan, and patches without closed rings", "", of(&Reason::crossing)},
      {"center", "Common vertex of all triangles, for edge, fan, patch, if there is one", "", of(&Reason::center)},
      {"must_split", "Conflict of the edge, for split", "",
       [](const R& r) {
         return r.reason.must_split ? std::optional(EdgeConflictReport{r.mesh, *r.reason.must_split}) : std::nullopt;
       }},
      {"certificate", "Proof for edge, fan, patch, interface; `check_certificate` accepts it", "",
       of(&Reason::certificate)},
      {"cures_searched", "Cures were searched for; else `cures` has only those that need no search", "",
       of(&Reason::cures_searched)},
      {"cures", "Cures, best first", "",
       [](const R& r) {
         std::vector<CureReport> cures;
         for (const Cure& cure : r.reason.cures) cures.push_back({r.mesh, cure, r.names});
         return cures;
       }},
      {"text", "The reason in words", "", [](const R& r) { return reason_text(r.mesh, r.reason, r.names); }}};
}

const ReportTable& table_of(const ReasonReport*) {
  using R = ReasonReport;
  static const ReportTable table = [] {
    ReportTable made = report_table<R>(
        "Reason", "A reason why triangles are not well-centered.",
        {{"kind", "Kind of the reason", "", of(&Reason::kind)},
         {"at", "Centroid of the worst triangle; on the sphere longitude and latitude [degrees]", "", of(&Reason::at)},
         {"triangles", "Triangles that are not well-centered for this reason, worst first", "", of(&Reason::bad)},
         {"least_margin", "Least h/ℓ or d/ℓ of these triangles as they are", "", of(&Reason::least_margin)},
         {"conflict",
          "For edge, fan, patch: smallest set of triangles for which no weights exist; `triangles` is a part of it", "",
          of(&Reason::conflict)},
         {"margin",
          "Best margin. For edge, fan, patch: of the conflict, at most 0. For weights: of the neighborhood, above 0",
          "", of(&Reason::margin)},
         {"margin_of", "Number of triangles that `margin` is for", "", of(&Reason::checked)},
         {"each", "`margin` is the least over bad triangles, each with the triangles that touch it", "",
          of(&Reason::each), ShownIn::libraries},
         {"free", "Corners that may move", "", of(&Reason::free)}});
    const std::vector<Field<R>> more = proof_rows();
    made.rows.insert(made.rows.end(), more.begin(), more.end());
    return made;
  }();
  return table;
}

}  // namespace

const ReportTable& table_of(const ExplanationReport*) {
  using R = ExplanationReport;
  static const ReportTable table = report_table<R>(
      "Explanation", "The result of ``explain``.",
      {{"triangles", "Number of triangles", "", of(&Explanation::triangles)},
       {"bad", "Number of triangles that are not well-centered", "", of(&Explanation::bad)},
       {"verdict", "Verdict on the whole mesh with its positions and connectivity. Feasible if no triangle is bad", "",
        of(&Explanation::verdict)},
       {"weights_changed", "For feasible: number of nonzero weights in the result of find_weights", "",
        [](const R& r) {
          const Explanation& e = r.explanation;
          return e.verdict == Feasibility::feasible ? std::optional(e.changed) : std::nullopt;
        }},
       {"margin", "Requested margin of these weights: 0.01, or half of the best margin if that is less", "",
        of(&Explanation::margin), ShownIn::libraries},
       {"reasons", "Reasons: certified ones first, by least margin; then by least_margin", "", [](const R& r) {
          std::vector<ReasonReport> reasons;
          for (const Reason& reason : r.explanation.reasons) reasons.push_back({r.mesh, reason, r.names});
          return reasons;
        }}});
  return table;
}

}  // namespace temper

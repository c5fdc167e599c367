// The tables of explanations of tetrahedra.
#include "temper/tets/explain.hpp"

#include <array>
#include <optional>
#include <vector>

#include "temper/detail/report.hpp"

namespace temper::tets {
namespace {

/// A bad tetrahedron with its mesh.
struct ReasonReport {
  const TetMesh& mesh;
  const Reason& reason;
};

/// Members of the reason or explanation of a report.
template <class T, class C>
auto of(T C::*member) {
  return [member](const ReasonReport& r) -> const T& { return r.reason.*member; };
}
template <class T>
auto of(T Explanation::*member) {
  return [member](const ExplanationReport& r) -> const T& { return r.explanation.*member; };
}

const ReportTable& table_of(const ReasonReport*) {
  using R = ReasonReport;
  static const ReportTable table = report_table<R>(
      "TetReason", "A tetrahedron that is not well-centered.",
      {{"tetrahedron", "Number of the tetrahedron, from 0", "", of(&Reason::tetrahedron)},
       {"vertices", "Its vertices", "", of(&Reason::vertices)},
       {"weights", "Their weights", "length²",
        [](const R& r) {
          const auto [a, b, c, d] = r.mesh.points(r.reason.tetrahedron);
          return std::array<double, 4>{a.w, b.w, c.w, d.w};
        }},
       {"at", "Its centroid", "", of(&Reason::at)},
       {"orthocenter", "Its orthocenter; not finite if it is flat", "", of(&Reason::orthocenter)},
       {"h_over_l", "Least h/ℓ of its faces", "", of(&Reason::h_over_l)},
       {"dihedral_deg", "Largest of its dihedral angles", "degrees", of(&Reason::dihedral_deg)},
       {"faces", "Its faces", "",
        [](const R& r) { return std::vector<FaceHeight>(r.reason.faces.begin(), r.reason.faces.end()); }},
       {"all_on_boundary", "All corners are on the boundary, or on interfaces between tensors", "",
        of(&Reason::all_on_boundary)},
       {"text", "The reason in words", "", [](const R& r) { return NumberedText{r.reason.why}; }},
       {"cure", "The change that may cure it; it is not tried", "", of(&Reason::cure), ShownIn::libraries}});
  return table;
}

}  // namespace

std::span<const std::string_view> words_of(Cure) {
  static const std::array<std::string_view, 4> words = {name(Cure::weights), name(Cure::optimize),
                                                        name(Cure::split_boundary), name(Cure::slide)};
  return words;
}

const ReportTable& table_of(const FaceHeight*) {
  using F = FaceHeight;
  static const ReportTable table =
      report_table<F>("FaceHeight", "The height of the orthocenter of a tetrahedron over one of its faces.",
                      {{"vertices", "Vertices of the face", "", &F::vertices},
                       {"boundary", "The face is on the boundary", "", &F::boundary},
                       {"at_interface", "The face is on an interface between tensors", "", &F::at_interface},
                       {"h", "Signed height, positive inside", "length", &F::h},
                       {"h_over_l", "The height over the length of the face", "", &F::h_over_l},
                       {"outside", "h ≤ 0, exact", "", &F::outside},
                       {"crossed", "Its own orthocenter is strictly inside it, exact", "", &F::crossed}});
  return table;
}

const ReportTable& table_of(const ExplanationReport*) {
  using R = ExplanationReport;
  static const ReportTable table = report_table<R>(
      "TetExplanation", "The result of ``explain`` for tetrahedra.",
      {{"tetrahedra", "Number of tetrahedra", "", [](const R& r) { return r.explanation.quality.tetrahedra; }},
       {"bad", "Number of tetrahedra with orthocenters outside", "", of(&Explanation::bad)},
       {"verdict",
        "Verdict on the whole mesh with its positions and connectivity; undecided if no weights were searched for", "",
        [](const R& r) { return r.explanation.verdict(); }},
       {"weights_changed", "For feasible: number of weights that change", "",
        [](const R& r) {
          const bool feasible = r.explanation.verdict() == Feasibility::feasible;
          return feasible ? std::optional(r.explanation.weights->moved) : std::nullopt;
        }},
       {"certificate", "Proof that no weights exist, if they were searched for and there are none", "",
        [](const R& r) -> const Certificate& {
          static const Certificate none;
          return r.explanation.weights ? r.explanation.weights->certificate : none;
        },
        ShownIn::libraries},
       {"all_on_boundary", "Number of bad tetrahedra with all corners on the boundary", "",
        of(&Explanation::all_on_boundary)},
       {"reasons", "Bad tetrahedra, the worst first", "", [](const R& r) {
          std::vector<ReasonReport> reasons;
          for (const Reason& reason : r.explanation.reasons) reasons.push_back({r.mesh, reason});
          return reasons;
        }}});
  return table;
}

}  // namespace temper::tets

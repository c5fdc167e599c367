// Weights by linear programming, certificates, and reasons: feasibility.hpp, connectivity.hpp, necessity.hpp and
// explain.hpp.
#include <chrono>
#include <limits>
#include <optional>
#include <variant>

#include "bind.hpp"
#include "reports.hpp"
#include "temper/detail/certificate_io.hpp"
#include "temper/detail/connectivity.hpp"
#include "temper/detail/lp.hpp"
#include "temper/detail/necessity.hpp"
#include "temper/detail/optimize_table.hpp"
#include "temper/explain.hpp"
#include "temper/feasibility.hpp"
#include "temper/tets/explain.hpp"
#include "temper/tets/weights.hpp"

TEMPER_PYTHON_NAMES(temper::LpStatus, "optimal", "infeasible", "unbounded", "failed");
TEMPER_PYTHON_NAMES(temper::WeightConstraint::Kind, "height", "crossing", "dual", "height_over_face", "dual_of_face",
                    "equal_crossing");
TEMPER_PYTHON_NAMES(temper::Constraints, "well_centered", "heights_only", "regular", "coefficients", "distances",
                    "completely_well_centered");
TEMPER_PYTHON_NAMES(temper::WeightGoal, "margin", "change", "elastic", "center", "accuracy", "least", "fewest");

namespace temper::python {
namespace {

py::tuple constraint_to_tuple(const WeightConstraint& c) {
  return py::make_tuple(to_python(name_of(c.kind)), to_python(c.p), to_python(c.q), to_python(c.r), to_python(c.s),
                        to_python(c.t));
}

py::list terms_to_list(const std::vector<Certificate::Term>& terms) {
  py::list list;
  for (const auto& term : terms) list.append(py::make_tuple(constraint_to_tuple(term.constraint), term.multiplier));
  return list;
}

}  // namespace

py::dict certificate_to_dict(const Certificate& certificate) {
  return Record()("margin", certificate.margin)("terms", terms_to_list(certificate.terms))(
             "constraints", name(certificate.constraints))
      .dict;
}

namespace {

/// None without lemmas.
py::object proof_to_python(const ConnectivityProof& proof) {
  if (proof.lemmas.empty()) return py::none();
  const auto edge = [](const ConnectivityProof::Edge& e) { return py::make_tuple(to_python(e[0]), to_python(e[1])); };
  py::list lemmas;
  for (const ConnectivityProof::Lemma& lemma : proof.lemmas) {
    py::list edges, cases;
    for (const ConnectivityProof::Edge& e : lemma.edges) edges.append(edge(e));
    for (const auto& [apex, number] : lemma.cases) cases.append(py::make_tuple(to_python(apex), number));
    const py::object side = lemma.terms.empty() ? py::object(edge(lemma.side)) : py::none();
    lemmas.append(Record()("edges", edges)("terms", terms_to_list(lemma.terms))("side", side)("cases", cases).dict);
  }
  return Record()("constraints", name(proof.constraints))("lemmas", lemmas).dict;
}

VertexId vertex_or_none(const py::handle& index) {
  const auto i = index.cast<std::int64_t>();
  return i < 0 || i >= INT32_MAX ? VertexId() : VertexId(static_cast<std::size_t>(i));
}

std::vector<Certificate::Term> terms_from(const py::handle& list) {
  std::vector<Certificate::Term> terms;
  for (const auto& item : list) {
    const auto term = item.cast<py::tuple>();
    const auto c = term[0].cast<py::tuple>();
    terms.push_back({{from_name<WeightConstraint::Kind>("kind", c[0].cast<std::string>()), vertex_or_none(c[1]),
                      vertex_or_none(c[2]), vertex_or_none(c[3]), vertex_or_none(c[4]), vertex_or_none(c[5])},
                     term[1].cast<double>()});
  }
  return terms;
}

Certificate certificate_from(const py::dict& d) {
  Certificate certificate;
  certificate.margin = d["margin"].cast<double>();
  certificate.constraints = from_name<Constraints>("constraints", d["constraints"].cast<std::string>());
  certificate.terms = terms_from(d["terms"]);
  return certificate;
}

ConnectivityProof proof_from(const py::dict& d) {
  const auto edge = [](const py::handle& pair) {
    const auto ends = pair.cast<py::tuple>();
    return ConnectivityProof::Edge{vertex_or_none(ends[0]), vertex_or_none(ends[1])};
  };
  ConnectivityProof proof;
  proof.constraints = from_name<Constraints>("constraints", d["constraints"].cast<std::string>());
  for (const auto& item : d["lemmas"]) {
    ConnectivityProof::Lemma lemma;
    for (const auto& e : item["edges"]) lemma.edges.push_back(edge(e));
    lemma.terms = terms_from(item["terms"]);
    if (!item["side"].is_none()) lemma.side = edge(item["side"]);
    for (const auto& each : item["cases"]) {
      const auto apex = each.cast<py::tuple>();
      lemma.cases.push_back({vertex_or_none(apex[0]), apex[1].cast<std::size_t>()});
    }
    proof.lemmas.push_back(std::move(lemma));
  }
  return proof;
}

/// Edges by their vertices; empty: all.
std::vector<HalfedgeId> prescribed(const Mesh& mesh, const py::object& edges) {
  std::vector<HalfedgeId> halfedges;
  if (edges.is_none()) return halfedges;
  const auto ends = edges.cast<Int64s>();
  for (py::ssize_t i = 0; i < ends.shape(0); ++i) {
    const VertexId a = vertex_id(mesh, ends.at(i, 0)), b = vertex_id(mesh, ends.at(i, 1));
    const HalfedgeId h = mesh.find_halfedge(a, b);
    halfedges.push_back(h.valid() ? h : mesh.find_halfedge(b, a));
    if (halfedges.back().valid()) continue;
    fail(ErrorCode::missing_edge, "edges: row " + std::to_string(i) + ": there is no edge between vertices " +
                                      std::to_string(a.index) + " and " + std::to_string(b.index));
  }
  if (halfedges.empty()) fail(ErrorCode::invalid_option, "edges: expected at least one, or None for all; found none");
  return halfedges;
}

py::dict best_to_dict(const BestMargin& best) {
  py::list tight;
  for (const WeightConstraint& c : best.tight) tight.append(constraint_to_tuple(c));
  return Record()("status", name_of(best.status))("margin", best.margin)("tight", tight)(
             "certificate", certificate_to_dict(best.certificate))("vertices", best.vertices)("weights", best.weights)
      .dict;
}

/// None, or the proof that weights are best.
py::object optimality_to_python(const std::optional<Optimality>& proof) {
  if (!proof) return py::none();
  py::list offsets;
  for (const OffsetTerm& term : proof->offsets)
    offsets.append(py::make_tuple(constraint_to_tuple(term.at), term.factor, term.target));
  return Record()("goal", name_of(proof->goal))("constraints", name(proof->constraints))("margin", proof->margin)(
             "objective", proof->objective)("gap", proof->gap)("iterations", proof->iterations)(
             "terms", terms_to_list(proof->terms))("offsets", offsets)
      .dict;
}

py::dict weight_report_to_dict(const WeightReport& r) {
  py::list violations;
  for (const Violation& v : r.violations) {
    violations.append(Record()("constraint", constraint_to_tuple(v.constraint))("value", v.value)(
                          "shortfall", v.shortfall)("angle_deg", v.angle_deg)
                          .dict);
  }
  return Record()("verdict", name(r.verdict))("margin", r.margin)("margin_kind", name(r.margin_kind))(
             "solved", r.solved)("asked", r.asked)("attained", r.attained)("moved", r.moved)("change", r.change)(
             "programs", r.programs)("largest", r.largest)("weights", r.weights)("violations", violations)(
             "certificate", certificate_to_dict(r.certificate))("optimality", optimality_to_python(r.optimality))
      .dict;
}

WeightOptions weight_options(const std::string& goal, double margin, bool from_input, std::size_t whole, int rings,
                             const std::string& constraints, double offset_factor, double boundary_offset_factor) {
  WeightOptions options;
  options.offset_factor = offset_factor;
  options.boundary_offset_factor = boundary_offset_factor;
  options.goal = from_name<WeightGoal>("goal", goal);
  options.margin = margin;
  options.from_input = from_input;
  options.whole = whole;
  options.rings = rings;
  options.constraints = from_name<Constraints>("constraints", constraints);
  return options;
}

py::dict search_connectivity(const PyMesh& self, const std::string& constraints, std::size_t programs,
                             double time_limit) {
  const auto mesh = self.read();
  Visitor visitor;
  const auto start = std::chrono::steady_clock::now();
  const auto stop = [&] {
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return !visitor.check_signals() || (time_limit > 0 && spent.count() >= time_limit);
  };
  const ConnectivityOptions options = {from_name<Constraints>("constraints", constraints), programs, stop};
  auto searched = aside([&] { return best_connectivity(*mesh, *clp_solver(), options); });
  visitor.raise();
  ConnectivityReport report = or_raise(std::move(searched));
  py::list steps;
  for (const ConnectivityStep& step : report.steps) {
    steps.append(Record()("kind", name(step.kind))("flips", step.flips)("margin", step.margin).dict);
  }
  PyMesh flipped = self.copy();
  flipped.replace(std::move(report.mesh), {});
  return Record()("mesh", py::cast(std::move(flipped)))("end", name(report.end))("before", report.before)(
             "margin", report.margin)("steps", steps)("programs", report.programs)("weights", report.weights)(
             "bound", report.bound)("complete_programs", report.complete_programs)("proof",
                                                                                   proof_to_python(report.proof))
      .dict;
}

py::list conditions_rows(std::span<const ConstraintsInfo> table) {
  py::list rows;
  for (const ConstraintsInfo& row : table) {
    rows.append(Record()("name", row.name)("keeps", row.keeps)("success", row.success)("failure", row.failure).dict);
  }
  return rows;
}

/// The weights that `find` finds for a mesh, or for its pieces in the metrics of tensors, which may be None.
template <class K, class AnyMesh, class Find>
py::dict weights_to_dict(const AnyMesh& mesh, const py::object& tensor, py::ssize_t corners, const Find& find) {
  if (tensor.is_none()) return Record{weight_report_to_dict(find(mesh))}("corner_weights", py::object(py::none())).dict;
  const auto [report, weights] = weights_in_metric(mesh, tensors_from<K>(tensor), find);
  return Record{weight_report_to_dict(report)}("corner_weights", corner_weights_to_python(weights, corners)).dict;
}

/// Null of a target whose criterion is well_centered.
template <class AnyMesh>
py::object explain_duals_of(const AnyMesh& mesh, const std::string& target, std::size_t most) {
  const std::string_view named = or_raise(target_named(target));
  or_raise(check_cells({}, {named}, cells_of(mesh)));
  const Criterion criterion = criterion_of_target(named);
  if (criterion == Criterion::well_centered) return py::none();
  return report_to_python(aside([&] { return explain_duals(mesh, criterion, most); }));
}

/// The functions of meshes of triangles, in the plane, on a sphere or in space.
template <class AnyMesh>
void bind_weights_of_triangles(py::module_& m) {
  m.def("find_weights", [](const AnyMesh& self, const std::string& goal, double margin, bool from_input,
                           std::size_t whole, int rings, const std::string& constraints, double offset_factor,
                           double boundary_offset_factor, const py::object& edges, const py::object& tensor) {
    const auto mesh = self.read();
    WeightOptions options =
        weight_options(goal, margin, from_input, whole, rings, constraints, offset_factor, boundary_offset_factor);
    options.edges = prescribed(*connectivity_of(self), edges);
    const auto found = [&](const auto& wanted) {
      return or_raise(
          aside([&] { return find_weights(wanted, *clp_solver(), options, interior_point_solver().get()); }));
    };
    if constexpr (std::is_same_v<AnyMesh, PySurface>) {
      return weight_report_to_dict(found(*mesh));
    } else {
      return weights_to_dict<Tensor>(*mesh, tensor, 3, found);
    }
  });
  m.def("weight_margin", [](const AnyMesh& self, const std::string& constraints, const py::object& edges) {
    const auto mesh = self.read();
    return weight_margin(*mesh, from_name<Constraints>("constraints", constraints),
                         prescribed(*connectivity_of(self), edges));
  });
  m.def("weight_change", [](const AnyMesh& self, const Doubles& before, const Doubles& after) {
    const auto mesh = self.read();
    const auto weights = [&](const Doubles& values) {
      const auto n = static_cast<std::size_t>(values.size());
      if (n != mesh->n_vertices()) {
        fail(ErrorCode::size_mismatch,
             "weights: expected " + std::to_string(mesh->n_vertices()) + ", found " + std::to_string(n));
      }
      IdVector<VertexId, double> own(n, 0.0);
      std::copy_n(values.data(), n, own.begin());
      return own;
    };
    return weight_change(*mesh, weights(before), weights(after));
  });
  m.def("check_certificate", [](const AnyMesh& self, const py::dict& certificate, const py::object& tensor) {
    const auto mesh = self.read();
    const Certificate proof = certificate_from(certificate);
    if constexpr (std::is_same_v<AnyMesh, PyMesh>) {
      if (!tensor.is_none())
        return std::string(name(check_certificate(in_metric(*mesh, tensors_from<Tensor>(tensor)), proof)));
    }
    return std::string(name(check_certificate(*mesh, proof)));
  });
  m.def("explain_duals", [](const AnyMesh& self, const std::string& target, std::size_t most) {
    return explain_duals_of(*self.read(), target, most);
  });
}

void bind_feasibility(py::module_& m) {
  m.def("constraints_table", [] { return conditions_rows(constraints_table()); });
  m.def("best_connectivity", search_connectivity);
  m.def("best_margin",
        [](const PyMesh& self, const py::object& triangles, const std::string& constraints, const py::object& edges) {
          const auto mesh = self.read();
          const auto wanted = from_name<Constraints>("constraints", constraints);
          std::vector<TriangleId> ids;
          if (!triangles.is_none()) {
            const auto numbers = triangles.cast<Int64s>();
            for (const std::int64_t t : as_span<std::int64_t>(numbers)) ids.push_back(triangle_id(*mesh, t));
          }
          const bool all = triangles.is_none();
          const std::vector<HalfedgeId> chosen = prescribed(*mesh, edges);
          return best_to_dict(aside([&] {
            const auto solver = clp_solver();
            return all ? best_margin(*mesh, *solver, wanted, chosen) : best_margin(*mesh, ids, *solver, wanted, chosen);
          }));
        });
  m.def("certificate_to_json", [](const py::dict& d) {
    return d.contains("lemmas") ? io::certificate_to_json(proof_from(d)) : io::certificate_to_json(certificate_from(d));
  });
  m.def("certificate_from_json", [](const std::string& text) {
    const io::VertexOfPoint all_points(std::numeric_limits<std::int32_t>::max());
    const io::AnyCertificate any = or_raise(io::certificate_from_json(text, all_points));
    const auto* const proof = std::get_if<ConnectivityProof>(&any);
    return proof != nullptr ? proof_to_python(*proof) : py::object(certificate_to_dict(std::get<Certificate>(any)));
  });
  m.def("check_proof", [](const PyMesh& self, const py::dict& proof) {
    const auto mesh = self.read();
    require_plane(*mesh, "check_certificate() of a proof over connectivities");
    return std::string(name(check_proof(*mesh, proof_from(proof))));
  });
}

// --- intrinsic triangulations ---------------------------------------------------------------------------------------

void bind_weights_of_intrinsic_meshes(py::module_& m) {
  m.def("find_intrinsic_weights", [](const PySurface& self, const std::string& goal, double margin, bool from_input,
                                     std::size_t whole, int rings, const std::string& constraints, double offset_factor,
                                     double boundary_offset_factor) {
    surfaces::IntrinsicMesh mesh(self.mesh());
    const WeightOptions options =
        weight_options(goal, margin, from_input, whole, rings, constraints, offset_factor, boundary_offset_factor);
    const surfaces::IntrinsicWeights found = or_raise(
        aside([&] { return find_intrinsic_weights(mesh, *clp_solver(), options, interior_point_solver().get()); }));
    const py::dict numbers = Record()("flips", found.flips.flips)("blocked", found.flips.blocked)(
                                 "bad_before", found.bad_before)("bad_after", found.bad_after)("rounds", found.rounds)
                                 .dict;
    return py::make_tuple(weight_report_to_dict(found.report), numbers,
                          PyIntrinsic{std::make_shared<const surfaces::IntrinsicMesh>(std::move(mesh))});
  });
  m.def("check_certificate", [](const PyIntrinsic& self, const py::dict& certificate, const py::object& /*tensor*/) {
    return std::string(name(check_certificate(*self.mesh, certificate_from(certificate))));
  });
}

// --- tetrahedra ---------------------------------------------------------------------------------------------------

void bind_weights_of_tetrahedra(py::module_& m) {
  m.def("tet_constraints_table", [] { return conditions_rows(tets::constraints_table()); });
  m.def("tet_find_weights", [](const PyTetMesh& self, const std::string& goal, double margin, bool from_input,
                               std::size_t whole, int rings, const std::string& constraints, double offset_factor,
                               double boundary_offset_factor, const py::object& tensor) {
    const auto loaded = self.loaded;
    const WeightOptions options =
        weight_options(goal, margin, from_input, whole, rings, constraints, offset_factor, boundary_offset_factor);
    const auto found = [&](const auto& wanted) {
      return or_raise(
          aside([&] { return tets::find_weights(wanted, *clp_solver(), options, interior_point_solver().get()); }));
    };
    return weights_to_dict<Tensor3>(loaded->mesh, tensor, 4, found);
  });
  m.def("tet_weight_margin", [](const PyTetMesh& self, const std::string& constraints) {
    return tets::weight_margin(self.mesh(), from_name<Constraints>("constraints", constraints));
  });
  m.def("tet_check_certificate", [](const PyTetMesh& self, const py::dict& certificate, const py::object& tensor) {
    const tets::TetMesh& mesh = self.mesh();
    const Certificate proof = certificate_from(certificate);
    const bool is_plain = tensor.is_none();
    return std::string(name(is_plain ? tets::check_certificate(mesh, proof)
                                     : tets::check_certificate(in_metric(mesh, tensors_from<Tensor3>(tensor)), proof)));
  });
}

// --- necessity ----------------------------------------------------------------------------------------------------

void bind_necessity(py::module_& m) {
  m.def("edge_conflict", [](const PyMesh& self, std::int64_t h, double up_to) -> py::object {
    const auto mesh = self.read();
    require_no_period(*mesh, "edge_conflict()");
    const auto conflict = edge_conflict(*mesh, halfedge_id(*mesh, h), up_to);
    return conflict ? report_to_python(EdgeConflictReport{*mesh, *conflict}) : py::none();
  });
  m.def("edges_that_must_be_split", [](const PyMesh& self, double up_to) {
    const auto mesh = self.read();
    require_no_period(*mesh, "edges_that_must_be_split()");
    py::list list;
    for (const EdgeConflict& c : edges_that_must_be_split(*mesh, up_to))
      list.append(report_to_python(EdgeConflictReport{*mesh, c}));
    return list;
  });
}

// --- explain ------------------------------------------------------------------------------------------------------

py::object explain_mesh(const PyMesh& self, std::size_t cures, std::size_t whole, const py::object& progress) {
  const auto mesh = self.read();
  ExplainOptions options;
  options.cures = cures;
  options.whole = whole;
  Visitor visitor;
  options.progress = [&](std::size_t done, std::size_t all) {
    bool go_on = visitor.check_signals();
    if (go_on && !progress.is_none()) {
      go_on = visitor.call([&] { return !(progress(done, all).is(py::bool_(false))); });
    }
    return go_on ? Continue::yes : Continue::no;
  };
  auto result = aside([&] { return explain(*mesh, *clp_solver(), options); });
  visitor.raise();
  const Explanation why = or_raise(std::move(result));
  return report_to_python(ExplanationReport{*mesh, why});
}

/// Cures and progress are for triangles of the plane or the sphere.
py::object explain_surface(const PySurface& self, std::size_t /*cures*/, std::size_t whole,
                           const py::object& /*progress*/) {
  const auto mesh = self.read();
  return report_to_python(
      or_raise(aside([&] { return surfaces::explain(*mesh, *clp_solver(), mesh->n_triangles(), whole); })));
}

py::object explain_tetrahedra(const PyTetMesh& self, std::size_t whole) {
  const auto loaded = self.loaded;
  const tets::ExplainOptions options = {.whole = whole};
  const tets::Explanation why = or_raise(aside([&] { return tets::explain(loaded->mesh, *clp_solver(), options); }));
  return report_to_python(tets::ExplanationReport{loaded->mesh, why});
}

}  // namespace

void bind_weights(py::module_& m) {
  bind_feasibility(m);
  bind_weights_of_triangles<PyMesh>(m);
  bind_weights_of_triangles<PySurface>(m);
  bind_weights_of_intrinsic_meshes(m);
  bind_weights_of_tetrahedra(m);
  bind_necessity(m);
  m.def("explain", explain_mesh);
  m.def("explain", explain_surface);
  m.def("tet_explain", explain_tetrahedra);
  m.def("tet_explain_duals", [](const PyTetMesh& self, const std::string& target, std::size_t most) {
    return explain_duals_of(self.loaded->mesh, target, most);
  });
}

}  // namespace temper::python

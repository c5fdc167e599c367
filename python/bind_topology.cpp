// Bindings of regularity and topology: flips, removals and insertions.
#include "bind.hpp"
#include "optimize_options.hpp"
#include "temper/regularity.hpp"
#include "temper/topology.hpp"

TEMPER_PYTHON_NAMES(temper::FlipStatus, "possible", "boundary", "constrained", "not_convex");
TEMPER_PYTHON_NAMES(temper::RemovalStatus, "possible", "fixed", "boundary_corner", "constrained", "no_triangulation");
TEMPER_PYTHON_NAMES(temper::InsertionStatus, "possible", "outside", "at_vertex", "on_boundary", "on_constrained",
                    "hidden", "not_regular", "in_quadrilateral", "inverted");

namespace temper::python {
namespace {

// --- regularity -----------------------------------------------------------------------------------------------

py::array edges_at(const Mesh& mesh, const std::vector<HalfedgeId>& halfedges) {
  std::vector<std::array<VertexId, 2>> edges;
  for (const HalfedgeId h : halfedges) edges.push_back({mesh.origin(h), mesh.target(h)});
  return rows_of<VertexId>(std::span<const std::array<VertexId, 2>>(edges));
}

py::dict restore(PyMesh& self, const std::string& policy) {
  const auto wanted = from_name<HiddenPolicy>("policy", policy);
  Mesh& mesh = self.change();
  const Restoration r = restore_regularity(mesh, wanted);
  Record record;
  record("flips", r.flips)("stuck", edges_at(mesh, r.stuck))("hidden", r.hidden)("removed", r.removed)(
      "undone", r.undone)("regular", r.regular());
  record("vertices", r.removed.empty() ? IdVector<VertexId, VertexId>() : self.compact());
  return record.dict;
}

void bind_regularity(py::module_& m) {
  m.def("is_regular", [](const PyMesh& self, std::int64_t h) {
    const auto mesh = self.read_with_erased();
    return is_regular(*mesh, halfedge_id(*mesh, h));
  });
  m.def("count_non_regular_edges", [](const PyMesh& self, bool with_constrained, const py::object& threads) {
    const auto mesh = self.read_with_erased();
    const auto count = threads_from(threads);
    const py::gil_scoped_release release;
    return count_non_regular_edges(*mesh, with_constrained, make_threads(count).get());
  });
  m.def("restore_regularity", restore);
  m.def("flip_threshold", [](const PyMesh& self, std::int64_t v, double x, double y, double w) {
    const auto mesh = self.read();
    return flip_threshold(*mesh, vertex_id(*mesh, v), {x, y, w});
  });
  m.def("weight_flip_threshold", [](const PyMesh& self, std::int64_t v, double direction) {
    const auto mesh = self.read();
    return weight_flip_threshold(*mesh, vertex_id(*mesh, v), direction);
  });
  m.def("position_flip_threshold", [](const PyMesh& self, std::int64_t v, double x, double y) {
    const auto mesh = self.read();
    require_plane(*mesh, "position_flip_threshold()");
    return position_flip_threshold(*mesh, vertex_id(*mesh, v), {x, y});
  });
}

// --- topology: a plan remembers the state of the mesh that it is for ------------------------------------------

template <class Plan>
struct PlanOf {
  Plan plan;
  std::uint64_t version;
};
using PyRemoval = PlanOf<RemovalPlan>;
using PyInsertion = PlanOf<InsertionPlan>;

template <class Plan>
void check_plan(const PyMesh& mesh, const PlanOf<Plan>& plan, bool committable) {
  if (plan.version != mesh.version())
    fail(ErrorCode::invalid_option, "the plan is for another mesh, or another state of this one");
  if (!committable) {
    fail(ErrorCode::invalid_option, "the plan cannot be committed: " + std::string(name_of(plan.plan.status)));
  }
}

WeightedPoint finite_point(double x, double y, double w) {
  if (!is_exact_coordinate(x) || !is_exact_coordinate(y) || !is_exact_weight(w)) {
    fail(ErrorCode::out_of_scale, "the point or its weight is not finite, or out of the range of exact arithmetic");
  }
  return {x, y, w};
}

/// A member of a plan as Python's value; rows of ids are tuples, and a status is its name.
template <class Member>
py::object member_to_python(const Member& member) {
  if constexpr (std::is_enum_v<Member>) {
    return to_python(name_of(member));
  } else if constexpr (requires { typename std::tuple_size<typename Member::value_type>::type; }) {
    py::list list;
    for (const auto& row : member) list.append(to_python(row));
    return list;
  } else {
    return to_python(member);
  }
}

template <class Plan, class Member>
void add_member(py::class_<PlanOf<Plan>>& plans, const char* name, Member Plan::*member, const char* doc) {
  plans.def_property_readonly(
      name, [member](const PlanOf<Plan>& p) { return member_to_python(p.plan.*member); }, doc);
}

void bind_removal(py::module_& m) {
  py::class_<PyRemoval> plans(m, "RemovalPlan",
                              "What remove_vertex will do, for the mesh as it is: a value, to be priced, thrown away, "
                              "or written down by the vertices' numbers.");
  add_member(plans, "status", &RemovalPlan::status,
             "possible, fixed, boundary_corner, constrained, or no_triangulation.");
  add_member(plans, "vertex", &RemovalPlan::vertex, "The vertex to be removed.");
  add_member(plans, "first", &RemovalPlan::first, "A halfedge out of vertex, to link[0].");
  add_member(plans, "link", &RemovalPlan::link, "Its neighbors, counter-clockwise.");
  add_member(plans, "triangles", &RemovalPlan::triangles, "The new triangles, counter-clockwise.");
  m.def("plan_removal", [](const PyMesh& self, std::int64_t v) {
    const auto mesh = self.read_with_erased();
    return PyRemoval{plan_removal(*mesh, vertex_id(*mesh, v)), self.version()};
  });
  m.def("plan_collapse", [](const PyMesh& self, std::int64_t v, std::int64_t into) {
    const auto mesh = self.read_with_erased();
    return PyRemoval{plan_collapse(*mesh, vertex_id(*mesh, v), vertex_id(*mesh, into)), self.version()};
  });
  m.def("removal_from_names", [](const PyMesh& self, std::int64_t v, std::int64_t first, const py::sequence& corners) {
    const auto mesh = self.read_with_erased();
    std::vector<std::array<VertexId, 3>> triangles;
    for (const auto& t : corners) triangles.push_back(ids_from<VertexId, 3>(t));
    return PyRemoval{removal_from_names(*mesh, vertex_id(*mesh, v), vertex_id(*mesh, first), triangles),
                     self.version()};
  });
  m.def("remove_vertex", [](PyMesh& self, const PyRemoval& plan) {
    check_plan(self, plan, plan.plan.status == RemovalStatus::possible);
    remove_vertex(self.change(), plan.plan);
    self.set_erased();
  });
}

void bind_insertion_plan(py::module_& m) {
  py::class_<PyInsertion> plans(
      m, "InsertionPlan", "What insert_vertex will do, for the mesh as it is: a value, to be priced or thrown away.");
  add_member(
      plans, "status", &InsertionPlan::status,
      "possible, outside, at_vertex, on_boundary, on_constrained, hidden, not_regular, in_quadrilateral, or inverted.");
  add_member(plans, "point", &InsertionPlan::point, "x, y, w of the new vertex.");
  add_member(plans, "triangle", &InsertionPlan::triangle, "The triangle that the point is in.");
  add_member(plans, "edge", &InsertionPlan::edge, "The halfedge of this triangle that will be split, or -1.");
  add_member(plans, "cavity", &InsertionPlan::cavity, "The triangles that the new ones replace.");
  add_member(plans, "link", &InsertionPlan::link, "The vertices around the new one, counter-clockwise.");
  add_member(plans, "rim", &InsertionPlan::rim, "The cavity's outer halfedges, from inside it.");
  add_member(plans, "flips", &InsertionPlan::flips,
             "The edges that are flipped to the new vertex, in this order, after the insertion.");
}

void bind_insertion(py::module_& m) {
  bind_insertion_plan(m);
  m.def("plan_insertion", [](const PyMesh& self, double x, double y, double w, std::int64_t near) {
    const auto mesh = self.read_with_erased();
    require_plane(*mesh, "plan_insertion()");
    return PyInsertion{plan_insertion(*mesh, finite_point(x, y, w), triangle_id(*mesh, near)), self.version()};
  });
  m.def("plan_split", [](const PyMesh& self, std::int64_t h, double t) {
    if (!(t > 0 && t < 1)) fail(ErrorCode::invalid_option, "t: expected a number between 0 and 1");
    const auto mesh = self.read_with_erased();
    require_plane(*mesh, "plan_split()");
    return PyInsertion{plan_split(*mesh, halfedge_id(*mesh, h), t), self.version()};
  });
  m.def("plan_split_at", [](const PyMesh& self, std::int64_t h, double x, double y, double w) {
    const auto mesh = self.read_with_erased();
    require_plane(*mesh, "plan_split()");
    return PyInsertion{plan_split(*mesh, halfedge_id(*mesh, h), finite_point(x, y, w)), self.version()};
  });
  m.def("plan_center", [](const PyMesh& self, std::int64_t t) {
    const auto mesh = self.read_with_erased();
    require_plane(*mesh, "plan_center()");
    return PyInsertion{plan_center(*mesh, mesh->corners(triangle_id(*mesh, t))), self.version()};
  });
  m.def("insert_vertex", [](PyMesh& self, const PyInsertion& plan) {
    const InsertionStatus status = plan.plan.status;
    check_plan(self, plan, status == InsertionStatus::possible || status == InsertionStatus::not_regular);
    return to_python(insert_vertex(self.change(), plan.plan));
  });
  m.def("interpolated_weight", [](const PyMesh& self, std::int64_t t, double x, double y) {
    const auto mesh = self.read_with_erased();
    require_plane(*mesh, "interpolated_weight()");
    return interpolated_weight(*mesh, triangle_id(*mesh, t), {x, y});
  });
  m.def("split_weight", [](double a, double b, double squared, double t) { return split_weight(a, b, squared, t); });
}

py::dict grade(PyMesh& self, double ratio) {
  if (!(ratio >= 2)) fail(ErrorCode::invalid_option, "ratio: expected 2 or more");
  Mesh mesh = *self.read();
  require_plane(mesh, "grade_boundary()");
  const std::size_t n = mesh.n_vertices();
  const Grading g = grade_boundary(mesh, ratio);
  IdVector<VertexId, VertexId> vertices(mesh.n_vertices());
  for (const VertexId v : IdRange<VertexId>(n)) vertices[v] = v;
  self.replace(std::move(mesh), vertices);
  return Record()("vertices", g.vertices)("inside", g.inside)("flips", g.flips)("refused", g.refused).dict;
}

}  // namespace

void bind_topology(py::module_& m) {
  bind_regularity(m);
  m.def("can_flip", [](const PyMesh& self, std::int64_t h) {
    const auto mesh = self.read_with_erased();
    return std::string(name_of(can_flip(*mesh, halfedge_id(*mesh, h))));
  });
  m.def("flip", [](PyMesh& self, std::int64_t index) {
    const HalfedgeId h = halfedge_id(*self.read_with_erased(), index);
    if (const FlipStatus status = can_flip(*self.read_with_erased(), h); status != FlipStatus::possible) {
      fail(ErrorCode::invalid_option,
           "halfedge " + std::to_string(index) + " cannot be flipped: " + std::string(name_of(status)));
    }
    return to_python(flip(self.change(), h));
  });
  bind_removal(m);
  bind_insertion(m);
  m.def("plan_boundary_grading", [](const PyMesh& self, double ratio, double widest) {
    const auto mesh = self.read();
    require_plane(*mesh, "plan_boundary_grading()");
    const GradingPlan plan = plan_boundary_grading(*mesh, ratio, widest);
    py::list cuts;
    for (const EdgeSplits& c : plan.cuts) cuts.append(py::make_tuple(c.a.index, c.b.index, to_python(c.at)));
    return Record()("cuts", cuts)("vertices", plan.vertices)("ratio_before", plan.ratio_before)("ratio_after",
                                                                                                plan.ratio_after)
        .dict;
  });
  m.def("triangles_without_free_corner", [](const PyMesh& self) {
    const auto mesh = self.read();
    require_plane(*mesh, "triangles_without_free_corner()");
    const auto triangles = triangles_without_free_corner(*mesh);
    return rows_of<VertexId>(std::span<const std::array<VertexId, 3>>(triangles));
  });
  m.def("grade_boundary", grade);
}

}  // namespace temper::python

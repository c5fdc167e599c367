// Bindings of functions that change meshes, except optimize (bind_optimize.cpp): regularity, topology, size, the
// mesher.
#include <limits>

#include "bind.hpp"
#include "optimize_options.hpp"
#include "reports.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesher.hpp"
#include "temper/regularity.hpp"
#include "temper/solvers.hpp"
#include "temper/topology.hpp"

TEMPER_PYTHON_NAMES(temper::FlipStatus, "possible", "boundary", "constrained", "not_convex");
TEMPER_PYTHON_NAMES(temper::RemovalStatus, "possible", "fixed", "boundary_corner", "constrained", "no_triangulation");
TEMPER_PYTHON_NAMES(temper::InsertionStatus, "possible", "outside", "at_vertex", "on_boundary", "on_constrained",
                    "hidden", "not_regular", "in_quadrilateral", "inverted");
TEMPER_PYTHON_NAMES(temper::Enclosed, "by_points", "all", "alternate");

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

// --- topology: a plan remembers the state of the mesh that it is for
// ----------------------------------------------------

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

py::list triangles_list(const std::vector<std::array<VertexId, 3>>& triangles) {
  py::list list;
  for (const auto& t : triangles) list.append(to_python(t));
  return list;
}

void bind_removal(py::module_& m) {
  py::class_<PyRemoval>(m, "RemovalPlan",
                        "What remove_vertex will do, for the mesh as it is: a value, to be priced, thrown away, or "
                        "written down by the vertices' numbers.")
      .def_property_readonly(
          "status", [](const PyRemoval& p) { return to_python(name_of(p.plan.status)); },
          "possible, fixed, boundary_corner, constrained, or no_triangulation.")
      .def_property_readonly(
          "vertex", [](const PyRemoval& p) { return to_python(p.plan.vertex); }, "The vertex to be removed.")
      .def_property_readonly(
          "first", [](const PyRemoval& p) { return to_python(p.plan.first); }, "A halfedge out of vertex, to link[0].")
      .def_property_readonly(
          "link", [](const PyRemoval& p) { return to_python(p.plan.link); }, "Its neighbors, counter-clockwise.")
      .def_property_readonly(
          "triangles", [](const PyRemoval& p) { return triangles_list(p.plan.triangles); },
          "The new triangles, counter-clockwise.");
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

void bind_insertion(py::module_& m) {
  py::class_<PyInsertion>(m, "InsertionPlan",
                          "What insert_vertex will do, for the mesh as it is: a value, to be priced or thrown away.")
      .def_property_readonly(
          "status", [](const PyInsertion& p) { return to_python(name_of(p.plan.status)); },
          "possible, outside, at_vertex, on_boundary, on_constrained, hidden, not_regular, in_quadrilateral, or "
          "inverted.")
      .def_property_readonly(
          "point", [](const PyInsertion& p) { return to_python(p.plan.point); }, "x, y, w of the new vertex.")
      .def_property_readonly(
          "triangle", [](const PyInsertion& p) { return to_python(p.plan.triangle); },
          "The triangle that the point is in.")
      .def_property_readonly(
          "edge", [](const PyInsertion& p) { return to_python(p.plan.edge); },
          "The halfedge of this triangle that will be split, or -1.")
      .def_property_readonly(
          "cavity", [](const PyInsertion& p) { return to_python(p.plan.cavity); },
          "The triangles that the new ones replace.")
      .def_property_readonly(
          "link", [](const PyInsertion& p) { return to_python(p.plan.link); },
          "The vertices around the new one, counter-clockwise.")
      .def_property_readonly(
          "rim", [](const PyInsertion& p) { return to_python(p.plan.rim); },
          "The cavity's outer halfedges, from inside it.")
      .def_property_readonly(
          "flips",
          [](const PyInsertion& p) {
            py::list list;
            for (const auto& edge : p.plan.flips) list.append(to_python(edge));
            return list;
          },
          "The edges that are flipped to the new vertex, in this order, after the insertion.");
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

void bind_topology(py::module_& m) {
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
  m.def("grade_boundary", [](PyMesh& self, double ratio) {
    if (!(ratio >= 2)) fail(ErrorCode::invalid_option, "ratio: expected 2 or more");
    Mesh mesh = *self.read();
    require_plane(mesh, "grade_boundary()");
    const std::size_t n = mesh.n_vertices();
    const Grading g = grade_boundary(mesh, ratio);
    IdVector<VertexId, VertexId> vertices(mesh.n_vertices());
    for (const VertexId v : IdRange<VertexId>(n)) vertices[v] = v;
    self.replace(std::move(mesh), vertices);
    return Record()("vertices", g.vertices)("inside", g.inside)("flips", g.flips)("refused", g.refused).dict;
  });
}

// --- size -----------------------------------------------------------------------------------------------------

void bind_size(py::module_& m) {
  py::class_<SizeField>(m, "SizeField")
      .def("at",
           [](const SizeField& field, const Doubles& points) {
             const bool plane = field.mesh().space().is_plane();
             std::vector<WeightedPoint> places;
             if (plane) {
               for (const Vec2 p : as_span<Vec2>(points)) places.push_back({p.x, p.y, 0});
             } else {
               const auto all = as_span<WeightedPoint>(points);
               places.assign(all.begin(), all.end());
             }
             std::vector<double> sizes;
             py::array_t<bool> outside(Shape{static_cast<py::ssize_t>(places.size())});
             bool* out = outside.mutable_data();
             TriangleId hint;
             for (const WeightedPoint& p : places) {
               if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.w))
                 fail(ErrorCode::not_finite, "points are not finite");
               if (!plane && length(as_vector(p)) == 0)
                 fail(ErrorCode::not_on_sphere, "the center of the sphere is in no direction");
               const SizeField::Sample sample = field.at(p, hint);
               hint = sample.triangle;
               sizes.push_back(sample.size);
               *out++ = sample.outside;
             }
             return py::make_tuple(to_python(sizes), outside);
           })
      .def("radius", [](const SizeField& field) { return field.mesh().space().radius(); })
      .def("mesh", [](const SizeField& field) { return PyMesh(field.mesh()); })
      .def("values", [](const SizeField& field) {
        std::vector<double> sizes;
        for (const VertexId v : field.mesh().vertices()) sizes.push_back(field.at(v));
        return to_python(sizes);
      });
  m.def("size_field_from_values", [](const PyMesh& self, const Doubles& sizes) {
    return or_raise(SizeField::from_values(*self.read(), as_span<double>(sizes)));
  });
  m.def("input_size_field", [](const PyMesh& self) { return input_size_field(*self.read()); });
  m.def("local_size", [](const PyMesh& self) {
    const auto sizes = local_sizes(*self.read());
    return to_python(std::vector<double>(sizes.begin(), sizes.end()));
  });
  m.def("relative_lengths", [](const PyMesh& self) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const auto mesh = self.read();
    const auto sizes = local_sizes(*mesh);
    std::vector<std::array<double, 2>> lengths;
    for (const HalfedgeId h : mesh->halfedges()) {
      if (!mesh->is_edge_representative(h)) continue;
      const auto [edge, dual] =
          mesh->is_boundary(h) ? RelativeLengths{kNone, kNone} : relative_lengths(*mesh, sizes, h);
      lengths.push_back({edge, dual});
    }
    return rows_of<double>(std::span<const std::array<double, 2>>(lengths));
  });
  m.def("sizes_from_depths", [](const Doubles& depths, double per_wavelength, double period, double time_step,
                                double courant, double least, double largest) {
    const DepthSizes rules = {per_wavelength, period, time_step, courant, least, largest};
    return array_of<double>(or_raise(sizes_from_depths(as_span<double>(depths), rules)));
  });
  m.def("measure_size", [](const PyMesh& self, const SizeField& field) {
    const auto mesh = self.read();
    if (mesh->space().kind() != field.mesh().space().kind()) {
      fail(ErrorCode::unsupported, "one of mesh and field is of the plane and the other of a sphere");
    }
    return report_to_python(measure_size(*mesh, field));
  });
}

// --- the mesher -------------------------------------------------------------------------------------------------

/// The names of a file. An outline from that file keeps them.
struct PyNames {
  std::shared_ptr<const OutlineNames> names;
};

std::optional<double> size_or_none(const py::handle& value) {
  if (value.is_none()) return std::nullopt;
  return value.cast<double>();
}

std::vector<OutlineTag> outline_tags_from(const py::handle& rows) {
  std::vector<OutlineTag> tags;
  const auto pairs = rows.cast<Int32s>();
  for (const auto& [element, tag] : as_span<std::array<std::int32_t, 2>>(pairs)) tags.push_back({element, tag});
  return tags;
}

py::array rows_of_tags(const std::vector<OutlineTag>& tags) {
  static_assert(sizeof(OutlineTag) == 2 * sizeof(std::int32_t));
  return rows_of<std::int32_t>(std::span<const OutlineTag>(tags));
}

Outline outline_from(const py::dict& d) {
  Outline outline;
  const auto points = d["points"].cast<Doubles>();
  const auto vertices = as_span<Vec2>(points);
  outline.points.assign(vertices.begin(), vertices.end());
  const auto ends = d["segments"].cast<Int32s>();
  const auto tags = d["segment_tags"].cast<Int32s>();
  const auto pairs = as_span<std::array<std::int32_t, 2>>(ends);
  if (static_cast<std::size_t>(tags.size()) != pairs.size()) {
    fail(ErrorCode::size_mismatch,
         "segment_tags: expected " + std::to_string(pairs.size()) + ", found " + std::to_string(tags.size()));
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) outline.segments.push_back({pairs[i], tags.data()[i]});
  const auto faces = d["faces"].cast<Int32s>();
  for (const std::int32_t segment : as_span<std::int32_t>(faces)) {
    const auto i = static_cast<std::size_t>(std::int64_t{segment});
    if (i >= outline.segments.size()) {
      fail(ErrorCode::index_out_of_range, "faces: the number " + std::to_string(segment) +
                                              " is of no segment; there are " +
                                              std::to_string(outline.segments.size()));
    }
    outline.segments[i].as = LineKind::faces;
  }
  const auto holes = d["holes"].cast<Doubles>();
  for (const Vec2 hole : as_span<Vec2>(holes)) outline.holes.push_back(hole);
  for (const auto& item : d["regions"]) {
    const auto r = item.cast<py::tuple>();
    outline.regions.push_back(
        {{r[0].cast<double>(), r[1].cast<double>()}, r[2].cast<std::int32_t>(), size_or_none(r[3])});
  }
  for (const auto& item : d["parts"]) {
    const auto p = item.cast<py::tuple>();
    const auto segments = p[1].cast<Int32s>();
    const auto numbers = as_span<std::int32_t>(segments);
    outline.parts.push_back({p[0].cast<std::int32_t>(), {numbers.begin(), numbers.end()}, size_or_none(p[2])});
  }
  outline.point_tags = outline_tags_from(d["point_tags"]);
  outline.further_tags = outline_tags_from(d["further_tags"]);
  outline.groups = physical_names_from(d["groups"]);
  for (const auto& item : d["sizes"]) {
    const auto s = item.cast<py::tuple>();
    outline.sizes.push_back({{s[0].cast<std::int32_t>(), s[1].cast<std::int32_t>()}, s[2].cast<double>()});
  }
  for (const auto& item : d["rings"]) {
    const auto r = item.cast<py::tuple>();
    const auto segments = r[0].cast<Int32s>();
    const auto numbers = as_span<std::int32_t>(segments);
    outline.rings.push_back({{numbers.begin(), numbers.end()}, r[1].cast<std::int32_t>()});
  }
  if (!d["names"].is_none()) outline.names = d["names"].cast<PyNames>().names;
  return outline;
}

py::dict outline_to_dict(const Outline& outline) {
  std::vector<std::array<std::int32_t, 2>> ends;
  std::vector<std::int32_t> tags, faces;
  for (const OutlineSegment& s : outline.segments) {
    if (s.as == LineKind::faces) faces.push_back(static_cast<std::int32_t>(ends.size()));
    ends.push_back(s.ends), tags.push_back(s.tag);
  }
  py::list regions, parts, rings;
  for (const OutlineRegion& r : outline.regions) {
    regions.append(py::make_tuple(r.at.x, r.at.y, r.region, to_python(r.size)));
  }
  for (const OutlinePart& p : outline.parts) {
    parts.append(py::make_tuple(p.region, array_of<std::int32_t>(p.segments), to_python(p.size)));
  }
  py::list sizes;
  for (const OutlineSize& s : outline.sizes) sizes.append(py::make_tuple(s.points[0], s.points[1], s.size));
  for (const OutlineRing& r : outline.rings) {
    rings.append(py::make_tuple(array_of<std::int32_t>(r.segments), r.shell));
  }
  return Record()("points", rows_of<double>(std::span<const Vec2>(outline.points)))("sizes", sizes)(
             "segments", rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 2>>(ends)))(
             "segment_tags", array_of<std::int32_t>(tags))("faces", array_of<std::int32_t>(faces))(
             "holes", rows_of<double>(std::span<const Vec2>(outline.holes)))("regions", regions)("parts", parts)(
             "rings", rings)("point_tags", rows_of_tags(outline.point_tags))(
             "further_tags", rows_of_tags(outline.further_tags))("groups", physical_names_to_python(outline.groups))(
             "names", outline.names ? py::cast(PyNames{outline.names}) : py::none())
      .dict;
}

MesherOptions mesher_options_from(const py::dict& d, const py::object& optimize_options) {
  MesherOptions options;
  options.size = d["size"].cast<double>();
  if (d["few_points"].cast<bool>()) options.points = MeshPoints::few;
  if (!d["field"].is_none()) options.field = d["field"].cast<SizeField>();
  options.grade = d["grade"].cast<double>();
  for (const auto& item : d["region_sizes"]) {
    const auto pair = item.cast<py::tuple>();
    options.region_sizes.push_back({pair[0].cast<std::int32_t>(), pair[1].cast<double>()});
  }
  options.enclosed = from_name<Enclosed>("enclosed", d["enclosed"].cast<std::string>());
  options.snap = size_or_none(d["snap"]);
  options.drop_below = d["drop_below"].cast<double>();
  options.split_crossings = d["split_crossings"].cast<bool>();
  options.attempts = d["attempts"].cast<int>();
  options.most_triangles = d["most_triangles"].cast<std::size_t>();
  options.memory = d["memory"].is_none() ? io::free_memory() : d["memory"].cast<std::uint64_t>();
  options.time_limit = d["time_limit"].cast<double>();
  if (optimize_options.is_none()) {
    options.optimize.reset();
  } else {
    options.optimize = options_from(optimize_options.cast<py::dict>());
  }
  return options;
}

/// The degrees that the points of an outline were given in, and their map; none in a plane without a map.
struct GivenDegrees {
  std::vector<Vec2> lon_lat;
  std::optional<Projection> map;
};

GivenDegrees degrees_from(const py::handle& given) {
  if (given.is_none()) return {};
  const auto [kind, lon, lat, radius, lon_lat] = given.cast<std::tuple<std::string, double, double, double, Doubles>>();
  const auto points = as_span<Vec2>(lon_lat);
  return {{points.begin(), points.end()},
          Projection{from_name<ProjectionKind>("projection", kind), {lon, lat}, radius}};
}

/// The mesh, with the file that the program writes.
py::tuple outline_mesh_to_python(OutlineMesh result, const GivenDegrees& degrees) {
  auto source = std::make_shared<Source>();
  source->file = io::from_outline(result, degrees.lon_lat, degrees.map);
  source->loaded.vertex_of_point = io::VertexOfPoint(result.mesh.n_vertices());
  std::vector<std::array<std::int32_t, 2>> marked;
  for (const auto& [vertex, tag] : result.marked) marked.push_back({static_cast<std::int32_t>(vertex.index), tag});
  std::vector<std::array<VertexId, 2>> lines;
  std::vector<std::int32_t> tags;
  for (const MeshLine& line : result.lines) lines.push_back({line.a, line.b}), tags.push_back(line.tag);
  return py::make_tuple(
      std::make_unique<PyMesh>(std::move(result.mesh), std::move(source)),
      Record()("lines", rows_of<VertexId>(std::span<const std::array<VertexId, 2>>(lines)))(
          "line_tags", array_of<std::int32_t>(tags))(
          "marked", rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 2>>(marked)))(
          "groups", physical_names_to_python(result.groups))("vertex_of_point", result.vertex_of_point)(
          "bad", result.bad)("delaunay_bad", result.delaunay_bad)("attempts", result.attempts)(
          "report", report_to_python(result.report))("notes", result.notes)("warnings", result.warnings)
          .dict);
}

/// Makes a mesh by the function `mesh`, which runs without the GIL.
template <class Mesher>
py::tuple mesh_by(const Mesher& mesh, const GivenDegrees& degrees, const py::object& threads,
                  const py::object& observer) {
  const auto executor = make_threads(threads_from(threads));
  Visitor visitor;
  const Observer watching = observer_of(visitor, observer);
  auto made = aside(
      [&] { return mesh(OptimizeHooks{.executor = executor.get(), .observer = watching, .solvers = solvers()}); });
  visitor.raise();
  return outline_mesh_to_python(or_raise(std::move(made)), degrees);
}

py::tuple mesh_an_outline(const py::dict& dict, const py::dict& d, const py::object& optimize_options,
                          const py::object& threads, const py::object& observer) {
  const Outline outline = outline_from(dict);
  const MesherOptions options = mesher_options_from(d, optimize_options);
  return mesh_by([&](const OptimizeHooks& hooks) { return mesh_outline(outline, options, hooks); },
                 degrees_from(dict["degrees"]), threads, observer);
}

py::tuple mesh_a_sphere(const py::dict& dict, const py::dict& d, const py::object& optimize_options,
                        const py::object& threads, const py::object& observer) {
  const auto outline = [&dict](const char* name) { return outline_from(dict[name].cast<py::dict>()); };
  const SphereOutline sphere = {dict["radius"].cast<double>(), outline("basins"), outline("coasts"), outline("lines")};
  const MesherOptions options = mesher_options_from(d, optimize_options);
  GivenDegrees degrees;
  for (const Outline* one : {&sphere.basins, &sphere.coasts, &sphere.lines})
    degrees.lon_lat.insert(degrees.lon_lat.end(), one->points.begin(), one->points.end());
  return mesh_by([&](const OptimizeHooks& hooks) { return mesh_sphere(sphere, options, hooks); }, degrees, threads,
                 observer);
}

void bind_mesher(py::module_& m) {
  py::class_<PyNames>(m, "OutlineNames");
  m.def("read_outline", [](const std::string& path) {
    const io::OutlineFile file = or_raise(io::read_outline(path));
    return py::make_tuple(outline_to_dict(file.outline), Record()("path", file.path)("format", file.format)(
                                                             "geographic", file.geographic)("warnings", file.warnings)
                                                             .dict);
  });
  m.def("project", [](const py::dict& outline, const std::string& kind, double lon, double lat, double radius) {
    return outline_to_dict(
        or_raise(project(outline_from(outline), {from_name<ProjectionKind>("projection", kind), {lon, lat}, radius})));
  });
  m.def("mesh_outline", mesh_an_outline);
  m.def("mesh_sphere", mesh_a_sphere);
}

}  // namespace

void bind_change(py::module_& m) {
  bind_regularity(m);
  bind_topology(m);
  bind_size(m);
  bind_mesher(m);
}

}  // namespace temper::python

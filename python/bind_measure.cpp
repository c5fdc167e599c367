// Bindings of functions that only read meshes: quality, energy, draw, measure_errors.
#include <optional>
#include <utility>

#include "bind.hpp"
#include "reports.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/html.hpp"
#include "temper/draw.hpp"
#include "temper/energy.hpp"
#include "temper/quality.hpp"
#include "temper/tets/draw.hpp"
#include "temper/tets/quality.hpp"
#ifdef TEMPER_WITH_ERRORS
#include "temper/errors.hpp"
#include "temper/surface_errors.hpp"
#include "temper/tets/errors.hpp"
#endif

namespace temper::python {
namespace {

// --- quality and energies ---------------------------------------------------------------------------------------

template <class AnyMesh>
py::dict triangle_quality_to_dict(const AnyMesh& self) {
  const auto mesh = self.read();
  const Shape n{static_cast<py::ssize_t>(mesh->n_triangles())};
  py::array_t<bool> well_centered(n);
  py::array_t<double> h_over_l(n), d_over_l(n), angle_deg(n);
  bool* good = well_centered.mutable_data();
  double *h = h_over_l.mutable_data(), *d = d_over_l.mutable_data(), *angle = angle_deg.mutable_data();
  for (const TriangleId t : mesh->triangles()) {
    const TriangleQuality q = triangle_quality(*mesh, t);
    *good++ = q.well_centered;
    *h++ = q.min_h_over_l;
    *d++ = q.min_d_over_l;
    *angle++ = q.min_angle_deg;
  }
  return Record()("well_centered", well_centered)("min_h_over_l", h_over_l)("min_d_over_l", d_over_l)("min_angle_deg",
                                                                                                      angle_deg)
      .dict;
}

template <class Report>
py::list measures_list(std::span<const MeasureRow<Report>> rows) {
  py::list list;
  for (const MeasureRow<Report>& m : rows) {
    list.append(Record()("key", m.key)("alias", m.alias)("label", m.label)("community", m.community)(
                    "definition", m.definition)("better", name_of(m.better))("count", m.count)("wanted", m.wanted)
                    .dict);
  }
  return list;
}

EnergyModel model_from(const py::dict& d) {
  EnergyModel model;
  model.kind = or_raise(find_energy(d["energy"].cast<std::string>())).kind;
  const int star = d["star"].cast<int>();
  if (star < 0 || star > 2) {
    fail(ErrorCode::invalid_option, "star: expected 0, 1 or 2, found " + std::to_string(star));
  }
  model.star = static_cast<Star>(star);
  model.boundary_treatment =
      from_name<BoundaryTreatment>("boundary_treatment", d["boundary_treatment"].cast<std::string>());
  model.gamma = length_parameter_from(d["gamma"]);
  model.h0 = length_parameter_from(d["h0"]);
  model.wall = d["wall"].cast<bool>();
  return model;
}

py::list energies_list() {
  py::list list;
  for (const EnergyInfo& e : energies()) {
    list.append(Record()("name", e.name)("formula", e.formula)("boundary_treatment", name_of(e.boundary_treatment))(
                    "barrier", e.barrier)("softened_by_gamma", e.softened_by_gamma)("softened_by_h0", e.softened_by_h0)(
                    "length_exponent", e.length_exponent)("signed_by_dual", e.signed_by_dual)(
                    "normalized", e.normalized)("positions_alone", e.positions_alone)
                    .dict);
  }
  return list;
}

void bind_energy(py::module_& m) {
  m.def("quality", [](const PyMesh& self, const py::object& gamma, const py::object& h0, std::size_t worst,
                      const py::object& threads) {
    const auto mesh = self.read();
    QualityOptions options;
    options.gamma = length_parameter_from(gamma);
    options.h0 = length_parameter_from(h0);
    options.worst = worst;
    const auto count = threads_from(threads);
    return report_to_python(aside([&] {
      const auto executor = make_threads(count);
      options.executor = executor.get();
      return quality(*mesh, options);
    }));
  });
  m.def("quality_measures", [](bool tetrahedra) {
    return tetrahedra ? measures_list(tets::quality_measures()) : measures_list(quality_measures());
  });
  // Energies of surfaces are not measured.
  m.def("quality", [](const PySurface& self, const py::object& /*gamma*/, const py::object& /*h0*/, std::size_t worst,
                      const py::object& /*threads*/) {
    const auto mesh = self.read();
    return report_to_python(aside([&] { return surfaces::quality(*mesh, worst); }));
  });
  m.def("triangle_quality", triangle_quality_to_dict<PyMesh>);
  m.def("triangle_quality", triangle_quality_to_dict<PySurface>);
  m.def("energies", energies_list);
  m.def("total_energy", [](const PyMesh& self, const py::dict& model, const py::object& threads) {
    const EnergyModel energy = model_from(model);
    const auto mesh = self.read();
    const auto count = threads_from(threads);
    const py::gil_scoped_release release;
    return total_energy(*mesh, energy, make_threads(count).get());
  });
  m.def("triangle_energy", [](const py::dict& model, const Doubles& corners, double radius) {
    const auto p = as_span<WeightedPoint>(corners);
    if (p.size() != 3) throw py::value_error("expected three weighted points");
    return triangle_energy(model_from(model), p[0], p[1], p[2], radius > 0 ? Space::sphere(radius) : Space());
  });
  m.def("vertex_energy", [](const PyMesh& self, const py::dict& model, std::int64_t v) {
    const auto mesh = self.read();
    const VertexDerivatives d = vertex_energy(*mesh, model_from(model), vertex_id(*mesh, v));
    return Record()("value", d.value)("feasible", d.feasible)("gradient", d.gradient)("hessian", d.hessian).dict;
  });
}

// --- pictures ---------------------------------------------------------------------------------------------------

/// Sets an option if it is given.
template <class T>
void take(const py::dict& given, const char* name, T& option) {
  if (given.contains(name)) option = given[name].cast<T>();
}

DrawOptions draw_options_from(const py::dict& given) {
  DrawOptions o;
  take(given, "primal", o.primal);
  take(given, "dual", o.dual);
  take(given, "weights", o.weights);
  take(given, "weight_scale", o.weight_scale);
  take(given, "fill", o.fill);
  take(given, "near_coincident", o.near_coincident);
  take(given, "vertex_numbers", o.vertex_numbers);
  take(given, "width", o.width);
  take(given, "title", o.title);
  if (given.contains("zoom") && !given["zoom"].is_none()) {
    const auto z = given["zoom"].cast<py::tuple>();
    o.zoom = Box{{z[0].cast<double>(), z[1].cast<double>()}, {z[2].cast<double>(), z[3].cast<double>()}};
  }
  if (given.contains("view") && !given["view"].is_none()) {
    const auto v = given["view"].cast<py::tuple>();
    o.view = Vec2{v[0].cast<double>(), v[1].cast<double>()};
  }
  return o;
}

void bind_draw(py::module_& m) {
  m.def("draw_svg",
        [](const PyMesh& self, const py::dict& options) { return draw_svg(*self.read(), draw_options_from(options)); });
  m.def("draw_before_after_svg", [](const PyMesh& before, const PyMesh& after, const py::dict& options) {
    const auto left = before.read(), right = after.read();
    if (left->space().kind() != right->space().kind()) {
      fail(ErrorCode::unsupported, "one mesh is of the plane and the other of a sphere; expected two of a kind");
    }
    return draw_before_after_svg(*left, *right, draw_options_from(options));
  });
  m.def("draw_svg", [](const PySurface& self, const py::dict& options) {
    return draw_svg(*self.read(), draw_options_from(options));
  });
  m.def("draw_before_after_svg", [](const PySurface& before, const PySurface& after, const py::dict& options) {
    return draw_before_after_svg(*before.read(), *after.read(), draw_options_from(options));
  });
  m.def("tet_draw_svg", [](const PyTetMesh& self, const PyTetMesh* before, int axis, const py::object& at,
                           const py::dict& options) {
    const tets::TetMesh& mesh = self.mesh();
    tets::Plane plane = axis < 0 ? middle_plane(mesh) : middle_plane(mesh, axis);
    if (!at.is_none()) plane = or_raise(plane_through(mesh, plane.axis, at.cast<double>()));
    const DrawOptions how = draw_options_from(options);
    return before == nullptr ? draw_svg(mesh, plane, how) : draw_before_after_svg(before->mesh(), mesh, plane, how);
  });
  m.def("tet_html_report",
        [](const PyTetMesh& self, const PyTetMesh* before, const std::string& title, const std::string& json) {
          const auto mesh = self.loaded, old = before == nullptr ? mesh : before->loaded;
          io::HtmlReport report = {io::HtmlTets{mesh->mesh}, std::nullopt, title, json};
          if (before != nullptr) report.before.emplace(io::HtmlTets{old->mesh});
          return aside([&] { return io::html_report(report); });
        });
  m.def("html_report", [](const PyMesh& self, const PyMesh* before, const std::string& title, const std::string& json) {
    const auto mesh = self.read();
    require_plane(*mesh, "html_report()");
    const auto old = before == nullptr ? mesh : before->read();
    require_plane(*old, "html_report()");
    io::HtmlReport report = {io::HtmlMesh{*mesh}, std::nullopt, title, json};
    if (before != nullptr) report.before.emplace(io::HtmlMesh{*old});
    const py::gil_scoped_release release;
    return io::html_report(report);
  });
  m.def("grid_svg", [](const py::sequence& documents, std::size_t columns, const std::string& title) {
    std::vector<std::string> svgs;
    for (const auto& document : documents) svgs.push_back(document.cast<std::string>());
    if (columns == 0) fail(ErrorCode::invalid_option, "columns: expected 1 or more, found 0");
    return grid_svg(svgs, columns, title);
  });
}

// --- measure_errors -------------------------------------------------------------------------------------------------

#ifdef TEMPER_WITH_ERRORS

/// The ten numbers of OperatorErrors, in the order of error_measures().
py::dict fields_to_dict(const std::vector<FieldErrors>& fields) {
  py::list names;
  std::vector<std::array<double, 10>> values;
  for (const FieldErrors& f : fields) {
    names.append(to_python(f.field.name));
    auto& row = values.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = error_measures()[i].of(f.errors);
  }
  return Record()("names", names)("values", rows_of<double>(std::span<const std::array<double, 10>>(values))).dict;
}

py::object errors_to_array(const OperatorErrors& errors) {
  std::vector<double> values;
  for (const ErrorMeasure& measure : error_measures()) values.push_back(measure.of(errors));
  return to_python(values);
}

std::vector<FieldErrors> fields_from(const py::sequence& names, const Doubles& values) {
  const auto rows = as_span<std::array<double, 10>>(values);
  if (rows.size() != names.size()) throw py::value_error("as many rows as fields expected");
  std::vector<FieldErrors> fields;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto wanted = names[i].cast<std::string>();
    FieldErrors& row = fields.emplace_back();
    for (const auto& known : {tets::error_fields(), error_fields(), error_fields(SpaceKind::sphere),
                              error_fields(SpaceKind::periodic_plane)}) {
      for (const ErrorField& field : known) {
        if (field.name == wanted) row.field = field;
      }
    }
    for (std::size_t k = 0; k < rows[i].size(); ++k) error_measures()[k].at(row.errors) = rows[i][k];
  }
  return fields;
}

FieldFrame frame_from(const py::handle& frame) {
  const auto f = frame.cast<py::tuple>();
  return {{f[0].cast<double>(), f[1].cast<double>()}, f[2].cast<double>()};
}

template <class Report>
py::dict errors_to_dict(const Report& r) {
  py::list levels, local;
  for (const ErrorLevel& level : r.levels) {
    levels.append(Record()("vertices", level.vertices)("triangles", level.triangles)(
                      "non_regular_edges", level.non_regular_edges)("not_well_centered", level.not_well_centered)(
                      "fields", fields_to_dict(level.fields))
                      .dict);
  }
  for (const auto& values : r.local) local.append(to_python(values));
  py::dict report = fields_of(view_of(r));
  report["fields"] = fields_to_dict(r.fields);
  report["levels"] = levels;
  report["orders"] = fields_to_dict(r.orders);
  report["local"] = local;
  return report;
}

py::dict error_mesh(const PyMesh& self, const py::sequence& fields, const py::object& frame, int refine, bool condition,
                    bool local, const py::object& threads) {
  const auto mesh = self.read();
  MeasureErrorsOptions options;
  for (const auto& field : fields) options.fields.push_back(field.cast<std::string>());
  if (!frame.is_none()) options.frame = frame_from(frame);
  if (refine < 0) fail(ErrorCode::invalid_option, "refine: expected 0 or more, found " + std::to_string(refine));
  options.refine = refine;
  options.condition = condition;
  options.local = local;
  const auto count = threads_from(threads);
  auto report = aside([&] {
    const auto executor = make_threads(count);
    options.executor = executor.get();
    return measure_errors(*mesh, options);
  });
  return errors_to_dict(or_raise(std::move(report)));
}

tets::MeasureErrorsOptions options_in_space(const py::sequence& fields, const py::object& frame, bool condition) {
  tets::MeasureErrorsOptions options;
  for (const auto& field : fields) options.fields.push_back(field.cast<std::string>());
  if (!frame.is_none()) {
    const auto f = frame.cast<py::tuple>();
    options.frame = {{f[0].cast<double>(), f[1].cast<double>(), f[2].cast<double>()}, f[3].cast<double>()};
  }
  options.condition = condition;
  return options;
}

py::dict error_tets(const PyTetMesh& self, const py::sequence& fields, const py::object& frame, bool condition) {
  const tets::MeasureErrorsOptions options = options_in_space(fields, frame, condition);
  const auto loaded = self.loaded;
  const tets::ErrorReport r = or_raise(aside([&] { return tets::measure_errors(loaded->mesh, options); }));
  py::dict report = fields_of(view_of(r));
  report["fields"] = fields_to_dict(r.fields);
  return report;
}

py::dict error_surface(const PySurface& self, const py::sequence& fields, const py::object& frame, bool condition) {
  const tets::MeasureErrorsOptions options = options_in_space(fields, frame, condition);
  const auto loaded = self.loaded;
  return errors_to_dict(or_raise(aside([&] { return surfaces::measure_errors(loaded->mesh, options); })));
}

py::list fields_list(std::span<const ErrorField> fields) {
  py::list list;
  for (const ErrorField& f : fields)
    list.append(Record()("name", f.name)("group", name(f.group))("formula", f.formula).dict);
  return list;
}

py::object diffusion_errors(const PyMesh& self, const py::tuple& given, int refinements) {
  const auto mesh = self.read();
  const DiffusionProblem problem = problem_from(given);
  return report_to_python(or_raise(aside([&] { return measure_diffusion_errors(*mesh, problem, refinements); })));
}

std::optional<FieldGroup> group_from(const py::object& group) {
  if (group.is_none()) return std::nullopt;
  constexpr std::array<std::string_view, 3> kNames = {"chosen", "held-back", "exact"};
  return static_cast<FieldGroup>(choose("group", group.cast<std::string>(), kNames));
}

void bind_errors(py::module_& m) {
  m.def("measure_errors", error_mesh);
  m.def("measure_errors", error_surface);
  m.def("measure_diffusion_errors", diffusion_errors);
  m.def("error_fields", [](bool sphere, bool periodic) {
    const SpaceKind in_plane = periodic ? SpaceKind::periodic_plane : SpaceKind::plane;
    return fields_list(error_fields(sphere ? SpaceKind::sphere : in_plane));
  });
  m.def("tet_error_fields", [] { return fields_list(tets::error_fields()); });
  m.def("tet_measure_errors", error_tets);
  m.def("tet_field_frame", [](const PyTetMesh& self) { return report_to_python(tets::field_frame(self.mesh())); });
  m.def("field_frame", [](const PySurface& self) { return report_to_python(surfaces::field_frame(self.mesh())); });
  m.def("field_frame", [](const PyMesh& self) { return report_to_python(field_frame(*self.read())); });
  m.def("error_measures", [] {
    py::list list;
    for (const ErrorMeasure& measure : error_measures()) {
      list.append(py::make_tuple(to_python(measure.key), to_python(measure.label)));
    }
    return list;
  });
  m.def("geometric_mean", [](const py::sequence& names, const Doubles& values, const py::object& group) {
    return errors_to_array(geometric_mean(fields_from(names, values), group_from(group)));
  });
  m.def("arithmetic_mean", [](const py::sequence& names, const Doubles& values, const py::object& group) {
    return errors_to_array(arithmetic_mean(fields_from(names, values), group_from(group)));
  });
  m.def("error_ratios", [](const py::sequence& after_names, const Doubles& after, const py::object& after_frame,
                           const py::sequence& before_names, const Doubles& before, const py::object& before_frame) {
    ErrorReport a, b;
    a.fields = fields_from(after_names, after);
    a.frame = frame_from(after_frame);
    b.fields = fields_from(before_names, before);
    b.frame = frame_from(before_frame);
    return fields_to_dict(or_raise(error_ratios(a, b)));
  });
}

#else

void bind_errors(py::module_&) {}

#endif

}  // namespace

void bind_measure(py::module_& m) {
  bind_energy(m);
  bind_draw(m);
  bind_errors(m);
}

}  // namespace temper::python

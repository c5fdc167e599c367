// Bindings of sizes and of the mesher.
#include <limits>

#include "bind.hpp"
#include "optimize_options.hpp"
#include "reports.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesher.hpp"
#include "temper/solvers.hpp"

TEMPER_PYTHON_NAMES(temper::Enclosed, "by_points", "all", "alternate");

namespace temper::python {
namespace {

// --- size -----------------------------------------------------------------------------------------------------

/// Sizes at points of shape (n, 2) of the plane or (n, 3) of space, and which of them are outside of the field's mesh.
py::tuple sizes_at(const SizeField& field, const Doubles& points) {
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
}

py::array relative_lengths_of_edges(const PyMesh& self) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto mesh = self.read();
  const auto sizes = local_sizes(*mesh);
  std::vector<std::array<double, 2>> lengths;
  for (const HalfedgeId h : mesh->halfedges()) {
    if (!mesh->is_edge_representative(h)) continue;
    const auto [edge, dual] = mesh->is_boundary(h) ? RelativeLengths{kNone, kNone} : relative_lengths(*mesh, sizes, h);
    lengths.push_back({edge, dual});
  }
  return rows_of<double>(std::span<const std::array<double, 2>>(lengths));
}

void bind_size(py::module_& m) {
  py::class_<SizeField>(m, "SizeField")
      .def("at", sizes_at)
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
  m.def("relative_lengths", relative_lengths_of_edges);
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

std::vector<OutlineSegment> segments_from(const py::dict& d) {
  std::vector<OutlineSegment> segments;
  const auto ends = d["segments"].cast<Int32s>();
  const auto tags = d["segment_tags"].cast<Int32s>();
  const auto pairs = as_span<std::array<std::int32_t, 2>>(ends);
  if (static_cast<std::size_t>(tags.size()) != pairs.size()) {
    fail(ErrorCode::size_mismatch,
         "segment_tags: expected " + std::to_string(pairs.size()) + ", found " + std::to_string(tags.size()));
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) segments.push_back({pairs[i], tags.data()[i]});
  const auto faces = d["faces"].cast<Int32s>();
  for (const std::int32_t segment : as_span<std::int32_t>(faces)) {
    const auto i = static_cast<std::size_t>(std::int64_t{segment});
    if (i >= segments.size()) {
      fail(ErrorCode::index_out_of_range, "faces: the number " + std::to_string(segment) +
                                              " is of no segment; there are " + std::to_string(segments.size()));
    }
    segments[i].as = LineKind::faces;
  }
  return segments;
}

Outline outline_from(const py::dict& d) {
  Outline outline;
  const auto points = d["points"].cast<Doubles>();
  const auto vertices = as_span<Vec2>(points);
  outline.points.assign(vertices.begin(), vertices.end());
  outline.segments = segments_from(d);
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

}  // namespace

void bind_mesher(py::module_& m) {
  bind_size(m);
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

}  // namespace temper::python

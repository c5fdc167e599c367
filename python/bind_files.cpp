// Files of meshes, and the data, lines, tags and names that came with a mesh from a file. See io.hpp.
#include <algorithm>
#include <tuple>
#include <utility>
#include <variant>

#include "space_mesh.hpp"
#include "temper/detail/file_cures.hpp"

namespace temper::python {
namespace {

/// A file, on the map of the projection if one is named, and its mesh.
std::shared_ptr<Source> source_of(io::MeshFile file, const std::string& projection,
                                  const std::vector<std::string>& fixed_tags, Executor* executor) {
  auto source = std::make_shared<Source>();
  source->file = std::move(file);
  const py::gil_scoped_release release;
  if (!projection.empty()) or_raise(io::project(source->file, projection));
  auto loaded = io::make_mesh(source->file, fixed_tags, executor);
  if (!loaded) throw BadInput{loaded.error()};
  source->loaded = *std::move(loaded);
  io::release_geometry(source->file, source->loaded);  // else memory would hold it twice
  return source;
}

/// The mesh of a file, with the other contents of the file, and the warnings.
py::tuple load(io::MeshFile file, const std::string& projection, const std::vector<std::string>& fixed_tags,
               Executor* executor) {
  const auto source = source_of(std::move(file), projection, fixed_tags, executor);
  std::vector<std::string> warnings = source->file.warnings;
  source->file.warnings.clear();
  warnings.insert(warnings.end(), source->loaded.warnings.begin(), source->loaded.warnings.end());
  Mesh mesh = std::move(source->loaded.mesh);
  source->loaded.mesh = Mesh();
  return py::make_tuple(std::make_unique<PyMesh>(std::move(mesh), source), to_python(warnings));
}

/// The file of a mesh, and the report on its data.
struct UpdatedFile {
  io::MeshFile file;
  io::DataReport data;
};

/// The file of the mesh in its present state; of a mesh of arrays, a new one. Without the GIL it works on a copy
/// of the mesh that was made with the GIL. The copy shares the memory, so other threads may change the mesh meanwhile.
UpdatedFile updated(const PyMesh& self, io::MeshFile former, Executor* executor = nullptr) {
  const auto mesh = self.read();
  if (!self.source()) return {io::from_mesh(*mesh), {}};
  UpdatedFile result{std::move(former), {}};
  result.data =
      io::update(result.file, self.source()->loaded, *mesh, self.origin(), self.data_rules().options(executor));
  return result;
}

UpdatedFile updated(const PySurface& self, io::MeshFile former, Executor* executor = nullptr) {
  UpdatedFile result{std::move(former), {}};
  result.data = io::update(result.file, *self.loaded, self.mesh(), {}, self.data_rules.options(executor));
  return result;
}

io::MeshFile former_file_of(const PyMesh& self) { return self.source() ? self.source()->file : io::MeshFile(); }
io::MeshFile former_file_of(const PySurface& self) { return *self.file; }

template <class AnyMesh>
UpdatedFile updated_file_of(const AnyMesh& self, Executor* executor) {
  return updated(self, former_file_of(self), executor);
}

/// The present file of the mesh with another array. The former values of the array need not follow the mesh.
io::MeshFile file_with(const PyMesh& self, bool of_points, const std::string& name, const py::array& values) {
  const auto arrays_of = [&](io::MeshFile & file) -> auto& {
    return of_points ? file.point_data : file.triangles.data;
  };
  io::MeshFile former = former_file_of(self);
  std::vector<std::string> before;  // arrays that stay before this one
  for (const io::DataArray& a : arrays_of(former)) {
    if (a.name == name) break;
    before.push_back(a.name);
  }
  std::erase_if(arrays_of(former), [&](const io::DataArray& a) { return a.name == name; });
  io::MeshFile file = updated(self, std::move(former)).file;
  std::vector<io::DataArray>& arrays = arrays_of(file);
  const auto place = std::ranges::find_if_not(
      arrays, [&](const io::DataArray& a) { return std::ranges::find(before, a.name) != before.end(); });
  arrays.insert(place, from_python_array(name, values, of_points ? file.points.size() : file.triangles.size(),
                                         of_points ? "point data" : "cell data"));
  return file;
}

io::MeshFile file_without(const PyMesh& self, bool of_points, const std::string& name) {
  io::MeshFile file = updated_file_of(self, nullptr).file;
  erase_array(of_points ? file.point_data : file.triangles.data, name);
  return file;
}

/// Sets an array of point data or cell data, or with None removes it. The mesh then has a file with this array.
void set_data(PyMesh& self, bool of_points, const std::string& name, const py::object& values) {
  const std::uint64_t version = self.version();
  io::MeshFile file = values.is_none() ? file_without(self, of_points, name)
                                       : file_with(self, of_points, name, values.cast<py::array>());
  MeshDataRules rules = without_absent(self.data_rules(), file);
  check_data_rules(rules, file);
  const auto source = source_of(std::move(file), {}, {}, nullptr);
  source->loaded.mesh = Mesh();
  if (self.version() != version) {
    fail(ErrorCode::unsupported, "data '" + name + "' are as they were: another thread changed the mesh meanwhile");
  }
  self.set_source(source);
  self.set_data_rules(std::move(rules));
}

py::object data_report(const PyMesh& self, const py::object& threads) {
  const auto executor = make_threads(threads_from(threads));
  const PyMesh same = self.copy();
  const io::DataReport r = aside([&] { return updated_file_of(same, executor.get()).data; });
  return report_to_python(r);
}

/// The contents of a file that Python gets unchanged. Points are not included, because they may have two coordinates or
/// three.
Record arrays_of(const io::MeshFile& file) {
  return contents_of(file)("triangles",
                           rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 3>>(file.triangles)));
}

PyMesh copy_of_mesh(const PyMesh& self) { return self.copy(); }
PySurface copy_of_mesh(const PySurface& self) { return self; }

/// The file of the mesh as it is now. Without data of points and triangles, nothing has to be interpolated.
template <class AnyMesh>
py::dict file_as_dict(const AnyMesh& self, bool with_data) {
  const AnyMesh same = copy_of_mesh(self);
  io::MeshFile former = former_file_of(self);
  if (!with_data) former.point_data.clear(), former.triangles.data.clear();
  io::MeshFile file = aside([&] { return updated(same, std::move(former)).file; });
  std::vector<Vec3> places;
  if (file.sphere() != nullptr) places = file.sphere()->places;
  for (std::size_t p = places.size(); p < file.points.size(); ++p)
    places.push_back(file.is_surface() ? file.place(p) : Vec3{file.points[p].x, file.points[p].y, file.z()});
  return arrays_of(file)("points", rows_of<double>(std::span<const Vec3>(places))).dict;
}

/// Vertex of each original point of the mesh, -1 if it is gone; None for a mesh without a file.
py::object vertices_of_points(const PyMesh& self) {
  if (!self.source()) return py::none();
  const auto origin = self.origin();
  const io::VertexOfPoint& loaded = self.source()->loaded.vertex_of_point;
  std::vector<std::int32_t> now(loaded.n_kept(), -1);
  for (std::size_t v = 0; v < now.size() && origin.empty(); ++v) now[v] = static_cast<std::int32_t>(v);
  for (std::size_t i = 0; i < origin.size(); ++i) {
    const VertexId before = origin[VertexId(i)];
    if (before.valid()) now[before.index] = static_cast<std::int32_t>(i);
  }
  std::vector<std::int32_t> vertices;
  for (std::size_t p = 0; p < loaded.size(); ++p) {
    const std::int32_t v = loaded[p];
    vertices.push_back(v < 0 ? -1 : now[static_cast<std::size_t>(v)]);
  }
  return array_of<std::int32_t>(vertices);
}

/// A file of these arrays, without the points; their number is given.
io::MeshFile file_of_arrays(const py::dict& d, std::size_t n_points) {
  io::MeshFile file;
  file.triangles.corners = narrow<3>(d["triangles"].cast<Int64s>(), "triangle");
  take_contents(file, file.triangles, d, n_points);
  check_range<3>(file.triangles.corners, n_points, "triangle");
  return file;
}

/// `curved`: a curved surface is no error.
py::tuple mesh_from_file_arrays(const py::dict& d, const py::sequence& fixed_tags, bool curved) {
  const auto points = d["points"].cast<Doubles>();
  io::MeshFile file = file_of_arrays(d, static_cast<std::size_t>(points.shape(0)));
  if (points.shape(1) == 3) {
    or_raise(io::set_points(file, copy_of<Vec3>(points)));
  } else {
    file.points = copy_of<Vec2>(points);
  }
  if (curved && file.is_surface()) return load_surface(std::move(file), strings_from(fixed_tags));
  return load(std::move(file), {}, strings_from(fixed_tags), nullptr);
}

py::tuple read_file(const std::string& path, const py::sequence& fixed_tags, const std::string& projection, bool flat,
                    const std::string& positive, const py::object& merge, const py::object& threads) {
  const auto tags = strings_from(fixed_tags);
  const auto executor = make_threads(threads_from(threads));
  io::ReadOptions options = {.executor = executor.get(), .flat = flat};
  if (!positive.empty()) options.positive = from_name<io::Positive>("positive", positive);
  auto read = aside([&] { return io::read(path, options); });
  auto file = or_raise(std::move(read));
  if (!merge.is_none()) static_cast<void>(or_raise(io::merge_points(file, merge.cast<double>())));
  if (file.dimension() == 3) {
    const char* const given = !tags.empty()         ? "fixed_tags"
                              : !projection.empty() ? "projection"
                              : flat                ? "flat"
                              : !positive.empty()   ? "positive"
                                                    : nullptr;
    if (given != nullptr) {
      throw BadInput{{ErrorCode::invalid_option, path,
                      "has tetrahedra, and " + std::string(given) + " is for triangles alone. Next: leave it out"}};
    }
    return load_tetrahedra(std::move(file), executor.get());
  }
  const bool onto_sphere = file.is_surface() && projection.starts_with(io::kOntoSphere);
  if (onto_sphere) or_raise(io::project(file, projection));
  if (file.is_surface() && projection.empty()) return load_surface(std::move(file), tags);
  return load(std::move(file), onto_sphere ? std::string() : projection, tags, executor.get());
}

template <class AnyMesh>
py::object write_file(const std::string& path, const AnyMesh& self, const std::string& format,
                      const std::string& encoding, bool triangle_quality, const py::object& threads,
                      const std::string& cells) {
  const auto executor = make_threads(threads_from(threads));
  io::WriteOptions options;
  options.format = format;
  if (!encoding.empty()) options.encoding = from_name<io::Encoding>("encoding", encoding);
  options.triangle_quality = triangle_quality;
  if (!cells.empty()) options.cells = from_name<CellsOf>("cells", cells);
  options.executor = executor.get();
  const AnyMesh same = copy_of_mesh(self);
  return to_python(aside([&] {
    io::MeshFile file = updated_file_of(same, executor.get()).file;
    const auto written = or_raise(io::write(path, file, options));
    file.warnings.insert(file.warnings.end(), written.begin(), written.end());
    return std::move(file.warnings);
  }));
}

// --- pickles ------------------------------------------------------------------------------------------------------

/// The kind of the points, with all its data.
struct PointsToPython {
  py::tuple operator()(const io::PlanePoints& p) const { return py::make_tuple("plane", p.z, p.normal); }
  py::tuple operator()(const io::PeriodicPoints& p) const {
    return py::make_tuple("periodic", p.period.x, p.period.y, p.z);
  }
  py::tuple operator()(const io::SpherePoints& p) const {
    return py::make_tuple("sphere", p.radius, rows_of<double>(std::span(p.places)));
  }
  py::tuple operator()(const io::SpacePoints& p) const { return py::make_tuple("space", array_of<double>(p.heights)); }
  py::tuple operator()(const io::DegreePoints& p) const { return py::make_tuple("degrees", p.is_guessed, p.z); }
  py::tuple operator()(const io::MappedPoints& p) const {
    const auto& [projection, lon_lat, places] = *p.map;
    return py::make_tuple("map", name_of(projection.kind), projection.center.x, projection.center.y, projection.radius,
                          rows_of<double>(std::span(lon_lat)), rows_of<double>(std::span(places)), p.z);
  }
};

io::PointsIn points_in_from(const py::tuple& t) {
  const auto number = [&t](std::size_t i) { return t[i].cast<double>(); };
  const auto kind = t[0].cast<std::string>();
  if (kind == "plane") return io::PlanePoints{number(1), t[2].cast<int>()};
  if (kind == "periodic") return io::PeriodicPoints{{number(1), number(2)}, number(3)};
  if (kind == "sphere") return io::SpherePoints{number(1), copy_of<Vec3>(t[2].cast<Doubles>())};
  if (kind == "space") return io::SpacePoints{copy_of<double>(t[1].cast<Doubles>())};
  if (kind == "degrees") return io::DegreePoints{t[1].cast<bool>(), number(2)};
  auto map = std::make_shared<const io::GeographicMap>(io::GeographicMap{
      {from_name<ProjectionKind>("projection", t[1].cast<std::string>()), {number(2), number(3)}, number(4)},
      copy_of<Vec2>(t[5].cast<Doubles>()),
      copy_of<Vec2>(t[6].cast<Doubles>())});
  return io::MappedPoints{std::move(map), number(7)};
}

/// The original file of a mesh, and the points that are its vertices; None for a mesh without a file.
py::object source_as_dict(const PyMesh& self) {
  if (!self.source()) return py::none();
  const auto& [file, loaded] = *self.source();
  std::vector<std::uint8_t> kept(loaded.vertex_of_point.size());
  for (std::size_t p = 0; p < kept.size(); ++p) kept[p] = loaded.vertex_of_point[p] >= 0 ? 1 : 0;
  const std::vector<std::uint8_t> edge_lines(loaded.edge_lines.begin(), loaded.edge_lines.end());
  return arrays_of(file)("points", rows_of<double>(std::span(file.points)))(
             "points_in", std::visit(PointsToPython(), file.points_in))("kept", array_of<std::uint8_t>(kept))(
             "edge_lines", array_of<std::uint8_t>(edge_lines))("origin", self.origin())("z_is_data", file.z_is_data)(
             "positive", file.positive ? py::cast(name_of(*file.positive)) : py::none())
      .dict;
}

std::vector<bool> bits_from(const py::handle& array) {
  const auto values = copy_of<std::uint8_t>(array.cast<py::array_t<std::uint8_t, py::array::c_style>>());
  return {values.begin(), values.end()};
}

io::MeshFile file_of_source(const py::dict& d, std::size_t n_points) {
  io::MeshFile file = file_of_arrays(d, n_points);
  file.points = copy_of<Vec2>(d["points"].cast<Doubles>());
  file.points_in = points_in_from(d["points_in"].cast<py::tuple>());
  file.z_is_data = d["z_is_data"].cast<bool>();
  if (!d["positive"].is_none()) file.positive = from_name<io::Positive>("positive", d["positive"].cast<std::string>());
  file.path = d["path"].cast<std::string>();
  file.format = d["format"].cast<std::string>();
  file.warnings = strings_from(d["warnings"]);
  return file;
}

void set_source_from_dict(PyMesh& self, const py::dict& d) {
  auto source = std::make_shared<Source>();
  auto& [file, loaded] = *source;
  const std::vector<bool> kept = bits_from(d["kept"]);
  file = file_of_source(d, kept.size());
  loaded.vertex_of_point = std::find(kept.begin(), kept.end(), false) == kept.end() ? io::VertexOfPoint(kept.size())
                                                                                    : io::VertexOfPoint(kept);
  loaded.edge_lines = bits_from(d["edge_lines"]);
  IdVector<VertexId, VertexId> origin;
  for (const VertexId v : copy_of<VertexId>(d["origin"].cast<Int32s>())) origin.push_back(v);
  const std::size_t n = loaded.vertex_of_point.n_kept(), n_vertices = self.read()->n_vertices();
  const auto is_new_or_known = [n](VertexId v) { return !v.valid() || v.index < n; };
  const auto has_size = [](std::size_t size, std::size_t expected) { return size == 0 || size == expected; };
  if (!has_size(file.points.size(), kept.size()) ||
      (file.sphere() != nullptr && !has_size(file.sphere()->places.size(), kept.size())) ||
      !has_size(file.weights.size(), kept.size()) || !has_size(origin.size(), n_vertices) ||
      file.lines.tags.size() != file.lines.size() || file.marked_points.tags.size() != file.marked_points.size() ||
      (origin.empty() && n != n_vertices) || !std::all_of(origin.begin(), origin.end(), is_new_or_known)) {
    fail(ErrorCode::size_mismatch, "the pickle of a mesh has arrays that do not belong together");
  }
  self.set_source(std::move(source), std::move(origin));
}

}  // namespace

py::list physical_names_to_python(const std::vector<PhysicalName>& names) {
  py::list rows;
  for (const PhysicalName& n : names) rows.append(py::make_tuple(n.dimension, n.tag, n.name));
  return rows;
}

std::vector<PhysicalName> physical_names_from(const py::handle& names) {
  std::vector<PhysicalName> result;
  for (const auto& item : names) {
    auto [dimension, tag, text] = item.cast<std::tuple<int, std::int32_t, std::string>>();
    result.push_back({dimension, tag, std::move(text)});
  }
  return result;
}

void bind_files(py::module_& m) {
  m.def("read", read_file);
  m.def("write", write_file<PyMesh>);
  m.def("write", write_file<PySurface>);
  m.def("mesh_from_file_arrays", mesh_from_file_arrays);
  m.def("file_as_dict", file_as_dict<PyMesh>);
  m.def("file_as_dict", file_as_dict<PySurface>);
  m.def("data_report", data_report);
  m.def("set_data", set_data);
  m.def("set_data", set_space_data<io::LoadedSurface>);
  m.def("vertices_of_points", vertices_of_points);
  m.def("vertices_of_points", [](const PySurface& self) { return array_of<std::int32_t>(self.vertex_of_point); });
  m.def("source_as_dict", source_as_dict);
  m.def("set_source_from_dict", set_source_from_dict);
  m.def("write_text", [](const std::string& path, const std::string& text) { or_raise(io::write_text(path, text)); });
  m.def("formats", [] {
    py::list list;
    for (const io::Format& f : io::formats()) {
      list.append(
          Record()("name", f.name)("description", f.description)("suffixes", f.suffixes)("writes", f.writes)(
              "holds_weights", f.holds_weights)("holds_planes", f.holds_planes)("holds_spheres", f.holds_spheres)(
              "holds_tetrahedra", f.holds_tetrahedra)("holds_surfaces", f.holds_surfaces)
              .dict);
    }
    return list;
  });
}

}  // namespace temper::python

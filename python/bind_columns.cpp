// Bindings of cells as polygons, of faces and barriers on lines, and of columns (cells under layers).
#include <type_traits>
#include <utility>

#include "bind.hpp"
#include "dec_arrays.hpp"
#include "temper/dec.hpp"
#include "temper/detail/columns.hpp"

namespace temper::python {
namespace {

// --- cells as polygons ------------------------------------------------------------------------------------------

py::dict cell_polygons_to_dict(const PyMesh& self, const std::string& cells) {
  const auto of = from_name<CellsOf>("cells", cells);
  const auto mesh = self.read();
  auto made =
      aside([&] { return std::make_shared<const CellPolygons>(cell_polygons(*mesh, dec_operators(*mesh), of)); });
  const py::object owner = keep(made);
  const CellPolygons& c = *made;
  const CellFace none;
  const CellFace* const face = c.faces.empty() ? &none : c.faces.data();
  const auto of_faces = [&](const auto* first, py::ssize_t width) {
    using T = std::decay_t<decltype(*first)>;
    const auto n = static_cast<py::ssize_t>(c.faces.size());
    const py::ssize_t stride = sizeof(CellFace), item = sizeof(T);
    if (width == 1) return view(py::dtype::of<T>(), {n}, {stride}, first, owner);
    return view(py::dtype::of<T>(), {n, width}, {stride, item}, first, owner);
  };
  return Record()("points", places(owner, c.points, c.sphere_points))("connectivity", whole(owner, c.corners))(
             "offsets", c.starts)("cell", whole(owner, c.cells))("center", places(owner, c.centers, c.sphere_centers))(
             "area", whole(owner, c.areas))("region", whole(owner, c.regions))(
             "region_share", whole(owner, c.region_shares))("polygon_area", whole(owner, c.polygon_areas))(
             "faces", of_faces(&face->first, 2))("face_width", of_faces(&face->width, 1))(
             "face_distances", of_faces(&face->first_distance, 2))
      .dict;
}

// --- columns ----------------------------------------------------------------------------------------------------

struct PyColumns {
  std::shared_ptr<const Mesh> mesh;
  DecComplex complex;
  PowerCells cells;
  Columns columns;
  std::vector<io::GroupCell> groups;
};

/// The file of a mesh as the mesh is now, without data.
struct FileNow {
  io::MeshFile file;
  io::LoadedMesh loaded;
};
FileNow file_now(const PyMesh& self, const Mesh& mesh) {
  FileNow now;
  if (!self.source()) return now;
  now.file = self.source()->file;
  now.file.point_data.clear();
  now.file.triangles.data.clear();
  io::update(now.file, self.source()->loaded, mesh, self.origin());
  now.loaded = or_raise(io::make_mesh(now.file));
  return now;
}

/// The cells of the groups of the mesh's file; none without a file.
std::vector<io::GroupCell> groups_of(const PyMesh& self, const Mesh& mesh, CellsOf of) {
  if (!self.source()) return {};
  const io::MeshFile& source = self.source()->file;
  if (source.lines.empty() && source.marked_points.empty()) return {};
  const auto [file, loaded] = file_now(self, mesh);
  return io::cells_of_groups(file, loaded, mesh, of);
}

/// The Python package has checked the shapes.
std::shared_ptr<const PyColumns> make_columns(const PyMesh& self, std::size_t n_layers, const Doubles& surfaces,
                                              const Int32s& active, double pinch_out, const std::string& cells) {
  const auto of = from_name<CellsOf>("cells", cells);
  Layers layers;
  layers.n_layers = n_layers;
  const auto heights = as_span<double>(surfaces);
  layers.surfaces.assign(heights.begin(), heights.end());
  for (const std::int32_t flag : as_span<std::int32_t>(active)) layers.active.push_back(flag != 0 ? 1 : 0);
  const auto mesh = self.read();
  require_plane(*mesh, "columns()");
  std::vector<io::GroupCell> groups = groups_of(self, *mesh, of);
  const py::gil_scoped_release release;
  DecComplex complex = dec_operators(*mesh);
  PowerCells power = power_cells(*mesh, complex);
  CellPolygons plan = of == CellsOf::vertices ? cell_polygons(*mesh, power) : cell_polygons(*mesh, complex, of);
  Columns made = or_raise(columns(*mesh, complex, std::move(plan), layers, {pinch_out, nullptr}));
  return std::make_shared<const PyColumns>(
      PyColumns{mesh, std::move(complex), std::move(power), std::move(made), std::move(groups)});
}

/// (layers, columns).
template <class T, class Value>
py::array of_cells(const py::object& owner, const Columns& c, const std::vector<Value>& values) {
  static_assert(sizeof(T) == sizeof(Value));
  const auto n = static_cast<py::ssize_t>(c.n_columns()), size = static_cast<py::ssize_t>(sizeof(T));
  return view(py::dtype::of<T>(), {static_cast<py::ssize_t>(c.n_layers), n}, {n * size, size}, values.data(), owner);
}

/// One member of each connection, or two members in a row.
template <class T>
py::array of_connections(const py::object& owner, const Columns& c, T ColumnConnection::*first, py::ssize_t width = 1) {
  const ColumnConnection none;
  const ColumnConnection* const front = c.connections.empty() ? &none : c.connections.data();
  const T* const start = &(front->*first);
  const auto n = static_cast<py::ssize_t>(c.connections.size());
  const py::ssize_t stride = sizeof(ColumnConnection), size = sizeof(T);
  if (width == 1) return view(py::dtype::of<T>(), {n}, {stride}, start, owner);
  return view(py::dtype::of<T>(), {n, width}, {stride, size}, start, owner);
}

py::list groups_to_python(const std::vector<io::GroupCell>& groups) {
  constexpr const char* kKinds[] = {"point", "line", "boundary"};
  py::list rows;
  for (const io::GroupCell& g : groups)
    rows.append(py::make_tuple(g.name, kKinds[static_cast<std::size_t>(g.kind)], g.cell, g.length));
  return rows;
}

py::dict columns_to_dict(const std::shared_ptr<const PyColumns>& made) {
  const py::object owner = keep(made);
  const Columns& c = made->columns;
  return Record()("n_columns", c.n_columns())("n_layers", c.n_layers)(
             "states", of_cells<std::int8_t>(owner, c, c.states))("tops", of_cells<double>(owner, c, c.tops))(
             "bottoms", of_cells<double>(owner, c, c.bottoms))("volumes", of_cells<double>(owner, c, c.volumes))(
             "areas", whole(owner, c.plan.areas))("cells", of_connections(owner, c, &ColumnConnection::first, 2))(
             "is_vertical", of_connections(owner, c, &ColumnConnection::is_vertical))(
             "distances", of_connections(owner, c, &ColumnConnection::first_distance, 2))(
             "widths", of_connections(owner, c, &ColumnConnection::width))(
             "face_areas", of_connections(owner, c, &ColumnConnection::area))("groups", groups_to_python(made->groups))
      .dict;
}

/// The barriers of lines of the mesh's file, as rows: name, two cells, characteristic. `named` has pairs of a name and
/// a characteristic.
py::list barriers_of(const PyMesh& self, const py::sequence& named, const std::string& cells) {
  std::vector<std::pair<std::string, double>> characteristics;
  for (const auto& entry : named) {
    const auto pair = entry.cast<py::tuple>();
    characteristics.emplace_back(pair[0].cast<std::string>(), pair[1].cast<double>());
  }
  const auto of = from_name<CellsOf>("cells", cells);
  const auto mesh = self.read();
  const auto [file, loaded] = file_now(self, *mesh);
  py::list rows;
  for (const io::Barrier& b : or_raise(io::barriers_of_lines(file, loaded, *mesh, characteristics, of)))
    rows.append(py::make_tuple(b.name, b.first, b.second, b.characteristic));
  return rows;
}

py::dict faces_of_line_to_dict(const PyMesh& self, const std::string& name) {
  const auto mesh = self.read();
  require_plane(*mesh, "faces_of()");
  const auto [file, loaded] = file_now(self, *mesh);
  const auto made =
      std::make_shared<const std::vector<io::LineFace>>(or_raise(io::faces_of_line(file, loaded, *mesh, name)));
  const py::object owner = keep(made);
  const auto n = static_cast<py::ssize_t>(made->size());
  const py::ssize_t stride = sizeof(io::LineFace), number = sizeof(double);
  const io::LineFace& first = made->front();  // there is one, or an error
  return Record()("vertices", view(py::dtype::of<std::int32_t>(), {n, 2}, {stride, 4}, &first.first, owner))(
             "ends", view(py::dtype::of<double>(), {n, 2, 2}, {stride, 2 * number, number}, &first.from, owner))(
             "length", view(py::dtype::of<double>(), {n}, {stride}, &first.length, owner))
      .dict;
}

std::vector<io::Barrier> barriers_from(const py::sequence& rows) {
  std::vector<io::Barrier> barriers;
  for (const auto& row : rows) {
    const auto fields = row.cast<py::tuple>();
    barriers.push_back({fields[0].cast<std::string>(), fields[1].cast<std::uint32_t>(), fields[2].cast<std::uint32_t>(),
                        fields[3].cast<double>()});
  }
  return barriers;
}

}  // namespace

void bind_columns(py::module_& m) {
  m.def("cell_polygons", cell_polygons_to_dict);
  m.def("barriers_of_lines", barriers_of);
  m.def("faces_of_line", faces_of_line_to_dict);
  py::class_<PyColumns, std::shared_ptr<PyColumns>>(m, "Columns")
      .def("arrays", [](const std::shared_ptr<PyColumns>& c) { return columns_to_dict(c); })
      .def("write", [](const PyColumns& c, const std::string& folder, const py::sequence& formats,
                       const py::object& threads, const py::object& rows) {
        io::DecWriteOptions given;
        given.columns = &c.columns;
        if (!c.groups.empty()) given.groups = c.groups;
        std::vector<io::Barrier> barriers;
        if (!rows.is_none()) barriers = barriers_from(rows.cast<py::sequence>());
        if (!rows.is_none()) given.barriers = barriers;
        const auto write = [&](const io::DecWriteOptions& options) {
          return io::write_dec(folder, *c.mesh, c.complex, c.cells, options);
        };
        return to_python(write_files(formats, threads, write, given));
      });
  m.def("columns", [](const PyMesh& self, std::size_t n_layers, const Doubles& surfaces, const Int32s& active,
                      double pinch_out, const std::string& cells) {
    return std::const_pointer_cast<PyColumns>(make_columns(self, n_layers, surfaces, active, pinch_out, cells));
  });
}

}  // namespace temper::python

// Bindings of the operators, and of columns (cells under layers).
#include <type_traits>
#include <utility>

#include "bind.hpp"
#include "reports.hpp"
#include "temper/dec.hpp"
#include "temper/detail/columns.hpp"
#include "temper/detail/dec_io.hpp"
#include "temper/tets/operators.hpp"

TEMPER_PYTHON_NAMES(temper::io::DecFormat, "npz", "mtx", "vtu", "disv", "disu", "tough", "uge");

namespace temper::python {
namespace {

// --- dec: views on one value, which the arrays keep alive
// -------------------------------------------------------------

using Complex = std::shared_ptr<const DecComplex>;

/// One member of every element of a vector of structs.
template <class Value, class IdType, class Struct>
py::array column(const py::object& owner, const IdVector<IdType, Struct>& rows, const void* first, int width = 1) {
  const auto n = static_cast<py::ssize_t>(rows.size());
  const py::ssize_t stride = sizeof(Struct), item = py::dtype::of<Value>().itemsize();
  if (width == 1) return view(py::dtype::of<Value>(), {n}, {stride}, first, owner);
  return view(py::dtype::of<Value>(), {n, py::ssize_t{width}}, {stride, item}, first, owner);
}

template <class T>
py::array whole(const py::object& owner, const std::vector<T>& values) {
  return view(dtype_of<T>(), {static_cast<py::ssize_t>(values.size())}, {sizeof(T)}, values.data(), owner);
}

/// Places as rows: two columns in the plane, three columns on the sphere. One of the two arrays is empty.
py::array places(const py::object& owner, const std::vector<Vec2>& plane, const std::vector<Vec3>& sphere) {
  const auto doubles = py::dtype::of<double>();
  if (sphere.empty()) return view(doubles, {static_cast<py::ssize_t>(plane.size()), 2}, {16, 8}, plane.data(), owner);
  return view(doubles, {static_cast<py::ssize_t>(sphere.size()), 3}, {24, 8}, sphere.data(), owner);
}

py::dict edges_to_dict(const py::object& owner, const DecComplex& complex) {
  const IdVector<EdgeId, DecEdge>& edges = complex.edges;
  const auto& on_sphere = complex.sphere_midpoints;
  const DecEdge none;
  const DecEdge& e = edges.empty() ? none : edges[EdgeId(0)];
  using std::int32_t;
  return Record()("vertices", column<int32_t>(owner, edges, &e.from, 2))(
             "triangles", column<int32_t>(owner, edges, &e.left, 2))("length", column<double>(owner, edges, &e.length))(
             "crossing", column<double>(owner, edges, &e.crossing))("left_height",
                                                                    column<double>(owner, edges, &e.left_height))(
             "right_height", column<double>(owner, edges, &e.right_height))(
             "dual_length", column<double>(owner, edges, &e.dual_length))(
             "midpoint",
             on_sphere.empty() ? column<double>(owner, edges, &e.midpoint, 2) : places(owner, {}, on_sphere.raw()))
      .dict;
}

py::dict incidence_to_dict(const py::object& owner, const IncidenceMatrix& matrix) {
  return Record()("n_columns", matrix.n_columns)("starts", whole(owner, matrix.starts))(
             "columns", whole(owner, matrix.columns))("signs", whole(owner, matrix.signs))
      .dict;
}

struct PyDec {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const Mesh> measured;  // mesh in the metric of a tensor; else the same mesh
  Metric metric;
  Complex complex;

  [[nodiscard]] bool has_tensor() const { return measured != mesh; }
  [[nodiscard]] PowerCells cells() const {
    PowerCells made = power_cells(*measured, *complex);
    return has_tensor() ? mapped_back(std::move(made), metric) : made;
  }
};

/// `coefficient`: one value per triangle, or none at all.
PyDec make_dec(const PyMesh& self, const py::object& tensor, const Doubles& coefficient) {
  const auto mesh = self.read();
  const std::span<const double> k = as_span<double>(coefficient);
  const auto operators = [k](const Mesh& measured) {
    DecComplex plain = dec_operators(measured);
    return k.empty() ? std::move(plain) : or_raise(with_coefficient(measured, std::move(plain), k));
  };
  if (tensor.is_none()) {
    const py::gil_scoped_release release;
    return {mesh, mesh, {}, std::make_shared<const DecComplex>(operators(*mesh))};
  }
  const Metric metric = metric_from(tensor);
  const py::gil_scoped_release release;
  auto measured = std::make_shared<const Mesh>(or_raise(mapped(*mesh, metric)));
  return {mesh, measured, metric, std::make_shared<const DecComplex>(mapped_back(operators(*measured), metric))};
}

py::dict dec_to_dict(const PyDec& d) {
  const py::object owner = keep(d.complex);
  const DecComplex& c = *d.complex;
  return Record()("edges", edges_to_dict(owner, c))(
             "edge_of_halfedge",
             view(py::dtype::of<std::int32_t>(), {static_cast<py::ssize_t>(c.edge_of_halfedge.size())}, {4},
                  c.edge_of_halfedge.raw().data(), owner))("d0", incidence_to_dict(owner, c.d0))(
             "d1", incidence_to_dict(owner, c.d1))("star0", whole(owner, c.star0.raw()))(
             "star1", whole(owner, c.star1.raw()))("star2", whole(owner, c.star2.raw()))(
             "transmissibility", whole(owner, c.transmissibility.raw()))(
             "orthocenters", places(owner, c.orthocenters.raw(), c.sphere_orthocenters.raw()))(
             "areas", whole(owner, c.areas.raw()))("coefficient", whole(owner, c.coefficient.raw()))(
             "capacity", whole(owner, c.capacity.raw()))
      .dict;
}

py::dict cells_to_dict(const PyDec& d) {
  auto cells = aside([&] { return std::make_shared<const PowerCells>(d.cells()); });
  const py::object owner = keep(cells);
  const PowerCells& c = *cells;
  return Record()("vertices", whole(owner, c.vertices))("starts", c.starts)(
             "corners", places(owner, c.corners, c.sphere_corners))("polygon_areas", whole(owner, c.polygon_areas))(
             "areas", whole(owner, c.areas.raw()))
      .dict;
}

/// Writes files into a folder. `write` does so with given options; it runs without the GIL.
template <class Write>
std::vector<std::string> write_files(const py::sequence& formats, const py::object& threads, const Write& write,
                                     io::DecWriteOptions options = {}) {
  options.formats.clear();
  for (const auto& f : formats) options.formats.push_back(from_name<io::DecFormat>("formats", f.cast<std::string>()));
  const auto count = threads_from(threads);
  const py::gil_scoped_release release;
  const auto executor = make_threads(count);
  options.executor = executor.get();
  return or_raise(write(options));
}

void bind_operators(py::module_& m) {
  py::class_<PyDec>(m, "DecComplex")
      .def("mesh", [](const PyDec& d) { return std::make_unique<PyMesh>(Mesh(*d.mesh)); })
      .def("tensor",
           [](const PyDec& d) -> py::object {
             if (!d.has_tensor()) return py::none();
             const Tensor& k = d.metric.tensor();
             return py::make_tuple(k.xx, k.xy, k.yy);
           })
      .def("arrays", dec_to_dict)
      .def("summarize", [](const PyDec& d) { return report_to_python(summarize(*d.measured, *d.complex)); })
      .def("power_cells", cells_to_dict)
      .def("write",
           [](const PyDec& d, const std::string& folder, const py::sequence& formats, const py::object& threads) {
             return to_python(write_files(formats, threads, [&](const io::DecWriteOptions& options) {
               return io::write_dec(folder, *d.mesh, *d.complex, d.cells(), options);
             }));
           });
  m.def("dec_operators", make_dec);
}

// --- of tetrahedra ----------------------------------------------------------------------------------------------

struct PyTetDec {
  PyTetMesh mesh;
  std::shared_ptr<const tets::DecComplex> complex;
};

PyTetDec make_tet_dec(const PyTetMesh& mesh, const Doubles& coefficient) {
  const std::span<const double> k = as_span<double>(coefficient);
  const py::gil_scoped_release release;
  tets::DecComplex made = tets::dec_operators(mesh.mesh());
  if (!k.empty()) made = or_raise(tets::with_coefficient(mesh.mesh(), std::move(made), k));
  return {mesh, std::make_shared<const tets::DecComplex>(std::move(made))};
}

py::array places(const py::object& owner, const std::vector<Vec3>& in_space) { return places(owner, {}, in_space); }

py::dict edges_to_dict(const py::object& owner, const tets::DecComplex& complex) {
  const IdVector<EdgeId, tets::DecEdge>& edges = complex.edges;
  const tets::DecEdge none;
  const tets::DecEdge& e = edges.empty() ? none : edges[EdgeId(0)];
  return Record()("vertices", column<std::int32_t>(owner, edges, &e.from, 2))(
             "is_boundary", column<bool>(owner, edges, &e.is_boundary))(
             "length", column<double>(owner, edges, &e.length))("crossing", column<double>(owner, edges, &e.crossing))(
             "dual_area", column<double>(owner, edges, &e.dual_area))("midpoint",
                                                                      column<double>(owner, edges, &e.midpoint, 3))
      .dict;
}

py::dict faces_to_dict(const py::object& owner, const tets::DecComplex& complex) {
  const IdVector<tets::FaceId, tets::DecFace>& faces = complex.faces;
  const tets::DecFace none;
  const tets::DecFace& f = faces.empty() ? none : faces[tets::FaceId(0)];
  return Record()("vertices", column<std::int32_t>(owner, faces, &f.vertices, 3))(
             "tetrahedra", column<std::int32_t>(owner, faces, &f.behind, 2))(
             "area", column<double>(owner, faces, &f.area))("behind_height",
                                                            column<double>(owner, faces, &f.behind_height))(
             "ahead_height", column<double>(owner, faces, &f.ahead_height))(
             "dual_length", column<double>(owner, faces, &f.dual_length))(
             "orthocenter", column<double>(owner, faces, &f.orthocenter, 3))
      .dict;
}

py::dict tet_dec_to_dict(const PyTetDec& d) {
  const py::object owner = keep(d.complex);
  const tets::DecComplex& c = *d.complex;
  return Record()("edges", edges_to_dict(owner, c))("faces", faces_to_dict(owner, c))(
             "d0", incidence_to_dict(owner, c.d0))("d1", incidence_to_dict(owner, c.d1))(
             "d2", incidence_to_dict(owner, c.d2))("star0", whole(owner, c.star0.raw()))(
             "star1", whole(owner, c.star1.raw()))("star2", whole(owner, c.star2.raw()))(
             "star3", whole(owner, c.star3.raw()))("transmissibility", whole(owner, c.transmissibility.raw()))(
             "orthocenters", places(owner, c.orthocenters.raw()))("volumes", whole(owner, c.volumes.raw()))(
             "coefficient", whole(owner, c.coefficient.raw()))("capacity", whole(owner, c.capacity.raw()))
      .dict;
}

void bind_tet_operators(py::module_& m) {
  py::class_<PyTetDec>(m, "TetDecComplex")
      .def("mesh", [](const PyTetDec& d) { return d.mesh; })
      .def("arrays", tet_dec_to_dict)
      .def("summarize", [](const PyTetDec& d) { return report_to_python(tets::summarize(*d.complex)); })
      .def("write",
           [](const PyTetDec& d, const std::string& folder, const py::sequence& formats, const py::object& threads) {
             return to_python(write_files(formats, threads, [&](const io::DecWriteOptions& options) {
               return io::write_dec(folder, d.mesh.mesh(), *d.complex, options);
             }));
           });
  m.def("tet_dec_operators", make_tet_dec);
}

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

/// The cells of the groups of the mesh's file; none without a file.
std::vector<io::GroupCell> groups_of(const PyMesh& self, const Mesh& mesh, CellsOf of) {
  if (!self.source()) return {};
  io::MeshFile file = self.source()->file;
  if (file.lines.empty() && file.marked_points.empty()) return {};
  file.point_data.clear();
  file.triangles.data.clear();
  io::update(file, self.source()->loaded, mesh, self.origin());
  return io::cells_of_groups(file, or_raise(io::make_mesh(file)), mesh, of);
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
  io::MeshFile file = self.source() ? self.source()->file : io::MeshFile();
  io::LoadedMesh loaded;
  if (self.source()) {
    file.point_data.clear();
    file.triangles.data.clear();
    io::update(file, self.source()->loaded, *mesh, self.origin());
    loaded = or_raise(io::make_mesh(file));
  }
  py::list rows;
  for (const io::Barrier& b : or_raise(io::barriers_of_lines(file, loaded, *mesh, characteristics, of)))
    rows.append(py::make_tuple(b.name, b.first, b.second, b.characteristic));
  return rows;
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

void bind_columns(py::module_& m) {
  m.def("cell_polygons", cell_polygons_to_dict);
  m.def("barriers_of_lines", barriers_of);
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

}  // namespace

void bind_dec(py::module_& m) {
  bind_operators(m);
  bind_tet_operators(m);
  bind_columns(m);
}

}  // namespace temper::python

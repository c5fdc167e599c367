// Bindings of the operators.
#include <optional>
#include <type_traits>
#include <utility>

#include "bind.hpp"
#include "dec_arrays.hpp"
#include "reports.hpp"
#include "temper/dec.hpp"
#include "temper/detail/dec_io.hpp"
#include "temper/tets/operators.hpp"

namespace temper::python {
namespace {

// --- dec: views on one value, which the arrays keep alive
// -------------------------------------------------------------

using Complex = std::shared_ptr<const DecComplex>;

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
  std::shared_ptr<const MetricMesh> pieces;  // in the metrics of tensors; null without
  Complex measured;                          // the operators of pieces; else the same
  Complex complex;

  [[nodiscard]] PowerCells cells() const {
    PowerCells made = power_cells(as_measured(), *measured);
    return pieces ? mapped_back(std::move(made), *pieces) : made;
  }
  [[nodiscard]] const Mesh& as_measured() const { return pieces ? pieces->mesh : *mesh; }
  [[nodiscard]] auto owner() const { return std::make_unique<PyMesh>(Mesh(*mesh)); }
  [[nodiscard]] DecSummary summary() const { return summarize(as_measured(), *complex); }
};

struct PySurfaceDec {
  PySurface surface;
  std::shared_ptr<const surfaces::SurfaceMesh> mesh;
  Complex complex;

  [[nodiscard]] PowerCells cells() const { return dual_cells(*mesh, *complex); }
  [[nodiscard]] PySurface owner() const { return surface; }
  [[nodiscard]] DecSummary summary() const { return summarize(*mesh, *complex); }
};

template <class AnyMesh>
DecComplex operators_of(const AnyMesh& mesh, std::span<const double> coefficient) {
  DecComplex plain = dec_operators(mesh);
  return coefficient.empty() ? std::move(plain) : or_raise(with_coefficient(mesh, std::move(plain), coefficient));
}

/// `coefficient`: one value per triangle, or none at all.
PyDec make_dec(const PyMesh& self, const py::object& tensor, const Doubles& coefficient) {
  const auto mesh = self.read();
  const std::span<const double> k = as_span<double>(coefficient);
  if (tensor.is_none()) {
    const py::gil_scoped_release release;
    const auto complex = std::make_shared<const DecComplex>(operators_of(*mesh, k));
    return {mesh, nullptr, complex, complex};
  }
  const auto given = tensors_from<Tensor>(tensor);
  const py::gil_scoped_release release;
  auto pieces = std::make_shared<const MetricMesh>(in_metric(*mesh, given));
  const auto measured = std::make_shared<const DecComplex>(operators_of(pieces->mesh, k));
  return {mesh, pieces, measured, std::make_shared<const DecComplex>(mapped_back(*measured, *pieces, *mesh))};
}

PySurfaceDec make_surface_dec(const PySurface& self, const py::object& /*tensor*/, const Doubles& coefficient) {
  const auto mesh = self.read();
  const std::span<const double> k = as_span<double>(coefficient);
  return {self, mesh, aside([&] { return std::make_shared<const DecComplex>(operators_of(*mesh, k)); })};
}

py::dict dec_to_dict(const Complex& complex) {
  const py::object owner = keep(complex);
  const DecComplex& c = *complex;
  return Record()("edges", edges_to_dict(owner, c))(
             "edge_of_halfedge",
             view(py::dtype::of<std::int32_t>(), {static_cast<py::ssize_t>(c.edge_of_halfedge.size())}, {4},
                  c.edge_of_halfedge.raw().data(), owner))("d0", incidence_to_dict(owner, c.d0))(
             "d1", incidence_to_dict(owner, c.d1))("star0", whole(owner, c.star0.raw()))(
             "star1", whole(owner, c.star1.raw()))("star2", whole(owner, c.star2.raw()))(
             "transmissibility", whole(owner, c.transmissibility.raw()))(
             "orthocenters", places(owner, c.orthocenters.raw(), c.sphere_orthocenters.raw()))(
             "areas", whole(owner, c.areas.raw()))("coefficient", whole(owner, c.coefficient.raw()))(
             "capacity", whole(owner, c.capacity.raw()))("half_transmissibility",
                                                         whole(owner, c.half_transmissibility.raw()))
      .dict;
}

template <class Dec>
py::dict cells_to_dict(const Dec& d) {
  auto cells = aside([&] { return std::make_shared<const PowerCells>(d.cells()); });
  const py::object owner = keep(cells);
  const PowerCells& c = *cells;
  return Record()("vertices", whole(owner, c.vertices))("starts", c.starts)(
             "corners", places(owner, c.corners, c.sphere_corners))("polygon_areas", whole(owner, c.polygon_areas))(
             "areas", whole(owner, c.areas.raw()))
      .dict;
}

template <class Dec>
void bind_complex(py::module_& m, const char* name) {
  py::class_<Dec>(m, name)
      .def("mesh", [](const Dec& d) { return d.owner(); })
      .def("arrays", [](const Dec& d) { return dec_to_dict(d.complex); })
      .def("summarize", [](const Dec& d) { return report_to_python(d.summary()); })
      .def("power_cells", cells_to_dict<Dec>)
      .def("write",
           [](const Dec& d, const std::string& folder, const py::sequence& formats, const py::object& threads) {
             return to_python(write_files(formats, threads, [&](const io::DecWriteOptions& options) {
               return io::write_dec(folder, *d.mesh, *d.complex, d.cells(), options);
             }));
           });
}

// --- of intrinsic triangulations --------------------------------------------------------------------------------

py::dict intrinsic_to_dict(const PyIntrinsic& self) {
  const auto complex = std::make_shared<const DecComplex>(dec_operators(*self.mesh));
  std::vector<std::array<VertexId, 3>> triangles;
  std::vector<double> weights;
  for (const TriangleId t : self.mesh->connectivity().triangles())
    triangles.push_back(self.mesh->connectivity().corners(t));
  for (const VertexId v : self.mesh->connectivity().vertices()) weights.push_back(self.mesh->weight(v));
  return Record{dec_to_dict(complex)}(
             "triangles", rows_of<VertexId>(std::span<const std::array<VertexId, 3>>(triangles)))("weights", weights)
      .dict;
}

void bind_intrinsic(py::module_& m) {
  py::class_<PyIntrinsic>(m, "IntrinsicMesh")
      .def("arrays", intrinsic_to_dict)
      .def("write", [](const PyIntrinsic& self, const std::string& folder) {
        return to_python(
            or_raise(aside([&] { return io::write_dec(folder, *self.mesh, dec_operators(*self.mesh), {}); })));
      });
}

void bind_operators(py::module_& m) {
  bind_complex<PyDec>(m, "DecComplex");
  bind_complex<PySurfaceDec>(m, "SurfaceDecComplex");
  m.def("dec_operators", make_dec);
  m.def("dec_operators", make_surface_dec);
  bind_intrinsic(m);
}

// --- of tetrahedra ----------------------------------------------------------------------------------------------

struct PyTetDec {
  PyTetMesh mesh;
  std::shared_ptr<const tets::DecComplex> complex;
};

PyTetDec make_tet_dec(const PyTetMesh& mesh, const py::object& tensor, const Doubles& coefficient) {
  const std::span<const double> k = as_span<double>(coefficient);
  const auto operators = [k](const tets::TetMesh& measured) {
    tets::DecComplex plain = tets::dec_operators(measured);
    return k.empty() ? std::move(plain) : or_raise(tets::with_coefficient(measured, std::move(plain), k));
  };
  std::optional<GivenTensors<Tensor3>> given;
  if (!tensor.is_none()) given = tensors_from<Tensor3>(tensor);
  const py::gil_scoped_release release;
  if (!given) return {mesh, std::make_shared<const tets::DecComplex>(operators(mesh.mesh()))};
  const tets::MetricMesh pieces = in_metric(mesh.mesh(), *given);
  return {mesh, std::make_shared<const tets::DecComplex>(mapped_back(operators(pieces.mesh), pieces, mesh.mesh()))};
}

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
             "orthocenters", places(owner, {}, c.orthocenters.raw()))("volumes", whole(owner, c.volumes.raw()))(
             "coefficient", whole(owner, c.coefficient.raw()))("capacity", whole(owner, c.capacity.raw()))(
             "half_transmissibility", whole(owner, c.half_transmissibility.raw()))
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

}  // namespace

void bind_dec(py::module_& m) {
  bind_operators(m);
  bind_tet_operators(m);
}

}  // namespace temper::python

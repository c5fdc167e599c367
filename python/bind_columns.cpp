// Bindings of columns: cells under layers, for codes of groundwater and reservoirs.
#include <utility>

#include "bind.hpp"
#include "bind_dec.hpp"
#include "temper/columns.hpp"

namespace temper::python {
namespace {

struct PyColumns {
  std::shared_ptr<const Mesh> mesh;
  DecComplex complex;
  PowerCells cells;
  Columns columns;
};

/// The Python package has seen to shapes.
std::shared_ptr<const PyColumns> make_columns(const PyMesh& self, std::size_t n_layers, const Doubles& surfaces,
                                              const Int32s& active, double pinch_out) {
  Layers layers;
  layers.n_layers = n_layers;
  const auto heights = as_span<double>(surfaces);
  layers.surfaces.assign(heights.begin(), heights.end());
  for (const std::int32_t flag : as_span<std::int32_t>(active)) layers.active.push_back(flag != 0 ? 1 : 0);
  const auto mesh = self.read();
  require_plane(*mesh, "columns()");
  const py::gil_scoped_release release;
  DecComplex complex = dec(*mesh);
  PowerCells cells = power_cells(*mesh, complex);
  Columns made = or_raise(columns(*mesh, complex, cells, layers, {pinch_out, nullptr}));
  return std::make_shared<const PyColumns>(PyColumns{mesh, std::move(complex), std::move(cells), std::move(made)});
}

/// (layers, vertices).
template <class T, class Value>
py::array of_cells(const py::object& owner, const Columns& c, const std::vector<Value>& values) {
  static_assert(sizeof(T) == sizeof(Value));
  const auto n = static_cast<py::ssize_t>(c.n_vertices), size = static_cast<py::ssize_t>(sizeof(T));
  return view(py::dtype::of<T>(), {static_cast<py::ssize_t>(c.n_layers), n}, {n * size, size}, values.data(), owner);
}

/// One member of each connection, or two that follow each other.
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

py::dict columns_to_dict(const std::shared_ptr<const PyColumns>& made) {
  const py::object owner = keep(made);
  const Columns& c = made->columns;
  return Record()("n_vertices", c.n_vertices)("n_layers", c.n_layers)(
             "states", py::object(of_cells<std::int8_t>(owner, c, c.states)))(
             "tops", py::object(of_cells<double>(owner, c, c.tops)))("bottoms",
                                                                     py::object(of_cells<double>(owner, c, c.bottoms)))(
             "volumes", py::object(of_cells<double>(owner, c, c.volumes)))("areas", c.areas)(
             "cells", py::object(of_connections(owner, c, &ColumnConnection::first, 2)))(
             "is_vertical", py::object(of_connections(owner, c, &ColumnConnection::is_vertical)))(
             "distances", py::object(of_connections(owner, c, &ColumnConnection::first_distance, 2)))(
             "widths", py::object(of_connections(owner, c, &ColumnConnection::width)))(
             "face_areas", py::object(of_connections(owner, c, &ColumnConnection::area)))
      .dict;
}

py::object write_columns(const PyColumns& made, const std::string& folder, const std::vector<io::DecFormat>& formats,
                         const py::object& threads) {
  const auto count = threads_from(threads);
  std::vector<std::string> paths;
  {
    const py::gil_scoped_release release;
    const auto executor = make_threads(count);
    io::DecWriteOptions options;
    options.formats = formats;
    options.columns = &made.columns;
    options.executor = executor.get();
    paths = or_raise(io::write_dec(folder, *made.mesh, made.complex, made.cells, options));
  }
  return to_python(paths);
}

}  // namespace

void bind_columns(py::module_& m) {
  py::class_<PyColumns, std::shared_ptr<PyColumns>>(m, "Columns")
      .def("arrays", [](const std::shared_ptr<PyColumns>& c) { return columns_to_dict(c); })
      .def("write",
           [](const PyColumns& c, const std::string& folder, const py::sequence& names, const py::object& threads) {
             std::vector<io::DecFormat> formats;
             for (const auto& name : names)
               formats.push_back(from_name<io::DecFormat>("formats", name.cast<std::string>()));
             return write_columns(c, folder, formats, threads);
           });
  m.def("columns",
        [](const PyMesh& self, std::size_t n_layers, const Doubles& surfaces, const Int32s& active, double pinch_out) {
          return std::const_pointer_cast<PyColumns>(make_columns(self, n_layers, surfaces, active, pinch_out));
        });
}

}  // namespace temper::python

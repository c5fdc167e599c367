// Arrays of operators, cells and columns as views, and the files of operators.
#pragma once

#include <string>
#include <vector>

#include "bind.hpp"
#include "temper/detail/dec_io.hpp"

TEMPER_PYTHON_NAMES(temper::io::DecFormat, "npz", "mtx", "vtu", "disv", "disu", "tough", "uge");

namespace temper::python {

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
inline py::array places(const py::object& owner, const std::vector<Vec2>& plane, const std::vector<Vec3>& sphere) {
  const auto doubles = py::dtype::of<double>();
  if (sphere.empty()) return view(doubles, {static_cast<py::ssize_t>(plane.size()), 2}, {16, 8}, plane.data(), owner);
  return view(doubles, {static_cast<py::ssize_t>(sphere.size()), 3}, {24, 8}, sphere.data(), owner);
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

}  // namespace temper::python

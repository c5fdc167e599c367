// Data, tags and names of files, as arrays and dictionaries of Python.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "bind.hpp"
#include "temper/io.hpp"

namespace temper::python {

inline py::object to_python_array(const io::DataArray& data) {
  return std::visit(
      [&data](const auto& values) -> py::object {
        using T = typename std::decay_t<decltype(values)>::value_type;
        const auto n = static_cast<py::ssize_t>(values.size());
        if (data.components == 1) return py::array(py::dtype::of<T>(), Shape{n}, values.data());
        return py::array(py::dtype::of<T>(), Shape{n / data.components, py::ssize_t{data.components}}, values.data());
      },
      data.values);
}

inline py::dict to_python_dict(const std::vector<io::DataArray>& arrays) {
  py::dict dict;
  for (const io::DataArray& array : arrays) dict[py::str(array.name)] = to_python_array(array);
  return dict;
}

template <class T>
bool take_values(io::DataArray& data, const py::array& array) {
  if (!array.dtype().is(py::dtype::of<T>()) && !array.dtype().equal(py::dtype::of<T>())) return false;
  const auto same = py::array_t<T, py::array::c_style | py::array::forcecast>(array);
  data.values = std::vector<T>(same.data(), same.data() + same.size());
  return true;
}

/// One- or two-dimensional arrays of the types in files. The Python package has converted other types to these.
inline io::DataArray from_python_array(const std::string& name, const py::array& array) {
  io::DataArray data{name, array.ndim() > 1 ? static_cast<int>(array.shape(1)) : 1, {}};
  const bool taken = take_values<double>(data, array) || take_values<float>(data, array) ||
                     take_values<std::int64_t>(data, array) || take_values<std::int32_t>(data, array) ||
                     take_values<std::uint8_t>(data, array) || take_values<std::int8_t>(data, array) ||
                     take_values<std::int16_t>(data, array) || take_values<std::uint16_t>(data, array) ||
                     take_values<std::uint32_t>(data, array) || take_values<std::uint64_t>(data, array);
  if (!taken) throw py::type_error("data '" + name + "': " + std::string(py::str(array.dtype())) + " is not supported");
  return data;
}

/// An array with the given number of rows.
inline io::DataArray from_python_array(const std::string& name, const py::array& array, std::size_t size,
                                       const char* kind) {
  if (static_cast<std::size_t>(array.shape(0)) != size) {
    fail(ErrorCode::size_mismatch, std::string(kind) + " '" + name + "': expected " + std::to_string(size) +
                                       " values, found " + std::to_string(array.shape(0)));
  }
  return from_python_array(name, array);
}

/// Raises KeyError if there is no array with this name.
inline void erase_array(std::vector<io::DataArray>& arrays, const std::string& name) {
  if (std::erase_if(arrays, [&](const io::DataArray& a) { return a.name == name; }) == 0) throw py::key_error(name);
}

/// The data of the cells that the mesh of a file has.
template <class File>
auto& cell_data_of(File& file) {
  return file.dimension() == 3 ? file.tetrahedra.data : file.triangles.data;
}

/// The rules, without those of arrays that the file does not have.
[[nodiscard]] MeshDataRules without_absent(MeshDataRules rules, const io::MeshFile& file);
/// Raises if a rule names no array of the file, or does not fit its array.
void check_data_rules(const MeshDataRules& rules, const io::MeshFile& file);

inline std::vector<io::DataArray> from_python_dict(const py::dict& dict, std::size_t size, const char* kind) {
  std::vector<io::DataArray> arrays;
  for (const auto& [name, value] : dict)
    arrays.push_back(from_python_array(name.cast<std::string>(), value.cast<py::array>(), size, kind));
  return arrays;
}

/// Arrays of any number of rows.
inline std::vector<io::DataArray> from_python_dict(const py::dict& dict) {
  std::vector<io::DataArray> arrays;
  for (const auto& [name, value] : dict)
    arrays.push_back(from_python_array(name.cast<std::string>(), value.cast<py::array>()));
  return arrays;
}

template <class T, class Array>
std::vector<T> copy_of(const Array& array) {
  const auto values = as_span<T>(array);
  return {values.begin(), values.end()};
}

template <std::size_t n>
void check_range(const std::vector<std::array<std::int32_t, n>>& cells, std::size_t n_points, const char* kind) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const std::int32_t p : cells[i]) {
      if (p >= 0 && static_cast<std::size_t>(p) < n_points) continue;
      fail(ErrorCode::index_out_of_range, std::string(kind) + " " + std::to_string(i) + " uses point " +
                                              std::to_string(p) + ", but there are " + std::to_string(n_points) +
                                              " points. Next: count points from 0");
    }
  }
}

/// Everything in a file but the points, the cells of the mesh, and the tags of its faces.
inline Record contents_of(const io::MeshFile& file) {
  const bool tetrahedra = file.dimension() == 3;
  return Record()("weights", file.weights)(
      "regions", array_of<std::int32_t>(tetrahedra ? file.tetrahedra.tags : file.triangles.tags))(
      "lines", rows_of<std::int32_t>(std::span<const std::array<std::int32_t, 2>>(file.lines)))(
      "line_tags", array_of<std::int32_t>(file.lines.tags))("marked_points",
                                                            array_of<std::int32_t>(file.marked_points.corners))(
      "point_tags", array_of<std::int32_t>(file.marked_points.tags))(
      "names", py::object(physical_names_to_python(file.names)))("point_data",
                                                                 py::object(to_python_dict(file.point_data)))(
      "cell_data", py::object(to_python_dict(tetrahedra ? file.tetrahedra.data : file.triangles.data)))(
      "line_data", py::object(to_python_dict(file.lines.data)))("marked_point_data",
                                                                py::object(to_python_dict(file.marked_points.data)))(
      "field_data", py::object(to_python_dict(file.field_data)))("path", file.path)("format", file.format)(
      "warnings", file.warnings);
}

/// Takes the same contents from Python, with the regions and data of the cells of the mesh.
template <int dimension>
void take_contents(io::MeshFile& file, io::Cells<dimension>& cells, const py::dict& d, std::size_t n_points) {
  file.weights = copy_of<double>(d["weights"].cast<Doubles>());
  cells.tags = copy_of<std::int32_t>(d["regions"].cast<Int32s>());
  file.lines.corners = narrow<2>(d["lines"].cast<Int64s>(), "line");
  check_range<2>(file.lines.corners, n_points, "line");
  file.lines.tags = copy_of<std::int32_t>(d["line_tags"].cast<Int32s>());
  file.point_data = from_python_dict(d["point_data"].cast<py::dict>(), n_points, "point data");
  cells.data = from_python_dict(d["cell_data"].cast<py::dict>(), cells.size(), "cell data");
  file.lines.data = from_python_dict(d["line_data"].cast<py::dict>(), file.lines.size(), "line data");
  const auto vertex_cells = narrow<1>(d["marked_points"].cast<Int64s>(), "vertex cell");
  check_range<1>(vertex_cells, n_points, "vertex cell");
  for (const auto& [point] : vertex_cells) file.marked_points.corners.push_back(point);
  file.marked_points.tags = copy_of<std::int32_t>(d["point_tags"].cast<Int32s>());
  file.marked_points.data =
      from_python_dict(d["marked_point_data"].cast<py::dict>(), file.marked_points.size(), "data of vertex cells");
  file.names = physical_names_from(d["names"]);
  file.field_data = from_python_dict(d["field_data"].cast<py::dict>());
}

}  // namespace temper::python

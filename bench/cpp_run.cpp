// The C++ half of python_overhead.py: arrays in, a run, arrays out, timed without Python.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "temper/optimize.hpp"
#include "temper/solvers.hpp"
#ifdef TEMPER_WITH_TBB
#include "temper/detail/tbb_executor.hpp"
#endif

namespace py = pybind11;

namespace {

template <class T>
using Rows = py::array_t<T, py::array::c_style | py::array::forcecast>;

template <class Row, class T>
std::span<const Row> rows(const Rows<T>& array) {
  return {reinterpret_cast<const Row*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

template <class T, class Row>
py::array_t<T> array_of(const std::vector<Row>& rows, std::vector<py::ssize_t> shape) {
  return py::array_t<T>(std::move(shape), reinterpret_cast<const T*>(rows.data()));
}

py::tuple run(const Rows<double>& points, const Rows<std::int32_t>& triangles, int sweeps) {
  std::vector<temper::Vec2> places;
  std::vector<double> weights;
  std::vector<std::array<temper::VertexId, 3>> corners;
  const auto start = std::chrono::steady_clock::now();
  {
    const py::gil_scoped_release release;
    temper::OptimizeOptions options;
    options.max_sweeps = sweeps;
    options.repair = temper::Repair::none;
    temper::OptimizeHooks hooks;
    hooks.solvers = temper::solvers();
    temper::MeshInput input;
    input.points = rows<temper::Vec2>(points);
    input.triangles = rows<std::array<std::int32_t, 3>>(triangles);
#ifdef TEMPER_WITH_TBB
    temper::TbbExecutor threads;
    hooks.executor = input.executor = &threads;
#endif
    auto built = temper::Mesh::build(input);
    if (!built) throw std::runtime_error(built.error().what());
    temper::Mesh mesh = std::move(built->mesh);
    const auto report = temper::optimize(mesh, options, hooks);
    if (!report) throw std::runtime_error(report.error().what());
    places.reserve(mesh.n_vertices());
    weights.reserve(mesh.n_vertices());
    corners.reserve(mesh.n_triangles());
    for (const temper::VertexId v : mesh.vertices()) {
      places.push_back(mesh.position(v));
      weights.push_back(mesh.weight(v));
    }
    for (const temper::TriangleId t : mesh.triangles()) corners.push_back(mesh.corners(t));
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto n = static_cast<py::ssize_t>(places.size()), m = static_cast<py::ssize_t>(corners.size());
  return py::make_tuple(seconds, py::make_tuple(array_of<double>(places, {n, 2}), array_of<double>(weights, {n}),
                                                array_of<std::int32_t>(corners, {m, 3})));
}

}  // namespace

PYBIND11_MODULE(cpp_run, m) { m.def("run", run); }

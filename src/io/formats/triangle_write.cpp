// See triangle_read.cpp for the files.
#include <algorithm>
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "io/conversion/globe.hpp"
#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/formats/triangle.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

void declare(Output& out, std::string_view type, int components, std::string_view name) {
  out.put(kDeclaration, type, ' ', components, ' ', name, '\n');
}

/// Names and types of the arrays as comments; returns the number of columns.
std::size_t declare_all(Output& out, const std::vector<DataArray>& arrays) {
  std::size_t columns = 0;
  for (const DataArray& a : arrays) {
    declare(out, type_name(a.values), a.components, a.name);
    columns += static_cast<std::size_t>(a.components);
  }
  return columns;
}

void put_row(Output& out, const std::vector<DataArray>& arrays, std::size_t row) {
  for (const DataArray& a : arrays) {
    std::visit(
        [&](const auto& v) {
          const auto c = static_cast<std::size_t>(a.components);
          for (std::size_t k = 0; k < c; ++k) out.put(' ', v[row * c + k]);
        },
        a.values);
  }
}

/// Numbers of points, with a blank between two.
template <std::size_t N>
void put_corners(Output& out, const std::array<std::int32_t, N>& corners) {
  for (std::size_t k = 0; k < N; ++k) {
    if (k > 0) out.put(' ');
    out.put(corners[k] + 1);
  }
}

std::vector<DataArray> without(const std::vector<DataArray>& arrays, std::string_view name, const WriteJob& job) {
  std::vector<DataArray> result;
  for (const DataArray& a : arrays) {
    if (a.name == name)
      job.warn("data '", name, "' is not written: other data have this name");
    else
      result.push_back(a);
  }
  return result;
}

void write_node(const WriteJob& job, const std::string& base) {
  const MeshFile& f = job.file;
  Output& out = job.outputs.open(base + ".node");
  const auto markers = one_tag_a_point(job);
  const auto arrays = f.weights.empty() ? f.point_data : without(f.point_data, "weight", job);
  if (!f.weights.empty()) declare(out, "float64", 1, "weight");
  const std::size_t columns = declare_all(out, arrays) + (f.weights.empty() ? 0 : 1);
  const bool in_space = f.dimension() == 3;
  if (!in_space && !is_flat(f)) out.put(kDeclaredZ, f.z(), '\n');
  for (const PhysicalName& n : f.names) out.put(kDeclaredName, n.dimension, ' ', n.tag, ' ', n.name, '\n');
  const bool marked = !f.marked_points.empty();
  out.put(f.points.size(), in_space ? " 3 " : " 2 ", columns, ' ', marked ? 1 : 0, '\n');
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    out.put(i + 1, ' ', f.points[i].x, ' ', f.points[i].y);
    if (in_space) out.put(' ', job.place(i).z);
    if (!f.weights.empty()) out.put(' ', f.weights[i]);
    put_row(out, arrays, i);
    if (marked) out.put(' ', markers[i]);
    out.put('\n');
  }
}

template <int dimension>
void write_ele(const WriteJob& job, const std::string& base, const Cells<dimension>& elements) {
  const auto& [corners, regions, data] = elements;
  Output& out = job.outputs.open(base + ".ele");
  const auto arrays = regions.empty() ? data : without(data, "region", job);
  std::size_t columns = declare_all(out, arrays);
  if (!regions.empty()) {
    declare(out, "int32", 1, "region");
    ++columns;
  }
  out.put(elements.size(), ' ', dimension + 1, ' ', columns, '\n');
  for (std::size_t i = 0; i < elements.size(); ++i) {
    out.put(i + 1, ' ');
    put_corners(out, elements[i]);
    put_row(out, arrays, i);
    if (!regions.empty()) out.put(' ', regions[i]);
    out.put('\n');
  }
}

/// The file of tagged faces or edges of a mesh of TetGen. An old one would give its tags to this mesh, so it has to be
/// replaced. `kind`: of the elements, for the warning on those that the reader will not take for tagged.
template <int dimension>
void write_tagged(const WriteJob& job, const std::string& path, const Cells<dimension>& elements,
                  std::string_view kind) {
  const std::vector<std::int32_t>& tags = elements.tags;
  if (elements.empty() && !exists(path)) return;
  if (const auto n = std::count(tags.begin(), tags.end(), 0); n > 0)
    job.warn(n, " ", kind, n == 1 ? " has" : "s have", " tag 0, which is no tag in files of TetGen: nobody can read ",
             n == 1 ? "it" : "them", " again");
  Output& out = job.outputs.open(path);
  out.put(elements.size(), " 1\n");
  for (std::size_t i = 0; i < elements.size(); ++i) {
    out.put(i + 1, ' ');
    put_corners(out, elements[i]);
    out.put(' ', tags[i], '\n');
  }
}

void write_poly(const WriteJob& job, const std::string& base) {
  const MeshFile& f = job.file;
  // An old .poly would give its segments to this mesh, so it has to be replaced.
  if (f.lines.empty() && !exists(base + ".poly") && !exists(base + ".edge")) return;
  Output& out = job.outputs.open(base + ".poly");
  out.put("0 2 0 0\n", f.lines.size(), " 1\n");
  for (std::size_t i = 0; i < f.lines.size(); ++i) {
    out.put(i + 1, ' ', f.lines[i][0] + 1, ' ', f.lines[i][1] + 1, ' ', f.lines.tags[i], '\n');
  }
  out.put("0\n", "");
}

}  // namespace

void write_triangle(const WriteJob& job) {
  const std::string base = base_of_triangle(job.path);
  const MeshFile& f = job.file;
  write_node(job, base);
  if (f.dimension() == 2) {
    write_ele(job, base, f.triangles);
    return write_poly(job, base);
  }
  write_ele(job, base, f.tetrahedra);
  write_tagged(job, base + ".face", f.triangles, "face");
  write_tagged(job, base + ".edge", f.lines, "line");
}

}  // namespace temper::io

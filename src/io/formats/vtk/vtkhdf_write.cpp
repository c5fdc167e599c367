// Writes VTKHDF 1.0, which every VTK since 9.1 reads, of one piece. See vtkhdf_read.cpp.
#include <cstring>
#include <memory>

#include "io/containers/hdf5_file.hpp"
#include "io/formats/format.hpp"
#include "io/formats/vtk/vtk_arrays.hpp"
#include "io/formats/vtk/vtkhdf.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

/// In HDF5 a slash means a group within a group, and a point the group itself.
std::string hdf5_name(std::string_view name) {
  if (name.empty()) return "unnamed";
  std::string result;
  for (const char c : name) {
    if (c == '/' || name == ".") {
      append_percent(result, c);
    } else {
      result += c;
    }
  }
  return result;
}

VtkArray number_of(std::string name, std::size_t n) {
  return computed_vtk_array<std::int64_t>(std::move(name), Scalar::i64, 1,
                                          [n](std::size_t) { return static_cast<std::int64_t>(n); });
}

/// 64 bits per number, which all versions of VTK expect.
VtkArray vtkhdf_connectivity(const WriteJob& job) {
  const VtkArray narrow = vtk_connectivity(job);
  return {"Connectivity", Scalar::i64, 1, narrow.n_values, [narrow](std::size_t first, std::size_t n, char* to) {
            std::vector<std::int32_t> numbers(n);
            narrow.fill(first, n, reinterpret_cast<char*>(numbers.data()));
            for (std::size_t i = 0; i < n; ++i) {
              const std::int64_t wide = numbers[i];
              std::memcpy(to + i * sizeof wide, &wide, sizeof wide);
            }
          }};
}

VtkArray vtkhdf_offsets(const VtkCells& cells) {
  return computed_vtk_array<std::int64_t>("Offsets", Scalar::i64, cells.size() + 1, [cells](std::size_t i) {
    return static_cast<std::int64_t>(cells.points_of_first(i));
  });
}

void put_group(Hdf5Writer& out, const Hdf5Id& in, const char* name, const std::vector<VtkArray>& arrays) {
  const Hdf5Id group = out.group(in, name);
  TakenNames taken;
  for (const VtkArray& array : arrays) {
    const std::string written = taken.take(hdf5_name(array.name));
    const Hdf5Id dataset = out.dataset(group, written, array);
    if (written != array.name) out.attribute(dataset, kVtkhdfName, array.name);
  }
}

}  // namespace

std::vector<std::string> vtkhdf_files(const std::string& path) {
  static_cast<void>(hdf5_library(path));
  return {path};
}

void write_vtkhdf(const WriteJob& job) {
  const MeshFile& f = job.file;
  std::vector<VtkArray> point_data = vtk_point_data(job), cell_data = vtk_cell_data(job);
  const std::vector<VtkArray> field_data = vtk_field_data(f);
  if (job.triangle_quality) {
    for (VtkArray& array : vtk_quality(job)) cell_data.push_back(std::move(array));
  }
  Hdf5Writer out(job.path, point_data.size() + cell_data.size() + field_data.size());
  const Hdf5Id root = out.group(out.root(), std::string(kVtkhdfGroup));
  out.attribute(root, "Version", {1, 0});
  out.attribute(root, "Type", kVtkhdfType);
  VtkArray points = vtk_points(job), types = vtk_cell_types(job), connectivity = vtkhdf_connectivity(job);
  const std::size_t n_ids = connectivity.n_values;
  points.name = "Points";
  types.name = "Types";
  for (VtkArray array :
       {number_of("NumberOfPoints", f.points.size()), number_of("NumberOfCells", VtkCells(job).size()),
        number_of("NumberOfConnectivityIds", n_ids), points, connectivity, vtkhdf_offsets(VtkCells(job)), types}) {
    const std::string name = array.name;
    static_cast<void>(out.dataset(root, name, std::move(array)));
  }
  put_group(out, root, "PointData", point_data);
  put_group(out, root, "CellData", cell_data);
  put_group(out, root, "FieldData", field_data);
  out.finish(job.outputs.open(job.path));
}

}  // namespace temper::io

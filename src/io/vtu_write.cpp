// Writes VTU.
#include "io/triangle_quality.hpp"
#include "io/vtk_arrays.hpp"
#include "io/vtu_document.hpp"

namespace temper::io {

void write_vtu(const WriteJob& job) {
  const MeshFile& file = job.file;
  VtuDocument vtu(job.outputs.open(job.path), job.encoding.value_or(Encoding::base64), job.executor);
  vtu.fields(vtk_field_data(file));
  vtu.begin_piece(file.points.size(), n_vtk_cells(file));
  vtu.section("Points", {vtk_points(file)});
  const VtkArray ends = vtk_cell_ends(file.triangles.size(), file.lines.size(), file.marked_points.size());
  vtu.section("Cells", {vtk_connectivity(file), ends, vtk_cell_types(file)});
  vtu.section("PointData", vtk_point_data(job));
  std::vector<VtkArray> cell_data = vtk_cell_data(job);
  if (job.triangle_quality) {
    for (VtkArray& array : vtk_triangle_quality(job)) cell_data.push_back(std::move(array));
  }
  vtu.section("CellData", cell_data);
  vtu.finish();
}

}  // namespace temper::io

// The tables of reports on data that follow a changed mesh.
#include "temper/detail/report.hpp"

#include "temper/io.hpp"

namespace temper::io {
namespace {

ReportTable data_table(std::string_view name, std::array<std::string_view, 4> keys) {
  using R = DataReport;
  return report_table<R>(
      name, "The fate of the data of points and cells after the mesh has changed. All 0 without such data.",
      {{"points", "Points of the file that are still there", "", &R::points},
       {"points_moved", "Points among these that have moved", "", &R::points_moved},
       {"distance", "Distances that these have moved", "length", &R::distance},
       {"points_inserted", "New points that the file did not have", "", &R::points_inserted},
       {"interpolated", "Point data that belong to the place: linear in the cells of the file", "", &R::interpolated},
       {"kept", "Point data that stayed with their points", "", &R::kept},
       {"conserved", "Point data whose integrals stay: means over power cells", "", &R::conserved},
       {"dropped", "Integer point data that differ around an inserted point", "", &R::dropped},
       {keys[0], "Number of cells", "", &R::triangles},
       {keys[1], "Cells among these that the file does not have at the same number and places", "",
        &R::triangles_changed},
       {keys[2], "Data of cells: each cell has the data of the file's cell that contains its middle", "",
        &R::of_triangles},
       {keys[3], "Data of cells whose integrals stay: means over the file's cells", "", &R::conserved_of_triangles},
       {"integral_change",
        "Largest change of the integral of conserved data over the domain or a region, over the integral of |u| there",
        "", &R::integral_change},
       {"out_of_range",
        "Largest distance of conserved data from the range of the file's data, over the largest |u|; 0 unless the "
        "boundary moved",
        "", &R::out_of_range}});
}

}  // namespace

const ReportTable& table_of(const DataReport*) {
  static const ReportTable table =
      data_table("DataReport", {"triangles", "triangles_changed", "of_triangles", "conserved_of_triangles"});
  return table;
}

const ReportTable& table_for_tetrahedra(const DataReport*) {
  static const ReportTable table =
      data_table("TetDataReport", {"tetrahedra", "tetrahedra_changed", "of_tetrahedra", "conserved_of_tetrahedra"});
  return table;
}

}  // namespace temper::io

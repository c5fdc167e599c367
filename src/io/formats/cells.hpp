// Cells of the VTK family (VTU and legacy): sorted into tetrahedra, faces, lines and marked points, with their data.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/formats/format.hpp"

namespace temper::io {

// Numbers of the cell types, vtkCellType.h.
inline constexpr int kVtkEmptyCell = 0, kVtkVertex = 1, kVtkPolyVertex = 2, kVtkLine = 3, kVtkPolyLine = 4,
                     kVtkTriangle = 5, kVtkPolygon = 7, kVtkPixel = 8, kVtkQuad = 9, kVtkTetrahedron = 10,
                     kVtkPolyhedron = 42;
/// "quadrilateral", … : for messages.
[[nodiscard]] std::string_view vtk_cell_name(int type);
/// Field data of VTU: the periods of a plane along x and y.
inline constexpr std::string_view kPlanePeriod = "plane_period";

class CellSorter {
 public:
  /// Both must outlive the sorter.
  CellSorter(Document& document, AllocationLimits& allocation) : document_(document), allocation_(allocation) {}
  void reserve(std::size_t triangles) { document_.file.triangles.corners.reserve(triangles); }
  /// The next cell of the file. `where`: for errors.
  void add(int type, const std::int32_t* points, std::size_t n, const std::string& where);
  /// Hands cell data to tetrahedra, triangles, lines and marked points, and takes regions and tags out of them.
  void distribute(std::vector<DataArray>&& cell_data);
  [[nodiscard]] std::size_t n_cells() const { return n_cells_; }

 private:
  void take_tags();
  Document& document_;
  AllocationLimits& allocation_;
  std::size_t n_cells_ = 0;
  std::array<RunLength, 4> cells_of_;  // by dimension: which cell of the file each one was
};

/// Takes the regions or tags out of the arrays of triangles, lines or points, if they are there. `region` itself is
/// consumed; an array of another name also stays as data. Failure if a tag does not fit 32 bits.
[[nodiscard]] std::vector<std::int32_t> tags_of(std::vector<DataArray>& arrays, const std::string& path);

/// Physical names of the VTK family: lines "dimension tag name" in the bytes of the field array `physical_names`.
void take_physical_names(Document& document);

/// Periods of the VTK family, in the field array `plane_period`.
void take_period(Document& document);

/// Point data of the VTK family: the first `weight` becomes the weights.
void take_point_data(Document& document, std::vector<DataArray>&& arrays);

}  // namespace temper::io

// Grids of columns and rows: rasters of depths, heights or sizes. A raster becomes a mesh, with two triangles between
// four neighbors, so that everything that takes the data of a mesh takes a raster.
#pragma once

#include <vector>

#include "io/formats/format.hpp"

namespace temper::io {

struct Raster {
  std::vector<double> x, y;     ///< coordinates of columns and rows, each ascending or descending
  std::vector<DataArray> data;  ///< doubles, row after row; NaN: no value
  bool degrees = false;         ///< x and y are longitude and latitude
};

/// The mesh of a raster, or of the part within the window of the source. Points without any value are left out.
/// Longitudes move by whole turns to the window. Without a window, a raster around the globe is closed at its seam, and
/// a row at a pole is one point. If more than four million points remain, blocks of them become one point, their mean.
[[nodiscard]] Document mesh_of_raster(Raster raster, const Source& source);

}  // namespace temper::io

// The reader of UGRID, which is also that of all NetCDF and HDF5 files that no other one takes.
#pragma once

#include "io/formats/document.hpp"

namespace temper::io {

[[nodiscard]] Document read_ugrid(Source& source);

}  // namespace temper::io

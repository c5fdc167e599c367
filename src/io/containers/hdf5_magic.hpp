// The first bytes of HDF5 files (also of NetCDF-4), for code that includes the headers of neither.
#pragma once

#include <string_view>

namespace temper::io {

/// Checks the magic number; files with a user's block before it are not recognized.
[[nodiscard]] inline bool is_hdf5(std::string_view head) { return head.starts_with("\x89HDF\r\n\x1a\n"); }

}  // namespace temper::io

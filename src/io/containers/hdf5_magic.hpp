// How HDF5 files begin, NetCDF-4 among them: for who has the headers of neither.
#pragma once

#include <string_view>

namespace temper::io {

/// By the magic number; files with a block of the user's before it are not known.
[[nodiscard]] inline bool is_hdf5(std::string_view head) { return head.starts_with("\x89HDF\r\n\x1a\n"); }

}  // namespace temper::io

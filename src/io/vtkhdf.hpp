// Names in VTKHDF files that the reader looks for and the writer gives.
#pragma once

#include <string_view>

namespace temper::io {

inline constexpr std::string_view kVtkhdfGroup = "VTKHDF", kVtkhdfType = "UnstructuredGrid";
/// An attribute of temper's, of arrays whose own name HDF5 does not take.
inline constexpr const char* kVtkhdfName = "temper_name";

}  // namespace temper::io

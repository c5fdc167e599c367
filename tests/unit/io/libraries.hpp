// Says which libraries of others the tests of files expect: a library that was there when the tests were compiled, or
// that is found now.
#pragma once

#include "temper/io.hpp"

namespace temper::io {

inline bool expects_netcdf() { return TEMPER_NETCDF || !netcdf_version().empty(); }
inline bool expects_hdf5() { return TEMPER_HDF5 || !hdf5_version().empty(); }

}  // namespace temper::io

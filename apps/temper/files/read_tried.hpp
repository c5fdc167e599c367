// Reads a mesh file. One of HDF5 (NetCDF-4, VTKHDF) is first read in a child process: on a damaged file libhdf5 may
// loop for ever or crash, and then only the child does.
#pragma once

#include <string>

#include "temper/io.hpp"

namespace temper::app {

/// io::read(); Failure when the file cannot be used, or does not get through the child under its budget of time and
/// memory. What comes through a pipe can be read once only: it is read at once.
[[nodiscard]] io::MeshFile read_tried(const std::string& path, Executor* executor);

}  // namespace temper::app

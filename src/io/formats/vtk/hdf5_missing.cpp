// Replaces VTKHDF if the headers of HDF5 were missing when temper was built.
#include "io/containers/hdf5_magic.hpp"
#include "io/formats/format.hpp"
#include "io/formats/vtk/vtkhdf.hpp"

namespace temper::io {

bool sniff_vtkhdf(std::string_view head) { return is_hdf5(head) && head.find(kVtkhdfGroup) != std::string_view::npos; }
Document read_vtkhdf(Source& source) {
  fail(ErrorCode::unsupported, source.path, "is a VTKHDF file, and this temper was built without HDF5");
}
std::vector<std::string> vtkhdf_files(const std::string& path) {
  fail(ErrorCode::unsupported, path, "cannot be written: this temper was built without HDF5");
}
void write_vtkhdf(const WriteJob& job) { static_cast<void>(vtkhdf_files(job.path)); }

std::string hdf5_version() { return {}; }

}  // namespace temper::io

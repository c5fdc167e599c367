// Replaces NetCDF's formats if its headers were missing when temper was built.
#include "io/containers/hdf5_magic.hpp"
#include "io/conversion/bed.hpp"
#include "io/formats/format.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kMissing = "is a NetCDF file, and this temper was built without NetCDF";

}  // namespace

bool sniff_mpas(std::string_view) { return false; }
bool sniff_ugrid(std::string_view head) { return head.starts_with("CDF") || is_hdf5(head); }
Document read_mpas(Source& source) { fail(ErrorCode::unsupported, source.path, std::string(kMissing)); }
Document read_ugrid(Source& source) { fail(ErrorCode::unsupported, source.path, std::string(kMissing)); }
std::vector<std::string> netcdf_files(const std::string& path) {
  fail(ErrorCode::unsupported, path, "cannot be written: this temper was built without NetCDF");
}
void write_mpas(const WriteJob& job) { static_cast<void>(netcdf_files(job.path)); }
void write_ugrid(const WriteJob& job) { static_cast<void>(netcdf_files(job.path)); }

std::optional<std::string> netcdf_attribute(const MeshFile&, std::string_view, const char*) { return {}; }

std::string netcdf_version() { return {}; }

}  // namespace temper::io

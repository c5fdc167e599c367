// In place of NetCDF's formats where the library was not there when temper was built.
#include "io/format.hpp"

namespace temper::io {

namespace {

constexpr std::string_view kMissing = "is a NetCDF file, and this temper was built without NetCDF";

}  // namespace

bool sniff_mpas(std::string_view) { return false; }
bool sniff_ugrid(std::string_view head) { return head.starts_with("CDF") || head.starts_with("\x89HDF"); }
Document read_mpas(Source& source) { fail(ErrorCode::unsupported, source.path, std::string(kMissing)); }
Document read_ugrid(Source& source) { fail(ErrorCode::unsupported, source.path, std::string(kMissing)); }
void write_mpas(const WriteJob& job) {
  fail(ErrorCode::unsupported, job.path, "cannot be written: this temper was built without NetCDF");
}
void write_ugrid(const WriteJob& job) { write_mpas(job); }

}  // namespace temper::io

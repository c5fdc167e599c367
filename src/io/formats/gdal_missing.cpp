// Replaces geotiff.cpp and outline_gis.cpp where no library can be loaded (WebAssembly).
#include "io/formats/format.hpp"
#include "io/outlines/outline_input.hpp"
#include "temper/io.hpp"

namespace temper::io {

bool sniff_geotiff(std::string_view head) { return head.starts_with("II*") || head.starts_with("MM"); }
Document read_geotiff(Source& source) {
  fail(ErrorCode::unsupported, source.path, "is a TIFF, which this temper cannot read: it loads no libraries");
}
bool sniff_gis(std::string_view /*head*/) { return false; }
OutlineDocument read_gis(Source& source) {
  fail(ErrorCode::unsupported, source.path, "needs GDAL, and this temper loads no libraries");
}

std::string gdal_version() { return {}; }

}  // namespace temper::io

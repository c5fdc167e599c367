// Replaces geotiff.cpp where no library can be loaded (WebAssembly).
#include "io/formats/format.hpp"

namespace temper::io {

bool sniff_geotiff(std::string_view head) { return head.starts_with("II*") || head.starts_with("MM"); }
Document read_geotiff(Source& source) {
  fail(ErrorCode::unsupported, source.path, "is a TIFF, which this temper cannot read: it loads no libraries");
}

}  // namespace temper::io

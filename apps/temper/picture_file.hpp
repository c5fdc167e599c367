// Pictures as their files want them: SVG as it is drawn; PNG and PDF made of it by rsvg-convert, the program of
// librsvg.
#pragma once

#include <string>
#include <string_view>

namespace temper::app {

/// The suffixes of pictures that can be written: ".svg", ".png" and ".pdf". A path without a suffix is SVG.
[[nodiscard]] bool is_picture_name(const std::string& path);

/// The bytes of the picture in the format that the path's suffix names. PNG has two pixels for each of the SVG's.
/// Failure (bad input) when rsvg-convert is not there, or fails.
[[nodiscard]] std::string picture_bytes(const std::string& path, std::string_view svg);

}  // namespace temper::app

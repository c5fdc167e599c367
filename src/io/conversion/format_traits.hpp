// What conversion has to know of the format that a file came from. The rows of the registry say it.
#pragma once

#include "temper/io.hpp"

namespace temper::io {

struct FormatTraits {
  bool marks_boundary = false;   ///< each point of the boundary has a marker
  bool may_join_ends = false;    ///< triangles may join the ends of a mesh in longitude
  bool keeps_bed_names = false;  ///< the bed has a name of its own, which stays
};
/// The traits of the format of a file; all false for a file that was not read.
[[nodiscard]] const FormatTraits& traits_of(const MeshFile& file);

}  // namespace temper::io

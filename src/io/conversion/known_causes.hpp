// What is behind an error of the mesh, where the file shows it: meshes that are right where they come from, and that
// temper has no place for.
#pragma once

#include "temper/io.hpp"

namespace temper::io {

/// The error that a mesh of the file was refused with, in words of its format where the cause is known: sides of
/// ADCIRC's vertical element walls, and meshes of FESOM that are cyclic in longitude.
[[nodiscard]] InputError with_known_cause(InputError error, const MeshFile& file, const InputNames& names);

}  // namespace temper::io

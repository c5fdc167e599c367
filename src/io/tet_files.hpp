// A TetFile and the arrays that readers and writers have: tetrahedra, beside a mesh of their tagged faces.
#pragma once

#include "io/formats/format.hpp"
#include "temper/tets/io.hpp"

namespace temper::io {

/// The file of a document that has been checked.
[[nodiscard]] TetFile tet_file(Document&& document);

/// The faces, lines and points of a mesh of tetrahedra as a mesh of triangles, with x and y alone.
[[nodiscard]] MeshFile tags_of_file(const TetFile& file);

/// Fails unless the arrays of tetrahedra and faces fit the file; check_sizes() of the tags sees to the others.
void check_sizes(const std::string& path, const TetFile& file);

}  // namespace temper::io

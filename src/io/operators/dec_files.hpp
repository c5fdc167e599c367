// The writers behind write_dec: one source file for each format.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/disk/files.hpp"
#include "temper/detail/dec_io.hpp"

namespace temper::io {

/// The folder of one call.
struct DecFolder {
  const std::string& path;
  const DecWriteOptions& options;
  OutputSet& outputs;
  std::vector<std::string>& written;

  /// Opens a file of the folder.
  [[nodiscard]] Output& open(std::string_view name) const;
};

/// Places in the coordinates of the files: two in the plane, three on the sphere and in space. They refer to the mesh
/// or its operators.
struct DecPositions {
  std::size_t coordinates, size;
  std::function<Vec3(std::size_t)> at;  // z is 0 in the plane

  [[nodiscard]] double coordinate(std::size_t i, std::size_t k) const {
    const Vec3 p = at(i);
    return k == 0 ? p.x : k == 1 ? p.y : p.z;
  }
};
struct DecJob : DecFolder {
  const Mesh& mesh;
  const DecComplex& complex;
  const PowerCells& cells;
  const surfaces::SurfaceMesh* surface = nullptr;  ///< Has the places, if `mesh` is its connectivity

  /// The positions of vertices; on the sphere without weights.
  [[nodiscard]] DecPositions positions() const;
};

/// No vertex of it has a place.
struct IntrinsicDecJob : DecFolder {
  const surfaces::IntrinsicMesh& mesh;
  const DecComplex& complex;
};

struct TetDecJob : DecFolder {
  const tets::TetMesh& mesh;
  const tets::DecComplex& complex;
};

[[nodiscard]] DecPositions orthocenter_positions(const DecComplex& complex);
[[nodiscard]] DecPositions midpoint_positions(const DecComplex& complex);
[[nodiscard]] DecPositions corner_positions(const PowerCells& cells);
[[nodiscard]] DecPositions vertex_positions(const tets::TetMesh& mesh);
[[nodiscard]] DecPositions orthocenter_positions(const tets::DecComplex& complex);
[[nodiscard]] DecPositions midpoint_positions(const tets::DecComplex& complex);
[[nodiscard]] DecPositions face_orthocenter_positions(const tets::DecComplex& complex);

/// The operators of triangles or tetrahedra, each with what it is. They refer to the complex.
struct DecMatrices {
  struct Incidence {
    std::string_view name, is;
    const IncidenceMatrix& matrix;
  };
  struct Diagonal {
    std::string_view name, is;
    const std::vector<double>& values;
  };
  struct Places {
    std::string_view name, is;
    DecPositions at;
  };
  std::vector<Incidence> incidence;  ///< d0, d1, …
  std::vector<Diagonal> stars;       ///< ★0, ★1, …
  Diagonal transmissibility;
  std::vector<Places> places;
};
[[nodiscard]] DecMatrices matrices_of(const DecComplex& complex);
[[nodiscard]] DecMatrices matrices_of(const tets::DecComplex& complex);

void write_dec_mtx(const DecFolder& folder, const DecMatrices& matrices);
void write_dec_npz(const DecJob& job);
void write_dec_npz(const TetDecJob& job);
void write_dec_npz(const IntrinsicDecJob& job);
void write_dec_vtu(const DecJob& job);
void write_dec_vtu(const TetDecJob& job);
// Precondition of the functions below: the job has columns.
void write_columns_vtu(const DecJob& job);
void write_columns_disv(const DecJob& job);
void write_columns_disu(const DecJob& job);
/// The table of the cells of groups, with the number that the format has for each cell.
void write_groups(const DecJob& job, std::string_view file, const std::function<std::string(std::size_t)>& number);
/// The barriers, if there are any; `cell` is how the format writes a cell.
void write_barriers(const DecJob& job, std::string_view file, const std::function<std::string(std::size_t)>& cell);

}  // namespace temper::io

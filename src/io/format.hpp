// What a format is to the rest of io: one row of the table in registry.cpp and the functions of one source file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input.hpp"
#include "io/output.hpp"
#include "temper/io.hpp"

namespace temper::io {

struct WriteJob;
using ArraysOf = std::vector<DataArray> MeshFile::*;

/// The parts of a mesh file beyond points and triangles, which not every format has a place for.
enum Content : unsigned {
  kWeights = 1u << 0,
  kRegions = 1u << 1,
  kLines = 1u << 2,
  kMarkedPoints = 1u << 3,
  kNames = 1u << 4,
  kPointData = 1u << 5,
  kCellData = 1u << 6,
  kLineData = 1u << 7,
  kMarkedPointData = 1u << 8,
  kFieldData = 1u << 9,
};
using Contents = unsigned;
inline constexpr Contents kNothing = 0;

struct FormatRow {
  std::string_view name, description, suffixes;  ///< as in Format
  Contents holds;                                ///< what a file has beyond it is named in a warning
  bool (*sniff)(std::string_view head);          ///< from the first kSniffBytes of the file
  Document (*read)(Source& source);
  void (*write)(const WriteJob& job);  ///< null: read only
  /// Of arrays that are not in `holds`: whether this one has a place nevertheless. Null: none has.
  bool (*keeps)(ArraysOf of, const DataArray& array) = nullptr;
  std::vector<std::string> (*files)(const std::string& path) = nullptr;  ///< that are written; null: path alone
  std::int64_t first_point = 1;                                          ///< the number of the first point in a file
};
inline constexpr std::size_t kSniffBytes = 4096;

/// One file to be written.
struct WriteJob {
  const std::string& path;
  const MeshFile& file;
  const FormatRow& row;
  std::optional<Encoding> encoding;
  Executor* executor;
  OutputSet& outputs;
  std::vector<std::string>& warnings;

  void warn(std::string message) const { warnings.push_back(text(path, ": ", message)); }
};

/// Warns of all that the file has and the row does not hold, but the weights, which go to the side file.
void warn_of_losses(const WriteJob& job);
/// Warns of arrays or names that a writer found no place for.
void warn_of_arrays(const WriteJob& job, std::string_view kind, const std::vector<std::string_view>& names);
void warn_of_names(const WriteJob& job, const std::vector<PhysicalName>& lost);
/// The tag of each point, 0 where there is none, for formats that hold one: further tags are named in a warning.
[[nodiscard]] std::vector<std::int32_t> one_tag_a_point(const WriteJob& job);
/// Whether the plane of the mesh is z = 0.
[[nodiscard]] bool is_flat(const MeshFile& file);

/// The name of a format that is recognised but not read, or empty.
[[nodiscard]] std::string_view recognise_unsupported(std::string_view head);

bool sniff_vtu(std::string_view head);
bool sniff_gmsh22(std::string_view head);
bool sniff_gmsh41(std::string_view head);
bool sniff_medit(std::string_view head);
bool sniff_triangle(std::string_view head);
bool sniff_obj(std::string_view head);
bool sniff_legacy_vtk(std::string_view head);
bool sniff_vtk51(std::string_view head);
bool sniff_jigsaw(std::string_view head);
bool sniff_off(std::string_view head);
bool sniff_ply(std::string_view head);
bool sniff_adcirc(std::string_view head);
bool sniff_mpas(std::string_view head);
bool sniff_ugrid(std::string_view head);
bool sniff_mfem(std::string_view head);

Document read_vtu(Source& source);
Document read_gmsh(Source& source);
Document read_medit(Source& source);
Document read_triangle(Source& source);
Document read_obj(Source& source);
Document read_legacy_vtk(Source& source);
Document read_jigsaw_mesh(Source& source);
Document read_off(Source& source);
Document read_ply(Source& source);
Document read_adcirc(Source& source);
Document read_mpas(Source& source);
Document read_ugrid(Source& source);
Document read_mfem(Source& source);

void write_vtu(const WriteJob& job);
void write_gmsh22(const WriteJob& job);
void write_gmsh41(const WriteJob& job);
void write_medit(const WriteJob& job);
void write_triangle(const WriteJob& job);
void write_obj(const WriteJob& job);
void write_legacy_vtk(const WriteJob& job);
void write_vtk51(const WriteJob& job);
void write_jigsaw_mesh(const WriteJob& job);
void write_off(const WriteJob& job);
void write_ply(const WriteJob& job);
void write_adcirc(const WriteJob& job);
void write_mpas(const WriteJob& job);
void write_ugrid(const WriteJob& job);

bool adcirc_keeps(ArraysOf of, const DataArray& array);
bool jigsaw_keeps(ArraysOf of, const DataArray& array);
bool medit_keeps(ArraysOf of, const DataArray& array);
std::vector<std::string> triangle_files(const std::string& path);

// --- weights of formats without a place for them ---------------------------------------------------
/// PATH.weights.csv
[[nodiscard]] std::string side_file_path(const std::string& path);
/// Takes the weights from the side file when it is there and the file itself gives none.
void read_side_file(Document& document);
/// Writes the side file when there are weights, or one is there.
void write_side_file(const WriteJob& job);

}  // namespace temper::io

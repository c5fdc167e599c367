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

/// One file to be written.
struct WriteJob {
  const std::string& path;
  const MeshFile& file;
  std::optional<Encoding> encoding;
  Executor* executor;
  OutputSet& outputs;
  std::vector<std::string>& warnings;

  void warn(std::string message) const { warnings.push_back(text(path, ": ", message)); }
};

/// Warns of everything in the lists that the format has no place for.
void warn_of_data(const WriteJob& job, std::string_view format, std::string_view kind,
                  const std::vector<DataArray>& arrays);
void warn_of_names(const WriteJob& job, std::string_view format);
/// Warns of regions that are lost; of regions, lines and marked points.
void warn_of_regions(const WriteJob& job, std::string_view format);
void warn_of_tags(const WriteJob& job, std::string_view format);
/// The tag of each point, 0 where there is none, for formats that hold one: further tags are named in a warning.
[[nodiscard]] std::vector<std::int32_t> one_tag_a_point(const WriteJob& job, std::string_view format);
/// Whether the plane of the mesh is z = 0.
[[nodiscard]] bool is_flat(const MeshFile& file);

struct FormatRow {
  Format format;
  bool (*sniff)(std::string_view head);  ///< from the first kSniffBytes of the file
  Document (*read)(Source& source);
  void (*write)(const WriteJob& job);  ///< null: read only
};
inline constexpr std::size_t kSniffBytes = 4096;

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

// --- weights of formats without a place for them ---------------------------------------------------
/// PATH.weights.csv
[[nodiscard]] std::string side_file_path(const std::string& path);
/// Takes the weights from the side file when it is there and the file itself gives none.
void read_side_file(Document& document);
/// Writes the side file when there are weights; points are numbered from `first`.
void write_side_file(const WriteJob& job, std::int64_t first);

}  // namespace temper::io

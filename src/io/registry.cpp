// The table of formats, and the two entry points of io: read and write.
//
// A new format is one source file with a sniff, a read and maybe a write, declared here, and one row of the table.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "io/conversion/bed.hpp"
#include "io/conversion/globe.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/conversion/update.hpp"
#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/operators/cell_files.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/suggest.hpp"

namespace temper::io {

// Each is defined in the source file of its format.
using Sniff = bool(std::string_view head);
using Read = Document(Source& source);
using Write = void(const WriteJob& job);
using Keeps = bool(Content of, const DataArray& array);
using Files = std::vector<std::string>(const std::string& path);

Sniff sniff_vtu, sniff_gmsh22, sniff_gmsh41, sniff_medit, sniff_triangle, sniff_obj, sniff_legacy_vtk, sniff_vtk51,
    sniff_jigsaw, sniff_off, sniff_ply, sniff_adcirc, sniff_vtkhdf, sniff_mpas, sniff_ugrid, sniff_mfem, sniff_fesom,
    sniff_2dm, sniff_esri_ascii, sniff_geotiff, sniff_mike, sniff_avs, sniff_selafin, sniff_stl;
Read read_vtu, read_gmsh, read_medit, read_triangle, read_obj, read_legacy_vtk, read_jigsaw_mesh, read_off, read_ply,
    read_adcirc, read_vtkhdf, read_mpas, read_mfem, read_fesom, read_2dm, read_esri_ascii, read_geotiff, read_mike,
    read_avs, read_selafin, read_stl;
Write write_vtu, write_gmsh22, write_gmsh41, write_medit, write_triangle, write_obj, write_legacy_vtk, write_vtk51,
    write_jigsaw_mesh, write_off, write_ply, write_adcirc, write_vtkhdf, write_mpas, write_ugrid, write_fesom,
    write_2dm, write_mike, write_selafin;
Keeps fesom_keeps, adcirc_keeps, jigsaw_keeps, medit_keeps, mike_keeps, selafin_keeps;
Files fesom_files, selafin_files, triangle_files, triangle_files_to_read, vtkhdf_files;

namespace {

// If two rows recognize a file, or have its suffix, temper takes the first.
constexpr FormatRow kRows[] = {
    // clang-format off
    // name, description, suffixes, what a file holds,
    // functions that recognize, read and write it, details
    {"vtu", "VTK XML unstructured grid, temper's own", ".vtu", kAll | kSphere | kPeriod | kQuadrilaterals | kTetrahedra,
     sniff_vtu, read_vtu, write_vtu},
    {"gmsh41", "Gmsh MSH 4.1", ".msh .msh4", (kAll & ~kFieldData) | kSphere | kQuadrilaterals | kTetrahedra,
     sniff_gmsh41, read_gmsh, write_gmsh41, {.name_ends = "\""}},
    {"gmsh22", "Gmsh MSH 2.2", ".msh2", (kAll & ~kFieldData) | kSphere | kQuadrilaterals | kTetrahedra,
     sniff_gmsh22, read_gmsh, write_gmsh22, {.name_ends = "\""}},
    {"medit", "medit (INRIA, Mmg)", ".mesh", kInSpace | kAllTags | kTetrahedra,
     sniff_medit, read_medit, write_medit, {.keeps = medit_keeps, .traits = {.marks_boundary = true}}},
    {"jigsaw", "JIGSAW mesh", ".jigsaw.msh", kInSpace | kWeights | kAllTags,
     sniff_jigsaw, read_jigsaw_mesh, write_jigsaw_mesh, {.keeps = jigsaw_keeps, .may_be_outline = true}},
    {"ply", "PLY", ".ply", (kAll & ~(kMarkedPointData | kFieldData)) | kSphere,
     sniff_ply, read_ply, write_ply},
    {"off", "OFF", ".off", kInSpace,
     sniff_off, read_off, write_off, {.first_point = 0}},
    {"mike", "mesh of MIKE 21", ".mike.mesh", kZ | kLines | kMarkedPoints | kNames | kQuadrilaterals,
     sniff_mike, read_mike, write_mike, {.keeps = mike_keeps, .bed = Bed::z, .has_heights = true}},
    {"avs", "AVS UCD (LaGriT)", ".inp .avs", 0,
     sniff_avs, read_avs},
    // This row is before the formats whose first word may also be the first word of a title. It holds only those tags
    // and names that are boundaries; its writer names the others.
    {"adcirc", "ADCIRC fort.14", ".14 .grd .gr3", kLines | kMarkedPoints | kNames | kSphere | kQuadrilaterals,
     sniff_adcirc, read_adcirc, write_adcirc, {.keeps = adcirc_keeps, .degrees = Degrees::where_known, .bed = Bed::depth}},
    {"2dm", "2DM of SMS", ".2dm", kZ | kRegions | kLines | kNames | kQuadrilaterals,
     sniff_2dm, read_2dm, write_2dm,
     {.name_ends = "\"", .bed = Bed::z, .has_heights = true}},
    {"stl", "STL", ".stl", 0,
     sniff_stl, read_stl},
    {"obj", "Wavefront OBJ", ".obj", kInSpace | kAllTags | kNames,
     sniff_obj, read_obj, write_obj},
    {"vtk", "legacy VTK 2.0 to 4.2", ".vtk", kAll | kSphere | kQuadrilaterals | kTetrahedra,
     sniff_legacy_vtk, read_legacy_vtk, write_legacy_vtk},
    {"vtk51", "legacy VTK 5.1", ".vtk51", kAll | kSphere | kQuadrilaterals | kTetrahedra,
     sniff_vtk51, read_legacy_vtk, write_vtk51},
    {"selafin", "Selafin of TELEMAC", ".slf .sel .ser .srf", kLines | kMarkedPoints | kNames,
     sniff_selafin, read_selafin, write_selafin,
     {.keeps = selafin_keeps, .files_to_write = selafin_files, .files_to_read = selafin_files, .bed = Bed::z}},
    {"mfem", "MFEM mesh v1.0", ".mesh", 0,
     sniff_mfem, read_mfem},
    {"esri", "ESRI ASCII grid", ".asc", 0,
     sniff_esri_ascii, read_esri_ascii},
    {"geotiff", "GeoTIFF", ".tif .tiff", 0,
     sniff_geotiff, read_geotiff},
    {"fesom", "FESOM nod2d.out and elem2d.out", ".nod2d.out .elem2d.out nod2d.out elem2d.out", kSphere,
     sniff_fesom, read_fesom, write_fesom,
     {.keeps = fesom_keeps, .files_to_write = fesom_files, .files_to_read = fesom_files, .degrees = Degrees::always,
      .bed = Bed::depth, .traits = {.may_join_ends = true}}},
    {"triangle", "Triangle", ".node .ele",
     (kAll & ~(kLineData | kMarkedPointData | kFieldData)) | kTetrahedra,
     sniff_triangle, read_triangle, write_triangle,
     {.files_to_write = triangle_files, .files_to_read = triangle_files_to_read,
      .traits = {.marks_boundary = true}}},
    // This row is before the rows of NetCDF, which may be HDF5: it hands files of other contents on to them.
    {"vtkhdf", "VTKHDF unstructured grid (HDF5)", ".vtkhdf .hdf .hdf5",
     kAll | kSphere | kPeriod | kQuadrilaterals | kTetrahedra,
     sniff_vtkhdf, read_vtkhdf, write_vtkhdf, {.files_to_write = vtkhdf_files}},
    {"mpas", "MPAS mesh (NetCDF)", ".mpas.nc", kAll | kSphere | kPeriod,
     sniff_mpas, read_mpas, write_mpas, {.files_to_write = netcdf_files, .degrees = Degrees::by_writer, .traits = {.keeps_bed_names = true}}},
    {"ugrid", "UGRID (NetCDF)", ".ugrid.nc .nc", kAll | kSphere | kQuadrilaterals,
     sniff_ugrid, read_ugrid, write_ugrid,
     {.files_to_write = netcdf_files, .degrees = Degrees::by_writer, .bed = Bed::level,
      .joins_halves = true, .traits = {.keeps_bed_names = true}}},
    {"ncgrid", "grid of CF or COARDS (NetCDF)", ".nc .grd", 0,
     sniff_ugrid, read_ugrid},
    // clang-format on
};

template <std::size_t... I>
constexpr std::array<Format, sizeof...(I)> columns(std::index_sequence<I...>) {
  return {Format{kRows[I].name, kRows[I].description, kRows[I].suffixes, kRows[I].write != nullptr,
                 (kRows[I].holds & kWeights) != 0, kRows[I].details.degrees != Degrees::always,
                 (kRows[I].holds & kSphere) != 0, (kRows[I].holds & kTetrahedra) != 0, kRows[I].is_in_space()}...};
}
// Not constexpr: GCC with sanitizers does not take the address of a function for a constant.
const auto kFormats = columns(std::make_index_sequence<std::size(kRows)>());

/// The row of the format that begins this way, or null.
const FormatRow* row_of(std::string_view head) {
  const auto* row =
      std::find_if(std::begin(kRows), std::end(kRows), [&](const FormatRow& each) { return each.sniff(head); });
  return row == std::end(kRows) ? nullptr : row;
}

/// `bytes`: of the whole file.
const FormatRow& recognize(const std::string& path, std::string_view beginning, std::uint64_t bytes) {
  if (const FormatRow* const row = row_of(beginning.substr(0, kSniffBytes))) return *row;
  if (is_binary_stl(beginning, bytes)) return *find_row("stl");
  if (const std::string known = recognize_unsupported(beginning); !known.empty())
    fail(ErrorCode::unsupported, path, "is ", known);
  if (io::suffix_length(".stl", path, true) > 0) {
    if (const std::string fault = fault_of_stl(beginning, bytes); !fault.empty()) fail(ErrorCode::syntax, path, fault);
  }
  std::string names;
  for (const Format& format : kFormats) names += text(names.empty() ? "" : ", ", format.description);
  fail(ErrorCode::syntax, path, "is none of the formats that temper reads: ", names);
}

/// Makes the names of all arrays of a kind distinct, without characters that a terminal or a text file would interpret.
void tidy_names(MeshFile& file) {
  make_names_plain(file);
  for (auto* arrays : all_data(file)) make_names_unique(*arrays);
}

/// A file with a hundred thousand sections that temper drops needs no warning for each.
void tidy_warnings(MeshFile& file) {
  constexpr std::size_t kMost = 20;
  const std::size_t n = file.warnings.size();
  if (n <= kMost) return;
  file.warnings.resize(kMost - 1);
  file.warnings.push_back(text(file.path, ": ", n - kMost + 1, " more warnings like these"));
}

/// The arrays of a file, not yet checked.
Document read_document(const std::string& path, const ReadOptions& options) {
  const FormatRow* row = nullptr;
  Source source =
      load(path, [&](std::string_view beginning, std::uint64_t bytes) { row = &recognize(path, beginning, bytes); });
  source.executor = options.executor;
  source.window = options.window;
  source.raster_in_degrees = options.raster_in_degrees;
  Document document = row->read(source);
  std::string().swap(source.bytes);
  if (document.file.format.empty()) document.file.format = row->name;
  return document;
}

/// Letters may be large, unless the format has several files, whose names belong together.
std::size_t suffix_length(const FormatRow& row, const std::string& path) {
  return io::suffix_length(row.suffixes, path, row.details.files_to_read == nullptr);
}

/// One column of the rows that are written and hold these contents.
std::vector<std::string_view> of_written(std::string_view FormatRow::*column, Contents contents = 0) {
  std::vector<std::string_view> all;
  for (const FormatRow& row : kRows) {
    if (row.write != nullptr && (row.holds & contents) == contents) all.push_back(row.*column);
  }
  return all;
}

std::string names_with(Contents contents) { return join(of_written(&FormatRow::name, contents)); }

const FormatRow& row_to_write(const std::string& path, const std::string& format) {
  if (!format.empty()) {
    const FormatRow* row = find_row(format);
    if (row != nullptr && row->write != nullptr) return *row;
    const std::vector<std::string_view> names = of_written(&FormatRow::name);
    fail(ErrorCode::invalid_option, path, "cannot be written as '", format, "'; expected one of ", join(names),
         did_you_mean(format, names));
  }
  // .jigsaw.msh is a better match than .msh; the first of equals wins.
  const FormatRow* best = nullptr;
  std::size_t longest = 0;
  for (const FormatRow& row : kRows) {
    const std::size_t length = row.write == nullptr ? 0 : suffix_length(row, path);
    if (length <= longest) continue;
    longest = length;
    best = &row;
  }
  if (best != nullptr) return *best;
  fail(ErrorCode::invalid_option, path, "the suffix names no format that temper writes; expected one of ",
       join(of_written(&FormatRow::suffixes), " "), ", or a format", next_for_cells(path));
}

/// What messages call the cells of one dimension.
struct NamesOfCells {
  std::string_view one, several, tags, data;
};

}  // namespace

void check_sizes(const std::string& path, const MeshFile& f) {
  const auto insist = [&](bool good, std::string_view what) {
    if (!good) fail(ErrorCode::size_mismatch, path, "the mesh to be written has ", what);
  };
  const auto check_data = [&](const std::vector<DataArray>& arrays, std::size_t n, std::string_view kind) {
    for (const DataArray& a : arrays)
      insist(a.components >= 1 && size(a.values) == n * static_cast<std::size_t>(a.components),
             text(kind, " ", in_quotes(a.name), " with ", size(a.values), " values, expected ", n, " times ",
                  a.components));
  };
  const std::size_t n = f.points.size();
  const auto in_range = [n](std::int32_t p) { return p >= 0 && static_cast<std::size_t>(p) < n; };
  insist(f.sphere() == nullptr || f.sphere()->places.size() == n,
         "another number of places on the sphere than of points");
  insist(f.tetrahedra.empty() != (f.in_space() != nullptr && f.dimension() == 3),
         "tetrahedra without points in space, or such points alone");
  insist(f.in_space() == nullptr || f.in_space()->heights.size() == n, "another number of heights than of points");
  insist(f.weights.empty() || f.weights.size() == n, "another number of weights than of points");
  check_data(f.point_data, n, "point data");
  const auto check_cells = [&](const auto& cells, const NamesOfCells& names, bool may_be_untagged) {
    insist(cells.tags.size() == cells.size() || (may_be_untagged && cells.tags.empty()),
           text("another number of ", names.tags, " than of ", names.several));
    check_data(cells.data, cells.size(), names.data);
    const auto has_vertices = [&](const auto& cell) { return std::ranges::all_of(corners_of(cell), in_range); };
    insist(std::ranges::all_of(cells, has_vertices), text(names.one, " that is none"));
  };
  const bool tets = f.dimension() == 3;
  check_cells(f.tetrahedra, {"a tetrahedron with a vertex", "tetrahedra", "regions", "cell data"}, true);
  check_cells(f.triangles,
              tets ? NamesOfCells{"a triangle with a vertex", "faces", "face tags", "face data"}
                   : NamesOfCells{"a triangle with a vertex", "triangles", "regions", "cell data"},
              !tets);
  check_cells(f.lines, {"a line with a vertex", "lines", "line tags", "line data"}, false);
  check_cells(f.marked_points, {"a marked point", "marked points", "point tags", "data of marked points"}, false);
}

std::span<const Format> formats() { return kFormats; }

const FormatRow* find_row(std::string_view name) {
  const auto* row =
      std::find_if(std::begin(kRows), std::end(kRows), [&](const FormatRow& each) { return each.name == name; });
  return row == std::end(kRows) ? nullptr : row;
}

const FormatDetails& details_of(const MeshFile& file) {
  static constexpr FormatDetails kNone;
  const FormatRow* const row = find_row(file.format);
  return row == nullptr ? kNone : row->details;
}

const FormatTraits& traits_of(const MeshFile& file) { return details_of(file).traits; }

Expected<MeshFile> read(const std::string& path, const ReadOptions& options) {
  return guarded<MeshFile>(path, [&] {
    Document document = read_document(path, options);
    MeshFile& file = document.file;
    file.path = path;
    check(document, options);
    file.numbering = document.names;
    read_side_file(document);
    read_corner_file(document);
    drop_zero_weights(file);
    tidy_names(file);
    tidy_warnings(file);
    constexpr std::size_t kLarge = std::size_t{1} << 20;  // below it does not count, and reading is fast
    if (file.points.size() + file.triangles.size() + file.tetrahedra.size() > kLarge) give_memory_back();
    return std::move(file);
  });
}

namespace {

bool goes_back_to_degrees(const FormatRow& row, const MeshFile& file) {
  if (row.details.degrees == Degrees::by_writer) return false;
  return file.map() != nullptr || (row.details.degrees == Degrees::where_known && lon_lat_of_points(file));
}

/// A file with degrees alone has the earth's radius.
bool is_resized(const FormatRow& row, const MeshFile& file) {
  const bool degrees_alone = row.details.degrees == Degrees::always || row.details.degrees == Degrees::where_known;
  return degrees_alone && file.sphere() != nullptr && file.sphere()->radius != Projection{}.radius;
}

/// Warns that weights are squared lengths on the map, even if the points next to them are degrees.
void warn_of_weights_beside_degrees(const WriteJob& job, const MeshFile& on_map) {
  if (!is_weighted(on_map)) return;
  const std::string map = on_map.map() != nullptr
                              ? text(" on the map ", projection_text(on_map.map()->projection),
                                     ", in meters: give this projection where the file is read again")
                              : std::string(" of the plane that the mesh was in");
  job.warn("points are longitude and latitude, but weights are squared lengths", map);
}

/// Refuses a mesh that the format has no place for, by its dimension or its space.
void expect_place(const FormatRow& row, const std::string& path, const MeshFile& file) {
  if (file.dimension() == 3) {
    if ((row.holds & kTetrahedra) != 0) return;
    fail(ErrorCode::unsupported, path, row.description, " is not written with tetrahedra; expected one of ",
         names_with(kTetrahedra));
  }
  if (file.is_surface() && !row.is_in_space()) {
    std::vector<std::string_view> names;
    for (const FormatRow& each : kRows) {
      if (each.write != nullptr && each.is_in_space()) names.push_back(each.name);
    }
    fail(ErrorCode::unsupported, path, row.description, " is not written with a curved surface; expected one of ",
         join(names));
  }
  if (file.sphere() != nullptr && (row.holds & kSphere) == 0) {
    fail(ErrorCode::unsupported, path, "points are on a sphere, which ", row.description,
         " is not written with; expected one of ", names_with(kSphere));
  }
  if (file.periodic() != nullptr && (row.holds & kPeriod) == 0) {
    fail(ErrorCode::unsupported, path, "the plane is periodic, which ", row.description,
         " has no place for; expected one of ", names_with(kPeriod));
  }
  if (row.details.degrees == Degrees::always && file.sphere() == nullptr && !goes_back_to_degrees(row, file) &&
      file.degrees() == nullptr) {
    fail(ErrorCode::unsupported, path, row.description,
         " has points in longitude and latitude; expected a mesh of the sphere, or one that was read in degrees");
  }
}

/// The file as a format has it: in degrees, on the earth, with the bed and z in their places. The heights are taken out
/// of its data.
struct FileInFormat {
  std::optional<MeshFile> changed;
  std::vector<double> heights;
  std::vector<std::int32_t> fourth_corners;
};
FileInFormat file_in_format(const FormatRow& row, const MeshFile& file) {
  FileInFormat result;
  const auto change = [&]() -> MeshFile& { return result.changed ? *result.changed : result.changed.emplace(file); };
  if (goes_back_to_degrees(row, file)) result.changed = in_degrees(file);
  if (is_resized(row, file)) resize_sphere(change(), Projection{}.radius);
  if (!file.weights.empty() && !is_weighted(file)) change().weights.clear();
  const bool stays = file.positive && file.format == row.name;  // a sign that the format does not tell comes back
  if (!stays && needs_turned_bed(row.details.bed, file)) turn_bed(change(), row.details.bed);
  const MeshFile& now = result.changed ? *result.changed : file;
  const bool has_place = row.details.has_heights || (row.is_in_space() && file.sphere() == nullptr);
  const DataArray* const heights = now.z_is_data && has_place ? find(now.point_data, kHeight) : nullptr;
  if (heights != nullptr && is_finite(heights->values))  // a missing height stays a number of data
    result.heights = to_doubles(std::move(take(change().point_data, kHeight)->values));
  if ((row.holds & kQuadrilaterals) == 0 || row.details.joins_halves || file.dimension() == 3) return result;
  if (const auto quadrilaterals = quadrilaterals_of(file); !quadrilaterals.empty())
    result.fourth_corners = join_quadrilaterals(change(), quadrilaterals);
  return result;
}

}  // namespace

Expected<std::vector<std::string>> write(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  if (options.cells) return write_cells(path, file, options);
  return guarded<std::vector<std::string>>(path, [&] {
    const FormatRow& row = row_to_write(path, options.format);
    if (file.dimension() == 3) expect_place(row, path, file);
    if (row.details.files_to_write != nullptr && row.details.files_to_write(path).size() > 1 && is_stream(path)) {
      fail(ErrorCode::not_writable, path, row.description,
           " is several files; expected the name of a file, found a stream");
    }
    check_sizes(path, file);
    check_names(path, file);
    expect_place(row, path, file);
    std::vector<std::string> warnings;
    OutputSet outputs;
    FileInFormat written = file_in_format(row, file);
    const WriteJob job = {path,
                          written.changed ? *written.changed : file,
                          file,
                          row,
                          options.encoding,
                          options.triangle_quality,
                          options.executor,
                          outputs,
                          warnings,
                          std::move(written.heights),
                          std::move(written.fourth_corners)};
    if (goes_back_to_degrees(row, file)) warn_of_weights_beside_degrees(job, file);
    if (is_resized(row, file)) {
      job.warn("the radius is ", Projection{}.radius, " in ", row.description, ", not ", file.sphere()->radius,
               "; weights are scaled along");
    }
    row.write(job);
    warn_of_losses(job);
    if ((row.holds & kWeights) == 0) write_side_file(job);
    if ((row.holds & kCellData) == 0) write_corner_file(job);
    outputs.commit();
    return warnings;
  });
}

std::vector<std::string> files_to_read(const std::string& path) {
  if (is_stream(path) || !exists(path)) return {path};
  const FormatRow* const row = row_of(first_bytes(path, kSniffBytes));
  std::vector<std::string> files;
  if (row != nullptr && row->details.files_to_read != nullptr) files = row->details.files_to_read(path);
  if (std::find(files.begin(), files.end(), path) == files.end()) files.insert(files.begin(), path);
  files.push_back(side_file_path(files.front()));
  files.push_back(corner_file_path(files.front()));
  std::erase_if(files, [](const std::string& file) { return !exists(file); });
  return files;
}

Expected<std::vector<std::string>> files_to_write(const std::string& path, const std::string& format,
                                                  const MeshFile* file, std::optional<CellsOf> cells) {
  return guarded<std::vector<std::string>>(path, [&] {
    if (cells) return files_of_cells(path, format);
    const FormatRow& row = row_to_write(path, format);
    if (file != nullptr) expect_place(row, path, *file);
    std::vector<std::string> files =
        row.details.files_to_write == nullptr ? std::vector<std::string>{path} : row.details.files_to_write(path);
    if ((row.holds & kWeights) == 0 && !is_stream(path)) files.push_back(side_file_path(path));
    const bool beside = (row.holds & kCellData) == 0 && !is_stream(path);
    if (beside && ((file != nullptr && has_corner_weights(*file)) || exists(corner_file_path(path))))
      files.push_back(corner_file_path(path));
    return files;
  });
}

Expected<void> write_text(const std::string& path, std::string_view content) {
  return guarded<void>(path, [&] {
    OutputSet outputs;
    outputs.open(path).put(content);
    outputs.commit();
  });
}

}  // namespace temper::io

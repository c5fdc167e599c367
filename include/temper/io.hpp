// Mesh files. The content of a file decides its format, each format has one source file, and all data pass through.
//
// A MeshFile holds the content of a file in neutral arrays: points, weights, names, and cells of dimension 0 to 3 with
// tags and data. make_mesh() and make_tet_mesh() build the mesh from it. Errors use the file's own numbers and lines.
// update() puts an optimized mesh back, so that everything else in the file is written again.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "temper/detail/cells.hpp"
#include "temper/detail/error.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/outline.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesh.hpp"
#include "temper/surfaces.hpp"
#include "temper/tets/mesh.hpp"

namespace temper {
struct OutlineMesh;
}

namespace temper::io {

/// Numbers of one type. A file is written with the types that it was read with.
using Values =
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::int64_t>, std::vector<std::int32_t>,
                 std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::int16_t>,
                 std::vector<std::uint16_t>, std::vector<std::uint32_t>, std::vector<std::uint64_t>>;

struct DataArray {
  std::string name;
  int components = 1;
  Values values;
};

using temper::PhysicalName;

/// A map on which the points of a file in degrees lie.
struct GeographicMap {
  Projection projection;
  std::vector<Vec2> lon_lat;  ///< Longitude and latitude, as in the file [degrees]
  std::vector<Vec2> places;   ///< Positions of these points on the map [m]
};

/// Points of a plane across one of the axes. They have a common coordinate along this axis, which is written back.
struct PlanePoints {
  double z = 0;    ///< Common coordinate
  int normal = 2;  ///< Axis: 2 z; 0 x, with points (y, z); 1 y, with points (x, z)
};
/// Points of a plane with these periods along x and y. A period of 0 means none along that axis; one of them may be 0.
struct PeriodicPoints {
  Vec2 period;
  double z = 0;
};
/// Longitude and latitude of places on a sphere around the origin.
struct SpherePoints {
  double radius = 1;
  std::vector<Vec3> places;  ///< One place per point
};
/// Longitude and latitude without a place in any space: see project().
struct DegreePoints {
  bool is_guessed = false;  ///< Degrees are guessed: the file does not say it, but its numbers fit
  double z = 0;
};
/// Points in the plane of a map; they are written in degrees.
struct MappedPoints {
  std::shared_ptr<const GeographicMap> map;  ///< Map of the points, never null
  double z = 0;
};
/// Points in space, of a mesh of tetrahedra or of a curved surface.
struct SpacePoints {
  std::vector<double> heights;  ///< Third coordinate of each point
  int dimension = 3;            ///< Dimension of the mesh: 2 for a surface
};
using PointsIn = std::variant<PlanePoints, PeriodicPoints, SpherePoints, DegreePoints, MappedPoints, SpacePoints>;

/// The direction in which the numbers of a bed of water grow.
enum class Positive {
  up,    ///< Heights
  down,  ///< Depths
};

/// The cells of one dimension in a file: points, lines, triangles or tetrahedra. They are a range of corners.
template <int dimension>
struct Cells {
  /// The corners of a cell, 0-based. A point is a number alone.
  using Corners = std::conditional_t<dimension == 0, std::int32_t, std::array<std::int32_t, dimension + 1>>;
  std::vector<Corners> corners = {};
  std::vector<std::int32_t> tags = {};  ///< One tag per cell (medit reference, Gmsh physical tag, …)
  std::vector<DataArray> data = {};     ///< Data with one tuple per cell

  [[nodiscard]] std::size_t size() const { return corners.size(); }
  [[nodiscard]] bool empty() const { return corners.empty(); }
  [[nodiscard]] Corners& operator[](std::size_t i) { return corners[i]; }
  [[nodiscard]] const Corners& operator[](std::size_t i) const { return corners[i]; }
  [[nodiscard]] auto begin() { return corners.begin(); }
  [[nodiscard]] auto begin() const { return corners.begin(); }
  [[nodiscard]] auto end() { return corners.end(); }
  [[nodiscard]] auto end() const { return corners.end(); }
  void add(const Corners& cell, std::int32_t tag) {
    corners.push_back(cell);
    tags.push_back(tag);
  }
};

/// A mesh as a file has it. The cells of the largest dimension, triangles or tetrahedra, are the mesh. Their tags are
/// regions, and may be empty. Cells of lower dimensions are tags of its faces, edges and vertices.
struct MeshFile {
  std::vector<Vec2> points;     ///< The first two coordinates, or longitude and latitude [degrees]
  PointsIn points_in;           ///< Kind of the points, with their third coordinate
  std::vector<double> weights;  ///< One weight per point, or empty
  Cells<0> marked_points;       ///< Points that carry a tag (Gmsh point elements, …)
  Cells<1> lines;               ///< Tagged lines, on the boundary or inside
  Cells<2> triangles;           ///< Triangles of the mesh; beside tetrahedra tagged faces
  Cells<3> tetrahedra;
  std::vector<PhysicalName> names;
  std::vector<DataArray> point_data;  ///< Data with one tuple per point
  std::vector<DataArray> field_data;  ///< Data of the file as a whole
  bool z_is_data = false;             ///< Point data "z" are the third coordinate of a mesh of the plane
  std::optional<Positive> positive;   ///< Sign of the bed, if the user said it or z of 2DM; else its name shows it
  std::string path;                   ///< Path of the file that was read, for messages
  std::string format;                 ///< Name of the row of formats() that read the file: "vtu", "gmsh41", …
  std::vector<std::string> warnings;  ///< Warnings about what was dropped or repaired in reading
  std::shared_ptr<const tets::InputNames> numbering;  ///< Numbers and lines of the file, for errors

  /// The dimension of the mesh: 3 if it is of tetrahedra, else 2.
  [[nodiscard]] int dimension() const {
    return in_space() != nullptr ? in_space()->dimension : tetrahedra.empty() ? 2 : 3;
  }
  /// Says whether the mesh is a curved surface.
  [[nodiscard]] bool is_surface() const { return in_space() != nullptr && dimension() == 2; }
  /// The cells by their dimension, for std::get and std::apply.
  [[nodiscard]] auto cells() { return std::tie(marked_points, lines, triangles, tetrahedra); }
  [[nodiscard]] auto cells() const { return std::tie(marked_points, lines, triangles, tetrahedra); }
  /// The three coordinates of a point: in space, on the sphere, or in the plane with its common coordinate.
  [[nodiscard]] Vec3 place(std::size_t point) const;
  [[nodiscard]] const SpherePoints* sphere() const { return std::get_if<SpherePoints>(&points_in); }
  [[nodiscard]] const PeriodicPoints* periodic() const { return std::get_if<PeriodicPoints>(&points_in); }
  [[nodiscard]] const SpacePoints* in_space() const { return std::get_if<SpacePoints>(&points_in); }
  [[nodiscard]] const DegreePoints* degrees() const { return std::get_if<DegreePoints>(&points_in); }
  [[nodiscard]] const GeographicMap* map() const {
    const auto* mapped = std::get_if<MappedPoints>(&points_in);
    return mapped == nullptr ? nullptr : mapped->map.get();
  }
  /// The space of a mesh of these points.
  [[nodiscard]] Space space() const;
  /// The common z of the points of a plane; 0 on a sphere and in space.
  [[nodiscard]] double z() const;
  void set_z(double z);  ///< Sets the common z; does nothing for others
};

enum class Encoding { ascii, base64, appended };

struct ReadOptions {
  Executor* executor = nullptr;  ///< Threads that unpack compressed data; the result does not depend on them
  /// If z differs, the mesh is one of the plane of x and y, and z becomes point data "z". Formats with three
  /// coordinates get it back as z.
  bool flat = false;
  /// The part of a raster to read: the lower left and upper right corner, in the coordinates of the file. Two more
  /// columns and rows are read on each side. Meshes are read whole.
  std::optional<std::array<Vec2, 2>> window = {};
  bool raster_in_degrees = false;  ///< Rasters that do not say it (ESRI ASCII) are in longitude and latitude
  /// The sign of depths or heights in the file. None: by the format and names; z of 2DM is a height.
  std::optional<Positive> positive = {};
};

struct WriteOptions {
  std::string format;  ///< Name of a row of formats(); empty: by the suffix of the path
  /// Encoding, for formats that have several. The choices of VTU are:
  ///   - ascii
  ///   - base64, compressed by zlib: the default
  ///   - appended, raw bytes after the XML: fastest to write and to read, but up to 1.6 times as large as base64
  std::optional<Encoding> encoding;
  Executor* executor = nullptr;  ///< Threads that compress; the bytes written do not depend on them
  /// Add arrays of cell data to VTU and VTKHDF, for ParaView to color. They are bytes and floats, with the names in
  /// TriangleQuality or tets::TetrahedronQuality. read() leaves them out, because write() makes them again.
  bool triangle_quality = true;
  /// Cells to write as polygons instead of the mesh, in one of cell_formats(). The mesh cannot be read from such a file
  /// again.
  std::optional<CellsOf> cells = {};
};

/// A format that temper knows. A new format is one source file and one row.
struct Format {
  std::string_view name;  ///< Name: "vtu", "gmsh22", …; docs/reference/formats/index.md lists them
  std::string_view description;
  std::string_view suffixes;  ///< Suffixes ".vtu", ".msh", …, separated by spaces; files are written with the first one
  bool writes;                ///< Format can be written
  bool holds_weights;         ///< Format can hold weights; else weights go to PATH.weights.csv, with a warning
  bool holds_planes;          ///< Format can hold any mesh of the plane; else only meshes that were read in degrees
  bool holds_spheres;         ///< Format can hold meshes of the sphere
  bool holds_tetrahedra;      ///< Format can hold meshes of tetrahedra
  bool holds_surfaces;        ///< Format can hold curved surfaces
};
[[nodiscard]] std::span<const Format> formats();
/// A format for polygons of cells: see WriteOptions::cells. docs/reference/formats/cells.md lists their contents.
struct CellFormat {
  std::string_view name;  ///< Name: "geojson", …
  std::string_view description;
  std::string_view suffixes;  ///< Suffixes ".geojson", …, separated by spaces
};
[[nodiscard]] std::span<const CellFormat> cell_formats();
/// The version of libnetcdf, such as "4.9.0"; empty if there is none. The library is loaded now, if no file has needed
/// it before.
[[nodiscard]] std::string netcdf_version();
/// The version of libhdf5, such as "1.10.8"; loaded in the same way.
[[nodiscard]] std::string hdf5_version();
/// The version of GDAL, such as "3.6.2"; loaded in the same way.
[[nodiscard]] std::string gdal_version();

/// Reads any known format: a mesh of triangles, of tetrahedra or of a curved surface, as MeshFile tells. Weights come
/// from the side file PATH.weights.csv if it exists. Several threads may call it at once. However, other code in the
/// process (h5py) may share libnetcdf and libhdf5, and temper cannot lock it out. While temper reads or writes NetCDF
/// or VTKHDF, no other thread may call these libraries.
[[nodiscard]] Expected<MeshFile> read(const std::string& path, const ReadOptions& options = {});

/// Returns the bed at each point as depths, positive down; nothing if the file has none. The bed is point data `depth`,
/// the bed level of D-Flow FM, or z if the format or ReadOptions::positive says so.
[[nodiscard]] std::optional<DataArray> depths_of(const MeshFile& file);
/// Writes to a temporary file next to path and renames it. On an error the file at path is unchanged. If a mesh needs
/// several files, they are renamed one after the other when all are complete. If one cannot be renamed, the files
/// before it are new, and the error names them. Returns warnings (weights in a side file, data that the format cannot
/// hold).
[[nodiscard]] Expected<std::vector<std::string>> write(const std::string& path, const MeshFile& file,
                                                       const WriteOptions& options = {});

/// The files that read(path) takes: path, and further files of its format or its weights (m.ele for m.node). Returns
/// path alone if it does not exist or is a pipe, which is not read.
[[nodiscard]] std::vector<std::string> files_to_read(const std::string& path);
/// The files that write() would replace or make, the weights file included; or the error that it would return. `file`:
/// what is to be written, if it is known. The format must have a place for its space or its tetrahedra, and its mesh
/// may change. `cells`: as in WriteOptions.
[[nodiscard]] Expected<std::vector<std::string>> files_to_write(const std::string& path, const std::string& format = {},
                                                                const MeshFile* file = nullptr,
                                                                std::optional<CellsOf> cells = {});

/// The open file of this process that the path stands for, links followed: 1 for "/dev/stdout" and for a link to
/// "/proc/self/fd/1". −1: none. It may be closed.
[[nodiscard]] int open_file_of(const std::string& path);
/// Says whether the path stands for a stream, links followed: a pipe, a device, or the open file of a process, even if
/// bytes go to a file from there. Streams are written directly: they are never replaced, and no file is put next to
/// them.
[[nodiscard]] bool is_stream(const std::string& path);
/// Says whether an open file of this process may be written. False if it is closed.
[[nodiscard]] bool is_open_to_write(int file);
inline constexpr const char* kClosedStream = "the stream is closed. Next: name a file";

/// Writes any text to a file, by way of a temporary file in the same way.
[[nodiscard]] Expected<void> write_text(const std::string& path, std::string_view text);

/// Memory that this process may still take [bytes]. It is the least of the free memory of the machine, of the limits of
/// the process (ulimit), and of the limits of its container or job. Absent: the system does not say.
[[nodiscard]] std::optional<std::uint64_t> free_memory();

/// Removes the temporary files of all unfinished writes. A handler of a signal that ends the program may call it.
/// Writes under way then produce no file.
void discard_unfinished() noexcept;

/// A stream for text that is too long for memory. It writes to a temporary file and renames it: nothing is at path
/// before commit(). Without commit() the temporary file is removed.
class TextStream {
 public:
  [[nodiscard]] static Expected<TextStream> open(const std::string& path);
  TextStream(TextStream&&) noexcept;
  TextStream& operator=(TextStream&&) noexcept;
  TextStream(const TextStream&) = delete;
  TextStream& operator=(const TextStream&) = delete;
  ~TextStream();

  /// Writes text. After a failure further text is ignored, and commit() returns the error.
  void write(std::string_view text);
  /// Puts the file in its place; this is the last call. On an error the old file is unchanged.
  [[nodiscard]] Expected<void> commit();

 private:
  struct State;
  explicit TextStream(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The vertex of each point of a file. It takes no memory if all points are kept.
class VertexOfPoint {
 public:
  VertexOfPoint() = default;
  /// Keeps all of n points.
  explicit VertexOfPoint(std::size_t n) : n_(n), n_kept_(n) {}
  /// Keeps the points that are marked, in order.
  explicit VertexOfPoint(const std::vector<bool>& kept);

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] std::size_t n_kept() const { return n_kept_; }
  /// The vertex of a point; −1 for dropped points.
  [[nodiscard]] std::int32_t operator[](std::size_t point) const {
    return vertices_.empty() ? static_cast<std::int32_t>(point) : vertices_[point];
  }

 private:
  std::size_t n_ = 0, n_kept_ = 0;
  std::vector<std::int32_t> vertices_;  // empty: all points are kept
};

/// The word for the sphere of longitude and latitude, with the Earth's radius of 6371 km. "sphere:radius=R" sets
/// another radius.
inline constexpr std::string_view kOntoSphere = "sphere";
/// The message that refuses points in longitude and latitude if a plane is needed, with the remedy. `guessed`: the
/// file does not say what its points are (fort.14, 2DM). `onto_sphere`: the text with which the user puts them on the
/// sphere.
[[nodiscard]] std::string needs_projection(bool guessed = false, std::string_view onto_sphere = kOntoSphere);
/// The word for no projection: coordinates are in a plane, whatever their values.
inline constexpr std::string_view kNoProjection = "none";
/// Puts the points of a file in degrees on a map, in meters. parse_projection() reads the text; without a center, the
/// middle of the points is the center. write() maps points back: an unmoved point gets its degrees again, bit for bit.
/// kNoProjection takes the coordinates as a plane's. A surface that is nearly a sphere around the origin gets all
/// points on the sphere with kOntoSphere, by default with their median radius. A warning has the largest change.
/// Errors: the errors of project() for outlines; a text that is no projection.
[[nodiscard]] Expected<void> project(MeshFile& file, std::string_view projection);

/// Sets the points of a file from three coordinates. Beside tetrahedra they are in space. If z is constant to one part
/// in a million of the extent, they are in a plane; a warning says so if z is not exactly constant. So they are if x or
/// y is constant. If all have the same distance from the origin, to one part in a million, they are on a sphere. Points
/// that no triangle of the file uses may be anywhere. All others are points of a curved surface. If it is nearly a
/// sphere, a warning says so.
[[nodiscard]] Expected<void> set_points(MeshFile& file, std::vector<Vec3> points);

/// The mesh of a file, in a plane or on a sphere. A file in degrees needs project() first. Points of no triangle are
/// dropped, and a warning names them. Clockwise triangles are reversed and counted in a warning. Interior tagged lines
/// become constrained edges.
struct LoadedMesh {
  Mesh mesh;
  VertexOfPoint vertex_of_point;
  std::size_t reversed_triangles = 0;
  /// Lines that only list the edges of the mesh. If there are two or more inner edges, and all are lines with one
  /// common tag, this marks them among the lines with both points in the mesh. Such lines constrain nothing. Otherwise
  /// empty.
  std::vector<bool> edge_lines = {};
  std::vector<std::string> warnings;
};
/// Makes the mesh of a file. `fixed_tags`: tags or physical names whose points must not move. Points on straight pieces
/// of the boundary are also fixed if tagged lines end or change their tag there.
[[nodiscard]] Expected<LoadedMesh> make_mesh(const MeshFile& file, std::span<const std::string> fixed_tags = {},
                                             Executor* executor = nullptr);
/// The error of a file with tetrahedra, or of a curved surface, where a mesh of the plane or the sphere is expected.
/// make_mesh() returns it, too.
[[nodiscard]] Expected<void> expect_triangles(const MeshFile& file);

/// The mesh of a file with tetrahedra. Points of no tetrahedron are dropped, and a warning names them. Negative
/// tetrahedra are reversed and counted in a warning. Warnings name faces and lines that are no face or edge of the
/// mesh.
struct LoadedTetMesh {
  tets::TetMesh mesh;
  VertexOfPoint vertex_of_point;
  std::vector<std::string> warnings;
};
[[nodiscard]] Expected<LoadedTetMesh> make_tet_mesh(const MeshFile& file, Executor* executor = nullptr);

/// The mesh of a file with a curved surface. Points of no triangle are dropped, and a warning names them. Lines become
/// constrained edges, unless they list the edges of the mesh. `fixed_tags`: as in make_mesh().
struct LoadedSurface {
  surfaces::SurfaceMesh mesh;
  VertexOfPoint vertex_of_point;
  std::vector<bool> edge_lines = {};  ///< As in LoadedMesh
  std::vector<std::string> warnings;
};
[[nodiscard]] Expected<LoadedSurface> make_surface(const MeshFile& file, std::span<const std::string> fixed_tags = {});

/// The treatment of floating point data when the mesh changes. (Integers, flags and tags of points stay with their
/// points. Integers of cells are sampled.)
enum class DataRule {
  interpolate,  ///< Data of points belong to the place: linear on the triangles of the input, so that a depth stays
                ///< where it was measured
  keep,         ///< Data of points belong to the point, such as a load on it
  conserve,     ///< Data of points or cells are means over power cells or cells: their integrals over the domain and
                ///< over each region stay (temper/detail/transfer.hpp)
  sample,       ///< A cell has the data of the input's cell that contains its middle
};
/// The arrays that rules are for.
enum class DataOf { points, cells };

/// The rules for all arrays: a default rule and exceptions.
struct DataRules {
  DataRule rule = DataRule::interpolate;            ///< Of cells `sample` or `conserve`, of points one of the others
  std::map<std::string, DataRule> exceptions = {};  ///< Rules of single arrays, by name

  /// The rule of an array; `keep` for integers.
  [[nodiscard]] DataRule of(const DataArray& array) const;
};
/// Reads rules from words: `interpolate`, `keep` or `conserve` for all arrays of points, `keep=NAME` and so on for one
/// array. Those of cells are `sample` and `conserve`. Without a word for all arrays they are `interpolate` or `sample`.
[[nodiscard]] Expected<DataRules> parse_data_rules(std::span<const std::string> words, DataOf of = DataOf::points);
/// The words from which parse_data_rules() makes these rules: first the one for all arrays.
[[nodiscard]] std::vector<std::string> data_rule_words(const DataRules& rules);
/// Returns an error if an exception names no such array, or an array of integers for what only floating point data
/// can, or conserves an array with a value that is not finite.
[[nodiscard]] Expected<void> check_data_rules(const DataRules& rules, const std::vector<DataArray>& arrays,
                                              DataOf of = DataOf::points);

struct UpdateOptions {
  DataRules rules = {};                           ///< Of data of points
  Executor* executor = nullptr;                   ///< Threads for the search; the result does not depend on them
  DataRules cell_rules = {DataRule::sample, {}};  ///< Of data of triangles or tetrahedra
};

/// The effect of update() on data of points and triangles; all 0 for a file without data.
struct DataReport {
  std::size_t points = 0;           ///< Points of the file that are still there
  std::size_t points_moved = 0;     ///< Points among these that have moved
  Spread distance = {};             ///< Distances that these have moved [length]
  std::size_t points_inserted = 0;  ///< New points that the file did not have
  std::size_t triangles = 0;        ///< Triangles of the mesh
  /// Triangles among these that the file does not have at the same number and places.
  std::size_t triangles_changed = 0;
  /// Names of point data, by their treatment.
  std::vector<std::string> interpolated, kept, conserved, dropped;
  /// Names of cell data: sampled, and conserved.
  std::vector<std::string> of_triangles, conserved_of_triangles;
  /// Of conserved data: the largest change of an integral, over the integral of |u|; and how far a value is outside the
  /// range of the former ones, over the largest |u|. The first is only rounding, unless a region has no cell of its
  /// own. The second is 0, unless the size of a region or of the domain has changed.
  double integral_change = 0, out_of_range = 0;
};
/// The rows for triangles, or for tetrahedra: there the keys say so.
[[nodiscard]] const ReportTable& table_of(const DataReport*);
[[nodiscard]] const ReportTable& table_for_tetrahedra(const DataReport*);

/// Puts coordinates, weights, triangles and regions of the mesh back into the file that it came from. Dropped points
/// disappear with their data. `vertices` is OptimizeReport::vertices: the number in `loaded` of each vertex of the
/// mesh, invalid for inserted vertices. Empty means that no vertex was removed or inserted. If the number of vertices
/// has changed nevertheless, vertices are identified by their place. (This is impossible after release_geometry().)
///
/// Data follow these rules:
///   - Floating point data of points are interpolated on the triangles of the file, at the new place of the vertex,
///     unless the rules keep them. At the place of an old point they are its data, bit for bit.
///   - Conserved data of points are means over power cells, those of the file's weights and of the mesh's. So are
///     conserved data of cells. Arrays with a value that is not finite are interpolated or sampled, with a warning.
///   - Integers stay with their point. An inserted point gets the value that all corners around it have in common. If
///     they differ anywhere, the array is dropped.
///   - Each triangle gets the other cell data of the file's triangle that contains its middle. Nothing is averaged.
///   - If a removed point joined two lines of one tag, one line replaces them. Other lines and marked points disappear
///     with their points.
///   - A line whose edge was split becomes two lines with the same tag and data.
///   - Lines that list all inner edges (LoadedMesh::edge_lines) list the edges of the new mesh.
///   - Warnings in file.warnings name everything that is lost.
///
/// It may be called again for a later state of the mesh, if no vertices are removed or inserted. Then data are
/// interpolated on the result of the last call. O(n log n) if data move, else O(n).
DataReport update(MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
                  const IdVector<VertexId, VertexId>& vertices = {}, const UpdateOptions& options = {});

/// Puts points, weights, tetrahedra and regions of a mesh back into the file that it came from, by the same rules.
/// `loaded` is the mesh of the file, unchanged, and `origins` says where the parts of the mesh are in it. Data are
/// linear on the tetrahedra of the file. In the report, triangles are tetrahedra. O(n) if points move little.
DataReport update(MeshFile& file, const LoadedTetMesh& loaded, const tets::TetMesh& mesh,
                  const tets::Origins& origins = {}, const UpdateOptions& options = {});

/// Puts a surface back into its file, by the same rules. `vertices`: as for triangles. Data are linear on the triangles
/// of the file, and vertices get those of the closest points. There are no conserved data.
DataReport update(MeshFile& file, const LoadedSurface& loaded, const surfaces::SurfaceMesh& mesh,
                  const IdVector<VertexId, VertexId>& vertices = {}, const UpdateOptions& options = {});

/// The weight of each corner of each triangle of the mesh, three each, from cell data `corner_weights` of the file;
/// empty if it has none. Meshes with tensors of several planes have them (temper/detail/tensor.hpp).
[[nodiscard]] std::vector<double> corner_weights_of(const MeshFile& file, const LoadedMesh& loaded);
/// The same of tetrahedra, four each.
[[nodiscard]] std::vector<double> corner_weights_of(const MeshFile& file, const LoadedTetMesh& loaded);
/// Says whether a file has such cell data.
[[nodiscard]] bool has_corner_weights(const MeshFile& file);
/// Sets these cell data of a file after update(). Empty: the file has none any more.
void set_corner_weights(MeshFile& file, const std::vector<double>& weights);

/// Frees the points, weights and triangles of a file after make_mesh(); update() writes them again. It does nothing in
/// these cases:
///   - points were dropped or are on a sphere
///   - points or triangles have data, because update() then needs the former geometry
///
/// The memory goes back to the system.
void release_geometry(MeshFile& file, const LoadedMesh& loaded);
/// Frees points, weights and tetrahedra after make_tet_mesh(), unless points were dropped or corners have weights.
void release_geometry(MeshFile& file, const LoadedTetMesh& loaded);
/// Frees nothing: surfaces are small.
inline void release_geometry(MeshFile& /*file*/, const LoadedSurface& /*loaded*/) {}

/// An outline, as a file gives it.
struct OutlineFile {
  Outline outline;                    ///< Outline; its names are the file's own numbers and lines
  std::string path;                   ///< Path of the file that was read
  std::string format;                 ///< Format: "poly", "jigsaw", "geojson", or "gis" through GDAL
  bool geographic = false;            ///< Points are longitude and latitude [degrees]
  std::vector<std::string> warnings;  ///< Warnings about what was dropped in reading
};
/// Reads an outline: Triangle's .poly (with its .node), JIGSAW's geometry, GeoJSON, and through GDAL shapefiles and
/// GeoPackages. The content decides the format.
[[nodiscard]] Expected<OutlineFile> read_outline(const std::string& path);

/// A file that holds only this mesh. Its fixed vertices are marked points of tag 1.
[[nodiscard]] MeshFile from_mesh(const Mesh& mesh);

/// A file with the mesh of an outline. It has the edges of the outline as tagged lines, the marked vertices as marked
/// points, and the names of both. Tags of 0 are replaced, because files drop elements without a tag: lines on the
/// boundary get 1, as in Triangle. Other lines get the first number above 1 and above all other tags, and points the
/// number after it.
///
/// If the outline was given in degrees, `lon_lat` has its points as they were given (`vertex_of_point` counts them),
/// and `map` is the projection of the plane. The points of a file on the sphere are then these degrees, bit for bit. A
/// file in the plane has point data `longitude` and `latitude`.
[[nodiscard]] MeshFile from_outline(const OutlineMesh& made, std::span<const Vec2> lon_lat = {},
                                    const std::optional<Projection>& map = {});

}  // namespace temper::io

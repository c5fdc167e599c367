// Mesh files. Content decides the format; one source file a format; everything passes through.
//
// A MeshFile is what a file says, in neutral arrays: points, weights, triangles, lines, tags, names and
// data. make_mesh builds the mesh from it (errors speak the file's own numbers and lines); update puts an
// optimized mesh back, so that all else that was in the file is written again.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/detail/executor.hpp"
#include "temper/detail/outline.hpp"
#include "temper/detail/projection.hpp"
#include "temper/detail/size.hpp"
#include "temper/mesh.hpp"

namespace temper::io {

/// Numbers of one kind. Files are written with the type they were read with.
using Values =
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::int64_t>, std::vector<std::int32_t>,
                 std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::int16_t>,
                 std::vector<std::uint16_t>, std::vector<std::uint32_t>, std::vector<std::uint64_t>>;

struct DataArray {
  std::string name;
  int components = 1;
  Values values;
};

/// A named group of elements: Gmsh physical names.
struct PhysicalName {
  int dimension = 0;  ///< 0 points, 1 lines, 2 triangles
  std::int32_t tag = 0;
  std::string name;
};

/// Where the points of a file in degrees are on a map.
struct GeographicMap {
  Projection projection;
  std::vector<Vec2> lon_lat;  ///< as the file has them [degrees]
  std::vector<Vec2> places;   ///< the same on the map [m]
};

/// What the points of a file are. Points of a plane have one z in common, which is written back.
struct PlanePoints {
  double z = 0;
};
/// Of a plane with these periods along x and y, of which one may be 0: none.
struct PeriodicPoints {
  Vec2 period;
  double z = 0;
};
/// Longitude and latitude of places on a sphere around the origin.
struct SpherePoints {
  double radius = 1;
  std::vector<Vec3> places;  ///< one a point
};
/// Longitude and latitude without a place in any space: see project().
struct DegreePoints {
  bool is_guessed = false;  ///< which the file does not say, but its depths
  double z = 0;
};
/// Of the plane of a map, and written in degrees.
struct MappedPoints {
  std::shared_ptr<const GeographicMap> map;  ///< never null
  double z = 0;
};
using PointsIn = std::variant<PlanePoints, PeriodicPoints, SpherePoints, DegreePoints, MappedPoints>;

struct MeshFile {
  std::vector<Vec2> points;                            ///< of the plane; or longitude and latitude [degrees]
  PointsIn points_in;                                  ///< what they are
  std::vector<double> weights;                         ///< empty, or one a point
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< 0-based
  std::vector<std::int32_t> regions;  ///< empty, or one a triangle (medit reference, Gmsh physical tag, …)
  std::vector<std::array<std::int32_t, 2>> lines;  ///< tagged lines: boundary or interior
  std::vector<std::int32_t> line_tags;             ///< one a line
  std::vector<std::int32_t> marked_points;         ///< points that carry a tag (Gmsh point elements, …)
  std::vector<std::int32_t> point_tags;            ///< one a marked point
  std::vector<PhysicalName> names;
  std::vector<DataArray> point_data;            ///< one tuple a point
  std::vector<DataArray> cell_data;             ///< one tuple a triangle
  std::vector<DataArray> line_data;             ///< one tuple a line
  std::vector<DataArray> marked_point_data;     ///< one tuple a marked point
  std::vector<DataArray> field_data;            ///< of the file as a whole
  std::string path;                             ///< where it was read from, for messages
  std::string format;                           ///< "vtu", "gmsh41", …: the row of formats() it came from
  std::vector<std::string> warnings;            ///< what was dropped or repaired in reading
  std::shared_ptr<const InputNames> numbering;  ///< the file's own numbers and lines

  [[nodiscard]] const SpherePoints* sphere() const { return std::get_if<SpherePoints>(&points_in); }
  [[nodiscard]] const PeriodicPoints* periodic() const { return std::get_if<PeriodicPoints>(&points_in); }
  [[nodiscard]] const DegreePoints* degrees() const { return std::get_if<DegreePoints>(&points_in); }
  [[nodiscard]] const GeographicMap* map() const {
    const auto* mapped = std::get_if<MappedPoints>(&points_in);
    return mapped == nullptr ? nullptr : mapped->map.get();
  }
  /// The space that a mesh of these points is in.
  [[nodiscard]] Space space() const;
  /// Of the plane; 0 on a sphere.
  [[nodiscard]] double z() const;
  void set_z(double z);  ///< nothing on a sphere
};

enum class Encoding { ascii, base64, appended };

struct ReadOptions {
  Executor* executor = nullptr;  ///< threads that unpack compressed data; what is read does not depend on them
};

struct WriteOptions {
  std::string format;  ///< row of formats(); empty: by the suffix of the path
  /// The encoding, for formats that have several. VTU: ascii; base64, which is compressed by zlib, its default;
  /// appended, raw bytes after the XML: the fastest to write and to read, and about half as large again.
  std::optional<Encoding> encoding;
  Executor* executor = nullptr;  ///< threads that compress; the bytes written do not depend on them
  /// VTU and VTKHDF have four arrays of cell data more, named as in TriangleQuality, for ParaView to color: bytes and
  /// floats.
  /// read() leaves them out, as they are made anew.
  bool triangle_quality = true;
};

/// A format temper knows. Adding one is one source file and one row.
struct Format {
  std::string_view name;  ///< "vtu", "gmsh22", …: docs/formats.md lists them
  std::string_view description;
  std::string_view suffixes;  ///< ".vtu", ".msh", …, separated by spaces; first is the one written
  bool writes;
  bool holds_weights;  ///< else weights go to PATH.weights.csv, with a warning
  bool holds_planes;   ///< meshes of the plane; else only such as were read in degrees
  bool holds_spheres;  ///< meshes of the sphere
};
[[nodiscard]] std::span<const Format> formats();
/// "4.9.0": of libnetcdf, which is loaded when a file needs it, or now; empty when there is none.
[[nodiscard]] std::string netcdf_version();
/// "1.10.8": of libhdf5, likewise.
[[nodiscard]] std::string hdf5_version();

/// Reads any known format; a side file PATH.weights.csv, when there, gives the weights. From several threads at once,
/// too. But libnetcdf and libhdf5 may be those of others in the process (h5py), of whom temper does not know: while it
/// reads or writes NetCDF or VTKHDF, no other thread may call them.
[[nodiscard]] Expected<MeshFile> read(const std::string& path, const ReadOptions& options = {});
/// Writes to a temporary file beside path and renames it: on any error what was at path is untouched. Of several files
/// none is renamed before all are whole; then they are, one after the other: where one cannot be, those before it are
/// new, and the error names them. Returns warnings (weights gone to a side file, data that the format cannot hold).
[[nodiscard]] Expected<std::vector<std::string>> write(const std::string& path, const MeshFile& file,
                                                       const WriteOptions& options = {});

/// The files that read() takes there: path, and those beside it that its format or its weights are in (m.ele of
/// m.node). Path alone where there is none yet, or a pipe, which is left as it is.
[[nodiscard]] std::vector<std::string> files_to_read(const std::string& path);
/// The files that write() replaces or makes there, that of the weights included; or why it would write none.
[[nodiscard]] Expected<std::vector<std::string>> files_to_write(const std::string& path,
                                                                const std::string& format = {});

/// Any text to a file, by the same temporary-and-rename.
[[nodiscard]] Expected<void> write_text(const std::string& path, std::string_view text);

/// Removes the temporary files of all writes under way: for the handler of a signal that ends the program, in which it
/// may be called. What is written meanwhile comes to nothing.
void discard_unfinished() noexcept;

/// Text too long to be held, written as it comes, by the same temporary-and-rename: nothing is at path before commit(),
/// and nothing is left of it when there is none.
class TextStream {
 public:
  [[nodiscard]] static Expected<TextStream> open(const std::string& path);
  TextStream(TextStream&&) noexcept;
  TextStream& operator=(TextStream&&) noexcept;
  TextStream(const TextStream&) = delete;
  TextStream& operator=(const TextStream&) = delete;
  ~TextStream();

  /// Once writing has failed the rest is ignored: commit() says why.
  void write(std::string_view text);
  /// The last call. What was written takes its place, or there is an error and what was there before is unchanged.
  [[nodiscard]] Expected<void> commit();

 private:
  struct State;
  explicit TextStream(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The vertex that each point of a file has become. Takes no room where all are kept.
class VertexOfPoint {
 public:
  VertexOfPoint() = default;
  /// Keeps all of n points.
  explicit VertexOfPoint(std::size_t n) : n_(n), n_kept_(n) {}
  /// Keeps the points that are marked, in order.
  explicit VertexOfPoint(const std::vector<bool>& kept);

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] std::size_t n_kept() const { return n_kept_; }
  /// −1 for dropped points.
  [[nodiscard]] std::int32_t operator[](std::size_t point) const {
    return vertices_.empty() ? static_cast<std::int32_t>(point) : vertices_[point];
  }

 private:
  std::size_t n_ = 0, n_kept_ = 0;
  std::vector<std::int32_t> vertices_;  // empty: all points are kept
};

/// The word for the sphere that longitude and latitude are of: its radius is the Earth's, 6371 km, or
/// "sphere:radius=R".
inline constexpr std::string_view kOntoSphere = "sphere";
/// Why points in longitude and latitude are refused where a plane is needed, and the cure. `guessed`: their format does
/// not say what they are, as fort.14 does not. `onto_sphere`: what the user writes to have them on the sphere.
[[nodiscard]] std::string needs_projection(bool guessed = false, std::string_view onto_sphere = kOntoSphere);
/// The word that is no projection: coordinates are those of a plane, whatever they look like.
inline constexpr std::string_view kNoProjection = "none";
/// Puts the points of a file in degrees on a map, in meters, as parse_projection reads it; about the middle of its
/// points when it says no center. write() takes them back: a point at the place of one that was read has its degrees
/// bit for bit. kNoProjection: they are of a plane. Errors: those of project() for outlines; a text that is no
/// projection.
[[nodiscard]] Expected<void> project(MeshFile& file, std::string_view projection);

/// Gives a file points with three coordinates: in a plane of constant z, to one part in a million of the extent, with a
/// warning where it is not exact; or on a sphere around the origin where all are at one distance from it, to one part
/// in a million. Points of none of the triangles that the file has may be anywhere. An error names a point that is in
/// neither.
[[nodiscard]] Expected<void> set_points(MeshFile& file, std::vector<Vec3> points);

/// The mesh of a file, in a plane or on a sphere: of one in degrees only after project(). Points of no triangle are
/// dropped with a warning that names them; clockwise triangles are reversed and counted in a warning. Interior tagged
/// lines become constrained edges.
struct LoadedMesh {
  Mesh mesh;
  VertexOfPoint vertex_of_point;
  std::size_t reversed_triangles = 0;
  /// Where all inner edges are lines of one tag, two or more: for each line of the file whose points are both in the
  /// mesh whether it is one of these. They constrain nothing. Else empty.
  std::vector<bool> edge_lines = {};
  std::vector<std::string> warnings;
};
/// `fixed_tags`: tags or physical names whose points must not move. Fixed, too, are points of straight pieces of the
/// boundary where tagged lines end or change their tag.
[[nodiscard]] Expected<LoadedMesh> make_mesh(const MeshFile& file, std::span<const std::string> fixed_tags = {},
                                             Executor* executor = nullptr);

/// What floating point data of points do where vertices move. (Integers, and flags and tags, stay with their points.)
enum class DataRule {
  interpolate,  ///< are of the place: linear on the triangles of the input, so that a depth stays where it was measured
  keep,         ///< are of the point: a load that it carries
};

/// DataRules: a rule, and arrays for which another holds.
struct DataRules {
  DataRule rule = DataRule::interpolate;
  std::map<std::string, DataRule> exceptions = {};  ///< by the array's name

  /// The rule of an array of point data; keep for integers.
  [[nodiscard]] DataRule of(const DataArray& array) const;
};
/// The rules that words say, of which each is interpolate or keep, or interpolate=NAME or keep=NAME for one array.
[[nodiscard]] Expected<DataRules> parse_data_rules(std::span<const std::string> words);
/// An error unless each exception names an array of point data, and one of floating point where it says interpolate.
[[nodiscard]] Expected<void> check_data_rules(const DataRules& rules, const MeshFile& file);

struct UpdateOptions {
  DataRules rules = {};
  Executor* executor = nullptr;  ///< threads that look for places; the result does not depend on them
};

/// What update() did with data of points and triangles; all 0 for a file without.
struct DataReport {
  std::size_t points = 0;             ///< of the file that are left
  std::size_t points_moved = 0;       ///< of those, elsewhere than in the file
  Spread distance = {};               ///< by which the moved ones are [length]
  std::size_t points_inserted = 0;    ///< that the file did not have
  std::size_t triangles = 0;          ///< of the mesh
  std::size_t triangles_changed = 0;  ///< of those, that the file does not have at this number and these places
  std::vector<std::string> interpolated, kept, dropped;  ///< names of point data, by what became of them
  std::vector<std::string> of_triangles;                 ///< names of cell data
};

/// Puts coordinates, weights, triangles and regions of the mesh back into the file it came from, whose dropped points
/// go with their data. `vertices` is OptimizeReport::vertices: the number in `loaded` of each vertex of the mesh,
/// invalid for one that was inserted. Empty: none was removed or inserted; or, where their number is another one than
/// before, vertices are known by their place, on the sphere, too. (After release_geometry() no place is known.)
///
/// Floating point data of points are interpolated on the triangles of the file, at the place where a vertex is now,
/// unless the rules say that they stay with their point; bit for bit the same where a vertex is still at its place, or
/// at that of another one. Integers stay with their point. Of inserted points they are what all corners around have in
/// common; an array that has nothing in common somewhere is dropped. Cell data are those of the file's triangle that
/// the middle of a triangle is in; nothing is averaged. Where a point is gone that two lines of one tag met at, one
/// line is left; other lines and marked points go with their points. A line whose edge was split is two, with its tag
/// and data on both. Lines that list all inner edges (LoadedMesh::edge_lines) list those of the mesh afterwards. What
/// is lost is named in file.warnings.
///
/// May be called again for a later state of the mesh, as long as no vertices are removed or inserted; data are then
/// interpolated on what the last call has left. O(n log n) when there are data that move, else O(n).
DataReport update(MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh,
                  const IdVector<VertexId, VertexId>& vertices = {}, const UpdateOptions& options = {});

/// Frees the points, weights and triangles of a file whose mesh has been made: update() writes them again. Nothing when
/// points were dropped or are on a sphere, or there are data of points or triangles, which update() needs the former
/// geometry for. What is free is given back to the system.
void release_geometry(MeshFile& file, const LoadedMesh& loaded);

/// An outline, as a file gives it.
struct OutlineFile {
  Outline outline;                    ///< its names are the file's own numbers and lines
  std::string path;                   ///< where it was read from
  std::string format;                 ///< "poly", "jigsaw" or "geojson"
  bool geographic = false;            ///< points are longitude and latitude, in degrees
  std::vector<std::string> warnings;  ///< what was dropped in reading
};
/// Reads an outline: Triangle's .poly (with its .node), JIGSAW's geometry, GeoJSON. Its content decides the format.
[[nodiscard]] Expected<OutlineFile> read_outline(const std::string& path);

/// A file that holds just this mesh.
[[nodiscard]] MeshFile from_mesh(const Mesh& mesh);

}  // namespace temper::io

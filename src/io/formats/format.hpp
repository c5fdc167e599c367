// A format for the rest of io: one row of the table in registry.cpp, and the functions of one source file.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/conversion/bed.hpp"
#include "io/conversion/format_traits.hpp"
#include "io/conversion/globe.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/disk/files.hpp"
#include "io/text/file_names.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// The result of a reader: the arrays, and the file's own numbers for them.
struct Document {
  MeshFile file;
  std::shared_ptr<FileNames> names;
  double z = 0;                                   ///< of the first point
  std::vector<double> heights = {};               ///< z of each point; empty while all points have the z of the first
  std::vector<std::int32_t> fourth_corners = {};  ///< of the first faces that were read, or kNoCorner
  bool may_be_degrees = false;  ///< nothing says that the points are lengths, and meshes of the sea have this format

  /// The three coordinates of a point, as they were read.
  [[nodiscard]] Vec3 place(std::size_t point) const {
    return {file.points[point].x, file.points[point].y, heights.empty() ? z : heights[point]};
  }
  /// A quadrilateral is the next of the triangles, with its fourth corner beside it: quadrilaterals.hpp.
  void add_face(const std::array<std::int32_t, 3>& corners, std::int32_t fourth = kNoCorner) {
    file.triangles.corners.push_back(corners);
    if (fourth == kNoCorner) return;
    fourth_corners.resize(file.triangles.size(), kNoCorner);
    fourth_corners.back() = fourth;
  }
};
[[nodiscard]] Document new_document(const std::string& path);

/// Checks what every format must satisfy once its arrays are read. Points and triangles or tetrahedra exist, and
/// numbers are in range. Coordinates and weights are finite. Points of triangles lie in a plane or on a sphere around
/// the origin; degrees are guessed if the file may have them. Points of tetrahedra are in space.
void check(Document& document, const ReadOptions& options);

/// Collects z, of one point after the other.
class PlaneCheck {
 public:
  explicit PlaneCheck(Document& document) : document_(document) {}
  /// z of the point with this index, whose number and line are already in the names.
  void add(std::size_t index, double z) {
    if (index == 0) document_.z = z;
    if (z != document_.z && document_.heights.empty()) document_.heights.assign(index, document_.z);
    if (!document_.heights.empty()) document_.heights.push_back(z);
  }

 private:
  Document& document_;
};

/// The kinds of elements that temper reads in a format, beside lines and points.
enum class KindsOfCells {
  triangles,
  faces,      ///< triangles and quadrilaterals
  simplices,  ///< triangles and tetrahedra
  all,
};
inline constexpr std::string_view kNextForQuadrilaterals = ". Next: write meshes of quadrilaterals as VTU or Gmsh";
inline constexpr std::string_view kNextForTetrahedra = ". Next: write meshes of tetrahedra as VTU, Gmsh or medit";

/// Refuses an element that is neither point, line nor one of these, with the reason.
[[noreturn]] void refuse_element(const std::string& where, std::int64_t number, std::string_view kind,
                                 KindsOfCells read = KindsOfCells::faces);
/// Refuses a quadrilateral in a file with tetrahedra.
[[noreturn]] void refuse_beside_tetrahedra(const std::string& where, std::string_view name);

struct WriteJob;

/// The parts of a mesh file beyond triangles and points in the plane. Not every format has a place for each.
enum Content : unsigned {
  kZ = 1u << 0,
  kWeights = 1u << 1,
  kRegions = 1u << 2,
  kLines = 1u << 3,
  kMarkedPoints = 1u << 4,
  kNames = 1u << 5,
  kPointData = 1u << 6,
  kCellData = 1u << 7,
  kLineData = 1u << 8,
  kMarkedPointData = 1u << 9,
  kFieldData = 1u << 10,
  kSphere = 1u << 11,  ///< points of a sphere, in three coordinates or in degrees
  kPeriod = 1u << 12,  ///< periods of a plane
  kQuadrilaterals = 1u << 13,
  kTetrahedra = 1u << 14,
};
using Contents = unsigned;
/// The arrays of a kind of data. Cell data are data of triangles.
template <class File>
[[nodiscard]] auto& data_of(File& file, Content kind) {
  return kind == kPointData         ? file.point_data
         : kind == kCellData        ? file.triangles.data
         : kind == kLineData        ? file.lines.data
         : kind == kMarkedPointData ? file.marked_points.data
                                    : file.field_data;
}
inline constexpr Contents kAllTags = kRegions | kLines | kMarkedPoints;
inline constexpr Contents kAllData = kPointData | kCellData | kLineData | kMarkedPointData | kFieldData;
inline constexpr Contents kAll = kZ | kWeights | kAllTags | kNames | kAllData;
/// Contents of formats whose points are always in space.
inline constexpr Contents kInSpace = kZ | kSphere;

/// The meshes that a format writes in longitude and latitude.
enum class Degrees {
  as_they_came,  ///< those that were read in degrees
  where_known,   ///< those in the plane, too, that have longitude and latitude as data
  always,        ///< no others
  by_writer,     ///< the writer needs the plane for orthocenters, and sees to degrees itself
};

/// Properties that few formats have.
struct FormatDetails {
  /// Says whether the format has a place for an array whose content is not in `holds`. Null: for none.
  bool (*keeps)(Content of, const DataArray& array) = nullptr;
  /// The files that are written, or the reason why none can be; null: path alone.
  std::vector<std::string> (*files_to_write)(const std::string& path) = nullptr;
  /// The files that are read if they exist, the file of the points first; null: path alone.
  std::vector<std::string> (*files_to_read)(const std::string& path) = nullptr;
  std::int64_t first_point = 1;     ///< the number of the first point in a file
  std::string_view name_ends = {};  ///< characters that would end a name: written as %22
  Degrees degrees = Degrees::as_they_came;
  Bed bed = Bed::as_it_came;
  bool has_heights = false;     ///< z of its points is data
  bool joins_halves = false;    ///< the writer makes the quadrilaterals of triangles itself
  bool may_be_outline = false;  ///< files without triangles are outlines
  FormatTraits traits = {};
};

struct FormatRow {
  std::string_view name, description, suffixes;  ///< as in Format
  Contents holds;                                ///< what a file has beyond it is named in a warning
  bool (*sniff)(std::string_view head);          ///< from the first kSniffBytes of the file
  Document (*read)(Source& source);
  void (*write)(const WriteJob& job) = nullptr;  ///< null: read only
  FormatDetails details = {};

  /// Says whether points have three coordinates in a file.
  [[nodiscard]] bool is_in_space() const {
    return (holds & kInSpace) == kInSpace && details.degrees == Degrees::as_they_came;
  }
};
inline constexpr std::size_t kSniffBytes = 4096;
/// The row of that name, or null.
[[nodiscard]] const FormatRow* find_row(std::string_view name);
/// The details of the format that a file was read from; those of no format for others.
[[nodiscard]] const FormatDetails& details_of(const MeshFile& file);

/// One file to be written.
struct WriteJob {
  const std::string& path;
  const MeshFile& file;      ///< as it is written: in degrees where it was read in degrees
  const MeshFile& measured;  ///< the same file in lengths of the mesh
  const FormatRow& row;
  std::optional<Encoding> encoding;
  bool triangle_quality;
  Executor* executor;
  OutputSet& outputs;
  std::vector<std::string>& warnings;
  std::vector<double> heights = {};               ///< z of each point, from data; empty: all have the z of the file
  std::vector<std::int32_t> fourth_corners = {};  ///< of the last triangles of the file, which are quadrilaterals

  /// The number of triangles; the rest are quadrilaterals.
  [[nodiscard]] std::size_t n_triangles() const { return file.triangles.size() - fourth_corners.size(); }
  /// The three coordinates of a point, as they are written.
  [[nodiscard]] Vec3 place(std::size_t point) const {
    return heights.empty() ? file.place(point) : Vec3{file.points[point].x, file.points[point].y, heights[point]};
  }
  /// Says whether each point has a z of its own.
  [[nodiscard]] bool has_heights() const { return !heights.empty() || file.in_space() != nullptr; }
  [[nodiscard]] bool is_flat() const { return !has_heights() && normal_of(file) == kZAxis && io::is_flat(file); }
  /// The message in parts, as for text().
  template <class... Parts>
  void warn(const Parts&... message) const {
    warnings.push_back(text(path, ": ", message...));
  }
  /// The name in a form that the format can hold.
  [[nodiscard]] std::string written(std::string_view name) const;
};

/// Warns of all that the file has and the row does not hold, except the weights, which go to the side file.
void warn_of_losses(const WriteJob& job);
/// Warns of arrays or names without a place in the format.
void warn_of_arrays(const WriteJob& job, std::string_view kind, const std::vector<std::string_view>& names);
void warn_of_names(const WriteJob& job, const std::vector<PhysicalName>& lost);
/// The tag of each point, 0 without one, for formats that hold one tag: a warning names further tags.
[[nodiscard]] std::vector<std::int32_t> one_tag_a_point(const WriteJob& job);

/// "a Fluent mesh, which temper does not read; meshio converts it", for a file in a recognized format. Else empty.
[[nodiscard]] std::string recognize_unsupported(std::string_view beginning);
/// Says whether a file of this size is a binary STL file, which begins with any title.
[[nodiscard]] bool is_binary_stl(std::string_view beginning, std::uint64_t bytes);
/// Says what is wrong with STL that was not recognized, because it was cut; empty if it seems to be another file.
[[nodiscard]] std::string fault_of_stl(std::string_view beginning, std::uint64_t bytes);

// --- weights of formats without a place for them ---------------------------------------------------
/// PATH.weights.csv
[[nodiscard]] std::string side_file_path(const std::string& path);
/// PATH.corner_weights.csv, with weights for each vertex and region of formats without cell data
[[nodiscard]] std::string corner_file_path(const std::string& path);
void read_corner_file(Document& document);
void write_corner_file(const WriteJob& job);
/// Takes the weights from the side file when it exists and the file itself has none.
void read_side_file(Document& document);
/// Writes the side file when there are weights, or the side file exists.
void write_side_file(const WriteJob& job);

/// The reader of UGRID, which also takes all NetCDF and HDF5 files that no other reader takes.
[[nodiscard]] Document read_ugrid(Source& source);

/// Fails unless the arrays of the file fit each other: a file made by hand, or kept in another file, may not. Writers
/// would read past the ends.
void check_sizes(const std::string& path, const MeshFile& file);

}  // namespace temper::io

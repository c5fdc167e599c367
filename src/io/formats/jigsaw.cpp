// JIGSAW's meshes (Engwirda): MSHID=3;EUCLIDEAN-MESH, sections NAME=n of n lines with their numbers between semicolons.
//
//   NDIMS=2          3 when the plane of the mesh is not z = 0, and on a sphere
//   POINT=n          x;y;tag               tag 0: none
//   POWER=n;1        w                     weights, with the sign that temper has
//   VALUE=n;k        k numbers per point   kept as data `value`, SLOPE as data `slope`
//   EDGE2=n          a;b;tag               TRIA3=n          a;b;c;tag
//
// ELLIPSOID-MESH is read, too: RADII=r;r;r of a sphere. Points are longitude and latitude in radians (NDIMS=2), or in
// space. JIGSAW's POWER refers to chords, and so does temper's weight there.
//
// Points count from 0. Geometries of the same format (edges without triangles) are outlines: outline_jigsaw.cpp.
#include <algorithm>
#include <cctype>
#include <numbers>
#include <optional>

#include "io/conversion/globe.hpp"
#include "io/formats/format.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

constexpr std::pair<std::string_view, std::string_view> kOtherJigsawCells[] = {
    {"QUAD4", "quadrilateral"}, {"TRIA4", "tetrahedron"}, {"HEXA8", "hexahedron"},
    {"WEDG6", "wedge"},         {"PYRA5", "pyramid"},
};

/// Sections of point data, and the names of their arrays.
constexpr std::pair<std::string_view, std::string_view> kJigsawData[] = {{"VALUE", "value"}, {"SLOPE", "slope"}};

class JigsawMeshReader {
 public:
  explicit JigsawMeshReader(Source& source)
      : document_(new_document(source.path)), scanner_(source.path, separated(source.bytes), '#') {}
  Document read() {
    while (!scanner_.at_end()) section(upper_case(scanner_.word("a section")));
    MeshFile& f = document_.file;
    if (std::all_of(f.triangles.tags.begin(), f.triangles.tags.end(), [](std::int32_t r) { return r == 0; }))
      f.triangles.tags.clear();
    for (const auto& [name, array] : kJigsawData) {
      const DataArray* data = find(f.point_data, array);
      if (data == nullptr || size(data->values) == f.points.size() * static_cast<std::size_t>(data->components))
        continue;
      fail(ErrorCode::size_mismatch, scanner_.path(), name, " has ",
           size(data->values) / static_cast<std::size_t>(data->components), " rows, but there are ", f.points.size(),
           " points");
    }
    if (!f.weights.empty() && f.weights.size() != f.points.size()) {
      fail(ErrorCode::size_mismatch, scanner_.path(), "POWER has ", f.weights.size(), " rows, but there are ",
           f.points.size(), " points");
    }
    settle_ellipsoid();
    document_.names->triangles = RunLength(0, f.triangles.size());
    document_.names->lines = RunLength(0, f.lines.size());
    return std::move(document_);
  }

 private:
  /// Semicolons and the equals signs of titles are blanks here, so that the scanner finds its words.
  static std::string_view separated(std::string& bytes) {
    for (char& c : bytes) {
      if (c == ';' || c == '=') c = ' ';
    }
    return bytes;
  }
  void section(const std::string& name) {
    if (name == "MSHID") return kind();
    if (name == "NDIMS") return dimension();
    if (name == "RADII") return radii();
    if (name == "POINT") return points();
    if (name == "EDGE2") return edges();
    if (name == "TRIA3") return triangles();
    if (name == "POWER" || name == "VALUE" || name == "SLOPE") return point_values(name);
    other(name);
  }
  void kind() {
    const auto version = scanner_.integer("the version of the format");
    if (version < 1 || version > 3)
      scanner_.fail_here(ErrorCode::unsupported, "is JIGSAW version ", version, "; temper reads 1 to 3");
    // Version 1 had no kinds: all its files were meshes in the plane or in space.
    if (!scanner_.more_on_line()) return;
    const std::string found = upper_case(scanner_.word("the kind of file"));
    ellipsoid_ = found == "ELLIPSOID-MESH";
    if (ellipsoid_ || found == "EUCLIDEAN-MESH") return;
    scanner_.fail_here(ErrorCode::unsupported, "is of kind ", in_quotes(found),
                       "; temper reads EUCLIDEAN-MESH and ELLIPSOID-MESH");
  }
  void dimension() {
    dimension_ = scanner_.integer("the dimension");
    if (dimension_ != 2 && dimension_ != 3)
      scanner_.fail_here(ErrorCode::unsupported, "has dimension ", dimension_, "; expected 2 or 3");
  }
  /// One number, or three equal ones.
  void radii() {
    while (scanner_.more_on_line()) {
      const double r = scanner_.real("a radius");
      if (!(r > 0) || (radius_ && r != *radius_)) {
        scanner_.fail_here(ErrorCode::unsupported, "has the radius ", r, radius_ ? text(" beside ", *radius_) : "",
                           "; expected a sphere: equal radii above 0");
      }
      radius_ = r;
    }
  }
  void points() {
    MeshFile& f = document_.file;
    FileNames& names = *document_.names;
    if (!f.points.empty()) scanner_.fail_here(ErrorCode::syntax, "has a second section POINT");
    const std::size_t n = scanner_.count("points", 6);
    f.points.reserve(n);
    names.points = RunLength(0, n);
    PlaneCheck plane(document_);
    for (std::size_t i = 0; i < n; ++i) {
      const double x = scanner_.real("the x coordinate of a point");
      names.point_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      f.points.push_back({x, scanner_.real("the y coordinate of a point")});
      if (dimension_ == 3) plane.add(i, scanner_.real("the z coordinate of a point"));
      const std::int32_t tag = scanner_.integer("the tag of a point");
      if (tag == 0) continue;
      f.marked_points.add(static_cast<std::int32_t>(i), tag);
    }
  }
  /// Radians become degrees, which go onto the sphere.
  void settle_ellipsoid() {
    MeshFile& f = document_.file;
    if (!ellipsoid_ || dimension_ != 2) return;
    if (!radius_) fail(ErrorCode::syntax, scanner_.path(), "is an ELLIPSOID-MESH without RADII");
    for (Vec2& p : f.points) p = (180 / std::numbers::pi) * p;
    put_on_sphere(f, *radius_, *document_.names);
  }
  void point_values(const std::string& name) {
    MeshFile& f = document_.file;
    const std::size_t n = scanner_.count("rows", 2);
    const std::size_t columns = scanner_.more_on_line() ? scanner_.count("columns", 1) : 1;
    constexpr std::size_t kMostColumns = 4096;
    if (columns < 1 || columns > kMostColumns)
      scanner_.fail_here(ErrorCode::syntax, name, " has ", columns, " columns; expected 1 to ", kMostColumns);
    if (name == "POWER" && columns != 1)
      scanner_.fail_here(ErrorCode::unsupported, "POWER has ", columns, " columns; expected one weight per point");
    scanner_.check_room(n * columns, "numbers", 2);
    std::vector<double> values(n * columns);
    for (double& value : values) value = scanner_.real(text("a number of ", name));
    if (name == "POWER") {
      f.weights = std::move(values);
      return;
    }
    const std::string_view array = name == "VALUE" ? kJigsawData[0].second : kJigsawData[1].second;
    if (find(f.point_data, array) != nullptr) scanner_.fail_here(ErrorCode::syntax, "has a second section ", name);
    if (n > 0) f.point_data.push_back({std::string(array), static_cast<int>(columns), std::move(values)});
  }
  void edges() {
    MeshFile& f = document_.file;
    const std::size_t n = scanner_.count("edges", 6);
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t a = scanner_.vertex(0);
      document_.names->line_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const std::int32_t b = scanner_.vertex(0);
      f.lines.add({a, b}, scanner_.integer("the tag of an edge"));
    }
  }
  void triangles() {
    MeshFile& f = document_.file;
    const std::size_t n = scanner_.count("triangles", 8);
    f.triangles.corners.reserve(f.triangles.size() + n);
    f.triangles.tags.reserve(f.triangles.size() + n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t a = scanner_.vertex(0);
      document_.names->triangle_lines.push_back(static_cast<std::int64_t>(scanner_.line()));
      const std::int32_t b = scanner_.vertex(0);
      const std::int32_t c = scanner_.vertex(0);
      f.triangles.add({a, b, c}, scanner_.integer("the tag of a triangle"));
    }
  }
  void other(const std::string& name) {
    const bool word = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
    if (!word) scanner_.fail_here(ErrorCode::syntax, "expected a section NAME=…, found ", in_quotes(name));
    const std::size_t n = scanner_.count("lines", 2);
    for (const auto& [cells, kind] : kOtherJigsawCells) {
      if (name != cells || n == 0) continue;
      scanner_.next_line();
      refuse_element(scanner_.where(), 0, kind, KindsOfCells::triangles);
    }
    if (n > 0) document_.file.warnings.push_back(text(scanner_.where(), ": section ", in_quotes(name), " is dropped"));
    scanner_.next_line();
    for (std::size_t i = 0; i < n; ++i) scanner_.next_line();
  }

  Document document_;
  Scanner scanner_;
  int dimension_ = 2;
  bool ellipsoid_ = false;
  std::optional<double> radius_;
};

// --- writing ---------------------------------------------------------------------------------------------

const std::vector<double>* jigsaw_values(const DataArray& array) {
  const bool named = std::any_of(std::begin(kJigsawData), std::end(kJigsawData),
                                 [&](const auto& row) { return row.second == array.name; });
  return named ? std::get_if<std::vector<double>>(&array.values) : nullptr;
}

void write_jigsaw_values(Output& out, std::string_view name, std::size_t columns, const std::vector<double>& values) {
  out.put(name, '=', values.size() / columns, ';', columns, '\n');
  for (std::size_t i = 0; i < values.size(); ++i) out.put(values[i], (i + 1) % columns == 0 ? '\n' : ';');
}

}  // namespace

Document read_jigsaw_mesh(Source& source) { return JigsawMeshReader(source).read(); }

bool jigsaw_keeps(Content of, const DataArray& array) { return of == kPointData && jigsaw_values(array) != nullptr; }

void write_jigsaw_mesh(const WriteJob& job) {
  const MeshFile& f = job.file;
  Output& out = job.outputs.open(job.path);
  const bool flat = job.is_flat();
  out.put("MSHID=3;EUCLIDEAN-MESH\nNDIMS=", flat ? 2 : 3, "\nPOINT=", f.points.size(), '\n');
  const auto tags = one_tag_a_point(job);
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const Vec3 p = job.place(i);
    out.put(p.x, ';', p.y, ';');
    if (!flat) out.put(p.z, ';');
    out.put(tags[i], '\n');
  }
  if (!f.weights.empty()) write_jigsaw_values(out, "POWER", 1, f.weights);
  for (const auto& [name, array] : kJigsawData) {
    const DataArray* data = find(f.point_data, array);
    const auto* values = data == nullptr ? nullptr : jigsaw_values(*data);
    if (values != nullptr) write_jigsaw_values(out, name, static_cast<std::size_t>(data->components), *values);
  }
  if (!f.lines.empty()) {
    out.put("EDGE2=", f.lines.size(), '\n');
    for (std::size_t i = 0; i < f.lines.size(); ++i)
      out.put(f.lines[i][0], ';', f.lines[i][1], ';', f.lines.tags[i], '\n');
  }
  out.put("TRIA3=", f.triangles.size(), '\n');
  for (std::size_t i = 0; i < f.triangles.size(); ++i) {
    const auto& t = f.triangles[i];
    out.put(t[0], ';', t[1], ';', t[2], ';', f.triangles.tags.empty() ? 0 : f.triangles.tags[i], '\n');
  }
}

}  // namespace temper::io

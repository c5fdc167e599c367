// Meshes of the ocean model FESOM: nod2d.out, elem2d.out, and aux3d.out if it exists (FESOM2 documentation, "Mesh").
//
//   nod2d.out    points, then: number longitude latitude flag     degrees; flag 1 on the coast, kept as data `flag`
//   elem2d.out   triangles, then: a b c                           numbers from 1
//   aux3d.out    levels, then the depth of each, then of each point: data `depth`, and field data `levels`
//                FESOM turns depths above 0. The data are positive down, and are turned again beside levels below 0
//   cavity_depth@node.out and others, kQuantities     numbers of each point or triangle: data `cavity_depth@node`
//   edges.out and others, kDerived                    what FESOM's fesom_ini.x makes of the mesh: named in a warning
//
// Before each name may be another one: pi.nod2d.out, pi.elem2d.out. The points are on a sphere of 6371 km.
#include <algorithm>
#include <array>
#include <set>

#include "io/conversion/bed.hpp"
#include "io/conversion/globe.hpp"
#include "io/disk/files.hpp"
#include "io/formats/format.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

constexpr std::string_view kPoints = "nod2d.out", kTriangles = "elem2d.out", kDepths = "aux3d.out";
constexpr std::string_view kFlag = "flag", kLevels = "levels", kOfPoints = "@node", kOfTriangles = "@elem",
                           kSuffix = ".out";
/// Files NAME@node.out have a row for each point, files NAME@elem.out one for each triangle.
constexpr std::array<std::string_view, 3> kQuantities = {"depth", "cavity_depth", "windstress"};
/// Numbers of edges and levels. fesom_ini.x does not replace them: they have to be gone.
constexpr std::array<std::string_view, 9> kDerived = {
    "edgenum.out", "edges.out",        "edge_tri.out",         "elvls.out",       "elvls_raw.out",
    "nlvls.out",   "cavity_elvls.out", "cavity_elvls_raw.out", "cavity_nlvls.out"};

enum class FesomFile { none, points, triangles };

bool is_whole_number(std::string_view word) {
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

/// A number alone on its line, then lines of four or three words: no other format begins this way.
FesomFile kind_of_fesom(std::string_view head) {
  Scanner scanner("", head);
  std::array<std::vector<std::string_view>, 2> lines;
  for (auto& words : lines) {
    if (scanner.at_end()) return FesomFile::none;
    while (scanner.more_on_line()) words.push_back(scanner.word("a number"));
  }
  const auto& row = lines[1];
  if (lines[0].size() != 1 || !is_whole_number(lines[0][0]) || row.empty() || !is_whole_number(row[0])) {
    return FesomFile::none;
  }
  if (row.size() == 4 && row[0] == "1" && looks_like_number(row[1]) && looks_like_number(row[2])) {
    return FesomFile::points;
  }
  const bool three = row.size() == 3 && std::all_of(row.begin(), row.end(), is_whole_number);
  return three ? FesomFile::triangles : FesomFile::none;
}

void turn(std::vector<double>& depth) {
  for (double& d : depth) d = 0 - d;
}

class FesomReader {
 public:
  explicit FesomReader(Source& source) : source_(source), document_(new_document(source.path)) {}

  Document read() {
    const bool is_points = kind_of_fesom(std::string_view(source_.bytes).substr(0, kSniffBytes)) == FesomFile::points;
    const std::string base = without_suffix(source_.path, is_points ? kPoints : kTriangles);
    const std::string other_path = base + std::string(is_points ? kTriangles : kPoints);
    if (base == source_.path) refuse_other_name(is_points);
    if (!exists(other_path)) {
      fail(ErrorCode::not_found, source_.path, "is the ", is_points ? "points" : "triangles", " of a FESOM mesh; its ",
           is_points ? "triangles are" : "points are", " expected in ", other_path, ", which does not exist");
    }
    Source other = load(other_path);
    document_.names->path = is_points ? source_.path : other_path;
    document_.names->triangle_path = is_points ? other_path : source_.path;
    points(is_points ? source_ : other);
    triangles(is_points ? other : source_);
    if (exists(base + std::string(kDepths))) depths(base + std::string(kDepths));
    MeshFile& f = document_.file;
    for (const std::string_view quantity : kQuantities) {
      add_quantity(base, text(quantity, kOfPoints), f.points.size(), f.point_data);
      add_quantity(base, text(quantity, kOfTriangles), f.triangles.size(), f.triangles.data);
    }
    return std::move(document_);
  }

 private:
  /// Nothing in such a file is FESOM's alone: METIS writes triangles in the same way.
  [[noreturn]] void refuse_other_name(bool is_points) const {
    fail(ErrorCode::unsupported, source_.path,
         is_points ? text("has points without triangles, as FESOM has them; expected a name that ends with ", kPoints,
                          ", and the triangles in ", kTriangles, " beside it")
                   : text("has triangles without points, as in files of METIS and FESOM. temper reads files of FESOM: "
                          "expected a name that ends with ",
                          kTriangles, ", and the points in ", kPoints, " beside it"));
  }
  void points(Source& source) {
    Scanner scanner(source.path, source.bytes);
    MeshFile& f = document_.file;
    const std::size_t n = scanner.count("points", 8);
    std::vector<std::int32_t> flags;
    for (std::size_t i = 0; i < n; ++i) {
      const auto number = scanner.integer("the number of a point");
      if (number != static_cast<std::int64_t>(i) + 1) {
        scanner.fail_here(ErrorCode::syntax, "expected point ", i + 1, ", found point ", number);
      }
      document_.names->points.push_back(number);
      document_.names->point_lines.push_back(static_cast<std::int64_t>(scanner.line()));
      const double longitude = scanner.real("the longitude of a point");
      f.points.push_back({longitude, scanner.real("the latitude of a point")});
      flags.push_back(scanner.integer("the flag of a point"));
    }
    f.point_data.push_back({std::string(kFlag), 1, std::move(flags)});
    put_on_sphere(f, Projection{}.radius, *document_.names);
  }

  void triangles(Source& source) {
    Scanner scanner(source.path, source.bytes);
    const std::size_t n = scanner.count("triangles", 6);
    for (std::size_t i = 0; i < n; ++i) {
      document_.names->triangles.push_back(static_cast<std::int64_t>(i) + 1);
      const std::int32_t a = scanner.vertex(1);
      document_.names->triangle_lines.push_back(static_cast<std::int64_t>(scanner.line()));
      const std::int32_t b = scanner.vertex(1);
      document_.file.triangles.corners.push_back({a, b, scanner.vertex(1)});
    }
  }

  void depths(const std::string& path) {
    const Source source = load(path);
    Scanner scanner(path, source.bytes);
    MeshFile& f = document_.file;
    std::vector<double> levels, depth;
    for (std::size_t n = scanner.count("levels", 2); levels.size() < n;) levels.push_back(scanner.real("a level"));
    while (depth.size() < f.points.size()) depth.push_back(scanner.real("the depth of a point"));
    if (std::ranges::none_of(depth, [](double d) { return d > 0; })) turn(depth);
    if (!levels.empty()) f.field_data.push_back({std::string(kLevels), 1, std::move(levels)});
    f.point_data.push_back({std::string(kDepth), 1, std::move(depth)});
  }

  /// Reads the file of that name if it exists: as many numbers in each of n rows.
  void add_quantity(const std::string& base, const std::string& name, std::size_t n, std::vector<DataArray>& data) {
    const std::string path = text(base, name, kSuffix);
    if (!exists(path)) return;
    const Source source = load(path);
    Scanner scanner(path, source.bytes);
    std::vector<double> values;
    while (!scanner.at_end()) values.push_back(scanner.real("a number"));
    if (n > 0 && !values.empty() && values.size() % n == 0 && values.size() / n <= kMostComponents) {
      data.push_back({name, static_cast<int>(values.size() / n), std::move(values)});
      return;
    }
    document_.file.warnings.push_back(text(path, ": has ", values.size(), " numbers for ", n,
                                           name.ends_with(kOfPoints) ? " points" : " triangles",
                                           ", and is left out. Next: see whether it is of this mesh"));
  }

  static constexpr std::size_t kMostComponents = 9;
  Source& source_;
  Document document_;
};

// --- writing ---------------------------------------------------------------------------------------------

/// The part before the names of the files; "NAME." for another NAME.
std::string fesom_base(const std::string& path) {
  std::string base = without_suffix(without_suffix(path, kPoints), kTriangles);
  return base == path ? base + "." : base;
}

/// The flags that came with the points; without them 1 for points on the boundary.
std::vector<std::int32_t> flags_of(const MeshFile& f) {
  if (const DataArray* flags = find(f.point_data, kFlag); flags != nullptr && flags->components == 1) {
    if (auto known = to_int32(flags->values)) return *std::move(known);
  }
  std::vector<std::array<std::int32_t, 2>> sides;
  for (const auto& [a, b, c] : f.triangles) {
    for (const auto& side : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
      sides.push_back({std::min(side[0], side[1]), std::max(side[0], side[1])});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::int32_t> flags(f.points.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool twice = (i > 0 && sides[i] == sides[i - 1]) || (i + 1 < sides.size() && sides[i] == sides[i + 1]);
    if (twice) continue;
    for (const std::int32_t p : sides[i]) flags[static_cast<std::size_t>(p)] = 1;
  }
  return flags;
}

/// The numbers of that name; none when they are not there.
std::vector<double> numbers_of(const std::vector<DataArray>& arrays, std::string_view name) {
  const DataArray* array = find(arrays, name);
  return array == nullptr || array->components != 1 ? std::vector<double>() : to_doubles(Values(array->values));
}

/// The kind of values that a name with its place says: `depth@node` of points. Nothing: the name is of no such file.
std::optional<Content> place_of_quantity(std::string_view name) {
  for (const std::string_view quantity : kQuantities) {
    if (name == text(quantity, kOfPoints)) return kPointData;
    if (name == text(quantity, kOfTriangles)) return kCellData;
  }
  return {};
}

/// All files of numbers of points or triangles, in the order in which they are read.
std::vector<std::string> quantity_files(const std::string& base) {
  std::vector<std::string> files;
  for (const std::string_view quantity : kQuantities) {
    for (const std::string_view place : {kOfPoints, kOfTriangles})
      files.push_back(text(base, quantity, place, kSuffix));
  }
  return files;
}

/// Writes what is there, and returns the paths.
std::set<std::string> write_quantities(const WriteJob& job, const std::string& base) {
  std::set<std::string> written;
  for (const Content place : {kPointData, kCellData}) {
    for (const DataArray& array : data_of(job.file, place)) {
      if (place_of_quantity(array.name) != place) continue;
      Output& out = job.outputs.open(*written.insert(text(base, array.name, kSuffix)).first);
      const std::vector<double> values = to_doubles(Values(array.values));
      const auto components = static_cast<std::size_t>(array.components);
      for (std::size_t i = 0; i < values.size(); ++i) out.put(values[i], (i + 1) % components == 0 ? '\n' : ' ');
    }
  }
  return written;
}

/// Writes depths and levels; says whether there were any.
bool write_depths(const WriteJob& job, const std::string& path) {
  const MeshFile& f = job.file;
  const std::vector<double> levels = numbers_of(f.field_data, kLevels);
  std::vector<double> depth = numbers_of(f.point_data, kDepth);
  if (std::ranges::any_of(levels, [](double level) { return level < 0; })) turn(depth);
  if (depth.empty()) {
    if (!levels.empty()) job.warn("field data ", kLevels, " are not written: FESOM has levels with depths alone");
    return false;
  }
  if (levels.empty()) {
    job.warn("there are depths, and no levels: ", kDepths,
             " has 0 levels. Next: put the number of levels of your model "
             "on its first line, and the levels on the lines after it");
  }
  Output& depths = job.outputs.open(path);
  depths.put(levels.size(), '\n');
  for (const double level : levels) depths.put(level, '\n');
  for (const double d : depth) depths.put(d, '\n');
  return true;
}

/// The names, without the folder, of those files that exist.
std::string existing(const std::vector<std::string>& files) {
  std::string names;
  for (const std::string& file : files) {
    if (exists(file)) names += text(names.empty() ? "" : ", ", file.substr(file.find_last_of("/\\") + 1));
  }
  return names;
}
std::vector<std::string> derived_files(const std::string& base) {
  std::vector<std::string> files;
  for (const std::string_view name : kDerived) files.push_back(text(base, name));
  return files;
}

/// Names the files of another mesh that FESOM would read beside this one.
void warn_of_former(const WriteJob& job, const std::string& base, const std::set<std::string>& written) {
  std::vector<std::string> others = quantity_files(base);
  others.push_back(base + std::string(kDepths));
  std::erase_if(others, [&](const std::string& file) { return written.contains(file); });
  if (const std::string names = existing(others); !names.empty()) {
    job.warn("beside it stay ", names,
             ", which are not of this mesh: it has no such data. Next: remove them, or make "
             "them for the new points and triangles");
  }
  constexpr std::string_view kMaker = "let FESOM's fesom_ini.x make them, and the parts in dist_*, for this mesh";
  if (const std::string names = existing(derived_files(base)); !names.empty()) {
    job.warn("beside it stay ", names, ", the edges and levels of the mesh before. Next: remove them, and ", kMaker);
    return;
  }
  const MeshFile& f = job.file;
  const std::string names = f.format == "fesom" ? existing(derived_files(fesom_base(f.path))) : std::string();
  if (!names.empty())
    job.warn(names, " beside ", f.path, " are the edges and levels of the mesh there. Next: ", kMaker);
}

}  // namespace

bool sniff_fesom(std::string_view head) { return kind_of_fesom(head) != FesomFile::none; }

Document read_fesom(Source& source) { return FesomReader(source).read(); }

std::vector<std::string> fesom_files(const std::string& path) {
  const std::string base = fesom_base(path);
  std::vector<std::string> files = quantity_files(base);
  files.insert(files.begin(),
               {base + std::string(kPoints), base + std::string(kTriangles), base + std::string(kDepths)});
  return files;
}

bool fesom_keeps(Content of, const DataArray& array) {
  if (of != kFieldData && place_of_quantity(array.name) == of) return true;
  if (of == kPointData) return array.name == kFlag || array.name == kDepth;
  return of == kFieldData && array.name == kLevels;
}

void write_fesom(const WriteJob& job) {
  const MeshFile& f = job.file;
  const std::string base = fesom_base(job.path);
  Output& points = job.outputs.open(base + std::string(kPoints));
  const std::vector<std::int32_t> flags = flags_of(f);
  points.put(f.points.size(), '\n');
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    points.put(i + 1, ' ', f.points[i].x, ' ', f.points[i].y, ' ', flags[i], '\n');
  }
  Output& triangles = job.outputs.open(base + std::string(kTriangles));
  triangles.put(f.triangles.size(), '\n');
  for (const auto& [a, b, c] : f.triangles) triangles.put(a + 1, ' ', b + 1, ' ', c + 1, '\n');
  std::set<std::string> written = write_quantities(job, base);
  if (write_depths(job, base + std::string(kDepths))) written.insert(base + std::string(kDepths));
  warn_of_former(job, base, written);
}

}  // namespace temper::io

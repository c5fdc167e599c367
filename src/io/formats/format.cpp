// PATH.weights.csv: the weights of a mesh whose own format has no place for them.
//
//   point,weight
//   1,0.25          the file's own number of the point, and its weight: one row per point, in the order of the file
#include "io/formats/format.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "io/conversion/globe.hpp"
#include "io/conversion/known_arrays.hpp"
#include "io/conversion/update.hpp"
#include "io/disk/files.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {

Document new_document(const std::string& path) { return {MeshFile{}, std::make_shared<FileNames>(path)}; }

namespace {

void check_range(const Document& d, std::int32_t point, const std::string& element, const std::string& where) {
  const auto n = d.file.points.size();
  if (point >= 0 && static_cast<std::size_t>(point) < n) return;
  fail(ErrorCode::index_out_of_range, where, element, " uses vertex ", d.names->points[point], ", but the file has ", n,
       " vertices, numbered from ", d.names->points[0]);
}

void check_ranges(const Document& d) {
  const MeshFile& f = d.file;
  const auto outside = [n = f.points.size()](std::int32_t p) { return p < 0 || static_cast<std::size_t>(p) >= n; };
  for (std::size_t t = 0; t < f.triangles.size(); ++t) {
    for (const std::int32_t p : f.triangles[t]) {
      if (outside(p)) check_range(d, p, d.names->triangle(t), d.names->triangle_where(t));
    }
  }
  for (std::size_t t = 0; t < f.tetrahedra.size(); ++t) {
    for (const std::int32_t p : f.tetrahedra[t]) {
      if (outside(p)) check_range(d, p, d.names->tetrahedron(t), d.names->tetrahedron_where(t));
    }
  }
  for (std::size_t l = 0; l < f.lines.size(); ++l) {
    for (const std::int32_t p : f.lines[l]) {
      if (outside(p)) check_range(d, p, d.names->line(l), d.names->line_where(l));
    }
  }
  for (std::size_t t = 0; t < d.fourth_corners.size(); ++t) {
    const std::int32_t p = d.fourth_corners[t];
    if (p != kNoCorner && outside(p)) check_range(d, p, d.names->triangle(t), d.names->triangle_where(t));
  }
  for (const std::int32_t p : f.marked_points) {
    if (outside(p)) check_range(d, p, "a marked point", d.names->path);
  }
}

void check_weights(const Document& d) {
  const std::vector<double>& weights = d.file.weights;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (std::isfinite(weights[i])) continue;
    fail(ErrorCode::not_finite, d.names->point_where(i), d.names->point(i), " has weight ", weights[i],
         ", expected a finite number");
  }
}

/// Points on one parallel of a sphere are in a plane, too: nothing in the file decides between the two.
void warn_of_parallel(Document& d) {
  std::vector<Vec3> places;
  for (const Vec2 p : d.file.points) places.push_back({p.x, p.y, d.z});
  const auto radius = common_radius(places);
  if (!radius) return;
  d.file.warnings.push_back(text(d.names->path, ": all points have z = ", d.z, " and are ", *radius,
                                 " from the origin: taken for a mesh in a plane, though they are also on one parallel "
                                 "of a sphere"));
}

[[noreturn]] void refuse_place(const Document& d, std::size_t i) {
  const Vec3 p = d.place(i);
  const std::string z = d.file.dimension() == 3 || !d.heights.empty() ? text(", ", p.z) : "";
  fail(ErrorCode::not_finite, d.names->point_where(i), d.names->point(i), " has coordinates (", p.x, ", ", p.y, z,
       "), expected finite numbers. Next: give its place");
}

/// Takes z of the points as point data of a mesh of the plane.
void make_z_data(Document& d) {
  MeshFile& f = d.file;
  for (std::size_t i = 0; i < d.heights.size(); ++i) {
    if (!std::isfinite(d.heights[i]))
      fail(ErrorCode::not_finite, d.names->point_where(i), d.names->point(i), " has z = ", d.heights[i],
           ", expected a finite number");
  }
  f.set_z(0);
  f.z_is_data = true;
  f.point_data.insert(f.point_data.begin(), {std::string(kHeight), 1, std::move(d.heights)});
  d.may_be_degrees = std::holds_alternative<PlanePoints>(f.points_in);
}

/// Gives the bed the sign that the user says. Without it, z that is data is a height, and a warning says so: SCHISM has
/// depths in 2DM files.
void settle_bed(Document& d, std::optional<Positive> positive) {
  MeshFile& f = d.file;
  if (positive) f.positive = positive;
  if (positive && bed_of(f) == nullptr) {
    f.warnings.push_back(text(d.names->path, ": has no depths or heights of a bed, so positive ",
                              *positive == Positive::up ? "up" : "down", " has no effect"));
  }
  if (f.positive || !details_of(f).has_heights || !f.z_is_data) return;
  f.positive = Positive::up;
  f.warnings.push_back(text(d.names->path,
                            ": z is taken as heights, positive up. Next: --positive down if they are depths, or "
                            "--positive up to confirm (positive=\"down\" or \"up\" in Python)"));
}

/// A surface has triangles alone.
void drop_quadrilaterals(MeshFile& f) {
  const std::size_t n = quadrilaterals_of(f).size();
  if (n == 0) return;
  std::erase_if(f.triangles.data, [](const DataArray& array) { return array.name == kQuadrilateral; });
  f.warnings.push_back(
      text(n, n == 1 ? " quadrilateral of a curved surface is" : " quadrilaterals of a curved surface are",
           " cut into two triangles", n == 1 ? "" : " each"));
}

void guess_degrees(Document& d) {
  MeshFile& f = d.file;
  if (!d.may_be_degrees || f.is_surface()) return;
  const DataArray* const bed = bed_of(f);
  const std::vector<double> heights = bed == nullptr ? std::vector<double>() : to_doubles(Values(bed->values));
  if (look_like_degrees(f.points, heights)) f.points_in = DegreePoints{.is_guessed = true, .z = f.z()};
}

void check_tetrahedra(Document& d) {
  MeshFile& f = d.file;
  if (f.points.empty())
    fail(ErrorCode::empty_input, d.names->path, "the file has tetrahedra, and no points. Next: write its points, too");
  const auto quadrilateral = std::find_if(d.fourth_corners.begin(), d.fourth_corners.end(),
                                          [](std::int32_t corner) { return corner != kNoCorner; });
  if (quadrilateral != d.fourth_corners.end()) {
    const auto t = static_cast<std::size_t>(quadrilateral - d.fourth_corners.begin());
    refuse_beside_tetrahedra(d.names->triangle_where(t), d.names->triangle(t));
  }
  check_ranges(d);
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const Vec3 p = d.place(i);
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) refuse_place(d, i);
  }
  check_weights(d);
  if (d.heights.empty()) d.heights.assign(f.points.size(), d.z);
  f.points_in = SpacePoints{std::move(d.heights)};
  f.triangles.tags.resize(f.triangles.size());
}

}  // namespace

void check(Document& d, const ReadOptions& options) {
  MeshFile& f = d.file;
  if (f.dimension() == 3) return check_tetrahedra(d);
  if (f.points.empty()) fail(ErrorCode::empty_input, d.names->path, "the file has no points");
  if (f.triangles.empty()) {
    // Other programs call outlines meshes.
    const bool outline = details_of(f).may_be_outline && !f.lines.empty();
    fail(ErrorCode::empty_input, d.names->path, "the file has no triangles",
         outline ? ": it is an outline, for `temper mesh` to mesh" : " or tetrahedra");
  }
  check_ranges(d);
  cut_quadrilaterals(f, *d.names, d.fourth_corners, d.heights);
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    if (!std::isfinite(f.points[i].x) || !std::isfinite(f.points[i].y)) refuse_place(d, i);
  }
  if (!std::isfinite(d.z)) fail(ErrorCode::not_finite, d.names->point_where(0), d.names->point(0), " has z = ", d.z);
  d.file.set_z(d.z);
  if (!d.heights.empty() && options.flat) {
    make_z_data(d);
  } else if (!d.heights.empty()) {
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < f.points.size(); ++i) places.push_back({f.points[i].x, f.points[i].y, d.heights[i]});
    const bool is_periodic = f.periodic() != nullptr;
    settle_points(d.file, std::move(places), *d.names);
    if (f.is_surface()) drop_quadrilaterals(f);
    if (is_periodic && f.sphere() != nullptr)
      fail(ErrorCode::unsupported, d.names->path, "has periods and points on a sphere; expected points of a plane");
  } else if (d.z != 0 && f.sphere() == nullptr) {
    warn_of_parallel(d);
  }
  check_weights(d);
  settle_bed(d, options.positive);
  guess_degrees(d);
}

namespace {

/// The next step for an element that is not read, or nothing.
std::string_view next_for(std::string_view kind, KindsOfCells read) {
  constexpr std::string_view kSolids[] = {"hexahedron", "voxel", "prism", "wedge", "pyramid"};
  const bool quadrilaterals = read == KindsOfCells::faces || read == KindsOfCells::all;
  const bool tetrahedra = read == KindsOfCells::simplices || read == KindsOfCells::all;
  if (kind.starts_with("quadratic") || kind.starts_with("Lagrange")) return ". Next: write linear elements";
  if (kind == "quadrilateral" && !quadrilaterals) return kNextForQuadrilaterals;
  if (kind == "tetrahedron" && !tetrahedra) return kNextForTetrahedra;
  if (tetrahedra && std::ranges::find(kSolids, kind) != std::end(kSolids))
    return ". Next: split it into tetrahedra, as triangulate() of PyVista does";
  return {};
}

}  // namespace

void refuse_element(const std::string& where, std::int64_t number, std::string_view kind, KindsOfCells read) {
  constexpr std::string_view kRead[] = {"in this format temper reads linear triangles",
                                        "temper reads linear triangles and quadrilaterals",
                                        "in this format temper reads linear triangles and tetrahedra",
                                        "temper reads linear triangles, quadrilaterals and tetrahedra"};
  fail(ErrorCode::unsupported, where, "element ", number, kind.starts_with('e') ? " is an " : " is a ", kind, "; ",
       kRead[static_cast<std::size_t>(read)], ", with lines and points as tags", next_for(kind, read));
}

void refuse_beside_tetrahedra(const std::string& where, std::string_view name) {
  fail(ErrorCode::unsupported, where, name,
       " is a quadrilateral beside tetrahedra; expected triangles as their tagged faces. Next: split it into "
       "triangles, or remove it");
}

std::string side_file_path(const std::string& path) { return path + ".weights.csv"; }

void read_side_file(Document& document) {
  MeshFile& f = document.file;
  const std::string path = side_file_path(document.names->path);
  if (!f.weights.empty() || is_stream(document.names->path) || !exists(path)) return;
  Source source = load(path);
  // A comma is a blank here, so that the scanner finds its words.
  for (char& c : source.bytes) {
    if (c == ',' || c == ';') c = ' ';
  }
  Scanner scanner(path, source.bytes);
  for (const std::string_view title : {"point", "weight"}) {
    const std::string_view found = scanner.word("the title line 'point,weight'");
    if (found != title)
      scanner.fail_here(ErrorCode::syntax, "expected the title line 'point,weight', found ", in_quotes(found));
  }
  std::vector<double> weights;
  weights.reserve(f.points.size());
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    const std::int64_t expected = document.names->points[static_cast<std::int64_t>(i)];
    if (scanner.at_end()) {
      scanner.fail_here(ErrorCode::size_mismatch, "has ", i, " weights, but ", document.names->path, " has ",
                        f.points.size(), " points");
    }
    const auto number = scanner.number<std::int64_t>("the number of a point");
    if (number != expected) {
      scanner.fail_here(ErrorCode::index_out_of_range, "expected the weight of point ", expected, ", found point ",
                        number);
    }
    weights.push_back(scanner.real("a weight"));
    if (!std::isfinite(weights.back())) {
      scanner.fail_here(ErrorCode::not_finite, "point ", number, " has weight ", weights.back(),
                        ", expected a finite number");
    }
  }
  if (!scanner.at_end()) {
    scanner.fail_here(ErrorCode::size_mismatch, "has more weights than ", document.names->path, " has points (",
                      f.points.size(), ")");
  }
  f.weights = std::move(weights);
}

void write_side_file(const WriteJob& job) {
  const MeshFile& f = job.file;
  const std::string path = side_file_path(job.path);
  const bool weighted = is_weighted(f);
  if (is_stream(job.path)) {
    if (weighted)
      job.warn("the format has no place for weights, and a stream has no file next to it: they are left out");
    return;
  }
  // An old side file would give its weights to this mesh, so it has to be replaced.
  if (!weighted && !exists(path)) return;
  Output& out = job.outputs.open(path);
  out.put("point,weight\n", "");
  for (std::size_t i = 0; i < f.points.size(); ++i) {
    out.put(job.row.details.first_point + static_cast<std::int64_t>(i), ',', f.weights.empty() ? 0.0 : f.weights[i],
            '\n');
  }
  job.warn("the format has no place for weights; they are in ", path);
}

// Warnings of unsupported_content, for all formats: they name the parts of a mesh file for which the written format has
// no place.

namespace {

constexpr std::pair<Content, std::string_view> kKindsOfArrays[] = {{kPointData, "point data"},
                                                                   {kCellData, "cell data"},
                                                                   {kLineData, "line data"},
                                                                   {kMarkedPointData, "data of marked points"},
                                                                   {kFieldData, "field data"}};

std::string has_no_place_for(const WriteJob& job, std::string_view what) {
  return text(" not written, ", job.row.description, " has no place for ", what);
}

}  // namespace

std::string WriteJob::written(std::string_view name) const {
  if (row.details.name_ends.empty() || name.find_first_of(row.details.name_ends) == std::string_view::npos)
    return std::string(name);
  std::string result;
  for (const char c : name) {
    if (row.details.name_ends.find(c) == std::string_view::npos) {
      result += c;
    } else {
      append_percent(result, c);
    }
  }
  warn("the name '", name, "' is written as '", result, "': in ", row.description, " it would end early");
  return result;
}

void warn_of_losses(const WriteJob& job) {
  const MeshFile& f = job.file;
  const FormatRow& row = job.row;
  const auto lost = [&row](Content content) { return (row.holds & content) == 0; };
  const bool tets = f.dimension() == 3;
  const std::string_view axis = name_of_axis(normal_of(f));
  if (!tets && lost(kZ) && f.sphere() == nullptr && !is_flat(f))
    job.warn(axis, " = ", f.z(), " of the points is", has_no_place_for(job, "it"));
  if (!lost(kZ) && normal_of(f) != kZAxis && !row.is_in_space())
    job.warn("the plane of ", axis, " = ", f.z(), " is written as one of z");
  const bool has_regions =
      std::any_of(f.triangles.tags.begin(), f.triangles.tags.end(), [](std::int32_t r) { return r != 0; });
  if (lost(kRegions) && has_regions) job.warn("regions are", has_no_place_for(job, "them"));
  if (lost(kLines) && !f.lines.empty()) job.warn("lines are", has_no_place_for(job, "them"));
  if (const std::size_t n = lost(kQuadrilaterals) ? quadrilaterals_of(f).size() : 0; n > 0)
    job.warn(n, n == 1 ? " quadrilateral is" : " quadrilaterals are",
             " written as two triangles each, as temper writes no quadrilaterals in ", row.description);
  if (lost(kLineData) && find(f.lines.data, kFace) != nullptr)
    job.warn("faces on lines are", has_no_place_for(job, "them"), ", and will not stay when this file is optimized");
  if (lost(kMarkedPoints) && !f.marked_points.empty()) job.warn("marked points are", has_no_place_for(job, "them"));
  for (const auto& [content, name] : kKindsOfArrays) {
    const bool of_faces = tets && content == kCellData;  // a format with data of lines has data of faces
    if (!lost(of_faces ? kLineData : content)) continue;
    std::vector<std::string_view> names;
    for (const DataArray& a : data_of(f, content)) {
      if (a.name == kQuadrilateral || (a.name == kFace && content == kLineData) || a.name == kCornerWeights) continue;
      if (row.details.keeps == nullptr || !row.details.keeps(content, a)) names.push_back(a.name);
    }
    warn_of_arrays(job, of_faces ? "face data" : name, names);
  }
  if (tets && lost(kCellData)) {
    std::vector<std::string_view> names;
    for (const DataArray& a : f.tetrahedra.data) {
      if (a.name != kCornerWeights) names.push_back(a.name);
    }
    warn_of_arrays(job, "cell data", names);
  }
  if (lost(kNames)) warn_of_names(job, f.names);
}

void warn_of_arrays(const WriteJob& job, std::string_view kind, const std::vector<std::string_view>& names) {
  if (!names.empty()) job.warn(kind, " is", has_no_place_for(job, "it: "), list_of(names));
}

void warn_of_names(const WriteJob& job, const std::vector<PhysicalName>& lost) {
  if (lost.empty()) return;
  std::vector<std::string_view> names;
  names.reserve(lost.size());
  for (const PhysicalName& n : lost) names.push_back(n.name);
  job.warn("physical names are", has_no_place_for(job, "them: "), list_of(names));
}

std::vector<std::int32_t> one_tag_a_point(const WriteJob& job) {
  const MeshFile& f = job.file;
  std::vector<std::int32_t> tags(f.points.size());
  std::size_t lost = 0;
  std::map<std::int32_t, std::string> lost_tags;
  for (std::size_t i = 0; i < f.marked_points.size(); ++i) {
    std::int32_t& tag = tags[static_cast<std::size_t>(f.marked_points[i])];
    if (tag == 0) {
      tag = f.marked_points.tags[i];
    } else if (tag != f.marked_points.tags[i]) {
      ++lost;
      lost_tags.emplace(f.marked_points.tags[i], text(f.marked_points.tags[i]));
    }
  }
  if (lost == 0) return tags;
  for (const PhysicalName& n : f.names) {
    const auto found = lost_tags.find(n.tag);
    if (n.dimension == 0 && found != lost_tags.end()) found->second = n.name;
  }
  std::vector<std::string_view> names;
  names.reserve(lost_tags.size());
  for (const auto& [tag, name] : lost_tags) names.push_back(name);
  job.warn(lost, lost == 1 ? " further tag of a point that has" : " further tags of points that have", " one already ",
           lost == 1 ? "is" : "are", " not written: ", list_of(names), "; ", job.row.description,
           " holds one per point");
  return tags;
}

}  // namespace temper::io

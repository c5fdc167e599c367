// The table of formats, and the two doors of io: read and write.
//
// A new format is one source file with a sniff, a read and maybe a write, and one row here.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <new>

#include "io/format.hpp"
#include "io/scanner.hpp"

namespace temper::io {

namespace {

constexpr FormatRow kRows[] = {
    {{"vtu", "VTK XML unstructured grid, temper's own", ".vtu", true, true}, sniff_vtu, read_vtu, write_vtu},
    {{"gmsh41", "Gmsh MSH 4.1", ".msh .msh4", true, true}, sniff_gmsh41, read_gmsh, write_gmsh41},
    {{"gmsh22", "Gmsh MSH 2.2", ".msh2", true, true}, sniff_gmsh22, read_gmsh, write_gmsh22},
    {{"medit", "medit (INRIA, Mmg)", ".mesh", true, false}, sniff_medit, read_medit, write_medit},
    {{"obj", "Wavefront OBJ", ".obj", true, false}, sniff_obj, read_obj, write_obj},
    {{"vtk", "legacy VTK", ".vtk", false, true}, sniff_legacy_vtk, read_legacy_vtk, nullptr},
    {{"mfem", "MFEM mesh v1.0", ".mesh", false, false}, sniff_mfem, read_mfem, nullptr},
    {{"triangle", "Triangle", ".node .ele", true, true}, sniff_triangle, read_triangle, write_triangle},
};

template <std::size_t... I>
constexpr std::array<Format, sizeof...(I)> columns(std::index_sequence<I...>) {
  return {kRows[I].format...};
}
constexpr auto kFormats = columns(std::make_index_sequence<std::size(kRows)>());

const FormatRow& recognise(const Source& source) {
  const std::string_view head = std::string_view(source.bytes).substr(0, kSniffBytes);
  for (const FormatRow& row : kRows) {
    if (row.sniff(head)) return row;
  }
  if (const std::string_view known = recognise_unsupported(head); !known.empty()) {
    fail(ErrorCode::unsupported, source.path, text("is ", known, ", which temper does not read"));
  }
  std::string names;
  for (const Format& format : kFormats) names += text(names.empty() ? "" : ", ", format.description);
  fail(ErrorCode::syntax, source.path, text("is none of the formats that temper reads: ", names));
}

MeshFile read_or_throw(const std::string& path, const ReadOptions& options) {
  Source source = load(path);
  source.executor = options.executor;
  const FormatRow& row = recognise(source);
  Document document = row.read(source);
  std::string().swap(source.bytes);
  if (document.file.format.empty()) document.file.format = row.format.name;
  check(document);
  read_side_file(document);
  document.file.path = path;
  document.file.numbering = document.names;
  constexpr std::size_t kLarge = std::size_t{1} << 20;  // below it does not count, and reading is fast
  if (document.file.points.size() + document.file.triangles.size() > kLarge) give_memory_back();
  return std::move(document.file);
}

bool has_suffix(const Format& format, const std::string& path) {
  std::string_view left = format.suffixes;
  while (!left.empty()) {
    const std::size_t end = std::min(left.find(' '), left.size());
    if (path.ends_with(left.substr(0, end))) return true;
    left.remove_prefix(std::min(end + 1, left.size()));
  }
  return false;
}

std::string writable_suffixes() {
  std::string result;
  for (const Format& format : kFormats) {
    if (format.writes) result += text(result.empty() ? "" : " ", format.suffixes);
  }
  return result;
}

std::string writable_names() {
  std::string result;
  for (const Format& format : kFormats) {
    if (format.writes) result += text(result.empty() ? "" : ", ", format.name);
  }
  return result;
}

const FormatRow& row_to_write(const std::string& path, const WriteOptions& options) {
  if (!options.format.empty()) {
    for (const FormatRow& row : kRows) {
      if (row.format.name == options.format && row.write != nullptr) return row;
    }
    fail(ErrorCode::invalid_option, path,
         text("cannot be written as '", options.format, "'; expected one of ", writable_names()));
  }
  for (const FormatRow& row : kRows) {
    if (row.write != nullptr && has_suffix(row.format, path)) return row;
  }
  fail(ErrorCode::invalid_option, path,
       text("the suffix names no format that temper writes; expected one of ", writable_suffixes(), ", or a format"));
}

/// The arrays of a file made by hand must fit each other, or writers would read past their ends.
void check_sizes(const std::string& path, const MeshFile& f) {
  const auto insist = [&](bool good, std::string_view what) {
    if (!good) fail(ErrorCode::size_mismatch, path, text("the mesh to be written has ", what));
  };
  insist(f.weights.empty() || f.weights.size() == f.points.size(), "another number of weights than of points");
  insist(f.regions.empty() || f.regions.size() == f.triangles.size(), "another number of regions than of triangles");
  insist(f.line_tags.size() == f.lines.size(), "another number of line tags than of lines");
  insist(f.point_tags.size() == f.marked_points.size(), "another number of point tags than of marked points");
  const auto check_data = [&](const std::vector<DataArray>& arrays, std::size_t n, std::string_view kind) {
    for (const DataArray& a : arrays) {
      const std::size_t have = std::visit([](const auto& v) { return v.size(); }, a.values);
      insist(a.components >= 1 && have == n * static_cast<std::size_t>(a.components),
             text(kind, " ", quoted(a.name), " with ", have, " values, expected ", n, " times ", a.components));
    }
  };
  check_data(f.point_data, f.points.size(), "point data");
  check_data(f.cell_data, f.triangles.size(), "cell data");
  check_data(f.line_data, f.lines.size(), "line data");
  check_data(f.marked_point_data, f.marked_points.size(), "data of marked points");
  const auto n = f.points.size();
  const auto in_range = [n](std::int32_t p) { return p >= 0 && static_cast<std::size_t>(p) < n; };
  for (const auto& t : f.triangles)
    insist(std::all_of(t.begin(), t.end(), in_range), "a triangle with a vertex that is none");
  for (const auto& l : f.lines) insist(std::all_of(l.begin(), l.end(), in_range), "a line with a vertex that is none");
  insist(std::all_of(f.marked_points.begin(), f.marked_points.end(), in_range), "a marked point that is none");
}

/// Runs work; whatever stops it comes back as a value.
template <class Result, class Work>
Expected<Result> guarded(const std::string& path, Work work) {
  try {
    return work();
  } catch (Failure& failure) {
    return std::move(failure.error);
  } catch (const std::bad_alloc&) {
    return InputError{ErrorCode::unsupported, path, "needs more memory than there is"};
  }
}

}  // namespace

std::span<const Format> formats() { return kFormats; }

Expected<MeshFile> read(const std::string& path, const ReadOptions& options) {
  return guarded<MeshFile>(path, [&] { return read_or_throw(path, options); });
}

Expected<std::vector<std::string>> write(const std::string& path, const MeshFile& file, const WriteOptions& options) {
  return guarded<std::vector<std::string>>(path, [&] {
    const FormatRow& row = row_to_write(path, options);
    check_sizes(path, file);
    std::vector<std::string> warnings;
    OutputSet outputs;
    row.write({path, file, options.encoding, options.executor, outputs, warnings});
    outputs.commit();
    return warnings;
  });
}

Expected<void> write_text(const std::string& path, std::string_view content) {
  try {
    OutputSet outputs;
    outputs.open(path).put(content);
    outputs.commit();
    return {};
  } catch (Failure& failure) {
    return std::move(failure.error);
  }
}

void warn_of_data(const WriteJob& job, std::string_view format, std::string_view kind,
                  const std::vector<DataArray>& arrays) {
  std::string names;
  for (const DataArray& a : arrays) names += text(names.empty() ? "" : ", ", a.name);
  if (!names.empty()) job.warn(text(kind, " is not written, ", format, " has no place for it: ", names));
}

void warn_of_names(const WriteJob& job, std::string_view format) {
  std::string names;
  for (const PhysicalName& n : job.file.names) names += text(names.empty() ? "" : ", ", n.name);
  if (!names.empty()) job.warn(text("physical names are not written, ", format, " has no place for them: ", names));
}

}  // namespace temper::io

// See cells.hpp. A region or tag is the first of these cell arrays that exists with one integer per cell. They are
// region (temper's own), gmsh:physical and medit:ref (names of meshio), and the usual names among users of VTK.
#include "io/formats/cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

constexpr std::array<std::string_view, 9> kRegionNames = {"region",        "gmsh:physical", "medit:ref",
                                                          "CellEntityIds", "mat_id",        "MaterialIds",
                                                          "material",      "subdomain",     "attribute"};

}  // namespace

std::string_view vtk_cell_name(int type) {
  constexpr std::array<std::string_view, 15> kNames = {
      "empty cell", "vertex",        "poly-vertex", "line",  "poly-line",  "triangle", "triangle strip", "polygon",
      "pixel",      "quadrilateral", "tetrahedron", "voxel", "hexahedron", "wedge",    "pyramid"};
  if (type >= 0 && static_cast<std::size_t>(type) < kNames.size()) return kNames[static_cast<std::size_t>(type)];
  if (type == 21) return "quadratic edge";
  if (type == 22) return "quadratic triangle";
  if (type == 24) return "quadratic tetrahedron";
  if (type == 69) return "Lagrange triangle";
  return "cell of a type that is no simplex";
}

void CellSorter::add(int type, const std::int32_t* p, std::size_t n, const std::string& where) {
  MeshFile& f = document_.file;
  const auto cell = static_cast<std::int64_t>(n_cells_++);
  const bool fits = type == kVtkTriangle      ? n == 3
                    : type == kVtkLine        ? n == 2
                    : type == kVtkVertex      ? n == 1
                    : type == kVtkPolyLine    ? n >= 2
                    : type == kVtkPixel       ? n == 4
                    : type == kVtkQuad        ? n == 4
                    : type == kVtkTetrahedron ? n == 4
                                              : true;
  if (!fits) fail(ErrorCode::syntax, where, "element ", cell, " is a ", vtk_cell_name(type), " with ", n, " vertices");
  switch (type) {
    case kVtkPolygon:
      if (n != 3 && n != 4) refuse_element(where, cell, text("polygon with ", n, " corners"));
      [[fallthrough]];
    case kVtkTriangle:
    case kVtkQuad:
      document_.add_face({p[0], p[1], p[2]}, n == 4 ? p[3] : kNoCorner);
      cells_of_[2].push_back(cell);
      return;
    case kVtkTetrahedron:
      document_.file.tetrahedra.corners.push_back({p[0], p[1], p[2], p[3]});
      cells_of_[3].push_back(cell);
      return;
    case kVtkPixel:  // in rows
      document_.add_face({p[0], p[1], p[3]}, p[2]);
      cells_of_[2].push_back(cell);
      return;
    case kVtkLine:
    case kVtkPolyLine:
      for (std::size_t k = 0; k + 1 < n; ++k) {
        f.lines.corners.push_back({p[k], p[k + 1]});
        cells_of_[1].push_back(cell);
      }
      return;
    case kVtkVertex:
    case kVtkPolyVertex:
      for (std::size_t k = 0; k < n; ++k) {
        f.marked_points.corners.push_back(p[k]);
        cells_of_[0].push_back(cell);
      }
      return;
    case kVtkEmptyCell:
      return;
    default:
      refuse_element(where, cell, vtk_cell_name(type), KindsOfCells::all);
  }
}

namespace {

/// Whole numbers that do not fit are an error: without them, faces between regions would not stay.
void refuse_large_tag(const std::string& path, std::string_view name, const Values& values) {
  std::visit(
      [&](const auto& v) {
        if constexpr (std::is_integral_v<typename std::decay_t<decltype(v)>::value_type>) {
          const auto at = std::ranges::find_if_not(v, [](auto tag) { return std::in_range<std::int32_t>(tag); });
          if (at == v.end()) return;
          fail(
              ErrorCode::index_out_of_range, path, "the array ", in_quotes(name), " of the cells has the tag ", *at,
              ", which is beyond 32 bits; expected at most 2147483647. Next: give the cells smaller tags, or the array "
              "another name");
        }
      },
      values);
}

}  // namespace

std::vector<std::int32_t> tags_of(std::vector<DataArray>& arrays, const std::string& path) {
  for (const std::string_view name : kRegionNames) {
    const DataArray* array = find(arrays, name);
    if (array == nullptr || array->components != 1) continue;
    auto tags = to_int32(array->values);
    if (!tags) refuse_large_tag(path, name, array->values);
    if (!tags) continue;
    if (name == "region") static_cast<void>(take(arrays, name));
    return std::move(*tags);
  }
  return {};
}

void CellSorter::distribute(std::vector<DataArray>&& cell_data) {
  MeshFile& f = document_.file;
  make_names_unique(cell_data);
  const bool only_triangles = cells_of_[2].size() == n_cells_ && cells_of_[2].counts_from(0);
  const bool only_tetrahedra = !cells_of_[3].empty() && cells_of_[3].size() == n_cells_;
  for (DataArray& array : cell_data) {
    if (only_triangles || only_tetrahedra) {
      (only_triangles ? f.triangles.data : document_.file.tetrahedra.data).push_back(std::move(array));
      continue;
    }
    // One cell may be many lines or points, and each gets the cell's data.
    const auto part = [&](const RunLength& cells) {
      allocation_.take(cells.size(), static_cast<std::uint64_t>(array.components), document_.names->path);
      return DataArray{array.name, array.components, gather(array.values, array.components, cells)};
    };
    const std::array lists = {&f.marked_points.data, &f.lines.data, &f.triangles.data, &f.tetrahedra.data};
    for (std::size_t d = 4; d-- > 0;) {
      const bool are_of_mesh = d == 2 && cells_of_[3].empty();
      if (are_of_mesh || !cells_of_[d].empty()) lists[d]->push_back(part(cells_of_[d]));
    }
  }
  take_tags();
  document_.names->tetrahedra = std::move(cells_of_[3]);
  document_.names->triangles = std::move(cells_of_[2]);
  document_.names->lines = std::move(cells_of_[1]);
}

void CellSorter::take_tags() {
  MeshFile& f = document_.file;
  const auto take = [&](auto&... cells) { ((cells.tags = tags_of(cells.data, document_.names->path)), ...); };
  take(f.tetrahedra, f.triangles, f.lines, f.marked_points);
  f.lines.tags.resize(f.lines.size());
  f.marked_points.tags.resize(f.marked_points.size());
}

void take_physical_names(Document& document) {
  const std::string& path = document.names->path;
  const auto taken = take(document.file.field_data, "physical_names");
  if (!taken) return;
  const auto* bytes = std::get_if<std::vector<std::uint8_t>>(&taken->values);
  if (bytes == nullptr) fail(ErrorCode::syntax, path, "the field array 'physical_names' is not of type UInt8");
  const std::string all(bytes->begin(), bytes->end());
  Scanner scanner(path, all);
  read_physical_names(scanner, document.file.names);
}

void take_period(Document& document) {
  auto taken = take(document.file.field_data, kPlanePeriod);
  if (!taken) return;
  const std::vector<double> lengths = to_doubles(std::move(taken->values));
  const auto is_length = [](double x) { return x >= 0 && std::isfinite(x); };
  if (lengths.size() != 2 || !std::all_of(lengths.begin(), lengths.end(), is_length)) {
    fail(ErrorCode::out_of_scale, document.names->path, "field data ", in_quotes(kPlanePeriod),
         " is not two lengths; expected the periods along x and y, 0 where there is none");
  }
  const Vec2 period = {lengths[0], lengths[1]};
  if (!(period == Vec2{})) document.file.points_in = PeriodicPoints{period};
}

void take_point_data(Document& document, std::vector<DataArray>&& arrays) {
  MeshFile& f = document.file;
  f.point_data = std::move(arrays);
  make_names_unique(f.point_data);
  const DataArray* weight = find(f.point_data, "weight");
  if (weight == nullptr || weight->components != 1) return;
  f.weights = to_doubles(std::move(take(f.point_data, "weight")->values));
}

}  // namespace temper::io

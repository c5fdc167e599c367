#include "io/formats/vtk/triangle_quality.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>

#include "io/text/scanner.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/quality.hpp"

namespace temper::io {
namespace {

struct QualityColumns {
  std::vector<std::uint8_t> well_centered;
  std::array<std::vector<float>, 3> margins;  // h/l, d/l, angle
};

/// −∞, of triangles without area, is no number in text of VTK.
float as_float(double value) {
  using Limits = std::numeric_limits<float>;
  if (!(value >= Limits::lowest())) return Limits::lowest();
  return static_cast<float>(std::min<double>(value, Limits::max()));
}

/// Measures the triangles of a file, which may be clockwise there.
class Measurer {
 public:
  explicit Measurer(const MeshFile& file) : file_(file), space_(file.space()) {}

  [[nodiscard]] TriangleQuality measure(std::size_t triangle) const {
    std::array<WeightedPoint, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = vertex(static_cast<std::size_t>(file_.triangles[triangle][k]));
    for (WeightedPoint& p : corners) p = space_.image(p, corners[0]);
    if (temper::orientation(space_, corners[0], corners[1], corners[2]) == Sign::negative)
      std::swap(corners[1], corners[2]);
    return triangle_quality(space_, corners);
  }

 private:
  [[nodiscard]] WeightedPoint vertex(std::size_t point) const {
    const double w = file_.weights.empty() ? 0 : file_.weights[point];
    return space_.vertex_at(place_of(file_, point), w);
  }

  const MeshFile& file_;
  Space space_;
};

QualityColumns measure_all(const MeshFile& file, Executor* executor) {
  constexpr std::size_t kBlock = std::size_t{1} << 13;
  const std::size_t n = file.triangles.size();
  const Measurer measurer(file);
  QualityColumns columns;
  columns.well_centered.resize(n);
  for (auto& margin : columns.margins) margin.resize(n);
  or_serial(executor).run((n + kBlock - 1) / kBlock, [&](std::size_t block) {
    for (std::size_t t = block * kBlock; t < std::min(n, (block + 1) * kBlock); ++t) {
      const TriangleQuality q = measurer.measure(t);
      columns.well_centered[t] = q.well_centered ? 1 : 0;
      columns.margins[0][t] = as_float(q.min_h_over_l);
      columns.margins[1][t] = as_float(q.min_d_over_l);
      columns.margins[2][t] = as_float(q.min_angle_deg);
    }
  });
  return columns;
}

/// The name of one of the arrays that data of the file have, or nothing.
std::string_view name_taken(const MeshFile& file) {
  for (const TriangleQualityArray& row : kTriangleQuality) {
    for (const auto* arrays : {&file.cell_data, &file.line_data, &file.marked_point_data}) {
      if (find(*arrays, row.name) != nullptr) return row.name;
    }
  }
  return {};
}

}  // namespace

bool has_triangle_quality(const std::function<std::optional<TypeOfArray>(std::string_view)>& type_of) {
  return std::all_of(kTriangleQuality.begin(), kTriangleQuality.end(), [&](const TriangleQualityArray& row) {
    const auto type = type_of(row.name);
    return type && type->scalar == row.scalar && type->components == 1;
  });
}

std::vector<VtkArray> vtk_triangle_quality(const WriteJob& job) {
  const MeshFile& file = job.measured;
  if (file.degrees() != nullptr) return {};
  if (file.triangles.empty()) return {};
  if (const std::string_view name = name_taken(file); !name.empty()) {
    job.warn(text("the quality of triangles is not written: the mesh has data ", in_quotes(name), " of its own"));
    return {};
  }
  const auto columns = std::make_shared<const QualityColumns>(measure_all(file, job.executor));
  const std::size_t n = file.triangles.size(), cells = n_vtk_cells(file);
  std::vector<VtkArray> list = {computed_vtk_array<std::uint8_t>(
      std::string(kTriangleQuality[0].name), kTriangleQuality[0].scalar, cells,
      [columns, n](std::size_t i) { return i < n ? columns->well_centered[i] : std::uint8_t{0}; })};
  for (std::size_t k = 0; k < 3; ++k) {
    const TriangleQualityArray& row = kTriangleQuality[k + 1];
    list.push_back(computed_vtk_array<float>(std::string(row.name), row.scalar, cells, [columns, n, k](std::size_t i) {
      return i < n ? columns->margins[k][i] : 0.0F;
    }));
  }
  return list;
}

}  // namespace temper::io

#include "io/formats/vtk/vtk_arrays.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include "io/conversion/globe.hpp"
#include "io/formats/cells.hpp"
#include "io/text/names.hpp"
#include "io/text/scanner.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/quality.hpp"
#include "temper/tets/geometry.hpp"
#include "temper/tets/quality.hpp"

namespace temper::io {
namespace {

/// Arrays one after the other, as the data of one array; an absent one is zeros.
struct Part {
  const Values* values;
  std::size_t n_values;
};
VtkArray joined(std::string name, Scalar scalar, int components, std::vector<Part> parts) {
  std::size_t total = 0;
  for (const Part& part : parts) total += part.n_values;
  const std::size_t each = info(scalar).bytes;
  return {std::move(name), scalar, components, total,
          [parts = std::move(parts), each](std::size_t first, std::size_t n, char* to) {
            std::size_t start = 0;
            for (const Part& part : parts) {
              const std::size_t low = std::max(first, start), high = std::min(first + n, start + part.n_values);
              if (low < high) {
                char* target = to + (low - first) * each;
                if (part.values == nullptr) {
                  std::memset(target, 0, (high - low) * each);
                } else {
                  std::visit([&](const auto& v) { std::memcpy(target, v.data() + (low - start), (high - low) * each); },
                             *part.values);
                }
              }
              start += part.n_values;
            }
          }};
}

/// Calls use(value, its index) for each value, of type T.
template <class T, class F>
void for_each_value(const VtkArray& a, F use) {
  constexpr std::size_t kBlock = kVtkBlockBytes / sizeof(T);
  std::vector<char> buffer(std::min(kBlock, a.n_values) * sizeof(T));
  for (std::size_t first = 0; first < a.n_values; first += kBlock) {
    const std::size_t n = std::min(kBlock, a.n_values - first);
    a.fill(first, n, buffer.data());
    for (std::size_t i = 0; i < n; ++i) {
      T value;
      std::memcpy(&value, buffer.data() + i * sizeof(T), sizeof(T));
      use(value, first + i);
    }
  }
}

}  // namespace

void put_ascii(Output& out, const VtkArray& a) {
  constexpr std::size_t kScalarsALine = 10;
  const std::size_t a_line = a.components > 1 ? static_cast<std::size_t>(a.components) : kScalarsALine;
  with_scalar(a.scalar, [&](auto zero) {
    for_each_value<decltype(zero)>(a, [&](auto value, std::size_t i) {
      out.put(value);
      out.put((i + 1) % a_line == 0 || i + 1 == a.n_values ? '\n' : ' ');
    });
  });
}

void put_big_endian(Output& out, const VtkArray& a) {
  with_scalar(a.scalar, [&](auto zero) {
    for_each_value<decltype(zero)>(a, [&](auto value, std::size_t) {
      char bytes[sizeof value];
      std::memcpy(bytes, &value, sizeof value);
      if constexpr (std::endian::native == std::endian::little) std::reverse(bytes, bytes + sizeof value);
      out.put(std::string_view(bytes, sizeof bytes));
    });
  });
}

VtkArray vtk_points(const WriteJob& job) {
  return computed_vtk_array<double>(
      "Points", Scalar::f64, 3 * job.file.points.size(),
      [&job](std::size_t i) {
        const Vec3 p = job.place(i / 3);
        return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z;
      },
      3);
}

VtkArray vtk_connectivity(const WriteJob& job) {
  const VtkCells cells(job);
  const std::size_t n_tets = 4 * cells.tetrahedra, n3 = 3 * cells.triangles, n4 = n3 + 4 * cells.quadrilaterals,
                    n2 = n4 + 2 * cells.lines;
  return computed_vtk_array<std::int32_t>(
      "connectivity", Scalar::i32, cells.points_of_first(cells.size()), [&job, n_tets, n3, n4, n2](std::size_t i) {
        if (i < n_tets) return job.file.tetrahedra[i / 4][i % 4];
        i -= n_tets;
        const MeshFile& f = job.file;
        if (i < n3) return f.triangles[i / 3][i % 3];
        if (i < n4) {
          const std::size_t q = (i - n3) / 4, k = (i - n3) % 4;
          return k < 3 ? f.triangles[n3 / 3 + q][k] : job.fourth_corners[q];
        }
        return i < n2 ? f.lines[(i - n4) / 2][(i - n4) % 2] : f.marked_points[i - n2];
      });
}

VtkArray vtk_cell_ends(const VtkCells& cells) {
  const auto ends = [&]<class T>(T /*zero*/, Scalar scalar) {
    return computed_vtk_array<T>("offsets", scalar, cells.size(),
                                 [cells](std::size_t i) { return static_cast<T>(cells.points_of_first(i + 1)); });
  };
  const bool fits = std::in_range<std::int32_t>(cells.points_of_first(cells.size()));
  return fits ? ends(std::int32_t{}, Scalar::i32) : ends(std::int64_t{}, Scalar::i64);
}

VtkArray vtk_cell_types(const WriteJob& job) {
  const VtkCells cells(job);
  return computed_vtk_array<std::uint8_t>("types", Scalar::u8, cells.size(), [cells](std::size_t i) {
    if (i < cells.tetrahedra) return static_cast<std::uint8_t>(kVtkTetrahedron);
    i -= cells.tetrahedra;
    const std::size_t faces = cells.triangles + cells.quadrilaterals;
    return static_cast<std::uint8_t>(i < cells.triangles       ? kVtkTriangle
                                     : i < faces               ? kVtkQuad
                                     : i < faces + cells.lines ? kVtkLine
                                                               : kVtkVertex);
  });
}

namespace {

VtkArray regions(const WriteJob& job) {
  const MeshFile& f = job.file;
  const std::size_t s = job.file.tetrahedra.size(), t = f.triangles.size(), l = f.lines.size();
  return computed_vtk_array<std::int32_t>("region", Scalar::i32, s + t + l + f.marked_points.size(),
                                          [&job, &f, s, t, l](std::size_t i) {
                                            if (i < s) {
                                              const auto& of_tets = job.file.tetrahedra.tags;
                                              return of_tets.empty() ? 0 : of_tets[i];
                                            }
                                            i -= s;
                                            if (i < t) return f.triangles.tags.empty() ? 0 : f.triangles.tags[i];
                                            return i < t + l ? f.lines.tags[i - t] : f.marked_points.tags[i - t - l];
                                          });
}

}  // namespace

std::vector<VtkArray> vtk_point_data(const WriteJob& job) {
  std::vector<VtkArray> list;
  const MeshFile& f = job.file;
  if (!f.weights.empty()) {
    list.push_back(computed_vtk_array<double>("weight", Scalar::f64, f.weights.size(),
                                              [&f](std::size_t i) { return f.weights[i]; }));
  }
  for (const DataArray& a : f.point_data) {
    if (a.name == "weight" && !f.weights.empty()) {
      job.warn("point data 'weight' is not written: temper uses this name for the weights");
      continue;
    }
    list.push_back(joined(a.name, scalar_of(a.values), a.components, {{&a.values, size(a.values)}}));
  }
  return list;
}

std::vector<VtkArray> vtk_cell_data(const WriteJob& job) {
  const MeshFile& f = job.file;
  std::vector<VtkArray> list;
  const Cells<3>& tets = f.tetrahedra;
  const bool tagged = !tets.tags.empty() || !f.triangles.tags.empty() || !f.lines.empty() || !f.marked_points.empty();
  if (tagged) list.push_back(regions(job));

  const std::vector<DataArray>* kinds[] = {&tets.data, &f.triangles.data, &f.lines.data, &f.marked_points.data};
  const std::size_t counts[] = {tets.size(), f.triangles.size(), f.lines.size(), f.marked_points.size()};
  const ArraysByName named[] = {ArraysByName(tets.data), ArraysByName(f.triangles.data), ArraysByName(f.lines.data),
                                ArraysByName(f.marked_points.data)};
  std::set<std::string_view> done;
  for (const auto* kind : kinds) {
    for (const DataArray& a : *kind) {
      if (!done.insert(a.name).second) continue;
      if (a.name == "region" && tagged) {
        job.warn("cell data 'region' is not written: temper uses this name for the regions");
        continue;
      }
      std::vector<Part> parts;
      for (std::size_t k = 0; k < std::size(kinds); ++k) {
        const DataArray* other = named[k].find(a.name);
        const bool alike =
            other != nullptr && other->components == a.components && other->values.index() == a.values.index();
        if (other != nullptr && !alike) {
          job.warn("data ", a.name, " of ", tets.empty() ? "" : "faces, ",
                   "lines or points have another type than data of ", tets.empty() ? "triangles" : "tetrahedra",
                   " and are not written");
        }
        parts.push_back({alike ? &other->values : nullptr, counts[k] * static_cast<std::size_t>(a.components)});
      }
      list.push_back(joined(a.name, scalar_of(a.values), a.components, std::move(parts)));
    }
  }
  return list;
}

std::vector<VtkArray> vtk_field_data(const MeshFile& f) {
  std::vector<VtkArray> list;
  if (!f.names.empty()) {
    std::string all = lines_of(f.names);
    const std::size_t n = all.size();
    list.push_back(computed_vtk_array<std::uint8_t>(
        "physical_names", Scalar::u8, n,
        [all = std::move(all)](std::size_t i) { return static_cast<std::uint8_t>(all[i]); }));
  }
  if (f.periodic() != nullptr) {
    list.push_back(
        computed_vtk_array<double>(std::string(kPlanePeriod), Scalar::f64, 2,
                                   [p = f.periodic()->period](std::size_t i) { return i == 0 ? p.x : p.y; }));
  }
  for (const DataArray& a : f.field_data) {
    list.push_back(joined(a.name, scalar_of(a.values), a.components, {{&a.values, size(a.values)}}));
  }
  return list;
}

namespace {

/// The first column are flags. They are exact as floats, too.
using QualityColumns = std::vector<std::vector<float>>;

/// VTK has no text for −∞, the value of triangles without area.
float as_float(double value) {
  using Limits = std::numeric_limits<float>;
  if (!(value >= Limits::lowest())) return Limits::lowest();
  return static_cast<float>(std::min<double>(value, Limits::max()));
}

// A mesh has no numbers that exact arithmetic cannot take, but a file that is only converted may have them. They would
// overflow in the predicates. Such an element is not well-centered, and its measures are the lowest ones.

/// The coordinates that measures use: those of a plane are two.
Vec3 measured_place(const WriteJob& job, std::size_t point) {
  if (job.file.in_space() != nullptr) return job.place(point);
  const Vec3 p = position_of(job.measured, point);
  return job.measured.sphere() != nullptr ? p : Vec3{p.x, p.y, 0};
}

bool is_exact(const WriteJob& job, Vec3 p) {
  const auto all = [&](const auto& is_in_range) { return is_in_range(p.x) && is_in_range(p.y) && is_in_range(p.z); };
  return job.file.dimension() == 3 ? all(tets::is_exact_coordinate) : all(is_exact_coordinate);
}

/// The first of these corners with coordinates out of range, or −1.
std::int32_t corner_out_of_range(const WriteJob& job, std::span<const std::int32_t> corners) {
  const auto found = std::ranges::find_if(corners, [&](std::int32_t corner) {
    return !is_exact(job, measured_place(job, static_cast<std::size_t>(corner)));
  });
  return found == corners.end() ? -1 : *found;
}

bool is_measurable(const WriteJob& job, std::span<const std::int32_t> corners) {
  const auto& weights = job.measured.weights;
  const auto is_in_range = job.file.dimension() == 3 ? tets::is_exact_weight : is_exact_weight;
  return corner_out_of_range(job, corners) < 0 && std::ranges::all_of(corners, [&](std::int32_t corner) {
           return weights.empty() || is_in_range(weights[static_cast<std::size_t>(corner)]);
         });
}

template <class Elements>
void warn_of_scale(const WriteJob& job, const Elements& elements, std::string_view name) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const std::int32_t corner = corner_out_of_range(job, elements[i]);
    if (corner < 0) continue;
    const Vec3 p = measured_place(job, static_cast<std::size_t>(corner));
    job.warn("the quality of ", name, " ", i, " and perhaps of others is unknown, and written as the lowest: point ",
             corner, " has coordinates (", p.x, ", ", p.y, ", ", p.z, "), which exact arithmetic cannot take");
    return;
  }
}

/// Warns of the first element that cannot be measured.
void warn_of_scale(const WriteJob& job) {
  std::size_t in_range = 0;
  while (in_range < job.file.points.size() && is_exact(job, measured_place(job, in_range))) ++in_range;
  if (in_range == job.file.points.size()) return;  // nearly always, at a sixth of the cost
  if (job.file.dimension() == 3)
    warn_of_scale(job, job.file.tetrahedra, "tetrahedron");
  else
    warn_of_scale(job, job.measured.triangles, "triangle");
}

constexpr double kUnknown = -std::numeric_limits<double>::infinity();

/// Measures the triangles of a file, which may be clockwise there.
class Measurer {
 public:
  explicit Measurer(const MeshFile& file) : file_(file), space_(file.space()) {}

  [[nodiscard]] TriangleQuality measure(std::size_t triangle) const {
    if (file_.is_surface()) return measure_in_space(triangle);
    std::array<WeightedPoint, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = vertex(static_cast<std::size_t>(file_.triangles[triangle][k]));
    for (WeightedPoint& p : corners) p = space_.image(p, corners[0]);
    if (temper::orientation(space_, corners[0], corners[1], corners[2]) == Sign::negative)
      std::swap(corners[1], corners[2]);
    return triangle_quality(space_, corners);
  }

 private:
  [[nodiscard]] TriangleQuality measure_in_space(std::size_t triangle) const {
    std::array<surfaces::WeightedPoint, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto point = static_cast<std::size_t>(file_.triangles[triangle][k]);
      const Vec3 p = position_of(file_, point);
      corners[k] = {p.x, p.y, p.z, file_.weights.empty() ? 0 : file_.weights[point]};
    }
    const auto& [p, q, r] = corners;
    if (surfaces::is_flat(p.position(), q.position(), r.position())) return {false, kUnknown, kUnknown, 0};
    return surfaces::triangle_quality(corners);
  }
  [[nodiscard]] WeightedPoint vertex(std::size_t point) const {
    const double w = file_.weights.empty() ? 0 : file_.weights[point];
    return space_.vertex_at(position_of(file_, point), w);
  }

  const MeshFile& file_;
  Space space_;
};

/// `measured`: the numbers of the rows for element i of n.
template <class Measured>
QualityColumns measure_all(std::size_t n, std::size_t n_columns, Executor* executor, const Measured& measured) {
  constexpr std::size_t kBlock = std::size_t{1} << 13;
  QualityColumns columns(n_columns, std::vector<float>(n));
  or_serial(executor).run((n + kBlock - 1) / kBlock, [&](std::size_t block) {
    for (std::size_t i = block * kBlock; i < std::min(n, (block + 1) * kBlock); ++i) {
      const auto values = measured(i);
      for (std::size_t k = 0; k < n_columns; ++k) columns[k][i] = as_float(values[k]);
    }
  });
  return columns;
}

QualityColumns columns_of_triangles(const WriteJob& job) {
  const Measurer measurer(job.measured);
  return measure_all(job.measured.triangles.size(), kTriangleQuality.size(), job.executor, [&](std::size_t t) {
    if (!is_measurable(job, job.measured.triangles[t])) return std::array{0.0, kUnknown, kUnknown, kUnknown};
    const TriangleQuality q = measurer.measure(t);
    return std::array{q.well_centered ? 1.0 : 0.0, q.min_h_over_l, q.min_d_over_l, q.min_angle_deg};
  });
}

/// Corners may come in either orientation.
QualityColumns columns_of_tetrahedra(const WriteJob& job) {
  const auto& weights = job.file.weights;
  return measure_all(job.file.tetrahedra.size(), kTetrahedronQuality.size(), job.executor, [&](std::size_t t) {
    if (!is_measurable(job, job.file.tetrahedra[t])) return std::array{0.0, kUnknown, kUnknown};
    std::array<tets::WeightedPoint, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto point = static_cast<std::size_t>(job.file.tetrahedra[t][k]);
      const Vec3 p = job.place(point);
      corners[k] = {p.x, p.y, p.z, weights.empty() ? 0 : weights[point]};
    }
    if (tets::orientation(corners[0].position(), corners[1].position(), corners[2].position(), corners[3].position()) ==
        Sign::negative)
      std::swap(corners[2], corners[3]);
    const tets::TetrahedronQuality q = tets::tetrahedron_quality(corners);
    return std::array{q.well_centered ? 1.0 : 0.0, q.min_h_over_l, q.min_dihedral_deg};
  });
}

/// The name of an array that data of the file already have, or nothing.
std::string_view name_taken(const WriteJob& job, std::span<const QualityArray> rows) {
  const MeshFile& file = job.measured;
  for (const QualityArray& row : rows) {
    for (const auto* arrays :
         {&file.tetrahedra.data, &file.triangles.data, &file.lines.data, &file.marked_points.data}) {
      if (find(*arrays, row.name) != nullptr) return row.name;
    }
  }
  return {};
}

}  // namespace

std::span<const QualityArray> quality_among(
    const std::function<std::optional<TypeOfArray>(std::string_view)>& type_of) {
  for (const std::span<const QualityArray> rows :
       {std::span<const QualityArray>(kTriangleQuality), std::span<const QualityArray>(kTetrahedronQuality)}) {
    const bool all = std::ranges::all_of(rows, [&](const QualityArray& row) {
      const auto type = type_of(row.name);
      return type && type->scalar == row.scalar && type->components == 1;
    });
    if (all) return rows;
  }
  return {};
}

std::vector<VtkArray> vtk_quality(const WriteJob& job) {
  const MeshFile& file = job.measured;
  const bool tetrahedra = job.file.dimension() == 3;
  if (file.degrees() != nullptr) return {};
  if (!tetrahedra && (file.triangles.empty() || !job.fourth_corners.empty())) return {};
  const std::span<const QualityArray> rows =
      tetrahedra ? std::span<const QualityArray>(kTetrahedronQuality) : std::span<const QualityArray>(kTriangleQuality);
  if (const std::string_view name = name_taken(job, rows); !name.empty()) {
    job.warn("the quality of ", tetrahedra ? "tetrahedra" : "triangles", " is not written: the mesh has data ",
             in_quotes(name), " of its own");
    return {};
  }
  warn_of_scale(job);
  const auto columns =
      std::make_shared<const QualityColumns>(tetrahedra ? columns_of_tetrahedra(job) : columns_of_triangles(job));
  const std::size_t n = columns->front().size(), cells = VtkCells(job).size();
  std::vector<VtkArray> list;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto value = [columns, n, k](std::size_t i) { return i < n ? (*columns)[k][i] : 0.0F; };
    const std::string name(rows[k].name);
    list.push_back(
        rows[k].scalar == Scalar::u8
            ? computed_vtk_array<std::uint8_t>(name, Scalar::u8, cells,
                                               [value](std::size_t i) { return static_cast<std::uint8_t>(value(i)); })
            : computed_vtk_array<float>(name, Scalar::f32, cells, value));
  }
  return list;
}

}  // namespace temper::io

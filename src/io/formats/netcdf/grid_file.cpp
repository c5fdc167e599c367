// Grids in NetCDF, by the CF conventions and COARDS: variables of two dimensions, each with a coordinate variable of
// its own name. Axes are found by standard_name, units and axis, else by their order (y, x). A leading dimension of one
// entry, such as a time, is left out.
#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/formats/raster.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

enum class AxisKind { unknown, x, y, longitude, latitude };

class GridReader {
 public:
  GridReader(const NetcdfReader& in, const Source& source) : in_(in), source_(source) {}

  /// Nothing if the file has no grid.
  std::optional<Document> read() {
    for (const NetcdfVariable& v : in_.variables()) add(v);
    if (!x_) return {};
    Raster raster;
    raster.degrees = kind(*x_) == AxisKind::longitude && kind(*y_) == AxisKind::latitude;
    raster.x = to_doubles(in_.values(*x_));
    raster.y = to_doubles(in_.values(*y_));
    for (const NetcdfVariable* v : grids_) raster.data.push_back({v->name, 1, rows_of(*v)});
    Document document = mesh_of_raster(std::move(raster), source_);
    document.file.format = "ncgrid";
    return document;
  }

 private:
  /// The coordinate variable of a dimension, or null.
  [[nodiscard]] const NetcdfVariable* coordinates(int dimension) const {
    const NetcdfVariable* const v = in_.find(in_.dimension_name(dimension));
    return v != nullptr && v->scalar && v->dimensions == std::vector<int>{dimension} ? v : nullptr;
  }

  [[nodiscard]] AxisKind kind(const NetcdfVariable& v) const {
    const std::string name = in_.text_attribute(&v, "standard_name"), units = in_.text_attribute(&v, "units"),
                      axis = in_.text_attribute(&v, "axis");
    const auto degrees = [&](std::string_view end, std::string_view letter) {
      return units.starts_with("degree") && (units.ends_with(end) || units.ends_with(letter));
    };
    if (name == kLongitude || degrees("_east", "E")) return AxisKind::longitude;
    if (name == kLatitude || degrees("_north", "N")) return AxisKind::latitude;
    if (name == "projection_x_coordinate" || axis == "X") return AxisKind::x;
    if (name == "projection_y_coordinate" || axis == "Y") return AxisKind::y;
    return AxisKind::unknown;
  }

  void add(const NetcdfVariable& v) {
    if (!v.scalar || v.dimensions.size() < 2) return;
    const std::size_t n = v.dimensions.size();
    if (!std::all_of(v.sizes.begin(), v.sizes.end() - 2, [](std::size_t size) { return size == 1; })) return;
    const NetcdfVariable *y = coordinates(v.dimensions[n - 2]), *x = coordinates(v.dimensions[n - 1]);
    if (x == nullptr || y == nullptr || x == y) return;
    const AxisKind first = kind(*y);
    const bool turned = first == AxisKind::x || first == AxisKind::longitude;
    if (turned) std::swap(x, y);
    if (x_ != nullptr && (x != x_ || y != y_ || turned != turned_)) return;  // another grid
    x_ = x, y_ = y, turned_ = turned;
    grids_.push_back(&v);
  }

  [[nodiscard]] std::vector<double> rows_of(const NetcdfVariable& v) const {
    Values unpacked = in_.unpacked(v);
    const bool whole = !is_floating(unpacked);  // as they are in the file
    std::vector<double> values = to_doubles(std::move(unpacked));
    for (const char* attribute : {"_FillValue", "missing_value"}) {
      const auto missing = in_.number_attribute(&v, attribute);
      if (whole && missing) std::ranges::replace(values, *missing, std::numeric_limits<double>::quiet_NaN());
    }
    if (!turned_) return values;
    const std::size_t nx = x_->n_values(), ny = y_->n_values();
    std::vector<double> rows(values.size());
    for (std::size_t i = 0; i < nx; ++i) {
      for (std::size_t j = 0; j < ny; ++j) rows[j * nx + i] = values[i * ny + j];
    }
    return rows;
  }

  const NetcdfReader& in_;
  const Source& source_;
  const NetcdfVariable *x_ = nullptr, *y_ = nullptr;
  bool turned_ = false;
  std::vector<const NetcdfVariable*> grids_;
};

}  // namespace

std::optional<Document> read_grid_from(const NetcdfReader& in, const Source& source) {
  return GridReader(in, source).read();
}

}  // namespace temper::io

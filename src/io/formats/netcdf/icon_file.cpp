// Grids of the atmosphere model ICON, which are triangles on a sphere (ICON grid generator).
//
//   vlon vlat             longitude and latitude of vertices, in radians
//   vertex_of_cell        (3, cells), numbers from 1
//   clon_vertices clat_vertices   (cells, 3): the same corners, in files without the others
//
// The radius is the attribute sphere_radius or semi_major_axis, or the Earth's.
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "io/conversion/globe.hpp"
#include "io/formats/netcdf/netcdf_extras.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

/// Data of vertices and cells that do not follow from the grid.
const std::set<std::string_view> kIconGrid = {"vlon", "vlat", "vertex_of_cell", "clon_vertices", "clat_vertices"};
const std::set<std::string_view> kIconData = {
    "cell_elevation", "cell_sea_land_mask", "vertex_elevation", "topography_c", "z_mc", "cell_domain_id"};

class IconReader {
 public:
  IconReader(const NetcdfReader& in, const std::string& path) : in_(in), document_(new_document(path)), kept_(in) {}

  Document read() {
    MeshFile& f = document_.file;
    f.format = "ugrid";
    if (in_.find("vertex_of_cell") != nullptr && in_.find("vlon") != nullptr) {
      from_table();
    } else {
      from_corners();
    }
    document_.names->points = RunLength(1, f.points.size());
    document_.names->triangles = RunLength(1, f.triangles.size());
    const auto said = in_.number_attribute(nullptr, "sphere_radius");
    const auto axis = in_.number_attribute(nullptr, "semi_major_axis");
    put_on_sphere(f, said ? *said : axis ? *axis : Projection{}.radius, *document_.names);
    data();
    // Not those that say which grid it is.
    kept_.file([](std::string_view name, const std::string&) {
      return name.starts_with("uuid") || name.starts_with("number_of_grid") || name.starts_with("grid_");
    });
    kept_.finish(f);
    return std::move(document_);
  }

 private:
  [[nodiscard]] std::vector<double> degrees(const char* name) const {
    const NetcdfVariable& v = in_.variable(name);
    std::vector<double> values = to_doubles(in_.unpacked(v));
    if (!in_.text_attribute(&v, "units").starts_with("deg"))
      for (double& value : values) value *= 180 / std::numbers::pi;
    return values;
  }
  void expect(bool good, std::string_view variable) const {
    if (!good) fail(ErrorCode::size_mismatch, document_.names->path, "variable ", variable, " has a wrong size");
  }

  void from_table() {
    const auto lon = degrees("vlon"), lat = degrees("vlat");
    expect(lon.size() == lat.size(), "vlat");
    for (std::size_t i = 0; i < lon.size(); ++i) document_.file.points.push_back({lon[i], lat[i]});
    const NetcdfVariable& v = in_.variable("vertex_of_cell");
    expect(v.sizes.size() == 2 && (v.sizes[0] == 3 || v.sizes[1] == 3), v.name);
    const bool is_turned = v.sizes[0] == 3;  // as Fortran's vertex_of_cell(cell, 3)
    const auto all = in_.integers(v);
    const std::size_t n = all.size() / 3;
    for (std::size_t t = 0; t < n; ++t) {
      auto& corners = document_.file.triangles.corners.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t number = all[is_turned ? k * n + t : 3 * t + k];
        if (number < 1 || number > static_cast<std::int64_t>(lon.size()))
          fail(ErrorCode::index_out_of_range, document_.names->path, "triangle ", t + 1, " uses vertex ", number,
               ", but the file has ", lon.size(), " vertices, numbered from 1");
        corners[k] = static_cast<std::int32_t>(number - 1);
      }
    }
  }
  /// Corners of one place are one vertex, and all longitudes are one at a pole.
  void from_corners() {
    const auto lon = degrees("clon_vertices"), lat = degrees("clat_vertices");
    expect(lon.size() == lat.size() && lon.size() % 3 == 0, "clat_vertices");
    constexpr double kTick = 1e-10;  // degrees: far below the rounding of radians in single precision
    std::map<std::pair<double, double>, std::int32_t> vertices;
    for (std::size_t i = 0; i < lon.size(); ++i) {
      if (!std::isfinite(lon[i]) || !std::isfinite(lat[i]))
        fail(ErrorCode::not_finite, document_.names->path, "triangle ", i / 3 + 1, " has a corner at longitude ",
             lon[i], " and latitude ", lat[i], ", expected finite numbers");
      const bool is_pole = std::abs(lat[i]) > 90 - kTick;
      const double turned = lon[i] - 360 * std::floor(lon[i] / 360);
      const std::pair key = {is_pole ? 0 : std::fmod(std::round(turned / kTick), std::round(360 / kTick)),
                             std::round(lat[i] / kTick)};
      const auto [found, is_new] = vertices.emplace(key, static_cast<std::int32_t>(vertices.size()));
      if (is_new) document_.file.points.push_back({lon[i], lat[i]});
      if (i % 3 == 0) document_.file.triangles.corners.emplace_back();
      document_.file.triangles.corners.back()[i % 3] = found->second;
    }
  }
  void data() {
    std::vector<std::string_view> dropped;
    for (const NetcdfVariable& v : in_.variables()) {
      const bool taken = kIconData.contains(v.name) && v.scalar && v.sizes.size() == 1;
      if (taken && v.sizes[0] == document_.file.points.size()) {
        add_netcdf_data(in_, v, document_.file.point_data, kept_);
      } else if (taken && v.sizes[0] == document_.file.triangles.size()) {
        add_netcdf_data(in_, v, document_.file.triangles.data, kept_);
      } else if (!kIconGrid.contains(v.name)) {
        dropped.push_back(v.name);
      }
    }
    warn_of_dropped(document_, dropped);
  }

  const NetcdfReader& in_;
  Document document_;
  NetcdfCollector kept_;
};

}  // namespace

bool is_icon(const NetcdfReader& in) {
  return (in.find("vertex_of_cell") != nullptr && in.find("vlon") != nullptr && in.find("vlat") != nullptr) ||
         (in.find("clon_vertices") != nullptr && in.find("clat_vertices") != nullptr);
}

Document read_icon(const NetcdfReader& in, const std::string& path) { return IconReader(in, path).read(); }

}  // namespace temper::io

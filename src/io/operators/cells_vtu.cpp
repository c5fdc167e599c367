// Polygons of cells as VTU. Coordinates are those of a mesh in VTU: on a map degrees, on a sphere three coordinates.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>

#include "io/conversion/globe.hpp"
#include "io/formats/cells.hpp"
#include "io/formats/vtk/vtu_write.hpp"
#include "io/operators/cell_files.hpp"
#include "io/text/names.hpp"

namespace temper::io {
namespace {

/// Places of the plane of a mesh in three coordinates.
std::vector<Vec3> places_in_space(const CellJob& job, std::vector<Vec2> flat) {
  MeshFile shell;
  if (const auto* const plane = std::get_if<PlanePoints>(&job.file.points_in)) shell.points_in = *plane;
  shell.points = std::move(flat);
  if (job.file.map() != nullptr || job.file.periodic() != nullptr) shell.set_z(job.file.z());
  std::vector<Vec3> places;
  places.reserve(shell.points.size());
  for (std::size_t i = 0; i < shell.points.size(); ++i) places.push_back(shell.place(i));
  return places;
}

VtkArray places_array(const char* name, const std::vector<Vec3>& places,
                      const std::function<std::size_t(std::size_t)>& of, std::size_t n) {
  return computed_vtk_array<double>(
      name, Scalar::f64, 3 * n,
      [&places, of](std::size_t i) {
        const Vec3 p = places[of(i / 3)];
        return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z;
      },
      3);
}

template <class F>
VtkArray integers_array(std::string name, std::size_t n, F value) {
  return computed_vtk_array<std::int32_t>(std::move(name), Scalar::i32, n,
                                          [value](std::size_t i) { return static_cast<std::int32_t>(value(i)); });
}

/// The names of regions and points, as in VTU files of meshes.
VtkArray names_array(const std::vector<PhysicalName>& all) {
  std::vector<PhysicalName> names;
  std::ranges::copy_if(all, std::back_inserter(names), [](const PhysicalName& n) { return n.dimension != 1; });
  std::string lines = lines_of(names);
  const std::size_t n = lines.size();
  return computed_vtk_array<std::uint8_t>("physical_names", Scalar::u8, n, [lines = std::move(lines)](std::size_t i) {
    return static_cast<std::uint8_t>(lines[i]);
  });
}

/// The columns as cell data of the polygons. Texts are left out: the arrays `tag` and `region` have the numbers of
/// the names.
std::vector<VtkArray> data_of_polygons(const CellJob& job) {
  const std::vector<std::uint32_t>& cell = job.cells.cells;
  const std::size_t n = job.cells.n_polygons();
  std::vector<VtkArray> arrays;
  for (const CellColumn& column : job.columns()) {
    std::string name(column.name);
    if (const auto* const integers = std::get_if<CellColumn::Integers>(&column.of)) {
      arrays.push_back(integers_array(name, n, [of = *integers, &cell](std::size_t p) { return of(cell[p]); }));
    } else if (const auto* const reals = std::get_if<CellColumn::Reals>(&column.of)) {
      arrays.push_back(computed_vtk_array<double>(std::move(name), Scalar::f64, n,
                                                  [of = *reals, &cell](std::size_t p) { return of(cell[p]); }));
    }
  }
  if (!job.tags.empty())
    arrays.push_back(integers_array("tag", n, [&job, &cell](std::size_t p) { return job.tags[cell[p]]; }));
  return arrays;
}

}  // namespace

void write_cells_vtu(const CellJob& job) {
  const CellPolygons& c = job.cells;
  std::vector<Vec3> centers = c.sphere_centers, points = c.sphere_points;
  if (job.file.map() != nullptr) {
    FlatPlaces places = flat_places(job);
    centers = places_in_space(job, std::move(places.centers));
    points = places_in_space(job, std::move(places.points));
  } else if (job.file.sphere() == nullptr) {
    centers = places_in_space(job, c.centers);
    points = places_in_space(job, c.points);
  }
  const std::size_t n = c.n_polygons();
  VtuPiece piece = {places_array(
                        "Points", points, [](std::size_t i) { return i; }, points.size()),
                    {integers_array("connectivity", c.corners.size(), [&c](std::size_t i) { return c.corners[i]; }),
                     integers_array("offsets", n, [&c](std::size_t p) { return c.starts[p + 1]; }),
                     computed_vtk_array<std::uint8_t>(
                         "types", Scalar::u8, n, [](std::size_t) { return static_cast<std::uint8_t>(kVtkPolygon); })}};
  piece.cell_data = data_of_polygons(job);
  piece.cell_data.push_back(places_array(
      "center", centers, [&c](std::size_t p) { return c.cells[p]; }, n));
  if (!job.file.names.empty()) piece.field_data.push_back(names_array(job.file.names));
  write_piece(job.outputs.open(job.path), piece, job.options.encoding.value_or(Encoding::base64), job.options.executor);
}

}  // namespace temper::io

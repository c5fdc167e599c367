// Operators as Matrix Market files. Their rows and columns count from 1: vertex 0 is row 1.
#include "io/dec_files.hpp"
#include "io/failure.hpp"
#include "io/matrix_market.hpp"

namespace temper::io {
namespace {

void put_places(const DecJob& job, std::string_view name, const DecPlaces& places, std::string_view of_what) {
  const std::string_view axes = places.coordinates == 2 ? "x, y " : "x, y, z ";
  put_columns(job.open(name), places.size(), places.coordinates, text(axes, of_what),
              [&](std::size_t row, std::size_t column) { return places.coordinate(row, column); });
}

}  // namespace

void write_dec_mtx(const DecJob& job) {
  const DecComplex& c = job.complex;
  put_matrix(job.open("d0.mtx"), c.d0, "edges x vertices: -1 at the lower vertex, +1 at the higher");
  put_matrix(job.open("d1.mtx"), c.d1, "triangles x edges: +1 where the edge runs counter-clockwise");
  put_diagonal(job.open("star0.mtx"), c.star0.raw(), "signed areas of the dual cells of the vertices");
  put_diagonal(job.open("star1.mtx"), c.star1.raw(), "signed dual length over length of the edges");
  put_diagonal(job.open("star2.mtx"), c.star2.raw(), "1 / area of the triangles");
  put_diagonal(job.open("flux.mtx"), c.flux.raw(), "length over signed dual length of the edges");
  put_places(job, "orthocenters.mtx", orthocenter_places(c), "of the orthocenters of the triangles");
  put_places(job, "edge_midpoints.mtx", midpoint_places(c), "of the weighted midpoints of the edges");
}

}  // namespace temper::io

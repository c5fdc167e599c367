// Files that hold only a mesh, or the mesh of an outline.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "io/conversion/follow.hpp"
#include "io/conversion/globe.hpp"
#include "io/conversion/known_arrays.hpp"
#include "io/conversion/quadrilaterals.hpp"
#include "io/conversion/update.hpp"
#include "temper/io.hpp"
#include "temper/mesher.hpp"

namespace temper::io {
namespace {

/// Longitude and latitude of the vertices of a map, as point data.
void add_degrees(MeshFile& file, const OutlineMesh& made, std::span<const Vec2> lon_lat, const Projection& map) {
  std::vector<double> longitudes, latitudes;
  const LongitudeTurn turn(lon_lat);
  for (const VertexId v : made.mesh.vertices()) {
    const Vec2 place = turn(inverse(map, made.mesh.position(v)));
    longitudes.push_back(place.x);
    latitudes.push_back(place.y);
  }
  for (std::size_t p = lon_lat.size(); p-- > 0;) {  // bit for bit; of joined points the first
    const VertexId v = made.vertex_of_point[p];
    if (v.valid()) longitudes[v.index] = lon_lat[p].x, latitudes[v.index] = lon_lat[p].y;
  }
  file.point_data.push_back({std::string(kLongitude), 1, std::move(longitudes)});
  file.point_data.push_back({std::string(kLatitude), 1, std::move(latitudes)});
}

/// Flags of lines: is the dual of the edge a face that stays?
class FaceFlags {
 public:
  /// Takes the edge of the next line; invalid if it is a boundary edge in the other direction.
  void add(const Mesh& mesh, HalfedgeId h) { flags_.push_back(h.valid() && mesh.is_face(h) ? 1 : 0); }
  void write(MeshFile& file) const {
    if (std::ranges::find(flags_, 1) != flags_.end()) file.lines.data.push_back({std::string(kFace), 1, flags_});
  }

 private:
  std::vector<std::int32_t> flags_;
};

}  // namespace

MeshFile from_outline(const OutlineMesh& made, std::span<const Vec2> lon_lat, const std::optional<Projection>& map) {
  MeshFile file = from_mesh(made.mesh);
  file.lines = {};
  file.marked_points = {};
  constexpr std::int32_t kBoundary = 1, kHighest = std::numeric_limits<std::int32_t>::max() - 2;
  std::int32_t highest = kBoundary;
  for (const MeshLine& line : made.lines) highest = std::max(highest, line.tag);
  for (const MarkedVertex& mark : made.marked) highest = std::max(highest, mark.tag);
  highest = std::min(highest, kHighest);
  const std::int32_t inside = highest + 1, point = highest + 2;
  const auto number = [](VertexId v) { return static_cast<std::int32_t>(v.index); };
  FaceFlags faces;
  for (const MeshLine& line : made.lines) {
    const HalfedgeId h = made.mesh.find_halfedge(line.a, line.b);
    faces.add(made.mesh, h);
    const bool boundary = !h.valid() || made.mesh.is_boundary(h);
    file.lines.add({number(line.a), number(line.b)}, line.tag != 0 ? line.tag : boundary ? kBoundary : inside);
  }
  faces.write(file);
  for (const MarkedVertex& mark : made.marked)
    file.marked_points.add(number(mark.vertex), mark.tag != 0 ? mark.tag : point);
  file.names = made.groups;
  if (map) add_degrees(file, made, lon_lat, *map);
  if (made.mesh.space().is_plane()) return file;
  for (std::size_t p = lon_lat.size(); p-- > 0;) {  // bit for bit; of joined points the first
    const VertexId v = made.vertex_of_point[p];
    if (v.valid()) file.points[v.index] = lon_lat[p];
  }
  return file;
}

MeshFile from_mesh(const Mesh& mesh) {
  MeshFile file;
  copy_vertices(file, mesh, {});
  copy_cells(file.triangles, mesh);
  std::vector<std::array<TriangleId, 2>> pairs;  // of halves of quadrilaterals
  FaceFlags faces;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_constrained(h) || mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    // An interface between regions is constrained by its regions; any other line has to be written.
    const TriangleId t = Mesh::triangle(h), other = Mesh::triangle(mesh.twin(h));
    if (mesh.joins_halves(h)) pairs.push_back({t, other});
    if (!mesh.is_face(h) && (mesh.region(t) != mesh.region(other) || mesh.is_half(t) || mesh.is_half(other))) continue;
    faces.add(mesh, h);
    file.lines.add({static_cast<std::int32_t>(mesh.origin(h).index), static_cast<std::int32_t>(mesh.target(h).index)},
                   0);
  }
  faces.write(file);
  if (!pairs.empty()) {
    std::vector<std::int32_t> numbers(mesh.n_triangles());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (const TriangleId t : pairs[i]) numbers[t.index] = static_cast<std::int32_t>(i + 1);
    }
    file.triangles.data.push_back({std::string(kQuadrilateral), 1, std::move(numbers)});
  }
  constexpr std::int32_t kFixed = 1;
  for (const VertexId v : mesh.vertices()) {
    if (mesh.is_fixed(v) && !mesh.is_frozen(v)) file.marked_points.add(static_cast<std::int32_t>(v.index), kFixed);
  }
  return file;
}

}  // namespace temper::io

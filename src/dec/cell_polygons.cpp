// Cells as polygons whose corners are shared: power cells from the corners that each cell has for itself, triangles
// from the vertices.
#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "dec/accurate.hpp"
#include "temper/detail/cells.hpp"

namespace temper {
namespace {

// Coinciding corners differ by the rounding in different cells. Relative to a cell's size, and to its coordinates: some
// units in the last place.
constexpr double kSameCorner = 1e-9, kRounding = 0x1p-48;

Vec3 in_space(Vec2 p) { return {p.x, p.y, 0}; }

/// Numbers corners in their order; a corner near an earlier one is merged with it.
class CornerNumbers {
 public:
  /// `reach`: an upper bound of `near` in all calls of add(). In a plane z is 0.
  CornerNumbers(double reach, bool plane) : step_(4 * reach), layers_(plane ? 0 : 1) {}
  std::uint32_t add(Vec3 at, double near);
  std::vector<Vec3> corners;

 private:
  using Cube = std::array<std::int64_t, 3>;
  [[nodiscard]] std::int64_t cube(double x) const { return static_cast<std::int64_t>(std::floor(x / step_)); }
  /// Different cubes may have one key: distances decide.
  [[nodiscard]] static std::uint64_t key(const Cube& c) {
    return static_cast<std::uint64_t>(c[0]) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(c[1]) +
           static_cast<std::uint64_t>(c[2]) * 0xbf58476d1ce4e5b9u;
  }
  double step_;
  std::int64_t layers_;  // of cubes to look at, above and below
  std::unordered_multimap<std::uint64_t, std::uint32_t> cubes_;
};

std::uint32_t CornerNumbers::add(Vec3 at, double near) {
  const Cube c = {cube(at.x), cube(at.y), cube(at.z)};
  for (std::int64_t i = c[0] - 1; i <= c[0] + 1; ++i) {
    for (std::int64_t j = c[1] - 1; j <= c[1] + 1; ++j) {
      for (std::int64_t k = c[2] - layers_; k <= c[2] + layers_; ++k) {
        const auto [first, last] = cubes_.equal_range(key({i, j, k}));
        for (auto known = first; known != last; ++known) {
          if (length(corners[known->second] - at) <= near) return known->second;
        }
      }
    }
  }
  const auto added = static_cast<std::uint32_t>(corners.size());
  cubes_.emplace(key(c), added);
  corners.push_back(at);
  return added;
}

/// A polygon of a cell with corners of its own.
struct OwnPolygon {
  std::uint32_t cell = 0;
  double area = 0;
  std::vector<Vec3> corners;
};

/// The distance at which a corner of the polygon is the same as another one.
double same_at(const std::vector<Vec3>& corners) {
  double size = 0, far = 0;
  for (const Vec3 c : corners) {
    size = std::max(size, length(c - corners.front()));
    far = std::max(far, length(c));
  }
  return std::max(kSameCorner * size, kRounding * far);
}

void set_points(CellPolygons& made, const Mesh& mesh, const std::vector<Vec3>& points) {
  const bool plane = mesh.space().is_plane();
  for (const Vec3 p : points) {
    if (plane)
      made.points.push_back({p.x, p.y});
    else
      made.sphere_points.push_back(p);
  }
}

/// Shares the corners of n polygons; `polygon(p)` makes one. Corners get their numbers clockwise, from the last one.
template <class Polygon>
void share_corners(CellPolygons& made, const Mesh& mesh, std::size_t n, const Polygon& polygon) {
  double reach = 0;
  for (std::size_t p = 0; p < n; ++p) reach = std::max(reach, same_at(polygon(p).corners));
  CornerNumbers numbers(reach, mesh.space().is_plane());
  made.starts.push_back(0);
  for (std::size_t p = 0; p < n; ++p) {
    const OwnPolygon own = polygon(p);
    const double near = same_at(own.corners);
    std::vector<std::uint32_t> shared;
    for (std::size_t i = own.corners.size(); i-- > 0;) {
      const std::uint32_t corner = numbers.add(own.corners[i], near);
      if (shared.empty() || shared.back() != corner) shared.push_back(corner);
    }
    while (shared.size() > 1 && shared.front() == shared.back()) shared.pop_back();
    made.cells.push_back(own.cell);
    made.corners.insert(made.corners.end(), shared.rbegin(), shared.rend());
    made.starts.push_back(made.corners.size());
    made.polygon_areas.push_back(own.area);
  }
  set_points(made, mesh, numbers.corners);
}

std::vector<CellFace> faces_between(const Mesh& mesh, const std::vector<PowerFace>& faces) {
  std::vector<CellFace> all;
  all.reserve(faces.size());
  for (const PowerFace& face : faces) {
    const WeightedPoint p = mesh.point(face.first), q = mesh.point(face.second, p);
    const double between = length(q.position() - p.position());
    all.push_back({face.first.index, face.second.index, face.width, 0.5 * accurate::doubled_crossing(p, q) / between,
                   0.5 * accurate::doubled_crossing(q, p) / between});
  }
  return all;
}

std::vector<CellFace> faces_between(const DecComplex& complex) {
  std::vector<CellFace> all;
  for (const DecEdge& e : complex.edges) {
    if (e.is_boundary()) continue;
    const bool swapped = e.right < e.left;
    const auto [first, second] = swapped ? std::pair(e.right, e.left) : std::pair(e.left, e.right);
    const auto [to_face, from_face] =
        swapped ? std::pair(e.right_height, e.left_height) : std::pair(e.left_height, e.right_height);
    all.push_back({first.index, second.index, e.length, to_face, from_face});
  }
  std::sort(all.begin(), all.end(), [](const CellFace& a, const CellFace& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
  return all;
}

CellPolygons triangle_polygons(const Mesh& mesh, const DecComplex& complex) {
  CellPolygons made;
  made.of = CellsOf::triangles;
  made.centers = mesh.space().is_plane() ? complex.orthocenters.raw() : std::vector<Vec2>();
  made.sphere_centers = complex.sphere_orthocenters.raw();
  made.areas = complex.areas.raw();
  for (const TriangleId t : mesh.triangles()) made.regions.push_back(mesh.region(t));
  made.region_shares.assign(made.areas.size(), 1.0);
  if (mesh.space().is_plane()) made.faces = faces_between(complex);
  if (mesh.space().is_periodic()) {  // an image of a vertex near each triangle
    share_corners(made, mesh, mesh.n_triangles(), [&](std::size_t p) {
      const auto [a, b, c] = mesh.points(TriangleId(p));
      return OwnPolygon{static_cast<std::uint32_t>(p),
                        made.areas[p],
                        {in_space(a.position()), in_space(b.position()), in_space(c.position())}};
    });
    return made;
  }
  std::vector<Vec3> places;
  for (const VertexId v : mesh.vertices()) places.push_back(mesh.space().place(mesh.point(v)));
  set_points(made, mesh, places);
  made.starts.push_back(0);
  for (const TriangleId t : mesh.triangles()) {
    made.cells.push_back(t.index);
    for (const VertexId v : mesh.corners(t)) made.corners.push_back(v.index);
    made.starts.push_back(made.corners.size());
  }
  made.polygon_areas = made.areas;
  return made;
}

}  // namespace

CellPolygons cell_polygons(const Mesh& mesh, const PowerCells& cells) {
  const bool plane = mesh.space().is_plane();
  CellPolygons made;
  for (const VertexId v : mesh.vertices()) {
    if (plane)
      made.centers.push_back(mesh.position(v));
    else
      made.sphere_centers.push_back(mesh.space().place(mesh.point(v)));
  }
  made.areas = cells.areas.raw();
  made.regions = cells.regions.raw();
  made.region_shares = cells.region_shares.raw();
  if (plane) made.faces = faces_between(mesh, cells.faces);
  share_corners(made, mesh, cells.n_polygons(), [&](std::size_t p) {
    OwnPolygon own = {cells.vertices[p].index, cells.polygon_areas[p], {}};
    for (std::size_t i = cells.starts[p]; i < cells.starts[p + 1]; ++i)
      own.corners.push_back(plane ? in_space(cells.corners[i]) : cells.sphere_corners[i]);
    return own;
  });
  return made;
}

CellPolygons cell_polygons(const Mesh& mesh, const DecComplex& complex, CellsOf of) {
  return of == CellsOf::triangles ? triangle_polygons(mesh, complex) : cell_polygons(mesh, power_cells(mesh, complex));
}

}  // namespace temper

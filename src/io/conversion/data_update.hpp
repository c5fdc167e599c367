// The parts of a file that follow a changed mesh: data of points and triangles, and lines.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "io/text/values.hpp"
#include "temper/detail/location.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// Says whether some weight is not 0. A mesh without weights is a file without them, for which some programs have no
/// place (DEVSIM).
[[nodiscard]] bool is_weighted(const MeshFile& file);
void drop_zero_weights(MeshFile& file);

/// The former point of each vertex in a file, invalid for a new vertex; empty: equal numbers.
using Former = IdVector<VertexId, VertexId>;

/// Data of the file for the vertices and triangles of the mesh: see update(). Reads the former points, triangles and
/// regions, which the file still has.
DataReport update_data(MeshFile& file, const Mesh& mesh, const Former& former, const UpdateOptions& options);

/// Flags of medit mark special points of the user's: a new point has none.
[[nodiscard]] bool is_flag(const DataArray& a);
/// The points that medit calls required: they must not move.
[[nodiscard]] std::vector<std::int32_t> required_points(const std::vector<DataArray>& point_data);

/// Linear between the corners that have a value (not NaN), if these have at least half of the shares; else NaN. So a
/// missing value stays missing, but spreads no farther than half-way to the next corners.
template <class AtPlace, class AtCorner>
double between_known(const AtPlace& place, const AtCorner& at_corner) {
  AtPlace known = place;
  known.n = 0;
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(place.n); ++k) {
    if (std::isnan(at_corner(place.corners[k]))) continue;
    const auto to = static_cast<std::size_t>(known.n++);
    known.corners[to] = place.corners[k];
    known.shares[to] = place.shares[k];
    sum += place.shares[k];
  }
  if (known.n == 0 || (known.n < place.n && sum < 0.5)) return std::numeric_limits<double>::quiet_NaN();
  if (known.n < place.n) std::ranges::for_each(known.shares, [sum](double& share) { share /= sum; });
  return interpolated(known, [&](VertexId v) { return double{at_corner(v)}; });
}

/// The value at a place: the linear interpolation of floating numbers; the common value of integers at all corners, if
/// any.
template <class T, class AtPlace>
std::optional<T> value_at(const std::vector<T>& values, std::size_t n, std::size_t component, const AtPlace& place) {
  const auto at_corner = [&](VertexId v) { return values[n * v.index + component]; };
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(between_known(place, at_corner));
  } else {
    const T first = at_corner(place.corners[0]);
    for (std::size_t k = 1; k < static_cast<std::size_t>(place.n); ++k) {
      if (at_corner(place.corners[k]) != first) return {};
    }
    return first;
  }
}

/// Elements by indices that may repeat.
template <class T>
std::vector<T> at(const std::vector<T>& values, const std::vector<std::size_t>& indices) {
  std::vector<T> result;
  result.reserve(indices.size());
  for (const std::size_t i : indices) result.push_back(values[i]);
  return result;
}
/// Rows of data by indices that may repeat.
void take_rows(std::vector<DataArray>& arrays, const std::vector<std::size_t>& indices);

/// The warning that names data which are dropped; nothing if there are none.
[[nodiscard]] std::optional<std::string> warning_of_dropped(const std::vector<std::string>& names,
                                                            std::string_view why);

/// Takes the point data of a file to the vertices of a mesh, and names each array in the report. Integers that differ
/// around a new vertex are dropped, with a warning. `former(v)`: the point of v, invalid for a new vertex. `places`: of
/// the vertices among the former elements; empty if no array is interpolated and no vertex is new.
template <class File, class M, class FormerOf, class Place>
void update_point_data(File& file, const M& mesh, const DataRules& rules, const FormerOf& former,
                       const IdVector<VertexId, Place>& places, DataReport& report) {
  const auto at_vertices = [&](const DataArray& a) {
    const bool stays = rules.of(a) == DataRule::keep || places.empty();
    const auto n = static_cast<std::size_t>(a.components);
    return std::visit(
        [&](const auto& values) -> std::optional<Values> {
          std::remove_cvref_t<decltype(values)> result;
          result.reserve(mesh.n_vertices() * n);
          for (const VertexId v : mesh.vertices()) {
            const VertexId was = former(v);
            for (std::size_t i = 0; i < n; ++i) {
              const auto value = stays && was.valid() ? std::optional(values[n * was.index + i])
                                 : is_flag(a)         ? std::optional(ElementOf<decltype(values)>())
                                                      : value_at(values, n, i, places[v]);
              if (!value) return {};
              result.push_back(*value);
            }
          }
          return result;
        },
        a.values);
  };
  std::vector<DataArray> left;
  for (DataArray& a : file.point_data) {
    const bool follows = rules.of(a) == DataRule::interpolate;
    std::optional<Values> values = at_vertices(a);
    (!values ? report.dropped : follows ? report.interpolated : report.kept).push_back(a.name);
    if (values) left.push_back({std::move(a.name), a.components, *std::move(values)});
  }
  file.point_data = std::move(left);
  if (auto warning = warning_of_dropped(report.dropped, "integers differ around a new point"))
    file.warnings.push_back(*std::move(warning));
}

/// Cuts the lines of the file at vertices that the mesh has inserted on them (`vertices` invalid). The lines have the
/// numbers of the mesh. In files with a marker for every boundary point (Triangle, medit), a new boundary point gets
/// the marker of its neighbors if both have the same.
void split_lines(MeshFile& file, const Mesh& mesh, const IdVector<VertexId, VertexId>& vertices);

// Lines that list the edges of a mesh, and no features of it.
//
// Some programs (Fluidity, whose meshes come from Triangle's edges) write each edge of a mesh as a line of tag 0. If
// these were constraints, nothing could flip. So if all inner edges are lines of one tag, these constrain nothing. The
// file that is written again has such a line for each inner edge.

/// Lines on all inner edges of a mesh, of one tag.
struct EdgeLines {
  std::vector<bool> lines;  ///< as LoadedMesh::edge_lines
  std::int32_t tag = 0;
  std::size_t n_inner_edges = 0;  ///< of the mesh
};
/// The edge lines of a file. Nothing if not all inner edges are lines of one tag, or there is only one. `edges` has the
/// edge of each line, invalid if it has none. O(n).
[[nodiscard]] std::optional<EdgeLines> find_edge_lines(const MeshFile& file, const VertexOfPoint& vertex_of_point,
                                                       const Mesh& mesh, const std::vector<HalfedgeId>& edges);

/// Puts the edges that flips have made into the place of the edges that are gone. The vertices of the lines stay, and
/// edge_lines stays right. O(n log n).
void replace_edge_lines(MeshFile& file, const std::vector<bool>& edge_lines, const Mesh& mesh);

/// For meshes with other vertices: takes the lines out before the rest of the file follows. Afterwards it puts them
/// behind all other lines, one for each inner edge.
class EdgeLinesTakenOut {
 public:
  EdgeLinesTakenOut(MeshFile& file, const std::vector<bool>& edge_lines);
  void put_back(MeshFile& file, const Mesh& mesh) const;

 private:
  std::int32_t tag_ = 0;
  std::vector<Values> rows_;  // of each array of line data
};

}  // namespace temper::io

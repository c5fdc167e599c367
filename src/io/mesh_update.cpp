// From a mesh back to the arrays of the file that it came from.
//
// Coordinates, weights, triangles and regions are the mesh's; everything else is the file's and goes with its point,
// its line or its triangle. When vertices were removed or inserted, the points that are left keep their data, bit for
// bit; those of new points are interpolated on the mesh of before.
#include <algorithm>
#include <cstring>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "io/failure.hpp"
#include "io/file_names.hpp"
#include "io/input.hpp"
#include "io/interpolation.hpp"
#include "io/line_cuts.hpp"
#include "io/values.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

/// Copies what is on the mesh to arrays of its own vertices.
void copy_vertices(MeshFile& file, const Mesh& mesh) {
  file.points.resize(mesh.n_vertices());
  file.weights.resize(mesh.n_vertices());
  for (const VertexId v : mesh.vertices()) {
    file.points[v.index] = mesh.position(v);
    file.weights[v.index] = mesh.weight(v);
  }
}

void copy_triangles(MeshFile& file, const Mesh& mesh) {
  file.triangles.resize(mesh.n_triangles());
  bool regions = !file.regions.empty();
  for (const TriangleId t : mesh.triangles()) {
    const auto corners = mesh.corners(t);
    for (std::size_t k = 0; k < 3; ++k) file.triangles[t.index][k] = static_cast<std::int32_t>(corners[k].index);
    regions = regions || mesh.region(t) != 0;
  }
  file.regions.resize(regions ? mesh.n_triangles() : 0);
  for (std::size_t t = 0; t < file.regions.size(); ++t) file.regions[t] = mesh.region(TriangleId(t));
}

template <class T>
void keep(std::vector<T>& values, const std::vector<bool>& kept) {
  std::size_t n = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (kept[i]) values[n++] = values[i];
  }
  values.resize(n);
}

void keep(std::vector<DataArray>& arrays, const std::vector<bool>& kept) {
  RunLength indices;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) indices.push_back(static_cast<std::int64_t>(i));
  }
  for (DataArray& a : arrays) a.values = gather(a.values, a.components, indices);
}

/// Renumbers lines and marked points by new_index (−1: gone) and drops those that lost a point.
template <class NewIndex>
void renumber(MeshFile& file, NewIndex new_index) {
  std::vector<bool> kept_lines(file.lines.size());
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    for (std::int32_t& p : file.lines[i]) p = new_index(p);
    kept_lines[i] = file.lines[i][0] >= 0 && file.lines[i][1] >= 0;
  }
  std::vector<bool> kept_points(file.marked_points.size());
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) {
    file.marked_points[i] = new_index(file.marked_points[i]);
    kept_points[i] = file.marked_points[i] >= 0;
  }
  keep(file.lines, kept_lines);
  keep(file.line_tags, kept_lines);
  keep(file.line_data, kept_lines);
  keep(file.marked_points, kept_points);
  keep(file.point_tags, kept_points);
  keep(file.marked_point_data, kept_points);
}

void drop_unused_points(MeshFile& file, const VertexOfPoint& vertex_of_point) {
  std::vector<bool> used(vertex_of_point.size());
  for (std::size_t p = 0; p < used.size(); ++p) used[p] = vertex_of_point[p] >= 0;
  keep(file.points, used);
  keep(file.point_data, used);
  for (auto& triangle : file.triangles) {
    for (std::int32_t& p : triangle) p = vertex_of_point[static_cast<std::size_t>(p)];
  }
  renumber(file, [&](std::int32_t p) { return vertex_of_point[static_cast<std::size_t>(p)]; });
}

struct PlaceHash {
  std::size_t operator()(Vec2 p) const {
    std::uint64_t x, y;
    p = {p.x + 0.0, p.y + 0.0};  // −0 is the same place as 0
    std::memcpy(&x, &p.x, sizeof x);
    std::memcpy(&y, &p.y, sizeof y);
    return static_cast<std::size_t>((x * 0x9E3779B97F4A7C15u) ^ (y + (x >> 29)) * 0xBF58476D1CE4E5B9u);
  }
};

/// Vertices were removed or inserted: what is on lines has not moved and is found again by its place.
void find_again(MeshFile& file, const Mesh& mesh) {
  std::unordered_map<Vec2, std::int32_t, PlaceHash> places;
  for (const VertexId v : mesh.vertices()) places.emplace(mesh.position(v), static_cast<std::int32_t>(v.index));
  const std::vector<Vec2> old = file.points;
  const std::size_t n_lines = file.lines.size(), n_marked = file.marked_points.size();
  renumber(file, [&](std::int32_t p) {
    const auto found = places.find(old[static_cast<std::size_t>(p)]);
    return found == places.end() ? std::int32_t{-1} : found->second;
  });
  const std::size_t lost = n_lines - file.lines.size() + n_marked - file.marked_points.size();
  if (lost > 0) file.warnings.push_back(text(lost, " lines or marked points have lost their vertices and are dropped"));
}

void drop_data(MeshFile& file, std::vector<DataArray>& arrays, std::string_view kind) {
  std::string names;
  for (const DataArray& a : arrays) names += text(names.empty() ? "" : ", ", a.name);
  if (!names.empty()) file.warnings.push_back(text("the mesh has changed in number: ", kind, " is dropped: ", names));
  arrays.clear();
}

// --- vertices that were removed or inserted
// -------------------------------------------------------------------------------

using NewNumbers = std::vector<std::int32_t>;  // of the points before; −1: removed

/// A vertex on a straight line may be removed: the two lines that met there are one.
///
///     a --i-- v --j-- b     becomes    a --i-- b
class LineMerger {
 public:
  LineMerger(MeshFile& file, const NewNumbers& new_index) : file_(file), new_index_(new_index) {
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      for (const std::int32_t p : file.lines[i]) {
        if (removed(p)) lines_at_[p].push_back(i);
      }
    }
  }
  /// Lines that others stand for now. They are left with a removed vertex at both ends, for renumber() to drop.
  std::size_t merge() {
    std::size_t merged = 0;
    for (std::size_t p = 0; p < new_index_.size(); ++p) merged += merge_at(static_cast<std::int32_t>(p)) ? 1 : 0;
    return merged;
  }

 private:
  [[nodiscard]] bool removed(std::int32_t p) const { return new_index_[static_cast<std::size_t>(p)] < 0; }
  bool merge_at(std::int32_t v) {
    const auto found = lines_at_.find(v);
    if (found == lines_at_.end() || found->second.size() != 2) return false;
    const std::size_t i = std::min(found->second[0], found->second[1]);
    const std::size_t j = std::max(found->second[0], found->second[1]);
    if (i == j || file_.line_tags[i] != file_.line_tags[j]) return false;
    auto &kept = file_.lines[i], &gone = file_.lines[j];
    const std::int32_t far = gone[0] == v ? gone[1] : gone[0];
    kept[kept[0] == v ? 0 : 1] = far;
    gone = {v, v};
    if (removed(far)) std::replace(lines_at_[far].begin(), lines_at_[far].end(), j, i);
    return true;
  }

  MeshFile& file_;
  const NewNumbers& new_index_;
  std::unordered_map<std::int32_t, std::vector<std::size_t>> lines_at_;  // of removed points
};

/// Flags of medit say what is special about a point of the user's: nothing is about a new one.
bool is_flag(const DataArray& a) { return a.name == "medit:corner" || a.name == "medit:required"; }

/// Point data of the kept points, then of the new ones: see update(). Reads the file's geometry of before.
void extend_point_data(MeshFile& file, const Mesh& mesh, const IdVector<VertexId, VertexId>& vertices) {
  RunLength old;
  std::vector<Vec2> places;
  for (const VertexId v : IdRange<VertexId>(vertices.size())) {
    if (vertices[v].valid()) {
      old.push_back(std::int64_t{vertices[v].index});
    } else {
      places.push_back(mesh.position(v));
    }
  }
  const bool released = file.triangles.empty();
  const bool needs_means = !places.empty() && !file.point_data.empty() && !released;
  const auto means = needs_means ? locate(file.points, file.triangles, places) : std::vector<PointMean>();
  std::vector<DataArray> kept, lost;
  for (DataArray& a : file.point_data) {
    DataArray of_new = a;
    bool known = places.empty();
    if (!known && is_flag(a)) {
      of_new.values = zeros(scalar_of(a.values), places.size() * static_cast<std::size_t>(a.components));
      known = true;
    } else if (needs_means && append_means(of_new, means)) {
      RunLength appended(static_cast<std::int64_t>(file.points.size()), places.size());
      of_new.values = gather(of_new.values, a.components, appended);
      known = true;
    }
    if (known) {
      a.values = gather(a.values, a.components, old);
      if (!places.empty()) append(a.values, of_new.values);
    }
    (known ? kept : lost).push_back(std::move(a));
  }
  file.point_data = std::move(kept);
  drop_data(file, lost, "point data");
}

void keep_vertices(MeshFile& file, std::size_t n_before, const Mesh& mesh,
                   const IdVector<VertexId, VertexId>& vertices) {
  extend_point_data(file, mesh, vertices);
  NewNumbers new_index(n_before, -1);
  for (const VertexId v : IdRange<VertexId>(vertices.size())) {
    if (vertices[v].valid()) new_index[vertices[v].index] = static_cast<std::int32_t>(v.index);
  }
  const std::size_t n_lines = file.lines.size(), n_marked = file.marked_points.size();
  const std::size_t merged = LineMerger(file, new_index).merge();
  renumber(file, [&](std::int32_t p) { return new_index[static_cast<std::size_t>(p)]; });
  const std::size_t lost = n_lines - merged - file.lines.size() + n_marked - file.marked_points.size();
  if (lost > 0) file.warnings.push_back(text(lost, " lines or marked points have lost their vertices and are dropped"));
  cut_lines(file, mesh, vertices);
}

/// The same bytes at the two tuples?
bool same_tuple(const DataArray& a, std::size_t s, std::size_t t) {
  return std::visit(
      [&](const auto& v) {
        const std::size_t bytes = static_cast<std::size_t>(a.components) * sizeof v[0];
        const auto* data = reinterpret_cast<const char*>(v.data());
        return std::memcmp(data + s * bytes, data + t * bytes, bytes) == 0;
      },
      a.values);
}

/// Triangles are others than before, but each is within one region: what a region's triangles had in common they have.
/// Reads the file's regions of before.
void keep_region_data(MeshFile& file, const Mesh& mesh) {
  if (file.cell_data.empty()) return;
  const DataArray& any = file.cell_data.front();
  const std::size_t n_before = size(any.values) / static_cast<std::size_t>(any.components);
  std::unordered_map<std::int32_t, std::size_t> first_of_region;
  std::vector<std::size_t> first(n_before);
  for (std::size_t t = 0; t < n_before; ++t) {
    first[t] = first_of_region.emplace(file.regions.empty() ? 0 : file.regions[t], t).first->second;
  }
  RunLength source;
  for (const TriangleId t : mesh.triangles()) {
    const auto found = first_of_region.find(mesh.region(t));
    if (found == first_of_region.end()) return drop_data(file, file.cell_data, "cell data");
    source.push_back(static_cast<std::int64_t>(found->second));
  }
  std::vector<DataArray> kept, lost;
  for (DataArray& a : file.cell_data) {
    bool by_region = true;
    for (std::size_t t = 0; t < n_before && by_region; ++t) by_region = same_tuple(a, first[t], t);
    if (by_region) a.values = gather(a.values, a.components, source);
    (by_region ? kept : lost).push_back(std::move(a));
  }
  file.cell_data = std::move(kept);
  drop_data(file, lost, "cell data");
}

}  // namespace

void update(MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh, const IdVector<VertexId, VertexId>& vertices) {
  const auto& vertex = loaded.vertex_of_point;
  const std::size_t n_kept = vertex.n_kept();
  const bool has_unused = file.points.size() == vertex.size() && n_kept < vertex.size();
  if (has_unused) drop_unused_points(file, vertex);
  const bool released = file.points.empty();
  const bool renumbered = !vertices.empty() && (released || file.points.size() == n_kept);  // else it was done before
  if (renumbered) {
    keep_vertices(file, n_kept, mesh, vertices);
    keep_region_data(file, mesh);
  } else if (!released && (mesh.n_vertices() != file.points.size() || mesh.n_triangles() != file.triangles.size())) {
    find_again(file, mesh);
    drop_data(file, file.point_data, "point data");
    keep_region_data(file, mesh);
  }
  copy_vertices(file, mesh);
  copy_triangles(file, mesh);
  if (has_unused || renumbered) file.numbering = nullptr;  // the file's numbers are no longer those of its points
}

void release_geometry(MeshFile& file, const LoadedMesh& loaded) {
  if (file.points.size() != loaded.mesh.n_vertices()) return;
  std::vector<Vec2>().swap(file.points);  // assigning {} would keep the capacity
  std::vector<double>().swap(file.weights);
  std::vector<std::array<std::int32_t, 3>>().swap(file.triangles);
  give_memory_back();
}

MeshFile from_mesh(const Mesh& mesh) {
  MeshFile file;
  copy_vertices(file, mesh);
  copy_triangles(file, mesh);
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_constrained(h) || mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    // An interface between regions is constrained by them; any other line has to be written.
    if (mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)))) continue;
    file.lines.push_back(
        {static_cast<std::int32_t>(mesh.origin(h).index), static_cast<std::int32_t>(mesh.target(h).index)});
    file.line_tags.push_back(0);
  }
  return file;
}

}  // namespace temper::io

// From a mesh of tetrahedra back to the arrays of the file that it came from.
//
// Points, weights, tetrahedra and regions are the mesh's. Everything else is the file's, and goes with its point, its
// face, its line or its tetrahedron. Data belong to places, as in the plane: a walk finds the former tetrahedron.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "io/conversion/data_update.hpp"
#include "io/conversion/globe.hpp"
#include "io/disk/files.hpp"
#include "io/text/failure.hpp"
#include "io/text/file_names.hpp"
#include "io/text/values.hpp"
#include "temper/io.hpp"

namespace temper::io {
namespace {

using tets::HalffaceId;
using tets::TetId;
using tets::TetMesh;

// The longest walk before all tetrahedra are tried. A vertex step crosses a few, and a walk that circles must end.
constexpr int kLongestWalk = 200;

/// A point as a weighted mean of the corners around it: temper::Place, with a dimension more.
struct TetPlace {
  TetId tetrahedron;
  int n = 0;
  std::array<VertexId, 4> corners = {};
  std::array<double, 4> shares = {1, 0, 0, 0};
};

/// A face of t that has p on its outer side; nothing if p is in t.
std::optional<int> face_towards(const TetMesh& mesh, TetId t, Vec3 p, int first) {
  for (int k = 0; k < 4; ++k) {
    const int f = (first + k) % 4;
    const auto [a, b, c] = mesh.vertices(TetMesh::halfface(t, f));
    if (tets::orientation(mesh.position(a), mesh.position(b), mesh.position(c), p) == Sign::negative) return f;
  }
  return std::nullopt;
}

/// Says whether p is in t, or so close to it that rounding may have moved it outside: a new vertex on the boundary.
bool is_nearly_in(const TetMesh& mesh, TetId t, Vec3 p) {
  constexpr double kRounding = 1e-9;
  for (int f = 0; f < 4; ++f) {
    const HalffaceId h = TetMesh::halfface(t, f);
    const auto corners = mesh.vertices(h);
    const auto volumes = [&](Vec3 q) {
      return tets::six_volumes(mesh.position(corners[0]), mesh.position(corners[1]), mesh.position(corners[2]), q);
    };
    if (volumes(p) < -kRounding * volumes(mesh.position(mesh.opposite(h)))) return false;
  }
  return true;
}

/// The tetrahedron that contains p, found from one nearby. Without one, the result is `near`.
TetId locate(const TetMesh& mesh, Vec3 p, TetId near) {
  TetId t = near;
  for (int steps = 0; steps < kLongestWalk; ++steps) {
    const std::optional<int> face = face_towards(mesh, t, p, steps);
    if (!face) return t;
    const HalffaceId beyond = mesh.twin(TetMesh::halfface(t, *face));
    if (!beyond.valid()) {
      if (is_nearly_in(mesh, t, p)) return t;
      break;  // the domain need not be convex: p may still be inside
    }
    t = TetMesh::tetrahedron(beyond);
  }
  // Ever larger rings around the place where the walk ended.
  std::vector<TetId> reached = {t};
  std::unordered_set<std::uint32_t> seen = {t.index};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const TetId s = reached[i];
    if (is_nearly_in(mesh, s, p)) return s;
    for (int f = 0; f < 4; ++f) {
      const HalffaceId beyond = mesh.twin(TetMesh::halfface(s, f));
      if (!beyond.valid()) continue;
      const TetId next = TetMesh::tetrahedron(beyond);
      if (seen.insert(next.index).second) reached.push_back(next);
    }
  }
  return near;
}

/// The place of p, which is in t.
TetPlace place_in(const TetMesh& mesh, TetId t, Vec3 p) {
  const auto& corners = mesh.corners(t);
  TetPlace place{t};
  double sum = 0;
  for (int f = 0; f < 4; ++f) {
    const VertexId v = corners[static_cast<std::size_t>(f)];
    if (mesh.position(v) == p) return {t, 1, {v}, {1}};
    const auto [a, b, c] = mesh.vertices(TetMesh::halfface(t, f));
    const double share = tets::six_volumes(mesh.position(a), mesh.position(b), mesh.position(c), p);
    if (!(share > 0)) continue;
    const auto to = static_cast<std::size_t>(place.n++);
    place.corners[to] = v;
    sum += place.shares[to] = share;
  }
  if (place.n == 0) return {t, 1, {corners[0]}, {1}};  // in a tetrahedron that is all rounding
  for (double& share : place.shares) share /= sum;
  return place;
}

/// Tags that the mesh has dropped may name points out of range: they are lost, too.
void renumber(std::int32_t& p, const std::vector<std::int32_t>& number) {
  p = p >= 0 && static_cast<std::size_t>(p) < number.size() ? number[static_cast<std::size_t>(p)] : -1;
}
template <std::size_t N>
void renumber(std::array<std::int32_t, N>& element, const std::vector<std::int32_t>& number) {
  for (std::int32_t& p : element) renumber(p, number);
}
template <class Element>
void renumber(std::vector<Element>& elements, const std::vector<std::int32_t>& number) {
  for (Element& element : elements) renumber(element, number);
}

bool is_there(std::int32_t point) { return point >= 0; }
template <std::size_t N>
bool is_there(const std::array<std::int32_t, N>& element) {
  return std::ranges::all_of(element, [](std::int32_t p) { return p >= 0; });
}

/// Drops the cells that lost a point, with their tags and data.
template <int dimension>
void drop_lost(Cells<dimension>& cells) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (is_there(cells[i])) kept.push_back(i);
  }
  if (kept.size() == cells.size()) return;
  cells.corners = at(cells.corners, kept);
  cells.tags = at(cells.tags, kept);
  take_rows(cells.data, kept);
}

/// Numbers of the vertices of a face or line.
template <std::size_t N>
std::array<std::int32_t, N> numbers(const std::array<VertexId, N>& corners) {
  std::array<std::int32_t, N> result;
  std::ranges::transform(corners, result.begin(), [](VertexId v) { return static_cast<std::int32_t>(v.index); });
  return result;
}
template <std::size_t N>
bool same_corners(std::array<std::int32_t, N> a, std::array<std::int32_t, N> b) {
  std::ranges::sort(a), std::ranges::sort(b);
  return a == b;
}
/// Says whether a goes through its corners in the direction of b, which has the same.
template <std::size_t N>
bool turn_alike(const std::array<std::int32_t, N>& a, const std::array<std::int32_t, N>& b) {
  const auto first = static_cast<std::size_t>(std::ranges::find(b, a[0]) - b.begin());
  return a[1] == b[(first + 1) % N] && (N > 2 || first == 0);
}

/// The tagged faces or lines of two meshes: each of the second is a piece of one of the first, in the same order.
template <class Element>
struct Pieces {
  const std::vector<Element>&former, &now;
  const std::vector<std::uint32_t>& origins;
};
/// Renumbers elements, or puts pieces in their place. Those that are not in the mesh follow their points. Returns the
/// number of those that lost one, which are dropped.
template <int dimension>
std::size_t take_pieces(Cells<dimension>& cells, const std::vector<std::int32_t>& number,
                        const Pieces<typename Cells<dimension>::Corners>& pieces) {
  std::vector<typename Cells<dimension>::Corners> taken;
  std::vector<std::size_t> rows;
  std::size_t tag = 0, piece = 0, lost = 0;
  for (std::size_t row = 0; row < cells.size(); ++row) {
    auto element = cells[row];
    const bool is_tag = tag < pieces.former.size() && same_corners(element, pieces.former[tag]);
    const bool alike = is_tag && turn_alike(element, pieces.former[tag]);
    renumber(element, number);
    const std::size_t first = piece;
    while (is_tag && piece < pieces.now.size() && pieces.origins[piece] == tag) ++piece;
    tag += is_tag ? 1 : 0;
    if (piece - first > 1) {
      for (std::size_t i = first; i < piece; ++i) {
        taken.push_back(pieces.now[i]);
        if (!alike) std::swap(taken.back()[0], taken.back()[1]);
        rows.push_back(row);
      }
    } else if (is_there(element)) {
      taken.push_back(element);
      rows.push_back(row);
    } else {
      ++lost;
    }
  }
  cells.corners = std::move(taken);
  cells.tags = at(cells.tags, rows);
  take_rows(cells.data, rows);
  return lost;
}

class TetUpdater {
 public:
  TetUpdater(MeshFile& file, const LoadedTetMesh& loaded, const TetMesh& mesh, const tets::Origins& origins,
             const UpdateOptions& options)
      : file_(file), loaded_(loaded), before_(loaded.mesh), mesh_(mesh), origins_(origins), options_(options) {}

  DataReport update() {
    drop_unused_points();
    if (!file_.point_data.empty() || !file_.tetrahedra.data.empty()) update_data();
    if (!origins_.vertices.empty()) follow_vertices();
    copy_mesh();
    return std::move(report_);
  }

 private:
  [[nodiscard]] VertexId former(VertexId v) const { return origins_.vertices.empty() ? v : origins_.vertices[v]; }
  [[nodiscard]] bool stays(VertexId v) const {
    const VertexId was = former(v);
    return was.valid() && before_.position(was) == mesh_.position(v);
  }
  void drop_unused_points() {
    const VertexOfPoint& vertex = loaded_.vertex_of_point;
    if (vertex.n_kept() == vertex.size() || file_.points.size() != vertex.size()) return;
    std::vector<std::int32_t> number;
    std::vector<std::size_t> used;
    for (std::size_t p = 0; p < vertex.size(); ++p) {
      number.push_back(vertex[p]);
      if (vertex[p] >= 0) used.push_back(p);
    }
    take_rows(file_.point_data, used);
    renumber_tags(number);
    file_.numbering = nullptr;  // its numbers no longer fit the points
  }
  void renumber_tags(const std::vector<std::int32_t>& number) {
    renumber(file_.triangles.corners, number);
    renumber(file_.lines.corners, number);
    renumber(file_.marked_points.corners, number);
    drop_lost(file_.triangles);
    drop_lost(file_.lines);
    drop_lost(file_.marked_points);
  }
  void follow_vertices() {
    std::vector<std::int32_t> number(before_.n_vertices(), -1);
    for (const VertexId v : mesh_.vertices()) {
      if (former(v).valid()) number[former(v).index] = static_cast<std::int32_t>(v.index);
    }
    if (!file_.marked_points.empty()) mark_new_vertices(number);
    std::vector<std::array<std::int32_t, 3>> faces_before, faces;
    std::vector<std::array<std::int32_t, 2>> lines_before, lines;
    for (const auto& f : before_.tagged_faces()) faces_before.push_back(numbers(before_.vertices(f.face)));
    for (const auto& l : before_.tagged_lines()) lines_before.push_back(numbers(l.ends));
    for (const auto& f : mesh_.tagged_faces()) faces.push_back(numbers(mesh_.vertices(f.face)));
    for (const auto& l : mesh_.tagged_lines()) lines.push_back(numbers(l.ends));
    const std::size_t lost = take_pieces(file_.triangles, number, {faces_before, faces, origins_.faces}) +
                             take_pieces(file_.lines, number, {lines_before, lines, origins_.lines});
    renumber(file_.marked_points.corners, number);
    const std::size_t marked = file_.marked_points.size();
    drop_lost(file_.marked_points);
    if (const std::size_t all = lost + marked - file_.marked_points.size(); all > 0)
      file_.warnings.push_back(text(all, " tags are dropped, because their faces, lines or points have lost vertices"));
    file_.numbering = nullptr;
  }
  /// A tag that all corners of a tetrahedron have lists the vertices of a part. A new vertex in it belongs to the part,
  /// too. New vertices get numbers after those of the file, until all are renumbered.
  void mark_new_vertices(std::vector<std::int32_t>& number) {
    using Mark = std::pair<std::int32_t, std::int32_t>;  // point, tag
    std::map<Mark, std::size_t> marks;
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < file_.marked_points.size(); ++i) {
      marks.emplace(Mark(file_.marked_points[i], file_.marked_points.tags[i]), i);
      rows.push_back(i);
    }
    for (const VertexId v : mesh_.vertices()) {
      if (former(v).valid()) continue;
      const auto& corners = before_.corners(locate(before_, mesh_.position(v), near(mesh_.incident(v))));
      const auto mark = [](VertexId corner, std::int32_t tag) { return Mark(corner.index, tag); };
      for (auto at = marks.lower_bound(mark(corners[0], std::numeric_limits<std::int32_t>::min()));
           at != marks.end() && at->first.first == mark(corners[0], 0).first; ++at) {
        const std::int32_t tag = at->first.second;
        if (!std::ranges::all_of(corners, [&](VertexId c) { return marks.contains(mark(c, tag)); })) continue;
        file_.marked_points.add(static_cast<std::int32_t>(number.size()), tag);
        rows.push_back(at->second);
      }
      number.push_back(static_cast<std::int32_t>(v.index));
    }
    take_rows(file_.marked_points.data, rows);
  }
  void copy_mesh() {
    std::vector<Vec3> points;
    file_.weights.clear();
    bool weighted = false;
    for (const VertexId v : mesh_.vertices()) {
      points.push_back(mesh_.position(v));
      file_.weights.push_back(mesh_.weight(v));
      weighted = weighted || mesh_.weight(v) != 0;
    }
    if (!weighted) file_.weights = {};
    put_in_space(file_, points);
    bool regions = !file_.tetrahedra.tags.empty();
    file_.tetrahedra.corners.clear();
    for (const TetId t : mesh_.tetrahedra()) {
      auto& corners = file_.tetrahedra.corners.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) corners[k] = static_cast<std::int32_t>(mesh_.corners(t)[k].index);
      regions = regions || mesh_.region(t) != 0;
    }
    file_.tetrahedra.tags.clear();
    for (const TetId t : mesh_.tetrahedra()) {
      if (regions) file_.tetrahedra.tags.push_back(mesh_.region(t));
    }
  }

  // --- data ------------------------------------------------------------------------------------------
  void update_data() {
    measure();
    const auto moves = [&](const DataArray& a) { return options_.rules.of(a) == DataRule::interpolate; };
    if (report_.points_inserted > 0 || (report_.points_moved > 0 && std::ranges::any_of(file_.point_data, moves)))
      find_places();
    update_point_data(
        file_, mesh_, options_.rules, [this](VertexId v) { return former(v); }, places_, report_);
    for (DataArray& a : file_.tetrahedra.data) report_.of_triangles.push_back(a.name);
    if (report_.triangles_changed > 0 && !file_.tetrahedra.data.empty()) take_rows(file_.tetrahedra.data, sources());
  }
  void measure() {
    std::vector<double> distances;
    for (const VertexId v : mesh_.vertices()) {
      const VertexId was = former(v);
      ++(was.valid() ? report_.points : report_.points_inserted);
      if (was.valid() && !stays(v)) distances.push_back(length(mesh_.position(v) - before_.position(was)));
    }
    report_.points_moved = distances.size();
    report_.distance = spread(std::move(distances));
    report_.triangles = mesh_.n_tetrahedra();
    for (const TetId t : mesh_.tetrahedra()) report_.triangles_changed += is_same(t) ? 0 : 1;
  }
  /// Says whether tetrahedron t has the same corners as in the file, at the same places.
  [[nodiscard]] bool is_same(TetId t) const {
    if (t.index >= before_.n_tetrahedra()) return false;
    std::array<VertexId, 4> now, then = before_.corners(t);
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId v = mesh_.corners(t)[k];
      if (!stays(v)) return false;
      now[k] = former(v);
    }
    std::ranges::sort(now), std::ranges::sort(then);
    return now == then;
  }
  /// A former tetrahedron near t, to start a walk from.
  [[nodiscard]] TetId near(TetId t) const {
    for (const VertexId v : mesh_.corners(t)) {
      if (former(v).valid()) return before_.incident(former(v));
    }
    return TetId(0);
  }
  /// Calls use(i) for each of n items, on threads.
  template <class Use>
  void for_each(std::size_t n, const Use& use) const {
    constexpr std::size_t kItems = 4096;
    or_serial(options_.executor).run((n + kItems - 1) / kItems, [&](std::size_t block) {
      for (std::size_t i = kItems * block; i < std::min(n, kItems * (block + 1)); ++i) use(i);
    });
  }
  void find_places() {
    places_.resize(mesh_.n_vertices());
    for_each(mesh_.n_vertices(), [&](std::size_t i) {
      const VertexId v(i), was = former(v);
      const TetId from = was.valid() ? before_.incident(was) : near(mesh_.incident(v));
      places_[v] = stays(v) ? TetPlace{from, 1, {was}, {1}}
                            : place_in(before_, locate(before_, mesh_.position(v), from), mesh_.position(v));
    });
  }
  /// The former tetrahedron of each.
  [[nodiscard]] std::vector<std::size_t> sources() const {
    std::vector<std::size_t> all(mesh_.n_tetrahedra());
    for_each(all.size(), [&](std::size_t i) {
      const TetId t(i);
      Vec3 sum;
      for (const VertexId v : mesh_.corners(t)) sum = sum + mesh_.position(v);
      all[i] = is_same(t) ? i : locate(before_, 0.25 * sum, near(t)).index;
    });
    return all;
  }

  MeshFile& file_;
  const LoadedTetMesh& loaded_;
  const TetMesh &before_, &mesh_;
  const tets::Origins& origins_;
  const UpdateOptions& options_;
  IdVector<VertexId, TetPlace> places_;  // of the vertices in the former mesh; empty: not needed
  DataReport report_;
};

}  // namespace

DataReport update(MeshFile& file, const LoadedTetMesh& loaded, const tets::TetMesh& mesh, const tets::Origins& origins,
                  const UpdateOptions& options) {
  return TetUpdater(file, loaded, mesh, origins, options).update();
}

void release_geometry(MeshFile& file, const LoadedTetMesh& loaded) {
  if (file.points.size() != loaded.mesh.n_vertices()) return;
  give_memory_back_of(file.points, std::get<SpacePoints>(file.points_in).heights, file.weights,
                      file.tetrahedra.corners);
}

}  // namespace temper::io

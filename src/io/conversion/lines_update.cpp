// Lines and marked points that follow a mesh of triangles with other vertices.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <unordered_map>
#include <utility>

#include "io/conversion/follow.hpp"
#include "io/conversion/format_traits.hpp"
#include "io/conversion/update.hpp"
#include "io/text/failure.hpp"

namespace temper::io {
namespace {

/// A vertex on a straight line may be removed: of each tag, the two lines that met there become one.
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
  /// Lines that were merged into others get a removed vertex at both ends, for renumber() to drop.
  std::size_t merge() {
    std::size_t merged = 0;
    for (std::size_t p = 0; p < new_index_.size(); ++p) merged += merge_at(static_cast<std::int32_t>(p));
    return merged;
  }

 private:
  [[nodiscard]] bool removed(std::int32_t p) const { return new_index_(p) < 0; }
  std::size_t merge_at(std::int32_t v) {
    const auto found = lines_at_.find(v);
    if (found == lines_at_.end()) return 0;
    std::map<std::int32_t, std::vector<std::size_t>> lines_of;  // by tag, ascending
    for (const std::size_t line : found->second) lines_of[file_.lines.tags[line]].push_back(line);
    std::size_t merged = 0;
    for (auto& [tag, lines] : lines_of) {
      std::sort(lines.begin(), lines.end());
      if (lines.size() != 2 || lines[0] == lines[1]) continue;
      join(v, lines[0], lines[1]);
      ++merged;
    }
    return merged;
  }
  void join(std::int32_t v, std::size_t i, std::size_t j) {
    auto &kept = file_.lines[i], &gone = file_.lines[j];
    const std::int32_t far = gone[0] == v ? gone[1] : gone[0];
    kept[kept[0] == v ? 0 : 1] = far;
    gone = {v, v};
    if (removed(far)) std::replace(lines_at_[far].begin(), lines_at_[far].end(), j, i);
  }

  MeshFile& file_;
  const NewNumbers& new_index_;
  std::unordered_map<std::int32_t, std::vector<std::size_t>> lines_at_;  // of removed points
};

/// Inserted vertices in a row along the boundary or a constrained line, between two of the file's.
struct Chain {
  VertexId a, b;
  std::vector<VertexId> inside;  ///< from a to b
};

/// The other ends of boundary and constrained edges at v.
std::vector<VertexId> along_lines(const Mesh& mesh, VertexId v) {
  std::vector<VertexId> ends;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.is_unflippable(h)) ends.push_back(mesh.target(h));
    if (mesh.is_boundary(Mesh::prev(h))) ends.push_back(mesh.opposite(h));
  }
  return ends;
}

class Chains {
 public:
  Chains(const Mesh& mesh, const Former& vertices) : mesh_(mesh), vertices_(vertices), seen_(vertices.size(), 0) {
    for (const VertexId v : mesh.vertices()) {
      if (inserted(v) && seen_[v] == 0) follow(v);
    }
  }

  [[nodiscard]] const std::vector<Chain>& all() const { return chains_; }
  /// The shortest chain from a to b, starting at a; empty when there is none.
  [[nodiscard]] std::vector<VertexId> between(VertexId a, VertexId b) const {
    const Chain* shortest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    const auto [first, last] = by_ends_.equal_range(std::minmax(a, b));
    for (auto found = first; found != last; ++found) {
      const double length = length_of(chains_[found->second]);
      if (length < least) shortest = &chains_[found->second];
      least = std::min(least, length);
    }
    if (shortest == nullptr) return {};
    std::vector<VertexId> inside = shortest->inside;
    if (shortest->a != a) std::reverse(inside.begin(), inside.end());
    return inside;
  }

 private:
  [[nodiscard]] bool inserted(VertexId v) const { return !vertices_[v].valid(); }

  void follow(VertexId v) {
    const std::vector<VertexId> ends = along_lines(mesh_, v);
    if (ends.size() != 2) return;
    Chain chain;
    chain.a = walk(v, ends[0], chain.inside);
    std::reverse(chain.inside.begin(), chain.inside.end());
    chain.inside.push_back(v);
    seen_[v] = 1;
    chain.b = walk(v, ends[1], chain.inside);
    if (inserted(chain.a) || inserted(chain.b)) return;
    by_ends_.emplace(std::minmax(chain.a, chain.b), chains_.size());
    chains_.push_back(std::move(chain));
  }

  /// Walks past `at`, coming from `from`, to the first vertex that is not inserted within a line.
  VertexId walk(VertexId from, VertexId at, std::vector<VertexId>& passed) {
    while (inserted(at) && seen_[at] == 0) {
      const std::vector<VertexId> ends = along_lines(mesh_, at);
      if (ends.size() != 2) break;
      seen_[at] = 1;
      passed.push_back(at);
      from = std::exchange(at, ends[0] == from ? ends[1] : ends[0]);
    }
    return at;
  }

  [[nodiscard]] double length_of(const Chain& chain) const {
    double sum = 0;
    WeightedPoint last = mesh_.point(chain.a);
    const auto add = [&](VertexId v) {
      const WeightedPoint next = mesh_.point(v, last);
      sum += length(next.position() - last.position());
      last = next;
    };
    for (const VertexId v : chain.inside) add(v);
    add(chain.b);
    return sum;
  }

  const Mesh& mesh_;
  const Former& vertices_;
  IdVector<VertexId, std::uint8_t> seen_;
  std::vector<Chain> chains_;
  std::multimap<std::pair<VertexId, VertexId>, std::size_t> by_ends_;
};

VertexId id(std::int32_t p) { return VertexId(static_cast<std::size_t>(p)); }
std::int32_t point(VertexId v) { return static_cast<std::int32_t>(v.index); }

bool is_edge(const Mesh& mesh, VertexId a, VertexId b) {
  return mesh.find_halfedge(a, b).valid() || mesh.find_halfedge(b, a).valid();
}

void cut_edges(MeshFile& file, const Mesh& mesh, const Chains& chains) {
  std::vector<std::array<std::int32_t, 2>> lines;
  std::vector<std::size_t> from;  // which line each is a piece of
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const VertexId a = id(file.lines[i][0]), b = id(file.lines[i][1]);
    VertexId last = a;
    if (!is_edge(mesh, a, b)) {
      for (const VertexId v : chains.between(a, b)) {
        lines.push_back({point(std::exchange(last, v)), point(v)});
        from.push_back(i);
      }
    }
    lines.push_back({point(last), point(b)});
    from.push_back(i);
  }
  file.lines.corners = std::move(lines);
  take_contents(file.lines, from);
}

void mark_new_points(MeshFile& file, const Mesh& mesh, const Chains& chains) {
  std::map<VertexId, std::size_t> mark_of;
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) mark_of.emplace(id(file.marked_points[i]), i);
  std::vector<std::size_t> from(file.marked_points.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
  for (const Chain& chain : chains.all()) {
    const auto a = mark_of.find(chain.a), b = mark_of.find(chain.b);
    if (a == mark_of.end() || b == mark_of.end() || !mesh.is_boundary(chain.inside.front())) continue;
    if (file.marked_points.tags[a->second] != file.marked_points.tags[b->second]) continue;
    for (const VertexId v : chain.inside) {
      file.marked_points.corners.push_back(point(v));
      from.push_back(a->second);
    }
  }
  take_contents(file.marked_points, from);
}

/// Cuts the lines of the file at vertices that the mesh has inserted on them. The lines have the numbers of the mesh.
void split_lines(MeshFile& file, const Mesh& mesh, const Former& vertices) {
  if (std::all_of(vertices.begin(), vertices.end(), [](VertexId v) { return v.valid(); })) return;
  const Chains chains(mesh, vertices);
  cut_edges(file, mesh, chains);
  if (traits_of(file).marks_boundary) mark_new_points(file, mesh, chains);
}

}  // namespace

void follow_lines(MeshFile& file, std::size_t n, const Mesh& mesh, const Former& former) {
  const NewNumbers new_index(n, mesh, [&](VertexId v) { return former[v]; });
  const std::size_t merged = LineMerger(file, new_index).merge();
  const std::size_t lost = renumber(file.lines, new_index) - merged + renumber(file.marked_points, new_index);
  if (lost > 0) file.warnings.push_back(text(lost, " lines or marked points have lost their vertices and are dropped"));
  split_lines(file, mesh, former);
}

}  // namespace temper::io

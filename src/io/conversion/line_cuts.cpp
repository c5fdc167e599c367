#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/text/file_names.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

using Vertices = IdVector<VertexId, VertexId>;

/// Inserted vertices in a row along the boundary or a constrained line, between two of the file's.
struct Chain {
  VertexId a, b;
  std::vector<VertexId> inside;  ///< from a to b
};

/// The other ends of boundary and constrained edges at v.
std::vector<VertexId> along_lines(const Mesh& mesh, VertexId v) {
  std::vector<VertexId> ends;
  for (const HalfedgeId h : mesh.star(v)) {
    if (mesh.keeps_its_place(h)) ends.push_back(mesh.target(h));
    if (mesh.is_boundary(Mesh::prev(h))) ends.push_back(mesh.opposite(h));
  }
  return ends;
}

class Chains {
 public:
  Chains(const Mesh& mesh, const Vertices& vertices) : mesh_(mesh), vertices_(vertices), seen_(vertices.size(), 0) {
    for (const VertexId v : mesh.vertices()) {
      if (inserted(v) && seen_[v] == 0) follow(v);
    }
  }

  [[nodiscard]] const std::vector<Chain>& all() const { return chains_; }
  /// The shortest one from a to b, from a on; empty when there is none.
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

  /// Past `at`, coming from `from`, to the first vertex that is not an inserted one within a line.
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
  const Vertices& vertices_;
  IdVector<VertexId, std::uint8_t> seen_;
  std::vector<Chain> chains_;
  std::multimap<std::pair<VertexId, VertexId>, std::size_t> by_ends_;
};

VertexId id(std::int32_t p) { return VertexId(static_cast<std::size_t>(p)); }
std::int32_t point(VertexId v) { return static_cast<std::int32_t>(v.index); }

bool is_edge(const Mesh& mesh, VertexId a, VertexId b) {
  return mesh.find_halfedge(a, b).valid() || mesh.find_halfedge(b, a).valid();
}

template <class T>
std::vector<T> at(const std::vector<T>& values, const std::vector<std::size_t>& indices) {
  std::vector<T> result;
  result.reserve(indices.size());
  for (const std::size_t i : indices) result.push_back(values[i]);
  return result;
}

/// Rows of data by indices that may repeat.
void take_rows(std::vector<DataArray>& arrays, const std::vector<std::size_t>& indices) {
  RunLength rows;
  for (const std::size_t i : indices) rows.push_back(static_cast<std::int64_t>(i));
  for (DataArray& a : arrays) a.values = gather(a.values, a.components, rows);
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
  file.lines = std::move(lines);
  file.line_tags = at(file.line_tags, from);
  take_rows(file.line_data, from);
}

void mark_new_points(MeshFile& file, const Mesh& mesh, const Chains& chains) {
  std::map<VertexId, std::size_t> mark_of;
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) mark_of.emplace(id(file.marked_points[i]), i);
  std::vector<std::size_t> from(file.marked_points.size());
  for (std::size_t i = 0; i < from.size(); ++i) from[i] = i;
  for (const Chain& chain : chains.all()) {
    const auto a = mark_of.find(chain.a), b = mark_of.find(chain.b);
    if (a == mark_of.end() || b == mark_of.end() || !mesh.is_boundary(chain.inside.front())) continue;
    if (file.point_tags[a->second] != file.point_tags[b->second]) continue;
    for (const VertexId v : chain.inside) {
      file.marked_points.push_back(point(v));
      from.push_back(a->second);
    }
  }
  file.point_tags = at(file.point_tags, from);
  take_rows(file.marked_point_data, from);
}

}  // namespace

void cut_lines(MeshFile& file, const Mesh& mesh, const Vertices& vertices) {
  if (std::all_of(vertices.begin(), vertices.end(), [](VertexId v) { return v.valid(); })) return;
  const Chains chains(mesh, vertices);
  cut_edges(file, mesh, chains);
  const bool marks_all_of_the_boundary = file.format == "triangle" || file.format == "medit";
  if (marks_all_of_the_boundary) mark_new_points(file, mesh, chains);
}

}  // namespace temper::io

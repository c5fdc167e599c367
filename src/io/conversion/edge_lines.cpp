#include "io/conversion/edge_lines.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "io/conversion/globe.hpp"
#include "io/text/failure.hpp"
#include "io/text/file_names.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

// With a single inner edge, a line on it may as well be a feature.
constexpr std::size_t kFewestEdges = 2;

using SortedEnds = std::array<std::int32_t, 2>;  // the lesser first

SortedEnds sorted_ends(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

void sort_unique(std::vector<SortedEnds>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

std::vector<SortedEnds> inner_edges(const Mesh& mesh) {
  std::vector<SortedEnds> all;
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || !mesh.is_edge_representative(h)) continue;
    all.push_back(
        sorted_ends(static_cast<std::int32_t>(mesh.origin(h).index), static_cast<std::int32_t>(mesh.target(h).index)));
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::size_t first_of(const std::vector<bool>& edge_lines) {
  return static_cast<std::size_t>(std::find(edge_lines.begin(), edge_lines.end(), true) - edge_lines.begin());
}

/// Drops arrays that differ between edges: they have no value for a new edge.
void drop_what_differs(MeshFile& file, const std::vector<bool>& edge_lines) {
  const std::size_t first = first_of(edge_lines);
  const auto differs = [&](const DataArray& array) {
    const auto k = static_cast<std::size_t>(array.components);
    return std::visit(
        [&](const auto& values) {
          const auto row = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i * k); };
          for (std::size_t i = first + 1; i < edge_lines.size(); ++i) {
            if (edge_lines[i] && !std::equal(row(i), row(i + 1), row(first))) return true;
          }
          return false;
        },
        array.values);
  };
  std::string names;
  std::erase_if(file.lines.data, [&](const DataArray& array) {
    if (!differs(array)) return false;
    names += text(names.empty() ? "" : ", ", array.name);
    return true;
  });
  if (!names.empty()) file.warnings.push_back(text("edges have changed: data of lines on them are dropped: ", names));
}

std::size_t count_inner_edges(const Mesh& mesh) {
  std::size_t n = 0;
  for (const HalfedgeId h : mesh.halfedges()) n += !mesh.is_boundary(h) && mesh.is_edge_representative(h) ? 1 : 0;
  return n;
}

}  // namespace

std::optional<EdgeLines> find_edge_lines(const MeshFile& file, const VertexOfPoint& vertex_of_point, const Mesh& mesh,
                                         const std::vector<HalfedgeId>& edges) {
  if (edges.empty()) return {};
  EdgeLines found;
  found.n_inner_edges = count_inner_edges(mesh);
  if (found.n_inner_edges < kFewestEdges || edges.size() < found.n_inner_edges) return {};
  std::vector<HalfedgeId> listed;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [a, b] = file.lines[i];
    if (vertex_of_point[static_cast<std::size_t>(a)] < 0 || vertex_of_point[static_cast<std::size_t>(b)] < 0) continue;
    const bool inner = edges[i].valid() && !mesh.is_boundary(edges[i]);
    found.lines.push_back(inner);
    if (!inner) continue;
    if (listed.empty()) found.tag = file.lines.tags[i];
    if (found.tag != file.lines.tags[i]) return {};
    listed.push_back(edges[i]);
  }
  std::sort(listed.begin(), listed.end());
  listed.erase(std::unique(listed.begin(), listed.end()), listed.end());
  return listed.size() == found.n_inner_edges ? std::optional(std::move(found)) : std::nullopt;
}

void replace_edge_lines(MeshFile& file, const std::vector<bool>& edge_lines, const Mesh& mesh) {
  std::vector<SortedEnds> listed;
  for (std::size_t i = 0; i < edge_lines.size(); ++i) {
    if (edge_lines[i]) listed.push_back(sorted_ends(file.lines[i][0], file.lines[i][1]));
  }
  sort_unique(listed);
  const std::vector<SortedEnds> edges = inner_edges(mesh);
  std::vector<SortedEnds> gone, made;
  std::set_difference(listed.begin(), listed.end(), edges.begin(), edges.end(), std::back_inserter(gone));
  std::set_difference(edges.begin(), edges.end(), listed.begin(), listed.end(), std::back_inserter(made));
  if (gone.empty() || gone.size() != made.size()) return;  // lines of another mesh are not replaced
  for (std::size_t i = 0; i < edge_lines.size(); ++i) {
    if (!edge_lines[i]) continue;
    const SortedEnds ends = sorted_ends(file.lines[i][0], file.lines[i][1]);
    const auto found = std::lower_bound(gone.begin(), gone.end(), ends);
    if (found == gone.end() || *found != ends) continue;
    // Flips keep the number of edges, so there is one for each.
    file.lines[i] = made[static_cast<std::size_t>(found - gone.begin())];
  }
  drop_what_differs(file, edge_lines);
}

EdgeLinesTakenOut::EdgeLinesTakenOut(MeshFile& file, const std::vector<bool>& edge_lines) {
  drop_what_differs(file, edge_lines);
  const std::size_t first = first_of(edge_lines);
  tag_ = file.lines.tags[first];
  RunLength others;
  std::size_t n = 0;
  for (std::size_t i = 0; i < edge_lines.size(); ++i) {
    if (edge_lines[i]) continue;
    others.push_back(static_cast<std::int64_t>(i));
    file.lines[n] = file.lines[i];
    file.lines.tags[n++] = file.lines.tags[i];
  }
  file.lines.corners.resize(n);
  file.lines.tags.resize(n);
  for (DataArray& array : file.lines.data) {
    rows_.push_back(gather(array.values, array.components, RunLength(static_cast<std::int64_t>(first), 1)));
    array.values = gather(array.values, array.components, others);
  }
}

void EdgeLinesTakenOut::put_back(MeshFile& file, const Mesh& mesh) const {
  const std::vector<SortedEnds> edges = inner_edges(mesh);
  file.lines.corners.insert(file.lines.end(), edges.begin(), edges.end());
  file.lines.tags.insert(file.lines.tags.end(), edges.size(), tag_);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    for (std::size_t i = 0; i < edges.size(); ++i) append(file.lines.data[k].values, rows_[k]);
  }
}

}  // namespace temper::io

#include "io/conversion/fixed_points.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "io/conversion/data_update.hpp"
#include "io/conversion/known_arrays.hpp"
#include "io/text/failure.hpp"
#include "io/text/names.hpp"
#include "io/text/values.hpp"

namespace temper::io {
namespace {

/// A tag, as a user writes it: its number or its physical name.
struct TagSet {
  std::vector<std::int32_t> points, lines, triangles;
};

std::string available_tags(const MeshFile& file) {
  std::vector<std::int32_t> tags(file.lines.tags);
  tags.insert(tags.end(), file.marked_points.tags.begin(), file.marked_points.tags.end());
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  std::string result;
  for (const PhysicalName& n : file.names) result += text(result.empty() ? "" : ", ", n.name);
  for (std::size_t i = 0; i < std::min(tags.size(), kNamed); ++i) result += text(result.empty() ? "" : ", ", tags[i]);
  return result.empty() ? "none" : result;
}

TagSet find_tags(const MeshFile& file, std::span<const std::string> wanted) {
  TagSet set;
  for (const std::string& tag : wanted) {
    bool found = false;
    for (const PhysicalName& n : file.names) {
      if (n.name != tag) continue;
      found = true;
      (n.dimension == 0 ? set.points : n.dimension == 1 ? set.lines : set.triangles).push_back(n.tag);
    }
    if (found) continue;
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(tag.data(), tag.data() + tag.size(), number);
    const auto has = [&](const std::vector<std::int32_t>& tags) {
      return std::find(tags.begin(), tags.end(), number) != tags.end();
    };
    if (error == std::errc() && end == tag.data() + tag.size() &&
        (has(file.lines.tags) || has(file.marked_points.tags) || has(file.triangles.tags))) {
      set.points.push_back(number);
      set.lines.push_back(number);
      set.triangles.push_back(number);
      continue;
    }
    fail(ErrorCode::invalid_option, file.path, "no points, lines or triangles have the tag '", tag,
         "'; there are: ", available_tags(file));
  }
  return set;
}

bool contains(const std::vector<std::int32_t>& tags, std::int32_t tag) {
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

// If the boundary turns by more than this (radians), the vertex is a corner, and stays anyway. The optimizer's own
// bound of what is straight is far lower.
constexpr double kCorner = 1e-6;

bool is_corner(const Mesh& mesh, VertexId v) {
  const HalfedgeId out = mesh.outgoing(v);
  HalfedgeId last = out;
  for (const HalfedgeId h : mesh.star(v)) last = h;
  const VertexId before = mesh.opposite(last), after = mesh.target(out);
  const auto [p, a, b] = mesh.points(v, before, after);
  const Vec3 from = mesh.space().chord(a, p), to = mesh.space().chord(p, b);
  const double turn = dot(mesh.space().up(p), cross(from, to));
  return dot(from, to) < 0 || std::abs(turn) > kCorner * length(from) * length(to);
}

/// Says of each triangle whether it is of one of these regions, or groups. Empty: none is.
std::vector<bool> triangles_of(const MeshFile& file, const std::vector<std::int32_t>& tags) {
  std::vector<bool> inside(tags.empty() ? 0 : file.triangles.size());
  const auto add = [&](const std::vector<std::int32_t>& of_triangles, const auto& is_wanted) {
    for (std::size_t t = 0; t < std::min(inside.size(), of_triangles.size()); ++t)
      inside[t] = inside[t] || is_wanted(of_triangles[t]);
  };
  const auto is_of_tags = [&](std::int32_t tag) { return contains(tags, tag); };
  add(file.triangles.tags, is_of_tags);
  for (const DataArray& array : file.triangles.data) {
    const std::optional<std::int32_t> group = further_group(array);
    const bool is_wanted_group = group && contains(tags, *group);
    if (tags.empty() || (!is_wanted_group && array.name != kFirstGroup)) continue;
    const auto values = to_int32(array.values);
    if (!values || array.components != 1) continue;
    is_wanted_group ? add(*values, [](std::int32_t value) { return value != 0; }) : add(*values, is_of_tags);
  }
  return inside;
}

/// The vertices that lines pass through, with the tags of the lines, sorted.
using TaggedVertex = std::pair<VertexId, std::int32_t>;
std::vector<TaggedVertex> marks_of_lines(const MeshFile& file, const VertexOfPoint& vertex) {
  std::vector<TaggedVertex> marks;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    for (const std::int32_t p : file.lines[i]) {
      const std::int32_t v = vertex[static_cast<std::size_t>(p)];
      if (v >= 0) marks.emplace_back(static_cast<std::size_t>(v), file.lines.tags[i]);
    }
  }
  std::sort(marks.begin(), marks.end());
  return marks;
}

/// The tags of pairs across levees.
std::vector<std::int32_t> tags_of_pairs(const MeshFile& file) {
  std::vector<std::int32_t> paired;
  const DataArray* const side = find(file.marked_points.data, kPairSide);
  if (side == nullptr) return paired;
  const std::vector<double> sides = to_doubles(Values(side->values));
  for (std::size_t i = 0; i < std::min(sides.size(), file.marked_points.tags.size()); ++i) {
    if (sides[i] == 1 && !contains(paired, file.marked_points.tags[i])) paired.push_back(file.marked_points.tags[i]);
  }
  return paired;
}

/// The tags that list vertices, sorted.
std::vector<std::int32_t> tags_of_lists(const MeshFile& file, const VertexOfPoint& vertex, const Mesh& mesh,
                                        const std::vector<TaggedVertex>& marks, bool all_of_boundary) {
  const std::vector<TaggedVertex> of_lines = marks_of_lines(file, vertex);
  const std::vector<std::int32_t> paired = tags_of_pairs(file);
  std::vector<std::int32_t> lists, named;
  for (const PhysicalName& n : file.names) {
    if (n.dimension == 0) named.push_back(n.tag);
  }
  for (const TaggedVertex& mark : marks) {
    const auto [v, tag] = mark;
    if (contains(paired, tag)) continue;
    const bool of_boundary = all_of_boundary && mesh.is_boundary(v);
    const bool of_line = !contains(named, tag) && std::binary_search(of_lines.begin(), of_lines.end(), mark);
    if (of_boundary || of_line) lists.push_back(tag);
  }
  std::sort(lists.begin(), lists.end());
  return lists;
}

}  // namespace

std::vector<std::int32_t> fixed_points(const MeshFile& file, const VertexOfPoint& vertex,
                                       std::span<const std::string> wanted) {
  const TagSet tags = find_tags(file, wanted);
  std::vector<std::int32_t> fixed = required_points(file.point_data);
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) {
    if (contains(tags.points, file.marked_points.tags[i])) fixed.push_back(file.marked_points[i]);
  }
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    if (contains(tags.lines, file.lines.tags[i])) fixed.insert(fixed.end(), file.lines[i].begin(), file.lines[i].end());
  }
  const std::vector<bool> inside = triangles_of(file, tags.triangles);
  for (std::size_t t = 0; t < inside.size(); ++t) {
    if (inside[t]) fixed.insert(fixed.end(), file.triangles[t].begin(), file.triangles[t].end());
  }
  std::sort(fixed.begin(), fixed.end());
  fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
  std::erase_if(fixed, [&](std::int32_t p) { return vertex[static_cast<std::size_t>(p)] < 0; });
  for (std::int32_t& p : fixed) p = vertex[static_cast<std::size_t>(p)];
  return fixed;
}

std::vector<VertexId> ends_of_tags(const MeshFile& file, std::span<const HalfedgeId> edges, const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> ends;  // vertex, tag and edge of lines
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const HalfedgeId h = edges[i];
    if (!h.valid() || !mesh.is_unflippable(h)) continue;
    for (const VertexId v : {mesh.origin(h), mesh.target(h)})
      ends.push_back({v.index, static_cast<std::uint32_t>(file.lines.tags[i]), h.index});
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<VertexId> vertices;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const auto continues = [&](std::size_t other) {
      return other < ends.size() && ends[other][0] == ends[i][0] && ends[other][1] == ends[i][1];
    };
    if (!continues(i + 1) && !continues(i - 1)) vertices.emplace_back(ends[i][0]);
  }
  return vertices;
}

void fix_ends_of_tags(const MeshFile& file, std::span<const HalfedgeId> edges, Mesh& mesh) {
  std::vector<HalfedgeId> of_boundary(edges.begin(), edges.end());
  for (HalfedgeId& h : of_boundary) {
    if (h.valid() && !mesh.is_boundary(h)) h = {};
  }
  for (const VertexId v : ends_of_tags(file, of_boundary, mesh)) {
    if (!is_corner(mesh, v)) mesh.set_fixed(v, true);
  }
}

std::vector<VertexId> fixed_marks(const MeshFile& file, const VertexOfPoint& vertex, const Mesh& mesh) {
  IdVector<VertexId, std::uint8_t> marked(mesh.n_vertices());
  std::vector<TaggedVertex> marks;
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) {
    const std::int32_t v = vertex[static_cast<std::size_t>(file.marked_points[i])];
    if (v < 0 || file.marked_points.tags[i] == 0) continue;
    marks.emplace_back(static_cast<std::size_t>(v), file.marked_points.tags[i]);
    marked[marks.back().first] = 1;
  }
  if (marks.empty() || std::find(marked.begin(), marked.end(), 0) == marked.end()) return {};
  bool all_of_boundary = true;
  for (const HalfedgeId h : mesh.halfedges())
    all_of_boundary = all_of_boundary && (!mesh.is_boundary(h) || marked[mesh.origin(h)] != 0);
  const std::vector<std::int32_t> lists = tags_of_lists(file, vertex, mesh, marks, all_of_boundary);
  std::vector<VertexId> fixed;
  for (const auto& [v, tag] : marks) {
    if (!std::binary_search(lists.begin(), lists.end(), tag)) fixed.push_back(v);
  }
  return fixed;
}

}  // namespace temper::io

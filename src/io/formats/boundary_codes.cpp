#include "io/formats/boundary_codes.hpp"

#include <algorithm>
#include <map>

namespace temper::io {

std::vector<NodeString> node_strings(const std::vector<DirectedEdge>& edges) {
  std::map<std::int32_t, std::int32_t> next;
  std::set<std::int32_t> targets;
  for (const auto& [a, b] : edges) {
    next.emplace(a, b);
    targets.insert(b);
  }
  std::vector<NodeString> strings;
  const auto follow = [&](std::int32_t from) {
    NodeString nodes = {from};
    for (auto it = next.find(from); it != next.end(); it = next.find(nodes.back())) {
      nodes.push_back(it->second);
      next.erase(it);
    }
    if (nodes.size() > 1) strings.push_back(std::move(nodes));
  };
  for (const auto& edge : edges) {
    if (!targets.contains(edge[0])) follow(edge[0]);
  }
  for (const auto& edge : edges) follow(edge[0]);  // loops
  return strings;
}

std::set<DirectedEdge> boundary_edges(const MeshFile& f, const std::vector<std::int32_t>& fourth_corners) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * f.triangles.size());
  const auto outside = [n = f.points.size()](std::int32_t p) { return p < 0 || static_cast<std::size_t>(p) >= n; };
  for (std::size_t t = 0; t < f.triangles.size(); ++t) {
    const auto corners = corners_of_face(f.triangles[t], fourth_corners, t);
    if (std::ranges::any_of(corners, outside)) continue;
    const auto at = [&](std::size_t k) { return position_of(f, static_cast<std::size_t>(corners[k])); };
    const Vec3 normal = cross(at(2) - at(0), at(3) - at(1));
    const bool clockwise = (f.sphere() != nullptr ? dot(normal, at(0)) : normal.z) < 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t a = corners[k], b = corners[(k + 1) % 4];
      if (a != b) edges.push_back(clockwise ? DirectedEdge{b, a} : DirectedEdge{a, b});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::set<DirectedEdge> boundary;
  for (const auto& [a, b] : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), DirectedEdge{b, a})) boundary.insert({a, b});
  }
  return boundary;
}

NodeString boundary_nodes(const MeshFile& f, const std::set<DirectedEdge>& edges) {
  const auto sum = [&f](std::int32_t p) {
    const Vec2 at = f.points[static_cast<std::size_t>(p)];
    return at.x + at.y;
  };
  std::vector<NodeString> strings = node_strings({edges.begin(), edges.end()});
  for (NodeString& s : strings) {
    if (s.front() != s.back()) continue;
    s.pop_back();
    std::rotate(s.begin(), std::ranges::min_element(s, {}, sum), s.end());
  }
  std::ranges::stable_sort(strings, {}, [&](const NodeString& s) { return sum(s.front()); });
  NodeString nodes;
  std::set<std::int32_t> seen;
  const auto add = [&](std::int32_t p) {
    if (seen.insert(p).second) nodes.push_back(p);
  };
  for (const NodeString& s : strings) std::ranges::for_each(s, add);
  for (const DirectedEdge& edge : edges) std::ranges::for_each(edge, add);  // a node may be on two strings
  return nodes;
}

namespace {

std::string name_of_code(const CodeRules& rules, std::int32_t code) { return text(rules.name, code); }

}  // namespace

void take_codes(Document& document, const std::vector<std::int32_t>& codes, const CodeRules& rules) {
  MeshFile& f = document.file;
  enum class Place : std::uint8_t { inside, boundary, on_line };
  std::vector<Place> places(codes.size(), Place::inside);
  std::set<std::int32_t> tags;
  for (const DirectedEdge& edge : boundary_edges(f, document.fourth_corners)) {
    const auto [a, b] = std::pair{static_cast<std::size_t>(edge[0]), static_cast<std::size_t>(edge[1])};
    const bool is_line = codes[a] == codes[b] && codes[a] != rules.wall && codes[a] != 0;
    for (const std::size_t p : {a, b}) places[p] = std::max(places[p], is_line ? Place::on_line : Place::boundary);
    if (!is_line) continue;
    f.lines.add(edge, codes[a]);
    if (tags.insert(codes[a]).second) f.names.push_back({1, codes[a], name_of_code(rules, codes[a])});
  }
  for (std::size_t p = 0; p < codes.size(); ++p) {
    if (places[p] == Place::on_line || codes[p] == 0 || (places[p] == Place::boundary && codes[p] == rules.wall))
      continue;
    f.marked_points.add(static_cast<std::int32_t>(p), codes[p]);
  }
}

std::vector<std::int32_t> codes_to_write(const WriteJob& job, const std::set<DirectedEdge>& boundary,
                                         const CodeRules& rules) {
  const MeshFile& f = job.file;
  std::vector<std::int32_t> codes(f.points.size());
  std::size_t inside = 0;
  for (std::size_t i = 0; i < f.lines.size(); ++i) {
    const auto [a, b] = f.lines[i];
    const bool is_outside = boundary.contains({a, b}) || boundary.contains({b, a});
    inside += is_outside ? 0 : 1;
    for (const std::int32_t p : f.lines[i]) {
      std::int32_t& code = codes[static_cast<std::size_t>(p)];
      if (is_outside && f.lines.tags[i] != rules.wall) code = std::max(code, f.lines.tags[i]);
    }
  }
  if (inside > 0)
    job.warn(inside, " lines that are not on the boundary are not written: ", job.row.description,
             " has no place for them");
  for (const DirectedEdge& edge : boundary) {
    std::int32_t& code = codes[static_cast<std::size_t>(edge[0])];
    if (code == 0) code = rules.wall;
  }
  const std::vector<std::int32_t> marks = one_tag_a_point(job);
  for (std::size_t p = 0; p < marks.size(); ++p) {
    if (marks[p] != 0) codes[p] = marks[p];
  }
  std::vector<PhysicalName> lost;
  for (const PhysicalName& n : f.names) {
    if (n.dimension != 1 || n.name != name_of_code(rules, n.tag)) lost.push_back(n);
  }
  warn_of_names(job, lost);
  return codes;
}

}  // namespace temper::io

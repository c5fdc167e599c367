// The cells of named groups, as a table next to the columns of MODFLOW and TOUGH: wells, rivers and boundaries by name.
#include <map>
#include <tuple>
#include <utility>

#include "io/operators/dec_files.hpp"

namespace temper::io {
namespace {

/// The vertex whose power cell has this vertex: nearly always itself.
VertexId owner_of(const Mesh& mesh, VertexId vertex) {
  const Vec2 at = mesh.position(vertex);
  const auto power = [&](VertexId u) { return squared_length(mesh.position(u) - at) - mesh.weight(u); };
  for (VertexId owner = vertex;;) {
    VertexId less = owner;
    const auto look_at = [&](VertexId u) { less = power(u) < power(less) ? u : less; };
    for (const HalfedgeId h : mesh.star(owner)) look_at(mesh.target(h)), look_at(mesh.opposite(h));
    if (less == owner) return owner;
    owner = less;
  }
}

/// Visits the power cells along the edge from a to b: f(vertex, length).
///
/// On the edge, the power of a vertex u is t² − 2 t along(u) + offset(u). So the next cell is that of the neighbor
/// which first gets less power than the cell before. Cells of a mesh with regular edges have no other neighbors.
///
///       a --------|---------|---- b        t: from 0 to the length of the edge
///         cell a    cell u    cell b
template <class F>
void for_each_cell(const Mesh& mesh, VertexId a, VertexId b, F f) {
  const Vec2 from = mesh.position(a);
  const double whole = length(mesh.position(b) - from);
  const Vec2 direction = (1 / whole) * (mesh.position(b) - from);
  const auto along = [&](VertexId u) { return dot(mesh.position(u) - from, direction); };
  const auto offset = [&](VertexId u) { return squared_length(mesh.position(u) - from) - mesh.weight(u); };
  double t = 0;
  for (VertexId v = owner_of(mesh, a);;) {
    double next = whole;
    VertexId to;
    const auto look_at = [&](VertexId u) {
      if (!(along(u) > along(v))) return;
      const double meets = std::max(t, (offset(u) - offset(v)) / (2 * (along(u) - along(v))));
      if (meets < next) next = meets, to = u;
    };
    for (const HalfedgeId h : mesh.star(v)) look_at(mesh.target(h)), look_at(mesh.opposite(h));
    if (next > t) f(v, next - t);
    if (!to.valid()) return;
    t = next, v = to;
  }
}

/// In quotes if it has a comma or a quote (RFC 4180).
std::string csv_field(const std::string& value) {
  if (value.find_first_of(",\"") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

constexpr std::string_view kKinds[] = {"point", "line", "boundary"};

/// The lengths of groups in cells: of points 0.
class GroupLengths {
 public:
  GroupLengths(const Mesh& mesh, CellsOf of) : mesh_(mesh), of_(of) {}

  void add_point(std::int32_t tag, VertexId v) {
    if (of_ == CellsOf::vertices) return add(GroupKind::point, tag, owner_of(mesh_, v).index, 0);
    for (const HalfedgeId h : mesh_.star(v)) add(GroupKind::point, tag, Mesh::triangle(h).index, 0);
  }
  void add_line(std::int32_t tag, HalfedgeId h) {
    const GroupKind kind = mesh_.is_boundary(h) ? GroupKind::boundary : GroupKind::line;
    const VertexId a = mesh_.origin(h), b = mesh_.target(h);
    if (of_ == CellsOf::vertices)
      return for_each_cell(mesh_, a, b, [&](VertexId v, double part) { add(kind, tag, v.index, part); });
    const double whole = length(mesh_.position(b) - mesh_.position(a));
    add(kind, tag, Mesh::triangle(h).index, mesh_.is_boundary(h) ? whole : whole / 2);
    if (!mesh_.is_boundary(h)) add(kind, tag, Mesh::triangle(mesh_.twin(h)).index, whole / 2);
  }
  /// In the order of kind, tag and cell, for each of the names of the tag.
  [[nodiscard]] std::vector<GroupCell> named(const std::vector<PhysicalName>& all) const {
    std::multimap<std::pair<int, std::int32_t>, std::string_view> names;  // of a dimension and tag
    for (const PhysicalName& n : all) names.emplace(std::pair(n.dimension, n.tag), n.name);
    std::vector<GroupCell> cells;
    for (const auto& [key, part] : lengths_) {
      const auto [kind, tag, cell] = key;
      const auto [first, last] = names.equal_range({kind == GroupKind::point ? 0 : 1, tag});
      if (first == last) cells.push_back({text(tag), kind, cell, part});
      for (auto name = first; name != last; ++name) cells.push_back({std::string(name->second), kind, cell, part});
    }
    return cells;
  }

 private:
  void add(GroupKind kind, std::int32_t tag, std::uint32_t cell, double part) { lengths_[{kind, tag, cell}] += part; }

  const Mesh& mesh_;
  CellsOf of_;
  std::map<std::tuple<GroupKind, std::int32_t, std::uint32_t>, double> lengths_;
};

}  // namespace

std::vector<GroupCell> cells_of_groups(const MeshFile& file, const LoadedMesh& loaded, const Mesh& mesh, CellsOf of) {
  GroupLengths lengths(mesh, of);
  const auto vertex = [&](std::int32_t p) {
    const std::int32_t v = loaded.vertex_of_point[static_cast<std::size_t>(p)];
    return v < 0 ? VertexId() : VertexId(static_cast<std::size_t>(v));
  };
  for (std::size_t i = 0; i < file.marked_points.size(); ++i) {
    const VertexId v = vertex(file.marked_points[i]);
    if (v.valid() && file.marked_points.tags[i] != 0) lengths.add_point(file.marked_points.tags[i], v);
  }
  std::size_t in_mesh = 0;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const VertexId a = vertex(file.lines[i][0]), b = vertex(file.lines[i][1]);
    if (!a.valid() || !b.valid()) continue;
    const bool lists_edges = !loaded.edge_lines.empty() && loaded.edge_lines[in_mesh];
    ++in_mesh;
    HalfedgeId h = mesh.find_halfedge(a, b);
    if (!h.valid()) h = mesh.find_halfedge(b, a);
    if (!lists_edges && h.valid()) lengths.add_line(file.lines.tags[i], h);
  }
  return lengths.named(file.names);
}

void write_groups(const DecJob& job, std::string_view file, const std::function<std::string(std::size_t)>& number) {
  if (!job.options.groups) return;
  const Columns& c = *job.options.columns;
  Output& out = job.open(file);
  out.put("name,kind,layer,cell,length,x,y\n");
  for (const GroupCell& group : *job.options.groups) {
    const Vec2 at = c.plan.centers[group.cell];
    for (std::size_t layer = 0; layer < c.n_layers; ++layer) {
      const std::size_t cell = c.cell(group.cell, layer);
      if (!c.is_active(cell)) continue;
      out.put(csv_field(group.name), ',', kKinds[static_cast<std::size_t>(group.kind)], ',', layer + 1, ',',
              number(cell), ',');
      if (group.kind != GroupKind::point) out.put(group.length);
      out.put(',', at.x, ',', at.y, '\n');
    }
  }
}

}  // namespace temper::io

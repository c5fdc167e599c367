// A mesh in the planes of its metrics: cut along interfaces, and joined again.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "mesh/mesh_editor.hpp"
#include "mesh/pieces.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/detail/tensor.hpp"

namespace temper {
namespace {

/// The first triangle that is no longer counter-clockwise.
Expected<void> expect_upright(const Mesh& mesh, const InputNames& names) {
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    const auto [i, j, k] = mesh.corners(t);
    if (orient2d(mesh.position(i), mesh.position(j), mesh.position(k)) == Sign::positive) continue;
    return InputError{ErrorCode::zero_area, names.triangle_where(t.index),
                      names.triangle(t.index) +
                          " is so flat that it turns over when its corners are rounded, in the metric of the tensor or "
                          "back"};
  }
  return {};
}

/// Makes edges between two tensors of one plane constrained.
void constrain_regions(Mesh& mesh) {
  for (const HalfedgeId h : mesh.halfedges()) {
    if (mesh.is_boundary(h) || mesh.is_constrained(h)) continue;
    if (mesh.region(Mesh::triangle(h)) != mesh.region(Mesh::triangle(mesh.twin(h)))) mesh.set_constrained(h, true);
  }
}

/// Cuts a mesh along edges between planes.
class Cutter {
 public:
  explicit Cutter(MetricMesh& pieces) : whole_(pieces.mesh), pieces_(pieces), editor_(pieces.mesh) {}

  void cut() {
    for (const VertexId v : whole_.vertices()) {
      if (!whole_.is_isolated(v)) cut_at(v);
    }
    if (!pieces_.is_cut()) return;
    for (const HalfedgeId h : whole_.halfedges()) {
      if (is_seam(h)) editor_.link(h, HalfedgeId());
    }
    editor_.repair_outgoing();
  }

 private:
  [[nodiscard]] bool is_seam(HalfedgeId h) const {
    return !whole_.is_boundary(h) && !metric(Mesh::triangle(h)).shares_plane(metric(Mesh::triangle(whole_.twin(h))));
  }
  [[nodiscard]] const Metric& metric(TriangleId t) const { return pieces_.metrics.of(t); }

  /// Gives each run of triangles between two seams at v a copy of its own, all but the run of the first triangle.
  ///
  ///          \ run 1 /              h: a halfedge out of v that is a seam; with it the next run begins.
  ///      seam \     / seam             A boundary vertex has runs from one boundary edge to the other. At a vertex
  ///      ------v------ h               inside, the last run goes on in the first.
  ///          run 0
  void cut_at(VertexId v) {
    std::vector<HalfedgeId> star;
    for (const HalfedgeId h : whole_.star(v)) star.push_back(h);
    const auto seam = std::find_if(star.begin(), star.end(), [this](HalfedgeId h) { return is_seam(h); });
    if (seam == star.end()) return;
    if (!whole_.is_boundary(v)) std::rotate(star.begin(), seam, star.end());
    VertexId copy = v;
    for (std::size_t i = 1; i < star.size(); ++i) {
      if (is_seam(star[i])) copy = add_copy(v);
      if (copy != v) editor_.set_corner(star[i], copy);
    }
  }
  VertexId add_copy(VertexId v) {
    if (!pieces_.is_cut()) {
      for (const VertexId u : whole_.vertices()) pieces_.first_copies.push_back(u);
    }
    pieces_.first_copies.push_back(v);
    const VertexId copy = editor_.add_vertex(whole_.point(v));
    pieces_.mesh.set_fixed(copy, whole_.is_fixed(v));
    if (whole_.is_frozen(v)) pieces_.mesh.set_frozen(copy);
    return copy;
  }

  const Mesh whole_;  // a copy: connectivity is read while it changes
  MetricMesh& pieces_;
  MeshEditor editor_;
};

/// The ends of a halfedge before the cut.
std::pair<VertexId, VertexId> ends_of(const MetricMesh& pieces, HalfedgeId h) {
  return {pieces.first_copy(pieces.mesh.origin(h)), pieces.first_copy(pieces.mesh.target(h))};
}

/// The first triangle at each vertex. Its metric maps the vertex.
IdVector<VertexId, TriangleId> triangles_at(const Mesh& mesh) {
  IdVector<VertexId, TriangleId> triangles(mesh.n_vertices());
  for (const TriangleId t : mesh.triangles()) {
    if (mesh.is_erased(t)) continue;
    for (const VertexId v : mesh.corners(t)) {
      if (!triangles[v].valid()) triangles[v] = t;
    }
  }
  return triangles;
}

}  // namespace

std::vector<SeamEdge> seams_of(const MetricMesh& pieces) {
  std::vector<SeamEdge> seams;
  if (!pieces.is_cut()) return seams;
  std::map<std::pair<VertexId, VertexId>, HalfedgeId> open;
  for (const HalfedgeId h : pieces.mesh.halfedges()) {
    if (pieces.mesh.is_erased(Mesh::triangle(h)) || !pieces.mesh.is_boundary(h)) continue;
    const auto [from, to] = ends_of(pieces, h);
    const auto other = open.find({to, from});
    if (other == open.end()) {
      open.insert({{from, to}, h});
    } else {
      seams.push_back({other->second, h});
      open.erase(other);
    }
  }
  std::sort(seams.begin(), seams.end(), [](const SeamEdge& a, const SeamEdge& b) { return a.one < b.one; });
  return seams;
}

Expected<MetricMesh> mapped(const Mesh& mesh, const Metrics& metrics, std::span<const double> corner_weights,
                            const InputNames& names) {
  if (auto error = expect_plane(mesh, "a diffusion tensor")) return *std::move(error);
  const auto sizes = expect_sizes(metrics, corner_weights, mesh.n_triangles(), mesh.n_halfedges(), "triangles");
  if (!sizes) return sizes.error();
  MetricMesh pieces = {mesh, metrics, {}, {}};
  if (!metrics.is_constant()) {
    Cutter(pieces).cut();
    number_regions(pieces, pieces.mesh.triangles());
    constrain_regions(pieces.mesh);
  }
  const IdVector<VertexId, TriangleId> triangles = triangles_at(pieces.mesh);
  for (const VertexId v : pieces.mesh.vertices()) {
    const Metric& metric = triangles[v].valid() ? metrics.of(triangles[v]) : metrics[0];
    pieces.mesh.set_position(v, metric.to_metric(pieces.mesh.position(v)));
  }
  if (pieces.is_cut() && !corner_weights.empty()) {
    for (const HalfedgeId h : pieces.mesh.halfedges())
      pieces.mesh.set_weight(pieces.mesh.origin(h), corner_weights[h.index]);
  }
  if (const auto upright = expect_upright(pieces.mesh, names); !upright) return upright.error();
  return pieces;
}

MetricMesh with_mesh(const MetricMesh& pieces, Mesh changed, const IdVector<VertexId, VertexId>& vertices) {
  return with_other_mesh(pieces, std::move(changed), vertices);
}

namespace {

/// Maps the vertices of changed pieces back, and gives triangles their regions.
void move_back(MetricMesh& now, const Mesh& original, const MetricMesh& pieces,
               const IdVector<VertexId, VertexId>& vertices) {
  Mesh& mesh = now.mesh;
  const IdVector<VertexId, TriangleId> triangles = triangles_at(mesh);
  for (const VertexId v : mesh.vertices()) {
    const VertexId old = vertices.empty() ? v : vertices[v];
    const bool known = old.valid() && old.index < pieces.mesh.n_vertices();
    const bool stayed = known && pieces.mesh.position(old) == mesh.position(v);
    const Metric& metric = triangles[v].valid() ? now.metric(triangles[v]) : now.metrics[0];
    mesh.set_position(v, stayed ? original.position(pieces.first_copy(old)) : metric.from_metric(mesh.position(v)));
    if (pieces.is_cut()) mesh.set_frozen(v, known && original.is_frozen(pieces.first_copy(old)));
  }
  if (pieces.regions.empty()) return;
  for (const TriangleId t : mesh.triangles())
    mesh.set_region(t, pieces.regions[static_cast<std::size_t>(mesh.region(t))].region);
}

/// Makes one vertex of all copies, and joins the edges of interfaces.
IdVector<VertexId, VertexId> join(MetricMesh& now) {
  const std::vector<SeamEdge> seams = seams_of(now);
  MeshEditor editor(now.mesh);
  for (const HalfedgeId h : now.mesh.halfedges()) editor.set_corner(h, now.first_copy(now.mesh.origin(h)));
  for (const auto& [one, other] : seams) editor.link(one, other);
  editor.repair_outgoing();
  return now.mesh.compact().vertices;
}

}  // namespace

Expected<WholeMesh> mapped_back(const MetricMesh& changed, const Mesh& original, const MetricMesh& pieces,
                                const IdVector<VertexId, VertexId>& vertices) {
  if (auto error = expect_plane(changed.mesh, "a diffusion tensor")) return *std::move(error);
  MetricMesh now = changed;
  WholeMesh whole;
  whole.vertices = vertices;
  if (now.is_cut()) {
    for (const HalfedgeId h : now.mesh.halfedges()) whole.corner_weights.push_back(now.mesh.weight(now.mesh.origin(h)));
  }
  for (const TriangleId t : now.mesh.triangles()) {
    if (!now.regions.empty()) whole.tensors.push_back(now.metric(t).tensor());
  }
  move_back(now, original, pieces, vertices);
  if (now.is_cut()) whole.vertices = numbers_before_cut(join(now), pieces, vertices);
  whole.mesh = std::move(now.mesh);
  if (const auto upright = expect_upright(whole.mesh, InputNames()); !upright) return upright.error();
  return whole;
}

}  // namespace temper

// The commit of a vertex removal. The drawing is in remove_vertex.cpp.
//
// Everything is addressed by the star's own order from the first spoke on, never by the numbers of slots: the same
// plan on the same mesh with its triangles in other slots gives the same mesh in those slots.

#include "topology/flip_inline.hpp"

namespace temper {
namespace {

/// One triangle of the star: its slot, and what lies beyond its link edge.
struct Rim {
  TriangleId slot;
  inlined::OuterSide outside;
  std::int32_t region;
};

/// The star as it was, and the line that gives its two edges' place to one.
struct Star {
  std::vector<Rim> rim;
  std::size_t line_end = 0;  ///< index in the link where the line from link[0] ends; 0: no line
  bool line_constrained = false;
};

Star gather(const Mesh& mesh, const RemovalPlan& plan) {
  Star star;
  const bool on_boundary = mesh.is_boundary(plan.first);
  HalfedgeId h = plan.first;
  for (std::size_t i = 0; h.valid() && (i == 0 || h != plan.first); ++i, h = mesh.rotate(h)) {
    star.rim.push_back({Mesh::triangle(h), inlined::outer_side(mesh, Mesh::next(h)), mesh.region(Mesh::triangle(h))});
    if (i > 0 && !on_boundary && mesh.is_constrained(h)) star.line_end = i;
  }
  if (on_boundary) star.line_end = plan.link.size() - 1;
  star.line_constrained = star.line_end > 0 && mesh.is_constrained(plan.first);
  return star;
}

/// The halfedge a → b among the first n slots of the rim, or invalid.
HalfedgeId find_new(const Mesh& mesh, const std::vector<Rim>& rim, std::size_t n, VertexId a, VertexId b) {
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(rim[i].slot, k);
      if (mesh.origin(h) == a && mesh.target(h) == b) return h;
    }
  }
  return {};
}

/// The region of new triangle i: of its side, on an interface, which has line_end − 1 of them on its first side.
std::int32_t new_region(const Star& star, std::size_t i) {
  const bool is_interface = 0 < star.line_end && star.line_end < star.rim.size();
  return star.rim[is_interface && i + 1 >= star.line_end ? star.line_end : 0].region;
}

/// The triangles of the plan, in the first slots of the star, linked to one another and to nothing else.
void write_triangles(Mesh& mesh, const RemovalPlan& plan, const Star& star) {
  const std::size_t n = plan.triangles.size();
  MeshEditor edit(mesh);
  for (std::size_t i = 0; i < n; ++i) {
    mesh.set_region(star.rim[i].slot, new_region(star, i));
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(star.rim[i].slot, k);
      edit.set_corner(h, plan.triangles[i][static_cast<std::size_t>(k)]);
      edit.link(h, HalfedgeId());
      mesh.set_constrained(h, false);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      const HalfedgeId h = Mesh::halfedge(star.rim[i].slot, k);
      edit.link(h, find_new(mesh, star.rim, n, mesh.target(h), mesh.origin(h)));
    }
  }
}

}  // namespace

void remove_vertex(Mesh& mesh, const RemovalPlan& plan) {
  TEMPER_ASSERT(plan.status == RemovalStatus::possible && mesh.origin(plan.first) == plan.vertex);
  const Star star = gather(mesh, plan);
  const std::size_t n = plan.triangles.size(), k = plan.link.size();
  TEMPER_ASSERT(star.rim.size() > n);
  MeshEditor edit(mesh);
  for (const Rim& r : star.rim) edit.erase(r.slot);
  write_triangles(mesh, plan, star);
  for (std::size_t i = 0; i < star.rim.size(); ++i) {
    const HalfedgeId h = find_new(mesh, star.rim, n, plan.link[i], plan.link[(i + 1) % k]);
    TEMPER_ASSERT(h.valid());
    inlined::attach(mesh, h, star.rim[i].outside);
  }
  if (star.line_constrained) {
    const HalfedgeId line = find_new(mesh, star.rim, n, plan.link[star.line_end], plan.link[0]);
    mesh.set_constrained(line, true);
  }
  for (std::size_t i = 0; i < k; ++i) {
    const HalfedgeId h = find_new(mesh, star.rim, n, plan.link[i], plan.link[(i + 1) % k]);
    edit.set_outgoing(plan.link[i], canonical_outgoing(mesh, h));
  }
  edit.set_outgoing(plan.vertex, HalfedgeId());
}

}  // namespace temper

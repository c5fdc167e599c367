#include <utility>

#include "errors/poisson.hpp"
#include "geometry/surface.hpp"
#include "mesh/input_positions.hpp"
#include "temper/dec.hpp"
#include "temper/regularity.hpp"

namespace temper::error_detail {
namespace {

struct Arrays {
  InputPositions places;
  std::vector<double> weights = {};
  std::vector<std::array<std::int32_t, 3>> triangles = {};
  std::vector<std::array<std::int32_t, 2>> constrained = {};
  std::vector<std::int32_t> regions = {};
};

std::int32_t number(std::size_t i) { return static_cast<std::int32_t>(i); }

void add_points(const Mesh& mesh, const DecComplex& dec, Arrays& arrays) {
  const Space& space = mesh.space();
  for (const VertexId v : mesh.vertices()) {
    arrays.places.add(space.place(mesh.point(v)));
    arrays.weights.push_back(0.5 * mesh.weight(v));
  }
  for (const DecEdge& edge : dec.edges) {
    const WeightedPoint p = mesh.point(edge.from), q = mesh.point(edge.to, p);
    arrays.places.add(space.place(middle(space, as_point(space.place(p)), as_point(space.place(q)))));
    arrays.weights.push_back(0.25 * mesh.weight(edge.from) + 0.25 * mesh.weight(edge.to));
  }
}

void add_triangles(const Mesh& mesh, const DecComplex& dec, Arrays& arrays) {
  const std::size_t n = mesh.n_vertices();
  const auto middle = [&](TriangleId t, int k) { return number(n + dec.edge_of_halfedge[Mesh::halfedge(t, k)].index); };
  for (const TriangleId t : mesh.triangles()) {
    const auto corners = mesh.corners(t);
    const std::int32_t a = number(corners[0].index), b = number(corners[1].index), c = number(corners[2].index);
    const std::int32_t ab = middle(t, 0), bc = middle(t, 1), ca = middle(t, 2);
    arrays.triangles.insert(arrays.triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    arrays.regions.insert(arrays.regions.end(), 4, mesh.region(t));
  }
}

void add_constrained(const Mesh& mesh, const DecComplex& dec, Arrays& arrays) {
  for (const HalfedgeId h : mesh.halfedges()) {
    if (!mesh.is_edge_representative(h) || !mesh.is_constrained(h)) continue;
    const std::int32_t middle = number(mesh.n_vertices() + dec.edge_of_halfedge[h].index);
    arrays.constrained.push_back({number(mesh.origin(h).index), middle});
    arrays.constrained.push_back({middle, number(mesh.target(h).index)});
  }
}

}  // namespace

Expected<Mesh> refined(const Mesh& mesh) {
  const DecComplex complex = dec_operators(mesh);
  Arrays arrays = {.places = InputPositions(mesh.space())};
  add_points(mesh, complex, arrays);
  add_triangles(mesh, complex, arrays);
  add_constrained(mesh, complex, arrays);
  MeshInput input = arrays.places.input();
  input.weights = arrays.weights;
  input.triangles = arrays.triangles;
  input.constrained_edges = arrays.constrained;
  input.regions = arrays.regions;
  auto built = Mesh::build(input);
  if (!built) {
    return InputError{built.error().code, "", "the mesh cannot be refined any more: " + built.error().what()};
  }
  if (count_non_regular_edges(mesh, false) == 0) restore_regularity(built->mesh, HiddenPolicy::keep);
  return std::move(built->mesh);
}

}  // namespace temper::error_detail

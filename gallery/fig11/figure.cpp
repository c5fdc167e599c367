// Figure 11: the sparse and the dense horseshoe, and why the hard barrier cannot start from the sparse one.
#include <array>
#include <string>

#include "experiments/dense_runs.hpp"
#include "experiments/domain.hpp"
#include "experiments/hard_barrier.hpp"
#include "experiments/inputs.hpp"
#include "experiments/sparse_runs.hpp"
#include "experiments/text.hpp"
#include "figures.hpp"
#include "plot/plot.hpp"
#include "temper/draw.hpp"
#include "temper/generate.hpp"
#include "temper/detail/geometry.hpp"
#include "temper/quality.hpp"

namespace temper::gallery::fig11 {
namespace {

Claim one_free_vertex(const Mesh& mesh) {
  const std::size_t free = count_interior(mesh);
  return {"11",
          "In the sparse horseshoe one vertex alone is free to move",
          "only p_4 is free; 5 vertices",
          digits(mesh.n_vertices()) + " vertices, " + digits(free) + " of them interior",
          mesh.n_vertices() == 5 && free == 1,
          "counted on the mesh"};
}

/// Each interior vertex goes to the mean of its neighbours.
Claim laplacian_inverts(const Mesh& input) {
  Mesh mesh = input;
  const VertexId v(std::size_t{4});
  Vec2 sum;
  double neighbours = 0;
  for (const HalfedgeId h : mesh.star(v)) {
    sum = sum + mesh.position(mesh.target(h));
    neighbours += 1;
  }
  const Vec2 mean = (1 / neighbours) * sum;
  mesh.set_point(v, {mean.x, mean.y, 0});
  const std::size_t inverted = quality(mesh).inverted_triangles;
  return {"11",
          "Laplacian smoothing inverts triangles of the sparse horseshoe",
          "often inverts triangles",
          "p_4 goes to (" + digits(mean.x, 3) + ", " + digits(mean.y, 3) + "), and " + digits(inverted) +
              " triangles turn over",
          inverted > 0,
          "one step: p_4 to the mean of its neighbours, orientation by the exact test"};
}

std::string proof_text(const Certificate& c) { return c.terms + " = " + digits(static_cast<double>(c.constant)); }

Claim no_hard_barrier_weights() {
  const Certificate proof = shortest_certificate();
  const MarginSearch search = search_margin(true, 20000);
  return {"6.4",
          "No weights make all d and all h of the sparse horseshoe positive at its input positions: the hard barrier "
          "cannot be used",
          "no such weights",
          "proved: with 2ℓd and 2Sℓh in exact integers, " + proof_text(proof) +
              " for all weights, so the four cannot all be positive",
          proof.proves() && search.margin < 0,
          "a Farkas certificate, checked in integers; besides, the best margin of d/ℓ and h/ℓ that " +
              digits(search.tries) + " random trials climb to is " + digits(search.margin, 6)};
}

Claim papers_argument() {
  const Certificate proof = papers_certificate();
  return {"6.4",
          "The paper's argument: h_40 > 0 in 014 and d_10 > 0 leave h_03 < 0 in 430, as all d are positive",
          "easy to observe",
          proof_text(proof) + " for all weights",
          proof.proves(),
          "exact integers; of the other d only d_43 is needed"};
}

Claim heights_alone() {
  const MarginSearch search = search_margin(false, 5000);
  std::string weights;
  for (const double w : search.weights) weights += (weights.empty() ? "" : ", ") + digits(w, 3);
  return {"6.4",
          "It is the conditions on d that stand in the way: h alone can be made positive",
          "left open (its open problem: weights with all h positive)",
          "weights (" + weights + ") give every h ≥ " + digits(search.margin, 3) + " ℓ",
          search.margin > 0,
          digits(search.tries) + " random trials, each better one kept",
          Author::temper};
}

Claim dense_input(const Mesh& mesh) {
  const Quality q = quality(mesh);
  const std::size_t star = 1;
  return {"11",
          "The dense horseshoe has 7 × 9 vertices and obtuse triangles whose circumcenters lie across their edges",
          "7 values of a, 9 of b",
          digits(mesh.n_vertices()) + " vertices, " + digits(count_interior(mesh)) + " interior; circumcenters of " +
              digits(q.orthocenters_outside) + " of " + digits(q.triangles) + " triangles lie outside them, " +
              digits(q.negative_boundary_duals) + " of them across the boundary; E_F^1 = " +
              digits(q.energy[0][star], 6) + ", E_∂T^1 = " + digits(q.energy[2][star], 6),
          mesh.n_vertices() == 63 && q.orthocenters_outside > 0 && q.non_regular_edges == 0,
          "counted by exact predicates; constrained Delaunay, no edge needs a flip"};
}

}  // namespace

Page make(Effort) {
  const Mesh sparse = sparse_horseshoe();
  const Mesh& dense = dense_horseshoe();
  const std::array<std::string, 2> panels = {
      sparse_picture(sparse, "sparse", "5 vertices, 4 triangles"),
      dense_picture(dense, "dense",
                    digits(dense.n_vertices()) + " vertices, " + digits(dense.n_triangles()) + " triangles", 0, 300)};
  Page page;
  page.pictures.push_back({"fig11", grid_svg(panels, 2),
                           "The inputs, with duals in blue: every triangle of the sparse one, and most of the dense "
                           "one, have their circumcenter outside."});
  page.claims = {one_free_vertex(sparse), laplacian_inverts(sparse), no_hard_barrier_weights(),
                 papers_argument(),       heights_alone(),           dense_input(dense)};
  return page;
}

}  // namespace temper::gallery::fig11

// Operators with a tensor for each region: what is linear in each region is harmonic, and parts add up.
#include <gtest/gtest.h>

#include <cmath>

#include "support/layers_of_rock.hpp"
#include "temper/dec.hpp"

namespace temper {
namespace {

DecComplex operators_of(const test::LayersOfRock& rock, const MetricMesh& pieces) {
  return mapped_back(dec_operators(pieces.mesh), pieces, rock.mesh);
}

/// With any weights that are constant along interfaces.
MetricMesh weighted(const test::LayersOfRock& rock) {
  MetricMesh pieces = rock.pieces();
  test::Noise noise(7);
  IdVector<VertexId, int> copies(pieces.mesh.n_vertices(), 0);
  for (const VertexId v : pieces.mesh.vertices()) ++copies[pieces.first_copy(v)];
  for (const VertexId v : pieces.mesh.vertices())
    pieces.mesh.set_weight(v, copies[pieces.first_copy(v)] > 1 ? 0 : 0.05 * noise());
  return pieces;
}

TEST(DecOfTensors, APressureThatIsLinearInEachLayerIsHarmonicAtAllVertices) {
  for (const double ratio : {1.5, 4.0, 50.0}) {
    const test::LayersOfRock rock = test::layers_of_rock(4, ratio);
    const DecComplex complex = operators_of(rock, weighted(rock));
    const Mesh& mesh = rock.mesh;
    IdVector<VertexId, double> u(mesh.n_vertices()), flow(mesh.n_vertices(), 0.0), size(mesh.n_vertices(), 0.0);
    for (const VertexId v : mesh.vertices()) u[v] = rock.pressure(Mesh::triangle(mesh.outgoing(v)), mesh.position(v));
    for (std::size_t e = 0; e < complex.edges.size(); ++e) {
      const DecEdge& edge = complex.edges[EdgeId(e)];
      const double flux = complex.star1[EdgeId(e)] * (u[edge.to] - u[edge.from]);
      flow[edge.from] += flux, flow[edge.to] -= flux;
      size[edge.from] += std::abs(flux), size[edge.to] += std::abs(flux);
    }
    for (const VertexId v : mesh.vertices()) {
      if (mesh.is_boundary(v)) continue;
      EXPECT_NEAR(flow[v], 0, 1e-12 * size[v]) << v.index;
    }
  }
}

TEST(DecOfTensors, FluxesBetweenOrthocentersAreThoseOfThePressure) {
  const test::LayersOfRock rock = test::layers_of_rock(3, 6);
  const MetricMesh pieces = weighted(rock);
  const DecComplex complex = operators_of(rock, pieces);
  for (std::size_t e = 0; e < complex.edges.size(); ++e) {
    const DecEdge& edge = complex.edges[EdgeId(e)];
    if (edge.is_boundary()) continue;
    const double left = rock.pressure(edge.left, complex.orthocenters[edge.left]);
    const double right = rock.pressure(edge.right, complex.orthocenters[edge.right]);
    // −K grad u through the edge, from left to right: n is to the right of from → to.
    const Vec2 along = rock.mesh.position(edge.to) - rock.mesh.position(edge.from), n = {along.y, -along.x};
    const Tensor& k = rock.tensors[edge.left.index];
    const Vec2 g = rock.gradients[rock.layers[edge.left.index]];
    const double flux = -(n.x * (k.xx * g.x + k.xy * g.y) + n.y * (k.xy * g.x + k.yy * g.y));
    EXPECT_NEAR(complex.transmissibility[EdgeId(e)] * (left - right), flux, 1e-11 * (1 + std::abs(flux))) << e;
  }
}

TEST(DecOfTensors, HalvesMakeTransmissibilitiesAndCellsMakeTheDomain) {
  const test::LayersOfRock rock = test::layers_of_rock(3, 6);
  const MetricMesh pieces = weighted(rock);
  const DecComplex there = dec_operators(pieces.mesh), complex = mapped_back(there, pieces, rock.mesh);
  const Mesh& mesh = rock.mesh;
  for (const HalfedgeId h : mesh.halfedges()) {
    const double half = complex.half_transmissibility[h], whole = complex.transmissibility[complex.edge_of_halfedge[h]];
    if (mesh.is_boundary(h)) {
      EXPECT_NEAR(half, whole, 1e-12 * std::abs(whole));
    } else {
      const double other = complex.half_transmissibility[mesh.twin(h)];
      EXPECT_NEAR(1 / (1 / half + 1 / other), whole, 1e-9 * std::abs(whole));
    }
  }
  double area = 0, dual = 0, of_cells = 0;
  for (const double a : complex.areas) area += a;
  for (const double a : complex.star0) dual += a;
  const PowerCells cells = mapped_back(power_cells(pieces.mesh, there), pieces);
  for (const double a : cells.areas) of_cells += a;
  EXPECT_EQ(cells.areas.size(), mesh.n_vertices());
  EXPECT_NEAR(dual, area, 1e-12 * area);
  EXPECT_NEAR(of_cells, area, 1e-12 * area);
  const DecSummary summary = summarize(pieces.mesh, complex);
  EXPECT_EQ(summary.vertices, mesh.n_vertices());
  EXPECT_EQ(summary.edges, mesh.n_edges());
}

TEST(DecOfTensors, ScalarsAreACoefficient) {
  test::LayersOfRock rock = test::layers_of_rock(3, 6);
  std::vector<double> coefficient;
  for (std::size_t t = 0; t < rock.tensors.size(); ++t) {
    coefficient.push_back(1 + 2.0 * static_cast<double>(rock.layers[t]));
    rock.tensors[t] = {coefficient.back(), 0, coefficient.back()};
  }
  const MetricMesh pieces = rock.pieces();
  EXPECT_FALSE(pieces.is_cut());
  const DecComplex tensors = operators_of(rock, pieces);
  const DecComplex scalars = *with_coefficient(rock.mesh, dec_operators(rock.mesh), coefficient);
  for (std::size_t e = 0; e < tensors.edges.size(); ++e) {
    const EdgeId id(e);
    EXPECT_NEAR(tensors.star1[id], scalars.star1[id], 1e-12 * std::abs(scalars.star1[id]) + 1e-14);
    EXPECT_NEAR(1 / tensors.transmissibility[id], 1 / scalars.transmissibility[id], 1e-12);
  }
}

}  // namespace
}  // namespace temper

// The local test of regularity, as Lawson's loop asks it: does the vertex across an inner edge conflict?
//
// Two rules for ties. PowerTest keeps an edge of a tie: nothing to gain, and no flip to undo. PerturbedPowerTest
// decides ties by the vertices' numbers, which makes the triangulation unique whatever order it was built in.
#pragma once

#include <array>
#include <cstdint>

#include "mesh/predicates.hpp"
#include "topology/flip_inline.hpp"

namespace temper {

/// Positive when the edge ab of the quad must flip.
struct PowerTest {
  [[nodiscard]] Sign operator()(const Mesh& mesh, const inlined::Quad& q) const {
    return inlined::power_test(mesh, q.a, q.b, q.c, q.d);
  }
};

/// The same, ties by rank: rank[v] is v's number where numbers must be the user's.
template <class Rank>
struct PerturbedPowerTest {
  Rank rank;

  [[nodiscard]] Sign operator()(const Mesh& mesh, const inlined::Quad& q) const {
    const Sign sign = PowerTest()(mesh, q);
    if (sign != Sign::zero) return sign;
    const auto [a, b, c] = mesh.points(q.a, q.b, q.c);
    return power_test_perturbed(mesh.space(), a, b, c, mesh.point(q.d, a),
                                {rank(q.a), rank(q.b), rank(q.c), rank(q.d)});
  }
};
template <class Rank>
PerturbedPowerTest(Rank) -> PerturbedPowerTest<Rank>;

}  // namespace temper

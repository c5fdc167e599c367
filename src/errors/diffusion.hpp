// The user's own problem on a mesh, and its reference. measure_diffusion_errors() and the model of errors use both.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "errors/poisson.hpp"
#include "temper/dec.hpp"
#include "temper/detail/location.hpp"
#include "temper/errors.hpp"

namespace temper::error_detail {

using VertexPair = std::array<std::uint32_t, 2>;
[[nodiscard]] inline VertexPair sorted(std::uint32_t a, std::uint32_t b) {
  return a < b ? VertexPair{a, b} : VertexPair{b, a};
}

/// A boundary edge with its value.
struct Side {
  VertexPair ends;
  std::optional<double> value, flux;
};

/// The problem on a triangulation. Refinements keep the vertices; the children of triangle t are 4 t to 4 t + 3.
struct Discrete {
  std::vector<Vec2> places;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<double> coefficient, source;
  std::vector<Side> sides;
};
[[nodiscard]] Discrete discrete_of(const Mesh& mesh, const DiffusionProblem& problem);

/// Finds what is wrong with a problem, or with the number of refinements for its reference.
[[nodiscard]] std::optional<InputError> check_problem(const Mesh& mesh, const DiffusionProblem& problem,
                                                      int refinements, const InputNames& names);

// --- the reference ---------------------------------------------------------------------------------------------------

struct Sample {
  double value = 0;
  Vec2 gradient;
};

/// The gradient of the share of each corner of a triangle.
[[nodiscard]] std::array<Vec2, 3> gradients_of_shares(Vec2 a, Vec2 b, Vec2 c);
/// The shares of all three corners of the triangle that a place is in.
[[nodiscard]] std::array<double, 3> shares_of(const temper::Place& place, const Mesh& mesh);

/// Linear finite elements on a refined mesh. Four children have six points: between these the reference is quadratic.
struct Reference {
  Discrete fine;
  std::vector<double> values;
  int refinements = 0;
  std::vector<double> before;  ///< values at the vertices of the mesh with one refinement less

  /// At a place of triangle t of the mesh.
  [[nodiscard]] Sample at(std::size_t t, std::array<double, 3> shares) const;
  /// The values at the first n points, which are the vertices of the mesh.
  [[nodiscard]] std::vector<double> at_vertices(std::size_t n) const {
    return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n)};
  }
};
/// Precondition: check_problem() found nothing.
[[nodiscard]] Expected<Reference> reference_of(const Discrete& coarse, int refinements);

/// Errors relative to the reference: in L2 with these weights, and at most.
[[nodiscard]] ErrorNorms relative(const std::vector<double>& weights, const std::vector<double>& values,
                                  const std::vector<double>& reference);

// --- the two schemes -------------------------------------------------------------------------------------------------

/// The equations of a scheme: at each point its sources, and its value where that is given.
struct Equations {
  PointSystem points;
  std::vector<double> sources, values;
};

/// A problem on a mesh with its operators, which have the coefficient.
struct DiffusionSubject {
  const Mesh& mesh;
  const Discrete& discrete;
  DecComplex dec;
  std::map<VertexPair, const Side*> side_of;

  DiffusionSubject(const Mesh& m, const Discrete& d, DecComplex complex)
      : mesh(m), discrete(d), dec(std::move(complex)) {
    for (const Side& side : d.sides) side_of[side.ends] = &side;
  }
  /// The flux into the domain through a boundary edge, or the value of u there.
  [[nodiscard]] std::optional<double> flux(const DecEdge& edge) const { return of_side(edge, &Side::flux); }
  [[nodiscard]] std::optional<double> value(const DecEdge& edge) const { return of_side(edge, &Side::value); }

 private:
  [[nodiscard]] std::optional<double> of_side(const DecEdge& edge, std::optional<double> Side::*member) const {
    const auto found = edge.is_boundary() ? side_of.find(sorted(edge.from.index, edge.to.index)) : side_of.end();
    return found == side_of.end() ? std::nullopt : found->second->*member;
  }
};

[[nodiscard]] Equations at_vertices(const DiffusionSubject& s);
/// Orthocenters that coincide are nearly one unknown: `merged` counts their edges.
[[nodiscard]] Equations at_orthocenters(const DiffusionSubject& s, std::size_t& merged);

/// The model of errors of a problem: see make_discretization_error().
[[nodiscard]] Expected<std::shared_ptr<const DiscretizationError>> make_problem_error(const Mesh& mesh,
                                                                                      const DiffusionProblem& problem,
                                                                                      Scheme scheme,
                                                                                      const InputNames* names);

}  // namespace temper::error_detail

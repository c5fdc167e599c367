#include "feasibility/edge_rows.hpp"

#include <algorithm>
#include <cmath>

#include "base/box.hpp"

namespace temper {
namespace {

double squared_size(const Mesh& mesh) {
  PlaneBox box;
  for (const VertexId v : mesh.vertices()) box.add(mesh.position(v));
  return squared_length(box.high - box.low);
}

}  // namespace

EdgeRows::EdgeRows(const Mesh& mesh, const Sight& sight, Constraints constraints)
    : mesh_(mesh),
      sight_(sight),
      demand_(mesh, constraints),
      unit_(squared_size(mesh)),
      edges_(mesh.n_vertices() * mesh.n_vertices()) {
  pairs_.first = rows_.size();
  for (const VertexId p : mesh.vertices()) {
    for (const VertexId q : mesh.vertices()) {
      if (p != q && demand_.has_crossings() && sight.see_each_other(p, q)) add(split_constraint(p, q), 0);
    }
  }
  pairs_.last = rows_.size();
}

void EdgeRows::add(const WeightConstraint& constraint, double slope) {
  const LinearForm form = demand_.linear_form(constraint);
  MarginRow row;
  double norm = slope;
  for (std::size_t k = 0; k < static_cast<std::size_t>(form.size); ++k) {
    row.columns[k] = column_of(form.vertices[k]);
    row.coefficients[k] = row.columns[k] < 0 ? 0 : unit_ * form.coefficients[k];
    norm = std::max(norm, std::abs(row.coefficients[k]));
  }
  for (double& coefficient : row.coefficients) coefficient /= norm;
  row.constant = form.constant / norm;
  row.slope = slope / norm;
  rows_.push_back(row);
  constraints_.push_back(constraint);
  norms_.push_back(norm);
}

EdgeRows::Range EdgeRows::of_edge(VertexId a, VertexId b) {
  Range& range = edges_[a.index * mesh_.n_vertices() + b.index];
  if (range.last != 0) return range;
  range.first = rows_.size();
  if (demand_.has_crossings()) {
    add(split_constraint(a, b), 1);
    add(split_constraint(b, a), 1);
  }
  for (const VertexId x : mesh_.vertices()) {
    if (x == a || x == b) continue;
    if (sight_.holds_triangle(a, b, x)) add({WeightConstraint::Kind::height, a, b, x}, 1);
    if (sight_.holds_triangle(b, a, x)) add({WeightConstraint::Kind::height, b, a, x}, 1);
  }
  range.last = rows_.size();
  return range;
}

}  // namespace temper

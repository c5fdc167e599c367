// The mesh that a run works on: a copy in its own units and order, with the user's number of each vertex and triangle.
//
// Inserted vertices and their triangles get the next number that was never used, as topology gives them slots. In a
// mesh that is never compacted, as in a replay, slots and numbers are equal.
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "optimize/working/divided_edge.hpp"
#include "optimize/working/working_units.hpp"
#include "temper/mesh.hpp"
#include "temper/optimize.hpp"

namespace temper {

/// Returns the values of the elements that a compaction has kept.
template <class Id, class T>
[[nodiscard]] IdVector<Id, T> kept_of(const IdVector<Id, T>& all, const IdVector<Id, Id>& kept) {
  IdVector<Id, T> result;
  result.reserve(kept.size());
  for (const Id i : kept) result.push_back(all[i]);
  return result;
}

/// An order that copies share until one of them changes it. Copies belong to one thread.
class SharedOrder {
 public:
  SharedOrder() : SharedOrder(MeshOrder()) {}
  explicit SharedOrder(MeshOrder order) : order_(std::make_shared<MeshOrder>(std::move(order))) {}

  const MeshOrder* operator->() const { return order_.get(); }
  const MeshOrder& operator*() const { return *order_; }
  MeshOrder& own() {
    if (order_.use_count() > 1) order_ = std::make_shared<MeshOrder>(*order_);
    return *order_;
  }

 private:
  std::shared_ptr<MeshOrder> order_;
};

/// The divided edge that a vertex of the run is on, by the number of this vertex.
using DividedEdges = std::map<VertexId, DividedEdge>;

struct WorkingCopy {
  Mesh mesh;
  WorkingUnits units;
  SharedOrder order;                  ///< the user's numbers, and further ones for new elements
  bool has_gaps = false;              ///< in the numbers, after vertices have been removed
  std::size_t n_input_vertices = 0;   ///< in the user's mesh; vertices from this number on are inserted
  std::size_t n_vertices_named = 0;   ///< numbers given so far, input included; none is given twice
  std::size_t n_triangles_named = 0;  ///< numbers of triangle slots given so far
  DividedEdges divided;               ///< removed vertices may have entries

  /// An empty copy.
  WorkingCopy() = default;
  WorkingCopy(const Mesh& user, SweepOrder sweeps, Executor* executor = nullptr);
  /// Takes a mesh in the user's units that is in this order already.
  WorkingCopy(Mesh ordered, SharedOrder order);
  /// The working copy of a part of a mesh that has the right units already: numbers and coordinates stay.
  [[nodiscard]] static WorkingCopy part(const Mesh& part, DividedEdges divided = {});

  /// Returns the vertex that has number v in the user's mesh, or an invalid one if it was removed. O(n).
  [[nodiscard]] VertexId from_user(VertexId v) const;
  /// Numbers the elements that topology has appended to the mesh. Call it after each insertion or split, before
  /// recording.
  void name_new();
  /// Returns the divided edge that v is on; null for vertices of the input, and for those on no line.
  [[nodiscard]] const DividedEdge* divided_edge(VertexId v) const;
  /// Returns the edge that a split of h divides, or has divided already. Precondition: h is on the boundary or
  /// constrained, in a plane without periods.
  [[nodiscard]] DividedEdge divided_by(HalfedgeId h) const;
  [[nodiscard]] bool has_inserted() const { return n_vertices_named > n_input_vertices; }
  /// Drops erased triangles and removed vertices from mesh and order.
  Compaction compact();
  /// Returns the mesh in the user's units and order, then in the order of insertion, without gaps. The copy stays, or
  /// is used up.
  [[nodiscard]] Mesh in_user_terms(Executor* executor = nullptr) const&;
  [[nodiscard]] Mesh in_user_terms(Executor* executor = nullptr) &&;
  /// The two steps of in_user_terms(). Each one changes nothing if it is made again.
  void leave_frame();
  void take_user_order(Executor* executor);
  /// Returns the number in the input of each vertex of in_user_terms(), invalid if inserted.
  [[nodiscard]] IdVector<VertexId, VertexId> user_vertices() const;
};

/// A mesh that a run has reached, and the sweep that made it.
struct Candidate {
  WorkingCopy work;
  int sweep = 0;
  std::optional<double> error = {};  ///< of the solver, if its phase has measured it
};

}  // namespace temper

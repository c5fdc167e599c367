// A trace records an optimization event by event: enough to do it again, bit for bit, without any energy.
//
//     std::vector<TraceEvent> events;
//     const Mesh input = mesh;
//     auto report = optimize(mesh, {}, {.tracer = [&](const TraceEvent& e) { events.push_back(e); }});
//     auto again = replay(input, events);   // *again == mesh
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "temper/detail/error.hpp"
#include "temper/mesh.hpp"

namespace temper {

enum class EventKind {
  move,       ///< a vertex has a new position, and with joint steps a new weight
  weight,     ///< a vertex has a new weight
  flip,       ///< an edge gave way to the other diagonal
  collapse,   ///< a vertex was removed by the short-edge rule (Algorithm 2)
  removal,    ///< a vertex was removed by the patch test, or because its weight hid it
  insertion,  ///< a triangle was cut into three by a new vertex inside
  split,      ///< an edge, and its one or two triangles, were cut in two by a new vertex on it
  hidden,     ///< the weights hide a vertex, and it stays: nothing changes
  undo,       ///< with a vertex: a step was taken back, nothing changes; without: the mesh is again that of a sweep
};
[[nodiscard]] std::string_view name(EventKind kind);

/// Vertices are numbered as in the input, also after removals; new ones get the numbers after those of the input, in
/// the order in which they came, and the number of a removed vertex is not given again. (Where sweeps are taken back,
/// so are the numbers that were given in them.) Coordinates and weights are in the user's units.
struct TraceEvent {
  EventKind kind = EventKind::move;
  int sweep = 0;         ///< 0: making the input regular, and cutting its boundary
  VertexId vertex = {};  ///< invalid for flip, and for undo of whole sweeps; insertion, split: the new one
  /// Energy at the γ of the sweep, in repairs E_BP at theirs, before and after: of the vertex's patch, or of all edges
  /// that a flip changes. NaN where none belongs to the event.
  double before = 0, after = 0;
  WeightedPoint point = {};  ///< move, weight, insertion, split: where the vertex is now
  /// flip: halfedge a→b, with c on its left and d on its right, becomes d→c; split: a→b was cut, on the boundary with
  /// an invalid d.
  std::array<VertexId, 4> quad = {};
  /// collapse, removal: neighbors, counter-clockwise from the first spoke; insertion: corners of the triangle.
  std::vector<VertexId> link = {};
  std::vector<std::array<VertexId, 3>> triangles = {};  ///< collapse, removal: that fill the cavity, in slot order
  int to_sweep = 0;  ///< undo without a vertex: the sweep at whose end the mesh was so; −1: the input as given
  friend bool operator==(const TraceEvent&, const TraceEvent&) = default;
};

/// Called for each event, in the order in which they took place.
using Tracer = std::function<void(const TraceEvent&)>;

/// Applies the events to the input. What optimize() returned comes out: the same bits, the same slots. Errors name
/// the event, counted from 0, that does not fit the mesh. O(events + sweeps undone to × n).
[[nodiscard]] Expected<Mesh> replay(const Mesh& input, std::span<const TraceEvent> events);

/// The mesh, and the number in the input of each of its vertices, invalid for those that were inserted; empty when none
/// was removed or inserted.
struct Replay {
  Mesh mesh;
  IdVector<VertexId, VertexId> vertices;
};
/// The same, for files: with the numbers of the vertices that are left, and errors in the user's numbering.
[[nodiscard]] Expected<Replay> replay_with_vertices(const Mesh& input, std::span<const TraceEvent> events,
                                                    const InputNames* names = nullptr);

}  // namespace temper

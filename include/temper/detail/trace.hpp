// A trace records an optimization event by event. The events suffice to repeat it, bit for bit, without any energy.
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

struct ReportTable;

enum class EventKind {
  move,       ///< A vertex has a new position, and with joint steps a new weight
  weight,     ///< A vertex has a new weight
  flip,       ///< An edge gave way to the other diagonal
  collapse,   ///< The short-edge rule removed a vertex (Algorithm 2)
  removal,    ///< A vertex was removed by the patch test, or because its weight hid it
  insertion,  ///< A new vertex inside a triangle cut it into three
  split,      ///< A new vertex on an edge cut the edge and its one or two triangles in two
  hidden,     ///< The weights hide a vertex, and it stays: nothing changes
  undo,  ///< With a vertex: a step was taken back, nothing changes; without: the mesh of an earlier sweep is restored
};
[[nodiscard]] std::string_view name(EventKind kind);
[[nodiscard]] std::span<const std::string_view> words_of(EventKind);

/// Vertices are numbered as in the input, also after removals. New vertices get the next numbers, in the order in which
/// they came. The number of a removed vertex is not used again. (If sweeps are taken back, their new numbers are free
/// again.) Coordinates and weights are in the user's units.
struct TraceEvent {
  EventKind kind = EventKind::move;
  int sweep = 0;         ///< Sweep of the event; 0: the input is made regular and its boundary cut
  VertexId vertex = {};  ///< Vertex of the event; invalid for flip, and for undo of whole sweeps. For insertion and
                         ///< split, the new vertex
  /// Energy before and after, at the γ of the sweep; in repairs, E_BP at their γ. It is the energy of the vertex's
  /// patch, or of all edges that a flip changes. NaN if the event has no energy.
  double before = 0, after = 0;
  WeightedPoint point = {};  ///< New place and weight of the vertex, for move, weight, insertion, split
  /// For a flip, halfedge a→b with c on its left and d on its right becomes d→c. For a split, a→b was cut; d is invalid
  /// on the boundary.
  std::array<VertexId, 4> quad = {};
  /// For collapse and removal, the neighbors counter-clockwise from the first spoke. For insertion, the corners of the
  /// triangle.
  std::vector<VertexId> link = {};
  /// New triangles of the cavity for collapse and removal, in slot order.
  std::vector<std::array<VertexId, 3>> triangles = {};
  int to_sweep = 0;  ///< Sweep at whose end the mesh was the same, for undo without a vertex; −1: the input as given
  friend bool operator==(const TraceEvent&, const TraceEvent&) = default;
};
[[nodiscard]] const ReportTable& table_of(const TraceEvent*);

/// Function that receives each event, in the order of the events.
using Tracer = std::function<void(const TraceEvent&)>;

/// Applies the events to the input. The result is the mesh that optimize() returned, with the same bits and slots. An
/// error names the first event, counted from 0, that does not fit the mesh. O(events + sweeps undone to × n).
[[nodiscard]] Expected<Mesh> replay(const Mesh& input, std::span<const TraceEvent> events);

/// The mesh, and the number of each vertex in the input, invalid for inserted vertices. `vertices` is empty if none was
/// removed or inserted.
struct Replay {
  Mesh mesh;
  IdVector<VertexId, VertexId> vertices;
};
/// Replays a trace from a file: also returns the numbers of the remaining vertices, and errors use the user's
/// numbering.
[[nodiscard]] Expected<Replay> replay_with_vertices(const Mesh& input, std::span<const TraceEvent> events,
                                                    const InputNames* names = nullptr);

}  // namespace temper

// Certificates as JSON. A certificate proves that a mesh has no good weights, and others can verify it.
//
//   {"temper_certificate": 1, "constraints": "well_centered", "margin": 0,
//    "terms": [{"kind": "height", "triangle": [3, 9, 10], "edge": [3, 9], "multiplier": 0.25},
//              {"kind": "crossing", "edge": [9, 3], "multiplier": 1.5}]}
//
// Points count from 0, in the order of the file's arrays. The edge of a height lies in its triangle, counter-clockwise.
// The edge of a crossing is directed: d is from its first point. A dual has the fields of a height, and "across": the
// corner on the other side of the edge. Of tetrahedra, a height_over_face and a dual_of_face have "tetrahedron", "face"
// and "across" instead; the face turns counter-clockwise as seen from the fourth corner. Without "constraints" a file
// is of well_centered. docs/explanation/certificates.md has the expressions that the multipliers multiply.
//
// With tensors of regions, vertices of interfaces have a copy on each side. The first copy has the number of its point.
// Others have numbers after those of all points, and "copies" lists those in use: [number, point, cell], with a cell
// that has the copy at a corner. An equal_crossing is the equation of the interface edge "edge", which is "across" on
// the other side. Its multiplier may have either sign.
//
// A proof over connectivities has lemmas instead of "margin" and "terms":
//
//   {"temper_certificate": 1, "constraints": "well_centered",
//    "lemmas": [{"edges": [[3, 9]], "terms": […]},
//               {"edges": [], "side": [3, 4], "cases": [{"apex": 9, "lemma": 0}, …]}]}
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "temper/detail/connectivity.hpp"
#include "temper/feasibility.hpp"
#include "temper/io.hpp"

namespace temper::io {

/// A further copy of a vertex on an interface between tensors, and a cell that has it at a corner.
struct CopyOfPoint {
  std::size_t number, point, cell;
};

/// Returns a certificate as a text of lines. `points`: the number of each vertex in the certificate, which is that of
/// its point in the file, from 0; empty: the same. `copies`: what further numbers are.
[[nodiscard]] std::string certificate_to_json(const Certificate& certificate, std::span<const std::size_t> points = {},
                                              std::span<const CopyOfPoint> copies = {});
/// Returns a proof over connectivities, with one lemma per line.
[[nodiscard]] std::string certificate_to_json(const ConnectivityProof& proof, std::span<const std::size_t> points = {});

/// Returns the proof of a report that its weights are best: a certificate with "goal", and for accuracy with the terms
/// of the objective. On the sphere it has the weights, which a mesh rounds. Precondition: there is a proof.
[[nodiscard]] std::string optimality_to_json(const WeightReport& report, const Space& space,
                                             std::span<const std::size_t> points = {});

using AnyCertificate = std::variant<Certificate, ConnectivityProof>;

/// Reads a certificate. Points become vertices of the mesh; `vertex_of_point` counts copies as points. `where`: the
/// file, for errors. `cell`: "triangle" or "tetrahedron", for errors. Errors: no JSON, no certificate, a point out of
/// range or of no vertex. An error names the wrong term or lemma.
[[nodiscard]] Expected<AnyCertificate> certificate_from_json(std::string_view text,
                                                             const VertexOfPoint& vertex_of_point,
                                                             const std::string& where = {},
                                                             std::string_view cell = "triangle");

/// temper writes no JSON deeper than this. JSON from anywhere may be deeper, and is checked before it is parsed.
/// Printing or dropping a value recurses into it, and a file must not decide how much of the stack that takes.
inline constexpr int kDeepestJson = 16;
[[nodiscard]] bool is_too_deep(std::string_view json);

}  // namespace temper::io

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
// is of well_centered. docs/explanation/weights.md has the expressions that the multipliers multiply.
//
// A proof over connectivities has lemmas instead of "margin" and "terms":
//
//   {"temper_certificate": 1, "constraints": "well_centered",
//    "lemmas": [{"edges": [[3, 9]], "terms": […]},
//               {"edges": [], "side": [3, 4], "cases": [{"apex": 9, "lemma": 0}, …]}]}
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "temper/detail/connectivity.hpp"
#include "temper/feasibility.hpp"
#include "temper/io.hpp"

namespace temper::app {

/// `points`: mesh vertex → point of the file, both from 0; empty: the same.
[[nodiscard]] nlohmann::ordered_json certificate_json(const Certificate& certificate,
                                                      const std::vector<std::size_t>& points);

/// A certificate as a file of its own.
[[nodiscard]] std::string certificate_text(const Certificate& certificate, const std::vector<std::size_t>& points);

/// The proof of a report that its weights are best, as a file: a certificate with "goal", and for accuracy with the
/// terms of the objective. On the sphere it has the weights, which a mesh rounds. Precondition: there is a proof.
[[nodiscard]] std::string optimality_text(const WeightReport& report, const Space& space,
                                          const std::vector<std::size_t>& points);

/// A proof over connectivities as a file of its own.
[[nodiscard]] std::string proof_text(const ConnectivityProof& proof, const std::vector<std::size_t>& points);

using AnyCertificate = std::variant<Certificate, ConnectivityProof>;

/// Failure when the file cannot be read or is no certificate. `cell`: "triangle" or "tetrahedron", for errors.
[[nodiscard]] AnyCertificate read_certificate(const std::string& path, const io::VertexOfPoint& vertex_of_point,
                                              std::string_view cell);

}  // namespace temper::app

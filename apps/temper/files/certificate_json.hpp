// Certificates as JSON. A certificate proves that a mesh has no good weights, and others can verify it.
//
//   {"temper_certificate": 1, "constraints": "well_centered", "margin": 0,
//    "terms": [{"kind": "height", "triangle": [3, 9, 10], "edge": [3, 9], "multiplier": 0.25},
//              {"kind": "crossing", "edge": [9, 3], "multiplier": 1.5}]}
//
// Points count from 0, in the order of the file's arrays. The edge of a height lies in its triangle, counter-clockwise.
// The edge of a crossing is directed: d is from its first point. A dual has the fields of a height, and "across": the
// corner on the other side of the edge. Without "constraints" a file is of well_centered.
// docs/explanation/weights.md has the expressions that the multipliers multiply.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "files/input.hpp"
#include "temper/feasibility.hpp"

namespace temper::app {

[[nodiscard]] nlohmann::ordered_json certificate_json(const Certificate& certificate, const Input& input);

/// A certificate as a file of its own.
[[nodiscard]] std::string certificate_text(const Certificate& certificate, const Input& input);

/// Failure when the file cannot be read or is no certificate.
[[nodiscard]] Certificate read_certificate(const std::string& path, const Input& input);

}  // namespace temper::app

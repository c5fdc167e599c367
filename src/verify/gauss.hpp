// Gauss quadrature with four points on equal pieces: exact for degree 7, and far below what it measures for smooth
// fields, because pieces are short against their wave lengths.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "temper/detail/vec2.hpp"

namespace temper::verify_detail {

struct GaussNode {
  double at = 0;      ///< in (0, 1)
  double weight = 0;  ///< sum 1
};

inline constexpr std::array<GaussNode, 4> kGauss = {{{0.5 - 0.5 * 0.8611363115940525752, 0.5 * 0.3478548451374538574},
                                                     {0.5 - 0.5 * 0.3399810435848562648, 0.5 * 0.6521451548625461426},
                                                     {0.5 + 0.5 * 0.3399810435848562648, 0.5 * 0.6521451548625461426},
                                                     {0.5 + 0.5 * 0.8611363115940525752, 0.5 * 0.3478548451374538574}}};

/// The nodes of Gauss's rule on [0, 1], divided into equal pieces.
inline std::vector<GaussNode> gauss_nodes(int pieces) {
  std::vector<GaussNode> nodes;
  for (int i = 0; i < pieces; ++i) {
    for (const GaussNode& node : kGauss) nodes.push_back({(i + node.at) / pieces, node.weight / pieces});
  }
  return nodes;
}

// Fields have wave numbers of at most 3 in the frame: over a quarter, the rule is right to 1e-10.
inline constexpr double kPiece = 0.25;
// Where triangles are so flat that orthocenters lie hundreds of domains away, time is bounded and not the error.
inline constexpr double kMostPieces = 4096;

/// Calls sample(point, weight) over the segment from a to b; the weights sum to 1, also when a = b.
template <class Sample>
void along_segment(Vec2 a, Vec2 b, const Sample& sample) {
  const double wanted = std::ceil(length(b - a) / kPiece);
  const double pieces = wanted >= 1 ? std::min(wanted, kMostPieces) : 1;  // also where the length is no number
  for (double i = 0; i < pieces; ++i) {
    for (const GaussNode& node : kGauss) sample(a + ((i + node.at) / pieces) * (b - a), node.weight / pieces);
  }
}

}  // namespace temper::verify_detail

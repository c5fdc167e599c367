// The manufactured solutions. In the plane they are functions of the frame's coordinates, of order 1 in [−1, 1]². On
// the sphere they are sums of spherical harmonics of directions, in a periodic plane sums of Fourier modes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "temper/detail/space.hpp"
#include "temper/detail/vec.hpp"
#include "temper/errors.hpp"

namespace temper::error_detail {

// Gauss quadrature with four points on equal pieces: exact for degree 7. For smooth fields its error is far below the
// measured errors, because pieces are short against their wave lengths.

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
// If triangles are so flat that orthocenters lie hundreds of domains away, this bounds the time, not the error.
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

/// A place in the frame: of the plane, with z = 0, or a direction.
struct Place : Vec3 {
  constexpr Place(double px, double py, double pz = 0) : Vec3{px, py, pz} {}
  constexpr Place(Vec2 p) : Vec3{p.x, p.y, 0} {}
  constexpr Place(Vec3 p) : Vec3(p) {}
};

/// The values of a field at a point that the measures need. Vectors are tangent to the space.
struct FieldValue {
  double u = 0;
  Vec3 gradient;
  double laplacian = 0;
  Vec3 potential;  ///< with divergence u: ∫ u over a region is the flow of it out of the region
};

/// amplitude · sin(m X + n Y + phase), with X and Y growing by 2π along the periods.
struct FourierMode {
  double amplitude;
  int m, n;
  double phase;
};

struct Field {
  ErrorField field;
  FieldValue (*in_frame)(Place p);
  SpaceKind space = SpaceKind::plane;
  std::span<const FourierMode> modes = {};  ///< of a periodic plane, instead of in_frame
  bool in_space = false;                    ///< of three coordinates, for tetrahedra
  Vec2 wave = {};                           ///< the wave numbers of the mode m = n = 1, in the frame

  [[nodiscard]] FieldValue at(Place p) const;
};
[[nodiscard]] std::span<const Field> all_fields(SpaceKind space = SpaceKind::plane);

/// Root mean squares over [−1, 1]², over the sphere, or over the domain of two periods. Errors are relative to them,
/// and they do not depend on any mesh.
struct FieldSize {
  double value = 0;
  double gradient = 0;
};
[[nodiscard]] FieldSize size_of(const Field& field);

/// The wave numbers of the first Fourier modes; along an axis without a period the wave is about as long as the frame.
[[nodiscard]] Vec2 first_waves(const Space& space, const FieldFrame& frame);

/// The fields that MeasureErrorsOptions::fields asks for, in the order of all_fields(), each once.
[[nodiscard]] Expected<std::vector<Field>> select_fields(const std::vector<std::string>& names,
                                                         SpaceKind space = SpaceKind::plane);
/// Selects among the fields of space in the same way.
[[nodiscard]] Expected<std::vector<Field>> select_fields_of_space(const std::vector<std::string>& names);

/// The waves and other fields of space, with their sizes over [−1, 1]³.
[[nodiscard]] std::span<const Field> fields_of_space();

}  // namespace temper::error_detail

// Operators with diffusion tensors: those of the pieces in the spaces of their metrics, mapped back and put together at
// interfaces.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "mesh/pieces.hpp"
#include "temper/tets/operators.hpp"
#include "tets/dec/factors.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {
namespace {

/// The edge between two vertices. Edges are sorted by their ends.
EdgeId edge_between(const IdVector<EdgeId, DecEdge>& edges, VertexId a, VertexId b) {
  const std::pair ends = std::minmax(a, b);
  const auto before = [](const DecEdge& e, const std::pair<VertexId, VertexId>& wanted) {
    return std::pair(e.from, e.to) < wanted;
  };
  return EdgeId(static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), ends, before) - edges.begin()));
}

class MetricDec {
 public:
  MetricDec(const DecComplex& of_pieces, const MetricMesh& pieces, const TetMesh& mesh)
      : there_(of_pieces), pieces_(pieces), mesh_(mesh), c_(dec_operators(mesh)) {
    factors_.reserve(mesh.n_tetrahedra());
    for (const TetId t : mesh.tetrahedra())
      factors_.push_back(pieces.metric(t).strength() * (there_.coefficient.empty() ? 1 : there_.coefficient[t]));
    weighted_ = with_factors(pieces.mesh, there_, factors_);
  }

  DecComplex build() {
    edges();
    faces();
    for (const TetId t : mesh_.tetrahedra()) c_.orthocenters[t] = pieces_.metric(t).from_metric(there_.orthocenters[t]);
    c_.volumes = there_.volumes;
    c_.star3 = there_.star3;
    c_.coefficient = there_.coefficient;
    c_.star0 = sums_of_copies(pieces_, there_.star0, mesh_.n_vertices());
    if (!there_.capacity.empty()) c_.capacity = sums_of_copies(pieces_, there_.capacity, mesh_.n_vertices());
    return std::move(c_);
  }

 private:
  /// Adds up the copies of each edge. The first tetrahedron at it has the first one.
  void edges() {
    IdVector<EdgeId, std::uint8_t> written(c_.edges.size(), 0), added(there_.edges.size(), 0);
    for (const TetId t : mesh_.tetrahedra()) {
      for (const auto& [i, j, k, l] : kEdgeCorners) {
        const auto first = static_cast<std::size_t>(i), second = static_cast<std::size_t>(j);
        const VertexId a = pieces_.mesh.corners(t)[first];
        const EdgeId e = edge_between(c_.edges, mesh_.corners(t)[first], mesh_.corners(t)[second]);
        const EdgeId copy = edge_between(there_.edges, a, pieces_.mesh.corners(t)[second]);
        if (std::exchange(added[copy], std::uint8_t{1}) != 0) continue;
        const DecEdge& from = there_.edges[copy];
        DecEdge& to = c_.edges[e];
        if (std::exchange(written[e], std::uint8_t{1}) == 0) {
          const bool forward = (from.from == a) == (to.from == mesh_.corners(t)[first]);
          to.length = from.length;
          to.crossing = forward ? from.crossing : from.length - from.crossing;
          to.midpoint = pieces_.metric(t).from_metric(from.midpoint);
          to.dual_area = c_.star1[e] = 0;
        }
        to.dual_area += from.dual_area * (to.length / from.length);
        c_.star1[e] += weighted_.star1[copy];
      }
    }
  }

  /// A face as the tetrahedron on one side has it.
  struct Side {
    FaceId face;  ///< of the pieces
    double area = 0, height = 0, factor = 1;
    Vec3 orthocenter;
  };

  void faces() {
    IdVector<FaceId, std::array<Side, 2>> sides(c_.faces.size());  // behind and ahead
    c_.half_transmissibility.resize(mesh_.n_halffaces());
    for (const TetId t : mesh_.tetrahedra()) {
      for (std::size_t k = 0; k < 4; ++k) {
        const FaceId f = face_of(c_, t, mesh_.vertices(TetMesh::halfface(t, int(k))));
        const Side side = side_of(t, face_of(there_, t, pieces_.mesh.vertices(TetMesh::halfface(t, int(k)))));
        sides[f].at(c_.faces[f].behind == t ? 0 : 1) = side;
        c_.half_transmissibility[TetMesh::halfface(t, int(k))] = over_height(side.factor * side.area, side.height);
      }
    }
    for (std::size_t f = 0; f < c_.faces.size(); ++f) write(FaceId(f), sides[FaceId(f)]);
  }
  [[nodiscard]] Side side_of(TetId t, FaceId copy) const {
    const DecFace& face = there_.faces[copy];
    return {copy, face.area, face.behind == t ? face.behind_height : face.ahead_height, factors_[t],
            pieces_.metric(t).from_metric(face.orthocenter)};
  }
  /// The face of a tetrahedron with these vertices, in any order.
  static FaceId face_of(const DecComplex& complex, TetId t, std::array<VertexId, 3> vertices) {
    std::sort(vertices.begin(), vertices.end());
    const auto begin = complex.d2.columns.begin() + 4 * static_cast<std::ptrdiff_t>(t.index);
    return FaceId(static_cast<std::size_t>(*std::find_if(begin, begin + 4, [&](std::int32_t f) {
      return complex.faces[FaceId(static_cast<std::size_t>(f))].vertices == vertices;
    })));
  }

  void write(FaceId f, const std::array<Side, 2>& sides) {
    const auto& [behind, ahead] = sides;
    const Side& first = behind.face.valid() ? behind : ahead;
    DecFace& face = c_.faces[f];
    face.area = first.area;
    face.orthocenter = first.orthocenter;
    face.behind_height = behind.height;
    face.ahead_height = ahead.face.valid() ? ahead.height * (first.area / ahead.area) : 0;
    const bool is_one = face.is_boundary() || behind.face == ahead.face;
    face.dual_length = is_one ? there_.faces[first.face].dual_length : face.behind_height + face.ahead_height;
    c_.star2[f] = is_one ? there_.star2[first.face] : face.dual_length / face.area;
    if (is_one) {
      c_.transmissibility[f] = weighted_.transmissibility[first.face];
    } else {
      const double resistance =
          behind.height / (behind.factor * behind.area) + ahead.height / (ahead.factor * ahead.area);
      c_.transmissibility[f] = over_height(1, resistance);
    }
  }

  const DecComplex& there_;
  const MetricMesh& pieces_;
  const TetMesh& mesh_;
  IdVector<TetId, double> factors_;  ///< ∛(det K), and the coefficient
  WithFactors weighted_;
  DecComplex c_;
};

}  // namespace

DecComplex mapped_back(const DecComplex& complex, const MetricMesh& pieces, const TetMesh& mesh) {
  return MetricDec(complex, pieces, mesh).build();
}

}  // namespace temper::tets

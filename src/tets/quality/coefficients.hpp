// The coefficients of edges with their exact signs, for criteria and reports.
//
// The coefficient of an edge is Σ K R/(8 ℓ²) over the faces around it. K = 4 k ℓ A is a polynomial of the face, and
// R = h/A of its dual length h. R is a quotient of polynomials, too: let D be the power polynomial of the tetrahedra
// on both sides, V and V′ their volumes times 6. Then R = −D/(V V′). Of one side alone, R = H/(V 4A²), where H is the
// height polynomial. So the sign is that of a polynomial.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "temper/detail/executor.hpp"
#include "temper/tets/criterion.hpp"
#include "tets/mesh/tables.hpp"

namespace temper::tets {

/// The coefficient of an edge, or its part in a region.
struct EdgeCoefficient {
  std::array<VertexId, 2> vertices;  ///< ascending
  DualKind kind = DualKind::inside;
  std::int32_t region = 0;  ///< of a part
  Sign sign = Sign::zero;   ///< exact
  double over_l = 0;        ///< coefficient over length, with this sign
};

/// Precondition: all tetrahedra are positive.
class Coefficients {
 public:
  Coefficients(const TetMesh& mesh, Executor* executor);

  [[nodiscard]] std::size_t n_blocks() const { return (mesh_.n_vertices() + kBlock - 1) / kBlock; }
  /// use(b, coefficient) for each edge and then its parts, in the order of their vertices; b is the number of a block.
  template <class Use>
  void visit(Executor* executor, const Use& use) const {
    or_serial(executor).run(n_blocks(), [&](std::size_t b) {
      std::vector<EdgeCoefficient> found;
      for (std::size_t v = b * kBlock; v < std::min(mesh_.n_vertices(), (b + 1) * kBlock); ++v) {
        found.clear();
        append_edges(VertexId(v), found);
        for (const EdgeCoefficient& coefficient : found) use(b, coefficient);
      }
    });
  }

 private:
  static constexpr std::size_t kBlock = 1024;  // vertices: some milliseconds of work

  /// One face around an edge, or one side of it.
  struct Term {
    VertexId end;
    HalffaceId face;
    std::int32_t region = 0;
    double value = 0;  ///< K R
    friend bool operator<(const Term& a, const Term& b) { return a.end != b.end ? a.end < b.end : a.face < b.face; }
  };

  [[nodiscard]] double term(VertexId v, VertexId w, HalffaceId h) const;
  /// Appends the edges whose lesser vertex is v.
  void append_edges(VertexId v, std::vector<EdgeCoefficient>& found) const;
  void append_edge(VertexId v, std::span<const Term> terms, std::vector<EdgeCoefficient>& found) const;
  [[nodiscard]] EdgeCoefficient sum(VertexId v, std::span<const Term> terms) const;
  [[nodiscard]] Sign exact_sign(VertexId v, std::span<const Term> terms) const;

  const TetMesh& mesh_;
  VertexStars stars_;
  IdVector<HalffaceId, double> ratios_;  // R of the dual at the representative, or of each side between regions
};

}  // namespace temper::tets

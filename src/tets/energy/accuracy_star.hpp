// The energy of the accuracy objective, the squared offsets between the centroids of primal and dual elements, behind a
// barrier.
//
// A diagonal ★ takes a mean over an edge or face σ for a mean over its dual σ*. The first error, for a linear field, is
// the field's gradient times the offset between their centroids. Over the local size s at σ,
//
//     E = Σ_σ s⁻² |σ| |σ*| |offset|² = Σ_σ s⁻² |N|²/V,     V = |σ| |σ*|,   N = |σ| ∫_{σ*} (x − centroid of σ)
//
// over edges for ★1 (unknowns at vertices) and over faces for ★2 (unknowns in tetrahedra). At an edge N has the dual
// face's centroid against the crossing, and the crossing against the midpoint of the edge; at a face the orthocenter
// against the centroid, and the face against the midpoint of its dual edge. In the plane N is δ and η
// (energy/accuracy_energy.hpp). The moments of HOT that no mesh avoids are left out. V and N are sums over
// tetrahedra (offset.hpp), but E is not: the parts of a dual cancel. A sum of |N|²/V over tetrahedra bounds it, yet its
// minimum cannot be near 0. So a star holds the sums over all tetrahedra around its edges.
//
// Behind it stands the barrier − μ Σ_tetrahedra s³ Σ_faces ln(h/ℓ − f), with the floor f of the tetrahedron.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "temper/tets/mesh.hpp"
#include "tets/energy/offset.hpp"
#include "tets/energy/star_kernel.hpp"

namespace temper::tets {

/// The factors of edges and faces in E. On the boundary the dual ends, and its offset cannot vanish.
struct AccuracyModel {
  double edges = 0, boundary_edges = 0;
  double faces = 0, boundary_faces = 0;
  double barrier = 0;  ///< μ
};
struct AccuracyTotal {
  double energy = 0, barrier = 0;
};

using VertexSizes = IdVector<VertexId, double>;

/// Sizes at the vertices, and floors of the tetrahedra. The terms of E and barrier are +∞ outside the domain.
struct AccuracyDomain {
  VertexSizes sizes;
  IdVector<TetId, double> floors;
};

/// Energy and barrier as a function of one vertex. Storage is kept from vertex to vertex.
class AccuracyStar {
 public:
  /// `link`: the halffaces opposite v in the tetrahedra around v.
  void gather(const TetMesh& mesh, VertexId v, std::span<const HalffaceId> link, const AccuracyDomain& domain,
              const AccuracyModel& model);
  /// All that depends on the vertex; +∞ if some V is not positive, or some height not above its floor.
  [[nodiscard]] double value(const WeightedPoint& p) const;
  /// Value, gradient, and the Hessian without the second derivatives of V, N and h/ℓ: it is never negative.
  [[nodiscard]] PointDerivatives<double> derivatives(const WeightedPoint& p) const;
  /// Of the edges, faces and tetrahedra whose least vertex this is: the sum over all vertices is that over the mesh. E
  /// leaves out elements whose V is not positive.
  [[nodiscard]] AccuracyTotal own(const WeightedPoint& p) const;

 private:
  /// An edge from the vertex.
  struct Spoke {
    Weighted<double> end;
    VertexId vertex;
    bool on_boundary = false;
    double factor = 0;
  };
  /// A face of the vertex and two spokes, and the link edge between these.
  struct Side {
    std::size_t from = 0, to = 0;  // in the direction of the first tetrahedron
    int tetrahedra = 0;
    Offset<double> beyond = {};  // of the link edge, in tetrahedra without the vertex
    bool edge_on_boundary = false;
    double edge_factor = 0, face_factor = 0;
  };
  struct Tet {
    std::array<std::size_t, 3> spokes, sides;  // side k: from spoke k to spoke k + 1, or back
    Vector<double> normal, center, centroid;   // of the link face
    Offset<double> beyond = {};                // of the link face, in the next tetrahedron
    double factor = 0;                         // of the link face
    double over_height = 0;                    // h/ℓ over it is this times V of its part
    double barrier = 0, floor = 0;
    bool is_own = false;
  };

  [[nodiscard]] Weighted<double> at(const WeightedPoint& p) const {
    return {Vector<double>{p.x, p.y, p.z} - origin_, p.w};
  }
  std::size_t add_spoke(const TetMesh& mesh, VertexId v);
  std::size_t add_side(std::size_t from, std::size_t to);
  void add_tetrahedron(const TetMesh& mesh, HalffaceId h, const AccuracyDomain& domain, const AccuracyModel& model);
  template <class T, class Elements, class Heights>
  void visit(const Weighted<T>& p, Elements&& element, Heights&& height) const;

  VertexId center_;
  Vector<double> origin_ = {};  // places are relative to the vertex as gathered
  std::vector<Spoke> spokes_;
  std::vector<Side> sides_;
  std::vector<Tet> tets_;
};

}  // namespace temper::tets

// The table of the numbers of a report on tetrahedra: the words of src/quality/measures_table.hpp, with a dimension
// more.
#pragma once

#include <algorithm>
#include <tuple>

#include "quality/gathered.hpp"
#include "quality/measure.hpp"
#include "tets/quality/coefficients.hpp"
#include "tets/quality/measure.hpp"

namespace temper::tets::measured {

// The elements that functions of rows may take. A function of a `const TetMesh&` gets the mesh once.

struct Tetrahedron {
  const TetMesh& mesh;
  TetId id;
  const TetMeasure& m;
};
/// One of the six angles of a tetrahedron.
struct Dihedral {
  double deg;
};
/// One of the four faces of a tetrahedron, opposite corner f.
struct Side {
  const TetMesh& mesh;
  HalffaceId h;
  const TetMeasure& m;
  std::size_t f;
};
/// Each face once.
struct Face {
  const TetMesh& mesh;
  HalffaceId h;
  FacePoints points;
};
/// Edge pq of a face.
struct FaceEdge {
  WeightedPoint p, q, opposite;
};
struct Edge {
  WeightedPoint p, q;
};
struct Vertex {
  bool on_boundary;
};

/// The lesser of d/ℓ and 1 − d/ℓ.
inline double lesser_crossing(const Edge& e) {
  const double d = dual_crossing(e.p, e.q) / length(e.q.position() - e.p.position());
  return std::min(d, 1 - d);
}
inline double height_in_face(const FaceEdge& e) {
  return signed_height(e.p, e.q, e.opposite) / length(e.q.position() - e.p.position());
}

constexpr const char* kFluxes = "two-point fluxes";

inline constexpr std::tuple kMeasures = {
    TEMPER_MEASURE(sum, vertices, {"", "vertices", "", "vertices"},
                   [](const TetMesh& mesh) { return mesh.n_vertices(); }),
    TEMPER_MEASURE(sum, inner_vertices, {"", "inner vertices", "", "vertices that are not on the boundary"},
                   [](const Vertex& v) { return !v.on_boundary; }),
    TEMPER_MEASURE(sum, tetrahedra, {"", "tetrahedra", "", "tetrahedra"},
                   [](const TetMesh& mesh) { return mesh.n_tetrahedra(); }),
    TEMPER_MEASURE(sum, faces, {"", "faces", "", "faces"}, [](const TetMesh& mesh) { return mesh.n_faces(); }),
    TEMPER_MEASURE(sum, boundary_faces, {"", "boundary faces", "", "faces of one tetrahedron"},
                   [](const Face& f) { return f.mesh.is_boundary(f.h); }),
    TEMPER_MEASURE(sum, edges, {"", "edges", "", "edges"}, [](const Edge&) { return true; }),
    TEMPER_MEASURE(sum, regions, {"", "regions", "", "different regions of tetrahedra"},
                   [](const TetMesh& mesh) { return count_regions(mesh, mesh.tetrahedra()); }),
    TEMPER_MEASURE(sum, inverted_tetrahedra,
                   {"inverted", "inverted tetrahedra", "", "tetrahedra that are not positive, exact", 0},
                   [](const Tetrahedron& t) { return t.m.orientation != Sign::positive; }),
    TEMPER_MEASURE(sum, non_regular_faces,
                   {"nonregular", "faces not regular", "", "interior faces with negative dual edge, exact", 0},
                   gathered::is_negative(DualKind::inside)),
    TEMPER_MEASURE(sum, negative_boundary_duals,
                   {"", "negative boundary duals", "", "boundary faces with h < 0, exact", 0},
                   gathered::is_negative(DualKind::boundary)),
    TEMPER_MEASURE(sum, negative_coefficients,
                   {"", "negative coefficients", "",
                    "interior edges with a negative coefficient, the area of the dual over ℓ, exact", 0},
                   gathered::is_negative<EdgeCoefficient>(DualKind::inside)),
    TEMPER_MEASURE(sum, negative_boundary_coefficients,
                   {"", "  on the boundary", "", "boundary edges with a negative coefficient, exact", 0},
                   gathered::is_negative<EdgeCoefficient>(DualKind::boundary)),
    TEMPER_MEASURE(
        sum, negative_region_coefficients,
        {"", "  of one region", "",
         "edges between regions with a negative coefficient of one region alone, counted once per region, exact", 0},
        gathered::is_negative<EdgeCoefficient>(DualKind::region)),
    TEMPER_MEASURE(sum, nonpositive_distances,
                   {"", "distances not positive", "", "interior faces with dual edge ≤ 0, exact", 0},
                   gathered::is_not_positive(DualKind::inside)),
    TEMPER_MEASURE(sum, nonpositive_boundary_distances,
                   {"", "  from the boundary", "", "boundary faces with h ≤ 0, exact", 0},
                   gathered::is_not_positive(DualKind::boundary)),
    TEMPER_MEASURE(sum, nonpositive_region_distances,
                   {"", "  from interfaces", "", "sides of faces between regions with h ≤ 0, exact", 0},
                   gathered::is_not_positive(DualKind::region)),
    TEMPER_MEASURE(sum, orthocenters_outside,
                   {"outside", "orthocenters outside", "", "tetrahedra with some h ≤ 0, exact", 0},
                   [](const Tetrahedron& t) { return !t.m.orthocenter_inside(); }),
    TEMPER_MEASURE(sum, faces_not_crossed,
                   {"", "faces not crossed", "", "faces whose orthocenter is not strictly inside, exact", 0},
                   [](const Face& f) { return !is_crossed(f.points); }),
    TEMPER_MEASURE(sum, edges_not_crossed,
                   {"not_crossed", "edges not crossed", "", "edges without 0 < d < ℓ, exact", 0},
                   [](const Edge& e) { return !is_crossed(e.p, e.q); }),
    TEMPER_MEASURE(share, well_centered_fraction,
                   {"well_centered", "well-centered fraction", "", "tetrahedra with all h > 0", 1},
                   [](const Tetrahedron& t) { return t.m.orthocenter_inside(); }),
    TEMPER_MEASURE(share, completely_well_centered_fraction,
                   {"completely", "completely well-centered", "",
                    "tetrahedra with all h > 0 whose faces and edges are crossed", 1},
                   [](const Tetrahedron& t) { return t.m.orthocenter_inside() && has_all_crossed(t.mesh, t.id); }),
    TEMPER_MEASURE(
        least, min_coefficient,
        {"", "least coefficient/l", "", "least area of the dual of an edge over ℓ², also of each region alone", 0},
        [](const EdgeCoefficient& c) { return c.over_l; }),
    TEMPER_MEASURE(
        least, min_distance,
        {"", "least distance/l", "", "least dual edge over ℓ of its face, and h/ℓ on the sides of interfaces"},
        [](const gathered::Dual& dual) { return dual.over_l; }),
    TEMPER_MEASURE(
        least, min_h_over_l,
        {"min_h", "least h/l", "",
         "least h/ℓ of tetrahedra and their faces, ℓ the side of the equilateral triangle with the area of the face"},
        [](const Side& s) { return s.m.h_over_l[s.f]; }),
    TEMPER_MEASURE(least, min_face_h_over_l,
                   {"min_face_h", "least h/l in faces", "", "least h/ℓ of faces and their edges"}, height_in_face),
    TEMPER_MEASURE(least, min_d_over_l, {"min_d", "least d/l", "", "least d/ℓ or 1 − d/ℓ of edges"}, lesser_crossing),
    TEMPER_MEASURE(least, min_dihedral_deg,
                   {"min_dihedral", "least dihedral (degrees)", "", "least angle between two faces"},
                   [](const Dihedral& angle) { return angle.deg; }),
    TEMPER_MEASURE(largest, max_dihedral_deg,
                   {"max_dihedral", "largest dihedral (degrees)", "", "largest angle between two faces"},
                   [](const Dihedral& angle) { return angle.deg; }),
    TEMPER_MEASURE(sum, volume, {"", "volume", "", "volume of all tetrahedra [length³]"},
                   [](const Tetrahedron& t) { return t.m.volume; }),
    TEMPER_MEASURE(least, min_volume, {"", "least volume", "", "least volume of a tetrahedron [length³]"},
                   [](const Tetrahedron& t) { return t.m.volume; }),
    TEMPER_MEASURE(largest, max_volume, {"", "largest volume", "", "largest volume of a tetrahedron [length³]"},
                   [](const Tetrahedron& t) { return t.m.volume; }),
    TEMPER_MEASURE(largest, max_transmissibility_over_median,
                   {"transmissibility", "transmissibility, max/median", kFluxes,
                    "largest over median A/|dual| of interior faces"}),
    TEMPER_MEASURE(largest, transmissibility_ratio,
                   {"", "transmissibility, max/min", kFluxes, "largest over least A/|dual| of interior faces"})};

}  // namespace temper::tets::measured

// The table of the numbers of a report on tetrahedra: the words of src/quality/measures_table.cpp, with a dimension
// more.
#include <array>

#include "temper/tets/quality.hpp"

namespace temper::tets {
namespace {

// Every member of Quality has the name of its key.
#define TEMPER_OF(member) [](const Quality& q) { return static_cast<double>(q.member); }

constexpr Preference kEqual = Preference::equal, kLarger = Preference::larger, kLess = Preference::less;
constexpr std::optional<double> kNothing;
constexpr const char* kFluxes = "two-point fluxes";

constexpr auto kMeasures = std::to_array<QualityMeasure>({
    {"vertices", "", "vertices", "", "vertices", kEqual, true, kNothing, TEMPER_OF(vertices)},
    {"inner_vertices", "", "inner vertices", "", "vertices that are not on the boundary", kEqual, true, kNothing,
     TEMPER_OF(inner_vertices)},
    {"tetrahedra", "", "tetrahedra", "", "tetrahedra", kEqual, true, kNothing, TEMPER_OF(tetrahedra)},
    {"faces", "", "faces", "", "faces", kEqual, true, kNothing, TEMPER_OF(faces)},
    {"boundary_faces", "", "boundary faces", "", "faces of one tetrahedron", kEqual, true, kNothing,
     TEMPER_OF(boundary_faces)},
    {"edges", "", "edges", "", "edges", kEqual, true, kNothing, TEMPER_OF(edges)},
    {"regions", "", "regions", "", "different regions of tetrahedra", kEqual, true, kNothing, TEMPER_OF(regions)},
    {"inverted_tetrahedra", "inverted", "inverted tetrahedra", "", "tetrahedra that are not positive, exact", kEqual,
     true, 0, TEMPER_OF(inverted_tetrahedra)},
    {"non_regular_faces", "nonregular", "faces not regular", "", "interior faces with negative dual edge, exact",
     kEqual, true, 0, TEMPER_OF(non_regular_faces)},
    {"negative_boundary_duals", "", "negative boundary duals", "", "boundary faces with h < 0, exact", kEqual, true, 0,
     TEMPER_OF(negative_boundary_duals)},
    {"negative_coefficients", "", "negative coefficients", "",
     "interior edges with a negative coefficient, the area of the dual over ℓ, exact", kEqual, true, 0,
     TEMPER_OF(negative_coefficients)},
    {"negative_boundary_coefficients", "", "  on the boundary", "", "boundary edges with a negative coefficient, exact",
     kEqual, true, 0, TEMPER_OF(negative_boundary_coefficients)},
    {"negative_region_coefficients", "", "  of one region", "",
     "edges between regions with a negative coefficient of one region alone, counted once per region, exact", kEqual,
     true, 0, TEMPER_OF(negative_region_coefficients)},
    {"nonpositive_distances", "", "distances not positive", "", "interior faces with dual edge ≤ 0, exact", kEqual,
     true, 0, TEMPER_OF(nonpositive_distances)},
    {"nonpositive_boundary_distances", "", "  from the boundary", "", "boundary faces with h ≤ 0, exact", kEqual, true,
     0, TEMPER_OF(nonpositive_boundary_distances)},
    {"nonpositive_region_distances", "", "  from interfaces", "", "sides of faces between regions with h ≤ 0, exact",
     kEqual, true, 0, TEMPER_OF(nonpositive_region_distances)},
    {"orthocenters_outside", "outside", "orthocenters outside", "", "tetrahedra with some h ≤ 0, exact", kEqual, true,
     0, TEMPER_OF(orthocenters_outside)},
    {"faces_not_crossed", "", "faces not crossed", "", "faces whose orthocenter is not strictly inside, exact", kEqual,
     true, 0, TEMPER_OF(faces_not_crossed)},
    {"edges_not_crossed", "not_crossed", "edges not crossed", "", "edges without 0 < d < ℓ, exact", kEqual, true, 0,
     TEMPER_OF(edges_not_crossed)},
    {"well_centered_fraction", "well_centered", "well-centered fraction", "", "tetrahedra with all h > 0", kLarger,
     false, 1, TEMPER_OF(well_centered_fraction)},
    {"completely_well_centered_fraction", "completely", "completely well-centered", "",
     "tetrahedra with all h > 0 whose faces and edges are crossed", kLarger, false, 1,
     TEMPER_OF(completely_well_centered_fraction)},
    {"min_coefficient", "", "least coefficient/l", "",
     "least area of the dual of an edge over ℓ², also of each region alone", kLarger, false, 0,
     TEMPER_OF(min_coefficient)},
    {"min_distance", "", "least distance/l", "",
     "least dual edge over ℓ of its face, and h/ℓ on the sides of interfaces", kLarger, false, kNothing,
     TEMPER_OF(min_distance)},
    {"min_h_over_l", "min_h", "least h/l", "",
     "least h/ℓ of tetrahedra and their faces, ℓ the side of the equilateral triangle with the area of the face",
     kLarger, false, kNothing, TEMPER_OF(min_h_over_l)},
    {"min_face_h_over_l", "min_face_h", "least h/l in faces", "", "least h/ℓ of faces and their edges", kLarger, false,
     kNothing, TEMPER_OF(min_face_h_over_l)},
    {"min_d_over_l", "min_d", "least d/l", "", "least d/ℓ or 1 − d/ℓ of edges", kLarger, false, kNothing,
     TEMPER_OF(min_d_over_l)},
    {"min_dihedral_deg", "min_dihedral", "least dihedral (degrees)", "", "least angle between two faces", kLarger,
     false, kNothing, TEMPER_OF(min_dihedral_deg)},
    {"max_dihedral_deg", "max_dihedral", "largest dihedral (degrees)", "", "largest angle between two faces", kLess,
     false, kNothing, TEMPER_OF(max_dihedral_deg)},
    {"volume", "", "volume", "", "volume of all tetrahedra [length³]", kEqual, false, kNothing, TEMPER_OF(volume)},
    {"min_volume", "", "least volume", "", "least volume of a tetrahedron [length³]", kLarger, false, kNothing,
     TEMPER_OF(min_volume)},
    {"max_volume", "", "largest volume", "", "largest volume of a tetrahedron [length³]", kLess, false, kNothing,
     TEMPER_OF(max_volume)},
    {"max_transmissibility_over_median", "transmissibility", "transmissibility, max/median", kFluxes,
     "largest over median A/|dual| of interior faces", kLess, false, kNothing,
     TEMPER_OF(max_transmissibility_over_median)},
    {"transmissibility_ratio", "", "transmissibility, max/min", kFluxes,
     "largest over least A/|dual| of interior faces", kLess, false, kNothing, TEMPER_OF(transmissibility_ratio)},
});

#undef TEMPER_OF

}  // namespace

std::span<const QualityMeasure> quality_measures() { return kMeasures; }

}  // namespace temper::tets

// The table of the numbers of a report: their names, their words for people, their users, and the better direction.
#include <array>

#include "geometry/flow_cell.hpp"
#include "temper/quality.hpp"

namespace temper {
namespace {

// Every member of Quality has the name of its key.
#define TEMPER_OF(member) [](const Quality& q) { return static_cast<double>(q.member); }

constexpr Preference kEqual = Preference::equal, kLarger = Preference::larger, kLess = Preference::less;
constexpr std::optional<double> kNothing;
constexpr const char* kExplicit = "explicit schemes";
constexpr const char* kFluxes = "two-point fluxes";
constexpr const char* kFlow = "D-Flow FM";
constexpr const char* kMpas = "MPAS";

constexpr auto kMeasures = std::to_array<QualityMeasure>({
    {"vertices", "", "vertices", "", "vertices", kEqual, true, kNothing, TEMPER_OF(vertices)},
    {"triangles", "", "triangles", "", "triangles", kEqual, true, kNothing, TEMPER_OF(triangles)},
    {"edges", "", "edges", "", "edges", kEqual, true, kNothing, TEMPER_OF(edges)},
    {"boundary_edges", "", "boundary edges", "", "edges of one triangle", kEqual, true, kNothing,
     TEMPER_OF(boundary_edges)},
    {"regions", "", "regions", "", "different regions of triangles", kEqual, true, kNothing, TEMPER_OF(regions)},
    {"inverted_triangles", "inverted", "inverted triangles", "", "triangles that are clockwise, exact", kEqual, true, 0,
     TEMPER_OF(inverted_triangles)},
    {"non_regular_edges", "nonregular", "edges not regular", "", "interior edges with negative dual, exact", kEqual,
     true, 0, TEMPER_OF(non_regular_edges)},
    {"negative_boundary_duals", "", "negative boundary duals", "", "boundary edges with h < 0, exact", kEqual, true, 0,
     TEMPER_OF(negative_boundary_duals)},
    {"negative_region_coefficients", "", "negative parts at interfaces", "",
     "sides of interfaces between regions with h < 0, exact: the coefficient of this region alone is negative", kEqual,
     true, 0, TEMPER_OF(negative_region_coefficients)},
    {"nonpositive_distances", "", "distances not positive", "", "interior edges with dual ≤ 0, exact", kEqual, true, 0,
     TEMPER_OF(nonpositive_distances)},
    {"nonpositive_boundary_distances", "", "  from the boundary", "", "boundary edges with h ≤ 0, exact", kEqual, true,
     0, TEMPER_OF(nonpositive_boundary_distances)},
    {"nonpositive_region_distances", "", "  from interfaces", "",
     "sides of interfaces between regions with h ≤ 0, exact", kEqual, true, 0, TEMPER_OF(nonpositive_region_distances)},
    {"orthocenters_outside", "outside", "orthocenters outside", "", "triangles with some h ≤ 0, exact", kEqual, true, 0,
     TEMPER_OF(orthocenters_outside)},
    {"edges_not_crossed", "not_crossed", "edges not crossed", "", "edges without 0 < d < ℓ, exact", kEqual, true, 0,
     TEMPER_OF(edges_not_crossed)},
    {"well_centered_fraction", "well_centered", "well-centered fraction", "", "triangles with all h > 0 and 0 < d < ℓ",
     kLarger, false, 1, TEMPER_OF(well_centered_fraction)},
    {"min_coefficient", "", "least coefficient", "",
     "least coefficient, which is dual/ℓ of edges, and h/ℓ on the sides of interfaces; also the least distance over ℓ",
     kLarger, false, 0, TEMPER_OF(min_coefficient)},
    {"min_h_over_l", "min_h", "least h/l", "", "least h/ℓ of triangles and their edges", kLarger, false, kNothing,
     TEMPER_OF(min_h_over_l)},
    {"min_d_over_l", "min_d", "least d/l", "", "least d/ℓ or 1 − d/ℓ of edges", kLarger, false, kNothing,
     TEMPER_OF(min_d_over_l)},
    {"min_angle_deg", "min_angle", "least angle (degrees)", "", "least angle of triangles", kLarger, false, kNothing,
     TEMPER_OF(min_angle_deg)},
    {"max_angle_deg", "max_angle", "largest angle (degrees)", "", "largest angle of triangles", kLess, false, kNothing,
     TEMPER_OF(max_angle_deg)},
    {"max_transmissibility_over_median", "transmissibility", "transmissibility, max/median", kFluxes,
     "largest over median ℓ/|dual| of interior edges", kLess, false, kNothing,
     TEMPER_OF(max_transmissibility_over_median)},
    {"transmissibility_ratio", "", "transmissibility, max/min", kFluxes,
     "largest over least ℓ/|dual| of interior edges", kLess, false, kNothing, TEMPER_OF(transmissibility_ratio)},
    {"min_edge_over_size", "min_edge", "least edge/size", kExplicit,
     "least length of interior edges over local size, as in --min-edge", kLarger, false, 0.75,
     TEMPER_OF(min_edge_over_size)},
    {"min_dual_over_size", "min_dual", "least dual/size", kExplicit,
     "least signed length of interior duals over local size, as in --min-dual", kLarger, false, 0.3,
     TEMPER_OF(min_dual_over_size)},
    {"min_dual_over_cell_median", "min_dual_of_cell", "least dual/median of its cell", kExplicit,
     "least signed dual of a closed cell over the median length of its duals", kLarger, false, 1e-4,
     TEMPER_OF(min_dual_over_cell_median)},
    {"max_orthogonality", "orthogonality", "orthogonality", kFlow,
     "largest |cosine| between an interior edge and the line between the circumcenters on its sides, kept inside their "
     "triangles (MeshKernel, MeshOrthogonality). Advice: 0.01. D-Flow FM refuses 0.5 (cosPhiUTrsh)",
     kLess, false, kAdvisedOrthogonality, TEMPER_OF(max_orthogonality)},
    {"max_smoothness", "smoothness", "smoothness", kFlow,
     "largest ratio of the areas on the sides of an interior edge (MeshKernel, MeshSmoothness)", kLess, false, kNothing,
     TEMPER_OF(max_smoothness)},
    {"min_flow_link", "flow_link", "least flow link", kFlow,
     "least distance between neighboring circumcenters, kept inside their triangles, over the mean square root of both "
     "areas (MeshKernel, GetEdgesCrossingSmallFlowEdges)",
     kLarger, false, kSmallFlowLink, TEMPER_OF(min_flow_link)},
    {"small_flow_links", "", "small flow links", kFlow,
     "interior edges with a flow link below 0.1, which D-Flow FM removes (removeSmallLinksTrsh)", kEqual, true, 0,
     TEMPER_OF(small_flow_links)},
    {"min_cell_quality", "cellQuality", "least cellQuality", kMpas,
     "shortest over longest dvEdge of a closed cell (MPAS-Tools, mpas_mesh_converter)", kLarger, false, kNothing,
     TEMPER_OF(min_cell_quality)},
    {"min_grid_spacing", "gridSpacing", "least gridSpacing", kMpas,
     "mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]", kLarger, false, kNothing,
     TEMPER_OF(min_grid_spacing)},
    {"max_grid_spacing", "", "largest gridSpacing", kMpas,
     "mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]", kLess, false, kNothing,
     TEMPER_OF(max_grid_spacing)},
    {"min_triangle_quality", "triangleQuality", "least triangleQuality", kMpas,
     "shortest over longest dcEdge of a triangle (MPAS-Tools, mpas_mesh_converter)", kLarger, false, kNothing,
     TEMPER_OF(min_triangle_quality)},
    {"min_triangle_angle_quality", "triangleAngleQuality", "least triangleAngleQuality", kMpas,
     "least over largest angle of a triangle, by the law of cosines (MPAS-Tools, mpas_mesh_converter)", kLarger, false,
     kNothing, TEMPER_OF(min_triangle_angle_quality)},
    {"obtuse_triangles", "obtuseTriangle", "obtuse triangles", kMpas,
     "triangles with an angle above 90° (MPAS-Tools, mpas_mesh_converter), exact", kEqual, true, 0,
     TEMPER_OF(obtuse_triangles)},
    {"max_centroid_offset_over_size", "centroid_offset", "centroid offset/size", kMpas,
     "largest distance of a vertex from the centroid of its closed cell, over local size; 0 in centroidal Voronoi "
     "meshes",
     kLess, false, kNothing, TEMPER_OF(max_centroid_offset_over_size)},
});

#undef TEMPER_OF

}  // namespace

std::span<const QualityMeasure> quality_measures() { return kMeasures; }

}  // namespace temper

// The table of the numbers of a report: their names, their words for people, their users, the better direction, and the
// elements of the mesh that they are gathered from.
#pragma once

#include <tuple>

#include "geometry/flow_cell.hpp"
#include "quality/gathered.hpp"
#include "quality/measure.hpp"

namespace temper::measured {

// The elements that functions of rows may take. A function of a `const Mesh&` gets the mesh once.

struct Triangle {
  const Mesh& mesh;
  TriangleId id;
  const TriangleMeasure& m;
};
/// One of the three sides of a triangle: the edge of h, and corner k.
template <class Which>
struct SideOf {
  const Mesh& mesh;
  HalfedgeId h;
  const TriangleMeasure& m;  ///< of the triangle
  int k;
};
/// Each side of each triangle.
using Side = SideOf<struct All>;
/// Each edge once, except diagonals of quadrilaterals.
using Edge = SideOf<struct Once>;

constexpr const char* kExplicit = "explicit schemes";
constexpr const char* kFluxes = "two-point fluxes";
constexpr const char* kFlow = "D-Flow FM";
constexpr const char* kMpas = "MPAS";

inline constexpr std::tuple kMeasures = {
    TEMPER_MEASURE(sum, vertices, {"", "vertices", "", "vertices"}, [](const Mesh& mesh) { return mesh.n_vertices(); }),
    TEMPER_MEASURE(sum, triangles, {"", "triangles", "", "triangles"},
                   [](const Mesh& mesh) { return mesh.n_triangles(); }),
    TEMPER_MEASURE(sum, edges, {"", "edges", "", "edges"},
                   [](const Side& s) { return s.mesh.is_edge_representative(s.h); }),
    TEMPER_MEASURE(sum, boundary_edges, {"", "boundary edges", "", "edges of one triangle"},
                   [](const Edge& e) { return e.mesh.is_boundary(e.h); }),
    TEMPER_MEASURE(sum, regions, {"", "regions", "", "different regions of triangles"},
                   [](const Mesh& mesh) { return count_regions(mesh, mesh.triangles()); }),
    TEMPER_MEASURE(sum, inverted_triangles,
                   {"inverted", "inverted triangles", "", "triangles that are clockwise, exact", 0},
                   [](const Triangle& t) { return t.m.orientation == Sign::negative; }),
    TEMPER_MEASURE(sum, non_regular_edges,
                   {"nonregular", "edges not regular", "", "interior edges with negative dual, exact", 0},
                   gathered::is_negative(DualKind::inside)),
    TEMPER_MEASURE(sum, negative_boundary_duals,
                   {"", "negative boundary duals", "", "boundary edges with h < 0, exact", 0},
                   gathered::is_negative(DualKind::boundary)),
    TEMPER_MEASURE(
        sum, negative_region_coefficients,
        {"", "negative parts at interfaces", "",
         "sides of interfaces between regions with h < 0, exact: the coefficient of this region alone is negative", 0},
        gathered::is_negative(DualKind::region)),
    TEMPER_MEASURE(sum, nonpositive_distances,
                   {"", "distances not positive", "", "interior edges with dual ≤ 0, exact", 0},
                   gathered::is_not_positive(DualKind::inside)),
    TEMPER_MEASURE(sum, nonpositive_boundary_distances,
                   {"", "  from the boundary", "", "boundary edges with h ≤ 0, exact", 0},
                   gathered::is_not_positive(DualKind::boundary)),
    TEMPER_MEASURE(sum, nonpositive_region_distances,
                   {"", "  from interfaces", "", "sides of interfaces between regions with h ≤ 0, exact", 0},
                   gathered::is_not_positive(DualKind::region)),
    TEMPER_MEASURE(sum, orthocenters_outside,
                   {"outside", "orthocenters outside", "", "triangles with some h ≤ 0, exact", 0},
                   [](const Triangle& t) { return !t.m.orthocenter_inside(); }),
    TEMPER_MEASURE(sum, edges_not_crossed,
                   {"not_crossed", "edges not crossed", "", "edges without 0 < d < ℓ, exact", 0},
                   [](const Edge& e) { return !e.m.crossed[e.k]; }),
    TEMPER_MEASURE(share, well_centered_fraction,
                   {"well_centered", "well-centered fraction", "", "triangles with all h > 0 and 0 < d < ℓ", 1},
                   [](const Triangle& t) { return t.m.well_centered(); }),
    TEMPER_MEASURE(least, min_coefficient,
                   {"", "least coefficient", "",
                    "least coefficient, which is dual/ℓ of edges, and h/ℓ on the sides of "
                    "interfaces; also the least distance over ℓ",
                    0},
                   [](const gathered::Dual& dual) { return dual.over_l; }),
    TEMPER_MEASURE(least, min_h_over_l, {"min_h", "least h/l", "", "least h/ℓ of triangles and their edges"},
                   [](const Side& s) { return s.m.h_over_l[s.k]; }),
    TEMPER_MEASURE(least, min_d_over_l, {"min_d", "least d/l", "", "least d/ℓ or 1 − d/ℓ of edges"},
                   [](const Edge& e) { return e.m.d_over_l[e.k]; }),
    TEMPER_MEASURE(least, min_angle_deg, {"min_angle", "least angle (degrees)", "", "least angle of triangles"},
                   [](const Side& s) { return s.m.angle_deg[s.k]; }),
    TEMPER_MEASURE(largest, max_angle_deg, {"max_angle", "largest angle (degrees)", "", "largest angle of triangles"},
                   [](const Side& s) { return s.m.angle_deg[s.k]; }),
    TEMPER_MEASURE(largest, max_transmissibility_over_median,
                   {"transmissibility", "transmissibility, max/median", kFluxes,
                    "largest over median ℓ/|dual| of interior edges"}),
    TEMPER_MEASURE(largest, transmissibility_ratio,
                   {"", "transmissibility, max/min", kFluxes, "largest over least ℓ/|dual| of interior edges"}),
    TEMPER_MEASURE(least, min_edge_over_size,
                   {"min_edge", "least edge/size", kExplicit,
                    "least length of interior edges over local size, as in --min-edge", 0.75}),
    TEMPER_MEASURE(least, min_dual_over_size,
                   {"min_dual", "least dual/size", kExplicit,
                    "least signed length of interior duals over local size, as in --min-dual", 0.3}),
    TEMPER_MEASURE(least, min_dual_over_cell_median,
                   {"min_dual_of_cell", "least dual/median of its cell", kExplicit,
                    "least signed dual of a closed cell over the median length of its duals", 1e-4}),
    TEMPER_MEASURE(
        largest, max_orthogonality,
        {"orthogonality", "orthogonality", kFlow,
         "largest |cosine| between an interior edge and the line between the circumcenters on its sides, kept inside "
         "their triangles (MeshKernel, MeshOrthogonality). Advice: 0.01. D-Flow FM refuses 0.5 (cosPhiUTrsh)",
         kAdvisedOrthogonality}),
    TEMPER_MEASURE(largest, max_smoothness,
                   {"smoothness", "smoothness", kFlow,
                    "largest ratio of the areas on the sides of an interior edge (MeshKernel, MeshSmoothness)"}),
    TEMPER_MEASURE(
        least, min_flow_link,
        {"flow_link", "least flow link", kFlow,
         "least distance between neighboring circumcenters, kept inside their triangles, over the mean square root of "
         "both areas (MeshKernel, GetEdgesCrossingSmallFlowEdges)",
         kSmallFlowLink}),
    TEMPER_MEASURE(sum, small_flow_links,
                   {"", "small flow links", kFlow,
                    "interior edges with a flow link below 0.1, which D-Flow FM removes (removeSmallLinksTrsh)", 0}),
    TEMPER_MEASURE(least, min_cell_quality,
                   {"cellQuality", "least cellQuality", kMpas,
                    "shortest over longest dvEdge of a closed cell (MPAS-Tools, mpas_mesh_converter)"}),
    TEMPER_MEASURE(least, min_grid_spacing,
                   {"gridSpacing", "least gridSpacing", kMpas,
                    "mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]"}),
    TEMPER_MEASURE(
        largest, max_grid_spacing,
        {"", "largest gridSpacing", kMpas, "mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]"}),
    TEMPER_MEASURE(least, min_triangle_quality,
                   {"triangleQuality", "least triangleQuality", kMpas,
                    "shortest over longest dcEdge of a triangle (MPAS-Tools, mpas_mesh_converter)"}),
    TEMPER_MEASURE(least, min_triangle_angle_quality,
                   {"triangleAngleQuality", "least triangleAngleQuality", kMpas,
                    "least over largest angle of a triangle, by the law of cosines (MPAS-Tools, mpas_mesh_converter)"}),
    TEMPER_MEASURE(sum, obtuse_triangles,
                   {"obtuseTriangle", "obtuse triangles", kMpas,
                    "triangles with an angle above 90° (MPAS-Tools, mpas_mesh_converter), exact", 0}),
    TEMPER_MEASURE(
        largest, max_centroid_offset_over_size,
        {"centroid_offset", "centroid offset/size", kMpas,
         "largest distance of a vertex from the centroid of its closed cell, over local size; 0 in centroidal Voronoi "
         "meshes"})};

}  // namespace temper::measured

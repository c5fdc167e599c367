// Written by scripts/docs/records.py --write from the tables in the library. Do not edit.
import type { LengthParameterLike } from './types.ts';

/** Use of the mesh.
 * - `any`: Any solver on a dual mesh: large margins, smaller errors.
 * - `valid`: Valid triangles alone: as any, but only bad places change.
 * - `vertex`: Unknowns at vertices: MODFLOW, DEVSIM, exterior calculus.
 * - `cell`: Unknowns in triangles, two-point flux: PorePy, FiPy.
 * - `stars`: Diagonal Hodge stars of exterior calculus.
 * - `mpas`: MPAS: no weights, centered edges; may add and remove vertices.
 * - `dflowfm`: D-Flow FM: no weights, orthogonal; may add and remove vertices.
 * - `adcirc`: ADCIRC, SCHISM: no weights, long edges; may add and remove vertices.
 * - `fem`: Linear finite elements: no weights, good angles, the same vertices.
 * - `paper`: Algorithm 1 of the paper: golden section, deferred flips, collapses, the patch test, inversions, the first vertex as anchor and gamma 1.
 * - `odt`: Optimal Delaunay triangulation (Chen and Xu 2004): positions alone lower energy ODT. All weights must be equal.
 * - `cvt`: Centroidal Voronoi tessellation (Du, Faber and Gunzburger 1999): positions alone lower energy F of star 0. */
export type TargetName = "any" | "valid" | "vertex" | "cell" | "stars" | "mpas" | "dflowfm" | "adcirc" | "fem" | "paper" | "odt" | "cvt";
/** Time that the run may take.
 * - `quick`: Few sweeps and repairs, in about half of the time.
 * - `normal`: Sweeps until little is gained. Targets vertex and cell also lower the error of the solver itself.
 * - `high`: More sweeps and repairs, which may add and remove vertices. More steps lower the solver's own error. */
export type EffortName = "quick" | "normal" | "high";
/** Part of the mesh that stays.
 * - `positions`: All vertices stay, and only weights change.
 * - `weights`: All weights stay, and only positions change.
 * - `edges`: No edge flips.
 * - `boundary`: Vertices of the boundary and of interfaces stay.
 * - `sizes`: Local sizes stay within a factor of 2. */
export type KeepName = "positions" | "weights" | "edges" | "boundary" | "sizes";

/** Further options of `optimize`. */
export interface OptimizeOptions {
  /** Energy to lower. Barriers: BH, BHs, BP. HOT energies: F, T, dT. HOT energies over squared areas: nF, nT, ndT. Optimal Delaunay triangulation: ODT. Default: "BP". */
  energy?: "F" | "T" | "dT" | "BH" | "BHs" | "BP" | "nF" | "nT" | "ndT" | "ODT";
  /** Hodge star whose error should be small. all: the three at once, except with objective: "energy". The first sweeps for accuracy always use star 1. Star 3 is for tetrahedra, for which only energy: "F" has stars. Default: 1. */
  star?: 0 | 1 | 2 | 3 | "all";
  /** Parameter gamma of E_BP; more than 0. null: gamma is relative to each edge. It shrinks to 0.003, from 1 if many triangles are bad, otherwise from 0.5. Default: null. */
  gamma?: LengthParameterLike | null;
  /** Parameter -h0 of E_BHs, at least 0. E_BHs keeps h above h0; at least 0. null: h0 is just below the least h of the mesh. It rises with the least h. Default: null. */
  h0?: LengthParameterLike | null;
  /** Height of boundary edges in energies F and nF. boundary_treatment: "as_is": h itself. absolute: |h|. mirrored: as if the mesh were mirrored there. Default: "as_is". */
  boundary_treatment?: "as_is" | "absolute" | "mirrored";
  /** Energy that the first sweeps lower, before they switch to energy. null: energy from the first sweep on. If scheme is one scheme and a mesh of the plane has no weights, ten sweeps lower ODT first. Default: null. */
  first_energy?: "F" | "T" | "dT" | "BH" | "BHs" | "BP" | "nF" | "nT" | "ndT" | "ODT" | null;
  /** First sweep that lowers energy after first_energy, counted from 0. The switch comes earlier if the first energy has converged; at least 0. Default: 20. */
  switch_at?: number;
  /** Objective of the run. energy: lower energy to the end. accuracy: once all triangles are well-centered, lower the distances between the midpoints of edges and duals. With objective: "solver_error" a third phase lowers the error of the solver itself. It takes longer. null: accuracy. With scheme: "vertex" or scheme: "cell", on a plane with at most solver_error_vertices, it is objective: "solver_error". If energy is not BP, or a switch of the paper other than order and seed is set, it is energy. Default: null. */
  objective?: "energy" | "accuracy" | "solver_error" | null;
  /** Scheme of the solver. vertex: unknowns at vertices. cell: unknowns at orthocenters, two-point flux. stars: diagonal Hodge stars. all: each of these, with larger margins. Default: "all". */
  scheme?: "all" | "vertex" | "cell" | "stars";
  /** Part of the mesh that may change. least: only the places that violate what scheme needs. All else stays, bit for bit, unless many places are bad, or stay bad. Default: "all". */
  change?: "all" | "least";
  /** Least margin in every triangle: h/l, d/l and 1 - d/l stay above it; more than 0 and less than 0.25. null: 0.1, or 0.02 if scheme is one scheme. Default: null. */
  margin?: number | null;
  /** Least length of interior edges, as a multiple of the local size; at least 0 and at most 0.95. Default: 0. */
  min_edge?: number;
  /** Least length of interior dual edges, as a multiple of the local size; at least 0 and at most 0.55. Default: 0. */
  min_dual?: number;
  /** Factor of the offset between the midpoints of edge and dual. 1: HOT over the squared size; at least 0. null: 10, or 20 for scheme: "stars". Default: null. */
  offset_factor?: number | null;
  /** Factor of the height of boundary edges, relative to HOT; at least 0. null: 5 for scheme: "all", 0.5 for vertex, 30 for cell, 18 for stars. Default: null. */
  boundary_offset_factor?: number | null;
  /** Factor of the logarithms that keep margins and least lengths; more than 0. Default: 0.003. */
  barrier?: number;
  /** Largest number of sweeps for accuracy. They follow the sweeps for energy; at least 0. Default: 32. */
  accuracy_sweeps?: number;
  /** Relative tolerance for accuracy. The sweeps end when one gains less than this part; at least 0. Default: 0.00001. */
  accuracy_tolerance?: number;
  /** Factor of the accuracy objective, which is lowered together with the error of the solver. It keeps other errors from rising; at least 0. Default: 1. */
  offset_share?: number;
  /** Largest number of steps for the error of the solver. Each moves all vertices at once, after all other sweeps; at least 0. Default: 15. */
  solver_error_steps?: number;
  /** Relative tolerance for the error of the solver. The steps end when ten of them gain less than this part; at least 0. Default: 0.005. */
  solver_error_tolerance?: number;
  /** Largest number of vertices for which the error of the solver is lowered, if objective is auto; at least 0. Default: 200000. */
  solver_error_vertices?: number;
  /** Method that improves one vertex. newton: Newton steps in position and weight together. golden: the paper's golden section. alternating: Newton in position, then in weight. Default: "newton". */
  solver?: "newton" | "golden" | "alternating";
  /** Unknowns that steps may change. The others keep their values. Default: "positions_and_weights". */
  unknowns?: "positions_and_weights" | "positions" | "weights";
  /** First sweep that changes weights, counted from 0; at least 0. Default: 0. */
  weights_from?: number;
  /** Over-relaxation of Newton steps; more than 0 and less than 2. null: 1.7, or 1.97 while gamma shrinks from 1. Default: null. */
  relaxation?: number | null;
  /** Radius of golden section for positions. rms: root mean square distance to the neighbors. max: distance to the farthest one. min: distance to the nearest one. Default: "rms". */
  search_radius?: "rms" | "max" | "min";
  /** Radius of golden section for weights, as a multiple of the squared radius for positions; more than 0. Default: 1. */
  weight_search_radius?: number;
  /** Number of visits to each vertex in one sweep. twice: first all positions, then all weights. Default: "once". */
  visits?: "once" | "twice";
  /** Vertex that has weight 0 after each sweep. All weights are shifted for this; a vertex. null: weights are not shifted. Default: null. */
  anchor?: number | null;
  /** Time at which edges flip. immediate: at once. deferred: after the inner sweeps. none: never. Then the connectivity stays, and no step may make an edge non-regular. Default: "immediate". */
  flips?: "immediate" | "deferred" | "none";
  /** Limit of a step that makes an edge flip. The step ends before, at or after the flip, or is unlimited. null: unlimited for barriers, after for HOT. Default: null. */
  flip_limit?: "unlimited" | "before" | "at" | "after" | null;
  /** Length of a step with flip_limit: "after" in the first sweep, as a multiple of the way to the flip; more than 0. Default: 1.1. */
  overshoot?: number;
  /** Factor per sweep on the difference between the overshoot and 1. With factor 1 the overshoot is constant; at least 0 and at most 1. Default: 0.1. */
  overshoot_factor?: number;
  /** Treatment of triangles that stay invalid. none: nothing. perturb: sweep again with random moves, and find weights by a linear program. vertices: also remove and insert vertices. The best result is kept. Default: "perturb". */
  repair?: "none" | "perturb" | "vertices";
  /** Largest number of edits that repairs try, 1 to 3 ms each. A linear program counts as 20. On curved surfaces, repairs end after 1/33 of this number of edits without help; at least 0. Default: 20000. */
  repair_trials?: number;
  /** Treatment of the boundary. keep: it stays bit for bit. slide: vertices may move along straight pieces; in tetrahedra also in planes, and on curved surfaces along boundary, creases and lines. Corners stay. split: cut long edges of the boundary or of interfaces, next to much shorter ones, before the sweeps, and with repair: "vertices" also where triangles stay bad. In tetrahedra, new vertices are on edges and faces, and only if a tetrahedron stays bad without them. The old vertices stay bit for bit. Default: "keep". */
  boundary?: "keep" | "slide" | "split";
  /** Largest ratio of the lengths of two boundary or interface edges that meet, with boundary: "split". Longer edges are cut; at least 2. Default: 4. */
  boundary_ratio?: number;
  /** Treatment of vertices on region interfaces and tagged lines. fixed: they stay. sliding: they may move along straight lines. Default: "fixed". */
  interfaces?: "fixed" | "sliding";
  /** Size band B. No step moves the size at a vertex out of the range from 1/B to B times the size field; at least 1. null: sizes are only reported. Default: null. */
  size_band?: number | null;
  /** Factor B of coarsening. The run searches for fewer vertices, and keeps all triangles well-centered. No removal makes the size at a vertex larger than B times the size field. The input's vertices on boundary and lines stay; at least 1. null: no coarsening. Default: null. */
  coarsen?: number | null;
  /** Largest number of random moves of coarsening, 0.1 to 10 ms each. They follow the removal of single vertices; at least 0. Default: 2000. */
  coarsen_moves?: number;
  /** Largest number of sweeps before edges flip, with flips: "deferred". 0: sweep until convergence; at least 0. Default: 1. */
  inner?: number;
  /** Largest number of rounds of sweeps and flips, with flips: "deferred". 0: continue until no flips are needed; at least 0. Default: 0. */
  outer?: number;
  /** Time at which neighbors see a new weight. immediate: at once. deferred: after the sweep. With solver: "newton", positions must then be deferred too. Default: "immediate". */
  weight_updates?: "immediate" | "deferred";
  /** Time at which neighbors see a new position. immediate: at once. deferred: after the sweep. All unknowns are then from the sweep before, so weights that move need weight_updates: "deferred". Default: "immediate". */
  position_updates?: "immediate" | "deferred";
  /** First sweep with collapses of short edges, counted from 0. It is i_c of Algorithm 2; at least 0. null: no collapses. Default: null. */
  collapse_from?: number | null;
  /** Energy E_c of collapses, which draws a vertex to an edge. Default: "dT". */
  collapse_energy?: "F" | "T" | "dT";
  /** Ratio below which a vertex collapses. It is the distance from the least E_c to the nearest neighbor, over the shorter link edge at that neighbor; more than 0 and less than 1. Default: 0.1. */
  collapse_ratio?: number;
  /** Removal of vertices. patch: if the patch is better without the vertex. This is line 15 of Algorithm 1. weight: if the weight is far below its neighbors' weights. Default: "none". */
  removal?: "none" | "patch" | "weight";
  /** Measure that compares patches. sum: total energy, as in the paper. mean: energy per triangle. excess: energy above the energy of equilateral triangles. Default: "mean". */
  removal_measure?: "sum" | "mean" | "excess";
  /** Relative gain of the patch that a removal or an insertion needs; at least 0. Default: 0.1. */
  removal_margin?: number;
  /** Threshold of removal: "weight". It is the distance of a weight below the mean weight of its neighbors, over their mean squared distance; more than 0. Default: 1. */
  hidden_threshold?: number;
  /** First sweep with removals, counted from 0; at least 0. Default: 10. */
  removal_from?: number;
  /** First sweep after which vertices are inserted, counted from 0. They go to triangles of large energy, if that makes the mesh better; at least 0. null: no insertions. Default: null. */
  insertion_from?: number | null;
  /** Ratio to the mean energy of a triangle, above which an energy is large; more than 1. Default: 4. */
  insertion_ratio?: number;
  /** Place of new vertices in triangles of large energy, and of repairs in bad triangles. best: the orthocenter; repairs try several places. Default: "best". */
  insertion_place?: "best" | "orthocenter" | "circumcenter" | "centroid";
  /** Treatment of vertices that weights hide. undo: undo the step. remove: remove the vertex. keep: keep the vertex and report it. Default: "undo". */
  hidden?: "undo" | "remove" | "keep";
  /** Treatment of steps that turn a triangle over. refuse: refused. allow: allowed as in the paper, with flips: "deferred". infinite: barriers are infinite there. Searches may then pass over such places, but never end there. Default: "refuse". */
  inversion?: "refuse" | "allow" | "infinite";
  /** Order in which a sweep visits the vertices. Default: "hilbert". */
  order?: "hilbert" | "input" | "reverse" | "random";
  /** Largest number of sweeps over the vertices; at least 0. Default: 1000. */
  max_sweeps?: number;
  /** Tolerance. The sweeps end when one gains less than this; at least 0. Default: 0.00001. */
  tolerance?: number;
  /** Measure of the gain of a sweep. relative: relative to the energy. paper: change of the mean energy per triangle, absolute. Default: "relative". */
  stopping?: "relative" | "paper";
  /** Time limit of the run in seconds. 0: no limit; at least 0. Default: 0. */
  time_limit?: number;
  /** Seed of the jitter that frees symmetric grids, of repairs, and of order: "random"; at least 0. Default: 1. */
  seed?: number;
  /** Solver whose measures the guard keeps. No measure of it becomes worse than in the input. If the input meets the limits of D-Flow FM, ADCIRC or MPAS, it comes back. Default: "none". */
  guard?: "none" | "fem" | "adcirc" | "dflowfm" | "mpas";
  /** Bound of the guard for the least angle a in degrees, and 180 - 2a for the largest one. The least angle never falls below it, or below the least one of the input if that is smaller. 60: the input's. 0: no limit. For tetrahedra it is about dihedral angles, and bounds the least alone; at least 0 and at most 60. Default: 0. */
  guard_angle?: number;
  /** Bound of the guard for the least length of an inner edge over the size of its triangles, not over the local size. 1: the input's. 0: no limit; at least 0 and at most 1. Default: 0. */
  guard_edge?: number;
  /** Bound of the guard for the largest ratio of the areas of two triangles that share an edge; at least 1. null: no limit. Default: null. */
  guard_areas?: number | null;
  /** Bound of the guard for the shortest edge, in the unit of the coordinates; at least 0. null: the shortest edge of the input, if there is another limit. Default: null. */
  guard_length?: number | null;
  /** Bound of the guard for the time in seconds in which a long wave crosses a triangle or an edge. It holds if the mesh has point data with the name depth; at least 0. null: the shortest time of the input, if there is another limit. Default: null. */
  guard_step?: number | null;
}

// Written by scripts/docs/records.py --write from the tables in the library. Do not edit.
import type { Certificate } from './types.ts';

/** An edge as a place. */
export interface EdgePlace {
  /** Its vertices. */
  vertices: [number, number];
  /** Its midpoint; on a sphere longitude and latitude [degrees]. */
  at: [number, number];
  /** Third coordinate of the midpoint, on a curved surface. */
  z: number | null;
}

/** Counts in equal bins over [low, high]. Each bin includes its lower end. Values outside go to the end bins. */
export interface Histogram {
  low: number;
  high: number;
  counts: number[];
}

/** Histograms of a mesh. */
export interface Histograms {
  /** Angles of all triangles [degrees]. */
  angles: Histogram;
  /** h/ℓ of each triangle and edge. */
  h_over_l: Histogram;
  /** Lesser of d/ℓ and 1 − d/ℓ of each edge. */
  d_over_l: Histogram;
}

/** A triangle whose least h/ℓ or d/ℓ is among the smallest of the mesh. */
export interface WorstTriangle {
  /** Number of the triangle, from 0. */
  triangle: number;
  /** Its vertices. */
  vertices: [number, number, number];
  /** Its centroid; on a sphere longitude and latitude [degrees]. */
  at: [number, number];
  /** Least h/ℓ of its three edges. */
  h_over_l: number;
  /** Largest of its three angles [degrees]. */
  angle_deg: number;
  /** The reason, such as "orthocenter outside across edge 3-9: angle of 138.3° at vertex 10". */
  why: string;
  /** Third coordinate of the centroid, on a curved surface. */
  z: number | null;
}

/** The result of `quality`: counts decided exactly, margins and energies in doubles. On a sphere lengths and angles are measured along arcs. */
export interface Quality {
  /** Vertices. */
  vertices: number;
  /** Triangles. */
  triangles: number;
  /** Edges. */
  edges: number;
  /** Edges of one triangle. */
  boundary_edges: number;
  /** Different regions of triangles. */
  regions: number;
  /** Triangles that are clockwise, exact. */
  inverted_triangles: number;
  /** Interior edges with negative dual, exact. */
  non_regular_edges: number;
  /** Boundary edges with h < 0, exact. */
  negative_boundary_duals: number;
  /** Sides of interfaces between regions with h < 0, exact: the coefficient of this region alone is negative. */
  negative_region_coefficients: number;
  /** Interior edges with dual ≤ 0, exact. */
  nonpositive_distances: number;
  /** Boundary edges with h ≤ 0, exact. */
  nonpositive_boundary_distances: number;
  /** Sides of interfaces between regions with h ≤ 0, exact. */
  nonpositive_region_distances: number;
  /** Triangles with some h ≤ 0, exact. */
  orthocenters_outside: number;
  /** Edges without 0 < d < ℓ, exact. */
  edges_not_crossed: number;
  /** Triangles with all h > 0 and 0 < d < ℓ. */
  well_centered_fraction: number;
  /** Least coefficient, which is dual/ℓ of edges, and h/ℓ on the sides of interfaces; also the least distance over ℓ. */
  min_coefficient: number;
  /** Least h/ℓ of triangles and their edges. */
  min_h_over_l: number;
  /** Least d/ℓ or 1 − d/ℓ of edges. */
  min_d_over_l: number;
  /** Least angle of triangles. */
  min_angle_deg: number;
  /** Largest angle of triangles. */
  max_angle_deg: number;
  /** Largest over median ℓ/|dual| of interior edges. */
  max_transmissibility_over_median: number;
  /** Largest over least ℓ/|dual| of interior edges. */
  transmissibility_ratio: number;
  /** Least length of interior edges over local size, as in --min-edge. */
  min_edge_over_size: number;
  /** Least signed length of interior duals over local size, as in --min-dual. */
  min_dual_over_size: number;
  /** Least signed dual of a closed cell over the median length of its duals. */
  min_dual_over_cell_median: number;
  /** Largest |cosine| between an interior edge and the line between the circumcenters on its sides, kept inside their triangles (MeshKernel, MeshOrthogonality). Advice: 0.01. D-Flow FM refuses 0.5 (cosPhiUTrsh). */
  max_orthogonality: number;
  /** Largest ratio of the areas on the sides of an interior edge (MeshKernel, MeshSmoothness). */
  max_smoothness: number;
  /** Least distance between neighboring circumcenters, kept inside their triangles, over the mean square root of both areas (MeshKernel, GetEdgesCrossingSmallFlowEdges). */
  min_flow_link: number;
  /** Interior edges with a flow link below 0.1, which D-Flow FM removes (removeSmallLinksTrsh). */
  small_flow_links: number;
  /** Shortest over longest dvEdge of a closed cell (MPAS-Tools, mpas_mesh_converter). */
  min_cell_quality: number;
  /** Mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]. */
  min_grid_spacing: number;
  /** Mean dcEdge of a cell (MPAS-Tools, mpas_mesh_converter) [length]. */
  max_grid_spacing: number;
  /** Shortest over longest dcEdge of a triangle (MPAS-Tools, mpas_mesh_converter). */
  min_triangle_quality: number;
  /** Least over largest angle of a triangle, by the law of cosines (MPAS-Tools, mpas_mesh_converter). */
  min_triangle_angle_quality: number;
  /** Triangles with an angle above 90° (MPAS-Tools, mpas_mesh_converter), exact. */
  obtuse_triangles: number;
  /** Largest distance of a vertex from the centroid of its closed cell, over local size; 0 in centroidal Voronoi meshes. */
  max_centroid_offset_over_size: number;
  /** Total of each energy for ★0, ★1, ★2; infinite outside its domain. */
  energy: Record<'F' | 'T' | 'dT' | 'BH' | 'BHs' | 'BP' | 'nF' | 'nT' | 'ndT' | 'ODT', [number, number, number]>;
  /** Edge with the least coefficient. */
  min_coefficient_place: EdgePlace;
  /** Histograms of angles, h/ℓ and d/ℓ. */
  histograms: Histograms;
  /** Worst triangles, the worst first. */
  worst: WorstTriangle[];
}

/** The distribution of many numbers: percentiles by nearest rank. All are 0 if there are no numbers. */
export interface Spread {
  min: number;
  p05: number;
  median: number;
  p95: number;
  max: number;
}

/** The comparison of a mesh with a size field. No number depends on the unit of length. */
export interface SizeReport {
  /** Local size over field at the vertices. */
  over_field: Spread;
  /** Ratio of the greater to the smaller local size at the two ends of each edge. */
  gradation: Spread;
  /** Largest ratio of the longest to the shortest edge of a triangle. */
  largest_edge_ratio: number;
  /** Number of vertices outside the field's mesh. */
  vertices_outside_field: number;
  /** B of the smallest band [1/B, B] that holds all ratios of size to field. */
  band: number;
}

/** The change of the sizes: both meshes compared with the size field. */
export interface SizeChange {
  /** The input. */
  before: SizeReport;
  /** The result. */
  after: SizeReport;
}

/** Counts of the changes of a run, by the numbers of the input. */
export interface ChangeCounts {
  /** Vertices of the input at another place. */
  vertices_moved: number;
  /** Vertices of the input with another weight. */
  weights_changed: number;
  /** Edges of the result that the input does not have. */
  edges_changed: number;
}

/** One sweep over all vertices. */
export interface SweepRecord {
  /** Number of the sweep; 0 is the input. */
  sweep: number;
  /** Value of the objective at the end of the sweep, at its γ. */
  energy: number;
  /** Number of triangles or tetrahedra that are not well-centered. */
  bad: number;
  /** Number of flips in this sweep. */
  flips: number;
  /** Value of γ or −h° in this sweep, relative to ℓ by default. */
  length_parameter: number;
  /** Time since the start of the optimization [s]. */
  seconds: number;
  /** Objective that the sweep lowered. */
  objective: 'energy' | 'accuracy' | 'solver_error';
}

/** The result of `optimize`. */
export interface OptimizeReport {
  /** Number of sweeps. */
  sweeps: number;
  /** Time of the optimization alone [s]. */
  seconds: number;
  /** Reason for the end of the run. tangled: triangles are inverted and no flips can make the mesh regular. hidden: deferred flips hid a vertex against the policy, and the mesh is an earlier one. sweep_limit: all sweeps for the accuracy are done, a normal end. */
  stopped: 'converged' | 'max_sweeps' | 'max_outer' | 'time_limit' | 'canceled' | 'tangled' | 'sweep_limit' | 'hidden';
  /** Objective that the run lowered. */
  objective: 'energy' | 'accuracy' | 'solver_error';
  /** Objective of the input, at the final γ. */
  objective_before: number;
  /** Objective of the result. */
  objective_after: number;
  /** Number of vertices of the input that were removed. */
  vertices_removed: number;
  /** Vertices without a power cell that the option hidden = keep left. */
  hidden_vertices: number[];
  /** Number of new vertices. */
  vertices_inserted: number;
  /** Number of changes of connectivity without a new or removed vertex. */
  flips: number;
  /** Number of triangles or tetrahedra of the input that are not well-centered, before any flip. */
  bad_before: number;
  /** Number of these in the result. */
  bad_after: number;
  /** Number of each vertex in the input; inserted vertices follow, with −1. Empty if none was removed or inserted. */
  vertices: number[];
  /** Change of the sizes; absent for tetrahedra. */
  size: SizeChange;
  /** Changes of the run, with change = least. */
  changed: ChangeCounts | null;
  /** Notes for the user, in sentences. */
  notes: string[];
  /** One record per sweep; history[0] is the input. Triangles are flipped to be regular before. */
  history: SweepRecord[];
}

/** Progress of a run. Observers get it at least once per sweep, and more often on large meshes. */
export interface Progress {
  /** Last whole sweep. */
  last: SweepRecord;
  /** Fraction of the current sweep, in [0, 1). */
  fraction: number;
  /** Largest number of sweeps. */
  max_sweeps: number;
  /** Estimate of the sweeps after the last one, while the energy converges. Absent in the first sweeps of a stage. */
  sweeps_left: number | null;
  /** Number of vertices, while the run searches for a mesh with fewer. */
  n_vertices: number | null;
  /** Estimate of the share of the present phase that is done, in [0, 1]. Each objective of `last` is a phase, and its energy has another meaning than in the phase before. */
  share_of_phase: number | null;
  /** Phase of the mesher before an optimization, such as "placing points"; `fraction` is then the share of the phase that is done, as far as it is known. Empty in an optimization. */
  phase: string;
}

/** An event of a run. Vertices are numbered as in the input, also after removals; new vertices get the next numbers. Coordinates and weights are in the user's units. */
export interface TraceEvent {
  /** Kind of the event. */
  kind: 'move' | 'weight' | 'flip' | 'collapse' | 'removal' | 'insertion' | 'split' | 'hidden' | 'undo';
  /** Sweep of the event; 0: the input is made regular and its boundary cut. */
  sweep: number;
  /** Vertex of the event; −1 for flip, and for undo of whole sweeps. For insertion and split, the new vertex. */
  vertex: number;
  /** Energy before the event, of the vertex's patch or of all edges that a flip changes; NaN if the event has none. */
  before: number;
  /** Energy after the event. */
  after: number;
  /** New x, y, w of the vertex for move, weight, insertion, split; on a sphere its weighted vector. */
  point: [number, number, number];
  /** For flip: edge a→b, with c on its left and d on its right, becomes d→c. For split: a→b was cut; d is −1 on the boundary. */
  quad: [number, number, number, number];
  /** Neighbors, counter-clockwise, for collapse and removal; corners of the triangle for insertion. */
  link: number[];
  /** New triangles of the cavity, in slot order, for collapse and removal. */
  triangles: [number, number, number][];
  /** For undo without a vertex: the sweep at whose end the mesh was the same; −1: the input as given. */
  to_sweep: number;
}

/** A summary of the operators, for a check before a solver uses them. */
export interface DecSummary {
  /** Number of vertices. */
  vertices: number;
  /** Number of edges. */
  edges: number;
  /** Number of edges on the boundary. */
  boundary_edges: number;
  /** Number of triangles. */
  triangles: number;
  /** Number of triangles that are not well-centered, exact. */
  not_well_centered: number;
  /** Area of the domain [length²]. */
  area: number;
  /** Sum of ★0: the area, except for rounding [length²]. */
  star0_sum: number;
  /** Number of negative ★0. */
  negative_star0: number;
  /** Number of interior edges that are not regular, exact. */
  negative_star1: number;
  /** Number of boundary edges with the orthocenter outside the domain, exact. */
  negative_boundary_star1: number;
  /** Number of interior edges that are cocircular, exact. */
  zero_star1: number;
  /** Least ★0. */
  min_star0: number;
  /** Least ★1. */
  min_star1: number;
  /** Median of |★1| over all edges. */
  median_star1: number;
  /** Largest |★1|. */
  max_star1: number;
  /** Largest over median |★1|. */
  max_star1_over_median: number;
  /** Median of |transmissibility| inside. */
  median_transmissibility: number;
  /** Largest |transmissibility| inside; infinite if a dual edge has length 0. */
  max_transmissibility: number;
  /** Largest over median |transmissibility|. */
  max_transmissibility_over_median: number;
}

/** One side of the edge of a conflict: the interval in which well-centered triangles let the dual cross the edge. */
export interface CrossingSide {
  /** Triangles of this side; the first one has the edge. */
  triangles: number[];
  /** Begin of the interval, as a distance from the edge's first vertex, exclusive [length]. */
  from: number;
  /** End of the interval [length]. */
  to: number;
  /** Vertex of the largest angle of these triangles. */
  widest_at: number;
  /** Largest angle of these triangles [degrees]. */
  angle_deg: number;
}

/** An edge whose two sides have disjoint intervals. */
export interface CrossingConflict {
  /** Vertices p and q of the edge. */
  edge: [number, number];
  /** Length of the edge [length]. */
  length: number;
  /** Left side of p → q. */
  left: CrossingSide;
  /** Right side of p → q. */
  right: CrossingSide;
}

/** The common corner of the triangles of a fan. */
export interface FanCenter {
  /** The corner. */
  vertex: number;
  /** The corner is on the boundary. */
  on_boundary: boolean;
  /** Angle of the domain at a boundary vertex; else 360 [degrees]. */
  angle_deg: number;
  /** Shortest edge of the fan at the corner. */
  shortest_edge: [number, number];
  /** Its length [length]. */
  shortest_length: number;
  /** Longest edge of the fan at the corner. */
  longest_edge: [number, number];
  /** Its length [length]. */
  longest_length: number;
}

/** An edge u → v with contradictory vertices: one requires that the dual crosses it near u, another near v. */
export interface EdgeConflict {
  /** Vertices u and v. */
  edge: [number, number];
  /** Halfedge from u to v. */
  halfedge: number;
  /** Length of the edge [length]. */
  length: number;
  /** The vertex that requires a crossing near u, and the one near v. */
  near: [number, number];
  /** Largest distances of these crossings from u, and from v [length]. */
  within: [number, number];
  /** Sum of these distances over the length: at most 1 if there is no place for the crossing. */
  sum: number;
  /** Part of the way from u: the middle of what is left, but at least 0.2 from each end. */
  split_at: number;
}

/** A change that would cure a reason. */
export interface Cure {
  /** Kind of the change. */
  action: 'find_weights' | 'optimize' | 'move_vertex' | 'flip_edge' | 'insert_vertex' | 'split_edge' | 'split_boundary' | 'split_interface';
  /** Edge that is flipped or split. */
  edge: [number, number] | null;
  /** Vertex that is moved. */
  vertex: number | null;
  /** Triangle that gets a vertex. */
  triangle: number | null;
  /** Place of the change; on the sphere longitude and latitude [degrees]. */
  at: [number, number] | null;
  /** A trial on a copy succeeded: the triangles of the neighborhood then have weights that make them well-centered, checked exactly. */
  verified: boolean;
  /** Only the triangles of the conflict, and those that the change touches, were tested. */
  conflict_only: boolean;
  /** For a split: neither half of the edge must be split again, checked exactly. */
  ends_conflict: boolean;
  /** Best margin of h/ℓ and d/ℓ after the cure. */
  margin: number | null;
  /** Number of triangles that `margin` is for. */
  margin_of: number;
  /** Number of bad triangles nearby that belong to other conflicts and were not tested. */
  left_out: number;
  /** For find_weights: number of nonzero weights around the bad triangles. */
  weights_changed: number;
  /** The cure in one sentence. */
  text: string;
}

/** A reason why triangles are not well-centered. */
export interface Reason {
  /** Kind of the reason. */
  kind: 'split' | 'edge' | 'fan' | 'patch' | 'interface' | 'weights' | 'undecided';
  /** Centroid of the worst triangle; on the sphere longitude and latitude [degrees]. */
  at: [number, number];
  /** Triangles that are not well-centered for this reason, worst first. */
  triangles: number[];
  /** Least h/ℓ or d/ℓ of these triangles as they are. */
  least_margin: number;
  /** For edge, fan, patch: smallest set of triangles for which no weights exist; `triangles` is a part of it. */
  conflict: number[];
  /** Best margin. For edge, fan, patch: of the conflict, at most 0. For weights: of the neighborhood, above 0. */
  margin: number;
  /** Number of triangles that `margin` is for. */
  margin_of: number;
  /** `margin` is the least over bad triangles, each with the triangles that touch it. */
  each: boolean;
  /** Corners that may move. */
  free: number[];
  /** Crossings, for edge, fan, and patches without closed rings. */
  crossing: CrossingConflict | null;
  /** Common vertex of all triangles, for edge, fan, patch, if there is one. */
  center: FanCenter | null;
  /** Conflict of the edge, for split. */
  must_split: EdgeConflict | null;
  /** Proof for edge, fan, patch, interface; `check_certificate` accepts it. */
  certificate: Certificate;
  /** Cures were searched for; else `cures` has only those that need no search. */
  cures_searched: boolean;
  /** Cures, best first. */
  cures: Cure[];
  /** The reason in words. */
  text: string;
}

/** The result of `explain`. */
export interface Explanation {
  /** Number of triangles. */
  triangles: number;
  /** Number of triangles that are not well-centered. */
  bad: number;
  /** Verdict on the whole mesh with its positions and connectivity. Feasible if no triangle is bad. */
  verdict: 'feasible' | 'infeasible' | 'undecided';
  /** For feasible: number of nonzero weights in the result of find_weights. */
  weights_changed: number | null;
  /** Requested margin of these weights: 0.01, or half of the best margin if that is less. */
  margin: number;
  /** Reasons: certified ones first, by least margin; then by least_margin. */
  reasons: Reason[];
}

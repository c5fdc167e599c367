// Arguments and results of functions that are no reports, with the names of Python.
import type { Mesh } from './mesh.ts';
import type { OptimizeOptions } from './options.ts';
import type { DecSummary, OptimizeReport } from './records.ts';

export type EnergyName = NonNullable<OptimizeOptions['energy']>;
export type ObjectiveName = NonNullable<OptimizeOptions['objective']>;
export type BoundaryTreatment = 'as_is' | 'absolute' | 'mirrored';

/** A length, absolute or relative to each edge. */
export interface LengthParameter {
  value: number;
  scale: 'absolute' | 'relative';
}
/** A plain number is relative to each edge. */
export type LengthParameterLike = number | LengthParameter;

/** kxx, kxy, kyy of a diffusion tensor K, for −div(K ∇u): symmetric, positive definite. */
export type Tensor = readonly number[];
/** One tensor; one for each region, by its number; or one for each triangle. */
export type TensorLike = Tensor | Readonly<Record<number, Tensor>> | readonly Tensor[];

/** A row of the registry of energies. */
export interface EnergyInfo {
  name: EnergyName;
  formula: string;
  boundary_treatment: BoundaryTreatment;
  /** Infinite outside 0 < d < ℓ. */
  barrier: boolean;
  softened_by_gamma: boolean;
  softened_by_h0: boolean;
  length_exponent: number;
  signed_by_dual: boolean;
  normalized: boolean;
  positions_alone: boolean;
}

/** An energy and its parameters. */
export interface EnergyModel {
  energy?: EnergyName;
  star?: 0 | 1 | 2;
  boundary_treatment?: BoundaryTreatment;
  gamma?: LengthParameterLike;
  h0?: LengthParameterLike;
  wall?: boolean;
}

/** The energy as a function of one vertex. */
export interface VertexDerivatives {
  /** Infinity if not feasible. */
  value: number;
  feasible: boolean;
  /** ∂E/∂x, ∂E/∂y, ∂E/∂w. */
  gradient: [number, number, number];
  /** xx, xy, xw, yy, yw, ww. */
  hessian: [number, number, number, number, number, number];
}

export type Stopped = OptimizeReport['stopped'];

/** The mesh as it is after a sweep of a run. */
export interface Snapshot {
  sweep: number;
  /** A copy. */
  mesh: Mesh;
}

/** A file format: a row of `formats()`. */
export interface Format {
  name: string;
  description: string;
  /** Suffixes such as ".vtu", separated by spaces. `write` uses the first. */
  suffixes: string;
  writes: boolean;
  /** If false, weights go to a file PATH.weights.csv. */
  holds_weights: boolean;
  /** Holds meshes of the plane. If false, it only holds meshes that were read in degrees. */
  holds_planes: boolean;
  holds_spheres: boolean;
  holds_tetrahedra: boolean;
}

export interface Restoration {
  flips: number;
  regular: boolean;
  /** Halfedges whose edges no flips make regular. */
  stuck: number[];
  /** Vertices that their weights hide. */
  hidden: number[];
}

/** A word that sets several options. */
export interface Preset {
  name: string;
  sentence: string;
  /** Is for the study of methods. */
  research: boolean;
}

/** A row of the table of options. */
export interface OptionRow {
  name: string;
  group: string;
  sentence: string;
  choices: (string | number)[];
  /** The value may be null. */
  optional: boolean;
  /** "at least 2" */
  range: string;
  /** Meaning of null. */
  absent: string;
  default: unknown;
}

/** A sparse matrix of entries ±1, in compressed rows. */
export interface IncidenceMatrix {
  /** Rows + 1. */
  starts: Int32Array;
  columns: Int32Array;
  signs: Int8Array;
}

/** Values of each edge, in the order of (from, to). Left and right are seen from from → to. Pairs are flat. */
export interface DecEdges {
  vertices: Int32Array;
  /** Left and right; −1 on the boundary. */
  triangles: Int32Array;
  length: Float64Array;
  /** d from `from`. */
  crossing: Float64Array;
  left_height: Float64Array;
  right_height: Float64Array;
  /** With the sign of the exact predicates. */
  dual_length: Float64Array;
  /** x, y of the weighted midpoint. */
  midpoint: Float64Array;
}

/** Discrete exterior calculus on a mesh: incidence, diagonal stars with signed power duals, and the dual. */
export interface DecComplex {
  edges: DecEdges;
  edge_of_halfedge: Int32Array;
  /** Edges × vertices. */
  d0: IncidenceMatrix;
  /** Triangles × edges. */
  d1: IncidenceMatrix;
  star0: Float64Array;
  star1: Float64Array;
  star2: Float64Array;
  /** Transmissibility of a two-point flux between orthocenters. It is Infinity if a dual edge has no length. */
  transmissibility: Float64Array;
  /** With several tensors, else empty: K ℓ/h of each halfedge. Where both triangles of an edge have one, the harmonic sum is
   * the transmissibility. */
  half_transmissibility: Float64Array;
  /** x, y of the orthocenter of each triangle. */
  orthocenters: Float64Array;
  areas: Float64Array;
  summary: DecSummary;
}

export interface DrawOptions {
  primal?: boolean;
  dual?: boolean;
  fill?: boolean;
  weights?: boolean;
  weight_scale?: number;
  near_coincident?: boolean;
  vertex_numbers?: boolean;
  /** x0, y0, x1, y1: draw only parts in this box. */
  zoom?: [number, number, number, number] | null;
  width?: number;
  title?: string;
}

/** An inequality of the weights: "height" over edge pq of the triangle pqr, "crossing" from p towards q, "dual" length of pq. */
export interface WeightConstraint {
  kind: 'height' | 'crossing' | 'dual';
  p: number;
  q: number;
  /** −1: none. */
  r: number;
  s: number;
}

/** Proof that no weights exist (Farkas): constraints with multipliers ≥ 0 whose sum is a contradiction. */
export interface Certificate {
  /** No weights satisfy the constraints with more than this margin. */
  margin: number;
  /** None: no certificate. */
  terms: [WeightConstraint, number][];
  constraints: 'well_centered' | 'heights_only' | 'regular';
}

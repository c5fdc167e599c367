// Written by build.mjs --options from the table of options in the library. Not to be edited.
import type { LengthParameterLike } from './records.ts';

/** The options of `optimize`. */
export interface OptimizeOptions {
  /** what to minimize: a barrier (BH, BHs, BP), a HOT energy (F, T, dT), one of these over squared areas (nF, nT, ndT), or what optimal Delaunay triangulations do (ODT). Default: "BP". */
  energy?: "F" | "T" | "dT" | "BH" | "BHs" | "BP" | "nF" | "nT" | "ndT" | "ODT";
  /** Hodge star whose error is to be small. all: the three at once, with objective: "accuracy", which begins with sweeps for star 1 whatever this is. Default: 1. */
  star?: 0 | 1 | 2 | "all";
  /** gamma of E_BP; more than 0; null: relative to each edge, shrinking from 0.5, or 1 where many triangles are bad, to 0.003. Default: null. */
  gamma?: LengthParameterLike | null;
  /** how far below zero E_BHs lets h go (-h0 of the paper, so >= 0); at least 0; null: just beyond the least h of the mesh, following it up. Default: null. */
  h0?: LengthParameterLike | null;
  /** of energy F: the h of boundary edges as it is, |h|, or as if the mesh were mirrored there. Default: "as_is". */
  boundary_treatment?: "as_is" | "absolute" | "mirrored";
  /** what the first sweeps lower instead, before they switch to energy; null: energy from the first sweep on; ODT for ten sweeps target one scheme on a mesh of the plane without weights. Default: null. */
  first_energy?: "F" | "T" | "dT" | "BH" | "BHs" | "BP" | "nF" | "nT" | "ndT" | "ODT" | null;
  /** of first_energy: the first sweep that lowers energy, from 0; an earlier one when the first energy has converged; at least 0. Default: 20. */
  switch_at?: number;
  /** energy: lowers energy to the end; accuracy: lowers the distances between the midpoints of edges and of duals, once all triangles are well-centered; solver_error: then lowers the error of the solver itself, and takes longer; null: accuracy; solver_error with target vertex or cell on a plane of at most 20000 vertices; energy if energy is not BP or has switches of its own. Default: null. */
  objective?: "energy" | "accuracy" | "solver_error" | null;
  /** what the mesh is for. vertex: unknowns at vertices; cell: unknowns at orthocenters (two-point flux); stars: diagonal Hodge stars; all: each of them, with larger margins. Default: "all". */
  target?: "all" | "vertex" | "cell" | "stars";
  /** of accuracy: h/l, d/l and 1 - d/l stay above it in every triangle; more than 0 and less than 0.25; null: 0.1, but 0.02 target one scheme. Default: null. */
  margin?: number | null;
  /** of accuracy: least length of interior edges, over the local size; 0: none; at least 0 and at most 0.95. Default: 0. */
  min_edge?: number;
  /** of accuracy: the same of their dual edges, whose lengths bound time steps; at least 0 and at most 0.55. Default: 0. */
  min_dual?: number;
  /** of accuracy: how many times as much as in HOT the offset of the middles counts; 1: HOT over size squared; at least 0; null: 10, but 20 for stars. Default: null. */
  offset_factor?: number | null;
  /** of accuracy: the same of the height of boundary edges; at least 0; null: 5; for vertex 0.5, cell 30, stars 18. Default: null. */
  boundary_offset_factor?: number | null;
  /** of accuracy: factor of the logarithms that keep the margin; more than 0. Default: 0.003. */
  barrier?: number;
  /** of accuracy: at most this many, after those for the energy; at least 0. Default: 30. */
  accuracy_sweeps?: number;
  /** of accuracy: stop when a sweep gains less than this part; at least 0. Default: 0.00001. */
  accuracy_tolerance?: number;
  /** of error: how much the offset of the middles counts beside it, which other errors go with; at least 0. Default: 1. */
  offset_share?: number;
  /** of error: at most this many, of all vertices at once, after the others; at least 0. Default: 200. */
  solver_error_steps?: number;
  /** of error: stop when ten steps gain less than this part; at least 0. Default: 0.01. */
  solver_error_tolerance?: number;
  /** Newton steps in position and weight together; the paper's golden section; Newton in position, then weight. Default: "newton". */
  solver?: "newton" | "golden" | "alternating";
  /** what steps may change; the others stay as they are. Default: "positions_and_weights". */
  unknowns?: "positions_and_weights" | "positions" | "weights";
  /** first sweep that changes weights, from 0; at least 0. Default: 0. */
  weights_from?: number;
  /** over-relaxation of Newton steps; more than 0 and less than 2; null: 1.7, but 1.97 while gamma shrinks from 1. Default: null. */
  relaxation?: number | null;
  /** how far golden section searches for a position: the root mean square distance to the neighbors, or that of the farthest or the nearest. Default: "rms". */
  search_radius?: "rms" | "max" | "min";
  /** how far golden section searches for a weight, relative to the search radius squared; more than 0. Default: 1. */
  weight_search_radius?: number;
  /** a sweep visits each vertex once, or twice: all positions first, then all weights. Default: "once". */
  visits?: "once" | "twice";
  /** shift the weights after each sweep so that this vertex has weight 0; a vertex; null: they stay. Default: null. */
  anchor?: number | null;
  /** flip edges at once, after the inner sweeps, or never: then the connectivity stays, and no step may make an edge non-regular. Default: "immediate". */
  flips?: "immediate" | "deferred" | "none";
  /** how far a step may go past the point where an edge flips; null: unlimited for barriers, after for HOT. Default: null. */
  flip_limit?: "unlimited" | "before" | "at" | "after" | null;
  /** of flip_limit: "after": where steps end, relative to the way to the flip, at first; more than 0. Default: 1.1. */
  overshoot?: number;
  /** by which what the overshoot is above or below 1 shrinks each sweep; 1: it is constant; at least 0 and at most 1. Default: 0.1. */
  overshoot_factor?: number;
  /** where sweeps leave triangles bad: nothing; sweep again and kick vertices there, and find weights by a linear program; remove and insert vertices there, too, and keep what cures most. Default: "perturb". */
  repair?: "none" | "perturb" | "vertices";
  /** at most so many edits are tried, 1 to 3 ms each; a linear program counts as 20; at least 0. Default: 20000. */
  repair_trials?: number;
  /** keep: the domain's boundary stays bit for bit; slide: vertices of its straight pieces, never corners, may move along them; split: edges of boundary and interfaces much longer than one they meet are cut before the sweeps, and the vertices that were there stay bit for bit. Default: "keep". */
  boundary?: "keep" | "slide" | "split";
  /** of boundary: "split": how many times as long an edge may be as one it meets; at least 2. Default: 4. */
  boundary_ratio?: number;
  /** vertices of straight region interfaces and tagged lines stay, or may move along them. Default: "fixed". */
  interfaces?: "fixed" | "sliding";
  /** B: no step takes the size at a vertex out of the size field's 1/B to B times; at least 1; null: sizes are only reported. Default: null. */
  size_band?: number | null;
  /** with deferred flips: at most so many sweeps before edges are flipped; 0: until they converge; at least 0. Default: 1. */
  inner?: number;
  /** with deferred flips: at most so many rounds of sweeps and flips; 0: until no flips are needed; at least 0. Default: 0. */
  outer?: number;
  /** a new weight is seen by its neighbors at once, or after the sweep (not with solver: "newton"). Default: "immediate". */
  weight_updates?: "immediate" | "deferred";
  /** the same of positions; deferred, with weight_updates: "deferred" where weights move: all unknowns are those of the sweep before. Default: "immediate". */
  position_updates?: "immediate" | "deferred";
  /** i_c: first sweep with short-edge collapses, from 0 (Algorithm 2); at least 0; null: no collapses. Default: null. */
  collapse_from?: number | null;
  /** E_c, which draws a vertex to an edge. Default: "dT". */
  collapse_energy?: "F" | "T" | "dT";
  /** collapse a vertex that E_c wants this near its neighbor, relative to that one's shorter edge beside; more than 0 and less than 1. Default: 0.1. */
  collapse_ratio?: number;
  /** patch: remove a vertex when its patch is better without it (Algorithm 1, line 15); weight: when its weight is far below its neighbors'. Default: "none". */
  removal?: "none" | "patch" | "weight";
  /** by what patches are compared: energy summed (the paper), per triangle, or above equilateral triangles. Default: "mean". */
  removal_measure?: "sum" | "mean" | "excess";
  /** by which part the patch must be better; at least 0. Default: 0.1. */
  removal_margin?: number;
  /** of removal: "weight": how far below the mean of its neighbors', relative to their mean squared distance; more than 0. Default: 1. */
  hidden_threshold?: number;
  /** first sweep with removals, from 0; at least 0. Default: 10. */
  removal_from?: number;
  /** first sweep after which vertices are inserted at the orthocenters of triangles of large energy, where that makes the mesh better, from 0; at least 0; null: no insertions. Default: null. */
  insertion_from?: number | null;
  /** how many times the mean energy of a triangle is large; more than 1. Default: 4. */
  insertion_ratio?: number;
  /** what weights hide: undo the step, remove the vertex, or keep and report it. Default: "undo". */
  hidden?: "undo" | "remove" | "keep";
  /** steps that turn a triangle over are refused, or allowed as in the paper (with deferred flips); infinite: where a triangle is turned over a barrier is, so that searches step over such places, but not onto them. Default: "refuse". */
  inversion?: "refuse" | "allow" | "infinite";
  /** in which a sweep visits the vertices. Default: "hilbert". */
  order?: "hilbert" | "input" | "reverse" | "random";
  /** at most this many sweeps over the vertices; at least 0. Default: 1000. */
  max_sweeps?: number;
  /** stop when a sweep gains less than this; at least 0. Default: 0.00001. */
  tolerance?: number;
  /** the gain relative to the energy, or the paper's: mean energy per triangle, absolute. Default: "relative". */
  stopping?: "relative" | "paper";
  /** stop after this many seconds; 0: no limit; at least 0. Default: 0. */
  time_limit?: number;
  /** of the jitter that frees symmetric grids, of repairs, and of order: "random"; at least 0. Default: 1. */
  seed?: number;
}

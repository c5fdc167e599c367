// What page and worker tell each other: a mesh as arrays, a run of it, and why its triangles are bad.
import type { Explanation, OptimizeReport, Progress, TraceEvent } from 'temper-mesh';
import type { Given } from './options_form.ts';

/** A mesh as arrays, for its way between page and worker. */
export interface Arrays {
  points: Float64Array;
  weights: Float64Array;
  triangles: Int32Array;
  regions: Int32Array;
  constrained_edges: Int32Array;
  fixed: Int32Array;
}

export interface Start {
  kind: 'optimize';
  mesh: Arrays;
  given: Given;
  traced: boolean;
}

export interface Ask {
  kind: 'explain';
  mesh: Arrays;
  cures: number;
}

export type Told =
  | { kind: 'ready' }
  | { kind: 'progress'; progress: Progress; mesh: Arrays | null }
  | { kind: 'done'; mesh: Arrays; report: OptimizeReport; events: TraceEvent[] }
  | { kind: 'explaining'; done: number; all: number }
  | { kind: 'explained'; explanation: Explanation }
  | { kind: 'failed'; message: string };

// temper: primal-dual triangle meshes that solvers can trust. Names are as in Python.
import { Mesh } from './mesh.ts';
import { answer, answerBytes, answerText, call, type Files, fromJson, listening, module, takeWritten, toJson, withFiles } from './module.ts';
import type { EffortName, KeepName, OptimizeOptions, TargetName } from './options.ts';
import type { DecSummary, Explanation, OptimizeReport, Progress, Quality, TraceEvent } from './records.ts';
import type {
  DecComplex, DrawOptions, EnergyInfo, EnergyModel, Format, IncidenceMatrix, OptionRow, Preset, Restoration,
  Snapshot, LengthParameterLike, TensorLike, VertexDerivatives,
} from './types.ts';
import { loadSolver } from './solver.ts';

export { Mesh, type MeshParts, type Numbers } from './mesh.ts';
export { type Files, TemperError } from './module.ts';
export type { EffortName, KeepName, OptimizeOptions, TargetName } from './options.ts';
export type * from './records.ts';
export type * from './types.ts';

/** The answer of a function of the module without arguments. */
function told<T>(name: string): T {
  module()[name]();
  return answer<T>();
}

/** The version of the library. */
export function version(): string {
  module().version();
  return answerText();
}

// --- files ---------------------------------------------------------------------------------------------------------

/** The file formats that `read` and `write` know. */
export function formats(): Format[] {
  return told('formats');
}

export interface ReadOptions {
  /** Files by name, among them the path. Without files, Node reads the path from the disk. */
  files?: Files;
  /** Tags or physical names whose points must not move. */
  fixed_tags?: (string | number)[];
  /** The map for points in longitude and latitude: "stereographic", "mercator:lon", …; "none". */
  projection?: string;
}

/** Reads a mesh file. Its content determines the format, never its name. A file PATH.weights.csv next to it gives the
 * weights. `warnings` of the mesh lists all repairs. */
export function read(path: string, options: ReadOptions = {}): Mesh {
  const { files, fixed_tags = [], projection = '' } = options;
  return withFiles(path, files, (name) => {
    const mesh = Mesh.of(call('mesh_read', name, toJson({ fixed_tags: fixed_tags.map(String), projection })));
    Object.assign(mesh, answer<{ warnings: string[]; format: string }>());
    return mesh;
  });
}

export interface WriteOptions {
  /** Receives the written files by name. Without it, Node writes to the disk. */
  files?: Files;
  /** A name of `formats()`. By default, the suffix of the path selects the format. */
  format?: string;
  /** Encoding, for formats that have several. The default of VTU is base64, compressed. */
  encoding?: 'ascii' | 'base64' | 'appended';
  /** VTU gets cell data for colors in ParaView: well_centered, min_h_over_l, min_d_over_l, min_angle_deg. Default: true. */
  triangle_quality?: boolean;
}

/** Writes a mesh, with all other data of the file it came from. Returns warnings: weights that went to a file next to it,
 * and data that the format cannot hold. */
export function write(path: string, mesh: Mesh, options: WriteOptions = {}): string[] {
  const { files, format = '', encoding = '', triangle_quality = true } = options;
  return withFiles(path, files, (name) => {
    call('mesh_write', mesh.handle, name, toJson({ format, encoding, triangle_quality }));
    const result = answer<{ warnings: string[]; files: string[] }>();
    takeWritten(result.files, files);
    return result.warnings;
  });
}

// --- optimization ----------------------------------------------------------------------------------------------------

/** Listeners of a run. The result does not depend on them, unless a listener throws an error. */
export interface Hooks {
  /** Gets each move, flip and removal. `replay` makes the mesh again from them. */
  tracer?: (event: TraceEvent) => void;
  /** Gets the mesh after each sweep. */
  snapshots?: (snapshot: Snapshot) => void;
}

/** The arguments of `optimize`. */
export interface OptimizeArguments {
  /** Use of the mesh. Default: "any". */
  target?: TargetName;
  /** Time that the run may take for repairs and lower errors. Default: "normal". */
  effort?: EffortName;
  /** Parts of the mesh that stay. */
  keep?: KeepName | readonly KeepName[];
  /** Treatment of the boundary. By default it stays bit for bit. */
  boundary?: OptimizeOptions['boundary'];
  /** Diffusion tensors. Triangles become well-centered in the metric of theirs, and the report is in this metric. Where tensors
   * differ, vertices get a weight for each region: `mesh.corner_weights`. */
  tensor?: TensorLike;
  /** Time limit in seconds. The run then ends with the best mesh so far. */
  time_limit?: number;
  /** Gets the progress, at least once per sweep. If it returns false, the run stops with the best mesh so far. */
  progress?: (progress: Progress) => boolean | void;
  hooks?: Hooks;
  /** Further options. They override the options that `target`, `effort` and `keep` set. */
  options?: OptimizeOptions;
}

/** Makes the mesh well-centered, in place. To keep the original, optimize `mesh.copy()`. If a listener throws an error, the
 * run stops. The error is thrown again when the mesh has its best state. */
export function optimize(mesh: Mesh, { progress, hooks = {}, ...given }: OptimizeArguments = {}): OptimizeReport {
  const { tracer, snapshots } = hooks;
  const listener = {
    progress: (state: string): boolean => progress === undefined || progress(fromJson(state) as Progress) !== false,
    trace: tracer && ((event: string): void => tracer(fromJson(event) as TraceEvent)),
    snapshot: snapshots && ((handle: number, sweep: number): void => snapshots({ sweep, mesh: Mesh.of(call('mesh_copy', handle)) })),
  };
  return listening(listener, () => {
    call('mesh_optimize', mesh.handle, toJson(given), tracer ? 1 : 0, snapshots ? 1 : 0);
    return answer<OptimizeReport>();
  });
}

/** Returns the options for a target, an effort and parts of the mesh to keep. */
export function options_for(
  target: TargetName = 'any', effort: EffortName = 'normal', keep: KeepName | readonly KeepName[] = [],
): Required<OptimizeOptions> {
  call('options_for', toJson({ target, effort, keep }));
  return answer();
}

/** The words of `target`, `effort` and `keep`, with their meanings. */
export function presets(): Record<'target' | 'effort' | 'keep', Preset[]> {
  return told('presets');
}

/** Applies these events of a run to its input. With all events, the result is the same mesh, bit for bit. */
export function replay(input: Mesh, events: readonly TraceEvent[]): Mesh {
  return Mesh.of(call('mesh_replay', input.handle, toJson(events)));
}

/** The options, from the table in the library. */
export function option_table(): OptionRow[] {
  return told('option_table');
}

/** Flips edges until all edges are regular that can be regular. */
export function restore_regularity(mesh: Mesh): Restoration {
  call('mesh_restore_regularity', mesh.handle);
  return answer();
}

// --- measures ----------------------------------------------------------------------------------------------------------

/** Measures a mesh: validity, regularity, well-centered triangles and margins. With a tensor, it measures in its metric. */
export function quality(
  mesh: Mesh, options: { gamma?: LengthParameterLike; h0?: LengthParameterLike; worst?: number; tensor?: TensorLike } = {},
): Quality {
  call('mesh_quality', mesh.handle, toJson(options));
  return answer();
}

/** The margin of each triangle: the least of its h/ℓ, d/ℓ and 1 − d/ℓ. It is above 0 if the triangle is well-centered. */
export function triangle_margins(mesh: Mesh): Float64Array {
  call('mesh_triangle_margins', mesh.handle);
  return new Float64Array(answerBytes().buffer);
}
/** 1 for each well-centered triangle, else 0. Decided exactly. */
export function well_centered_triangles(mesh: Mesh): Uint8Array {
  call('mesh_well_centered_triangles', mesh.handle);
  return answerBytes();
}

export interface ExplainOptions {
  /** Number of reasons for which cures are searched, the worst first. Default: 20. */
  cures?: number;
  /** Weights of the whole mesh are searched if it has at most this many triangles, or bad triangles. Default: 1000. */
  whole?: number;
  /** Gets the number of explained bad triangles now and then. If it returns false, `explain` stops with a TemperError. */
  progress?: (done: number, all: number) => boolean | void;
}

/** Explains each triangle that is not well-centered, by exactly one reason with its cures. Unlike in Python, the result is a
 * promise: the first call loads HiGHS, a solver for linear programs. The mesh is read after that. */
export async function explain(mesh: Mesh, { progress, ...given }: ExplainOptions = {}): Promise<Explanation> {
  await loadSolver();
  const explained = progress && ((done: number, all: number): boolean => progress(done, all) !== false);
  return listening({ explained }, () => {
    call('mesh_explain', mesh.handle, toJson(given));
    return answer<Explanation>();
  });
}

/** All energies. */
export function energies(): EnergyInfo[] {
  return told('energies');
}
/** The energy of a mesh. It is Infinity if a term is outside its domain. */
export function total_energy(mesh: Mesh, model: EnergyModel = {}): number {
  call('mesh_total_energy', mesh.handle, toJson(model));
  return answer();
}
/** The part of the total energy that depends on a vertex, with its derivatives. */
export function vertex_energy(mesh: Mesh, model: EnergyModel, vertex: number): VertexDerivatives {
  call('mesh_vertex_energy', mesh.handle, toJson(model), vertex);
  return answer();
}

/** The operators of discrete exterior calculus. With a tensor K, ★1 and transmissibilities are those of −div(K ∇u). */
export function dec_operators(mesh: Mesh, options: { tensor?: TensorLike } = {}): DecComplex {
  const complex = call('dec_make', mesh.handle, toJson(options));
  const bytes = (name: string): ArrayBuffer => {
    call('dec_array', complex, name);
    return answerBytes().buffer;
  };
  const reals = (name: string): Float64Array => new Float64Array(bytes(name));
  const whole = (name: string): Int32Array => new Int32Array(bytes(name));
  const matrix = (name: string): IncidenceMatrix => ({
    starts: whole(`${name}.starts`),
    columns: whole(`${name}.columns`),
    signs: new Int8Array(bytes(`${name}.signs`)),
  });
  try {
    call('dec_summary', mesh.handle, complex);
    const summary = answer<DecSummary>();
    return {
      edges: {
        vertices: whole('edges.vertices'),
        triangles: whole('edges.triangles'),
        length: reals('edges.length'),
        crossing: reals('edges.crossing'),
        left_height: reals('edges.left_height'),
        right_height: reals('edges.right_height'),
        dual_length: reals('edges.dual_length'),
        midpoint: reals('edges.midpoint'),
      },
      edge_of_halfedge: whole('edge_of_halfedge'),
      d0: matrix('d0'),
      d1: matrix('d1'),
      star0: reals('star0'),
      star1: reals('star1'),
      star2: reals('star2'),
      transmissibility: reals('transmissibility'),
      half_transmissibility: reals('half_transmissibility'),
      orthocenters: reals('orthocenters'),
      areas: reals('areas'),
      summary,
    };
  } finally {
    module().dec_release(complex);
  }
}

/** An SVG picture: primal and dual, weights as circles, bad triangles filled. */
export function draw_svg(mesh: Mesh, options: DrawOptions = {}): string {
  call('mesh_draw_svg', mesh.handle, 0, toJson(options));
  return answerText();
}
/** Two panels side by side, to one scale. */
export function draw_before_after_svg(before: Mesh, after: Mesh, options: DrawOptions = {}): string {
  call('mesh_draw_svg', before.handle, after.handle, toJson(options));
  return answerText();
}

export interface HtmlOptions {
  /** A mesh to compare with. */
  before?: Mesh;
  /** Report of the run that made the mesh. The page then has its history and notes. */
  report?: OptimizeReport;
  /** Explanation of the mesh. The page then has reasons and cures at the triangles. */
  explanation?: Explanation;
  title?: string;
}

/** The page that the program writes with `--write FILE.html`. It needs no network. */
export function html_report(mesh: Mesh, { before, report, explanation, title = 'temper.Mesh' }: HtmlOptions = {}): string {
  // Without times, the same run makes the same page.
  const run = report && {
    sweeps: report.sweeps,
    stopped: report.stopped,
    notes: report.notes,
    history: report.history.map((record) => ({ ...record, seconds: undefined })),
  };
  const shown = {
    verb: report ? 'optimize' : 'check',
    version: version(),
    ...(before && { before: quality(before) }),
    after: quality(mesh),
    ...run,
    reasons: explanation?.reasons.map((r) => ({ kind: r.kind, triangles: r.triangles, text: r.text, cures: r.cures.map((cure) => cure.text) })) ?? [],
  };
  // Infinity and NaN become null for the page.
  call('mesh_html_report', mesh.handle, before?.handle ?? 0, title, JSON.stringify(shown));
  return answerText();
}

// --- examples ----------------------------------------------------------------------------------------------------------

/** `first`: a parameter, to say how one is given. */
function make(name: string, parameters: object = {}, first = ''): Mesh {
  if (typeof parameters !== 'object' || parameters === null || Array.isArray(parameters)) {
    const found = JSON.stringify(parameters);
    throw new TypeError(`generate.${name}: expected named parameters, such as ${name}({ ${first}: ${found} }), found ${found}`);
  }
  return Mesh.of(call('mesh_generate', name, toJson(parameters)));
}

/** Example meshes of the paper, and others on which methods can be tried. */
export const generate = {
  /** The paper's sparse horseshoe: 5 vertices, 4 triangles. */
  sparse_horseshoe: (): Mesh => make('sparse_horseshoe'),
  /** The paper's parameterized horseshoe: a × b points, x and y are the semi-axes of the inner and the outer arch. */
  horseshoe: (p: { a?: number; b?: number; x?: [number, number]; y?: [number, number] } = {}): Mesh => make('horseshoe', p, 'a'),
  /** Sides of length a and b from vertex 0, with an angle between them. */
  single_triangle: (p: { a?: number; b?: number; angle_deg?: number } = {}): Mesh => make('single_triangle', p, 'a'),
  /** Random points in a polygon, counter-clockwise (default: an L with a notch). */
  random_mesh: (p: { vertices?: number; seed?: number; polygon?: [number, number][] } = {}): Mesh => make('random_mesh', p, 'vertices'),
  /** nx × ny squares, each cut along the same diagonal, then sheared. */
  sheared_grid: (p: { nx?: number; ny?: number; shear?: number } = {}): Mesh => make('sheared_grid', p, 'nx'),
  /** Rings of points between two circles, the middle rings jittered. */
  annulus: (p: { inner?: number; outer?: number; around?: number; rings?: number; jitter?: number; seed?: number } = {}): Mesh =>
    make('annulus', p, 'inner'),
  /** A box with an airfoil-like hole, graded from fine at the foil. */
  airfoil: (p: { around?: number; growth?: number; seed?: number } = {}): Mesh => make('airfoil', p, 'around'),
  /** A regular polygon with no vertex inside: hard. */
  regular_polygon: (p: { corners?: number } = {}): Mesh => make('regular_polygon', p, 'corners'),
  /** A letter A with no vertex inside: hard. */
  letter_a: (): Mesh => make('letter_a'),
  /** A triangle with a sharp corner. */
  wedge: (p: { angle_deg?: number; pieces?: number; seed?: number } = {}): Mesh => make('wedge', p, 'angle_deg'),
  /** Random points in the unit square, finer towards a corner. */
  graded_mesh: (p: { finest?: number; growth?: number; seed?: number } = {}): Mesh => make('graded_mesh', p, 'finest'),
};

// The weighted triangle mesh. It is in the memory of the module; arrays are copies.
import { answer, answerBytes, call, module } from './module.ts';

/** Numbers in a flat array, or in rows: [[0, 0], [1, 0]]. */
export type Numbers = ArrayLike<number> | readonly (readonly number[])[];

function flat(values: Numbers | undefined | null, columns: number, name: string): number[] | ArrayLike<number> {
  if (values === undefined || values === null) return [];
  const first = values[0];
  if (Array.isArray(first)) {
    const rows = values as readonly (readonly number[])[];
    const bad = rows.findIndex((row) => row.length !== columns);
    if (bad >= 0) throw new TypeError(`${name}: expected rows of ${columns} numbers, found ${rows[bad].length} in row ${bad}`);
    return rows.flat();
  }
  const list = values as ArrayLike<number>;
  if (list.length % columns !== 0) throw new TypeError(`${name}: expected rows of ${columns} numbers, found ${list.length} in all`);
  return list;
}
const doubles = (values: Numbers | undefined | null, columns: number, name: string): Float64Array => {
  const list = flat(values, columns, name);
  return list instanceof Float64Array ? list : Float64Array.from(list);
};
const ints = (values: Numbers | undefined | null, columns: number, name: string): Int32Array => {
  const list = flat(values, columns, name);
  if (list instanceof Int32Array) return list;
  const whole = Int32Array.from(list);
  for (let i = 0; i < whole.length; i++) {
    if (whole[i] !== list[i]) throw new TypeError(`${name}: expected whole numbers of 32 bits, found ${list[i]}`);
  }
  return whole;
};

// A mesh without references gives back its memory; free() does this at once.
const freed = new FinalizationRegistry((handle: number) => module().mesh_release(handle));

export interface MeshParts {
  /** Edges that stay, as pairs of vertices. */
  constrained_edges?: Numbers;
  /** A number for each triangle. */
  regions?: Numbers;
  /** Vertices that do not move. */
  fixed?: Numbers;
}

/** A triangle mesh whose vertices carry weights: the power of a place p to vertex i is |x_i − p|² − w_i. Triangles are
 * counter-clockwise; halfedge 3 t + k runs from corner k to corner k + 1 of triangle t. */
export class Mesh {
  /** Triangles that were clockwise in the input. */
  reversed_triangles = 0;
  /** Parts of the file that were repaired or dropped, in sentences. */
  warnings: string[] = [];
  /** Format of its file. */
  format: string | null = null;
  /** @internal */
  #handle: number;

  /** `points`: x, y of each vertex. `triangles`: three corners each, counted from 0. `weights`: squared lengths, all 0 by
   * default. If the arrays make no planar mesh, it throws a TemperError that names the element. */
  constructor(points: Numbers, triangles: Numbers, weights?: Numbers | null, parts: MeshParts = {}) {
    if (points === kOfHandle) {
      this.#handle = triangles as unknown as number;
    } else {
      const p = doubles(points, 2, 'points'), t = ints(triangles, 3, 'triangles'), w = doubles(weights, 1, 'weights');
      const constrained = ints(parts.constrained_edges, 2, 'constrained_edges');
      const regions = ints(parts.regions, 1, 'regions'), fixed = ints(parts.fixed, 1, 'fixed');
      this.#handle = call(
        'mesh_build', p, p.length / 2, t, t.length / 3, w, w.length, constrained, constrained.length / 2,
        regions, regions.length, fixed, fixed.length,
      );
      this.reversed_triangles = answer<{ reversed_triangles: number }>().reversed_triangles;
    }
    freed.register(this, this.#handle, this);
  }

  /** @internal A mesh of the module. */
  static of(handle: number): Mesh {
    return new Mesh(kOfHandle, handle as unknown as Numbers);
  }
  /** @internal Its address there. */
  get handle(): number {
    if (this.#handle === 0) throw new TypeError('the mesh was freed');
    return this.#handle;
  }

  /** Gives back the memory. After that, the mesh cannot be used. */
  free(): void {
    if (this.#handle === 0) return;
    freed.unregister(this);
    module().mesh_release(this.#handle);
    this.#handle = 0;
  }

  get n_vertices(): number {
    return module().mesh_n_vertices(this.handle);
  }
  get n_triangles(): number {
    return module().mesh_n_triangles(this.handle);
  }
  get n_halfedges(): number {
    return 3 * this.n_triangles;
  }
  get n_edges(): number {
    return module().mesh_n_edges(this.handle);
  }

  /** x, y of each vertex. Assigning moves all vertices at once. If a triangle would not be counter-clockwise, it throws a
   * TemperError and changes nothing. */
  get points(): Float64Array {
    return this.columns(0, 2);
  }
  set points(points: Numbers) {
    call('mesh_set_points', this.handle, this.sized(doubles(points, 2, 'points'), 2, 'points'));
  }

  /** Weight of each vertex [length²]. Assigning sets all at once; the edges stay (see restore_regularity). */
  get weights(): Float64Array {
    return this.columns(2, 1);
  }
  set weights(weights: Numbers) {
    call('mesh_set_weights', this.handle, this.sized(doubles(weights, 1, 'weights'), 1, 'weights'));
  }

  /** Weight of each corner of each triangle, three each, where tensors of regions differ (see optimize). Else empty. */
  get corner_weights(): Float64Array {
    call('mesh_corner_weights', this.handle);
    return new Float64Array(answerBytes().buffer);
  }

  /** x, y, w of a vertex. */
  point(vertex: number): [number, number, number] {
    if (!(vertex >= 0 && vertex < this.n_vertices)) throw new RangeError(`there is no vertex ${vertex}`);
    const at = module().mesh_vertex_data(this.handle) / 8 + 4 * vertex;
    const memory = new Float64Array(module().memory.buffer);
    return [memory[at], memory[at + 1], memory[at + 2]];
  }
  /** Moves a vertex. If a triangle would not be counter-clockwise, it throws a TemperError and changes nothing. */
  set_point(vertex: number, x: number, y: number, w: number): void {
    call('mesh_set_point', this.handle, vertex, x, y, w);
  }

  /** Three corners of each triangle. */
  get triangles(): Int32Array {
    return this.ints(module().mesh_corner_data(this.handle), this.n_halfedges);
  }
  /** Halfedge on the other side of each halfedge; −1 on the boundary. */
  get twins(): Int32Array {
    return this.ints(module().mesh_twin_data(this.handle), this.n_halfedges);
  }
  get regions(): Int32Array {
    return this.array('mesh_regions');
  }
  /** All edges, as two vertices each. */
  get edges(): Int32Array {
    return this.array('mesh_edges');
  }
  /** Edges of one triangle, with the domain on their left. */
  get boundary_edges(): Int32Array {
    return this.array('mesh_boundary_edges');
  }
  /** Edges that are never flipped: your lines, and interfaces of regions. */
  get constrained_edges(): Int32Array {
    return this.array('mesh_constrained_edges');
  }
  /** Vertices that never move. Assigning replaces them. */
  get fixed(): Int32Array {
    return this.array('mesh_fixed');
  }
  set fixed(vertices: Numbers) {
    const list = ints(vertices, 1, 'fixed');
    call('mesh_set_fixed', this.handle, list, list.length);
  }

  /** Takes the state of another mesh that was made from this one, for example in a worker. The other data of the file stay.
   * `vertices`: former number of each vertex, −1 for inserted ones (`OptimizeReport.vertices`). Empty: the same numbers. */
  replace(other: Mesh, vertices: Numbers = []): void {
    const former = ints(vertices, 1, 'vertices');
    call('mesh_replace', this.handle, other.handle, former, former.length);
  }

  /** The first broken invariant of the mesh, or null. */
  validate(): string | null {
    call('mesh_validate', this.handle);
    return answer<string | null>();
  }
  copy(): Mesh {
    const mesh = Mesh.of(call('mesh_copy', this.handle));
    mesh.reversed_triangles = this.reversed_triangles;
    mesh.warnings = [...this.warnings];
    mesh.format = this.format;
    return mesh;
  }
  /** Compares all numbers, bit for bit. */
  equals(other: Mesh): boolean {
    return module().mesh_equal(this.handle, other.handle) === 1;
  }

  private columns(first: number, n: number): Float64Array {
    const rows = this.n_vertices, result = new Float64Array(n * rows);
    const at = module().mesh_vertex_data(this.handle) / 8;
    const memory = new Float64Array(module().memory.buffer);
    for (let v = 0; v < rows; v++) {
      for (let k = 0; k < n; k++) result[n * v + k] = memory[at + 4 * v + first + k];
    }
    return result;
  }
  private ints(at: number, n: number): Int32Array {
    return new Int32Array(module().memory.buffer.slice(at, at + 4 * n));
  }
  private array(name: string): Int32Array {
    call(name, this.handle);
    return new Int32Array(answerBytes().buffer);
  }
  private sized(values: Float64Array, columns: number, name: string): Float64Array {
    if (values.length === columns * this.n_vertices) return values;
    throw new TypeError(`${name}: expected ${this.n_vertices}, found ${values.length / columns}`);
  }
}

// The constructor's way in for meshes that the module has made: no array is this one.
const kOfHandle: Numbers = [];

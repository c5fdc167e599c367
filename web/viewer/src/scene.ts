// One mesh on the graphics card, and the drawing of its layers. Triangles and edges are in the order of a curve, cut
// into chunks with boxes, so that a close view draws what it shows alone.
import * as twgl from 'twgl.js';
import { hasNegativeDual, orthocenter, weightedMidpoint, weightOf } from './geometry.ts';
import { badTriangles } from './measures.ts';
import { boundsOf, type Box, curveOrder, findTwins, type MeshData, next, nTriangles, nVertices } from './mesh.ts';
import * as shaders from './shaders.ts';
import { rgb, type Theme } from './colors.ts';

export interface Layers {
  primal: boolean;
  dual: boolean;
  weights: boolean;
  orthocenters: boolean;
  bad: boolean;
}

/** What a frame looks like: the center of the view in the mesh's coordinates, and pixels of the screen a unit. */
export interface View {
  x: number;
  y: number;
  scale: number;
  /** In pixels of the canvas. */
  width: number;
  height: number;
  /** Of the canvas for one of the page. */
  ratio: number;
}

/** How places are kept: relative to the middle of the mesh, in its half sizes. All scenes of a viewer share one. */
export interface Frame {
  x: number;
  y: number;
  size: number;
}

export const frameOf = (box: Box): Frame => ({
  x: (box.x0 + box.x1) / 2,
  y: (box.y0 + box.y1) / 2,
  size: Math.max(box.x1 - box.x0, box.y1 - box.y0) / 2 || 1,
});

type Gl = WebGL2RenderingContext;

export interface Programs {
  fill: twgl.ProgramInfo;
  bad: twgl.ProgramInfo;
  mark: twgl.ProgramInfo;
  line: twgl.ProgramInfo;
  circle: twgl.ProgramInfo;
  dot: twgl.ProgramInfo;
}

export function makePrograms(gl: Gl): Programs {
  const program = (vertex: string, fragment: string): twgl.ProgramInfo => {
    const made = twgl.createProgramInfo(gl, [vertex, fragment]);
    if (!made) throw new Error('the shaders of the viewer do not compile');
    return made;
  };
  return {
    fill: program(shaders.fillVertex, shaders.fillFragment),
    bad: program(shaders.badVertex, shaders.badFragment),
    mark: program(shaders.markVertex, shaders.badFragment),
    line: program(shaders.lineVertex, shaders.lineFragment),
    circle: program(shaders.circleVertex, shaders.circleFragment),
    dot: program(shaders.dotVertex, shaders.dotFragment),
  };
}

const kChunk = 2048; // triangles: few enough calls for the largest meshes, and little drawn beside the view
const kFlag = 0x80000000;
// Edges shorter than this many pixels, in the mean, would cover all: they fade out, and are not drawn at last.
const kShortest = 2.5, kLong = 7;

/** A texture with one texel an element, in rows of shaders.kWidth. */
class Table {
  readonly texture: WebGLTexture;
  private rows = 0;

  constructor(
    private readonly gl: Gl,
    private readonly internalFormat: number,
    private readonly format: number,
    private readonly type: number,
    private readonly components: number,
  ) {
    const sampling = { minMag: gl.NEAREST, wrap: gl.CLAMP_TO_EDGE, auto: false };
    this.texture = twgl.createTexture(gl, { ...sampling, width: 1, height: 1, internalFormat, format, type });
  }

  /** Elements that fill whole rows: see padded(). */
  set(data: ArrayBufferView): void {
    const { gl } = this;
    const length = (data as Float32Array).length / this.components;
    const rows = length / shaders.kWidth;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    if (rows === this.rows) {
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, shaders.kWidth, rows, this.format, this.type, data);
    } else {
      gl.texImage2D(gl.TEXTURE_2D, 0, this.internalFormat, shaders.kWidth, rows, 0, this.format, this.type, data);
      this.rows = rows;
    }
  }

  delete(): void {
    this.gl.deleteTexture(this.texture);
  }
}

/** The number of elements that fill whole rows of a table. */
const padded = (n: number): number => Math.max(1, Math.ceil(n / shaders.kWidth)) * shaders.kWidth;

/** Runs of elements that a view may show. */
interface Chunks {
  starts: Uint32Array;
  boxes: Float64Array;
}

export class Scene {
  readonly twins: Int32Array;
  readonly bad: Uint32Array;
  /** Of the edges, in the mesh's units. */
  meanEdge = 0;
  private readonly order: Uint32Array;
  private edgeHalves = new Uint32Array(0); // a halfedge of each edge, in drawing order
  private readonly triangleChunks: Chunks;
  private edgeChunks: Chunks = { starts: new Uint32Array(1), boxes: new Float64Array(0) };
  private readonly tables: Record<'places' | 'duals' | 'corners' | 'edges' | 'bad' | 'radii' | 'rows' | 'table', Table>;
  private readonly places: Float32Array;
  private readonly duals: Float32Array;
  private readonly radii: Float32Array;
  private colored = false;
  private hasWeights = false;

  constructor(
    private readonly gl: Gl,
    private readonly programs: Programs,
    readonly mesh: MeshData,
    private readonly frame: Frame,
  ) {
    const n = nTriangles(mesh);
    this.twins = mesh.twins ?? findTwins(mesh.triangles, nVertices(mesh));
    this.order = curveOrder(mesh, boundsOf(mesh.points));
    this.bad = badTriangles(mesh);
    const float4 = (): Table => new Table(gl, gl.RGBA32F, gl.RGBA, gl.FLOAT, 4);
    const uint = (): Table => new Table(gl, gl.R32UI, gl.RED_INTEGER, gl.UNSIGNED_INT, 1);
    this.tables = {
      places: float4(),
      duals: float4(),
      corners: uint(),
      edges: new Table(gl, gl.RGBA32UI, gl.RGBA_INTEGER, gl.UNSIGNED_INT, 4),
      bad: uint(),
      radii: new Table(gl, gl.R32F, gl.RED, gl.FLOAT, 1),
      rows: new Table(gl, gl.R8UI, gl.RED_INTEGER, gl.UNSIGNED_BYTE, 1),
      table: new Table(gl, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, 4),
    };
    this.triangleChunks = cut(n);
    this.places = new Float32Array(4 * padded(nVertices(mesh)));
    this.radii = new Float32Array(padded(nVertices(mesh)));
    this.setConnectivity();
    this.duals = new Float32Array(4 * padded(n + this.countBoundary()));
    this.setGeometry();
  }

  /** Takes the positions and weights of the mesh as they are now. O(n). */
  setGeometry(): void {
    this.placeVertices();
    this.placeDuals();
    this.bound(this.triangleChunks, (i) => 3 * this.order[i], 3);
    this.bound(this.edgeChunks, (i) => this.edgeHalves[i], 1);
  }

  /** Colors by rows of a table of colors; null: plain. */
  setColors(rows: Uint8Array | null, table: Uint8Array): void {
    this.colored = rows !== null;
    if (rows === null) return;
    const ordered = new Uint8Array(padded(rows.length));
    for (let i = 0; i < rows.length; i++) ordered[i] = rows[this.order[i]];
    this.tables.rows.set(ordered);
    const row = new Uint8Array(4 * shaders.kWidth);
    row.set(table);
    this.tables.table.set(row);
  }

  draw(view: View, layers: Layers, theme: Theme): void {
    const { gl } = this;
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const uniforms = this.uniformsOf(view);
    const visible = Math.max(0, Math.min(1, ((this.meanEdge * view.scale) / view.ratio - kShortest) / (kLong - kShortest)));
    this.drawFill(view, uniforms, theme);
    if (layers.bad) this.drawBad(uniforms, theme, view);
    this.drawLines(view, uniforms, layers, theme, visible);
    if (layers.weights && this.hasWeights) this.drawWeights(uniforms, theme, 0.35 + 0.65 * visible);
    if (layers.orthocenters && visible > 0) this.drawOrthocenters(uniforms, theme, view, visible);
  }

  delete(): void {
    for (const table of Object.values(this.tables)) table.delete();
  }

  private setConnectivity(): void {
    const { mesh, twins, order } = this;
    const n = nTriangles(mesh);
    const corners = new Uint32Array(padded(3 * n));
    const placeOf = new Uint32Array(n);
    const halves: number[] = [];
    for (let i = 0; i < n; i++) {
      placeOf[order[i]] = i;
      for (let k = 0; k < 3; k++) {
        const h = 3 * order[i] + k;
        corners[3 * i + k] = mesh.triangles[h];
        const inside = twins[h] >= 0 && mesh.cells !== undefined && mesh.cells[order[i]] === mesh.cells[Math.floor(twins[h] / 3)];
        if (!inside && (twins[h] < 0 || h < twins[h])) halves.push(h);
      }
    }
    this.tables.corners.set(corners);
    this.edgeHalves = Uint32Array.from(halves);
    this.edgeChunks = cut(halves.length);
    const bad = new Uint32Array(padded(this.bad.length));
    for (let i = 0; i < this.bad.length; i++) bad[i] = placeOf[this.bad[i]];
    this.tables.bad.set(bad);
  }

  private countBoundary(): number {
    let n = 0;
    for (const twin of this.twins) n += twin < 0 ? 1 : 0;
    return n;
  }

  /** Where a point is in the frame, and what single precision leaves of that. */
  private place(into: Float32Array, i: number, x: number, y: number): void {
    const u = (x - this.frame.x) / this.frame.size, v = (y - this.frame.y) / this.frame.size;
    into[4 * i] = u;
    into[4 * i + 1] = v;
    into[4 * i + 2] = u - into[4 * i];
    into[4 * i + 3] = v - into[4 * i + 1];
  }

  private placeVertices(): void {
    const { mesh } = this;
    this.hasWeights = false;
    for (let v = 0; v < nVertices(mesh); v++) {
      this.place(this.places, v, mesh.points[2 * v], mesh.points[2 * v + 1]);
      const w = weightOf(mesh, v);
      this.radii[v] = (Math.sign(w) * Math.sqrt(Math.abs(w))) / this.frame.size;
      this.hasWeights ||= w !== 0;
    }
    this.tables.places.set(this.places);
    this.tables.radii.set(this.radii);
  }

  private placeDuals(): void {
    const { mesh, twins } = this;
    const n = nTriangles(mesh);
    for (let t = 0; t < n; t++) {
      const o = orthocenter(mesh, t);
      this.place(this.duals, t, o.x, o.y);
    }
    const edges = new Uint32Array(4 * padded(this.edgeHalves.length));
    let ends = n, total = 0;
    for (let i = 0; i < this.edgeHalves.length; i++) {
      const h = this.edgeHalves[i];
      const a = mesh.triangles[h], b = mesh.triangles[next(h)];
      total += Math.hypot(mesh.points[2 * b] - mesh.points[2 * a], mesh.points[2 * b + 1] - mesh.points[2 * a + 1]);
      let other = ends, negative = false;
      if (twins[h] < 0) {
        const middle = weightedMidpoint(mesh, a, b);
        this.place(this.duals, ends++, middle.x, middle.y);
      } else {
        other = Math.floor(twins[h] / 3);
        negative = hasNegativeDual(mesh, h, twins[h]);
      }
      edges[4 * i] = a + (twins[h] < 0 ? kFlag : 0);
      edges[4 * i + 1] = b + (mesh.constrained?.[h] ? kFlag : 0);
      edges[4 * i + 2] = Math.floor(h / 3) + (negative ? kFlag : 0);
      edges[4 * i + 3] = other;
    }
    this.meanEdge = total / Math.max(1, this.edgeHalves.length);
    this.tables.duals.set(this.duals);
    this.tables.edges.set(edges);
  }

  /** Boxes of chunks, around the ends of `count` halfedges from that of each element. */
  private bound(chunks: Chunks, halfedge: (i: number) => number, count: number): void {
    const { points, triangles } = this.mesh;
    for (let c = 0; c + 1 < chunks.starts.length; c++) {
      let x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
      const extend = (v: number): void => {
        const x = points[2 * v], y = points[2 * v + 1];
        if (x < x0) x0 = x;
        if (x > x1) x1 = x;
        if (y < y0) y0 = y;
        if (y > y1) y1 = y;
      };
      for (let i = chunks.starts[c]; i < chunks.starts[c + 1]; i++) {
        const h = halfedge(i);
        for (let k = 0; k < count; k++) extend(triangles[h + k]);
        if (count === 1) extend(triangles[next(h)]);
      }
      chunks.boxes.set([x0, y0, x1, y1], 4 * c);
    }
  }

  private uniformsOf(view: View): Record<string, unknown> {
    const x = (view.x - this.frame.x) / this.frame.size, y = (view.y - this.frame.y) / this.frame.size;
    const fx = Math.fround(x), fy = Math.fround(y);
    const scale = 2 * view.scale * this.frame.size;
    return {
      places: this.tables.places.texture,
      duals: this.tables.duals.texture,
      corners: this.tables.corners.texture,
      center: [fx, fy, x - fx, y - fy],
      scale: [scale / view.width, scale / view.height],
      pixel: [2 / view.width, 2 / view.height],
    };
  }

  private use(program: twgl.ProgramInfo, ...uniforms: Record<string, unknown>[]): void {
    this.gl.useProgram(program.program);
    for (const each of uniforms) twgl.setUniforms(program, each);
  }

  /** Draws elements of so many vertices, those of chunks that the view meets, margin pixels around it included. */
  private drawChunks(chunks: Chunks, vertices: number, view: View, margin: number): void {
    const { gl } = this;
    const dx = (view.width / 2 + margin) / view.scale, dy = (view.height / 2 + margin) / view.scale;
    const meets = (c: number): boolean =>
      chunks.boxes[4 * c] <= view.x + dx && chunks.boxes[4 * c + 2] >= view.x - dx &&
      chunks.boxes[4 * c + 1] <= view.y + dy && chunks.boxes[4 * c + 3] >= view.y - dy;
    const n = chunks.starts.length - 1;
    for (let c = 0; c < n; ) {
      if (!meets(c)) {
        c++;
        continue;
      }
      const begin = c;
      while (c < n && meets(c)) c++;
      const first = chunks.starts[begin];
      gl.drawArrays(gl.TRIANGLES, vertices * first, vertices * (chunks.starts[c] - first));
    }
  }

  private drawFill(view: View, uniforms: Record<string, unknown>, theme: Theme): void {
    const plain = this.colored ? [0, 0, 0, 0] : [...rgb(theme.fill), 1];
    this.use(this.programs.fill, uniforms, {
      rows: this.tables.rows.texture,
      table: this.tables.table.texture,
      plain,
    });
    this.drawChunks(this.triangleChunks, 3, view, 0);
  }

  private drawBad(uniforms: Record<string, unknown>, theme: Theme, view: View): void {
    const { gl, programs } = this;
    if (this.bad.length === 0) return;
    const own = { bad: this.tables.bad.texture, ink: [...rgb(theme.bad), 1], ratio: view.ratio, radius: 2 * view.ratio };
    this.use(programs.bad, uniforms, own);
    gl.drawArrays(gl.TRIANGLES, 0, 3 * this.bad.length);
    this.use(programs.mark, uniforms, own);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * this.bad.length);
  }

  private drawLines(view: View, uniforms: Record<string, unknown>, layers: Layers, theme: Theme, visible: number): void {
    const ratio = view.ratio;
    const draw = (dual: boolean, width: number, inks: string[], alphas: number[]): void => {
      this.use(this.programs.line, uniforms, {
        edges: this.tables.edges.texture,
        dual: dual ? 1 : 0,
        width: width * ratio,
        wide: 1.8 * ratio,
        inks: inks.flatMap((ink, i) => [...rgb(ink), alphas[i]]),
      });
      this.drawChunks(this.edgeChunks, 6, view, 4 * ratio + (dual ? this.meanEdge * view.scale * 4 : 0));
    };
    if (visible === 0) return;
    if (layers.primal) {
      const alphas = [0.75 * visible, 0.4 + 0.6 * visible, 0.4 + 0.6 * visible, 1];
      draw(false, 1, [theme.primal, theme.boundary, theme.constrained, theme.primal], alphas);
    }
    if (layers.dual) {
      const alphas = [0.9 * visible, visible, visible, visible];
      draw(true, 1.2, [theme.dual, theme.dual, theme.dual, theme.bad], alphas);
    }
  }

  private drawWeights(uniforms: Record<string, unknown>, theme: Theme, visible: number): void {
    this.use(this.programs.circle, uniforms, {
      radii: this.tables.radii.texture,
      positive: [...rgb(theme.positiveWeight), visible],
      negative: [...rgb(theme.negativeWeight), visible],
    });
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 6 * nVertices(this.mesh));
  }

  private drawOrthocenters(uniforms: Record<string, unknown>, theme: Theme, view: View, visible: number): void {
    this.use(this.programs.dot, uniforms, { ink: [...rgb(theme.orthocenter), visible], radius: 2.2 * view.ratio });
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 6 * nTriangles(this.mesh));
  }
}

/** n elements in chunks. */
function cut(n: number): Chunks {
  const count = Math.ceil(n / kChunk);
  const starts = Uint32Array.from({ length: count + 1 }, (_, i) => Math.min(n, i * kChunk));
  return { starts, boxes: new Float64Array(4 * count) };
}


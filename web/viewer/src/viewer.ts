// The viewer: a canvas that draws one mesh, or two with a divider between them, and says what was picked.
//
//   const viewer = new Viewer(document.querySelector('#mesh'), { onPick: (pick) => show(pick) });
//   viewer.setMesh({ points, weights, triangles });   // or setMesh(after, before)
//   viewer.setLayers({ dual: true, weights: true });
//   viewer.colorBy('margin');                         // viewer.scale is the legend's
//   viewer.zoomToTriangle(12);
//
// A mesh that changes: write into its points and weights and call geometryChanged() as often as you like, it is drawn
// once a frame; for another connectivity call setMesh again with { keepView: true }. Vertices are dragged when a
// VertexTool says which.
import { select, type Selection } from 'd3-selection';
import { zoom, type D3ZoomEvent, type ZoomBehavior, zoomIdentity, type ZoomTransform } from 'd3-zoom';
import * as twgl from 'twgl.js';
import { colorTable, type ColorScale, lightTheme, rgb, scaleOf, tableRows, type Theme } from './colors.ts';
import { Locator } from './locate.ts';
import { findMeasure, type Measure, valuesOf } from './measures.ts';
import { boundsOf, type Box, boxOfTriangle, type MeshData } from './mesh.ts';
import { Overlay } from './overlay.ts';
import { type Frame, frameOf, type Layers, makePrograms, type Programs, Scene, type View } from './scene.ts';

/** Which of two meshes: the one before is on the left of the divider. */
export type Side = 'before' | 'after';

export interface Pick {
  side: Side;
  triangle: number;
  /** The vertex under the pointer, or −1. */
  vertex: number;
  /** In the mesh's coordinates. */
  x: number;
  y: number;
}

/** What the owner of the mesh does when vertices are dragged. The viewer changes nothing by itself. */
export interface VertexTool {
  /** Whether a drag that begins at this vertex moves it; else it moves the view. */
  canDrag(vertex: number): boolean;
  drag(vertex: number, x: number, y: number, phase: 'start' | 'move' | 'end'): void;
  /** The wheel over a vertex; true: used, the view does not zoom. `steps` is positive away from the user. */
  wheel?(vertex: number, steps: number, event: WheelEvent): boolean;
}

export interface ViewerOptions {
  theme?: Theme;
  layers?: Partial<Layers>;
  /** A triangle was picked by click, tap or Enter; null: a place without one. */
  onPick?(pick: Pick | null): void;
  /** The pointer is over another triangle or vertex. */
  onHover?(pick: Pick | null): void;
  /** After each frame: milliseconds until the card was done with it. */
  onFrame?(milliseconds: number): void;
  /** How a vertex is called in labels. */
  vertexName?(vertex: number, side: Side): string;
  vertexTool?: VertexTool;
}

const kNear = 9; // pixels between pointer and vertex
const kSlow = 40; // milliseconds of a frame: beyond, moving slides the picture that is there
const kPause = 120; // milliseconds without a move until such a picture is drawn anew
const kMargin = 24; // pixels around a mesh that fits

export class Viewer {
  readonly canvas: HTMLCanvasElement;
  /** The scale of the colors in use, for a legend; null: plain. */
  scale: ColorScale | null = null;
  readonly layers: Layers = { primal: true, dual: true, weights: true, orthocenters: false, bad: true };

  private readonly gl: WebGL2RenderingContext;
  private readonly programs: Programs;
  private readonly overlay: Overlay;
  private readonly zoom: ZoomBehavior<HTMLElement, unknown>;
  private readonly surface: Selection<HTMLElement, unknown, null, undefined>;
  private readonly resizes: ResizeObserver;
  private theme: Theme;
  private scenes: Partial<Record<Side, Scene>> = {};
  private locators: Partial<Record<Side, Locator>> = {};
  private measure: Measure | null = null;
  private transform: ZoomTransform = zoomIdentity;
  private box: Box = { x0: 0, y0: 0, x1: 1, y1: 1 };
  private frame: Frame = { x: 0, y: 0, size: 1 };
  private split = 0;
  private selected: { side: Side; triangle: number } | null = null;
  private scheduled = 0;
  private dirty = false;
  private dragged = -1;
  private drawn: ZoomTransform = zoomIdentity; // of the picture on the canvas
  private frameTime = 0; // until the card was done with the last one
  private pause = 0;
  private fitted = false; // all of the mesh is shown, and is to be when the size changes

  constructor(
    readonly host: HTMLElement,
    private readonly options: ViewerOptions = {},
  ) {
    this.theme = options.theme ?? lightTheme;
    Object.assign(this.layers, options.layers);
    this.canvas = host.ownerDocument.createElement('canvas');
    this.canvas.style.cssText = 'position:absolute;inset:0;width:100%;height:100%;display:block';
    host.append(this.canvas);
    const gl = this.canvas.getContext('webgl2', { antialias: false, alpha: false, powerPreference: 'high-performance' });
    if (!gl) {
      this.canvas.remove();
      throw new Error('this browser has no WebGL 2, by which the mesh is drawn');
    }
    this.gl = gl;
    this.programs = makePrograms(gl);
    this.overlay = new Overlay(host);
    this.surface = select(host);
    this.zoom = zoom<HTMLElement, unknown>()
      .filter((event: Event) => this.movesView(event))
      .on('zoom', (event: D3ZoomEvent<HTMLElement, unknown>) => {
        this.transform = event.transform;
        this.fitted = false;
        if (event.sourceEvent && this.frameTime > kSlow) this.slide();
        else this.redraw();
      });
    this.surface.call(this.zoom);
    this.listen();
    this.resizes = new ResizeObserver(() => this.resize());
    this.resizes.observe(host);
    this.resize();
  }

  // --- what is drawn -----------------------------------------------------------------------------------------

  /** Draws a mesh; with another one before it, both, divided. Arrays are kept, not copied. */
  setMesh(mesh: MeshData, before: MeshData | null = null, { keepView = false } = {}): void {
    for (const scene of Object.values(this.scenes)) scene.delete();
    this.box = boundsOf(mesh.points);
    if (!keepView) {
      this.frame = frameOf(this.box);
      this.limitZoom();
    }
    this.scenes = { after: new Scene(this.gl, this.programs, mesh, this.frame) };
    if (before) this.scenes.before = new Scene(this.gl, this.programs, before, this.frame);
    this.locators = {};
    this.select(null);
    this.recolor();
    if (!keepView) this.fit();
    this.redraw();
  }

  /** The points or weights of the mesh have changed in place. */
  geometryChanged(): void {
    this.dirty = true;
    this.redraw();
  }

  meshOf(side: Side): MeshData | undefined {
    return this.scenes[side]?.mesh;
  }

  /** The triangles that are not well-centered, ascending. */
  badTriangles(side: Side): Uint32Array {
    return this.scenes[side]?.bad ?? new Uint32Array(0);
  }

  setLayers(layers: Partial<Layers>): void {
    Object.assign(this.layers, layers);
    this.redraw();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.recolor();
    this.redraw();
  }

  /** Colors triangles by a measure, or one of your own; null: plain. Returns the scale, for a legend. */
  colorBy(measure: string | Measure | null): ColorScale | null {
    this.measure = typeof measure === 'string' ? (findMeasure(measure) ?? null) : measure;
    this.recolor();
    this.redraw();
    return this.scale;
  }

  /** The part of the width, from the left, that shows the mesh before: 0 none, 1 all. */
  setSplit(part: number): void {
    this.split = Math.max(0, Math.min(1, part));
    this.redraw();
  }

  /** Marks a triangle with its vertices, orthocenter and duals. */
  select(triangle: number | null, side: Side = 'after'): void {
    this.selected = triangle === null ? null : { side, triangle };
    this.redraw();
  }

  // --- where ----------------------------------------------------------------------------------------------------

  fit(box: Box = this.box): void {
    const { width, height } = this.size();
    const k = this.baseScale();
    const wide = (box.x1 - box.x0) * k || 1, high = (box.y1 - box.y0) * k || 1;
    const factor = Math.min((width - 2 * kMargin) / wide, (height - 2 * kMargin) / high);
    this.lookAt((box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2, Math.max(1e-9, factor));
    this.fitted = box === this.box;
  }

  zoomToTriangle(triangle: number, side: Side = 'after'): void {
    const mesh = this.meshOf(side);
    if (!mesh) return;
    const box = boxOfTriangle(mesh, triangle);
    const around = 2.5 * Math.max(box.x1 - box.x0, box.y1 - box.y0);
    this.fit({ x0: box.x0 - around, y0: box.y0 - around, x1: box.x1 + around, y1: box.y1 + around });
  }

  zoomBy(factor: number): void {
    this.surface.call(this.zoom.scaleBy, factor);
  }

  /** By pixels of the screen. */
  panBy(dx: number, dy: number): void {
    this.surface.call(this.zoom.translateBy, dx / this.transform.k, dy / this.transform.k);
  }

  /** From pixels of the viewer to the mesh's coordinates, and back. */
  toMesh(x: number, y: number): [number, number] {
    const view = this.view();
    return [view.x + ((x - this.size().width / 2) * view.ratio) / view.scale, view.y - ((y - this.size().height / 2) * view.ratio) / view.scale];
  }
  toScreen(x: number, y: number): [number, number] {
    const view = this.view();
    return [this.size().width / 2 + ((x - view.x) * view.scale) / view.ratio, this.size().height / 2 - ((y - view.y) * view.scale) / view.ratio];
  }

  /** What is at a place in pixels of the viewer. */
  pickAt(x: number, y: number): Pick | null {
    const side: Side = this.scenes.before && x < this.split * this.size().width ? 'before' : 'after';
    const mesh = this.meshOf(side);
    if (!mesh) return null;
    const locator = (this.locators[side] ??= new Locator(mesh));
    const [mx, my] = this.toMesh(x, y);
    const reach = (kNear * this.view().ratio) / this.view().scale;
    const triangle = locator.triangleAt(mx, my), vertex = locator.vertexAt(mx, my, reach);
    return triangle < 0 && vertex < 0 ? null : { side, triangle, vertex, x: mx, y: my };
  }

  /** Draws at once, and returns the milliseconds until the card is done with it: for measurements. */
  drawNow(): number {
    const begin = performance.now();
    this.draw();
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - begin;
  }

  /** The picture as it is, as a data URL of a PNG: for printing. */
  image(): string {
    this.draw();
    return this.canvas.toDataURL('image/png');
  }

  destroy(): void {
    cancelAnimationFrame(this.scheduled);
    clearTimeout(this.pause);
    this.resizes.disconnect();
    for (const scene of Object.values(this.scenes)) scene.delete();
    this.surface.on('.zoom', null);
    this.overlay.remove();
    this.canvas.remove();
  }

  // --- inside -------------------------------------------------------------------------------------------------

  private size(): { width: number; height: number } {
    return { width: this.host.clientWidth || 1, height: this.host.clientHeight || 1 };
  }

  /** Pixels of the page a unit, at zoom 1. */
  private baseScale(): number {
    return 400 / this.frame.size;
  }

  private view(): View {
    const { width, height } = this.size();
    const { k, x, y } = this.transform;
    const base = this.baseScale(), ratio = this.canvas.width / width;
    return {
      x: this.frame.x + (width / 2 - x) / (k * base),
      y: this.frame.y - (height / 2 - y) / (k * base),
      scale: k * base * ratio,
      width: this.canvas.width,
      height: this.canvas.height,
      ratio,
    };
  }

  private lookAt(x: number, y: number, k: number): void {
    const { width, height } = this.size();
    const base = this.baseScale() * k;
    const moved = zoomIdentity
      .translate(width / 2 - (x - this.frame.x) * base, height / 2 + (y - this.frame.y) * base)
      .scale(k);
    this.surface.call(this.zoom.transform, moved);
  }

  private limitZoom(): void {
    this.zoom.scaleExtent([1e-3, 1e8]);
  }

  private recolor(): void {
    const scenes = Object.values(this.scenes);
    if (!this.measure || scenes.length === 0) {
      this.scale = null;
      for (const scene of scenes) scene.setColors(null, new Uint8Array(0));
      return;
    }
    const measure = this.measure;
    const values = scenes.map((scene) => valuesOf(scene.mesh, measure));
    const scale = scaleOf(measure, values);
    scenes.forEach((scene, i) => scene.setColors(tableRows(scale, values[i]), colorTable(scale)));
    this.scale = scale;
  }

  private resize(): void {
    const { width, height } = this.size();
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const w = Math.round(width * ratio), h = Math.round(height * ratio);
    if (w === this.canvas.width && h === this.canvas.height) return;
    const view = this.view();
    const k = this.transform.k;
    this.canvas.width = w;
    this.canvas.height = h;
    if (this.fitted) this.fit();
    else this.lookAt(view.x, view.y, k);
    this.redraw();
  }

  private redraw(): void {
    if (this.scheduled === 0) this.scheduled = requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    cancelAnimationFrame(this.scheduled);
    this.scheduled = 0;
    const begin = performance.now();
    if (this.dirty) this.updateGeometry();
    const { gl } = this;
    const view = this.view();
    twgl.bindFramebufferInfo(gl, null);
    gl.clearColor(...rgb(this.theme.background), 1);
    gl.disable(gl.SCISSOR_TEST);
    gl.clear(gl.COLOR_BUFFER_BIT);
    const { before, after } = this.scenes;
    const edge = before ? Math.round(this.split * view.width) : 0;
    gl.enable(gl.SCISSOR_TEST);
    if (before && edge > 0) {
      gl.scissor(0, 0, edge, view.height);
      before.draw(view, this.layers, this.theme);
    }
    if (after && edge < view.width) {
      gl.scissor(edge, 0, view.width - edge, view.height);
      after.draw(view, this.layers, this.theme);
    }
    this.drawn = this.transform;
    this.canvas.style.transform = '';
    this.drawSelection();
    this.timeFrame(begin);
  }

  /** Waits for the card without holding up the page. */
  private timeFrame(begin: number): void {
    const { gl } = this;
    const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (!fence) return;
    gl.flush();
    const look = (): void => {
      if (gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) {
        setTimeout(look, 3);
        return;
      }
      gl.deleteSync(fence);
      this.frameTime = performance.now() - begin;
      this.options.onFrame?.(this.frameTime);
    };
    setTimeout(look, 0);
  }

  /** Moves the picture as it is, and draws it anew when the move pauses: a slow card follows the hand, too. */
  private slide(): void {
    const { drawn, transform } = this;
    const k = transform.k / drawn.k;
    this.canvas.style.transformOrigin = '0 0';
    this.canvas.style.transform = `translate(${transform.x - k * drawn.x}px,${transform.y - k * drawn.y}px) scale(${k})`;
    this.drawSelection();
    clearTimeout(this.pause);
    this.pause = window.setTimeout(() => this.redraw(), kPause);
  }

  private updateGeometry(): void {
    this.dirty = false;
    for (const scene of Object.values(this.scenes)) scene.setGeometry();
    this.locators = {};
    this.recolor();
  }

  private drawSelection(): void {
    const mesh = this.selected && this.meshOf(this.selected.side);
    if (!this.selected || !mesh) {
      this.overlay.clear();
      return;
    }
    const side = this.selected.side;
    const name = (v: number): string => this.options.vertexName?.(v, side) ?? String(v);
    this.overlay.show(mesh, this.selected.triangle, (x, y) => this.toScreen(x, y), name, this.theme);
  }

  // --- pointer and keys ---------------------------------------------------------------------------------------

  private at(event: MouseEvent): [number, number] {
    const box = this.host.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** Whether d3-zoom takes an event. */
  private movesView(event: Event): boolean {
    if (event.target instanceof Element && event.target.closest('[data-control]')) return false;
    if (event instanceof MouseEvent && event.button !== 0) return false;
    if (event.type === 'wheel') return !this.wheelsVertex(event as WheelEvent);
    if (this.dragged >= 0) return false;
    return !(event instanceof MouseEvent && event.type === 'mousedown' && this.draggable(event) >= 0);
  }

  private draggable(event: MouseEvent): number {
    const tool = this.options.vertexTool;
    const vertex = tool ? (this.pickAt(...this.at(event))?.vertex ?? -1) : -1;
    return vertex >= 0 && tool?.canDrag(vertex) ? vertex : -1;
  }

  private wheelsVertex(event: WheelEvent): boolean {
    const tool = this.options.vertexTool;
    if (!tool?.wheel) return false;
    const vertex = this.pickAt(...this.at(event))?.vertex ?? -1;
    if (vertex < 0 || !tool.wheel(vertex, -Math.sign(event.deltaY), event)) return false;
    event.preventDefault();
    return true;
  }

  private listen(): void {
    const { host } = this;
    let down: [number, number] | null = null;
    if (host.tabIndex < 0) host.tabIndex = 0;
    host.style.touchAction = 'none';
    // The pointer's events come before those of mouse and touch, which d3-zoom hears.
    host.addEventListener('pointerdown', (event) => {
      if (event.target instanceof Element && event.target.closest('[data-control]')) return;
      down = this.at(event);
      this.dragged = event.button === 0 ? this.draggable(event) : -1;
      if (this.dragged < 0) return;
      host.setPointerCapture(event.pointerId);
      this.tellDrag(event, 'start');
    });
    host.addEventListener('pointermove', (event) => {
      if (this.dragged >= 0) this.tellDrag(event, 'move');
      else if (this.options.onHover && event.buttons === 0) this.options.onHover(this.pickAt(...this.at(event)));
    });
    const release = (event: PointerEvent): void => {
      if (this.dragged >= 0) this.tellDrag(event, 'end');
      this.dragged = -1;
    };
    host.addEventListener('pointercancel', release);
    host.addEventListener('pointerup', (event) => {
      release(event);
      const at = this.at(event);
      const still = down !== null && Math.hypot(at[0] - down[0], at[1] - down[1]) < 4;
      down = null;
      if (still && event.button === 0) this.tellPick(at[0], at[1]);
    });
    host.addEventListener('keydown', (event) => this.key(event));
  }

  private tellDrag(event: PointerEvent, phase: 'start' | 'move' | 'end'): void {
    this.options.vertexTool?.drag(this.dragged, ...this.toMesh(...this.at(event)), phase);
  }

  private tellPick(x: number, y: number): void {
    const pick = this.pickAt(x, y);
    const triangle = pick && pick.triangle >= 0 ? pick.triangle : null;
    this.select(triangle, pick?.side);
    this.options.onPick?.(triangle === null ? null : pick);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target !== this.host) return;
    const step = event.shiftKey ? 160 : 40;
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.panBy(step, 0),
      ArrowRight: () => this.panBy(-step, 0),
      ArrowUp: () => this.panBy(0, step),
      ArrowDown: () => this.panBy(0, -step),
      '+': () => this.zoomBy(1.4),
      '=': () => this.zoomBy(1.4),
      '-': () => this.zoomBy(1 / 1.4),
      '0': () => this.fit(),
      Enter: () => this.tellPick(this.size().width / 2, this.size().height / 2),
      Escape: () => {
        this.select(null);
        this.options.onPick?.(null);
      },
    };
    if (!(event.key in actions)) return;
    actions[event.key]();
    event.preventDefault();
  }
}

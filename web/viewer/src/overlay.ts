// What is drawn over the canvas: the picked triangle with the numbers of its vertices, its orthocenter, and the lines
// from there to where the duals cross its edges.
import type { Theme } from './colors.ts';
import { orthocenter, weightedMidpoint } from './geometry.ts';
import type { MeshData } from './mesh.ts';

const kSvg = 'http://www.w3.org/2000/svg';

/** The corners of the cell that a triangle is a part of. */
function cellCorners(mesh: MeshData, cells: Int32Array, triangle: number): number[] {
  let first = triangle;
  while (first > 0 && cells[first - 1] === cells[triangle]) first--;
  const around = [0, 1, 2].map((k) => mesh.triangles[3 * first + k]);
  for (let t = first + 1; cells[t] === cells[first]; t++) around.push(mesh.triangles[3 * t + 2]);
  return around;
}

export class Overlay {
  private readonly svg: SVGSVGElement;

  constructor(host: HTMLElement) {
    this.svg = host.ownerDocument.createElementNS(kSvg, 'svg');
    this.svg.style.cssText = 'position:absolute;inset:0;width:100%;height:100%;pointer-events:none';
    this.svg.setAttribute('aria-hidden', 'true');
    host.append(this.svg);
  }

  clear(): void {
    if (this.svg.firstChild) this.svg.replaceChildren();
  }

  show(
    mesh: MeshData,
    triangle: number,
    toScreen: (x: number, y: number) => [number, number],
    name: (vertex: number) => string,
    theme: Theme,
  ): void {
    const corners = mesh.cells ? cellCorners(mesh, mesh.cells, triangle) : [0, 1, 2].map((k) => mesh.triangles[3 * triangle + k]);
    const at = corners.map((v) => toScreen(mesh.points[2 * v], mesh.points[2 * v + 1]));
    const outline = `M${at.map((p) => p.join(',')).join('L')}Z`;
    const outlines = [[theme.background, 5], [theme.selection, 2.2]].map(([stroke, width]) =>
      this.make('path', { d: outline, fill: 'none', stroke, 'stroke-width': width, 'stroke-linejoin': 'round' }));
    this.svg.replaceChildren(...outlines);
    if (mesh.cells) return;
    const o = orthocenter(mesh, triangle), center = toScreen(o.x, o.y);
    const feet = corners.map((v, k) => {
      const m = weightedMidpoint(mesh, v, corners[(k + 1) % 3]);
      return toScreen(m.x, m.y);
    });
    const middle = [0, 1].map((i) => (at[0][i] + at[1][i] + at[2][i]) / 3);
    this.svg.append(
      ...feet.map((foot) =>
        this.make('path', { d: `M${center.join(',')}L${foot.join(',')}`, stroke: theme.selection, 'stroke-width': 1.2, 'stroke-dasharray': '3 3' }),
      ),
      ...feet.map((foot) => this.make('circle', { cx: foot[0], cy: foot[1], r: 2.5, fill: theme.selection })),
      this.make('circle', { cx: center[0], cy: center[1], r: 4.5, fill: theme.orthocenter, stroke: theme.background, 'stroke-width': 1.5 }),
      ...at.map((p, k) => this.label(p, middle, name(corners[k]), theme)),
    );
  }

  remove(): void {
    this.svg.remove();
  }

  /** A label outside of a corner. */
  private label(at: number[], middle: number[], text: string, theme: Theme): SVGElement {
    const dx = at[0] - middle[0], dy = at[1] - middle[1], l = Math.hypot(dx, dy) || 1;
    const element = this.make('text', {
      x: at[0] + (14 * dx) / l,
      y: at[1] + (14 * dy) / l,
      fill: theme.selection,
      stroke: theme.background,
      'stroke-width': 3,
      'paint-order': 'stroke',
      'text-anchor': 'middle',
      'dominant-baseline': 'central',
      'font-size': 12,
      'font-weight': 600,
    });
    element.textContent = text;
    return element;
  }

  private make(tag: string, attributes: Record<string, string | number>): SVGElement {
    const element = this.svg.ownerDocument.createElementNS(kSvg, tag) as SVGElement;
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
    return element;
  }
}

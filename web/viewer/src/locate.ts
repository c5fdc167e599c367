// Which triangle, or vertex, is at a place: by a grid over the mesh with the triangles that meet each cell.
import { contains } from './geometry.ts';
import { boundsOf, boxOfTriangle, type MeshData, nTriangles } from './mesh.ts';

export class Locator {
  private readonly starts: Uint32Array;
  private readonly members: Uint32Array;
  private readonly columns: number;
  private readonly rows: number;
  private readonly x: number;
  private readonly y: number;
  private readonly cell: number;

  constructor(private readonly mesh: MeshData) {
    const n = nTriangles(mesh);
    const box = boundsOf(mesh.points);
    const width = box.x1 - box.x0 || 1, height = box.y1 - box.y0 || 1;
    this.cell = Math.max(Math.sqrt((width * height) / Math.max(1, n / 2)), Math.max(width, height) / 2000);
    this.x = box.x0;
    this.y = box.y0;
    this.columns = Math.floor(width / this.cell) + 1;
    this.rows = Math.floor(height / this.cell) + 1;
    this.starts = new Uint32Array(this.columns * this.rows + 1);
    for (let t = 0; t < n; t++) this.eachCell(t, (c) => this.starts[c + 1]++);
    for (let c = 0; c + 1 < this.starts.length; c++) this.starts[c + 1] += this.starts[c];
    this.members = new Uint32Array(this.starts[this.starts.length - 1]);
    const filled = this.starts.slice();
    for (let t = 0; t < n; t++) this.eachCell(t, (c) => (this.members[filled[c]++] = t));
  }

  /** The triangle at a place, or −1. */
  triangleAt(x: number, y: number): number {
    const column = this.column(x), row = this.row(y);
    if (column < 0 || row < 0 || column >= this.columns || row >= this.rows) return -1;
    const c = row * this.columns + column;
    for (let i = this.starts[c]; i < this.starts[c + 1]; i++) {
      if (contains(this.mesh, this.members[i], x, y)) return this.members[i];
    }
    return -1;
  }

  /** The nearest vertex within a distance, or −1. */
  vertexAt(x: number, y: number, distance: number): number {
    const { points, triangles } = this.mesh;
    let found = -1, least = distance * distance;
    const clamp = (i: number, n: number): number => Math.max(0, Math.min(n - 1, i));
    const c0 = clamp(this.column(x - distance), this.columns), c1 = clamp(this.column(x + distance), this.columns);
    const r0 = clamp(this.row(y - distance), this.rows), r1 = clamp(this.row(y + distance), this.rows);
    for (let row = r0; row <= r1; row++) {
      for (let i = this.starts[row * this.columns + c0]; i < this.starts[row * this.columns + c1 + 1]; i++) {
        for (let h = 3 * this.members[i]; h < 3 * this.members[i] + 3; h++) {
          const v = triangles[h];
          const away = (points[2 * v] - x) ** 2 + (points[2 * v + 1] - y) ** 2;
          if (away <= least) {
            least = away;
            found = v;
          }
        }
      }
    }
    return found;
  }

  private column(x: number): number {
    return Math.floor((x - this.x) / this.cell);
  }
  private row(y: number): number {
    return Math.floor((y - this.y) / this.cell);
  }

  private eachCell(t: number, visit: (cell: number) => void): void {
    const box = boxOfTriangle(this.mesh, t);
    for (let row = this.row(box.y0); row <= this.row(box.y1); row++) {
      for (let column = this.column(box.x0); column <= this.column(box.x1); column++) visit(row * this.columns + column);
    }
  }
}

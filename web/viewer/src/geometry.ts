// The numbers of a triangle in the power diagram, in doubles, with the signs and formulae of temper/detail/geometry.hpp.
import { type MeshData, nTriangles, next, previous, Verdict } from './mesh.ts';

export interface Point {
  x: number;
  y: number;
}

/** Edge k runs from corner k to corner k + 1. */
export interface TriangleNumbers {
  vertices: [number, number, number];
  /** ℓ of each edge. */
  length: number[];
  /** h of the orthocenter over each edge, positive inside. */
  height: number[];
  /** d, from corner k towards corner k + 1. */
  crossing: number[];
  /** At each corner, in degrees. */
  angle: number[];
  weight: number[];
  area: number;
  orthocenter: Point;
  centroid: Point;
}

export const weightOf = (mesh: MeshData, v: number): number => (mesh.weights ? mesh.weights[v] : 0);

/** d of an edge. */
export function dualCrossing(mesh: MeshData, a: number, b: number): number {
  const { points } = mesh;
  const length = Math.hypot(points[2 * b] - points[2 * a], points[2 * b + 1] - points[2 * a + 1]);
  return length / 2 + (weightOf(mesh, a) - weightOf(mesh, b)) / (2 * length);
}

/** The weighted midpoint of an edge: where its dual crosses it. */
export function weightedMidpoint(mesh: MeshData, a: number, b: number): Point {
  const { points } = mesh;
  const dx = points[2 * b] - points[2 * a], dy = points[2 * b + 1] - points[2 * a + 1];
  const part = 0.5 + (weightOf(mesh, a) - weightOf(mesh, b)) / (2 * (dx * dx + dy * dy));
  return { x: points[2 * a] + part * dx, y: points[2 * a + 1] + part * dy };
}

/** The point of equal power to the corners of a triangle. */
export function orthocenter(mesh: MeshData, t: number): Point {
  const { points, triangles } = mesh;
  const a = triangles[3 * t], b = triangles[3 * t + 1], c = triangles[3 * t + 2];
  const ux = points[2 * b] - points[2 * a], uy = points[2 * b + 1] - points[2 * a + 1];
  const vx = points[2 * c] - points[2 * a], vy = points[2 * c + 1] - points[2 * a + 1];
  const w = weightOf(mesh, a);
  const p = ux * ux + uy * uy + w - weightOf(mesh, b);
  const q = vx * vx + vy * vy + w - weightOf(mesh, c);
  const doubled = 2 * (ux * vy - uy * vx);
  return { x: points[2 * a] + (p * vy - q * uy) / doubled, y: points[2 * a + 1] + (q * ux - p * vx) / doubled };
}

export function triangleNumbers(mesh: MeshData, t: number): TriangleNumbers {
  const { points, triangles } = mesh;
  const vertices = [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]] as [number, number, number];
  const xs = vertices.map((v) => points[2 * v]), ys = vertices.map((v) => points[2 * v + 1]);
  const center = orthocenter(mesh, t);
  const length = [], height = [], crossing = [], angle = [];
  for (let k = 0; k < 3; k++) {
    const j = (k + 1) % 3, i = (k + 2) % 3;
    const dx = xs[j] - xs[k], dy = ys[j] - ys[k];
    const ex = xs[i] - xs[k], ey = ys[i] - ys[k];
    const l = Math.hypot(dx, dy);
    length.push(l);
    height.push((dx * (center.y - ys[k]) - dy * (center.x - xs[k])) / l);
    crossing.push(dualCrossing(mesh, vertices[k], vertices[j]));
    angle.push((Math.atan2(Math.abs(dx * ey - dy * ex), dx * ex + dy * ey) * 180) / Math.PI);
  }
  const area = ((xs[1] - xs[0]) * (ys[2] - ys[0]) - (ys[1] - ys[0]) * (xs[2] - xs[0])) / 2;
  const centroid = { x: (xs[0] + xs[1] + xs[2]) / 3, y: (ys[0] + ys[1] + ys[2]) / 3 };
  const weight = vertices.map((v) => weightOf(mesh, v));
  return { vertices, length, height, crossing, angle, weight, area, orthocenter: center, centroid };
}

/** The verdict on a triangle in doubles, for meshes that bring none. */
function verdictOf(numbers: TriangleNumbers): number {
  if (!(numbers.area > 0)) return Verdict.inverted;
  let bits = 0;
  for (let k = 0; k < 3; k++) {
    if (!(numbers.height[k] > 0)) bits |= Verdict.outside[k];
    if (!(numbers.crossing[k] > 0 && numbers.crossing[k] < numbers.length[k])) bits |= Verdict.notCrossed[k];
  }
  return bits;
}

export function verdicts(mesh: MeshData): Uint8Array {
  if (mesh.verdicts) return mesh.verdicts;
  const n = nTriangles(mesh);
  const bits = new Uint8Array(n);
  for (let t = 0; t < n; t++) bits[t] = verdictOf(triangleNumbers(mesh, t));
  return bits;
}

/** Twice the signed area of a, b and a place. */
const turn = (points: Float64Array, a: number, b: number, x: number, y: number): number =>
  (points[2 * b] - points[2 * a]) * (y - points[2 * a + 1]) - (points[2 * b + 1] - points[2 * a + 1]) * (x - points[2 * a]);

export function contains(mesh: MeshData, t: number, x: number, y: number): boolean {
  for (let h = 3 * t; h < 3 * t + 3; h++) {
    if (turn(mesh.points, mesh.triangles[h], mesh.triangles[next(h)], x, y) < 0) return false;
  }
  return true;
}

/** Whether the dual of an edge between two triangles is shorter than nothing: the edge is not regular. */
export function hasNegativeDual(mesh: MeshData, h: number, twin: number): boolean {
  const { points, triangles } = mesh;
  const a = triangles[h], b = triangles[next(h)], c = triangles[previous(h)], d = triangles[previous(twin)];
  const asVector = (v: number): number[] => {
    const x = points[2 * v] - points[2 * d], y = points[2 * v + 1] - points[2 * d + 1];
    return [x, y, x * x + y * y - weightOf(mesh, v) + weightOf(mesh, d)];
  };
  const [p, q, r] = [asVector(a), asVector(b), asVector(c)];
  const power =
    p[2] * (q[0] * r[1] - q[1] * r[0]) - q[2] * (p[0] * r[1] - p[1] * r[0]) + r[2] * (p[0] * q[1] - p[1] * q[0]);
  return power > 0;
}

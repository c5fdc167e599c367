// What triangles can be colored by: one row a measure.
import { triangleNumbers, type TriangleNumbers, verdicts } from './geometry.ts';
import { type MeshData, nTriangles } from './mesh.ts';

/** The way from bad to good along the values of a measure. */
export type Preference = 'larger' | 'less' | 'neither';

export interface Measure {
  key: string;
  label: string;
  unit: string;
  better: Preference;
  /** Values that are kinds (regions), not amounts. */
  kinds?: boolean;
  /** Ends of the scale that do not depend on the mesh; the rest is taken from its values. */
  low?: number;
  high?: number;
  of(numbers: TriangleNumbers, t: number, mesh: MeshData): number;
}

const least = (values: number[]): number => Math.min(values[0], values[1], values[2]);
const overLength = (of: number[], numbers: TriangleNumbers): number[] => of.map((v, k) => v / numbers.length[k]);
const leastHeight = (n: TriangleNumbers): number => (n.area > 0 ? least(overLength(n.height, n)) : -Infinity);
const leastCrossing = (n: TriangleNumbers): number =>
  least(overLength(n.crossing, n).map((part) => Math.min(part, 1 - part)));

export const measures: readonly Measure[] = [
  { key: 'margin', label: 'Margin: least h/ℓ or d/ℓ', unit: '', better: 'larger', low: 0, high: 0.3,
    of: (n) => Math.min(leastHeight(n), leastCrossing(n)) },
  { key: 'h_over_l', label: 'Least h/ℓ', unit: '', better: 'larger', low: 0, high: 0.3, of: leastHeight },
  { key: 'd_over_l', label: 'Least d/ℓ', unit: '', better: 'larger', low: 0, high: 0.5, of: leastCrossing },
  { key: 'min_angle_deg', label: 'Least angle', unit: '°', better: 'larger', low: 0, high: 60,
    of: (n) => least(n.angle) },
  { key: 'max_angle_deg', label: 'Largest angle', unit: '°', better: 'less', low: 60, high: 120,
    of: (n) => Math.max(...n.angle) },
  { key: 'size', label: 'Size: mean edge length', unit: '', better: 'neither',
    of: (n) => (n.length[0] + n.length[1] + n.length[2]) / 3 },
  { key: 'area', label: 'Area', unit: '', better: 'neither', of: (n) => n.area },
  { key: 'region', label: 'Region', unit: '', better: 'neither', kinds: true,
    of: (_, t, mesh) => (mesh.regions ? mesh.regions[t] : 0) },
];

export const findMeasure = (key: string): Measure | undefined => measures.find((m) => m.key === key);

/** The values of a measure, one a triangle. */
export function valuesOf(mesh: MeshData, measure: Measure): Float32Array {
  const values = new Float32Array(nTriangles(mesh));
  for (let t = 0; t < values.length; t++) values[t] = measure.of(triangleNumbers(mesh, t), t, mesh);
  return values;
}

/** The triangles that are not well-centered, ascending. */
export function badTriangles(mesh: MeshData): Uint32Array {
  const bits = verdicts(mesh);
  let n = 0;
  for (const b of bits) n += b !== 0 ? 1 : 0;
  const bad = new Uint32Array(n);
  n = 0;
  for (let t = 0; t < bits.length; t++) if (bits[t] !== 0) bad[n++] = t;
  return bad;
}

/** The values at these parts of all finite ones, of a sample when there are very many. */
export function quantiles(values: Float32Array, parts: number[]): number[] {
  const step = Math.max(1, Math.floor(values.length / 100_000));
  const sample: number[] = [];
  for (let i = 0; i < values.length; i += step) if (Number.isFinite(values[i])) sample.push(values[i]);
  if (sample.length === 0) return parts.map(() => 0);
  sample.sort((a, b) => a - b);
  return parts.map((p) => sample[Math.min(sample.length - 1, Math.floor(p * sample.length))]);
}

// A mesh of tetrahedra: the numbers of one, and its cut by a plane, which the viewer draws as a mesh of triangles.
import { findTwins, type Measure, type MeshData } from 'temper-viewer';
import { number } from './html.ts';

/** Face f is opposite corner f. */
export interface Tets {
  /** x, y, z of each vertex. */
  points: Float64Array;
  weights?: Float64Array;
  /** Four corners of each tetrahedron. */
  tetrahedra: Int32Array;
  /** The exact verdict. Bit f: the orthocenter is not inside across face f. Bit 6: not positive. */
  verdicts: Uint8Array;
  regions?: Int32Array;
}

export const nTetrahedra = (tets: Tets): number => tets.verdicts.length;

type Vector = [number, number, number];
const minus = (a: Vector, b: Vector): Vector => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a: Vector, b: Vector): Vector => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Corners of face f, counter-clockwise as seen from corner f, as TetMesh has them. */
export const kFaces = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

export interface TetNumbers {
  vertices: number[];
  points: Vector[];
  weight: number[];
  /** ℓ of each face: the side of the equilateral triangle of its area. */
  length: number[];
  /** h of the orthocenter over each face, positive inside. */
  height: number[];
  /** The largest of its dihedral angles, in degrees. */
  dihedral: number;
  volume: number;
  orthocenter: Vector;
  /** The least h/ℓ; −∞ for one that is not positive. */
  margin: number;
}

export function tetNumbers(tets: Tets, t: number): TetNumbers {
  const vertices = [0, 1, 2, 3].map((k) => tets.tetrahedra[4 * t + k]);
  const points = vertices.map((v): Vector => [tets.points[3 * v], tets.points[3 * v + 1], tets.points[3 * v + 2]]);
  const weight = vertices.map((v) => tets.weights?.[v] ?? 0);
  const edges = [1, 2, 3].map((k) => minus(points[k], points[0]));
  const powers = edges.map((e, k) => dot(e, e) + weight[0] - weight[k + 1]);
  const normals = [cross(edges[1], edges[2]), cross(edges[2], edges[0]), cross(edges[0], edges[1])];
  const sixVolumes = dot(edges[0], normals[0]);
  const along = (i: number): number =>
    points[0][i] + (powers[0] * normals[0][i] + powers[1] * normals[1][i] + powers[2] * normals[2][i]) / (2 * sixVolumes);
  const orthocenter: Vector = [along(0), along(1), along(2)];
  const length: number[] = [], height: number[] = [], inwards: Vector[] = [];
  for (const [a, b, c] of kFaces) {
    const normal = cross(minus(points[b], points[a]), minus(points[c], points[a]));
    const size = Math.hypot(...normal);
    inwards.push([normal[0] / size, normal[1] / size, normal[2] / size]);
    length.push(Math.sqrt((2 / Math.sqrt(3)) * size));
    height.push(dot(normal, minus(orthocenter, points[a])) / size);
  }
  let least = 1; // cosine of the largest angle
  for (let f = 0; f < 4; f++) for (let g = 0; g < f; g++) least = Math.min(least, -dot(inwards[f], inwards[g]));
  const margin = sixVolumes > 0 ? Math.min(...height.map((h, f) => h / length[f])) : -Infinity;
  return { vertices, points, weight, length, height, dihedral: (Math.acos(Math.max(-1, least)) * 180) / Math.PI,
    volume: sixVolumes / 6, orthocenter, margin };
}

/** Across the axis x, y or z. */
export interface Plane {
  axis: number;
  at: number;
}

/** Axes of the picture of a cut, to the right and up. */
const kPicture = [[1, 2], [0, 2], [0, 1]];

/** The plane in the middle of the mesh across its shortest side: the largest picture. */
export function middlePlane(tets: Tets): Plane {
  const sides = [0, 1, 2].map((axis) => range(tets, axis)), widths = sides.map(([low, high]) => high - low);
  const axis = widths.lastIndexOf(Math.min(...widths));
  return { axis, at: (sides[axis][0] + sides[axis][1]) / 2 };
}

export const planeName = (plane: Plane): string => `${'xyz'[plane.axis]} = ${number(plane.at)}`;

/** The least and greatest coordinate along an axis. */
export function range(tets: Tets, axis: number): [number, number] {
  let low = Infinity, high = -Infinity;
  for (let i = axis; i < tets.points.length; i += 3) {
    low = Math.min(low, tets.points[i]);
    high = Math.max(high, tets.points[i]);
  }
  return [low, high];
}

/** A cut. Its triangles are parts of polygons, and their cells the tetrahedra. */
export interface Cut extends MeshData {
  cells: Int32Array;
  tets: Tets;
}

/**
 * The tetrahedra that have vertices both below the plane and not below it. A vertex on the plane is not below: a plane
 * along faces shows the tetrahedra beneath.
 */
export function cut(tets: Tets, plane: Plane): Cut {
  const { points, tetrahedra } = tets;
  const [right, up] = kPicture[plane.axis];
  const height = (v: number): number => points[3 * v + plane.axis];
  const n = points.length / 3;
  const numbers = new Map<number, number>(), places: number[] = [], triangles: number[] = [], cells: number[] = [];
  /** The point of the edge from a vertex below to another one: the same for all tetrahedra of the edge. */
  const crossing = (below: number, other: number): number => {
    const part = (plane.at - height(below)) / (height(other) - height(below));
    const key = part === 1 ? other : n + below * n + other;
    let found = numbers.get(key);
    if (found === undefined) {
      found = numbers.size;
      numbers.set(key, found);
      for (const axis of [right, up]) places.push((1 - part) * points[3 * below + axis] + part * points[3 * other + axis]);
    }
    return found;
  };
  const twiceArea = (corners: number[]): number => {
    const [x, y] = [0, 1].map((i) => corners.map((corner) => places[2 * corner + i] - places[2 * corners[0] + i]));
    return corners.reduce((sum, _, k) => (k === 0 ? 0 : sum + x[k - 1] * y[k] - x[k] * y[k - 1]), 0);
  };
  for (let t = 0; t < nTetrahedra(tets); t++) {
    let count = 0;
    for (let k = 4 * t; k < 4 * t + 4; k++) count += height(tetrahedra[k]) < plane.at ? 1 : 0;
    if (count === 0 || count === 4) continue;
    const below: number[] = [], others: number[] = [];
    for (let k = 4 * t; k < 4 * t + 4; k++) (height(tetrahedra[k]) < plane.at ? below : others).push(tetrahedra[k]);
    // Around the polygon one end of the edge changes at a time.
    const corners = below.flatMap((b, i) => (i % 2 === 0 ? others : [...others].reverse()).map((o) => crossing(b, o)))
      .filter((corner, i, all) => corner !== all[(i + 1) % all.length]);
    const area = twiceArea(corners);
    if (area === 0) continue;
    if (area < 0) corners.reverse();
    for (let k = 2; k < corners.length; k++) {
      triangles.push(corners[0], corners[k - 1], corners[k]);
      cells.push(t);
    }
  }
  const made = { points: Float64Array.from(places), triangles: Int32Array.from(triangles), cells: Int32Array.from(cells) };
  const twins = findTwins(made.triangles, numbers.size);
  const { regions } = tets;
  const constrained = regions && Uint8Array.from(twins, (twin, h) =>
    (twin >= 0 && regions[cells[Math.floor(twin / 3)]] !== regions[cells[Math.floor(h / 3)]] ? 1 : 0));
  return { ...made, twins, constrained, verdicts: Uint8Array.from(cells, (t) => tets.verdicts[t]), tets };
}

const of = (value: (numbers: TetNumbers) => number): Measure['of'] => (_, t, mesh) => {
  const { tets, cells } = mesh as Cut;
  return value(tetNumbers(tets, cells[t]));
};
/** What tetrahedra can be colored by. */
export const tetMeasures: readonly Measure[] = [
  { key: 'margin', label: 'Margin: least h/ℓ', unit: '', better: 'larger', low: 0, high: 0.2, of: of((n) => n.margin) },
  { key: 'max_dihedral_deg', label: 'Largest dihedral angle', unit: '°', better: 'less', low: 60, high: 150, of: of((n) => n.dihedral) },
  { key: 'volume', label: 'Volume', unit: '', better: 'neither', of: of((n) => n.volume) },
  { key: 'region', label: 'Region', unit: '', better: 'neither', kinds: true,
    of: (_, t, mesh) => (mesh as Cut).tets.regions?.[(mesh as Cut).cells[t]] ?? 0 },
];

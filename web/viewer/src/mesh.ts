// A weighted triangle mesh as flat arrays, and what drawing needs besides: twins, edges, an order in which neighbors
// in the plane are neighbors in memory.
//
// Halfedge 3 t + k runs from corner k to corner k + 1 of triangle t, as in temper itself.

export interface MeshData {
  /** x, y of each vertex. */
  points: Float64Array;
  /** The weight of each vertex; none: all 0. */
  weights?: Float64Array;
  /** Three corners of each triangle, counter-clockwise. */
  triangles: Int32Array;
  /** The halfedge on the other side of each, −1 on the boundary; none: they are found. */
  twins?: Int32Array;
  /** The region of each triangle; none: all 0. */
  regions?: Int32Array;
  /** Of each halfedge whether its edge is constrained; none: no edge is. */
  constrained?: Uint8Array;
  /** The exact verdict on each triangle, as Verdict has the bits; none: they are found in doubles. */
  verdicts?: Uint8Array;
  /** The cell of which each triangle is a part: it is drawn without the edges between its parts. These follow each
   * other, as a fan around their common first corner. None: each triangle is a cell of its own. */
  cells?: Int32Array;
}

/** Bits of a verdict: what keeps a triangle from being well-centered. */
export const Verdict = {
  /** The orthocenter is not inside across the edge from corner k: bit k. */
  outside: [1, 2, 4],
  /** The edge from corner k is not crossed by its dual: bit 3 + k. */
  notCrossed: [8, 16, 32],
  /** Clockwise, or without area. */
  inverted: 64,
} as const;

export interface Box {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

export const nTriangles = (mesh: MeshData): number => mesh.triangles.length / 3;
export const nVertices = (mesh: MeshData): number => mesh.points.length / 2;
export const next = (h: number): number => (h % 3 === 2 ? h - 2 : h + 1);
export const previous = (h: number): number => (h % 3 === 0 ? h + 2 : h - 1);

/** Twins by a list of halfedges at each lower vertex: O(n). */
export function findTwins(triangles: Int32Array, vertices: number): Int32Array {
  const n = triangles.length;
  const twins = new Int32Array(n).fill(-1);
  const first = new Int32Array(vertices).fill(-1);
  const chain = new Int32Array(n);
  for (let h = 0; h < n; h++) {
    const a = triangles[h], b = triangles[next(h)];
    const low = Math.min(a, b), high = a + b - low;
    let other = first[low];
    while (other >= 0 && (twins[other] >= 0 || triangles[other] + triangles[next(other)] - low !== high)) {
      other = chain[other];
    }
    if (other >= 0) {
      twins[h] = other;
      twins[other] = h;
    } else {
      chain[h] = first[low];
      first[low] = h;
    }
  }
  return twins;
}

/** The least box around some points; around nothing the unit square. */
export function boundsOf(points: Float64Array): Box {
  if (points.length === 0) return { x0: 0, y0: 0, x1: 1, y1: 1 };
  const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (let i = 0; i < points.length; i += 2) {
    const x = points[i], y = points[i + 1];
    if (x < box.x0) box.x0 = x;
    if (x > box.x1) box.x1 = x;
    if (y < box.y0) box.y0 = y;
    if (y > box.y1) box.y1 = y;
  }
  return box;
}

export function boxOfTriangle(mesh: MeshData, t: number): Box {
  const box = { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
  for (let h = 3 * t; h < 3 * t + 3; h++) {
    const x = mesh.points[2 * mesh.triangles[h]], y = mesh.points[2 * mesh.triangles[h] + 1];
    box.x0 = Math.min(box.x0, x);
    box.x1 = Math.max(box.x1, x);
    box.y0 = Math.min(box.y0, y);
    box.y1 = Math.max(box.y1, y);
  }
  return box;
}

/** The bits of two 16 bit numbers in turn: places that are close have keys that mostly are, too. */
function mortonKey(x: number, y: number): number {
  const spread = (value: number): number => {
    let v = value & 0xffff;
    v = (v | (v << 8)) & 0x00ff00ff;
    v = (v | (v << 4)) & 0x0f0f0f0f;
    v = (v | (v << 2)) & 0x33333333;
    return (v | (v << 1)) & 0x55555555;
  };
  return (spread(x) | (spread(y) << 1)) >>> 0;
}

/** The triangles in the order of a Z curve. */
export function curveOrder(mesh: MeshData, box: Box): Uint32Array {
  const n = nTriangles(mesh);
  const width = Math.max(box.x1 - box.x0, box.y1 - box.y0) || 1;
  // A key and its triangle in one double: 32 bits of key, 21 of triangle, are too few for the largest meshes.
  const keys = new BigUint64Array(n);
  for (let t = 0; t < n; t++) {
    const a = 2 * mesh.triangles[3 * t];
    const key = mortonKey(
      (65535 * (mesh.points[a] - box.x0)) / width,
      (65535 * (mesh.points[a + 1] - box.y0)) / width,
    );
    keys[t] = (BigInt(key) << 32n) | BigInt(t);
  }
  keys.sort();
  const low = new Uint32Array(keys.buffer);
  const order = new Uint32Array(n);
  for (let i = 0; i < n; i++) order[i] = low[2 * i];
  return order;
}

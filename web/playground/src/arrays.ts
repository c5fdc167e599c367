// Meshes as arrays, and back: bit for bit.
import { Mesh } from 'temper-mesh';
import type { Arrays } from './messages.ts';

export function arraysOf(mesh: Mesh): Arrays {
  const { points, weights, triangles, regions, constrained_edges, fixed } = mesh;
  return { points, weights, triangles, regions, constrained_edges, fixed };
}

export function meshOf(arrays: Arrays): Mesh {
  const { points, weights, triangles, regions, constrained_edges, fixed } = arrays;
  return new Mesh(points, triangles, weights, { regions, constrained_edges, fixed });
}

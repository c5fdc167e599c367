// The examples of the page: the paper's first.
import { generate, type Mesh } from 'temper-mesh';

export interface Example {
  name: string;
  title: string;
  make(): Mesh;
}

export const examples: readonly Example[] = [
  { name: 'horseshoe', title: "The paper's horseshoe", make: () => generate.horseshoe() },
  { name: 'sparse', title: "The paper's sparse horseshoe", make: generate.sparse_horseshoe },
  { name: 'triangle', title: "The paper's single triangle", make: () => generate.single_triangle() },
  { name: 'annulus', title: 'An annulus of jittered rings', make: () => generate.annulus() },
  { name: 'airfoil', title: 'A box around an airfoil', make: () => generate.airfoil() },
  { name: 'random', title: '1000 random points', make: () => generate.random_mesh() },
  { name: 'grid', title: 'A sheared grid', make: () => generate.sheared_grid() },
  { name: 'graded', title: 'Graded random points', make: () => generate.graded_mesh() },
  { name: 'letter', title: 'A letter A: hard', make: generate.letter_a },
  { name: 'polygon', title: 'A regular polygon: hard', make: () => generate.regular_polygon() },
  { name: 'wedge', title: 'A sharp wedge: hard', make: () => generate.wedge() },
  { name: 'large', title: '20,000 random points', make: () => generate.random_mesh({ vertices: 20000 }) },
];

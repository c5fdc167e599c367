// What temper has written into the page: the report, and arrays packed as src/io/html_report.cpp says.
import { type MeshData, verdicts } from 'temper-viewer';
import { cut, middlePlane, type Tets } from './tets.ts';

/** The numbers of temper check --json. Infinite ones are null. */
export interface Quality {
  [key: string]: unknown;
  vertices: number;
  worst: Worst[];
  histograms: Record<string, Histogram>;
}
/** A row of the library's table of measures: what a number of Quality is. */
export interface Measure {
  key: string;
  label: string;
  /** Whose codes look at it; empty for those of primal-dual meshes as such. */
  community: string;
  definition: string;
  better: 'equal' | 'larger' | 'less';
  wanted: number | null;
}
export interface Worst {
  triangle?: number;
  tetrahedron?: number;
  why: string;
}
export interface Histogram {
  low: number;
  high: number;
  counts: number[];
}
export interface Sweep {
  sweep: number;
  energy: number | null;
  bad: number;
  flips: number;
  objective: string;
}
/** Why triangles are not well-centered, as temper explain has it. */
export interface Reason {
  kind: string;
  triangles: number[];
  text: string;
  cures: string[];
}
/** All that is known; a page shows what is there. */
export interface Report {
  verb?: string;
  version?: string;
  command?: string;
  before?: Quality;
  after?: Quality;
  history?: Sweep[];
  stopped?: string;
  sweeps?: number;
  errors?: { before: SolverReport; after: SolverReport };
  notes?: string[];
  warnings?: string[];
  reasons?: Reason[];
}
export interface SolverReport {
  errors: Record<string, Record<string, Record<string, number | null>>>;
}

/** A mesh with the user's numbers. Its elements are tetrahedra, if there are some, and else triangles. */
export interface Shown {
  /** What is drawn: of tetrahedra a cut. */
  mesh: MeshData;
  tets?: Tets;
  vertexNumbers?: Int32Array;
  elementNumbers?: Int32Array;
}

/** The exact verdict on each element. */
export const verdictsOf = (shown: Shown): Uint8Array => shown.tets?.verdicts ?? verdicts(shown.mesh);
export const countBad = (shown: Shown): number => verdictsOf(shown).reduce((n, bits) => n + (bits !== 0 ? 1 : 0), 0);

/** What elements are called. */
export interface Words {
  one: string;
  many: string;
  /** What their sides are called. */
  side: string;
}
export const wordsOf = (shown: Shown): Words =>
  shown.tets ? { one: 'tetrahedron', many: 'tetrahedra', side: 'face' } : { one: 'triangle', many: 'triangles', side: 'edge' };

type Numbers = Float64Array | Int32Array | Uint8Array;

async function unpack(element: HTMLElement): Promise<Numbers> {
  const type = element.dataset.type, length = Number(element.dataset.length), delta = Number(element.dataset.delta);
  const text = atob(element.textContent ?? '');
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) packed[i] = text.charCodeAt(i);
  element.remove(); // the text is as large as the arrays
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  if (type === 'uint8') return planes;
  const each = type === 'float64' ? 8 : 4;
  const bytes = new Uint8Array(length * each);
  for (let b = 0; b < each; b++) {
    const plane = b * length;
    for (let i = 0, at = b; i < length; i++, at += each) bytes[at] = planes[plane + i];
  }
  if (type === 'float64') return new Float64Array(bytes.buffer);
  const numbers = new Int32Array(bytes.buffer);
  for (let i = 0; i < length; i++) {
    const step = (numbers[i] >>> 1) ^ -(numbers[i] & 1);
    numbers[i] = i < delta ? step : numbers[i - delta] + step;
  }
  return numbers;
}

/** The arrays of one mesh; null: there is none. */
export async function readMesh(side: string): Promise<Shown | null> {
  const read = async <T extends Numbers>(name: string): Promise<T | undefined> => {
    const element = document.getElementById(`${side}.${name}`);
    return element ? ((await unpack(element)) as T) : undefined;
  };
  const points = await read<Float64Array>('points');
  if (!points) return null;
  const weights = await read<Float64Array>('weights'), regions = await read<Int32Array>('regions');
  const tetrahedra = await read<Int32Array>('tetrahedra'), vertexNumbers = await read<Int32Array>('vertex_numbers');
  if (tetrahedra) {
    const tets = { points, weights, tetrahedra, verdicts: (await read<Uint8Array>('verdicts')) ?? new Uint8Array(0), regions };
    const elementNumbers = await read<Int32Array>('tetrahedron_numbers');
    return { mesh: cut(tets, middlePlane(tets)), tets, vertexNumbers, elementNumbers };
  }
  return {
    mesh: {
      points,
      weights,
      triangles: (await read<Int32Array>('triangles')) ?? new Int32Array(0),
      verdicts: await read<Uint8Array>('verdicts'),
      regions,
      constrained: await read<Uint8Array>('constrained'),
    },
    vertexNumbers,
    elementNumbers: await read<Int32Array>('triangle_numbers'),
  };
}

const readJson = (id: string, missing: string): unknown => JSON.parse(document.getElementById(id)?.textContent ?? missing);
export const readReport = (): Report => readJson('report', '{}') as Report;
export const readMeasures = (): Measure[] => readJson('measures', '[]') as Measure[];

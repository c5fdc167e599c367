// The numbers beside the mesh.
import type { Explanation, Mesh, Quality } from 'temper-mesh';
import { triangleNumbers, type MeshData } from 'temper-viewer';

type Cell = string | { text: string; bad: boolean };

function fill(table: HTMLElement, rows: [string, ...Cell[]][]): void {
  table.replaceChildren(
    ...rows.map(([title, ...cells]) => {
      const row = document.createElement('tr');
      const head = document.createElement('th');
      head.scope = 'row';
      head.textContent = title;
      row.append(head);
      for (const cell of cells) {
        const data = document.createElement('td');
        data.textContent = typeof cell === 'string' ? cell : cell.text;
        if (typeof cell !== 'string' && cell.bad) data.className = 'bad';
        row.append(data);
      }
      return row;
    }),
  );
}

const short = (value: number): string =>
  Number.isFinite(value) ? Number(value.toPrecision(5)).toString() : value > 0 ? '∞' : value < 0 ? '−∞' : '—';
const count = (value: number): Cell => ({ text: String(value), bad: value > 0 });

/** Triangles that are not well-centered. */
export const badOf = (q: Quality): number => Math.round((1 - q.well_centered_fraction) * q.triangles);

export function showQuality(table: HTMLElement, q: Quality): void {
  fill(table, [
    ['vertices', String(q.vertices)],
    ['triangles', String(q.triangles)],
    ['bad', count(badOf(q))],
    ['edges not regular', count(q.non_regular_edges)],
    ['least h/ℓ', { text: short(q.min_h_over_l), bad: !(q.min_h_over_l > 0) }],
    ['least d/ℓ', { text: short(q.min_d_over_l), bad: !(q.min_d_over_l > 0) }],
    ['angles', `${short(q.min_angle_deg)}° to ${short(q.max_angle_deg)}°`],
  ]);
}

export function showEnergies(table: HTMLElement, q: Quality): void {
  fill(table, [
    ['', '★0', '★1', '★2'],
    ...Object.entries(q.energy).map(([name, stars]): [string, ...Cell[]] => [`E ${name}`, ...stars.map((value) => ({ text: short(value), bad: value === Infinity }))]),
  ]);
}

/** The numbers of a triangle, edge by edge. */
export function showTriangle(table: HTMLElement, mesh: MeshData, triangle: number): void {
  const n = triangleNumbers(mesh, triangle);
  const over = (values: number[]): Cell[] =>
    values.map((value, k) => ({ text: short(value / n.length[k]), bad: !(value > 0) }));
  fill(table, [
    ['corner', ...n.vertices.map(String)],
    ['weight', ...n.weight.map(short)],
    ['angle', ...n.angle.map((angle) => `${short(angle)}°`)],
    ['h/ℓ of the edge from it', ...over(n.height)],
    ['d/ℓ', ...n.crossing.map((d, k): Cell => ({ text: short(d / n.length[k]), bad: !(d > 0 && d < n.length[k]) }))],
  ]);
}

/** The reason why a triangle is not well-centered, in the words of the library; null: it is. */
export function whyOf(q: Quality, mesh: Mesh, triangle: number, measure: (worst: number) => Quality): string | null {
  const bad = badOf(q);
  if (bad === 0 || triangle >= mesh.n_triangles) return null;
  return measure(bad).worst.find((w) => w.triangle === triangle)?.why ?? null;
}

/** The reason of a triangle with its cures, or what is said while there is none. */
export function showReason(section: HTMLElement, from: { explanation: Explanation | null; said: string } | null, triangle: number): void {
  const line = (tag: 'p' | 'li', text: string): HTMLElement => Object.assign(document.createElement(tag), { textContent: text });
  section.replaceChildren();
  if (!from?.explanation) {
    if (from?.said) section.append(line('p', from.said));
    return;
  }
  const reason = from.explanation.reasons.find(({ triangles }) => triangles.includes(triangle));
  if (!reason) return;
  section.append(line('p', reason.text));
  const cures = document.createElement('ul');
  cures.append(...reason.cures.map(({ text }) => line('li', text)));
  if (reason.cures.length > 0) section.append(cures);
}

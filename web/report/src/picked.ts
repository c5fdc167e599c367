// The picked triangle: its numbers, and why it is not well-centered.
import { triangleNumbers, Verdict, verdicts } from 'temper-viewer';
import type { Reason, Report, Shown, Worst } from './data.ts';
import { byId, make, number, table } from './html.ts';

export const vertexName = (shown: Shown, v: number): string => String(shown.vertexNumbers?.[v] ?? v);
export const triangleName = (shown: Shown, t: number): string => String(shown.triangleNumbers?.[t] ?? t);

interface Picked {
  shown: Shown;
  side: 'before' | 'after';
  triangle: number;
  compares: boolean;
}

const cell = (value: number, bad: boolean, unit = ''): HTMLElement =>
  make('td', { class: bad ? 'is-bad' : '' }, number(value) + unit + (bad ? ' ✕' : ''));

export function showPicked(picked: Picked | null, report: Report, close: () => void): void {
  const section = byId('picked');
  section.replaceChildren();
  if (!picked) return;
  const { shown, triangle: t, side } = picked;
  const n = triangleNumbers(shown.mesh, t), bits = verdicts(shown.mesh)[t];
  const name = (k: number): string => vertexName(shown, n.vertices[k % 3]);
  const edges = [0, 1, 2].map((k) => {
    const outside = (bits & (Verdict.outside[k] | Verdict.inverted)) !== 0, notCrossed = (bits & Verdict.notCrossed[k]) !== 0;
    return [`${name(k)}–${name(k + 1)}`, number(n.length[k]), cell(n.height[k], outside), cell(n.crossing[k], notCrossed),
      cell(n.height[k] / n.length[k], outside), cell(n.crossing[k] / n.length[k], notCrossed)];
  });
  const corners = [0, 1, 2].map((k) => [name(k), number(shown.mesh.points[2 * n.vertices[k]], 6), number(shown.mesh.points[2 * n.vertices[k] + 1], 6),
    number(n.weight[k]), `${number(n.angle[k])}°`]);
  const region = shown.mesh.regions ? [['Region', number(shown.mesh.regions[t])]] : [];
  section.append(
    make('h2', {}, `Triangle ${triangleName(shown, t)}${picked.compares ? `, ${side}` : ''}`, make('button', { type: 'button', onclick: close }, 'Close')),
    ...whyOf(picked, bits, name, report),
    table(['edge', 'ℓ', 'h', 'd', 'h/ℓ', 'd/ℓ'], edges),
    table(['vertex', 'x', 'y', 'weight', 'angle'], corners),
    table([], [['Orthocenter', `${number(n.orthocenter.x, 6)}, ${number(n.orthocenter.y, 6)}`], ['Area', number(n.area)], ...region]),
  );
}

/** The conditions that fail, the sentence of the report, and the reason of temper explain: what there is of them. */
function whyOf(picked: Picked, bits: number, name: (k: number) => string, report: Report): HTMLElement[] {
  if (bits === 0) return [make('div', { class: 'why good' }, 'Well-centered: the orthocenter is inside, and each edge is crossed by its dual.')];
  const fails: string[] = [];
  if (bits & Verdict.inverted) fails.push('Its corners do not turn counter-clockwise.');
  for (let k = 0; k < 3; k++) {
    const edge = `${name(k)}–${name(k + 1)}`;
    if (bits & Verdict.outside[k]) fails.push(`h ≤ 0 at edge ${edge}: the orthocenter is not inside of it.`);
    if (bits & Verdict.notCrossed[k]) fails.push(`d is not between 0 and ℓ at edge ${edge}: its dual does not cross it.`);
  }
  const parts: HTMLElement[] = [make('div', { class: 'why' }, ...fails.map((each) => make('p', {}, each)))];
  const reason = picked.side === 'after' ? report.reasons?.find((r: Reason) => r.triangles.includes(picked.triangle)) : undefined;
  if (reason) {
    parts.push(make('details', { open: true }, make('summary', {}, 'Why, and what would help'), make('p', {}, reason.text),
      ...(reason.cures.length > 0 ? [make('ul', {}, ...reason.cures.map((cure) => make('li', {}, cure)))] : [])));
    return parts;
  }
  const sentence = report[picked.side]?.worst.find((w: Worst) => w.triangle === picked.triangle)?.why;
  if (sentence) parts[0].append(make('p', { class: 'note' }, `${sentence[0].toUpperCase()}${sentence.slice(1)}.`));
  return parts;
}

// The picked element: its numbers, and why it is not well-centered.
import { triangleNumbers, Verdict } from 'temper-viewer';
import { type Reason, type Report, type Shown, verdictsOf, wordsOf, type Worst } from './data.ts';
import { byId, capital, make, number, table } from './html.ts';
import { kFaces, type Tets, tetNumbers } from './tets.ts';

export const vertexName = (shown: Shown, v: number): string => String(shown.vertexNumbers?.[v] ?? v);
export const elementName = (shown: Shown, t: number): string => String(shown.elementNumbers?.[t] ?? t);

interface Picked {
  shown: Shown;
  side: 'before' | 'after';
  element: number;
  compares: boolean;
}

const cell = (value: number, bad: boolean, unit = ''): HTMLElement =>
  make('td', { class: bad ? 'is-bad' : '' }, number(value) + unit + (bad ? ' ✕' : ''));

export function showPicked(picked: Picked | null, report: Report, close: () => void): void {
  const section = byId('picked');
  section.replaceChildren();
  if (!picked) return;
  const { shown, element, side } = picked;
  section.append(
    make('h2', {}, `${capital(wordsOf(shown).one)} ${elementName(shown, element)}${picked.compares ? `, ${side}` : ''}`, make('button', { type: 'button', onclick: close }, 'Close')),
    ...(shown.tets ? tetrahedronTables(picked, shown.tets, report) : triangleTables(picked, report)),
  );
}

const regionRow = (regions: Int32Array | undefined, t: number): string[][] => (regions ? [['Region', number(regions[t])]] : []);

function tetrahedronTables(picked: Picked, tets: Tets, report: Report): HTMLElement[] {
  const { shown, element: t } = picked;
  const n = tetNumbers(tets, t), bits = tets.verdicts[t];
  const name = (k: number): string => vertexName(shown, n.vertices[k]);
  const fails: string[] = bits & Verdict.inverted ? ['Its volume is not positive.'] : [];
  const faces = kFaces.map((corners, f) => {
    const face = corners.map(name).join('–'), outside = (bits & ((1 << f) | Verdict.inverted)) !== 0;
    if (bits & (1 << f)) fails.push(`h ≤ 0 at face ${face}: the orthocenter is not inside of it.`);
    return [face, number(n.length[f]), cell(n.height[f], outside), cell(n.height[f] / n.length[f], outside)];
  });
  const corners = n.points.map((p, k) => [name(k), ...p.map((x) => number(x, 6)), number(n.weight[k])]);
  return [
    ...whyOf(picked, bits === 0 ? [] : fails, 'Well-centered: the orthocenter is inside.', report),
    table(['face', 'ℓ', 'h', 'h/ℓ'], faces),
    table(['vertex', 'x', 'y', 'z', 'weight'], corners),
    table([], [['Orthocenter', n.orthocenter.map((x) => number(x, 6)).join(', ')], ['Volume', number(n.volume)],
      ['Largest dihedral angle', `${number(n.dihedral)}°`], ...regionRow(tets.regions, t)]),
  ];
}

function triangleTables(picked: Picked, report: Report): HTMLElement[] {
  const { shown, element: t } = picked;
  const n = triangleNumbers(shown.mesh, t), bits = verdictsOf(shown)[t];
  const name = (k: number): string => vertexName(shown, n.vertices[k % 3]);
  const fails: string[] = bits & Verdict.inverted ? ['Its corners do not turn counter-clockwise.'] : [];
  const edges = [0, 1, 2].map((k) => {
    const edge = `${name(k)}–${name(k + 1)}`;
    const outside = (bits & (Verdict.outside[k] | Verdict.inverted)) !== 0, notCrossed = (bits & Verdict.notCrossed[k]) !== 0;
    if (bits & Verdict.outside[k]) fails.push(`h ≤ 0 at edge ${edge}: the orthocenter is not inside of it.`);
    if (notCrossed) fails.push(`d is not between 0 and ℓ at edge ${edge}: its dual does not cross it.`);
    return [edge, number(n.length[k]), cell(n.height[k], outside), cell(n.crossing[k], notCrossed),
      cell(n.height[k] / n.length[k], outside), cell(n.crossing[k] / n.length[k], notCrossed)];
  });
  const corners = [0, 1, 2].map((k) => [name(k), number(shown.mesh.points[2 * n.vertices[k]], 6), number(shown.mesh.points[2 * n.vertices[k] + 1], 6),
    number(n.weight[k]), `${number(n.angle[k])}°`]);
  return [
    ...whyOf(picked, fails, 'Well-centered: the orthocenter is inside, and each edge is crossed by its dual.', report),
    table(['edge', 'ℓ', 'h', 'd', 'h/ℓ', 'd/ℓ'], edges),
    table(['vertex', 'x', 'y', 'weight', 'angle'], corners),
    table([], [['Orthocenter', `${number(n.orthocenter.x, 6)}, ${number(n.orthocenter.y, 6)}`], ['Area', number(n.area)], ...regionRow(shown.mesh.regions, t)]),
  ];
}

/** The conditions that fail, the sentence of the report, and the reason of temper explain: what there is of them. */
function whyOf(picked: Picked, fails: string[], good: string, report: Report): HTMLElement[] {
  if (fails.length === 0) return [make('div', { class: 'why good' }, good)];
  const parts: HTMLElement[] = [make('div', { class: 'why' }, ...fails.map((each) => make('p', {}, each)))];
  const reason = picked.side === 'after' ? report.reasons?.find((r: Reason) => r.triangles.includes(picked.element)) : undefined;
  if (reason) {
    parts.push(make('details', { open: true }, make('summary', {}, 'Why, and what would help'), make('p', {}, reason.text),
      ...(reason.cures.length > 0 ? [make('ul', {}, ...reason.cures.map((cure) => make('li', {}, cure)))] : [])));
    return parts;
  }
  const sentence = report[picked.side]?.worst.find((w: Worst) => (w.tetrahedron ?? w.triangle) === picked.element)?.why;
  if (sentence) parts[0].append(make('p', { class: 'note' }, `${sentence[0].toUpperCase()}${sentence.slice(1)}.`));
  return parts;
}

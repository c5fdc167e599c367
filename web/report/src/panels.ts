// The panels beside the mesh. Each fills its section from the report, or leaves it empty, which hides it.
import { histogram, series } from './charts.ts';
import type { Measure, Quality, Report, Words } from './data.ts';
import { byId, capital, make, number, plural, table } from './html.ts';

const kHistograms: [string, (words: Words) => string, number | undefined][] = [
  ['angles', () => 'Angles of triangles, in degrees', undefined],
  ['dihedrals', () => 'Dihedral angles, in degrees', undefined],
  ['h_over_l', ({ many, side }) => `h/ℓ of ${many} over their ${side}s`, 0],
  ['d_over_l', () => 'd/ℓ of edges, the lesser part', 0],
];

export function headline(report: Report, title: string, bad: { before?: number; after: number }, elements: number, { one, many }: Words): void {
  byId('title').textContent = title;
  byId('verb').textContent = report.verb ?? '';
  byId('version').textContent = report.version ?? '';
  const verdict = byId('verdict');
  verdict.className = bad.after === 0 ? 'good' : 'bad';
  verdict.textContent =
    bad.after === 0
      ? `All ${plural(elements, `${one} is`, `${many} are`)} well-centered`
      : `${number(bad.after)} of ${plural(elements, `${one} is`, `${many} are`)} bad (not well-centered)`;
  if (bad.before !== undefined) verdict.append(make('small', {}, `before: ${number(bad.before)} were bad`));
}

/** The least margins: a triangle is bad where one is not positive. Tetrahedra are judged by h alone. */
const kMargins = ['min_h_over_l', 'min_d_over_l'];
/** What tetrahedra may miss without being bad. */
const kNotAsked = ['faces_not_crossed', 'edges_not_crossed', 'completely_well_centered_fraction', 'min_d_over_l'];

/** Whether a number is not what is asked for where nobody says more. */
function misses(measure: Measure, value: unknown, isOfTetrahedra: boolean): boolean {
  const { better, wanted, key } = measure;
  if (value === null || (isOfTetrahedra && kNotAsked.includes(key))) return false;
  if (kMargins.includes(key)) return Number(value) <= 0;
  if (wanted === null) return false;
  const found = Number(value);
  return better === 'larger' ? found < wanted : better === 'less' ? found > wanted : found !== wanted;
}

/** Infinite: of what is to be large nothing was there to be measured. */
const measured = (measure: Measure, value: unknown): string => (value === null && measure.better === 'larger' ? '–' : number(value));

/** A label with spaces before it goes on from the row above. */
function title({ label, definition }: Measure): HTMLElement {
  const continues = label.startsWith(' ');
  return make('th', { scope: 'row', class: continues ? 'continued' : '', title: definition }, continues ? label.trim() : capital(label));
}

/** The measures of meshes as such, and, folded up, those of each community that runs codes on them. */
export function summary(report: Report, measures: Measure[], isOfTetrahedra: boolean): void {
  const { before, after } = report;
  if (!after) return;
  const cell = (quality: Quality, measure: Measure, old: boolean): HTMLElement => {
    const value = quality[measure.key];
    return make('td', { class: misses(measure, value, isOfTetrahedra) ? 'is-bad' : old ? 'was' : '' }, measured(measure, value));
  };
  const row = (measure: Measure): (HTMLElement | string)[] => [
    title(measure),
    ...(before ? [cell(before, measure, true)] : []),
    cell(after, measure, false),
  ];
  const head = before ? ['', 'before', 'after'] : [];
  byId('summary').append(make('h2', {}, 'Measures'));
  for (const community of new Set(measures.map((m) => m.community))) {
    const rows = measures.filter((m) => m.community === community && m.key in after);
    if (rows.length === 0) continue;
    const shown = table(head, rows.map(row));
    byId('summary').append(community === '' ? shown : make('details', {}, make('summary', {}, capital(community)), shown));
  }
}

export function histograms(report: Report, words: Words): void {
  const { before, after } = report;
  if (!after?.histograms) return;
  const section = byId('histograms');
  section.append(make('h2', {}, 'Histograms'));
  if (before) {
    const swatch = (color: string): HTMLElement => make('span', { class: 'swatch', style: `background:var(--${color})` });
    section.append(make('div', { class: 'key' }, make('span', {}, swatch('before'), 'before'), make('span', {}, swatch('accent'), 'after')));
  }
  for (const [key, label, bad] of kHistograms) {
    const of = after.histograms[key];
    if (of) section.append(make('h3', {}, label(words)), histogram(label(words), of, before?.histograms?.[key], bad));
  }
}

export function sweeps(report: Report, { many }: Words): void {
  const history = report.history ?? [];
  if (history.length < 2) return;
  const section = byId('sweeps');
  const count = report.sweeps === undefined ? '' : `: ${plural(report.sweeps, 'sweep', 'sweeps')}`;
  section.append(make('h2', {}, `By sweep${count}`));
  if (report.stopped) section.append(make('p', { class: 'note' }, `The run ended: ${report.stopped.replaceAll('_', ' ')}.`));
  const numbers = history.map((_, i) => i);
  const charts: [string, string, (number | null)[]][] = [
    ['Energy', 'energy', history.map((s) => s.energy)],
    [`Bad ${many}`, 'bad', history.map((s) => s.bad)],
    ['Flips', 'flips', history.map((s) => s.flips)],
  ];
  for (const [label, name, values] of charts) section.append(make('h3', {}, label), series(`${label} by sweep`, name, numbers, values));
}

export function solverErrors(report: Report): void {
  const before = report.errors?.before.errors?.mean?.all, after = report.errors?.after.errors?.mean?.all;
  if (!before || !after) return;
  const rows: (string | HTMLElement)[][] = [];
  for (const [solver, norms] of Object.entries(after as unknown as Record<string, Record<string, number | null>>)) {
    for (const [norm, value] of Object.entries(norms)) {
      const old = (before as unknown as Record<string, Record<string, number | null>>)[solver]?.[norm] ?? null;
      const ratio = old && value !== null ? value / old : null;
      const style = ratio === null || Math.abs(ratio - 1) < 0.005 ? '' : ratio > 1 ? 'is-bad' : 'is-good';
      rows.push([`${solver}, ${norm === 'l2' ? 'L²' : norm}`, make('td', { class: 'was' }, number(old, 3)), number(value, 3),
        make('td', { class: style }, ratio === null ? '–' : number(ratio, 3))]);
    }
  }
  byId('errors').append(make('h2', {}, 'Relative errors of solvers, in the mean'), table(['', 'before', 'after', 'ratio'], rows));
}

export function again(report: Report): void {
  const command = report.command;
  if (!command) return;
  const button = make('button', { type: 'button', onclick: () => void copy(command, button) }, 'Copy');
  byId('again').append(make('h2', {}, 'To run it again'), make('pre', {}, command), button);
}

/** The clipboard is not there for every page that is a file: then the words are selected. */
async function copy(text: string, button: HTMLElement): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    button.textContent = 'Copied';
  } catch {
    const words = button.previousElementSibling;
    if (words) getSelection()?.selectAllChildren(words);
    button.textContent = 'Selected: press Ctrl C';
  }
  setTimeout(() => (button.textContent = 'Copy'), 2000);
}

export function remarks(report: Report): void {
  const all = [...(report.warnings ?? []), ...(report.notes ?? [])];
  if (all.length === 0) return;
  byId('remarks').append(make('h2', {}, 'Notes and warnings'), make('ul', {}, ...all.map((each) => make('li', {}, each))));
}

const keyTable = ({ one }: Words, layers: number): [string, string][] => [
  ['← ↑ → ↓', 'move, with Shift farther'],
  ['+ −', 'zoom in, out'],
  ['0', 'the whole mesh'],
  ['x y z', 'cut across this axis'],
  ['[ ]', 'move the plane of the cut'],
  ['Enter', `pick the ${one} in the middle`],
  ['Esc', 'pick none'],
  ['n p', 'next, previous of the worst'],
  ['b a s', 'before, after, both by the divider'],
  [`1 … ${layers}`, 'layers on and off'],
  ['c', 'next color'],
];

export function keys(words: Words, layers: number, { compares, cuts }: { compares: boolean; cuts: boolean }): void {
  const rows = keyTable(words, layers).filter(([key]) => (compares || key !== 'b a s') && (cuts || !['x y z', '[ ]'].includes(key)));
  byId('keys').append(
    make('details', {}, make('summary', {}, 'Keys'),
      table([], rows.map(([names, words]) => [make('th', { scope: 'row' }, ...names.split(' ').flatMap((k) => (k === '…' ? [' … '] : [make('kbd', {}, k), ' ']))), make('td', { class: 'text' }, words)])),
    ),
  );
}

// The options as a form: target, effort and boundary first, then all others by group, from the tables in the library.
import { type OptimizeArguments, type OptimizeOptions, option_table, options_for, type OptionRow, type Preset, presets } from 'temper-mesh';

const kFirst = ['boundary'];

type Control = HTMLInputElement | HTMLSelectElement;
export type Given = Pick<OptimizeArguments, 'target' | 'effort' | 'options'>;

export class OptionsForm {
  private readonly controls = new Map<string, { row: OptionRow; input: Control }>();
  private readonly target: HTMLSelectElement;
  private readonly effort: HTMLSelectElement;
  /** The options of target and effort. */
  private base = options_for() as unknown as Record<string, unknown>;

  constructor(first: HTMLElement, all: HTMLElement) {
    const words = presets();
    this.target = this.addWords(first, 'target', words.target, 'any');
    this.effort = this.addWords(first, 'effort', words.effort, 'normal');
    const rows = option_table();
    for (const name of kFirst) this.addOption(first, rows.find((row) => row.name === name)!);
    let group = '';
    for (const row of rows) {
      if (kFirst.includes(row.name)) continue;
      if (row.group !== group) {
        group = row.group;
        const title = document.createElement('h3');
        title.textContent = group;
        all.append(title);
      }
      this.addOption(all, row);
    }
  }

  /** Target, effort, and the options that differ from theirs. */
  get given(): Given {
    const target = this.target.value as Given['target'], effort = this.effort.value as Given['effort'];
    return { target, effort, options: this.changes as OptimizeOptions };
  }

  private get changes(): Record<string, unknown> {
    const changes: Record<string, unknown> = {};
    for (const [name, { row, input }] of this.controls) {
      const value = valueOf(row, input, this.base[name]);
      if (JSON.stringify(value) !== JSON.stringify(this.base[name])) changes[name] = value;
    }
    return changes;
  }

  /** Shows the options of another target or effort. Options that differed from the previous ones keep their values. */
  private settle(): void {
    const changes = this.changes, { target, effort } = this.given;
    try {
      this.base = options_for(target, effort) as unknown as Record<string, unknown>;
    } catch {
      return; // the two contradict each other, and the run will say so
    }
    for (const [name, { input }] of this.controls) input.value = shown(name in changes ? changes[name] : this.base[name]);
  }

  private addWords(to: HTMLElement, name: string, words: Preset[], chosen: string): HTMLSelectElement {
    const select = document.createElement('select');
    for (const word of words) select.add(new Option(word.name, word.name));
    select.value = chosen;
    select.addEventListener('change', () => this.settle());
    add(to, name, select, words.map((word) => `${word.name}: ${word.sentence}`).join('\n'));
    return select;
  }

  private addOption(to: HTMLElement, row: OptionRow): void {
    const input = row.choices.length > 0 ? selectOf(row) : inputOf(row);
    input.value = shown(row.default);
    this.controls.set(row.name, { row, input });
    const range = row.choices.length === 0 && row.range ? `; ${row.range}` : '';
    const absent = row.optional && row.absent ? `. Empty: ${row.absent}` : '';
    add(to, row.name, input, `${row.sentence}${range}${absent}.`);
  }
}

function add(to: HTMLElement, name: string, input: Control, title: string): void {
  input.id = `option-${name}`;
  const label = document.createElement('label');
  label.htmlFor = input.id;
  label.textContent = name.replaceAll('_', ' ');
  label.title = input.title = title;
  to.append(label, input);
}

/** The text of a value. A LengthParameter is shown as a number. */
function shown(value: unknown): string {
  if (value === null) return '';
  return String(typeof value === 'object' ? (value as { value: number }).value : value);
}

function selectOf(row: OptionRow): HTMLSelectElement {
  const select = document.createElement('select');
  if (row.optional) select.add(new Option('—', ''));
  for (const choice of row.choices) select.add(new Option(String(choice).replaceAll('_', ' '), String(choice)));
  return select;
}

function inputOf(row: OptionRow): HTMLInputElement {
  const input = document.createElement('input');
  input.type = 'number';
  input.step = 'any';
  input.placeholder = row.optional ? 'automatic' : '';
  return input;
}

/** The value of a control; `base` if the control shows it. A plain number is relative to each edge, as in the library. */
function valueOf(row: OptionRow, input: Control, base: unknown): unknown {
  if (input.value === shown(base)) return base;
  if (input.value === '') return row.optional ? null : base;
  if (input instanceof HTMLInputElement) return Number(input.value);
  return row.choices.find((choice) => String(choice) === input.value);
}

// The options as a form: the few that matter first, all others by their groups, made from the table in the library.
import { type OptimizeOptions, option_table, type OptionRow } from 'temper-mesh';

const kFirst = ['target', 'objective', 'boundary', 'repair', 'energy', 'max_sweeps'];

export class OptionsForm {
  private readonly controls = new Map<string, { row: OptionRow; input: HTMLInputElement | HTMLSelectElement }>();

  constructor(first: HTMLElement, all: HTMLElement) {
    const rows = option_table();
    for (const name of kFirst) this.add(first, rows.find((row) => row.name === name)!);
    let group = '';
    for (const row of rows) {
      if (kFirst.includes(row.name)) continue;
      if (row.group !== group) {
        group = row.group;
        const title = document.createElement('h3');
        title.textContent = group;
        all.append(title);
      }
      this.add(all, row);
    }
  }

  /** Those that are not as by default. */
  get values(): OptimizeOptions {
    const given: Record<string, unknown> = {};
    for (const [name, { row, input }] of this.controls) {
      const value = valueOf(row, input);
      if (JSON.stringify(value) !== JSON.stringify(row.default)) given[name] = value;
    }
    return given as OptimizeOptions;
  }

  private add(to: HTMLElement, row: OptionRow): void {
    const input = row.choices.length > 0 ? selectOf(row) : inputOf(row);
    input.id = `option-${row.name}`;
    const label = document.createElement('label');
    label.htmlFor = input.id;
    label.textContent = row.name.replaceAll('_', ' ');
    label.title = input.title = [row.sentence, row.range && row.choices.length === 0 && `${row.range}`, row.optional && row.absent && `empty: ${row.absent}`]
      .filter(Boolean)
      .join('; ');
    this.controls.set(row.name, { row, input });
    to.append(label, input);
  }
}

/** A length_parameter is a number here, relative to each edge, as a plain number is in the library. */
function shown(value: unknown): string {
  if (value === null) return '';
  return String(typeof value === 'object' ? (value as { value: number }).value : value);
}

function selectOf(row: OptionRow): HTMLSelectElement {
  const select = document.createElement('select');
  if (row.optional) select.add(new Option('—', ''));
  for (const choice of row.choices) select.add(new Option(String(choice).replaceAll('_', ' '), String(choice)));
  select.value = shown(row.default);
  return select;
}

function inputOf(row: OptionRow): HTMLInputElement {
  const input = document.createElement('input');
  if (row.type === 'boolean') {
    input.type = 'checkbox';
    input.checked = row.default === true;
  } else {
    input.type = 'number';
    input.step = 'any';
    input.value = shown(row.default);
    input.placeholder = row.optional ? 'automatic' : '';
  }
  return input;
}

function valueOf(row: OptionRow, input: HTMLInputElement | HTMLSelectElement): unknown {
  if (input instanceof HTMLInputElement && input.type === 'checkbox') return input.checked;
  if (input.value === shown(row.default)) return row.default;
  if (input.value === '') return row.optional ? null : row.default;
  if (input instanceof HTMLInputElement) return Number(input.value);
  return row.choices.find((choice) => String(choice) === input.value);
}

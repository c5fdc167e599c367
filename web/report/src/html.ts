// Elements, and numbers as people read them.

type Child = Node | string;

/** An element with attributes (on… are listeners) and children. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | number | boolean | ((event: Event) => void)> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value);
    else if (value !== false) element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(...children);
  return element;
}

export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`the page has no element ${id}`);
  return element;
}

/** A number in four digits or so, with a real minus; "∞" where it is not finite. */
export function number(value: unknown, digits = 4): string {
  if (value === null || value === undefined) return '∞';
  const x = Number(value);
  if (!Number.isFinite(x)) return x < 0 ? '−∞' : x > 0 ? '∞' : '–';
  if (Number.isInteger(x) && Math.abs(x) < 1e15) return x.toLocaleString('en').replace('-', '−');
  const size = Math.abs(x);
  const text = size >= 1e6 || size < 1e-4 ? x.toExponential(digits - 1) : String(Number(x.toPrecision(digits)));
  const [mantissa, exponent] = text.split('e');
  const raised = (exponent ?? '').replace('+', '').replace(/./g, (c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'.charAt(Number(c))));
  return mantissa.replace('-', '−') + (raised && `·10${raised}`);
}

export const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);
export const plural = (n: number, one: string, many: string): string => `${number(n)} ${n === 1 ? one : many}`;

/** Rows of cells as a table; the first cell of each is its name. */
export function table(head: string[], rows: Child[][], rowAttributes: (i: number) => Record<string, string | number | ((event: Event) => void)> = () => ({})): HTMLTableElement {
  const cells = (row: Child[]): HTMLElement[] =>
    row.map((cell, i) => (cell instanceof HTMLTableCellElement ? cell : make(i === 0 ? 'th' : 'td', i === 0 ? { scope: 'row' } : {}, cell)));
  return make(
    'table',
    {},
    ...(head.length > 0 ? [make('thead', {}, make('tr', {}, ...head.map((cell) => make('th', { scope: 'col' }, cell))))] : []),
    make('tbody', {}, ...rows.map((row, i) => make('tr', rowAttributes(i), ...cells(row)))),
  );
}

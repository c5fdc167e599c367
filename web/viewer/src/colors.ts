// Colors: those of the layers in light and dark, and maps from values to colors. Amounts go from
// blue to yellow with growing lightness, as in the pictures of `temper draw`; bright is good. Kinds go by the eight hues of Okabe and Ito, without the one of bad triangles.
import { type Measure, quantiles } from './measures.ts';

export interface Theme {
  background: string;
  /** Triangles when they are not colored by a measure. */
  fill: string;
  primal: string;
  dual: string;
  boundary: string;
  constrained: string;
  bad: string;
  positiveWeight: string;
  negativeWeight: string;
  orthocenter: string;
  selection: string;
}

export const lightTheme: Theme = {
  background: '#ffffff',
  fill: '#f3f4f6',
  primal: '#5b6472',
  dual: '#0b6fb8',
  boundary: '#1d232b',
  constrained: '#1d232b',
  bad: '#d5450a',
  positiveWeight: '#00866b',
  negativeWeight: '#9a4f96',
  orthocenter: '#0b4f86',
  selection: '#111418',
};

export const darkTheme: Theme = {
  background: '#14171b',
  fill: '#20252c',
  primal: '#8b95a3',
  dual: '#6db8f2',
  boundary: '#e8ebef',
  constrained: '#e8ebef',
  bad: '#ff7a3d',
  positiveWeight: '#3fcfae',
  negativeWeight: '#d590d0',
  orthocenter: '#a5d4f7',
  selection: '#ffffff',
};

/** As kScaleColors of src/draw/panel.hpp. */
const kAmountColors = ['#7690c8', '#8ba1cc', '#9fb3d0', '#b3c5d3', '#c6d7d6', '#d5e2d2', '#e1e6c6', '#eceaba', '#f6eead', '#fff2a0'];

const kKindColors = ['#56b4e9', '#009e73', '#f0e442', '#0072b2', '#cc79a7', '#e69f00', '#9aa4b2', '#6b4f9e'];

/** "#rrggbb" or "rgb(r, g, b)" as numbers from 0 to 1. */
export function rgb(color: string): [number, number, number] {
  if (color.startsWith('#')) {
    const whole = parseInt(color.slice(1), 16);
    return [(whole >> 16) / 255, ((whole >> 8) & 255) / 255, (whole & 255) / 255];
  }
  const [r, g, b] = (color.match(/[\d.]+/g) ?? ['0', '0', '0']).map(Number);
  return [r / 255, g / 255, b / 255];
}

/** From 0, dark, to 1, bright. */
function amountColor(part: number): string {
  const at = part * (kAmountColors.length - 1), below = Math.min(kAmountColors.length - 2, Math.floor(at));
  const from = rgb(kAmountColors[below]), to = rgb(kAmountColors[below + 1]);
  return `rgb(${from.map((c, i) => Math.round(255 * (c + (at - below) * (to[i] - c)))).join(', ')})`;
}

/** From values to colors. */
export interface ColorScale {
  measure: Measure;
  low: number;
  high: number;
  /** Of kinds: their values, ascending. */
  kinds: number[];
  color(value: number): string;
}

/** The scale for a measure of these values: of several meshes, when they are compared. */
export function scaleOf(measure: Measure, values: readonly Float32Array[]): ColorScale {
  if (measure.kinds) {
    const all = new Set<number>();
    for (const list of values) for (const value of list) all.add(value);
    const kinds = [...all].sort((a, b) => a - b);
    const color = (value: number): string => kKindColors[Math.max(0, kinds.indexOf(value)) % kKindColors.length];
    return { measure, low: 0, high: kinds.length, kinds, color };
  }
  const ends = values.filter((list) => list.length > 0).map((list) => quantiles(list, [0.005, 0.995]));
  const low = measure.low ?? Math.min(...ends.map((e) => e[0]));
  const high = measure.high ?? Math.max(...ends.map((e) => e[1]));
  const color = (value: number): string => {
    const part = high > low ? (value - low) / (high - low) : 0.5;
    const bright = Number.isFinite(part) ? Math.max(0, Math.min(1, part)) : part > 0 ? 1 : 0;
    return amountColor(measure.better === 'less' ? 1 - bright : bright);
  };
  return { measure, low, high, kinds: [], color };
}

export const kTableSize = 256;

/** The scale as a row of pixels, and the place of each value in it, from 0 to 1. */
export function colorTable(scale: ColorScale): Uint8Array {
  const table = new Uint8Array(4 * kTableSize);
  for (let i = 0; i < kTableSize; i++) {
    const value = scale.kinds.length > 0 ? scale.kinds[i % scale.kinds.length] : scale.low + (i / (kTableSize - 1)) * (scale.high - scale.low);
    const [r, g, b] = rgb(scale.color(value));
    table.set([255 * r, 255 * g, 255 * b, 255], 4 * i);
  }
  return table;
}

/** Values as rows of the table of their scale. */
export function tableRows(scale: ColorScale, values: Float32Array): Uint8Array {
  const rows = new Uint8Array(values.length);
  const place = new Map(scale.kinds.map((kind, i) => [kind, i % kTableSize]));
  const factor = scale.high > scale.low ? (kTableSize - 1) / (scale.high - scale.low) : 0;
  for (let i = 0; i < values.length; i++) {
    const row = scale.kinds.length > 0 ? (place.get(values[i]) ?? 0) : (values[i] - scale.low) * factor;
    rows[i] = Math.max(0, Math.min(kTableSize - 1, Math.round(row) || 0));
  }
  return rows;
}

// Charts as SVG, so that they print and follow the colors of the page.
import { max } from 'd3-array';
import { axisBottom, axisLeft } from 'd3-axis';
import { scaleLinear, scaleLog, type ScaleLinear, type ScaleLogarithmic } from 'd3-scale';
import { create, type Selection } from 'd3-selection';
import { line } from 'd3-shape';
import type { Histogram } from './data.ts';
import { number } from './html.ts';

const kWidth = 360, kHeight = 118;
const kSpace = { left: 46, right: 6, top: 6, bottom: 20 };

type Chart = Selection<SVGSVGElement, undefined, null, undefined>;

function chart(label: string): Chart {
  const svg = create('svg') as unknown as Chart;
  return svg.attr('viewBox', `0 0 ${kWidth} ${kHeight}`).attr('class', 'chart').attr('role', 'img').attr('aria-label', label);
}

const down = scaleLinear().range([kHeight - kSpace.bottom, kSpace.top]);

function addBottom(svg: Chart, scale: ScaleLinear<number, number>, ticks = 6): void {
  svg.append('g').attr('transform', `translate(0,${kHeight - kSpace.bottom})`)
    .call((g) => axisBottom(scale).ticks(ticks).tickSizeOuter(0)(g as never));
}

/** Of two meshes, the one before as wide bars behind. `bad`: what is below it is bad. */
export function histogram(label: string, after: Histogram, before: Histogram | undefined, bad?: number): SVGSVGElement {
  const svg = chart(label);
  const x = scaleLinear([after.low, after.high], [kSpace.left, kWidth - kSpace.right]);
  const highest = Math.max(max(after.counts) ?? 0, max(before?.counts ?? []) ?? 0, 1);
  const y = down.copy().domain([0, highest]);
  const step = (after.high - after.low) / after.counts.length;
  if (bad !== undefined && bad > after.low) {
    svg.append('rect').attr('class', 'bad-zone').attr('x', x(after.low)).attr('width', x(bad) - x(after.low))
      .attr('y', kSpace.top).attr('height', kHeight - kSpace.top - kSpace.bottom);
  }
  const bars = (counts: number[], name: string, part: number): void => {
    counts.forEach((count, i) => {
      if (count === 0) return;
      const left = x(after.low + i * step), width = x(after.low + step) - x(after.low);
      const height = Math.max(1, y(0) - y(count)); // one of a million is seen
      svg.append('rect').attr('class', name).attr('x', left + ((1 - part) / 2) * width).attr('width', part * width - 0.5)
        .attr('y', y(0) - height).attr('height', height)
        .append('title').text(`${number(after.low + i * step, 3)} to ${number(after.low + (i + 1) * step, 3)}: ${number(count)}`);
    });
  };
  if (before) bars(before.counts, 'bar-before', 0.96);
  bars(after.counts, before ? 'bar-after' : 'bar-only', before ? 0.5 : 0.9);
  addBottom(svg, x);
  svg.append('g').attr('transform', `translate(${kSpace.left},0)`).call((g) => axisLeft(y).ticks(3, '~s').tickSizeOuter(0)(g as never));
  return svg.node() as SVGSVGElement;
}

/** A series by sweep; amounts over several powers of ten on a logarithmic scale. */
export function series(label: string, name: string, sweeps: number[], values: (number | null)[]): SVGSVGElement {
  const svg = chart(label);
  const known = values.filter((v): v is number => v !== null && Number.isFinite(v));
  const low = Math.min(...known), high = Math.max(...known);
  const logarithmic = low > 0 && high > 30 * low;
  const x = scaleLinear([sweeps[0] ?? 0, Math.max(1, sweeps[sweeps.length - 1] ?? 1)], [kSpace.left, kWidth - kSpace.right]);
  const range = [kHeight - kSpace.bottom, kSpace.top + 3];
  const y: ScaleLinear<number, number> | ScaleLogarithmic<number, number> = logarithmic
    ? scaleLog([low, high], range)
    : scaleLinear([name === 'energy' ? low : 0, high > low || high > 0 ? high : 1], range);
  addBottom(svg, x, Math.min(6, sweeps.length));
  svg.append('g').attr('transform', `translate(${kSpace.left},0)`).call((g) => axisLeft(y as never).ticks(3, '~s').tickSizeOuter(0)(g as never));
  const path = line<number | null>().defined((v) => v !== null && Number.isFinite(v)).x((_, i) => x(sweeps[i])).y((v) => y(v as number));
  svg.append('path').attr('class', `line ${name}`).attr('d', path(values));
  return svg.node() as SVGSVGElement;
}

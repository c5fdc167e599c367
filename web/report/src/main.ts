// The page: reads what temper wrote into it, draws the mesh, and lets panels, list and keys act on it.
import { darkTheme, findMeasure, type Layers, lightTheme, type Measure, measures, type Side, triangleNumbers, Verdict, Viewer } from 'temper-viewer';
import { countBad, readMeasures, readMesh, readReport, type Report, type Shown, verdictsOf, wordsOf } from './data.ts';
import { byId, make, number, table } from './html.ts';
import { again, headline, histograms, keys, remarks, solverErrors, summary, sweeps } from './panels.ts';
import { elementName, showPicked, vertexName } from './picked.ts';
import { cut, middlePlane, type Plane, planeName, range, tetMeasures, tetNumbers } from './tets.ts';

const kWorst = 100; // elements of the list

const kLayers: [keyof Layers, string, string][] = [
  ['primal', 'Triangles', 'primal'],
  ['dual', 'Dual', 'dual'],
  ['weights', 'Weights', 'positiveWeight'],
  ['orthocenters', 'Orthocenters', 'orthocenter'],
  ['bad', 'Bad', 'bad'],
];

const layersOf = (shown: Shown): typeof kLayers =>
  shown.tets ? [['primal', 'Tetrahedra', 'primal'], ['bad', 'Bad', 'bad']] : kLayers;
const measuresOf = (shown: Shown): readonly Measure[] => (shown.tets ? tetMeasures : measures);

const dark = matchMedia('(prefers-color-scheme: dark)');
const theme = (): typeof lightTheme => (dark.matches ? darkTheme : lightTheme);

class Page {
  private readonly viewer: Viewer;
  private readonly layerBoxes: HTMLInputElement[] = [];
  private readonly worst: { side: Side; element: number }[] = [];
  private at = -1; // in the list of the worst
  private split = 0;
  private plane: Plane | null = null; // of tetrahedra
  private readonly colors: readonly Measure[];

  constructor(
    private readonly report: Report,
    private readonly shown: { before: Shown | null; after: Shown },
  ) {
    const { before, after } = shown;
    this.colors = measuresOf(after);
    this.viewer = new Viewer(byId('view'), {
      theme: theme(),
      layers: { weights: false, dual: !after.tets },
      vertexName: (v, side) => vertexName(this.of(side), v),
      onPick: (pick) => this.pick(pick && { side: pick.side, element: this.of(pick.side).mesh.cells?.[pick.triangle] ?? pick.triangle }),
    });
    this.viewer.setMesh(after.mesh, before?.mesh ?? null);
    if (after.tets) this.addPlane(middlePlane(after.tets));
    this.addColors();
    this.addLayers();
    if (before) this.addSides();
    this.addWorst();
    byId('closer').addEventListener('click', () => this.viewer.zoomBy(1.5));
    byId('farther').addEventListener('click', () => this.viewer.zoomBy(1 / 1.5));
    byId('fit').addEventListener('click', () => this.viewer.fit());
    dark.addEventListener('change', () => this.recolor());
    addEventListener('beforeprint', () => this.print());
    addEventListener('keydown', (event) => this.key(event));
    Object.assign(window, { temperViewer: this.viewer }); // for measurements
  }

  /** The picture as it is for paper, with what its parts are; and nothing is folded up there. */
  private print(): void {
    for (const group of document.querySelectorAll<HTMLDetailsElement>('#summary details')) group.open = true;
    const figure = byId('printed');
    figure.querySelector('img')!.src = this.viewer.image();
    const side = byId('sides').querySelector<HTMLInputElement>(':checked')?.value ?? '';
    const sides = { before: 'Before', both: 'Left before, right after', after: 'After' }[side];
    figure.querySelector('figcaption')!.textContent = [this.plane && this.describeCut(), sides].filter(Boolean).join('. ');
  }

  private of(side: Side): Shown {
    return side === 'before' && this.shown.before ? this.shown.before : this.shown.after;
  }

  // --- the plane of tetrahedra ----------------------------------------------------------------------------------

  private addPlane(plane: Plane): void {
    for (const axis of [0, 1, 2]) {
      const box = make('input', { type: 'radio', name: 'axis', value: axis });
      box.addEventListener('change', () => this.cutAcross(axis));
      byId('axes').append(make('label', { class: 'chip' }, box, make('span', {}, 'xyz'[axis])));
    }
    byId('axes').hidden = byId('plane').hidden = false;
    const slider = byId('plane').querySelector('input')!;
    let scheduled = 0;
    slider.addEventListener('input', () => {
      cancelAnimationFrame(scheduled);
      scheduled = requestAnimationFrame(() => this.slide(Number(slider.value)));
    });
    this.plane = plane;
    this.tellPlane();
  }

  private cutAcross(axis: number): void {
    const [low, high] = range(this.shown.after.tets!, axis);
    this.cutAt({ axis, at: (low + high) / 2 });
  }

  /** Moves the plane to so many parts of 1000 of the mesh. */
  private slide(part: number): void {
    const { axis } = this.plane!, [low, high] = range(this.shown.after.tets!, axis);
    this.cutAt({ axis, at: low + (Math.max(1, Math.min(999, part)) / 1000) * (high - low) });
  }

  private cutAt(plane: Plane): void {
    const keepView = plane.axis === this.plane?.axis;
    this.plane = plane;
    for (const shown of [this.shown.before, this.shown.after]) if (shown?.tets) shown.mesh = cut(shown.tets, plane);
    this.viewer.setMesh(this.shown.after.mesh, this.shown.before?.mesh ?? null, { keepView });
    this.pick(null);
    this.drawLegend();
    this.tellPlane();
  }

  private describeCut(): string {
    const { cells, verdicts } = this.shown.after.mesh;
    const all = new Set(cells), bad = new Set(cells?.filter((_, t) => verdicts![t] !== 0));
    return `Cut at ${planeName(this.plane!)}: ${number(all.size)} tetrahedra, ${number(bad.size)} of them bad`;
  }

  private tellPlane(): void {
    const { axis, at } = this.plane!, [low, high] = range(this.shown.after.tets!, axis);
    byId('axes').querySelector<HTMLInputElement>(`[value="${axis}"]`)!.checked = true;
    const slider = byId('plane').querySelector('input')!;
    slider.value = String((1000 * (at - low)) / (high - low));
    slider.setAttribute('aria-valuetext', planeName(this.plane!));
    byId('plane').querySelector('output')!.textContent = planeName(this.plane!);
    byId('view').setAttribute('aria-label', `${this.describeCut()}. Arrows move, plus and minus zoom, 0 shows all, Enter picks the tetrahedron in the middle`);
    byId('printed').querySelector('img')!.alt = this.describeCut();
  }

  // --- colors and layers ---------------------------------------------------------------------------------------

  private addColors(): void {
    const select = byId('measure') as HTMLSelectElement;
    const { tets, mesh } = this.shown.after;
    const regions = (tets ?? mesh).regions !== undefined;
    select.append(make('option', { value: '' }, 'none'));
    for (const measure of this.colors) {
      if (measure.kinds && !regions) continue;
      select.append(make('option', { value: measure.key, selected: measure.key === 'margin' }, measure.label));
    }
    select.addEventListener('change', () => this.recolor());
    this.recolor();
  }

  private recolor(): void {
    const key = (byId('measure') as HTMLSelectElement).value;
    this.viewer.setTheme(theme());
    this.viewer.colorBy(this.colors.find((m) => m.key === key) ?? null);
    this.drawLegend();
    for (const [layer, , color] of layersOf(this.shown.after)) {
      const box = this.layerBoxes.find((each) => each.value === layer);
      box?.parentElement?.style.setProperty('--swatch', theme()[color as keyof typeof lightTheme]);
    }
  }

  private drawLegend(): void {
    const legend = byId('legend'), scale = this.viewer.scale;
    legend.replaceChildren();
    if (scale && scale.kinds.length > 0) {
      const items = scale.kinds.slice(0, 24).map((kind) => make('span', {}, make('i', { class: 'swatch', style: `background:${scale.color(kind)}` }), ` ${kind}`));
      legend.append(make('b', {}, scale.measure.label), make('div', { class: 'kinds' }, ...items));
    } else if (scale) {
      const stops = Array.from({ length: 17 }, (_, i) => scale.color(scale.low + (i / 16) * (scale.high - scale.low)));
      const ticks = [0, 0.5, 1].map((part, i) => {
        const open = i === 0 ? '≤ ' : i === 2 ? '≥ ' : '';
        return make('span', {}, open + number(scale.low + part * (scale.high - scale.low), 3) + scale.measure.unit);
      });
      legend.append(make('b', {}, scale.measure.label), make('span', { class: 'bar', style: `background:linear-gradient(90deg,${stops.join(',')})` }),
        make('div', { class: 'ticks' }, ...ticks));
    }
    const anyBad = this.viewer.badTriangles('after').length + this.viewer.badTriangles('before').length > 0;
    if (this.viewer.layers.bad && anyBad) legend.append(make('div', { class: 'bad' }, make('i', { class: 'swatch striped' }), 'bad: not well-centered'));
    legend.hidden = legend.childElementCount === 0;
  }

  private addLayers(): void {
    for (const [layer, label] of layersOf(this.shown.after)) {
      const box = make('input', { type: 'checkbox', value: layer, checked: this.viewer.layers[layer] });
      box.addEventListener('change', () => {
        this.viewer.setLayers({ [layer]: box.checked });
        this.drawLegend();
      });
      this.layerBoxes.push(box);
      byId('layers').append(make('label', { class: 'chip' }, box, make('span', {}, label)));
    }
    this.recolor();
  }

  // --- before and after -----------------------------------------------------------------------------------------

  private addSides(): void {
    const sides = byId('sides');
    for (const [value, label] of [['before', 'Before'], ['both', 'Both'], ['after', 'After']]) {
      const box = make('input', { type: 'radio', name: 'side', value });
      box.addEventListener('change', () => this.showSide(value));
      sides.append(make('label', { class: 'chip' }, box, make('span', {}, label)));
    }
    sides.hidden = false;
    const divider = byId('divider');
    const moveTo = (event: PointerEvent): void => {
      const box = byId('view').getBoundingClientRect();
      this.divide((event.clientX - box.left) / box.width);
    };
    divider.addEventListener('pointerdown', (event) => divider.setPointerCapture(event.pointerId));
    divider.addEventListener('pointermove', (event) => {
      if (divider.hasPointerCapture(event.pointerId)) moveTo(event);
    });
    divider.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
      if (step === undefined) return;
      this.divide(this.split + step);
      event.preventDefault();
      event.stopPropagation();
    });
    this.showSide('both');
  }

  private showSide(side: string): void {
    const box = byId('sides').querySelector<HTMLInputElement>(`[value=${side}]`);
    if (!box) return;
    box.checked = true;
    byId('divider').hidden = side !== 'both';
    if (side === 'both') this.divide(0.5);
    else this.viewer.setSplit(side === 'before' ? 1 : 0);
  }

  private divide(part: number): void {
    this.split = Math.max(0.02, Math.min(0.98, part));
    const divider = byId('divider');
    divider.style.left = `${100 * this.split}%`;
    divider.setAttribute('aria-valuenow', String(Math.round(100 * this.split)));
    this.viewer.setSplit(this.split);
  }

  // --- elements -------------------------------------------------------------------------------------------------

  /** The triangle that shows an element, or −1: the cut may miss it. */
  private triangleOf({ side, element }: { side: Side; element: number }): number {
    return this.of(side).mesh.cells?.indexOf(element) ?? element;
  }

  private pick(picked: { side: Side; element: number } | null): void {
    this.viewer.select(picked && this.triangleOf(picked), picked?.side);
    this.at = picked ? this.worst.findIndex((w) => w.side === picked.side && w.element === picked.element) : -1;
    byId('worst').querySelectorAll('tbody tr').forEach((row, i) => row.setAttribute('aria-selected', String(i === this.at)));
    const close = (): void => this.pick(null);
    showPicked(picked && { ...picked, shown: this.of(picked.side), compares: this.shown.before !== null }, this.report, close);
  }

  /** The elements of least margin: those that are bad after, else before, and if there are none the least good ones. */
  private addWorst(): void {
    const { before, after } = this.shown;
    const side: Side = before && countBad(after) === 0 && countBad(before) > 0 ? 'before' : 'after';
    const shown = this.of(side), words = wordsOf(shown), verdicts = verdictsOf(shown);
    const ranked = rank(shown);
    for (const { t } of ranked) this.worst.push({ side, element: t });
    const angle = (t: number): number => (shown.tets ? tetNumbers(shown.tets, t).dihedral : Math.max(...triangleNumbers(shown.mesh, t).angle));
    const rows = ranked.map(({ t, margin }) => {
      const bits = verdicts[t];
      const what = bits === 0 ? '' : bits & Verdict.inverted ? 'inverted' : shown.tets ? 'h' : bits & 7 && bits & 56 ? 'h, d' : bits & 7 ? 'h' : 'd';
      return [elementName(shown, t), make('td', { class: bits ? 'is-bad' : '' }, number(margin, 3)), `${number(angle(t), 4)}°`, make('td', { class: bits ? 'is-bad' : '' }, what)];
    });
    const open = (i: number): void => this.zoomToWorst(i);
    const attributes = (i: number): Record<string, string | number | ((event: Event) => void)> => ({
      tabindex: 0,
      onclick: () => open(i),
      onkeydown: (event) => {
        if ((event as KeyboardEvent).key === 'Enter') open(i);
      },
    });
    const bad = countBad(shown);
    const title = bad > 0 ? `The worst ${words.many}${before ? `, ${side}` : ''}` : 'The least margins';
    byId('worst').append(
      make('h2', {}, title),
      make('div', { class: 'scroll' }, table([words.one, 'margin', shown.tets ? 'largest dihedral angle' : 'largest angle', bad > 0 ? 'fails' : ''], rows, attributes)),
      make('p', { class: 'note' }, bad > kWorst ? `${kWorst} of ${number(bad)}. ` : '', `The margin is the least h/ℓ${shown.tets ? '' : ' or d/ℓ'}`, make('span', { class: 'on-screen' }, `; a click shows the ${words.one}`), '.'),
    );
  }

  private zoomToWorst(i: number): void {
    if (this.worst.length === 0) return;
    const next = (i + this.worst.length) % this.worst.length, worst = this.worst[next], { tets } = this.of(worst.side);
    if (this.shown.before) this.showSide(worst.side);
    if (tets && this.triangleOf(worst) < 0) {
      const { axis } = this.plane!, at = tetNumbers(tets, worst.element).points.reduce((sum, p) => sum + p[axis] / 4, 0);
      this.cutAt({ axis, at });
    }
    this.viewer.zoomToTriangle(this.triangleOf(worst), worst.side);
    this.pick(this.worst[next]);
    byId('worst').querySelectorAll('tbody tr')[next]?.scrollIntoView({ block: 'nearest' });
  }

  // --- keys -----------------------------------------------------------------------------------------------------

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.matches('select, textarea')) return;
    const colors = byId('measure') as HTMLSelectElement;
    const actions: Record<string, () => void> = {
      n: () => this.zoomToWorst(this.at + 1),
      p: () => this.zoomToWorst(this.at < 0 ? -1 : this.at - 1),
      b: () => this.showSide('before'),
      a: () => this.showSide('after'),
      s: () => this.showSide('both'),
      c: () => {
        colors.selectedIndex = (colors.selectedIndex + 1) % colors.length;
        this.recolor();
      },
    };
    this.layerBoxes.forEach((box, i) => (actions[String(i + 1)] = () => box.click()));
    if (this.plane) {
      const { axis } = this.plane, slider = byId('plane').querySelector('input')!;
      [...'xyz'].forEach((key, i) => (actions[key] = () => i !== axis && this.cutAcross(i)));
      actions['['] = () => this.slide(Number(slider.value) - 20);
      actions[']'] = () => this.slide(Number(slider.value) + 20);
    }
    if (!this.shown.before) for (const key of ['b', 'a', 's']) delete actions[key];
    actions[event.key]?.();
  }
}

/** The kWorst elements of least margin, bad ones first. */
function rank(shown: Shown): { t: number; margin: number }[] {
  const margin = findMeasure('margin');
  const bits = verdictsOf(shown), { tets, mesh } = shown;
  let worst: { t: number; margin: number; bad: boolean }[] = [];
  const order = (a: (typeof worst)[0], b: (typeof worst)[0]): number => Number(b.bad) - Number(a.bad) || a.margin - b.margin || a.t - b.t;
  const shrink = (): void => void (worst = worst.sort(order).slice(0, kWorst));
  for (let t = 0; t < bits.length; t++) {
    const value = tets ? tetNumbers(tets, t).margin : margin ? margin.of(triangleNumbers(mesh, t), t, mesh) : 0;
    worst.push({ t, margin: value, bad: bits[t] !== 0 });
    if (worst.length > 50 * kWorst) shrink();
  }
  shrink();
  return worst;
}

async function start(): Promise<void> {
  const report = readReport();
  const title = document.title;
  document.title = `${title} – temper`;
  const [before, after] = [await readMesh('before'), await readMesh('after')];
  byId('loading').remove();
  if (!after) return;
  const words = wordsOf(after);
  headline(report, title, { before: before ? countBad(before) : undefined, after: countBad(after) }, verdictsOf(after).length, words);
  summary(report, readMeasures(), after.tets !== undefined);
  histograms(report, words);
  sweeps(report, words);
  solverErrors(report);
  again(report);
  remarks(report);
  keys(words, layersOf(after).length, { compares: before !== null, cuts: after.tets !== undefined });
  try {
    new Page(report, { before, after });
  } catch (error) {
    byId('view').append(make('p', { class: 'trouble' }, `The mesh cannot be drawn: ${(error as Error).message}.`));
  }
  document.documentElement.dataset.ready = 'true';
}

void start();

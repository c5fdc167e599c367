// The page: a mesh is opened, looked at, changed by hand or by a run in a worker, and saved.
import { draw_svg, formats, html_report, type Progress, quality, type Quality, write } from 'temper-mesh';
import { darkTheme, lightTheme, type MeshData, type Pick, Viewer } from 'temper-viewer';
import { arraysOf } from './arrays.ts';
import { examples } from './examples.ts';
import { Explainer } from './explainer.ts';
import type { Arrays } from './messages.ts';
import { OptionsForm } from './options_form.ts';
import { Runner } from './runner.ts';
import { Session } from './session.ts';
import { badOf, showEnergies, showQuality, showReason, showTriangle, whyOf } from './tables.ts';

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;
const dark = matchMedia('(prefers-color-scheme: dark)');
const themeNow = (): typeof lightTheme => (dark.matches ? darkTheme : lightTheme);

const kStill = 300; // ms without a change until reasons are looked for
const kWheelStep = 0.02; // of the squared length of the edges around, a step of the wheel

let session = new Session(examples[0].make(), examples[0].name);
let shown: MeshData;
let measured: Quality;
let picked: Pick | null = null;
let scheduled = 0;
let stillness = 0;

const options = new OptionsForm(element('first-options'), element('all-options'));
const runner = new Runner();
const explainer = new Explainer(() => explain());
const viewer = new Viewer(element('viewer'), {
  theme: themeNow(),
  onPick: (pick) => {
    picked = pick;
    explain();
  },
  vertexTool: {
    canDrag: () => !runner.running,
    drag(vertex, x, y, phase) {
      if (phase === 'start') session.remember();
      if (session.place(vertex, x, y, session.mesh.point(vertex)[2])) changed();
    },
    wheel(vertex, steps) {
      if (runner.running) return false;
      const [x, y, w] = session.mesh.point(vertex);
      session.remember();
      if (session.place(vertex, x, y, w + steps * kWheelStep * meanSquaredLength(vertex))) changed();
      return true;
    },
  },
});

/** Of the edges that leave a vertex. */
function meanSquaredLength(vertex: number): number {
  const { points, triangles } = shown;
  let sum = 0, n = 0;
  for (let h = 0; h < triangles.length; h++) {
    if (triangles[h] !== vertex) continue;
    const other = triangles[h % 3 === 2 ? h - 2 : h + 1];
    sum += (points[2 * other] - points[2 * vertex]) ** 2 + (points[2 * other + 1] - points[2 * vertex + 1]) ** 2;
    n++;
  }
  return n > 0 ? sum / n : 0;
}

// --- showing --------------------------------------------------------------------------------------------------------------

function dataOf(arrays: Arrays): MeshData {
  return { points: arrays.points, weights: arrays.weights, triangles: arrays.triangles, regions: arrays.regions };
}

/** The mesh of the session is drawn and measured. */
function show(keepView: boolean): void {
  explainer.forget();
  shown = dataOf(arraysOf(session.mesh));
  viewer.setMesh(shown, null, { keepView });
  measure();
  if (keepView && picked && picked.triangle < session.mesh.n_triangles) viewer.select(picked.triangle);
  else picked = null;
  explain();
  element('name').textContent = session.name;
  update();
}

/** The same after a change by hand, once a frame. */
function changed(): void {
  session.trace = null;
  session.run = null;
  explainer.forget();
  scheduled ||= requestAnimationFrame(() => {
    scheduled = 0;
    const { points, weights, triangles } = arraysOf(session.mesh);
    const same = triangles.length === shown.triangles.length && triangles.every((v, h) => v === shown.triangles[h]);
    if (!same) {
      show(true);
      return;
    }
    shown.points.set(points);
    shown.weights!.set(weights);
    viewer.geometryChanged();
    measure();
    explain();
    update();
  });
}

function measure(): void {
  measured = quality(session.mesh, { worst: 0 });
  showQuality(element('quality'), measured);
  showEnergies(element('energies'), measured);
}

/** What there is to say of the picked triangle. */
function explain(): void {
  element('why').hidden = picked === null;
  if (!picked) return;
  const why = whyOf(measured, session.mesh, picked.triangle, (worst) => quality(session.mesh, { worst }));
  element('why-title').textContent = `Triangle ${picked.triangle}`;
  element('why-text').textContent = why ?? 'well-centered: its orthocenter is inside, and its edges are crossed by their duals';
  showTriangle(element('why-numbers'), shown, picked.triangle);
  showReason(element('why-reason'), why === null ? null : explainer, picked.triangle);
  clearTimeout(stillness);
  if (why !== null && !runner.running) stillness = window.setTimeout(() => explainer.ask(() => arraysOf(session.mesh)), kStill);
}

function update(): void {
  const running = runner.running;
  element<HTMLButtonElement>('optimize').disabled = running;
  element<HTMLButtonElement>('stop').disabled = !running;
  element<HTMLButtonElement>('undo').disabled = running || !session.canUndo;
  for (const id of ['example', 'open', 'save']) element<HTMLInputElement>(id).disabled = running;
  element('steps').hidden = running || session.trace === null;
}

function say(lines: readonly string[], error = false): void {
  element('messages').replaceChildren(
    ...lines.map((line) => {
      const p = document.createElement('p');
      p.textContent = line;
      if (error) p.className = 'error';
      return p;
    }),
  );
}
const sayError = (error: unknown): void => say([error instanceof Error ? error.message : String(error)], true);

function begin(next: Session): void {
  session = next;
  say(session.mesh.warnings);
  element('progress').textContent = '';
  show(false);
}

// --- runs -----------------------------------------------------------------------------------------------------------------

function tellProgress({ last, fraction, max_sweeps, sweeps_left }: Progress): void {
  const now = fraction > 0 ? `, ${Math.round(100 * fraction)} % of the next` : '';
  const left = sweeps_left === null ? '' : `, about ${Math.ceil(sweeps_left)} left`;
  element('progress').textContent = `${last.bad} bad after ${last.sweep} of at most ${max_sweeps} sweeps${now}${left}`;
}

let latest: { progress: Progress; mesh: Arrays | null } | null = null;

/** At most once a frame: drawing may be slower than the run. */
function showProgress(progress: Progress, mesh: Arrays | null): void {
  const waiting = latest !== null;
  latest = { progress, mesh: mesh ?? latest?.mesh ?? null };
  if (waiting) return;
  requestAnimationFrame(() => {
    const now = latest;
    latest = null;
    if (!now || !runner.running) return;
    tellProgress(now.progress);
    if (!now.mesh) return;
    shown = dataOf(now.mesh);
    viewer.setMesh(shown, null, { keepView: true });
  });
}

async function optimize(): Promise<void> {
  const traced = element<HTMLInputElement>('record').checked;
  const input = arraysOf(session.mesh);
  session.remember();
  say([]);
  element('progress').textContent = 'begins';
  const run = runner.run({ kind: 'optimize', mesh: input, given: options.given, traced }, showProgress);
  update();
  const { mesh, report, events, error } = await run;
  if (error) {
    session.forget();
    sayError(error);
    element('progress').textContent = '';
  } else if (mesh && (report || mesh.points.length === input.points.length)) {
    session.take(mesh, report, events);
    say(report?.notes ?? []);
  }
  show(true);
  if (error) return;
  element('progress').textContent = report
    ? `${badOf(measured)} bad; ${report.stopped.replaceAll('_', ' ')} after ${report.sweeps} sweeps in ${report.seconds.toPrecision(2)} s, ${report.flips} flips`
    : `${badOf(measured)} bad; stopped`;
  const step = element<HTMLInputElement>('step');
  step.max = String(events.length);
  step.value = step.max;
  tellStep();
}

function tellStep(): void {
  if (!session.trace) return;
  const at = Number(element<HTMLInputElement>('step').value), { events } = session.trace;
  const event = events[at - 1];
  const where = event && (event.vertex >= 0 ? `vertex ${event.vertex}` : event.kind === 'flip' ? `edge ${event.quad[0]}-${event.quad[1]}` : '');
  element('event').textContent = event
    ? `${at} of ${events.length}: ${event.kind} ${where}, sweep ${event.sweep}`
    : `0 of ${events.length}: the input`;
}

function goTo(events: number): void {
  if (!session.trace) return;
  const step = element<HTMLInputElement>('step');
  step.value = String(events);
  tellStep();
  session.goTo(Number(step.value));
  show(true);
}

// --- files ----------------------------------------------------------------------------------------------------------------

async function open(list: FileList): Promise<void> {
  try {
    const files = Object.fromEntries(
      await Promise.all([...list].map(async (file) => [file.name, new Uint8Array(await file.arrayBuffer())] as const)),
    );
    begin(Session.open(files));
  } catch (error) {
    sayError(error);
  }
}

function download(name: string, content: BlobPart): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** The name of the mesh without the suffix of a format: a.jigsaw.msh is a. */
function stem(): string {
  const suffixes = formats().flatMap((row) => row.suffixes.split(' ')).filter((suffix) => session.name.endsWith(suffix));
  const longest = Math.max(0, ...suffixes.map((suffix) => suffix.length));
  return session.name.slice(0, session.name.length - longest);
}

function save(): void {
  try {
    const format = element<HTMLSelectElement>('format').value;
    const suffix = formats().find((row) => row.name === format)!.suffixes.split(' ')[0];
    const files: Record<string, Uint8Array<ArrayBuffer>> = {};
    const path = `${stem()}${suffix}`;
    say(write(path, session.mesh, { format, files }));
    for (const [name, bytes] of Object.entries(files)) download(name, bytes);
  } catch (error) {
    sayError(error);
  }
}

// --- the page -------------------------------------------------------------------------------------------------------------

for (const { name, title } of examples) element<HTMLSelectElement>('example').add(new Option(title, name));
for (const { name, description, writes, holds_planes } of formats()) {
  // The module has neither NetCDF nor HDF5.
  if (writes && holds_planes && !/NetCDF|HDF5/.test(description)) element<HTMLSelectElement>('format').add(new Option(description, name));
}
for (const [layer, title] of [['primal', 'primal'], ['dual', 'dual'], ['weights', 'weights'], ['orthocenters', 'orthocenters'], ['bad', 'bad triangles']] as const) {
  const label = document.createElement('label');
  const box = document.createElement('input');
  box.type = 'checkbox';
  box.checked = viewer.layers[layer];
  box.addEventListener('change', () => viewer.setLayers({ [layer]: box.checked }));
  label.append(box, ` ${title}`);
  element('layers').append(label);
}

element('example').addEventListener('change', (event) => {
  const chosen = examples.find(({ name }) => name === (event.target as HTMLSelectElement).value)!;
  begin(new Session(chosen.make(), chosen.name));
});
element('open').addEventListener('change', (event) => {
  const input = event.target as HTMLInputElement;
  if (input.files?.length) void open(input.files).then(() => (input.value = ''));
});
element('optimize').addEventListener('click', () => void optimize());
element('stop').addEventListener('click', () => runner.stop());
element('undo').addEventListener('click', () => {
  session.undo();
  element('progress').textContent = '';
  show(true);
});
element('save').addEventListener('click', save);
element('picture').addEventListener('click', () => download(`${stem()}.svg`, draw_svg(session.mesh, { title: session.name })));
element('report').addEventListener('click', () => {
  const explanation = explainer.explanation ?? undefined;
  download(`${stem()}.html`, html_report(session.mesh, { ...session.run, explanation, title: session.name }));
});
element('step').addEventListener('input', (event) => goTo(Number((event.target as HTMLInputElement).value)));
element('back').addEventListener('click', () => goTo(Math.max(0, Number(element<HTMLInputElement>('step').value) - 1)));
element('forward').addEventListener('click', () => goTo(Number(element<HTMLInputElement>('step').value) + 1));

addEventListener('dragover', (event) => {
  event.preventDefault();
  document.body.classList.add('dropping');
});
addEventListener('dragleave', (event) => {
  if (event.relatedTarget === null) document.body.classList.remove('dropping');
});
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dropping');
  if (!runner.running && event.dataTransfer?.files.length) void open(event.dataTransfer.files);
});
dark.addEventListener('change', () => viewer.setTheme(themeNow()));

show(false);
requestAnimationFrame(() => {
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
  setTimeout(() => runner.warm(), 300);
});

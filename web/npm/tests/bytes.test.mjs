// The same bytes as the native program: every text format and VTU, and runs of all kinds, read, optimized and written by
// both. TEMPER_PROGRAM names the program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import * as temper from 'temper-mesh';

const program = process.env.TEMPER_PROGRAM;
assert(program, 'TEMPER_PROGRAM: expected the path of the native program');
const folder = mkdtempSync(join(tmpdir(), 'temper-bytes-'));
after(() => rmSync(folder, { recursive: true }));
const native = (...words) => execFileSync(program, words, { cwd: folder, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });
const at = (name) => join(folder, name);

/** Examples, made by the program: name → words. */
const examples = {
  sparse: ['sparse-horseshoe'],
  horseshoe: ['horseshoe'],
  triangle: ['triangle'],
  random: ['random', '--vertices', '300'],
  grid: ['sheared-grid'],
  annulus: ['annulus'],
  airfoil: ['airfoil'],
  polygon: ['polygon'],
  letter: ['letter-a'],
  wedge: ['wedge'],
  graded: ['graded'],
};
for (const [name, words] of Object.entries(examples)) native('example', ...words, '-o', `${name}.vtu`);

/** What one of the two made must be what the other made, file by file. */
function expectSame(stem, what) {
  const files = readdirSync(folder).filter((name) => name.startsWith(`native-${stem}`));
  assert(files.length > 0, what);
  for (const name of files) {
    const theirs = readFileSync(at(name)), ours = readFileSync(at(name.replace('native-', 'wasm-')));
    assert(ours.equals(theirs), `${what}: ${name} differs`);
  }
}

// Of formats with the same suffix the name decides, so all are written by name; NetCDF and HDF5 are not in the module.
const writable = temper.formats().filter((format) => format.writes && format.holds_planes && !/NetCDF|HDF5/.test(format.description));
for (const format of writable) {
  for (const [name, encodings] of Object.entries({ annulus: [''], airfoil: ['ascii', 'base64', 'appended'] })) {
    for (const encoding of format.name === 'vtu' ? encodings : ['']) {
      test(`${format.name} ${encoding} of ${name} has the bytes of the program, and is read again`, () => {
        const stem = `${format.name}-${name}${encoding}`, suffix = format.suffixes.split(' ')[0];
        native('optimize', `${name}.vtu`, '-o', `wc-${name}.vtu`, '--quiet', '--set', 'max_sweeps=3');
        native('convert', `wc-${name}.vtu`, '-o', `native-${stem}${suffix}`, '--format', format.name, ...(encoding ? ['--encoding', encoding] : []));
        const mesh = temper.read(at(`wc-${name}.vtu`));
        temper.write(at(`wasm-${stem}${suffix}`), mesh, { format: format.name, ...(encoding ? { encoding } : {}) });
        expectSame(stem, format.name);
        const again = temper.read(at(`wasm-${stem}${suffix}`));
        assert.deepEqual(again.points, mesh.points);
        assert.deepEqual(again.weights, mesh.weights);
        assert.deepEqual(again.triangles, mesh.triangles);
      });
    }
  }
}

/** Fewer trials than a linear program counts as: the module has none, so the program must use none. */
const repair_trials = 19;
/** Runs: what module and program are given. */
const runs = {
  default: { options: { repair_trials } },
  accuracy: { options: { objective: 'accuracy', repair_trials } },
  'star 0, dT': { options: { energy: 'dT', star: 0, max_sweeps: 40 } },
  'BHs from F': { options: { energy: 'BHs', first_energy: 'F', max_sweeps: 60, repair_trials } },
  'split boundary': { boundary: 'split', options: { repair_trials } },
  'slide, kept sizes': { boundary: 'slide', keep: ['sizes'], options: { repair_trials } },
  'kept positions and edges': { keep: ['positions', 'edges'], options: { repair_trials } },
  'high effort': { effort: 'high', options: { repair_trials } },
  'target valid': { target: 'valid', effort: 'quick', options: { repair_trials } },
  'target mpas': { target: 'mpas', options: { repair_trials } },
  'target paper': { target: 'paper', options: { max_sweeps: 5 } },
  'alternating, deferred flips': { options: { solver: 'alternating', flips: 'deferred', max_sweeps: 8 } },
  'gamma 1, random order': { options: { gamma: { value: 1, scale: 'absolute' }, order: 'random', seed: 5, max_sweeps: 30 } },
  'removals, insertions': { options: { removal: 'patch', removal_from: 2, insertion_from: 3, max_sweeps: 12 } },
  'overshoot past flips': { options: { energy: 'T', flip_limit: 'after', overshoot: 1.5, overshoot_factor: 0.3, max_sweeps: 12 } },
};
/** The words of the program. */
const spell = ({ target = 'any', effort = 'normal', keep = [], boundary = 'keep', options }) => [
  '--for', target, '--effort', effort, ...keep.flatMap((part) => ['--keep', part]), '--boundary', boundary,
  '--set', Object.entries(options).map(([name, value]) => `${name}=${value?.scale ? `${value.value}:${value.scale}` : value}`).join(),
];

for (const [label, run] of Object.entries(runs)) {
  test(`optimize with ${label} ends with the bytes of the program on every example`, () => {
    let compared = 0;
    for (const name of Object.keys(examples)) {
      const stem = `run-${name}-${label.replaceAll(/\W/g, '')}`;
      let refused = null;
      try {
        native('optimize', `${name}.vtu`, '-o', `native-${stem}.vtu`, '--quiet', ...spell(run));
      } catch (error) {
        if (error.status !== 3 && error.status !== 1) throw error;
        refused = error.stderr;
      }
      const mesh = temper.read(at(`${name}.vtu`));
      if (refused) {
        assert.throws(() => temper.optimize(mesh, run), temper.TemperError, refused);
        continue;
      }
      temper.optimize(mesh, run);
      temper.write(at(`wasm-${stem}.vtu`), mesh);
      expectSame(stem, `${name}, ${label}`);
      compared++;
    }
    assert(compared >= 8, `only ${compared} examples were compared`);
  });
}

test('a run of twenty thousand vertices ends with the bytes of the program', () => {
  native('example', 'random', '--vertices', '20000', '-o', 'large.vtu');
  native('optimize', 'large.vtu', '-o', 'native-large.vtu', '--quiet');
  const mesh = temper.read(at('large.vtu'));
  const begin = performance.now();
  temper.optimize(mesh);
  console.log(`20000 vertices: ${((performance.now() - begin) / 1000).toFixed(2)} s in the module`);
  temper.write(at('wasm-large.vtu'), mesh);
  expectSame('large', 'large');
});

// Sines and cosines are those of the C library: musl's here, glibc's there. They are the only functions of the library that
// differ, and only examples, maps and the choice of places to try in `explain` call them.
test('examples are those of the program but for the last bits of sines and cosines', () => {
  const generators = {
    sparse: 'sparse_horseshoe', horseshoe: 'horseshoe', triangle: 'single_triangle', grid: 'sheared_grid', annulus: 'annulus',
    airfoil: 'airfoil', polygon: 'regular_polygon', letter: 'letter_a', wedge: 'wedge', graded: 'graded_mesh',
  };
  const exact = [];
  for (const [name, generator] of Object.entries(generators)) {
    const theirs = temper.read(at(`${name}.vtu`)), ours = temper.generate[generator]();
    const a = ours.points, b = theirs.points;
    assert.equal(a.length, b.length, name);
    const size = b.reduce((most, x) => Math.max(most, Math.abs(x)), 0);
    let differ = 0, worst = 0;
    for (let i = 0; i < a.length; i++) {
      if (a[i] === b[i]) continue;
      differ++;
      worst = Math.max(worst, Math.abs(a[i] - b[i]) / size);
    }
    if (differ === 0) exact.push(name);
    else console.log(`${name}: ${differ} of ${a.length} coordinates differ, by ${worst.toExponential(1)} of the size at most`);
    assert(worst < 1e-12, name);
    // Corners of a regular polygon are on a circle but for rounding: which diagonals there are is up to that.
    if (name !== 'polygon') assert.deepEqual(ours.triangles, theirs.triangles, name);
  }
  console.log(`the same bits: ${exact.join(', ')}`);
});

test('explanations have the verdicts of the program, whose programs another solver solves', async () => {
  for (const name of Object.keys(examples).filter((each) => each !== 'random')) {
    const theirs = JSON.parse(native('explain', `${name}.vtu`, '--json', '--limit', '0'));
    const ours = await temper.explain(temper.read(at(`${name}.vtu`)), { cures: 0 });
    assert.deepEqual([ours.verdict, ours.bad], [theirs.verdict, theirs.bad], name);
    const bad = (why) => why.reasons.flatMap((reason) => reason.triangles).sort((a, b) => a - b);
    assert.deepEqual(bad(ours), bad(theirs), name);
  }
});

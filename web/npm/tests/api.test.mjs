// The package's own side: arrays in and out, listeners, errors, memory. (Meshes themselves are tested in C++.)
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { isDeepStrictEqual } from 'node:util';
import * as temper from 'temper-mesh';

const folder = mkdtempSync(join(tmpdir(), 'temper-api-'));
after(() => rmSync(folder, { recursive: true }));

const square = () => new temper.Mesh([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]]);

test('arrays go in as rows or flat, and come out as they were', () => {
  const points = Float64Array.from([0, 0, 1, 0, 1, 1, 0, 1]);
  const mesh = new temper.Mesh(points, Int32Array.from([0, 1, 2, 3, 2, 0]), [0, 0.1, 0, 0.1], { regions: [1, 2], fixed: [2] });
  assert.deepEqual(mesh.points, points);
  assert.deepEqual(mesh.weights, Float64Array.from([0, 0.1, 0, 0.1]));
  assert.equal(mesh.reversed_triangles, 1);
  assert.deepEqual(mesh.regions, Int32Array.from([1, 2]));
  assert.deepEqual(mesh.fixed, Int32Array.from([2]));
  assert.deepEqual([mesh.n_vertices, mesh.n_triangles, mesh.n_edges, mesh.n_halfedges], [4, 2, 5, 6]);
  assert.equal(mesh.constrained_edges.length, 2, 'regions differ across the diagonal');
  assert.equal(mesh.boundary_edges.length, 8);
  assert.equal(mesh.validate(), null);
  assert(square().equals(square()) && !square().equals(mesh));
  assert.deepEqual(mesh.point(1), [1, 0, 0.1]);
});

test('wrong arguments are TypeErrors that name them, bad meshes TemperErrors', () => {
  assert.throws(() => new temper.Mesh([[0, 0, 0]], []), /points: expected rows of 2 numbers, found 3 in row 0/);
  assert.throws(() => new temper.Mesh([0, 0, 1], []), /points: expected rows of 2 numbers, found 3 in all/);
  assert.throws(() => new temper.Mesh([0, 0], [0.5, 1, 2]), /triangles: expected whole numbers/);
  const refuses = (given, error) => assert.throws(() => temper.optimize(square(), given), error);
  refuses({ sweeps: 3 }, { name: 'TypeError', message: 'there is no argument sweeps' });
  refuses({ max_sweeps: 3 }, { name: 'TypeError', message: 'max_sweeps is one of the options: {options: {max_sweeps: VALUE}}' });
  refuses({ options: { sweeps: 3 } }, { name: 'TypeError', message: 'there is no option sweeps' });
  refuses({ options: { max_sweeps: 1.5 } }, { name: 'TypeError', message: 'max_sweeps: expected number, found 1.5' });
  refuses({ options: { energy: 'XY' } }, { name: 'TemperError', code: 'invalid_option' });
  refuses({ options: { size_band: Infinity } }, temper.TemperError);
  refuses({ target: 'none' }, { code: 'invalid_option', message: /^target is 'none'; expected one of any, valid, / });
  refuses({ keep: 3 }, TypeError);
  refuses({ keep: ['positions', 'weights'] }, /nothing can change/);
  refuses({ target: 'paper', effort: 'high' }, /effort 'high' is not for target 'paper'/);
  refuses({ boundary: 'cut' }, { code: 'invalid_option' });
  assert.throws(() => temper.generate.annulus({ inside: 3 }), TypeError);
  assert.throws(() => temper.generate.random_mesh(30), { name: 'TypeError', message: /such as random_mesh\(\{ vertices: 30 \}\), found 30/ });
  assert.throws(() => new temper.Mesh([[0, 0], [1, 0], [0, 1], [0, 0], [1, 1]], [[0, 1, 2], [3, 4, 2]]), { code: 'duplicate_point' });
  assert.throws(() => temper.read('none.vtu', { files: {} }), { code: 'not_found', where: 'none.vtu' });
});

test('every kind of exception of the module comes through, and leaves it whole', () => {
  const text = (s) => ({ 'a.vtu': new TextEncoder().encode(s) });
  for (const [content, code] of [
    ['', 'empty_input'],
    ['<VTKFile type="UnstructuredGrid">', 'truncated'],
    ['<VTKFile type="UnstructuredGrid"><UnstructuredGrid></UnstructuredGrid></VTKFile>', 'truncated'],
    ['nothing', 'syntax'],
  ]) {
    for (let i = 0; i < 100; i++) assert.throws(() => temper.read('a.vtu', { files: text(content) }), { name: 'TemperError', code });
  }
  assert.throws(() => temper.generate.random_mesh({ vertices: 4e8 }), /memory|vertices/);
  assert.equal(square().validate(), null);
});

test('positions that turn a triangle over are refused, and nothing has changed', () => {
  const mesh = temper.generate.annulus();
  const before = mesh.copy();
  assert.throws(() => (mesh.points = mesh.points.map(() => 0)), temper.TemperError);
  assert.throws(() => mesh.set_point(0, 9, 9, 0), /is not counter-clockwise/);
  assert.throws(() => (mesh.weights = [1]), TypeError);
  assert(mesh.equals(before));
  mesh.weights = mesh.weights.map((_, i) => i * 1e-6);
  assert(!mesh.equals(before));
  mesh.free();
  assert.throws(() => mesh.n_vertices, /freed/);
});

test('a listener gets the progress and stops the run; its error is thrown when the mesh is in place', () => {
  const mesh = temper.generate.random_mesh({ vertices: 400 });
  const sweeps = [];
  const left = [];
  const report = temper.optimize(mesh, {
    progress: ({ last, sweeps_left }) => {
      sweeps.push(last.sweep);
      left.push(sweeps_left);
    },
  });
  assert.equal(report.stopped, 'sweep_limit');
  assert.equal(left[0], null);                             // nothing to go by yet
  assert(left.some((n) => n !== null && n >= 0 && n < 1000));
  assert(sweeps.length >= report.sweeps);
  const stopped = temper.optimize(temper.generate.random_mesh({ vertices: 400 }), { progress: ({ last }) => last.sweep < 2 });
  assert.equal(stopped.stopped, 'canceled');
  assert(stopped.sweeps <= 3);
  const thrown = temper.generate.random_mesh({ vertices: 400 });
  const before = temper.quality(thrown).orthocenters_outside;
  assert.throws(() => temper.optimize(thrown, { progress: ({ last }) => { if (last.sweep === 2) throw new RangeError('enough'); } }), /enough/);
  assert(temper.quality(thrown).orthocenters_outside < before);
  let inner = 0;
  temper.optimize(temper.generate.letter_a(), { options: { max_sweeps: 2, repair: 'none' }, progress: () => void (inner += temper.quality(square()).triangles) });
  assert(inner > 0, 'other calls may be made meanwhile');
});

test('a trace replays to the same bits, and its beginning to a mesh', () => {
  const input = temper.generate.letter_a(), output = input.copy(), events = [];
  const report = temper.optimize(output, { boundary: 'split', options: { repair: 'vertices' }, hooks: { tracer: (event) => void events.push(event) } });
  assert(report.vertices.includes(-1) && events.length > 100);
  assert(temper.replay(input, events).equals(output));
  assert.equal(temper.replay(input, events.slice(0, 50)).validate(), null);
  assert.throws(() => temper.replay(temper.generate.sparse_horseshoe(), events), { code: 'trace_mismatch' });
});

test('operators fit together', () => {
  const mesh = temper.generate.annulus();
  temper.optimize(mesh);
  const { d0, d1, star0, star1, star2, edges, areas, orthocenters, summary } = temper.dec_operators(mesh);
  const n = [star0, star1, star2].map((star) => star.length);
  assert.deepEqual(n, [mesh.n_vertices, mesh.n_edges, mesh.n_triangles]);
  assert.deepEqual([d0.starts.length, d1.starts.length, orthocenters.length], [n[1] + 1, n[2] + 1, 2 * n[2]]);
  assert(Math.abs(star0.reduce((a, b) => a + b) - areas.reduce((a, b) => a + b)) < 1e-12 * summary.area * n[0]);
  // d1 d0 = 0.
  for (let t = 0; t < n[2]; t++) {
    const sums = new Map();
    for (let i = d1.starts[t]; i < d1.starts[t + 1]; i++) {
      const e = d1.columns[i];
      for (let j = d0.starts[e]; j < d0.starts[e + 1]; j++) sums.set(d0.columns[j], (sums.get(d0.columns[j]) ?? 0) + d1.signs[i] * d0.signs[j]);
    }
    assert([...sums.values()].every((sum) => sum === 0));
  }
  assert.equal(edges.vertices.length, 2 * n[1]);
});

/** A square of two layers, regions 1 and 2, whose inner vertices are moved a little. */
function layers(n = 8) {
  const points = [], triangles = [], regions = [];
  for (let j = 0; j <= n; j++) {
    for (let i = 0; i <= n; i++) {
      const inner = i > 0 && i < n && j > 0 && j < n && 2 * j !== n;
      points.push([(i + (inner ? 0.2 * Math.sin(7 * i + 3 * j) : 0)) / n, (j + (inner ? 0.2 * Math.cos(5 * i + 11 * j) : 0)) / n]);
    }
  }
  for (let j = 0; j < n; j++) {
    for (let i = 0; i < n; i++) {
      const a = i + (n + 1) * j, d = a + n + 1;
      triangles.push([a, a + 1, d + 1], [a, d + 1, d]);
      regions.push(...[1, 1].map((r) => (2 * j < n ? r : r + 1)));
    }
  }
  return new temper.Mesh(points, triangles, null, { regions });
}

test('a tensor for each region: a weight for each corner, good triangles in each metric', () => {
  const tensor = { 1: [1, 0, 1], 2: [1, 0.2, 1.5] };
  const mesh = layers();
  const before = temper.quality(mesh, { tensor });
  temper.optimize(mesh, { tensor });
  const after = temper.quality(mesh, { tensor });
  assert(before.well_centered_fraction < 0.9 && after.well_centered_fraction === 1, `${before.well_centered_fraction} ${after.well_centered_fraction}`);
  assert.equal(mesh.corner_weights.length, 3 * mesh.n_triangles);
  const files = {};
  temper.write('rock.vtu', mesh, { files });
  const again = temper.read('rock.vtu', { files });
  assert.deepEqual(again.corner_weights, mesh.corner_weights);
  assert.deepEqual(temper.quality(again, { tensor }), after);
  // Across an interface two halves in a row are the transmissibility of the edge.
  const { transmissibility, half_transmissibility, edge_of_halfedge } = temper.dec_operators(mesh, { tensor });
  const twins = mesh.twins;
  for (let h = 0; h < twins.length; h++) {
    if (twins[h] < 0) continue;
    const halves = half_transmissibility[h] * half_transmissibility[twins[h]] / (half_transmissibility[h] + half_transmissibility[twins[h]]);
    assert(Math.abs(halves / transmissibility[edge_of_halfedge[h]] - 1) < 1e-9);
  }
  mesh.weights = mesh.weights;
  assert.equal(mesh.corner_weights.length, 0);
});

test('one tensor is the same for all, for each region and for each triangle', () => {
  const one = layers(), regions = layers(), triangles = layers();
  temper.optimize(one, { tensor: [2, 0.5, 1] });
  temper.optimize(regions, { tensor: { 1: [2, 0.5, 1], 2: [2, 0.5, 1] } });
  temper.optimize(triangles, { tensor: Array(triangles.n_triangles).fill([2, 0.5, 1]) });
  assert(one.equals(regions) && one.equals(triangles));
  const plain = temper.dec_operators(one).star1, scaled = temper.dec_operators(one, { tensor: [4, 0, 4] }).star1;
  assert.deepEqual(scaled, plain.map((x) => 4 * x));
  const refuses = (tensor, error) => assert.throws(() => temper.quality(one, { tensor }), error);
  refuses([1, 0], { name: 'TypeError', message: 'tensor: expected kxx, kxy, kyy, found [1,0]' });
  refuses({ 1: [1, 0, 1] }, { code: 'invalid_option', message: /for each of the regions 1, 2; there is none for 2/ });
  refuses({ 1: [1, 0, 1], 2: [1, 0, 1], 7: [1, 0, 1] }, /the mesh has no region 7/);
  refuses([[1, 0, 1]], { code: 'size_mismatch' });
  refuses([1, 2, 1], temper.TemperError);
});

test('numbers that JSON has not come through', () => {
  const q = temper.quality(temper.generate.letter_a());
  assert.equal(q.energy.BH[1], Infinity);
  assert.equal(temper.total_energy(temper.generate.letter_a(), { energy: 'BH' }), Infinity);
  assert.equal(temper.triangle_margins(temper.generate.letter_a()).length, 29);
});

test('in Node paths are those of the disk, side files too', () => {
  const mesh = temper.generate.annulus();
  temper.optimize(mesh);
  const path = join(folder, 'ring.node');
  const warnings = temper.write(path, mesh);
  const again = temper.read(join(folder, 'ring.ele'));
  assert.deepEqual(again.points, mesh.points);
  const weighted = temper.write(join(folder, 'ring.off'), mesh);
  assert(weighted.some((w) => w.includes('ring.off.weights.csv')), weighted.join());
  assert.deepEqual(temper.read(join(folder, 'ring.off')).weights, mesh.weights);
  assert(readFileSync(join(folder, 'ring.off.weights.csv'), 'utf8').length > 0);
  assert(Array.isArray(warnings));
  assert.throws(() => temper.read(folder), { code: 'not_found' });
  writeFileSync(join(folder, 'bad.off'), 'OFF\n3 1 0\n');
  assert.throws(() => temper.read(join(folder, 'bad.off')), (error) => error.message.startsWith(join(folder, 'bad.off')));
  assert.throws(() => temper.write(join(folder, 'none', 'ring.off'), mesh), /ENOENT|cannot be written/);
});

test('the HTML report is one file with both meshes, and no address of the network', () => {
  const before = temper.generate.annulus(), mesh = before.copy();
  const page = temper.html_report(mesh, { before, report: temper.optimize(mesh), title: 'a ring' });
  assert.match(page, /^<!DOCTYPE html>[^]*a ring[^]*<\/html>\s*$/i);
  assert(page.length > 200_000);
  assert.equal(page, temper.html_report(mesh, { before, report: temper.optimize(before.copy()), title: 'a ring' }));
  assert.match(temper.html_report(square()), /temper\.Mesh/);
});

test('SVG is drawn, and options are those of the table', () => {
  assert.match(temper.draw_svg(square(), { title: 'a <square>' }), /^<svg[^]*a &lt;square&gt;/);
  assert.match(temper.draw_before_after_svg(square(), square()), /^<svg/);
  const names = temper.option_table().map((row) => row.name);
  assert(names.includes('objective') && names.includes('max_sweeps'));
});

test('words set options, which others override', () => {
  const { target, effort, keep } = temper.presets();
  const names = temper.option_table().map((row) => row.name);
  for (const { name } of target) assert.deepEqual(Object.keys(temper.options_for(name)), names);
  for (const { name } of effort) assert.deepEqual(Object.keys(temper.options_for('any', name)), names);
  const defaults = Object.fromEntries(temper.option_table().map((row) => [row.name, row.default]));
  assert.deepEqual(temper.options_for(), defaults);
  for (const { name } of keep) {
    const options = temper.options_for('any', 'normal', name);
    assert.deepEqual(Object.keys(options), names);
    assert.equal(isDeepStrictEqual(options, defaults), name === 'boundary', name); // the boundary stays by default
  }
  assert.deepEqual(temper.options_for('any', 'normal', ['weights']), { ...defaults, unknowns: 'positions' });
  assert.equal(temper.options_for('mpas').star, 0);
  assert.equal(temper.options_for('paper').solver, 'golden');
  assert.equal(temper.options_for('any', 'high').repair, 'vertices');
  assert.throws(() => temper.options_for('modflow'), { code: 'invalid_option' });

  const run = (given) => {
    const mesh = temper.generate.annulus();
    temper.optimize(mesh, given);
    return mesh;
  };
  const same = (a, b) => assert(run(a).equals(run(b)), JSON.stringify([a, b]));
  same({ target: 'cell', effort: 'quick', keep: 'edges' }, { options: temper.options_for('cell', 'quick', ['edges']) });
  same({ target: 'fem', boundary: 'slide', options: { max_sweeps: 3, boundary: 'keep' } },
    { options: { ...temper.options_for('fem'), max_sweeps: 3, boundary: 'slide' } });
  assert(run({ keep: ['positions', 'edges'] }).points.every((x, i) => x === temper.generate.annulus().points[i]));
  assert(!run({ target: 'paper', options: { max_sweeps: 1 } }).equals(temper.generate.annulus()));
});

test('a time limit ends a run with a valid mesh', () => {
  const mesh = temper.generate.random_mesh({ vertices: 2000 });
  const report = temper.optimize(mesh, { time_limit: 0.01 });
  assert.equal(report.stopped, 'time_limit');
  assert.equal(mesh.validate(), null);
});

test('a mesh that was optimized elsewhere takes the place of the one that has the file', () => {
  const files = {};
  const original = temper.generate.letter_a();
  original.weights = original.weights.map((_, i) => i / 1000);
  temper.write('a.msh', original, { files });
  const here = temper.read('a.msh', { files });
  const there = new temper.Mesh(here.points, here.triangles, here.weights, { regions: here.regions, constrained_edges: here.constrained_edges, fixed: here.fixed });
  let seen = 0;
  const report = temper.optimize(there, { boundary: 'split', options: { repair: 'vertices' }, hooks: { snapshots: ({ mesh }) => void (seen += mesh.validate() === null ? 1 : 0) } });
  assert(seen > 0 && report.vertices.length === there.n_vertices);
  here.replace(there, report.vertices);
  const direct = temper.read('a.msh', { files });
  temper.optimize(direct, { boundary: 'split', options: { repair: 'vertices' } });
  temper.write('here.msh', here, { files });
  temper.write('direct.msh', direct, { files });
  assert.deepEqual(files['here.msh'], files['direct.msh']);
  assert.throws(() => direct.replace(original, [1, 2]), { code: 'size_mismatch' });
});

test('explanations have reasons, proofs and cures, and each bad triangle is in one', async () => {
  const shoe = temper.generate.sparse_horseshoe();
  const why = await temper.explain(shoe);
  assert.deepEqual([why.verdict, why.bad, why.triangles], ['infeasible', 4, 4]);
  assert.deepEqual(why.reasons.flatMap(({ triangles }) => triangles).sort(), [0, 1, 2, 3]);
  for (const reason of why.reasons) {
    assert.equal(reason.kind, 'edge');
    assert.match(reason.text, /exclude each other.*proved exactly, by a certificate/);
    assert(reason.certificate.terms.length > 0 && reason.margin < 0 && reason.crossing !== null);
    assert(reason.cures.some((cure) => cure.verified && cure.margin > 0));
  }
  const ring = await temper.explain(temper.generate.annulus(), { cures: 0 });
  assert.equal(ring.verdict, 'feasible');
  assert(ring.margin > 0 && ring.reasons.every(({ kind }) => kind === 'weights'));
  const good = temper.generate.annulus();
  temper.optimize(good);
  assert.equal((await temper.explain(good)).reasons.length, 0);
  assert.match(temper.html_report(shoe, { explanation: why }), /^<!DOCTYPE html>/);
});

test('an explanation is stopped by its listener, whose errors are thrown on', async () => {
  const grid = temper.generate.sheared_grid();
  await assert.rejects(temper.explain(grid, { progress: () => false }), { name: 'TemperError' });
  await assert.rejects(temper.explain(grid, { progress: () => assert.fail('mine') }), /mine/);
  await assert.rejects(temper.explain(grid, { cure: 3 }), TypeError);
});

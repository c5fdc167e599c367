// The package as others get it: npm pack, npm install into an empty folder, and there each example of the README, in its
// order. Prints sizes and seconds.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = join(dirname(fileURLToPath(import.meta.url)), '..');
const folder = mkdtempSync(join(tmpdir(), 'temper-npm-'));
after(() => rmSync(folder, { recursive: true }));
const run = (program, words, cwd) => execFileSync(program, words, { cwd, encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'] });

test('the package is installed in an empty folder, and the examples of its README run there', () => {
  const readme = readFileSync(join(here, 'README.md'), 'utf8');
  const examples = [...readme.matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]);
  assert(examples.length >= 3);
  const [packed] = JSON.parse(run('npm', ['pack', '--json', '--pack-destination', folder], here));
  const project = join(folder, 'project');
  mkdirSync(project);
  const begin = performance.now();
  run('npm', ['install', '--no-audit', '--no-fund', '--offline', join(folder, packed.filename)], project);
  const installed = performance.now();
  const wasm = readFileSync(join(project, 'node_modules', 'temper-mesh', 'dist', 'temper.wasm'));
  console.log(
    `package ${kB(statSync(join(folder, packed.filename)).size)}, module ${kB(wasm.length)}, by gzip ${kB(gzipSync(wasm, { level: 9 }).length)}, ` +
      `installed in ${seconds(installed - begin)}`,
  );
  writeFileSync(join(project, 'first.mjs'), examples[0]);
  const ran = performance.now();
  const said = run('node', ['first.mjs'], project);
  console.log(`the first example in ${seconds(performance.now() - ran)}`);
  assert.match(said, /^\d+ triangles are bad\n\w+ after \d+ sweeps in \S+ s\ntrue\ntrue\n$/);
  assert(statSync(join(project, 'ring.vtu')).size > 1000);

  writeFileSync(join(project, 'all.mjs'), examples.join('\n'));
  const all = run('node', ['all.mjs'], project);
  assert.match(all, /infeasible\nTriangles 0 and 3 exclude each other.* Cures it, verified/);
  assert.match(all, /square\.off square\.vtu\nindex_out_of_range \| triangle 0 uses point index 305/);
});

test('types fit the examples', () => {
  const readme = readFileSync(join(here, 'README.md'), 'utf8');
  const code = [...readme.matchAll(/```js\n(.*?)```/gs)].map((match) => match[1]).join('\n').replace('console.log(error.code', 'if (error instanceof temper.TemperError) console.log(error.code');
  const project = join(folder, 'types');
  mkdirSync(project);
  writeFileSync(join(project, 'example.ts'), code);
  const tsc = join(here, '..', 'node_modules', 'typescript', 'bin', 'tsc');
  writeFileSync(join(project, 'tsconfig.json'), JSON.stringify({
    compilerOptions: { strict: true, noEmit: true, module: 'ESNext', moduleResolution: 'Bundler', target: 'ES2022', lib: ['ES2022', 'DOM'],
      types: [], paths: { 'temper-mesh': [join(here, 'dist', 'index.d.ts')] } },
    include: ['example.ts'],
  }));
  run('node', [tsc, '-p', project], project);
});

const kB = (bytes) => `${Math.round(bytes / 1000)} kB`;
const seconds = (ms) => `${(ms / 1000).toFixed(2)} s`;

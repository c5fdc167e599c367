// Builds the page into dist/: files for any static server. Prints what a visitor loads.
import { copyFileSync, cpSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';
import { notices } from '../notices.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const dist = join(here, 'dist');
rmSync(dist, { recursive: true, force: true });
mkdirSync(dist);
const made = await build({
  entryPoints: [join(here, 'src', 'main.ts'), join(here, 'src', 'worker.ts')],
  outdir: dist,
  bundle: true,
  format: 'esm',
  target: 'es2022',
  minify: true,
  legalComments: 'eof', // that of the package, which is a bundle itself; the rest is in the notice
  metafile: true,
  external: ['./highs/highs.js'], // loaded with the first explanation
});
for (const file of ['index.html', 'style.css']) copyFileSync(join(here, file), join(dist, file));
const wasm = createRequire(import.meta.url).resolve('temper-mesh/temper.wasm');
copyFileSync(wasm, join(dist, 'temper.wasm'));
for (const folder of ['highs', 'licenses']) cpSync(join(dirname(wasm), folder), join(dist, folder), { recursive: true });

writeFileSync(join(dist, 'NOTICE'), await notices(Object.keys(made.metafile.inputs)));

/** Says how large files are, one by one and in all. */
function tell(what, folder) {
  const sizes = readdirSync(folder, { withFileTypes: true }).filter((entry) => entry.isFile() && !/NOTICE|LICENSE/.test(entry.name)).map(({ name }) => {
    const bytes = readFileSync(join(folder, name));
    return { name, whole: bytes.length, packed: gzipSync(bytes, { level: 9 }).length };
  });
  const kB = (bytes) => `${Math.round(bytes / 1000)} kB`;
  for (const { name, whole, packed } of sizes) console.log(`playground: ${name} ${kB(whole)}, by gzip ${kB(packed)}`);
  const sum = (key) => kB(sizes.reduce((total, size) => total + size[key], 0));
  console.log(`playground: ${what} ${sum('whole')} in all, by gzip ${sum('packed')}`);
}
tell('the page', dist);
tell('the solver that explanations load', join(dist, 'highs'));

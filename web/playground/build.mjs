// Builds the page into dist/: files for any static server. Prints what a visitor loads.
import { copyFileSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
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
});
for (const file of ['index.html', 'style.css']) copyFileSync(join(here, file), join(dist, file));
copyFileSync(createRequire(import.meta.url).resolve('temper-mesh/temper.wasm'), join(dist, 'temper.wasm'));

writeFileSync(join(dist, 'NOTICE'), await notices(Object.keys(made.metafile.inputs)));

let total = 0, packed = 0;
for (const name of readdirSync(dist).filter((file) => file !== 'NOTICE')) {
  const bytes = readFileSync(join(dist, name)), small = gzipSync(bytes, { level: 9 }).length;
  total += bytes.length;
  packed += small;
  console.log(`playground: ${name} ${Math.round(bytes.length / 1000)} kB, by gzip ${Math.round(small / 1000)} kB`);
}
console.log(`playground: ${Math.round(total / 1000)} kB in all, by gzip ${Math.round(packed / 1000)} kB`);

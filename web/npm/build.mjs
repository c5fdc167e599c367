// Builds the package into dist/: the module, the two platforms, the types.
import { execFileSync } from 'node:child_process';
import { copyFileSync, cpSync, existsSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '..', '..');
const module = join(root, 'build', 'wasm');
const wasm = join(module, 'web', 'wasm', 'temper.wasm');
if (!existsSync(wasm)) {
  console.error(`npm: ${wasm} is missing: scripts/build.sh wasm makes it`);
  process.exit(1);
}

// The solver stays a module of its own: only who asks for explanations loads it.
const solverApart = {
  name: 'solver apart',
  setup: (on) => on.onResolve({ filter: /^highs$/ }, () => ({ path: './highs/highs.js', external: true })),
};

rmSync(join(here, 'dist'), { recursive: true, force: true });
const shim = readFileSync(join(dirname(createRequire(import.meta.url).resolve('@bjorn3/browser_wasi_shim')), '..', 'LICENSE-MIT'), 'utf8');
await build({
  entryPoints: [join(here, 'src', 'node.ts'), join(here, 'src', 'browser.ts')],
  outdir: join(here, 'dist'),
  bundle: true,
  format: 'esm',
  target: 'es2022',
  external: ['node:*'],
  plugins: [solverApart],
  banner: { js: `/*! temper, Apache-2.0. With @bjorn3/browser_wasi_shim:\n\n${shim.trim()}\n*/` },
});
mkdirSync(join(here, 'dist', 'highs'));
const highs = join(dirname(createRequire(import.meta.url).resolve('highs')), '..');
// As .js, which every server knows.
for (const [file, name] of [['build/highs.mjs', 'highs.js'], ['build/highs.wasm', 'highs.wasm'], ['LICENSE', 'LICENSE']]) {
  copyFileSync(join(highs, file), join(here, 'dist', 'highs', name));
}
copyFileSync(wasm, join(here, 'dist', 'temper.wasm'));
cpSync(join(module, 'licenses'), join(here, 'dist', 'licenses'), { recursive: true });
copyFileSync(join(root, 'LICENSE'), join(here, 'LICENSE'));

const tsc = createRequire(import.meta.url).resolve('typescript/bin/tsc');
execFileSync(process.execPath, [tsc, '-p', join(here, 'tsconfig.json')], { stdio: 'inherit' });

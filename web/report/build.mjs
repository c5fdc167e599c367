// Makes dist/report.html: the page of the HTML report as one file, without data. temper fills them in where the page has
// the mark below.
import { build } from 'esbuild';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { notices } from '../notices.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
const bundle = async (entry) => {
  const made = await build({
    entryPoints: [`${here}src/${entry}`],
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    format: 'iife',
    target: ['es2021', 'chrome90', 'firefox113', 'safari16.4'],
    legalComments: 'none', // all of them are in the notice
  });
  return { text: made.outputFiles[0].text.trim(), inputs: Object.keys(made.metafile.inputs) };
};

const script = await bundle('main.ts');
const style = await bundle('style.css');
const notice = await notices(script.inputs);
const template = await readFile(`${here}src/page.html`, 'utf8');
const page = template
  .replace('/*style*/', () => style.text)
  .replace('/*script*/', () => script.text.replaceAll('</script', '<\\/script'))
  .replace('<!--notice-->', () => `<!--\n${notice.trim()}\n-->`);
await mkdir(`${here}dist`, { recursive: true });
await writeFile(`${here}dist/report.html`, page);
await writeFile(`${here}dist/NOTICE`, notice);
console.log(`report.html: ${page.length} bytes`);

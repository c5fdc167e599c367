// The licences of all packages that a bundle has parts of.
import { readdir, readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';

const modules = fileURLToPath(new URL('node_modules/', import.meta.url));

/** `inputs`: the files of a bundle, as esbuild names them. Sorted by package; an error where a licence is missing. */
export async function notices(inputs) {
  const packages = new Set();
  for (const path of inputs) {
    const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(path);
    if (found) packages.add(found[1]);
  }
  let text = 'This page contains parts of the following packages.\n';
  for (const name of [...packages].sort()) {
    const { version, license } = JSON.parse(await readFile(`${modules}${name}/package.json`, 'utf8'));
    const file = (await readdir(modules + name)).find((each) => /^licen[cs]e/i.test(each));
    if (!file) throw new Error(`${name} has no licence file`);
    const words = (await readFile(`${modules}${name}/${file}`, 'utf8')).replaceAll('-->', '-- >').trim();
    text += `\n${'-'.repeat(80)}\n${name} ${version} (${license})\n\n${words}\n`;
  }
  return text;
}

// The caller in JavaScript: node run.mjs PACKAGE IN OUT ARGUMENTS reads a mesh, optimizes it, and writes it.
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, input, output, given] = process.argv.slice(2);
const temper = await import(pathToFileURL(join(folder, 'dist', 'node.js')));
const mesh = temper.read(input);
const report = temper.optimize(mesh, JSON.parse(given));
temper.write(output, mesh);
console.log(report.objective);

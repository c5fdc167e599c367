// temper for browsers, their workers, and other platforms with fetch: files are given and taken by their names.
import { start } from './module.ts';

const response = fetch(new URL('./temper.wasm', import.meta.url));
// A server that does not know of WebAssembly calls it something else.
const compiled = response.then(async (r) => {
  if (!r.ok) throw new Error(`temper: ${r.url}: ${r.status} ${r.statusText}`);
  return r.headers.get('content-type') === 'application/wasm'
    ? WebAssembly.compileStreaming(r)
    : WebAssembly.compile(await r.arrayBuffer());
});
await start(compiled, null);

export * from './index.ts';

// The browser that pages are tested in, and a server for a folder of files.
import { createServer } from 'node:http';
import { readFile } from 'node:fs/promises';
import { extname, join, normalize } from 'node:path';
import playwright from 'playwright-core';

const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm' };

/** Serves the files of a folder. Returns its address, and how to end it. */
export function serve(folder) {
  const server = createServer(async (request, response) => {
    const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname)).replace(/\/$/, '/index.html');
    try {
      const bytes = await readFile(join(folder, path));
      response.writeHead(200, { 'content-type': kTypes[extname(path)] ?? 'application/octet-stream' }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((resolve) => {
    server.listen(0, '127.0.0.1', () => resolve({ url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() }));
  });
}

/** Debian's Chromium, without a screen. TEMPER_BROWSER=firefox: Debian's Firefox, by WebDriver BiDi, on a screen, as it has no WebGL
 * without one: TEMPER_BROWSER=firefox xvfb-run -s "-screen 0 1400x900x24" node --test … */
export function launch() {
  if (process.env.TEMPER_BROWSER === 'firefox') {
    return playwright._bidiFirefox.launch({
      executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr',
      headless: false,
      firefoxUserPrefs: { 'webgl.force-enabled': true },
    });
  }
  return playwright.chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--headless', '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic',
      '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });
}

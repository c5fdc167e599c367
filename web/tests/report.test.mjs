// The HTML report in a browser: each control does what it says, nothing is written to the console, nothing is asked of the
// network. Pictures go to TEMPER_PICTURES, when that is set.
//
//   TEMPER_PROGRAM=…/temper [TEMPER_SHARED=…] node --test tests/*.test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { launch } from './browser.mjs';

const program = process.env.TEMPER_PROGRAM;
const pictures = process.env.TEMPER_PICTURES;
const folder = mkdtempSync(join(tmpdir(), 'temper-report-'));
const file = (name) => join(folder, name);
const temper = (...words) => execFileSync(program, words, { cwd: folder, stdio: ['ignore', 'pipe', 'pipe'] });

let browser;

before(async () => {
  assert.ok(program, 'TEMPER_PROGRAM: the program that writes the reports');
  if (pictures) mkdirSync(pictures, { recursive: true });
  browser = await launch();
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

/** Opens a page; what it says to the console, and asks of the network, fails the test that closes it. */
async function open(name, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1360, height: 860 }, ...options });
  const page = await context.newPage();
  const heard = [];
  page.on('console', (message) => heard.push(message.text()));
  page.on('pageerror', (error) => heard.push(String(error)));
  page.on('request', (request) => {
    if (!/^(file|data|blob):/.test(request.url())) heard.push(`asked for ${request.url()}`);
  });
  const begin = Date.now();
  await page.goto(pathToFileURL(file(name)).href);
  await page.waitForSelector('html[data-ready]', { timeout: 120_000 });
  const seconds = (Date.now() - begin) / 1000;
  const close = async () => {
    await context.close();
    assert.deepEqual(heard, []);
  };
  return { page, close, seconds };
}

const shoot = async (page, name, options = {}) => {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`), ...options });
};
/** The pixels of the mesh, after the next frame. */
const drawn = (page) => page.evaluate(() => window.temperViewer.image());
/** That an action changes the picture. */
async function changes(page, what, action) {
  const old = await drawn(page);
  await action();
  assert.ok((await drawn(page)) !== old, `${what} changes nothing`); // not notEqual, which would print the pictures
}

/** The middle of the triangle whose middle is nearest to a place of the view: the mesh may have a hole there. */
const triangleNear = (page, x, y) => page.evaluate((at) => {
  const viewer = window.temperViewer, { points, triangles } = viewer.meshOf('after');
  const away = (place) => Math.hypot(place[0] - at[0], place[1] - at[1]);
  let nearest = [Infinity, Infinity];
  for (let h = 0; h < triangles.length; h += 3) {
    const mean = (k) => (points[2 * triangles[h] + k] + points[2 * triangles[h + 1] + k] + points[2 * triangles[h + 2] + k]) / 3;
    const middle = viewer.toScreen(mean(0), mean(1));
    if (away(middle) < away(nearest)) nearest = middle;
  }
  return nearest;
}, [x, y]);

function makeMesh() {
  const shared = process.env.TEMPER_SHARED;
  const path = shared && join(shared, 'meshes', 'sfepy_circle_in_square.mesh');
  if (path && existsSync(path)) return path;
  temper('example', 'random', '-o', 'in.vtu');
  return 'in.vtu';
}

test('each control of a report of optimize does what it says', async () => {
  temper('optimize', makeMesh(), '-o', 'out.vtu', '--measure-errors', '--write', 'optimize.html');
  const { page, close } = await open('optimize.html');
  await shoot(page, 'optimize-light');
  assert.match(await page.textContent('#verdict'), /well-centered/);
  for (const section of ['summary', 'worst', 'histograms', 'sweeps', 'errors', 'again', 'keys']) {
    assert.ok((await page.textContent(`#${section}`)).length > 3, `#${section} is empty`);
  }
  assert.match(await page.textContent('#again pre'), /^temper optimize /);
  assert.equal(await page.locator('#loading').count(), 0);
  assert.equal(await page.inputValue('#measure'), 'margin');
  const least = page.locator('#summary tr', { hasText: /^Least h\/l/ }).first();
  assert.equal(await least.locator('td').first().getAttribute('class'), 'is-bad');
  assert.equal(await least.locator('td').last().getAttribute('class'), '');
  const measures = await page.evaluate(() => JSON.parse(document.querySelector('#measures').textContent));
  assert.equal(await page.locator('#summary tbody tr').count(), measures.length);
  for (const community of await page.locator('#summary details').all()) await community.locator('summary').click();
  assert.equal(await page.locator('#summary tbody tr:visible').count(), measures.length);
  assert.equal(await page.locator('#histograms svg').count(), 3);
  assert.equal(await page.locator('#sweeps svg path.line').count(), 3);

  for (const side of ['before', 'after']) await changes(page, side, () => page.check(`[name=side][value=${side}]`, { force: true }));
  await page.check('[name=side][value=both]', { force: true });
  const view = await page.locator('#view').boundingBox();
  await changes(page, 'the divider', async () => {
    await page.mouse.move(view.x + view.width / 2, view.y + view.height / 2);
    await page.mouse.down();
    await page.mouse.move(view.x + view.width / 4, view.y + view.height / 2, { steps: 4 });
    await page.mouse.up();
  });
  await page.focus('#divider');
  await changes(page, 'the divider by keys', () => page.keyboard.press('ArrowRight'));

  for (const layer of await page.locator('#layers input').all()) {
    await changes(page, await layer.getAttribute('value'), () => layer.click({ force: true }));
  }
  for (const option of await page.locator('#measure option:not([value=""])').all()) {
    const value = await option.getAttribute('value');
    await page.selectOption('#measure', '');
    await changes(page, `color ${value}`, () => page.selectOption('#measure', value));
    assert.ok((await page.textContent('#legend')).includes((await option.textContent()).trim()));
  }
  await page.selectOption('#measure', 'margin');
  for (const layer of ['orthocenters', 'weights']) await page.uncheck(`#layers [value=${layer}]`, { force: true });
  for (const layer of ['primal', 'dual', 'bad']) await page.check(`#layers [value=${layer}]`, { force: true });
  await shoot(page, 'optimize-margin');

  await changes(page, 'zooming in', () => page.click('#closer'));
  await changes(page, 'zooming out', () => page.click('#farther'));
  await changes(page, 'the wheel', () => page.mouse.move(view.x + 300, view.y + 300).then(() => page.mouse.wheel(0, -400)).then(() => page.waitForTimeout(200)));
  await changes(page, 'dragging', async () => {
    await page.mouse.move(view.x + 500, view.y + 300);
    await page.mouse.down();
    await page.mouse.move(view.x + 560, view.y + 360, { steps: 4 });
    await page.mouse.up();
  });
  await changes(page, 'Fit', () => page.click('#fit'));
  const [x, y] = await triangleNear(page, view.width * 0.62, view.height / 2);
  await page.mouse.click(view.x + x, view.y + y);
  assert.match(await page.textContent('#picked h2'), /^Triangle \d+, after/);
  await page.click('#picked button');
  assert.equal(await page.textContent('#picked'), '');

  await page.focus('#view');
  for (const key of ['ArrowLeft', 'ArrowDown', '+', '-', '0', 'c', 'b', 'a', 's', '1', '2', '3', '4', '5', 'n', 'p']) await page.keyboard.press(key);
  assert.match(await page.textContent('#picked h2'), /^Triangle/);
  await page.keyboard.press('Escape');
  assert.equal(await page.textContent('#picked'), '');

  await page.click('#again button');
  await page.waitForFunction(() => /Copied|Selected/.test(document.querySelector('#again button').textContent), null, { timeout: 5000 });
  await page.click('#keys summary');
  await close();
});

test('a click on one of the worst shows it, with its reason', async () => {
  temper('example', 'sparse-horseshoe', '-o', 'shoe.vtu');
  temper('check', 'shoe.vtu', '--write', 'check.html');
  const { page, close } = await open('check.html', { colorScheme: 'dark' });
  assert.match(await page.textContent('#verdict'), /not well-centered/);
  assert.ok(await page.isHidden('#sides') && await page.isHidden('#divider'));
  await page.click('#worst tbody tr');
  assert.match(await page.textContent('#picked'), /h ≤ 0 at edge/);
  assert.match(await page.textContent('#picked details'), /Why, and what would help/);
  assert.equal(await page.locator('#picked td.is-bad').count() > 0, true);
  await page.waitForTimeout(100);
  await shoot(page, 'check-dark');
  await close();
});

/** A box of n³ cubes in six tetrahedra each, as a file of medit. Inner vertices are moved, and two halves are regions. */
function writeBox(name, n) {
  const points = [], tetrahedra = [];
  const index = (x, y, z) => (z * (n + 1) + y) * (n + 1) + x + 1;
  const moved = (x, axis, i) => (x > 0 && x < n && axis !== 0 ? x + 0.2 * Math.sin(9 * i + axis) : x);
  for (let z = 0; z <= n; z++) for (let y = 0; y <= n; y++) for (let x = 0; x <= n; x++) {
    const inside = [x, y, z].every((c) => c > 0 && c < n), i = points.length;
    points.push(inside ? `${x} ${moved(y, 1, i)} ${moved(z, 2, i)} 0` : `${x} ${y} ${z} 0`);
  }
  for (let z = 0; z < n; z++) for (let y = 0; y < n; y++) for (let x = 0; x < n; x++) {
    for (const [a, b] of [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]]) {
      const corner = (c) => index(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2));
      tetrahedra.push([...[0, a, b, 7].map(corner), x < n / 2 ? 1 : 2].join(' '));
    }
  }
  writeFileSync(file(name), ['MeshVersionFormatted 2', 'Dimension 3', 'Vertices', points.length, ...points, 'Tetrahedra', tetrahedra.length, ...tetrahedra, 'End', ''].join('\n'));
}

/** The sum of the areas of the triangles of a cut, and the words about it. */
const section = (page) => page.evaluate(() => {
  const { points, triangles } = window.temperViewer.meshOf('after');
  let area = 0;
  for (let h = 0; h < triangles.length; h += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [points[2 * triangles[h + k]], points[2 * triangles[h + k] + 1]]);
    area += ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  }
  return { area, words: document.querySelector('#view').getAttribute('aria-label') };
});

test('tetrahedra are cut by a plane that the user moves', async () => {
  writeBox('box.mesh', 4);
  temper('optimize', 'box.mesh', '-o', 'box.vtu', '--set', 'max_sweeps=2', '--write', 'tets.html');
  const { page, close } = await open('tets.html');
  await shoot(page, 'tetrahedra');
  assert.match(await page.textContent('#verdict'), /of 384 tetrahedra are/);
  assert.match((await section(page)).words, /^Cut at z = 2: \d+ tetrahedra, \d+ of them bad/);
  for (const axis of ['z', 'x', 'y']) {
    if (axis !== 'z') await changes(page, axis, () => page.check(`[name=axis][value="${'xyz'.indexOf(axis)}"]`, { force: true }));
    for (const [part, at] of [[1, 0.004], [250, 1], [500, 2], [777, 3.108], [1000, 3.996]]) { // along faces of the boundary, and elsewhere
      await page.locator('#plane input').fill(String(part));
      await page.waitForSelector(`#plane input[aria-valuetext="${axis} = ${at}"]`);
      const { area, words } = await section(page);
      assert.ok(Math.abs(area - 16) < 1e-9, `${axis} ${part}: ${area}`);
      assert.ok(words.startsWith(`Cut at ${axis} = ${at}: `), words);
    }
  }
  for (const option of await page.locator('#measure option').all()) await page.selectOption('#measure', await option.getAttribute('value'));
  await page.selectOption('#measure', 'margin');
  assert.ok((await page.textContent('#legend')).includes('Margin: least h/ℓ'));
  await page.click('#worst tbody tr');
  assert.match(await page.textContent('#picked h2'), /^Tetrahedron \d+/);
  assert.equal(await page.locator('#picked table').first().locator('tbody tr').count(), 4);
  assert.match(await page.textContent('#picked'), /h ≤ 0 at face/);
  await page.focus('#view');
  for (const key of ['x', 'y', '[', ']', '1', '2', 'n', 'p', 'c', 'b', 'a', 's']) await page.keyboard.press(key);
  await close();
});

test('it fits a telephone, and paper', async () => {
  const { page, close } = await open('optimize.html', { viewport: { width: 390, height: 844 }, hasTouch: true });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'it is wider than the screen');
  await shoot(page, 'optimize-narrow');
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await page.emulateMedia({ media: 'print' });
  assert.ok(await page.isVisible('#printed'));
  assert.equal(await page.locator('#summary details:not([open])').count(), 0);
  assert.equal(await page.textContent('#printed figcaption'), 'Left before, right after');
  await shoot(page, 'optimize-print', { fullPage: true });
  await close();
});

/** Milliseconds from one frame of the page to the next, while the mesh is dragged by the mouse; sorted. */
async function dragTimes(page) {
  const view = await page.locator('#view').boundingBox();
  await page.waitForTimeout(2500); // the first frames compile the shaders
  await page.mouse.move(view.x + 400, view.y + 300);
  await page.mouse.down();
  await page.mouse.move(view.x + 405, view.y + 300);
  await page.waitForTimeout(1500);
  await page.evaluate(() => {
    window.frameTimes = [];
    let last = performance.now();
    const tick = (now) => {
      window.frameTimes.push(now - last);
      last = now;
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  });
  for (let i = 0; i < 60; i++) await page.mouse.move(view.x + 400 + 3 * i, view.y + 300 + 2 * i);
  const times = await page.evaluate(() => window.frameTimes.slice(1).sort((a, b) => a - b));
  await page.mouse.up();
  return times;
}

/** Frames while the mesh is moved: their times in milliseconds, sorted. */
const frames = (page) => page.evaluate(() => {
  const times = [];
  for (let i = 0; i < 20; i++) {
    window.temperViewer.panBy(i % 2 ? 30 : -25, 10 - i);
    times.push(window.temperViewer.drawNow());
  }
  return times.sort((a, b) => a - b);
});

for (const [triangles, points] of [[100_000, 50_000], [1_000_000, 500_000]]) {
  test(`${triangles} triangles open and move`, { timeout: 600_000 }, async (t) => {
    const name = `${triangles}.html`;
    temper('example', 'random', '--vertices', String(points), '-o', 'large.vtu');
    temper('check', 'large.vtu', '--write', name);
    const { page, close, seconds } = await open(name);
    const drag = await dragTimes(page);
    const whole = await frames(page);
    await page.evaluate(() => window.temperViewer.zoomToTriangle(1000));
    const near = await frames(page);
    const part = (times, p) => times[Math.floor(p * (times.length - 1))].toFixed(0);
    t.diagnostic(`dragged: a frame each ${part(drag, 0.5)} ms, nine of ten within ${part(drag, 0.9)} ms`);
    t.diagnostic(`${(statSync(file(name)).size / 1e6).toFixed(1)} MB, open in ${seconds.toFixed(1)} s, ` +
      `a frame in ${whole[10].toFixed(0)} ms (whole mesh) and ${near[10].toFixed(0)} ms (near), medians without a graphics card`);
    await shoot(page, name);
    await close();
  });
}

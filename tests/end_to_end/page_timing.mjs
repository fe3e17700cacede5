// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What a report with a large front takes of a browser: node page_timing.mjs REPORT.html POINTS. Between the
// points of the report's front lie as many as wanted, evenly mixed, in a copy that is removed afterwards. Of
// each thing that a reader does: processor time of the page's main thread until two frames are drawn after
// it, which other work on the machine does not lengthen, and of what the page puts off until the reader
// rests. Median and most of several times.

import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {openPage} from './browser.mjs';

const [source, wanted] = [process.argv[2], Number(process.argv[3])];
const open = '<script type="application/json" id="report-data">';

const mixed = (a, b, w) =>
  Array.isArray(a) ? a.map((value, k) => mixed(value, b[k], w)) : typeof a === 'number' ? a + w * (b - a) : a;

/// Lists with a value per point, each as long as wanted.
function enlarged(front, count) {
  const n = front.X.length;
  const longer = (list) =>
    Array.from({length: count}, (_, i) => {
      const at = (i * (n - 1)) / (count - 1),
        k = Math.min(n - 2, Math.floor(at));
      return mixed(list[k], list[k + 1], at - k);
    });
  return Object.fromEntries(
    Object.entries(front).map(([key, value]) => [
      key,
      Array.isArray(value) && value.length === n && key !== 'bands' ? longer(value) : value,
    ]),
  );
}

function largePage(file, count) {
  const page = readFileSync(file, 'utf8'),
    begin = page.indexOf(open) + open.length,
    end = page.indexOf('</script', begin);
  const data = JSON.parse(page.slice(begin, end));
  data.front = enlarged(data.front, count);
  data.illustrations = data.contrasts = []; // scenes are the graphics card's to draw
  return page.slice(0, begin) + JSON.stringify(data).replaceAll('<', '\\u003c') + page.slice(end);
}

const folder = mkdtempSync(join(tmpdir(), 'timing-')),
  file = join(folder, 'report.html');
writeFileSync(file, largePage(source, wanted));
const page = await openPage(file);
const {processor} = page;
await page.settled();

/// What the page puts off is kept until it is asked for: on a busy machine it would come between.
await page.evaluate(`(() => {
  const held = [], now = window.setTimeout.bind(window), forget = window.clearTimeout.bind(window);
  window.setTimeout = (f, delay = 0, ...rest) =>
    delay >= 100 && delay <= 200 ? -held.push(f) : now(f, delay, ...rest);
  window.clearTimeout = (id) => { if (id < 0) held[-id - 1] = null; else forget(id); };
  window.atRest = () => { for (const f of held.splice(0)) f?.(); };
})()`);

const summary = (list) => {
  const s = [...list].sort((a, b) => a - b);
  return `${Math.round(s[s.length >> 1])} (${Math.round(s[s.length - 1])})`;
};

async function time(name, acts) {
  const first = [],
    rest = [];
  for (const act of acts) {
    const begin = await processor();
    await act();
    await page.settled();
    const done = await processor();
    first.push(done - begin);
    await page.evaluate('atRest()');
    await page.settled();
    rest.push((await processor()) - done);
  }
  console.log(`| ${name} | ${summary(first)} | ${summary(rest)} |`);
}

const one = (selector) => `document.querySelector(${JSON.stringify(selector)})`;
const clicks = (expression) => () => page.evaluate(`(${expression}).click()`);
const times = (count, act) => Array.from({length: count}, (_, k) => () => act(k));

if (page.errors.length) throw new Error(page.errors.join('\n'));
console.log(
  `${page.product}; ${wanted} points, ${Math.round(readFileSync(file).length / 1e5) / 10} MB; drawn after ` +
    `${Math.round(await processor())} ms of the processor, ${Math.round(page.loaded)} ms by the clock`,
);
console.log('| Act | Until it is drawn [ms] | At rest [ms] |\n|---|---|---|');

// Along the first axis, step by step.
const axes = one('#designs .parallel svg');
await page.place(axes, [0, 0]);
const line = await page.evaluate(
  `(() => { const r = document.querySelector('#designs .parallel svg line').getBoundingClientRect(); return ` +
    `[r.left + r.width / 2, r.top, r.height]; })()`,
);
const along = (share) => [line[0], line[1] + share * line[2]];
await page.mouse('mousePressed', along(0.2));
await time(
  'brush of an axis, a step',
  times(10, (k) => page.mouse('mouseMoved', along(0.25 + 0.05 * k))),
);
await page.mouse('mouseReleased', along(0.7));
await time(
  'clear the selection',
  times(3, async () => {
    await page.evaluate(
      `[...document.querySelectorAll('.selection button')].find((b) => b.textContent === 'Clear selection').click()`,
    );
  }),
);

const plot = one('#front .plot .nsewdrag');
const [left, top] = await page.place(plot, [0, 0]),
  [right, bottom] = await page.place(plot, [1, 1]);
const inside = (x, y) => [left + x * (right - left), top + y * (bottom - top)];
await time(
  'hover in a trade-off, a step',
  times(10, (k) => page.mouse('mouseMoved', inside(0.2 + 0.06 * k, 0.8 - 0.06 * k), {buttons: 0, button: 'none'})),
);
await page.mouse('mousePressed', inside(0.1, 0.1));
await time(
  'box in a trade-off, a step',
  times(8, (k) => page.mouse('mouseMoved', inside(0.2 + 0.08 * k, 0.2 + 0.08 * k))),
);
await time('box in a trade-off, released', [() => page.mouse('mouseReleased', inside(0.76, 0.76))]);
await clicks(`[...document.querySelectorAll('.selection button')].find((b) => b.textContent === 'Clear selection')`)();
await page.evaluate('atRest()');
await time(
  'colour by another variable',
  times(3, (k) => page.choose(one('#front select'), String(k + 1))),
);
await time(
  'table: sort',
  times(6, (k) => clicks(`document.querySelectorAll('#front th button')[${1 + (k >> 1)}]`)()),
);
const box = one('#front input[type=search]');
await time(
  'table: filter',
  ['1', '12', '1', '', '0.5', ''].map(
    (text) => () =>
      page.evaluate(
        `(() => { const box = ${box}; box.value = ${JSON.stringify(text)}; box.dispatchEvent(new Event('input')); })()`,
      ),
  ),
);
await time(
  'table: next page',
  times(3, () => clicks(one('#front .pager button:last-child'))()),
);
await time(
  'mark a row',
  times(3, (k) => clicks(`document.querySelectorAll('#front tbody tr')[${k}]`)()),
);
await page.close();
rmSync(folder, {recursive: true});

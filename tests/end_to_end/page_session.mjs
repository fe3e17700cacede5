// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Goes through a report or a replay as a reader does, in a headless Chromium: node page_session.mjs
// PAGE.html. Says what it did and what came of it, a line each; fails where something did not come, the
// console had an error, the page asked for anything but itself, or a report takes more than eight sheets of
// paper. What a page does not have is named, and not tried.

import assert from 'node:assert/strict';
import {mkdtempSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {openPage} from './browser.mjs';

const mostSheets = 8;
const downloads = mkdtempSync(join(tmpdir(), 'saved-'));
process.once('exit', () => rmSync(downloads, {recursive: true, force: true}));
const page = await openPage(resolve(process.argv[2]), {downloads});
const {evaluate, until, click, drag, press, type, wheel, choose} = page;
const one = (selector) => `document.querySelector(${JSON.stringify(selector)})`;
const button = (within, text) =>
  `[...document.querySelectorAll(${JSON.stringify(within + ' button')})].find((b) => ` +
  `b.textContent.startsWith(${JSON.stringify(text)}))`;
const text = (element) => evaluate(`(${element}).textContent`);
const count = (selector) => evaluate(`document.querySelectorAll(${JSON.stringify(selector)}).length`);

async function step(name, needs, does) {
  if (!(await evaluate(`Boolean(${needs})`))) {
    console.log(`${name}: not on this page`);
    return;
  }
  try {
    console.log(`${name}: ${await does()}`);
  } catch (error) {
    throw new Error(`${name}: ${error.message}`, {cause: error});
  }
}

/// Numbers of the first rows of a table's column.
const column = (table, k) =>
  evaluate(
    `[...document.querySelectorAll(${JSON.stringify(table + ' tbody tr')})].map((row) => ` +
      `row.children[${k}].textContent)`,
  );

const seen = new Set();
/// A file that the page saves, not one of before: {name, text}.
async function saved(ending) {
  const found = () => readdirSync(downloads).find((name) => name.endsWith(ending) && !seen.has(name));
  for (let k = 0; k < 100 && !found(); ++k) await new Promise((r) => setTimeout(r, 50));
  const name = found();
  assert.ok(name, 'no file came');
  seen.add(name);
  return {name, text: readFileSync(join(downloads, name), 'utf8')};
}

const front = '#front .whole-table',
  bar = '.selection',
  axes = '#designs .parallel svg';
const selected = async () => (await text(one(bar))).match(/Selected: (.*?)Clear/)?.[1];

console.log(`${page.product}, ${await evaluate('document.title')}`);

/// Whether an element ends above the lower edge of the window, and none reaches beyond its right edge.
const bottom = (element) => evaluate(`Math.round((${element}).getBoundingClientRect().bottom)`);
const inWidth = () => evaluate('document.documentElement.scrollWidth <= innerWidth');
const screens = {desktop: [1440, 900], phone: [390, 844]};
await step('first screen', one('#summary'), async () => {
  const said = [];
  for (const [name, [width, height]] of Object.entries(screens)) {
    const mobile = name === 'phone';
    await page.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile});
    await page.settled();
    const sentences = await count('#summary > .sentence');
    assert.equal(sentences, 3, 'the answer has three sentences');
    assert.ok((await bottom("[...document.querySelectorAll('#summary > .brief')].at(-1)")) < height, `${name}: next`);
    const plot = await bottom(one('#summary .plot'));
    assert.ok(plot < height, `${name}: the trade-off ends at ${plot} px`);
    assert.ok(await inWidth(), `${name}: it is wider than the window`);
    if (!mobile)
      assert.ok(
        await evaluate(
          "(() => { const n = document.querySelector('nav .inner'); return n.scrollWidth <= n.clientWidth; })()",
        ),
        'the navigation is cut off',
      );
    said.push(`${name}: trade-off down to ${plot} px of ${height}`);
  }
  assert.ok(
    await evaluate(`document.querySelector('#summary .sentence code') !== null`),
    'no command for what is not simulated',
  );
  assert.equal(await evaluate("document.querySelector('#making details').open"), false, 'the tiles are folded');
  await page.send('Emulation.setDeviceMetricsOverride', {
    width: 1440,
    height: 900,
    deviceScaleFactor: 1,
    mobile: false,
  });
  await page.settled();
  const table = "document.querySelector('#front .whole-table .table')";
  assert.ok(await evaluate(`${table}.scrollWidth <= ${table}.clientWidth`), 'the table of the front is cut off');
  const named = (
    await evaluate("[...document.querySelector('#front .js-plotly-plot').data.find((t) => t.name === 'named').text]")
  ).join(', ');
  await page.send('Emulation.setDeviceMetricsOverride', {
    width: 1280,
    height: 900,
    deviceScaleFactor: 1,
    mobile: false,
  });
  await page.settled();
  return `${said.join(', ')}; named: ${named}`;
});
await step('sections', one('nav a'), async () => {
  const names = await evaluate('[...document.querySelectorAll("nav a")].map((a) => a.textContent)');
  for (let k = 0; k < names.length; ++k) {
    await click(`document.querySelectorAll('nav a')[${k}]`);
    await until(`location.hash === document.querySelectorAll('nav a')[${k}].hash`);
  }
  return names.join(', ');
});
await step('colours', one('button.theme'), async () => {
  const before = await evaluate('document.documentElement.dataset.theme');
  await click(one('button.theme'));
  await until(`document.documentElement.dataset.theme !== "${before}"`);
  await click(one('button.theme'));
  await until(`document.documentElement.dataset.theme === "${before}"`);
  return 'the other ones and back';
});
// Before anything is opened that paper would then show.
await step('paper', one('#summary'), async () => {
  const sheets = [];
  for (const [name, paperWidth, paperHeight] of [
    ['letter', 8.5, 11],
    ['A4', 8.27, 11.69],
  ]) {
    const {data} = await page.send('Page.printToPDF', {paperWidth, paperHeight, printBackground: true});
    const count = Buffer.from(data, 'base64')
      .toString('latin1')
      .match(/\/Type\s*\/Page\b(?!s)/g).length;
    assert.ok(count <= mostSheets, `${count} sheets of ${name}`);
    sheets.push(`${count} sheets of ${name}`);
  }
  return sheets.join(', ');
});
await step('what to do next', one('ol.next'), async () =>
  (await evaluate("[...document.querySelectorAll('ol.next li')].map((item) => item.textContent)")).join(' '),
);
await step('table, sorted', one(front), async () => {
  await click(`document.querySelectorAll('${front} th button')[1]`);
  const up = await column(front, 1);
  assert.deepEqual(
    up,
    [...up].sort((a, b) => a - b),
  );
  await click(`document.querySelectorAll('${front} th button')[1]`);
  const down = await column(front, 1);
  assert.deepEqual(
    down,
    [...down].sort((a, b) => b - a),
  );
  assert.ok(Number(down[0]) > Number(up[0]));
  return `from ${up[0]}, then from ${down[0]}`;
});
await step('table, filtered', one(front), async () => {
  const before = await text(button(front, 'Copy')),
    wanted = (await column(front, 1))[0];
  await click(one(front + ' input[type=search]'));
  await type(wanted);
  await until(`${button(front, 'Copy')}.textContent !== "${before}"`);
  const after = await text(button(front, 'Copy'));
  await evaluate(`${one(front + ' input[type=search]')}.select()`);
  await press('Home');
  await evaluate(
    `(() => { const box = ${one(front + ' input[type=search]')}; box.value = ''; box.dispatchEvent(new ` +
      `Event('input')); })()`,
  );
  await until(`${button(front, 'Copy')}.textContent === "${before}"`);
  return `${after} for "${wanted}", then ${before} again`;
});
await step('table, copied', one(front), async () => {
  await click(button(front, 'Copy'));
  await until(`${one(front + ' .tools .note')}.textContent === 'Copied'`, 5000);
  return 'it says so';
});
await step('table, downloaded', one(front), async () => {
  await click(button(front, 'Download'));
  return (await saved('.csv')).name;
});
await step('row, marked', one(front), async () => {
  await click(`document.querySelectorAll('${front} tbody tr')[0].children[1]`);
  await until(`${one(bar)}.textContent.includes('Marked: point')`);
  const marked = (await text(one(bar))).match(/Marked: (point \d+ of the front)/)[1];
  await click(button(bar, 'Take mark away'));
  return marked;
});
/// The place of a point of the front in the first trade-off, as shares of the plot's area; the point farthest
/// right.
const inPlot = () =>
  evaluate(`(() => {
  const {_fullData: traces, _fullLayout: {xaxis, yaxis}} = document.querySelector('#front ' +
    '.js-plotly-plot'), {x, y} = traces.find((t) => t.name === 'front');
  const k = x.reduce((best, value, i) => (value > x[best] ? i : best), 0);
  return [xaxis.l2p(x[k]) / xaxis._length, yaxis.l2p(y[k]) / yaxis._length];
})()`);
const area = one('#front .plot .nsewdrag');
await step('point, pointed at', area, async () => {
  await page.mouse('mouseMoved', await page.place(area, await inPlot()), {buttons: 0, button: 'none'});
  await until(one('#front .hoverlayer .hovertext'));
  return (await text(one('#front .hoverlayer .hovertext'))).slice(0, 60);
});
await step('point, clicked', area, async () => {
  await click(area, await inPlot());
  await until(`${one(bar)}.textContent.includes('Marked: ')`);
  const marked = (await text(one(bar))).match(/Marked: ([^(]*\d+)/)[1];
  const seen = await evaluate(
    `(() => { const row = document.querySelector('#front tr[data-selected]'), r = row?.getBoundingClientRect(), ` +
      `f = row?.closest('table').parentElement.getBoundingClientRect(); return Boolean(r) && r.top >= f.top && ` +
      `r.bottom <= f.bottom + 1; })()`,
  );
  assert.ok(seen, 'its row is not in view in the table');
  await click(button(bar, 'Take mark away'));
  return marked;
});
await step('figure, saved', area, async () => {
  await page.mouse('mouseMoved', await page.place(area), {buttons: 0, button: 'none'});
  await click(one('#front .modebar-btn[data-title="Save as SVG"]'));
  const {name, text: figure} = await saved('.svg');
  assert.ok(figure.startsWith('<svg') && figure.includes('</svg>'));
  return `${name}, ${figure.length} characters`;
});
await step('line of a design, pointed at and clicked', one(axes), async () => {
  const middle = await evaluate(
    `(() => { const r = ${one(axes)}.getBoundingClientRect(), [a, b] = [...document.querySelectorAll('${axes} ` +
      `line')].filter((l) => l.x1.baseVal.value === l.x2.baseVal.value).map((l) => l.x1.baseVal.value); return ` +
      `0.5 * (a + b) / r.width; })()`,
  );
  const label = '#designs .parallel .label';
  let share = 0.2;
  for (; share < 0.95; share += 0.01) {
    await page.mouse('mouseMoved', await page.place(one(axes), [middle, share]), {buttons: 0, button: 'none'});
    await page.settled();
    if (!(await evaluate(`${one(label)}.hidden`))) break;
  }
  await page.settled();
  const said = await text(one(label + ' b'));
  assert.equal((await count(axes + ' polyline')) > 0, true);
  const [x, y] = await page.place(one(axes), [middle, share]);
  await page.mouse('mousePressed', [x, y]);
  await page.mouse('mouseMoved', [x + 1, y]); // as a hand does
  await page.mouse('mouseReleased', [x + 1, y]);
  await until(`${one(bar)}.textContent.includes('Marked: ${said}')`);
  await click(button(bar, 'Take mark away'));
  return said;
});
/// What a drag over an element selects; cleared again.
async function selectedBy(element, from, to) {
  await drag(element, from, to);
  await until(`!${one(bar)}.hidden && ${one(bar)}.textContent.includes('Selected:')`);
  const after = await selected();
  await click(button(bar, 'Clear selection'));
  await until(`${one(bar)}.hidden`);
  return after;
}
await step('brush of an axis', one(axes), async () => {
  const x = await evaluate(
    `(() => { const r = ${one(axes)}.getBoundingClientRect(), l = document.querySelector('${axes} ` +
      `line').getBoundingClientRect(); return (l.left + l.width / 2 - r.left) / r.width; })()`,
  );
  return selectedBy(one(axes), [x, 0.3], [x, 0.6]);
});
await step('box in a trade-off', area, () => selectedBy(area, [0.1, 0.1], [0.7, 0.9]));
await step('range in numbers', one('#designs form'), async () => {
  await click(one('#designs form input'));
  await type('0');
  await click(button('#designs form', 'Set range'));
  await until(`${one('#designs .chip')}`);
  const chip = await text(one('#designs .chip'));
  await click(one('#designs .chip'));
  await until(`!${one('#designs .chip')}`);
  return chip;
});
await step('slider', one('#surfaces .slider'), async () => {
  const before = await text(one('#surfaces .slider output'));
  await click(one('#surfaces .slider input'), [0.9, 0.5]);
  await until(`${one('#surfaces .slider output')}.textContent !== "${before}"`);
  const after = await text(one('#surfaces .slider output'));
  await click(button('#surfaces', 'Middle of the box'));
  await until(`${one('#surfaces .slider output')}.textContent === "${before}"`);
  return `${before} to ${after} and back`;
});
await step('haul', one('#haul input'), async () => {
  const said = () => text(one('#haul .sentence'));
  const before = await said();
  await click(one('#haul input'), [0.5, 0.5]);
  await until(`${one('#haul .sentence')}.textContent !== ${JSON.stringify(before)}`);
  assert.match(await said(), /^With a haul of (29|30|31)\d s “/);
  return `${before} ${await said()} ${await text(one('#haul ul'))}`;
});
await step('surfaces in 3-D', button('#surfaces', '3-D'), async () => {
  await click(button('#surfaces', '3-D'));
  await until(one('#surfaces .gl-container canvas'));
  await click(button('#surfaces', 'Contours'));
  await until(`!${one('#surfaces .gl-container canvas')}`);
  return 'and contours again';
});
await step('nested contours', one('#surfaces details summary'), async () => {
  await click(one('#surfaces details summary'));
  await until(one('#surfaces details .main-svg'));
  return `${await count('#surfaces details .contour')} plots`;
});
await step('runs side by side', one('#runs details summary'), async () => {
  // A marked run opens it.
  if (!(await evaluate("document.querySelector('#runs details').open"))) await click(one('#runs details summary'));
  for (const k of [0, 1]) await click(`document.querySelectorAll('#runs details tbody input[type=checkbox]')[${k}]`);
  await until(one('#runs .comparison table'));
  const heads = await evaluate(
    "[...document.querySelectorAll('#runs .comparison th')].map((h) => h.textContent).filter(Boolean)",
  );
  for (const k of [2, 3]) await click(`document.querySelectorAll('#runs details tbody input[type=checkbox]')[${k}]`);
  await until("document.querySelectorAll('#runs .comparison th').length === 8");
  assert.ok(
    await evaluate("document.querySelectorAll('#runs details tbody input[type=checkbox]')[4].disabled"),
    'a fifth can be ticked',
  );
  await click(button('#runs .comparison', 'Clear'));
  await until(`!${one('#runs .comparison table')}`);
  return heads.join(', ');
});
const dot = '#surfaces .plot .scatterlayer .point';
await step('run on a surface, pointed at and clicked', one(dot), async () => {
  await page.mouse('mouseMoved', await page.place(one(dot)), {buttons: 0, button: 'none'});
  await until(one('#surfaces .hoverlayer .hovertext'));
  const said = await text(one('#surfaces .hoverlayer .hovertext'));
  await click(one(dot));
  await until(`${one(bar)}.textContent.includes('Marked: ')`);
  const marked = (await text(one(bar))).match(/Marked: ([^(]*\d+)/)[1];
  assert.ok(marked.endsWith(said.match(/^run \d+/)[0]), `${said} shown, ${marked} marked`);
  await click(button(bar, 'Take mark away'));
  return said;
});

// A report shows it first.
const first = await evaluate("Boolean(document.querySelector('#summary .replay'))"),
  scene = first ? '#summary .replay' : '#simulation .replay',
  clock = one(scene + ' .player .note');
const seconds = async () => Number((await text(clock)).split(' ')[0]);
/// Of the pixels that the scene shows: a camera that moves or a body that goes changes it.
const picture = () =>
  evaluate(
    `(() => { let sum = 0; for (const c of ${one(scene + ' canvas')}.toDataURL()) sum = (31 * sum + ` +
      `c.charCodeAt(0)) % 1e9; return sum; })()`,
  );
const changes = async (act) => {
  const before = await picture();
  await act();
  for (let k = 0; k < 50 && (await picture()) === before; ++k) await new Promise((r) => setTimeout(r, 100));
  assert.notEqual(await picture(), before, 'the picture is as before');
};
await step('keys in the scene', one(scene), async () => {
  await click(one(scene + ' canvas'));
  await press('Home');
  const start = await seconds();
  await press('ArrowRight');
  const later = await seconds();
  assert.ok(Math.abs(later - start - 0.05) < 0.011, `${start} to ${later}`);
  await press('ArrowRight', true);
  assert.ok(Math.abs((await seconds()) - later - 1) < 0.011);
  await press('End');
  const end = await seconds();
  await press('Home');
  return `${start} s, ${later} s, ${end} s`;
});
await step('play', one(scene), async () => {
  const start = await seconds();
  await click(button(scene + ' .player', 'Play'));
  await until(`Number(${clock}.textContent.split(' ')[0]) > ${start}`);
  await click(button(scene + ' .player', 'Pause'));
  await until(button(scene + ' .player', 'Play'));
  return `to ${await seconds()} s`;
});
await step('slider of time', one(scene), async () => {
  await changes(() => click(one(scene + ' .player input'), [0.6, 0.5]));
  return `to ${await seconds()} s`;
});
await step('cameras', one(scene), async () => {
  for (const name of ['Side', 'Above', 'Reset view']) await changes(() => click(button(scene + ' .player', name)));
  await changes(() => drag(one(scene + ' canvas'), [0.4, 0.5], [0.6, 0.6]));
  await changes(() => wheel(one(scene + ' canvas'), -240));
  if (await evaluate(`Boolean(${button(scene + ' .player', 'Follow')})`)) {
    await click(button(scene + ' .player', 'Follow'));
    assert.equal(await evaluate(`${button(scene + ' .player', 'Follow')}.getAttribute('aria-pressed')`), 'true');
  }
  return 'side, above, reset, drag, wheel, follow';
});
await step('click in a plot of the scene', one(scene + ' .scene-plot canvas'), async () => {
  const before = await seconds();
  await click(one(scene + ' .scene-plot canvas'), [0.3, 0.5]);
  assert.notEqual(await seconds(), before);
  const plots = `[...document.querySelectorAll('${scene} .scene-plot > div')].map((d) => d.textContent)`;
  return `to ${await seconds()} s; ${(await evaluate(plots)).join('; ')}`;
});
await step('plot of the scene, saved', button(scene + ' .scene-plot', 'SVG'), async () => {
  await click(button(scene + ' .scene-plot', 'SVG'));
  const {name, text: figure} = await saved('.svg');
  assert.ok(figure.startsWith('<svg') && /<path d="M[^"]*L/.test(figure) && figure.endsWith('</svg>'));
  return name;
});
await step('cycles', one('.cycles select'), async () => {
  const names = await evaluate("[...document.querySelectorAll('.cycles option')].map((o) => o.textContent)");
  const captions = new Set();
  for (let k = 0; k < names.length; ++k) {
    await choose(one('.cycles select'), String(k));
    await until(`document.querySelectorAll('.cycle .replay canvas').length > 0`);
    captions.add(await text(one('.cycle')));
    await changes(() => click(one(scene + ' .player input'), [0.5, 0.5]));
  }
  assert.equal(captions.size, names.length, 'each cycle has figures of its own');
  assert.equal(await evaluate(`${button('.cycles', 'Cycle after')}.disabled`), true);
  await click(button('.cycles', 'Cycle before'));
  assert.equal(await evaluate(`${one('.cycles select')}.value`), String(names.length - 2));
  return names.join(', ');
});

await step('a phone, from the beginning', one('#trust'), async () => {
  const [width, height] = screens.phone;
  await page.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: true});
  await page.load();
  await page.settled();
  const folded = await count('details.folded'),
    tall = (await evaluate('document.documentElement.scrollHeight')) / height;
  assert.ok(folded > 3, `${folded} sections are folded`);
  assert.ok(tall < 16, `the page has ${tall.toFixed(1)} screens`);
  assert.ok(await inWidth(), 'it is wider than the window');
  await evaluate(`document.querySelector('nav a[href="#trust"]').click()`);
  await until(`document.querySelector('#trust > details').open`);
  return `${folded} sections folded, ${tall.toFixed(1)} screens`;
});

const {errors} = page,
  requests = page.requests();
await page.close();
console.log(`console errors: ${errors.length}, requests: ${requests.length}`);
for (const line of [...errors, ...requests]) console.error(line);
process.exit(errors.length || requests.length ? 1 : 0);

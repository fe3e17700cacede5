// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How fluidly a replay plays, drawn in software at 1280 x 720 by a headless Chromium: node replay_rate.mjs PAGE.html
// [OTHER.html]. Each page is what `replay` writes. Of each: pictures per second, which other work on the machine slows;
// processor time of the browser per picture, which it slows far less; and what four cores would make of that at
// best. Two pages are measured in turns, and the ratio of their processor times follows. --seconds S per turn (5),
// --turns N (3). Linux.

import {readdirSync, readFileSync} from 'node:fs';
import {resolve} from 'node:path';
import {parseArgs} from 'node:util';
import {openPage} from '../../tests/end_to_end/browser.mjs';

const {values, positionals} = parseArgs({
  allowPositionals: true,
  options: {seconds: {type: 'string', default: '5'}, turns: {type: 'string', default: '3'}},
});
const [seconds, turns] = [Number(values.seconds), Number(values.turns)];
if (!positionals.length || !(seconds > 0) || !(turns >= 1)) {
  console.error('usage: node replay_rate.mjs PAGE.html [OTHER.html] [--seconds S] [--turns N]; S above 0, N at least 1');
  process.exit(2);
}

const button = (text) =>
  `[...document.querySelectorAll('.replay .player button')].find((b) => b.textContent.startsWith('${text}'))`;

/// Processor time of all that this process has started [ms], by /proc in ticks of 10 ms.
function processorTime() {
  const all = new Map();
  for (const name of readdirSync('/proc').filter((text) => /^\d+$/.test(text)))
    try {
      const text = readFileSync(`/proc/${name}/stat`, 'utf8'),
        fields = text.slice(text.lastIndexOf(')') + 2).split(' ').map(Number);
      all.set(Number(name), {parent: fields[1], time: 10 * (fields[11] + fields[12])});
    } catch {
      // it has ended
    }
  const isOurs = (id) => id > 1 && all.has(id) && (all.get(id).parent === process.pid || isOurs(all.get(id).parent));
  return [...all].reduce((sum, [id, {time}]) => sum + (isOurs(id) ? time : 0), 0);
}

/// One turn: pictures, their time and processor time [ms].
async function rate(file) {
  const page = await openPage(resolve(file));
  await page.send('Emulation.setDeviceMetricsOverride', {width: 1500, height: 900, deviceScaleFactor: 1, mobile: false});
  await page.evaluate(`(() => {
    const stage = document.querySelector('.replay .scene');
    Object.assign(stage.style, {width: '1280px', height: '720px', maxHeight: 'none'});
    stage.scrollIntoView({block: 'start', behavior: 'instant'});
  })()`);
  await page.settled();
  await page.evaluate(`${button('0.25')}.click()`);
  await page.evaluate(`${button('Play')}.click()`);
  await page.evaluate(`(() => {
    window.pictures = 0;
    const next = () => {
      ++window.pictures;
      ${button('Play')}?.click(); // at its end it begins again
      requestAnimationFrame(next);
    };
    requestAnimationFrame(next);
  })()`);
  const pictures = () => page.evaluate('window.pictures');
  const wait = (time) => new Promise((later) => setTimeout(later, time));
  for (const end = Date.now() + 60000; (await pictures()) < 12 && Date.now() < end; ) await wait(100); // settles its quality
  const begin = {count: await pictures(), processor: processorTime(), time: performance.now()};
  await wait(1000 * seconds);
  const told = {
    count: (await pictures()) - begin.count,
    processor: processorTime() - begin.processor,
    time: performance.now() - begin.time,
    drawn: await page.evaluate(`(({width, height}) => [width, height])(document.querySelector('.replay .scene canvas'))`),
  };
  await page.close();
  if (!told.count) throw new Error(`${file}: no picture was drawn in ${seconds} s; give more --seconds`);
  return told;
}

const costs = positionals.map(() => []);
for (let turn = 0; turn < turns; ++turn)
  for (const [k, file] of positionals.entries()) {
    const {count, processor, time, drawn} = await rate(file);
    const cost = processor / count;
    costs[k].push(cost);
    console.log(
      `${file}: ${((1000 * count) / time).toFixed(1)} pictures per second, ${cost.toFixed(0)} ms of processor time each ` +
        `(four cores: ${(4000 / cost).toFixed(0)} per second at best), drawn ${drawn.join(' x ')}`,
    );
  }
const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
if (costs.length === 2) console.log(`ratio of the medians of processor time: ${(median(costs[0]) / median(costs[1])).toFixed(2)}`);
process.exit(0);

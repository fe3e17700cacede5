// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How many pictures per second a replay plays with, drawn in software at 1280 x 720 by a headless Chromium:
// node replay_rate.mjs PAGE.html [OTHER.html]. Each page is what `replay` writes. Two pages are measured in turns,
// so that other work on the machine slows both, and the ratio of their rates follows. --seconds S per turn (5),
// --turns N (3).

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

/// Pictures per second of one turn, and how many rocks and pixels the scene has.
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
  const told = await page.evaluate(`new Promise((resolve) => {
    const warm = performance.now() + 1500, canvas = document.querySelector('.replay .scene canvas');
    let begin = 0, count = 0;
    const next = (now) => {
      if (begin) ++count;
      else if (now > warm) begin = now;
      if (begin && now - begin > ${1000 * seconds}) resolve({rate: (1000 * count) / (now - begin), size: [canvas.clientWidth, canvas.clientHeight],
        drawn: [canvas.width, canvas.height], plays: ${button('Pause')} !== undefined});
      else requestAnimationFrame(next);
    };
    requestAnimationFrame(next);
  })`);
  await page.close();
  if (!told.plays) throw new Error(`${file}: the replay ended within the ${seconds} s of a turn; give fewer --seconds`);
  return told;
}

const rates = positionals.map(() => []);
for (let turn = 0; turn < turns; ++turn)
  for (const [k, file] of positionals.entries()) {
    const {rate: value, size, drawn} = await rate(file);
    rates[k].push(value);
    console.log(`${file}: ${value.toFixed(1)} pictures per second, ${size.join(' x ')}, drawn ${drawn.join(' x ')}`);
  }
const median = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
if (rates.length === 2) console.log(`ratio of the medians: ${(median(rates[1]) / median(rates[0])).toFixed(2)}`);
process.exit(0);

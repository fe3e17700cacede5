// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Watches the live page of a study in a headless Chromium, from before the study is there to its end: node
// live_session.mjs ADDRESS. Says what came, a line each; fails where something did not come, the console had
// an error, or the page asked for anything but its server.

import assert from 'node:assert/strict';
import {openPage} from './browser.mjs';

const page = await openPage(process.argv[2]);
const {evaluate, until, choose} = page;
const text = (selector) => evaluate(`document.querySelector(${JSON.stringify(selector)})?.textContent ?? ''`);
const untilGrade = (grade) => until(`document.querySelector('.standing .grade')?.textContent === '${grade}'`, 120000);

await untilGrade('waiting');
console.log('before the study: waiting');
await untilGrade('finished');
console.log(`at the end: ${await evaluate('document.title')}`);
await until("document.querySelectorAll('#runs .point').length > 0");
const axes = await evaluate("[...document.querySelectorAll('#runs select')[0].options].map((o) => o.textContent)");
console.log(`axes: ${axes.join(', ')}`);
await choose("document.querySelectorAll('#runs select')[0]", String(axes.length - 1));
await until("document.querySelector('#runs .xtitle')?.textContent === 'run'");
const {responses, rows} = await evaluate("fetch('/state.json?epoch=&since=0').then((answer) => answer.json())");
const done = rows.filter((row) => row[3]).length;
assert.ok(done > 0 && responses[0].done === done);
// One more where the last run is ringed.
await until(`[${done}, ${done + 1}].includes(document.querySelectorAll('#runs .point').length)`);
console.log(`best: ${await text('#best tbody tr')}`);
await until("document.querySelector('#last figure')", 60000);
const titles = "[...document.querySelectorAll('#last figure')].map((f) => f.querySelector('h3').textContent)";
console.log(`last run: ${(await evaluate(titles)).join(', ')}`);
const link = await evaluate("document.querySelector('#best a').href");
assert.match(link, /\/run\/\d+$/);
await page.send('Page.navigate', {url: link});
await until('document.documentElement?.dataset.ready === "true" && document.querySelector("#simulation")', 60000);
console.log(`page of the best run: ${await evaluate('document.title')}`);

const {errors} = page,
  requests = page.requests();
await page.close();
console.log(`console errors: ${errors.length}, requests elsewhere: ${requests.length}`);
for (const line of [...errors, ...requests]) console.error(line);
process.exit(errors.length || requests.length ? 1 : 0);

#!/usr/bin/env node
// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// README's pictures from today's code: docs/images/make_pictures.mjs [--study FOLDER]. The folder has the default study
// of lhd_loading (results/lhd_loading); what it lacks is run first, all of it in some twenty minutes on two cores. Needs
// a build in build/release, chromium and ffmpeg. With --check it draws nothing and says whether what draws the
// pictures, the model of the machine included, is what drew those that are here (pictures.txt).

import {execFileSync} from 'node:child_process';
import {createHash} from 'node:crypto';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join, relative, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {parseArgs} from 'node:util';

const here = dirname(fileURLToPath(import.meta.url)),
  root = resolve(here, '../..'),
  stamp = join(here, 'pictures.txt'),
  programs = join(root, 'build/release/studies');

/// What decides how a picture looks. The simulator's name changes with what it simulates.
const web = (...names) => names.map((name) => `studies/say/page/web/${name}.js`);
const scene = web(
  ...['scene', 'stage', 'scene_parts', 'surface_material', 'shader_parts', 'shadow_map', 'drift_mesh', 'tyre_mesh', 'rock_cover'],
);
const drawnBy = {
  'machine_and_front.jpg': [
    'engine/loading/libraries.hpp',
    'engine/loading/machine_looks.cpp',
    'studies/loading/loading_scene.cpp',
    'studies/loading/loading_looks.cpp',
    ...scene,
    ...web('front', 'projections'),
  ],
  'report.png': ['studies/formula_demo.cpp', 'studies/say/page/web/style.css', ...web('main', 'header', 'summary', 'front')],
};

function digest(files) {
  const sum = createHash('sha256');
  for (const file of files) sum.update(file + '\n').update(readFileSync(join(root, file)));
  return sum.digest('hex').slice(0, 16);
}
const stamps = () => Object.entries(drawnBy).map(([name, files]) => `${name} ${digest(files)}\n`);

function check() {
  const drawn = readFileSync(stamp, 'utf8');
  const old = stamps().filter((line) => !drawn.includes(line));
  if (!old.length) return;
  const names = old.map((line) => line.split(' ')[0]).join(', ');
  console.error(`docs/images: ${names} was drawn by other code than today's; run docs/images/make_pictures.mjs and commit what it writes`);
  process.exit(1);
}

const programIn = (cwd, name, ...words) =>
  execFileSync(join(programs, name), words, {cwd, encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'], maxBuffer: 1 << 28});
const program = (name, ...words) => programIn(root, name, ...words);

/// The data of a page that a study wrote.
function dataOf(page) {
  const text = readFileSync(page, 'utf8'),
    open = '<script type="application/json" id="report-data">',
    begin = text.indexOf(open) + open.length;
  return JSON.parse(text.slice(begin, text.indexOf('</script', begin)));
}

/// A good run, not the luckiest: the upper quartile of production.
function goodRun(study) {
  const [head, ...rows] = program('lhd_loading', 'export', '--out', study, '--what', 'runs').trim().split('\n');
  const names = head.split(',').map((name) => name.replace(/ \[.*/, '')), // without units
    of = (row, name) => row.split(',')[names.indexOf(name)];
  const done = rows.filter((row) => of(row, 'status') === 'done');
  done.sort((a, b) => Number(of(a, 'production')) - Number(of(b, 'production')));
  return of(done[Math.floor(0.75 * done.length)], 'run');
}

/// The machine as its bucket breaks out of the pile, where the page begins its replay.
function machine(study, folder, size) {
  const run = goodRun(study),
    page = join(folder, 'replay.html'),
    frames = join(folder, 'frames');
  program('lhd_loading', 'replay', '--run', run, '--out', study, '--file', page);
  const panel = dataOf(page).illustrations.find((figure) => figure.type === 'scene');
  const t = String(panel.frames[panel.poster_frame].t);
  program('lhd_loading', 'replay', '--run', run, '--out', study, '--frames', frames, '--from', t, '--to', t, '--size', size);
  return join(frames, 'frame_000001.png');
}

/// What a window shows, as a picture: {data, box}; box: [left, top, width, height] around the first of what the selector finds.
async function shot(openPage, file, {width, height, selector = 'body', first = 2, format = 'png'}) {
  const page = await openPage(file);
  await page.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: false});
  if (selector !== 'body')
    await page.evaluate(`document.querySelector('${selector}').scrollIntoView({block: 'center', behavior: 'instant'})`);
  await new Promise((later) => setTimeout(later, 3000)); // figures are drawn as they come into view
  const box = await page.evaluate(`(() => {
    const all = [...document.querySelectorAll('${selector}')].slice(0, ${first}).map((node) => node.getBoundingClientRect());
    const [left, top] = [Math.min(...all.map((r) => r.left)), Math.min(...all.map((r) => r.top))];
    return [left, top, Math.max(...all.map((r) => r.right)) - left, Math.max(...all.map((r) => r.bottom)) - top];
  })()`);
  const {data} = await page.send('Page.captureScreenshot', {format, ...(format === 'jpeg' ? {quality: 88} : {})});
  await page.close();
  return {data, box: box.map(Math.round)};
}

/// A picture above what is in the box of another.
function together(above, {data, box: [left, top, wide, high]}, width) {
  const scale = width / wide;
  return `<!doctype html><html data-ready="true"><body style="margin:0;background:#fff">
<img style="display:block;width:${width}px" src="data:image/png;base64,${above.toString('base64')}">
<div style="width:${wide}px;height:${high}px;overflow:hidden;transform:scale(${scale});transform-origin:0 0">
<img style="display:block;margin:${-top}px 0 0 ${-left}px" src="data:image/png;base64,${data}"></div></body></html>`;
}

async function draw(study) {
  const {openPage} = await import('../../tests/end_to_end/browser.mjs');
  const folder = mkdtempSync(join(tmpdir(), 'pictures-'));
  process.once('exit', () => rmSync(folder, {recursive: true, force: true}));
  program('lhd_loading', 'run', '--out', study, '--no-spot-check');
  const frame = readFileSync(machine(study, folder, '1100x560'));
  const front = await shot(openPage, join(study, 'report.html'), {width: 1280, height: 1000, selector: '#front .plot'});
  const both = join(folder, 'both.html'),
    width = 1100;
  writeFileSync(both, together(frame, front, width));
  const height = 560 + Math.round((width * front.box[3]) / front.box[2]);
  const hero = await shot(openPage, both, {width, height, format: 'jpeg'});
  writeFileSync(join(here, 'machine_and_front.jpg'), Buffer.from(hero.data, 'base64'));
  const demo = join(folder, 'results/formula_demo'); // the page names it as a reader's own
  programIn(folder, 'formula_demo', 'run');
  const report = await shot(openPage, join(demo, 'report.html'), {width: 1200, height: 1500});
  writeFileSync(join(here, 'report.png'), Buffer.from(report.data, 'base64'));
  writeFileSync(stamp, stamps().join(''));
  console.log(`drew ${Object.keys(drawnBy).join(' and ')} in ${relative(process.cwd(), here)}, from ${study}`);
}

const {values} = parseArgs({options: {study: {type: 'string'}, check: {type: 'boolean', default: false}}});
if (values.check) check();
else await draw(resolve(values.study ?? join(root, 'results/lhd_loading')));
process.exit(0);

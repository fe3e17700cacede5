// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the live page works out without a browser.

import assert from 'node:assert/strict';
import test from 'node:test';
import {axesOf, clock, connection, curve, firstAxes, keep, lags, mostPoints, nothingKept, pause, question, totals} from '../../studies/say/page/web/live_state.js';

const row = (run) => [run, 'training', [0.5], [run]];
const answer = (epoch, from, runs, ended) => ({epoch, from, rows: runs.map(row), ended});

test('rows are kept within an epoch, and asked for from where they end', () => {
  let kept = keep(nothingKept, answer('a', 0, [1, 2], 3));
  assert.equal(question(kept), '/state.json?epoch=a&since=2');
  assert.ok(lags(kept, {ended: 3}));
  kept = keep(kept, answer('a', 2, [5], 3));
  assert.deepEqual(kept.rows.map(([run]) => run), [1, 2, 5]);
  assert.ok(!lags(kept, {ended: 3}));
  assert.equal(keep(kept, answer('a', 3, [], 3)), kept, 'the same rows are the same object');
});

test('another epoch, or rows that do not follow, begin anew', () => {
  const kept = keep(nothingKept, answer('a', 0, [1, 2], 2));
  assert.deepEqual(keep(kept, answer('b', 0, [7], 1)), {epoch: 'b', since: 1, rows: [row(7)]});
  assert.deepEqual(keep(kept, answer('a', 0, [1, 2, 3], 3)).rows.length, 3);
  assert.deepEqual(keep(kept, answer('b', 0, [], 0)), {epoch: 'b', since: 0, rows: []});
});

test('an answer without a study leaves the rows', () => {
  const kept = keep(nothingKept, answer('a', 0, [1], 1));
  assert.equal(keep(kept, {standing: {kind: 'absent'}}), kept);
  assert.ok(!lags(kept, {}));
});

test('the page keeps the latest points, and counts all', () => {
  let kept = nothingKept;
  for (let from = 0; from < mostPoints + 1000; from += 1000)
    kept = keep(kept, answer('a', from, Array.from({length: 1000}, (_, i) => from + i + 1), 1e6));
  assert.equal(kept.rows.length, mostPoints);
  assert.equal(kept.since, mostPoints + 1000);
  assert.equal(kept.rows.at(-1)[0], mostPoints + 1000);
});

test('the best so far steps at each improvement and goes on to now', () => {
  assert.deepEqual(curve([[1, 1, 9], [4, 7, 5]], 10), {x: [1, 4, 10], y: [9, 5, 5], runs: [1, 7, 7]});
  assert.deepEqual(curve([[1, 1, 9]], 1), {x: [1], y: [9], runs: [1]});
  assert.deepEqual(curve([], 3), {x: [], y: [], runs: []});
});

test('states are added over the kinds', () => {
  const of = (done, failed, running, planned) => ({done, failed, running, planned});
  assert.deepEqual(totals({training: of(1, 2, 3, 4), validation: of(10, 0, 0, 5)}), of(11, 2, 3, 9));
});

test('a lost server is said with the time when it answered last', () => {
  const heard = new Date(2026, 4, 3, 9, 5), now = new Date(2026, 4, 3, 17, 0);
  assert.equal(connection(heard, true, now), '');
  assert.match(connection(heard, false, now), /^No longer connected since 09:05: what stands below is how it was then\./);
  assert.match(connection(heard, false, new Date(2026, 4, 4, 8, 0)), /since 2026-05-03 09:05:/);
  assert.match(connection(null, false, now), /^The server does not answer\./);
  assert.equal(clock(heard, now), '09:05');
});

test('it asks at once for more, often while a study runs, seldom else', () => {
  assert.equal(pause('working', true, true), 0);
  assert.ok(pause('working', true, false) <= 3000);
  assert.ok(pause('ended', true, false) > pause('working', true, false));
  assert.ok(pause(undefined, false, false) > 0);
});

test('runs are shown along two objectives first, or one over the runs', () => {
  const response = (name, goal) => ({name, unit: '1', goal}), variables = [{name: 'x', unit: 'm'}];
  const two = {variables, responses: [response('a', 'record'), response('b', 'minimize'), response('c', 'maximize')]};
  assert.deepEqual(firstAxes(two), [1, 2]);
  const one = {variables, responses: [response('a', 'record'), response('b', 'minimize')]};
  const axes = axesOf(one), [across, up] = firstAxes(one);
  assert.equal(axes[across].item.name, 'run');
  assert.equal(axes[up].item.name, 'b');
  assert.deepEqual(axes.map(({of}) => of([4, 'training', [0.5], [1, 2]])), [1, 2, 0.5, 4]);
  assert.deepEqual(axes.map(({of}) => of([4, 'training', [0.5], null])), [null, null, 0.5, 4]);
});

test('standard errors are no axes', () => {
  const problem = {variables: [{name: 'x', unit: 'm'}], responses: [{name: 'e', unit: '1', goal: 'record', is_error: true}, {name: 'a', unit: '1', goal: 'minimize'}, {name: 'b', unit: '1', goal: 'minimize'}]};
  const axes = axesOf(problem);
  assert.deepEqual(axes.map(({item}) => item.name), ['a', 'b', 'x', 'run']);
  assert.deepEqual(firstAxes(problem).map((i) => axes[i].of([4, 'training', [0.5], [9, 1, 2]])), [1, 2]);
});

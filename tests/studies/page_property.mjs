// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the report's page computes without a browser: the selection, and values as text.

import assert from 'node:assert/strict';
import test from 'node:test';
import {csv, tsv} from '../../studies/report/web/delimited.js';
import {number, setting} from '../../studies/report/web/format.js';
import {predictor} from '../../studies/report/web/kriging.js';
import {words} from '../../studies/report/web/inscription.js';
import {selecting} from '../../studies/report/web/selection.js';

/// One axis that all have values on, and one that run 2 lacks.
function designs() {
  const axis = (runs, front) => ({values: {runs: Float64Array.from(runs), front: Float64Array.from(front)}});
  return {runs: [{}, {}, {}], front: [{}, {}], axes: [axis([0, 1, 2], [0.5, 1.5]), axis([5, 6, NaN], [7, 8])]};
}

const selected = (selection, set, count) => Array.from({length: count}, (_, i) => i).filter((i) => selection.has(set, i));

test('without a range or an area everything is selected', () => {
  const selection = selecting(designs());
  assert.equal(selection.active, false);
  assert.deepEqual(selection.counts, {runs: 3, front: 2});
  assert.deepEqual(selected(selection, 'runs', 3), [0, 1, 2]);
});

test('ranges and area select what lies in all of them, ends included', () => {
  const selection = selecting(designs());
  selection.setRange(0, [1, 2]);
  assert.deepEqual(selected(selection, 'runs', 3), [1, 2]);
  assert.deepEqual(selected(selection, 'front', 2), [1]);
  selection.setArea({owner: 'a plot', runs: new Set([0, 1]), front: new Set()});
  assert.deepEqual(selected(selection, 'runs', 3), [1]);
  assert.deepEqual(selection.counts, {runs: 1, front: 0});
  assert.equal(selection.areaOwner, 'a plot');
});

test('a run without a response lies in no range of it', () => {
  const selection = selecting(designs());
  selection.setRange(1, [-1e300, 1e300]);
  assert.deepEqual(selected(selection, 'runs', 3), [0, 1]);
});

test('clearing gives everything back, and each change is told once', () => {
  const selection = selecting(designs());
  let told = 0;
  selection.onchange(() => { ++told; });
  selection.setRange(0, [9, 10]);
  assert.deepEqual(selection.counts, {runs: 0, front: 0});
  selection.clear();
  assert.equal(selection.active, false);
  assert.equal(selection.areaOwner, null);
  assert.equal(told, 2);
});

// Levels are 0 or 2 apart, whichever they are: exp(-0.1 * 2^2) = exp(-0.4). A slider between two levels shows the nearer.
test('a category in a model is no number', () => {
  const mean = predictor({
    centre: [0, 0], factor: [1, 1], correlation: 'gaussian', theta: [0.5, 0.1], exponent: [], levels: [0, 4],
    X: [[0.25, 1]], weights: [3], terms: [], coefficients: [], constant: 7, scale: 'linear',
  });
  assert.equal(mean([0.25, 1]), 10);
  for (const other of [0, 2, 3]) assert.equal(mean([0.25, other]), 7 + 3 * Math.exp(-0.1 * 4));
  assert.equal(mean([0.25, 1.4]), mean([0.25, 1]));
});

test('a copied number is the same number', () => {
  for (const value of [0.1, 1 / 3, 5e-324, -1.7976931348623157e308, 123456789.12345679])
    for (const text of [csv([[value]]), tsv([[value]])]) assert.equal(Number(text), value);
});

test('text keeps to its cell', () => {
  assert.equal(csv([['a,b', 'say "no"', 'two\nlines', null, NaN]]), '"a,b","say ""no""","two\nlines",,\r\n');
  assert.equal(tsv([['a\tb', 'two\r\nlines', undefined]]), 'a b\ttwo lines\t\n');
});

test('what is shown stays short', () => {
  assert.equal(number(0.123456), '0.123');
  assert.equal(setting(1, {kind: 'categorical', levels: ['hard_steel', 'rubber']}), 'rubber');
  assert.equal(setting(32, {kind: 'integer'}), '32');
  assert.equal(setting(3e-6, {lower: 0, upper: 1}), '0');
  assert.equal(setting(3e-6, {lower: 1e-6, upper: 1}), '3.00e-6');
});

test('a frame tells its time, with two decimals, and the label of its picture', () => {
  assert.equal(words(3.4, 'curl, 3.2 t in the bucket'), '3.40 s, curl, 3.2 t in the bucket');
  assert.equal(words(0, undefined), '0.00 s');
});

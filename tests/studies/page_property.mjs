// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the report's page computes without a browser: the selection, and values as text.

import assert from 'node:assert/strict';
import test from 'node:test';
import {bandOutline} from '../../studies/say/page/web/band_outline.js';
import {byShade, colourAt} from '../../studies/say/page/web/cloud.js';
import {cyclesOf, withBodies} from '../../studies/say/page/web/cycle_panels.js';
import {csv, tsv} from '../../studies/say/page/web/delimited.js';
import {number, setting} from '../../studies/say/page/web/format.js';
import {predictor, scaledMean} from '../../studies/say/page/web/kriging.js';
import {meanInterval, scaledDeviation} from '../../studies/say/page/web/kriging_error.js';
import {ranked, rateOfRun, turnTexts} from '../../studies/say/page/web/haul_rates.js';
import {brokenText, symbols} from '../../studies/say/page/web/limits.js';
import {leftOutText, nestedVariables, outerLevels} from '../../studies/say/page/web/nested_levels.js';
import {lineAt} from '../../studies/say/page/web/parallel_pointer.js';
import {piecesOf} from '../../studies/say/page/web/parallel_trace.js';
import {came, question} from '../../studies/say/page/web/question_words.js';
import {distanceToCut, nearCut} from '../../studies/say/page/web/sampled.js';
import {words} from '../../studies/say/page/web/inscription.js';
import {Poses} from '../../studies/say/page/web/poses.js';
import {peaksKept, sampleAt, valueAt} from '../../studies/say/page/web/signals.js';
import {selecting} from '../../studies/say/page/web/selection.js';
import {SvgPen} from '../../studies/say/page/web/svg_pen.js';
import {shares} from '../../studies/say/page/web/shares.js';

/// One axis that all have values on, and one that run 2 lacks.
function designs() {
  const axis = (runs, front) => ({values: {runs: Float64Array.from(runs), front: Float64Array.from(front)}});
  return {runs: [{}, {}, {}], front: [{}, {}], axes: [axis([0, 1, 2], [0.5, 1.5]), axis([5, 6, NaN], [7, 8])]};
}

const selected = (selection, set, count) => Array.from({length: count}, (_, i) => i).filter((i) => selection.has(set, i));

test('a haul changes the order where the fuller strategy passes the quicker one', () => {
  const strategies = [
    {name: 'quick', load: 1000, seconds: 10},
    {name: 'full', load: 2000, seconds: 30},
  ];
  const first = (haul) => ranked(strategies, haul)[0].strategy.name;
  assert.equal(first(9), 'quick'); // 1000 / (10 + h) = 2000 / (30 + h) at h = 10
  assert.equal(first(11), 'full');
  assert.equal(ranked(strategies, 10)[0].rate, 50);
  assert.equal(rateOfRun({loads: [1000, 3000], seconds: [10, 20]}, 10), 75);
  const turns = [{haul: 10, better: 1, worse: 0, lower: 5, upper: null}];
  assert.deepEqual(turnTexts({turns, strategies, longest: 600}), [
    'From 10 s on “full” gives more than “quick” (the turn lies between 5 s and more than 600 s with 95 %).',
  ]);
  assert.equal(turnTexts({turns: [], strategies, longest: 600})[0], 'The order does not turn for hauls up to 600 s.');
  assert.equal(turnTexts({turns: Array(9).fill(turns[0]), strategies, longest: 600}).at(-1), '3 more turns follow.');
});

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

// Levels are 0 or 2 apart, whichever they are: exp(-0.1 * 2^2) = exp(-0.4). A slider between two levels shows
// the nearer.
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

// Of four places the last is reached in no draw, and the third in too few for the pessimistic end.
test('the band of a front closes, and ends where no draw reaches', () => {
  const {x, y, median} = bandOutline({at: [1, 2, 3, 4], optimistic: [5, 6, 7, null], median: [6, 7, null, null], pessimistic: [7, 8, null, null]}, 20);
  assert.deepEqual(x, [1, 2, 3, 3, 2, 1]);
  assert.deepEqual(y, [5, 6, 7, 20, 8, 7]);
  assert.deepEqual(median, {x: [1, 2, 3], y: [6, 7, null]});
});

/// Ordinary Kriging of two runs at -1 and 1 with r(0) = exp(-theta) and c = exp(-4 theta) between them, and
/// a nugget g. At 0: rᵀR⁻¹r = 2 r²/(1 + g + c) and 1ᵀR⁻¹1 = 2/(1 + g + c), so that
///   variance = s² (1 - 2 r²/(1 + g + c) + (1 - 2 r/(1 + g + c))² (1 + g + c)/2).
/// B = R⁻¹1/√(1ᵀR⁻¹1) and T = √(1ᵀR⁻¹1).
function twoRuns(theta, g) {
  const c = Math.exp(-4 * theta), sum = 1 + g + c, T = Math.sqrt(2 / sum);
  return {centre: [0], factor: [1], correlation: 'gaussian', theta: [theta], exponent: [], X: [[-1], [1]], weights: [-0.5, 0.5], terms: [[-1, -1]], coefficients: [3],
    constant: 0, scale: 'linear', error: {noise: [g, g], process_variance: 4, B: [[1 / sum / T], [1 / sum / T]], T: [[T]], theta_spread: [], exponent_spread: [], alpha_effects: [], beta_effects: []}};
}

test('the band of a surface is that of two runs by hand', () => {
  for (const [theta, g] of [[0.3, 0.1], [2, 1e-6]]) {
    const r = Math.exp(-theta), sum = 1 + g + Math.exp(-4 * theta);
    const wanted = Math.sqrt(4 * (1 - (2 * r * r) / sum + ((1 - (2 * r) / sum) ** 2 * sum) / 2));
    const found = scaledDeviation(twoRuns(theta, g))([0]);
    assert.ok(Math.abs(found - wanted) < 1e-12, `${found} ${wanted}`);
    const [low, high] = meanInterval(twoRuns(theta, g))([0]);
    assert.ok(Math.abs(low - (3 - 1.959963984540054 * wanted)) < 1e-12 && Math.abs(high + low - 6) < 1e-12);
  }
  assert.equal(meanInterval({...twoRuns(1, 1), error: undefined}), null);
});

// Unsure of the trend alone, with all else known: the parameters' part adds its square.
test('what the parameters leave unknown adds to the band', () => {
  const surface = twoRuns(0.3, 0.1), plain = scaledDeviation(surface)([0]);
  Object.assign(surface.error, {theta_spread: [[0.7]], alpha_effects: [[0], [0]], beta_effects: [[1.5]]});
  // At 0 the two runs' slopes in theta cancel: weights -0.5 and 0.5.
  assert.ok(Math.abs(scaledDeviation(surface)([0]) - Math.hypot(plain, 1.5)) < 1e-12);
  const h = [1.5, 0.5], slope = -0.3 * (-0.5 * h[0] ** 2 * Math.exp(-0.3 * h[0] ** 2) + 0.5 * h[1] ** 2 * Math.exp(-0.3 * h[1] ** 2));
  const without = scaledDeviation(twoRuns(0.3, 0.1))([0.5]);
  assert.ok(Math.abs(scaledDeviation(surface)([0.5]) - Math.hypot(without, 1.5 + 0.7 * slope)) < 1e-12);
});

test('another explanation of the runs widens the band by its probability', () => {
  const surface = twoRuns(0.3, 0.1), other = twoRuns(2, 1e-6), own = scaledDeviation(surface), wider = scaledDeviation(other);
  other.constant += 5; // its mean lies 5 away
  const both = scaledDeviation({...surface, other: {probability: 0.25, surface: other}});
  for (const x of [[0], [0.5], [3]]) {
    const variance = own(x) ** 2, apart = 5 + scaledMean({...other, constant: 0})(x) - scaledMean({...surface, constant: 0})(x);
    const wanted = Math.sqrt(variance + 0.25 * (wider(x) ** 2 + apart ** 2 - variance));
    assert.ok(Math.abs(both(x) - wanted) < 1e-12, `${both(x)} ${wanted}`);
  }
  const sure = {...surface, error: {...surface.error, process_variance: 1e-9}};
  const never = scaledDeviation({...surface, other: {probability: 0.9, surface: sure}});
  assert.equal(never([0]), own([0]));
});

const box = {variables: [{name: 'a', lower: 0, upper: 2}, {name: 'b', lower: 0, upper: 10}, {name: 'tool', kind: 'categorical', lower: 0, upper: 2, levels: ['x', 'y', 'z']}]};

test('the farther a run lies from a cut, the fainter it is', () => {
  assert.equal(distanceToCut(box, [0.3, 5, 1], [1.7, 5, 1], [0]), 0);
  assert.equal(distanceToCut(box, [0, 8, 1], [0, 5, 2], [0]), Math.sqrt((0.3 ** 2 + 1) / 2));
  const rows = [{x: [0, 8, 1], y: [1]}, {x: [2, 5, 1], y: [2]}, {x: [1, 6, 1], y: null}, {x: [1, 0, 1], y: [3]}];
  const near = nearCut(box, rows, [1, 5, 1], [0], 2);
  assert.deepEqual(near.rows, [rows[1], rows[0]]);
  assert.deepEqual(near.indices, [1, 0]);
  assert.equal(near.opacity[0], 1);
  assert.ok(Math.abs(near.opacity[1] - (1 - 0.3 / Math.sqrt(2) / 0.5)) < 1e-12);
});

// Axes 100 px apart, of which values are pixels: run 0 rises from 10 to 110, run 1 lies at 50 and ends there.
test('the line at the pointer is the nearest within reach that is shown', () => {
  const values = [[10, 50], [110, 50], [60, NaN]], axes = values.map((runs, k) => ({x: 100 * k, y: (value) => value, values: {runs}}));
  const all = () => true, at = (x, y, shown = all) => lineAt(axes, [['runs', 2]], shown, [x, y]);
  assert.deepEqual(at(25, 35), {set: 'runs', i: 0});
  assert.equal(at(25, 42), null);
  assert.deepEqual(at(38, 49.5), {set: 'runs', i: 1});
  assert.deepEqual(at(38, 49.5, (set, i) => i !== 1), {set: 'runs', i: 0});
  assert.equal(at(150, 50), null);
  assert.equal(at(250, 50), null);
  assert.equal(at(-1, 10), null);
  assert.deepEqual(piecesOf(axes, {set: 'runs', i: 0}), [[[0, 10], [100, 110], [200, 60]]]);
  assert.deepEqual(piecesOf(axes, {set: 'runs', i: 1}), [[[0, 50], [100, 50]]]);
});

test('what a pen draws comes out as SVG', () => {
  const pen = new SvgPen(100, 50);
  Object.assign(pen, {strokeStyle: '#123456', fillStyle: '#654321', textAlign: 'right', textBaseline: 'middle'});
  pen.setLineDash([5, 4]);
  pen.beginPath();
  pen.moveTo(1, 2);
  pen.lineTo(3, 4.126);
  pen.stroke();
  pen.setLineDash([]);
  pen.fillText('a < b', 10, 20);
  assert.equal(pen.text('#ffffff'), '<svg xmlns="http://www.w3.org/2000/svg" width="100" height="50" viewBox="0 0 100 50"><rect width="100%" height="100%" fill="#ffffff"/>' +
    '<path d="M1.00 2.00L3.00 4.13" fill="none" stroke="#123456" stroke-width="1" stroke-linejoin="bevel" stroke-dasharray="5,4"/>' +
    '<text x="10.00" y="20.00" fill="#654321" text-anchor="end" dominant-baseline="central" style="font:11px sans-serif">a &lt; b</text></svg>');
});

test('a run that breaks a limit has a shape and words of its own', () => {
  const responses = [{name: 'rock_spill', unit: '1', goal: 'at_most', limit: 0.25}, {name: 'load', unit: 't', goal: 'at_least', limit: 9}];
  const sound = {breaks: []}, broken = {breaks: [0, 1]};
  assert.equal(symbols([sound, sound], 'square'), 'square');
  assert.deepEqual(symbols([sound, broken], 'square'), ['square', 'triangle-down-open']);
  assert.equal(brokenText({responses}, broken), 'breaks rock spill at most 0.250, load at least 9.00 t');
  assert.equal(brokenText({responses}, sound), '');
});

test('nested contours take the strongest variables, and few values of what has few', () => {
  const problem = {variables: Array(5).fill({})};
  assert.deepEqual(nestedVariables({main_pair: [1, 3], influence: [[0.1, 0.9, 0.3, 0.8, 0.2], null], problem}), [1, 3, 2, 4]);
  assert.deepEqual(nestedVariables({main_pair: [0, 1], influence: [], problem: {variables: [{}, {}]}}), [0, 1]);
  assert.deepEqual(outerLevels({lower: 0, upper: 3}), [0, 1, 2, 3]);
  assert.deepEqual(outerLevels({lower: 0, upper: 2, kind: 'categorical'}), [0, 1, 2]);
  assert.deepEqual(outerLevels({lower: 10, upper: 19, kind: 'integer'}), [10, 13, 16, 19]);
});

test('nested contours name the levels that they leave out', () => {
  const tool = {kind: 'categorical', lower: 0, upper: 5, levels: ['a', 'b', 'c', 'd', 'e', 'f']};
  assert.deepEqual(outerLevels(tool), [0, 2, 3, 5]);
  assert.equal(leftOutText(tool, 'tool'), 'Of tool, 4 of 6 levels are shown, without b and e.');
  assert.equal(leftOutText({...tool, upper: 3, levels: ['a', 'b', 'c', 'd']}, 'tool'), '');
  assert.equal(leftOutText({...tool, upper: 4, levels: ['a', 'b', 'c', 'd', 'e']}, 'tool'), 'Of tool, 4 of 5 levels are shown, without c.');
  assert.equal(leftOutText({kind: 'integer', lower: 0, upper: 9}, 'count'), '');
});

test('a study says what it asks, and what came', () => {
  const response = (name, goal, limit) => ({name, goal, limit, unit: 't'}), variables = [{}, {}];
  assert.equal(question({variables, responses: [response('load', 'maximize'), response('wear', 'minimize'), response('spill', 'minimize'), response('time', 'at_most', 20)]}),
    'The study varies 2 variables and asks for load as large as possible and wear and spill as small as possible, with time of at most 20.0 t.');
  assert.equal(question({variables: [{name: 'x_y'}], responses: [response('load', 'record')]}), 'The study varies x y and records load.');
  assert.deepEqual(came([{y: [3, 1]}, {y: null}, {y: [5, 2]}], 0), [3, 5]);
  assert.equal(came([{y: null}], 0), null);
});

const packed = (Kind, values) => Buffer.from(Kind.from(values).buffer).toString('base64');

/// Position and quaternion of a body at a time, or null.
function poseAt(poses, body, t) {
  let p, q;
  const quaternion = {set: (...v) => { q = v; return {normalize: () => { const n = Math.hypot(...q); q = q.map((x) => x / n); }}; }};
  return poses.read(body, poses.place(t), {set: (...v) => { p = v; }}, quaternion) ? {p, q} : null;
}

// Body 0 stands from frame 1 on, goes 10 m from frame 2 to 4 with half a turn about z, whose quaternion is
// given with the other sign; body 1 comes in frame 3 and hides in frame 5; body 2 goes with body 0.
test('a body goes evenly from one of its poses to the next, and hides', () => {
  const w = 32767, h = Math.round(w * Math.SQRT1_2), scene = {
    frames: [0, 1, 2, 3, 4, 6].map((t) => ({t})),
    bodies: [{}, {}, {with: 0}],
    poses: {
      origin: [1, 0, 0], scale: 0.01, counts: [3, 2, 0], frames: packed(Uint16Array, [1, 2, 4, 3, 5]),
      data: packed(Int16Array, [0, 0, 0, w, 0, 0, 0, 0, 0, 0, w, 0, 0, 0, 1000, 0, 0, -h, 0, 0, -h, 5, 6, 7, w, 0, 0, 0, -32768, 0, 0, 0, 0, 0, 0]),
    }};
  const poses = new Poses(scene);
  assert.equal(poseAt(poses, 0, 0.5), null);
  assert.deepEqual(poseAt(poses, 0, 1.5).p, [1, 0, 0]);
  for (const body of [0, 2]) {
    const {p, q} = poseAt(poses, body, 3);
    assert.deepEqual(p, [6, 0, 0]);
    assert.ok(Math.abs(q[2] - Math.sin(Math.PI / 8)) < 1e-4 && Math.abs(q[3] - Math.cos(Math.PI / 8)) < 1e-4, String(q));
  }
  assert.deepEqual(poseAt(poses, 0, 9).p, [11, 0, 0]);
  assert.equal(poseAt(poses, 1, 2.9), null);
  assert.deepEqual(poseAt(poses, 1, 5.9).p, [1.05, 0.06, 0.07]);
  assert.equal(poseAt(poses, 1, 6), null);
});

test('a plot of few columns keeps the peaks of all samples', () => {
  const t = Float64Array.from({length: 10001}, (_, i) => i / 1000), y = t.map((v) => Math.sin(v));
  y[4321] = 50;
  y[9876] = -70;
  const kept = peaksKept({t, y}, [0, 10], 300);
  assert.ok(kept.t.length <= 600, String(kept.t.length));
  assert.equal(Math.max(...kept.y), 50);
  assert.equal(Math.min(...kept.y), -70);
  assert.equal(kept.t[kept.y.indexOf(50)], 4.321);
  for (let i = 1; i < kept.t.length; ++i) assert.ok(kept.t[i] > kept.t[i - 1]);
  assert.deepEqual(peaksKept({t: [0, 1, 2], y: [5, 6, 7]}, [0.5, 1.5], 4), {t: [1], y: [6]});
});

test('the value at a time is the last sample before it', () => {
  assert.deepEqual([-1, 0, 0.99, 1, 2.5].map((time) => sampleAt([0, 1, 2], time)), [0, 0, 0, 1, 2]);
});

// 0.5 s apart on the average: the last value holds half a second, and is gone then.
test('a signal has no value before it begins and after it ends', () => {
  const signal = {t: [1, 1.5, 2], y: [5, 6, 7]};
  assert.deepEqual([0.9, 1, 1.9, 2, 2.5, 2.51].map((time) => valueAt(signal, time)), [null, 5, 6, 7, 7, null]);
  assert.equal(valueAt({t: [], y: []}, 0), null);
  assert.equal(valueAt({t: [3], y: [4]}, 3), 4);
});

test('scenes of a run share their bodies', () => {
  const panels = [{type: 'table'}, {cycle: 1, shapes: ['s'], bodies: ['b'], frames: [1]}, {cycle: 2, bodies_of: 1, frames: [2]}, {cycle: 2}];
  assert.deepEqual(cyclesOf(panels), [1, 2]);
  const whole = withBodies(panels);
  assert.deepEqual([whole[2].shapes, whole[2].bodies, whole[2].frames], [['s'], ['b'], [2]]);
  assert.equal(whole[1], panels[1]);
});

test('bars of a design hold every run, those on the bounds too', () => {
  assert.deepEqual(shares([-5, 25, 25, 10], {lower: -5, upper: 25}, 10), [25, 0, 0, 0, 0, 25, 0, 0, 0, 50]);
  // 0.1 and 0.7 are no binary numbers: a corner of a design is the bound itself.
  for (const parts of [1, 3, 10]) {
    const bars = shares([0.1, 0.3, 0.7], {lower: 0.1, upper: 0.7}, parts);
    assert.equal(bars.length, parts);
    assert.ok(Math.abs(bars.reduce((sum, bar) => sum + bar, 0) - 100) < 1e-12);
  }
});

const greyScale = [[0, '#000000'], [0.5, '#808080'], [1, '#ffffff']];

test('a colour lies between the stops of its scale, and at its ends beyond them', () => {
  assert.equal(colourAt(greyScale, 0.25), 'rgb(64,64,64)');
  assert.equal(colourAt(greyScale, 0.5), 'rgb(128,128,128)');
  assert.equal(colourAt(greyScale, 2), 'rgb(255,255,255)');
  assert.equal(colourAt(greyScale, -1), 'rgb(0,0,0)');
});

test('points of a large front are drawn by shade, each once: those beyond the scale at its ends, those without a value apart', () => {
  const marker = {color: [0, 10, 9.99, -5, 50, NaN, 5], colorscale: greyScale, cmin: 0, cmax: 10};
  const groups = byShade(marker, 7).filter(({points}) => points.length > 0);
  assert.deepEqual(groups.map(({points}) => points), [[0, 3], [6], [1, 2, 4], [5]]);
  assert.deepEqual(groups.map(({fill}) => fill), ['rgb(2,2,2)', 'rgb(130,130,130)', 'rgb(253,253,253)', 'rgb(128,128,128)']);
});

test('one colour is one group, and so is a scale without a length', () => {
  assert.deepEqual(byShade({color: 'red'}, 3), [{fill: 'red', points: [0, 1, 2]}]);
  const level = byShade({color: Float64Array.from([4, 4]), colorscale: greyScale, cmin: 4, cmax: 4}, 2);
  assert.deepEqual(level.filter(({points}) => points.length > 0).map(({points}) => points), [[0, 1]]);
});

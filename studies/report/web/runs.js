// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The runs behind everything: the scatter matrix of the design, the failures, and every run as a table.

import {el, figure, section, table} from './dom.js';
import {axisLabel, colour, labelled, number, place, setting, ticks} from './format.js';
import {axis, draw, plotBox} from './plot.js';

const mostVariables = 6;
const bars = 10;

export function runs(data) {
  const node = section('runs', 'The runs', 'Each point is one simulation. The training runs are spread evenly over the whole box; adaptive runs were added where the runs before them showed most to learn, confirmation runs on predicted fronts; all of these make the models. The validation runs are drawn at random and were kept from the fit.');
  node.append(scatterMatrix(data));
  const failed = everyRun(data).filter((r) => r.y === null);
  if (failed.length) node.append(el('div', {class: 'block'}, el('h3', {}, `${failed.length} failed ${failed.length === 1 ? 'run' : 'runs'}`), failures(data, failed)));
  node.append(el('details', {class: 'block'}, el('summary', {}, 'All runs as a table'), runTable(data)));
  return node;
}

const everyRun = (data) => [...data.training.rows.map((r) => ({...r, set: r.kind || 'training'})), ...data.validation.rows.map((r) => ({...r, set: 'validation'}))];

const inputs = (data) => data.problem.variables.map((v) => ({title: labelled(v), format: (value) => setting(value, v)}));

function failures(data, failed) {
  return table([{title: 'Run', format: String}, {title: 'Set', text: true}, ...inputs(data), {title: 'Reason', text: true}],
    failed.map((r) => [r.run, r.set, ...r.x, r.reason]), {tall: true}).node;
}

function runTable(data) {
  const outputs = data.problem.responses.map((r) => ({title: labelled(r), format: number}));
  return table([{title: 'Run', format: String}, {title: 'Set', text: true}, ...inputs(data), ...outputs, {title: 'Time [s]', format: number}],
    everyRun(data).map((r) => [r.run, r.set, ...r.x, ...(r.y ?? data.problem.responses.map(() => 'failed')), r.seconds]), {tall: true}).node;
}

function scatterMatrix(data) {
  const shown = mostInfluential(data);
  const d = shown.length;
  const box = plotBox(d === 1 ? 260 : Math.min(860, 120 + 190 * d), 'Scatter matrix of the design points');
  const traces = [];
  const layout = {margin: {l: 64, r: 12, t: 30, b: 52}, barmode: 'overlay', legend: {orientation: 'h', x: 0, y: 1.01, yanchor: 'bottom'}};
  for (let row = 0; row < d; ++row) for (let column = 0; column < d; ++column) cell(data, shown, row, column, traces, layout);
  draw(box, traces, layout);
  const half = data.validation.rows.length && d > 1 ? 'Below the diagonal the training runs, above it the validation runs. ' : '';
  const part = d < data.problem.variables.length ? `The ${d} most influential of ${data.problem.variables.length} variables are shown. ` : '';
  const failed = everyRun(data).some((r) => r.y === null) ? 'Failed runs are red crosses: a cluster of them marks a region where the simulation breaks down.' : '';
  return figure(box, `Where the design was sampled. ${half}On the diagonal, the share of runs along each variable; even bars mean even coverage; adaptive and confirmation runs count with the training runs. ${part}${failed}`);
}

/// In the order of the problem, at most mostVariables of them.
function mostInfluential(data) {
  const all = data.problem.variables.map((_, k) => k);
  const weight = (k) => Math.max(0, ...data.influence.filter(Boolean).map((row) => row[k]));
  return [...all].sort((a, b) => weight(b) - weight(a)).slice(0, mostVariables).sort((a, b) => a - b);
}

function cell(data, shown, row, column, traces, layout) {
  const d = shown.length, id = row * d + column + 1, gap = d > 1 ? 0.03 : 0;
  const size = (1 - gap * (d - 1)) / d;
  const x = column * (size + gap), y = (d - 1 - row) * (size + gap);
  const suffix = id === 1 ? '' : id;
  const across = data.problem.variables[shown[column]], down = data.problem.variables[shown[row]];
  const range = (v) => [v.lower - 0.04 * (v.upper - v.lower), v.upper + 0.04 * (v.upper - v.lower)];
  layout['xaxis' + suffix] = axis(row === d - 1 ? axisLabel(across) : '', {domain: [x, x + size], anchor: 'y' + suffix, range: range(across), showticklabels: row === d - 1, nticks: 5, automargin: false, mirror: true, ...ticks(across)});
  layout['yaxis' + suffix] = axis(column === 0 ? axisLabel(down) : '', {domain: [y, y + size], anchor: 'x' + suffix, showticklabels: column === 0 && row !== column, nticks: 5, automargin: false, mirror: true, ...(row === column ? {} : ticks(down)),
    ...(row === column ? {rangemode: 'tozero', fixedrange: true} : {range: range(down)})});
  const panel = {xaxis: 'x' + suffix, yaxis: 'y' + suffix};
  if (row === column) histograms(data, shown[row], panel, traces, id === 1);
  else points(data, shown, row, column, panel, traces, id === (d > 1 ? 2 : 0));
}

/// Percent of the values in each of the equal parts of a variable's range; both bounds belong to a part.
function shares(values, {lower, upper}) {
  const counts = new Array(bars).fill(0);
  for (const value of values) ++counts[Math.min(bars - 1, Math.floor(bars * (value - lower) / (upper - lower)))];
  return counts.map((count) => 100 * count / values.length);
}

function histograms(data, k, panel, traces, legend) {
  const v = data.problem.variables[k];
  const middles = Array.from({length: bars}, (_, i) => v.lower + (i + 0.5) / bars * (v.upper - v.lower));
  for (const set of ['training', 'validation']) {
    if (!data[set].rows.length) continue;
    traces.push({type: 'bar', name: set, legendgroup: set, showlegend: legend, x: middles, y: shares(data[set].rows.map((r) => r.x[k]), v), width: (v.upper - v.lower) / bars,
      marker: {color: colour[set], opacity: set === 'training' ? 0.75 : 0.5}, hovertemplate: set + ' %{y:.0f} %<extra></extra>', ...panel});
  }
}

function points(data, shown, row, column, panel, traces, legend) {
  const across = data.problem.variables[shown[column]], down = data.problem.variables[shown[row]];
  const set = column > row && data.validation.rows.length ? 'validation' : 'training';
  const part = (failed) => data[set].rows.filter((r) => (r.y === null) === failed);
  const trace = (rows, more) => ({x: rows.map((r) => r.x[shown[column]]), y: rows.map((r) => r.x[shown[row]]), mode: 'markers',
    text: rows.map((r) => 'run ' + r.run), hovertemplate: `%{text}<br>${place(across, 'x', 4)}, ${place(down, 'y', 4)}<extra></extra>`, ...panel, ...more});
  const size = data[set].rows.length > 150 ? 4 : 6;
  traces.push(trace(part(false), {showlegend: false, legendgroup: set, name: set, marker: {size, color: colour[set], opacity: 0.8}}));
  const failed = part(true);
  const any = everyRun(data).some((r) => r.y === null);
  if (failed.length || (legend && any)) traces.push(trace(failed, {name: 'failed', legendgroup: 'failed', showlegend: legend, marker: {size: size + 3, symbol: 'x-thin', color: colour.failed, line: {color: colour.failed, width: 2}}}));
}

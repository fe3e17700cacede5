// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Where the runs lie: every pair of variables, and how often each part of a variable's range occurs.

import {runText} from './designs.js';
import {link, linkPoints, opacities} from './dimming.js';
import {figure} from './dom.js';
import {axisLabel, ticks} from './format.js';
import {legendOfLimits, symbols} from './limits.js';
import {axis, draw, plotBox} from './plot.js';
import {shares} from './shares.js';
import {colour} from './theme.js';

const mostVariables = 6;
const bars = 10;

export function scatterMatrix(data, shared) {
  const shown = mostInfluential(data);
  const d = shown.length;
  const box = plotBox(d === 1 ? 260 : Math.min(860, 120 + 190 * d), 'Scatter matrix of the design points');
  const view = {data, shown, hovers: hoverTexts(data), ...shared};
  const links = matrix(view).traces.map((trace) => trace.known);
  draw(box, (saved) => matrix({...view, saved}));
  linkPoints(box, links, shared);
  const half =
    data.validation.rows.length && d > 1 ? 'Below the diagonal the training runs, above it the validation runs. ' : '';
  const part =
    d < data.problem.variables.length
      ? `The ${d} most influential of ${data.problem.variables.length} variables are shown. `
      : '';
  const failed = shared.designs.runs.some((r) => r.y === null)
    ? 'Failed runs are red crosses: a cluster of them marks a region where the simulation breaks down.'
    : '';
  return figure(
    box,
    `Where the design was sampled. ${half}On the diagonal, the share of runs along each variable; even bars ` +
      `mean even coverage; adaptive and confirmation runs count with the training runs. ${part}${failed}` +
      legendOfLimits(shared.designs.runs),
  );
}

/// The traces carry which runs they show (known), for those who dim them.
function matrix(view) {
  const d = view.shown.length,
    traces = [];
  const layout = {
    margin: {l: 64, r: 12, t: 30, b: 52},
    barmode: 'overlay',
    legend: {orientation: 'h', x: 0, y: 1.01, yanchor: 'bottom'},
  };
  for (let row = 0; row < d; ++row) for (let column = 0; column < d; ++column) cell(view, row, column, traces, layout);
  return {traces, layout};
}

const hoverTexts = ({problem, training, validation}) =>
  [...training.rows, ...validation.rows].map((r) => runText(problem, r));

/// In the order of the problem, at most mostVariables of them.
function mostInfluential(data) {
  const all = data.problem.variables.map((_, k) => k);
  const weight = (k) => Math.max(0, ...data.influence.filter(Boolean).map((row) => row[k]));
  return [...all]
    .sort((a, b) => weight(b) - weight(a))
    .slice(0, mostVariables)
    .sort((a, b) => a - b);
}

function cell(view, row, column, traces, layout) {
  const {data, shown} = view,
    d = shown.length,
    id = row * d + column + 1,
    gap = d > 1 ? 0.03 : 0;
  const size = (1 - gap * (d - 1)) / d;
  const x = column * (size + gap),
    y = (d - 1 - row) * (size + gap);
  const suffix = id === 1 ? '' : id;
  const across = data.problem.variables[shown[column]],
    down = data.problem.variables[shown[row]];
  const range = (v) => [v.lower - 0.04 * (v.upper - v.lower), v.upper + 0.04 * (v.upper - v.lower)];
  layout['xaxis' + suffix] = axis(row === d - 1 ? axisLabel(across) : '', {
    domain: [x, x + size],
    anchor: 'y' + suffix,
    range: range(across),
    showticklabels: row === d - 1,
    nticks: 5,
    automargin: false,
    mirror: true,
    ...ticks(across),
  });
  layout['yaxis' + suffix] = axis(column === 0 ? axisLabel(down) : '', {
    domain: [y, y + size],
    anchor: 'x' + suffix,
    showticklabels: column === 0 && row !== column,
    nticks: 5,
    automargin: false,
    mirror: true,
    ...(row === column ? {} : ticks(down)),
    ...(row === column ? {rangemode: 'tozero', fixedrange: true} : {range: range(down)}),
  });
  const panel = {xaxis: 'x' + suffix, yaxis: 'y' + suffix};
  if (row === column) histograms(data, shown[row], panel, traces, id === 1);
  else points(view, row, column, panel, traces, id === (d > 1 ? 2 : 0));
}

function histograms(data, k, panel, traces, legend) {
  const v = data.problem.variables[k];
  const middles = Array.from({length: bars}, (_, i) => v.lower + ((i + 0.5) / bars) * (v.upper - v.lower));
  for (const set of ['training', 'validation']) {
    if (!data[set].rows.length) continue;
    traces.push({
      type: 'bar',
      name: set,
      legendgroup: set,
      showlegend: legend,
      x: middles,
      y: shares(
        data[set].rows.map((r) => r.x[k]),
        v,
        bars,
      ),
      width: (v.upper - v.lower) / bars,
      marker: {color: colour[set], opacity: set === 'training' ? 0.75 : 0.5},
      hovertemplate: set + ' %{y:.0f} %<extra></extra>',
      ...panel,
    });
  }
}

function points({data, shown, hovers, designs, selection, saved}, row, column, panel, traces, legend) {
  const validation = column > row && data.validation.rows.length > 0;
  const set = validation ? 'validation' : 'training',
    offset = validation ? data.training.rows.length : 0;
  const part = (failed) =>
    data[set].rows.map((_, i) => i + offset).filter((i) => (designs.runs[i].y === null) === failed);
  const trace = (indices, opacity, {marker, ...more}) => {
    const known = link('runs', indices, opacity);
    return {
      x: indices.map((i) => designs.runs[i].x[shown[column]]),
      y: indices.map((i) => designs.runs[i].x[shown[row]]),
      mode: 'markers',
      known,
      text: indices.map((i) => hovers[i]),
      hovertemplate: '%{text}<extra></extra>',
      marker: {...marker, opacity: opacities(selection, known, indices.length, saved)},
      ...panel,
      ...more,
    };
  };
  const size = data[set].rows.length > 150 ? 4 : 6;
  traces.push(
    trace(part(false), 0.8, {
      showlegend: false,
      legendgroup: set,
      name: set,
      marker: {size, color: colour[set], symbol: symbols(part(false).map((i) => designs.runs[i]))},
    }),
  );
  const failed = part(true);
  const any = designs.runs.some((r) => r.y === null);
  if (failed.length || (legend && any))
    traces.push(
      trace(failed, 1, {
        name: 'failed',
        legendgroup: 'failed',
        showlegend: legend,
        marker: {size: size + 3, symbol: 'x-thin', color: colour.failed, line: {color: colour.failed, width: 2}},
      }),
    );
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The trade-offs: projections of the front on pairs of objectives, and its points as a table.

import {el, figure, section, select, table} from './dom.js';
import {axisLabel, colour, labelled, number, percent, pretty, scale, setting, settingWithUnit, ticks, withUnit} from './format.js';
import {axis, draw, plotBox} from './plot.js';

const mostProjections = 6;
/// On one line.
const interval95 = (low, high) => `${number(low, 3)}\u00a0to\u00a0${number(high, 3)}`;

export function tradeOffs(data, chosen) {
  const objectives = data.front.objectives.map((j) => data.problem.responses[j]);
  const node = section('front', objectives.length > 1 ? 'Trade-offs' : 'Best point', lead(data, objectives));
  if (!data.front.X.length) return node;
  if (objectives.length > 1) node.append(projections(data, objectives, chosen));
  if (data.confirmations.rows.length) node.append(confirmed(data));
  node.append(pointTable(data, objectives, chosen));
  return node;
}

/// Predicted and simulated, side by side.
function confirmed(data) {
  const judged = data.problem.responses.map((response, j) => ({response, j})).filter(({response}) => response.goal !== 'record');
  const columns = [{title: 'Run', format: String}, {title: 'Round', format: String}, ...data.problem.variables.map((v) => ({title: labelled(v), format: (value) => setting(value, v)})),
    ...judged.flatMap(({response}) => [{title: `${labelled(response)} predicted`, text: true}, {title: 'simulated', text: true}]), {title: 'Note', text: true}];
  const cell = (r, j) => [interval95(r.lower[j], r.upper[j]),
    r.y === null ? 'failed' : number(r.y[j]) + (r.within[j] ? '' : ' outside')];
  const note = (r) => [r.named ? 'named by the user' : '', r.y === null ? r.reason : '', r.breaks_limit ? 'breaks a limit' : '', r.dominated ? 'dominated' : ''].filter(Boolean).join(', ');
  const rows = data.confirmations.rows.map((r) => [r.run, r.round, ...r.x, ...judged.flatMap(({j}) => cell(r, j)), note(r)]);
  return el('div', {class: 'block'}, el('h3', {}, 'Confirmed by simulation'),
    el('p', {class: 'note'}, `Each run was predicted by the models of the runs before it; the interval given should hold 95 of 100 such runs. ${data.confirmations.text}.`),
    table(columns, rows, {tall: true}).node);
}

function lead(data, objectives) {
  if (!objectives.length) return 'The study names no response to minimize or maximize, so there is nothing to search for.';
  if (!data.front.X.length) return `There is no front: ${data.no_front || 'the surrogates could not be fitted or searched'}.`;
  if (objectives.length === 1) return `The surrogate was searched for the best ${pretty(objectives[0].name)}.`;
  return `${data.front.X.length} points that the surrogates cannot improve in one objective without losing in another (the Pareto front). All are predictions${data.confirmations.rows.length ? '; below stand those that were simulated.' : ': simulate a point before relying on it (command confirm).'}`;
}

/// Which points meet the conditions of an optimum, and what it took. Of the surrogates, so no promise for the simulation.
export function certificate({residual, certified, tolerance, gain, skipped}) {
  if (skipped) return `The search was not finished with gradients: ${skipped}.`;
  if (!residual.length) return '';
  const added = gain === null ? '' : ` Finishing the search with gradients added ${number(gain, 2)} % of hypervolume.`;
  return `${certified} of ${residual.length} are certified: they meet the first-order conditions of an optimum of the surrogates (KKT residual at most ${tolerance.toExponential(0)}).${added}`;
}

function pairs(count) {
  const all = [];
  for (let a = 0; a < count; ++a) for (let b = a + 1; b < count; ++b) all.push([a, b]);
  return all.slice(0, mostProjections);
}

function projections(data, objectives, chosen) {
  const shown = pairs(objectives.length).map((pair) => ({pair, box: plotBox(400, 'Pareto projection')}));
  const colourings = [objectives.length > 2 ? 'the third response' : 'nothing', ...objectives.map(labelled), ...data.problem.variables.map(labelled)];
  let by = objectives.length > 2 ? 0 : objectives.length + 1;
  const redraw = () => shown.forEach(({pair, box}) => projection(box, data, objectives, pair, colouring(data, objectives, pair, by), chosen));
  chosen.onchange(redraw);
  redraw();
  shown.forEach(({box}) => box.on('plotly_click', ({points}) => {
    if (points[0].data.name === 'front') chosen.select(points[0].pointIndex);
  }));
  return figure(el('div', {}, el('div', {class: 'controls'}, select('Colour by', colourings, by, (i) => { by = i; redraw(); })),
    el('div', {class: 'grid'}, shown.map(({box}) => box))),
    'The front seen from each pair of objectives. Grey dots are simulated training runs, for scale; the diamond is the balanced point, nearest to the best of every objective at once; a line leads from what was predicted of a confirmed point to what its simulation gave (square). Click a point to follow it through the report.');
}


function colouring(data, objectives, [a, b], by) {
  const m = objectives.length;
  if (by === 0) {
    const third = objectives.findIndex((_, k) => k !== a && k !== b);
    return third < 0 ? null : {item: objectives[third], values: data.front.Y.map((y) => y[third])};
  }
  if (by <= m) return {item: objectives[by - 1], values: data.front.Y.map((y) => y[by - 1])};
  return {item: data.problem.variables[by - 1 - m], values: data.front.X.map((x) => x[by - 1 - m])};
}

function projection(box, data, objectives, [a, b], shade, chosen) {
  const column = (k) => data.front.Y.map((y) => y[k]);
  const simulated = (k) => data.training.rows.filter((r) => r.y).map((r) => r.y[data.front.objectives[k]]);
  const marker = {size: 8, line: {color: '#fff', width: 0.6}, color: shade ? shade.values : colour.training};
  if (shade) Object.assign(marker, {colorscale: scale, showscale: true,
    colorbar: {title: {text: axisLabel(shade.item), side: 'right', font: {size: 12}}, thickness: 11, len: 0.95, outlinewidth: 0, tickfont: {size: 11}, ...ticks(shade.item)}});
  const traces = [
    {name: 'simulated', x: simulated(a), y: simulated(b), mode: 'markers', marker: {size: 5, color: '#c3ccd4'}, hovertemplate: 'simulated<br>%{x:.4g}, %{y:.4g}<extra></extra>'},
    {name: 'front', x: column(a), y: column(b), mode: 'markers', marker, customdata: data.front.Y.map((_, i) => i + 1),
      hovertemplate: `point %{customdata}<br>${axisLabel(objectives[a])}: %{x:.4g}<br>${axisLabel(objectives[b])}: %{y:.4g}<extra></extra>`},
  ];
  traces.push(...confirmations(data, a, b));
  const ring = (i, symbol, line) => ({x: [data.front.Y[i][a]], y: [data.front.Y[i][b]], mode: 'markers', hoverinfo: 'skip',
    marker: {symbol, size: 16, color: line, line: {width: 2.5}}});
  if (data.front.balanced >= 0) traces.push(ring(data.front.balanced, 'diamond-open', colour.ink));
  if (chosen.selected >= 0) traces.push(ring(chosen.selected, 'circle-open', colour.accent));
  draw(box, traces, {showlegend: false, margin: {l: 60, r: 8, t: 12, b: 52}, xaxis: axis(goal(objectives[a])), yaxis: axis(goal(objectives[b]))});
}

/// From predicted to simulated.
function confirmations(data, a, b) {
  const [ja, jb] = [data.front.objectives[a], data.front.objectives[b]];
  const rows = data.confirmations.rows.filter((r) => r.y);
  if (!rows.length) return [];
  const line = (j) => rows.flatMap((r) => [r.predicted[j], r.y[j], null]);
  return [{x: line(ja), y: line(jb), mode: 'lines', hoverinfo: 'skip', line: {color: colour.ink, width: 1}},
    {x: rows.map((r) => r.y[ja]), y: rows.map((r) => r.y[jb]), mode: 'markers', text: rows.map((r) => 'run ' + r.run),
      marker: {symbol: 'square', size: 8, color: colour.ink}, hovertemplate: '%{text}, simulated<br>%{x:.4g}, %{y:.4g}<extra></extra>'}];
}

const goal = (response) => axisLabel(response) + (response.goal === 'maximize' ? ' →' : ' ←');

function pointTable(data, objectives, chosen) {
  const {lower, upper, success} = data.front;
  const values = objectives.flatMap((item) => [{title: labelled(item), format: number}, ...lower.length ? [{title: '95 % of runs', text: true}] : []]);
  const interval = (i, k) => lower.length ? [interval95(lower[i][k], upper[i][k])] : [];
  const chance = success.length ? [{title: 'a run succeeds', format: percent}] : [];
  const columns = [{title: 'Point', format: String}, ...values, ...chance, ...data.problem.variables.map((item) => ({title: labelled(item), format: (value) => setting(value, item)}))];
  const rows = data.front.X.map((x, i) => [i + 1, ...data.front.Y[i].flatMap((y, k) => [y, ...interval(i, k)]), ...success.slice(i, i + 1), ...x]);
  const detail = el('p', {class: 'note'});
  const {node, select: mark} = table(columns, rows, {onselect: (i) => chosen.select(chosen.selected === i ? -1 : i), tall: true});
  const update = () => {
    mark(chosen.selected);
    detail.textContent = chosen.selected < 0 ? 'Click a head to sort, a row to mark the point in the plots and to cut the response surfaces through it.' : describe(data, objectives, chosen.selected);
  };
  chosen.onchange(update);
  update();
  return el('div', {class: 'block'}, el('h3', {}, objectives.length > 1 ? 'Points of the front' : 'Points found'), detail, node);
}

function describe(data, objectives, i) {
  const y = objectives.map((r, k) => `${pretty(r.name)} ${withUnit(data.front.Y[i][k], r)}`);
  const x = data.problem.variables.map((v, k) => `${pretty(v.name)} = ${settingWithUnit(data.front.X[i][k], v)}`);
  const chance = data.front.success.length ? ` A run there succeeds with a chance of ${percent(data.front.success[i])}, as the runs that failed say.` : '';
  return `Point ${i + 1}: ${y.join(', ')} at ${x.join(', ')}.${chance}`;
}

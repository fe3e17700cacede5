// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The trade-offs: projections of the front on pairs of objectives, and its points as a table.

import {el, figure, section, select, table} from './dom.js';
import {axisLabel, colour, labelled, number, pretty, scale, withUnit} from './format.js';
import {axis, draw, plotBox} from './plot.js';

const mostProjections = 6;

export function tradeOffs(data, chosen) {
  const objectives = data.front.objectives.map((j) => data.problem.responses[j]);
  const node = section('front', objectives.length > 1 ? 'Trade-offs' : 'Best point', lead(data, objectives));
  if (!data.front.X.length) return node;
  if (objectives.length > 1) node.append(projections(data, objectives, chosen));
  node.append(pointTable(data, objectives, chosen));
  return node;
}

function lead(data, objectives) {
  if (!objectives.length) return 'The study names no response to minimize or maximize, so there is nothing to search for.';
  if (!data.front.X.length) return 'There is no front: the surrogates could not be fitted or searched.';
  if (objectives.length === 1) return `The surrogate was searched for the best ${pretty(objectives[0].name)}.${certificate(data.polishing)}`;
  return `${data.front.X.length} points that the surrogates cannot improve in one objective without losing in another (the Pareto front).${certificate(data.polishing)} All are predictions: confirm a point by simulating it before relying on it.`;
}

/// Which points meet the conditions of an optimum, and what it took. Of the surrogates, so no promise for the simulation.
function certificate({residual, certified, tolerance, gain, skipped}) {
  if (skipped) return ` The search was not finished with gradients: ${skipped}.`;
  if (!residual.length) return '';
  const added = gain === null ? '' : ` Finishing the search with gradients added ${number(gain, 2)} % of hypervolume.`;
  return ` ${certified} of ${residual.length} are certified: they meet the first-order conditions of an optimum of the surrogates (KKT residual at most ${tolerance.toExponential(0)}).${added}`;
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
    'The front seen from each pair of objectives. Grey dots are simulated training runs, for scale; the diamond is the balanced point, nearest to the best of every objective at once. Click a point to follow it through the report.');
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
    colorbar: {title: {text: axisLabel(shade.item), side: 'right', font: {size: 12}}, thickness: 11, len: 0.95, outlinewidth: 0, tickfont: {size: 11}}});
  const traces = [
    {name: 'simulated', x: simulated(a), y: simulated(b), mode: 'markers', marker: {size: 5, color: '#c3ccd4'}, hovertemplate: 'simulated<br>%{x:.4g}, %{y:.4g}<extra></extra>'},
    {name: 'front', x: column(a), y: column(b), mode: 'markers', marker, customdata: data.front.Y.map((_, i) => i + 1),
      hovertemplate: `point %{customdata}<br>${axisLabel(objectives[a])}: %{x:.4g}<br>${axisLabel(objectives[b])}: %{y:.4g}<extra></extra>`},
  ];
  const ring = (i, symbol, line) => ({x: [data.front.Y[i][a]], y: [data.front.Y[i][b]], mode: 'markers', hoverinfo: 'skip',
    marker: {symbol, size: 16, color: line, line: {width: 2.5}}});
  if (data.front.balanced >= 0) traces.push(ring(data.front.balanced, 'diamond-open', colour.ink));
  if (chosen.selected >= 0) traces.push(ring(chosen.selected, 'circle-open', colour.accent));
  draw(box, traces, {showlegend: false, margin: {l: 60, r: 8, t: 12, b: 52}, xaxis: axis(goal(objectives[a])), yaxis: axis(goal(objectives[b]))});
}

const goal = (response) => axisLabel(response) + (response.goal === 'maximize' ? ' →' : ' ←');

function pointTable(data, objectives, chosen) {
  const items = [...objectives, ...data.problem.variables];
  const {residual} = data.polishing;
  const certificates = residual.length ? [{title: 'KKT residual', format: (value) => number(value, 2)}] : [];
  const columns = [{title: 'Point', format: String}, ...items.map((item) => ({title: labelled(item), format: number})), ...certificates];
  const rows = data.front.X.map((x, i) => [i + 1, ...data.front.Y[i], ...x, ...residual.slice(i, i + 1)]);
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
  const x = data.problem.variables.map((v, k) => `${pretty(v.name)} = ${withUnit(data.front.X[i][k], v)}`);
  return `Point ${i + 1}: ${y.join(', ')} at ${x.join(', ')}.`;
}

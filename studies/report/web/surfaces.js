// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Response surfaces: each response over two chosen variables, cut at the sliders' values of all variables,
// and along every variable alone. The surrogates are evaluated here, in the browser.
/* global Plotly */

import {choice, el, figure, section, select} from './dom.js';
import {axisLabel, labelled, place, plain, pretty, settingWithUnit, ticks} from './format.js';
import {oncePerFrame} from './frames.js';
import {predictor, steps} from './kriging.js';
import {axis, draw, plotBox} from './plot.js';
import {colour, scale, series} from './theme.js';

const mostProfiles = 6;

export function surfaces(data, {chosen}) {
  const fitted = data.problem.responses.map((response, j) => ({response, j, model: data.models[j]})).filter((f) => f.model?.surface);
  const node = section('surfaces', 'Response surfaces', fitted.length ? 'What the surrogates predict between the simulated points.' : 'There is no surrogate to draw.');
  if (!fitted.length) return node;
  for (const f of fitted) {
    const mean = predictor(f.model.surface), {lower = -Infinity, upper = Infinity} = f.response;
    f.mean = (x) => Math.min(Math.max(mean(x), lower), upper);
    f.range = extent(data.training.rows.filter((r) => r.y).map((r) => r.y[f.j]));
  }
  node.append(influence(data, fitted));
  const controls = sliders(data, chosen);
  node.append(controls);
  if (data.problem.variables.length > 1) node.append(maps(data, fitted, chosen));
  node.append(profiles(data, fitted, chosen));
  return node;
}

/// Where a curve along a variable is drawn: at all of its values where there are few, so that none is made up
/// between them.
const places = (v, count) => steps(v.lower, v.upper, v.kind ? Math.min(count, v.upper - v.lower + 1) : count)
  .map((value) => (v.kind ? Math.round(value) : value));

function extent(values) {
  const low = Math.min(...values), high = Math.max(...values);
  return high > low ? [low, high] : [low - 0.5, high + 0.5];
}

function influence(data, fitted) {
  const known = fitted.filter((f) => data.influence[f.j]);
  const order = data.problem.variables.map((_, k) => k).reverse();
  const box = plotBox(90 + 34 * Math.max(2, order.length) * Math.max(1, known.length / 2.2), 'Influence of each variable');
  draw(box, () => ({traces: known.map((f, i) => ({type: 'bar', orientation: 'h', name: plain(pretty(f.response.name)), y: order.map((k) => plain(pretty(data.problem.variables[k].name))),
    x: order.map((k) => data.influence[f.j][k]), marker: {color: series[i % series.length]}, hovertemplate: '%{y}: %{x:.2f}<extra>%{fullData.name}</extra>'})).reverse(),
    layout: {barmode: 'group', bargap: 0.28, legend: {orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom', traceorder: 'reversed'}, margin: {l: 100, r: 16, t: 24, b: 48},
      xaxis: axis('share of the variation in which the variable takes part (total effect)', {rangemode: 'tozero'}), yaxis: axis('', {showgrid: false})}}));
  return figure(box, 'What drives each response, over the whole box (total Sobol index of the surrogate). A bar near zero means that the variable hardly matters; shares can add up to more than one where variables act together.');
}

function sliders(data, chosen) {
  const rows = data.problem.variables.map((v, k) => {
    const out = el('output', {});
    const whole = v.upper - v.lower, most = v.kind ? whole : 200;
    const input = el('input', {type: 'range', min: 0, max: most, step: 1, 'aria-label': pretty(v.name), oninput: () => {
      const x = [...chosen.x];
      x[k] = v.lower + (whole * Number(input.value)) / most;
      chosen.move(x);
    }});
    return {k, v, most, input, out, node: el('label', {class: 'slider'}, el('span', {}, pretty(v.name)), input, out)};
  });
  const update = () => rows.forEach(({k, v, most, input, out}) => {
    const position = String(Math.round((most * (chosen.x[k] - v.lower)) / (v.upper - v.lower)));
    if (input.value !== position) input.value = position;
    out.textContent = settingWithUnit(chosen.x[k], v);
  });
  chosen.onchange(update);
  update();
  return el('div', {class: 'block sliders'}, el('p', {class: 'note'}, 'Cut through the point'), rows.map((r) => r.node),
    el('button', {type: 'button', onclick: () => chosen.reset()}, 'Middle of the box'));
}

function maps(data, fitted, chosen) {
  const {variables} = data.problem;
  let [a, b] = data.main_pair;
  let solid = false;
  const boxes = fitted.map((f) => plotBox(fitted.length === 1 ? 460 : 380, 'Response surface of ' + f.response.name));
  const redraw = oncePerFrame(() => fitted.forEach((f, i) => map(boxes[i], f, variables, [a, b], chosen, solid)));
  const names = variables.map(labelled);
  const across = select('Across', names, a, (k) => { if (k === b) { b = a; up.querySelector('select').value = b; } a = k; redraw(); });
  const up = select('Up', names, b, (k) => { if (k === a) { a = b; across.querySelector('select').value = a; } b = k; redraw(); });
  chosen.onchange(redraw);
  redraw.now();
  return figure(el('div', {}, el('div', {class: 'controls'}, across, up, choice(['Contours', '3-D'], (i) => { solid = i === 1; boxes.forEach((box) => Plotly.purge(box)); redraw(); })),
    el('div', {class: 'grid'}, boxes)),
    'Predicted response over two variables, the others held at the sliders above. The colours span the simulated range of each response and do not move with the sliders; the cross marks the sliders’ point. Lines close together mean a steep response.');
}

function map(box, f, variables, [a, b], chosen, solid) {
  const count = f.model.surface.weights.length > 200 ? 31 : 41;
  const x = places(variables[a], count), y = places(variables[b], count);
  const point = [...chosen.x];
  const z = y.map((vb) => x.map((va) => { point[a] = va; point[b] = vb; return f.mean(point); }));
  const revision = `${a} ${b} ${solid}`;
  const title = {text: axisLabel(f.response), font: {size: 14}, x: 0, xanchor: 'left', xref: 'paper'};
  const range = {zmin: f.range[0], zmax: f.range[1], colorscale: scale, colorbar: {thickness: 11, len: 0.95, outlinewidth: 0, tickfont: {size: 11}}};
  if (solid) {
    const side = (item) => ({title: {text: axisLabel(item)}, color: colour.ink, gridcolor: colour.axis, zeroline: false});
    const scene = () => ({xaxis: {...side(variables[a]), ...ticks(variables[a])}, yaxis: {...side(variables[b]), ...ticks(variables[b])}, zaxis: side(f.response), camera: {eye: {x: -1.75, y: -1.85, z: 1.05}, center: {x: 0, y: 0, z: -0.15}}});
    const {zmin, zmax, ...rest} = range;
    draw(box, () => ({traces: [{type: 'surface', x, y, z, cmin: zmin, cmax: zmax, ...rest, showscale: false, contours: {z: {show: true, usecolormap: false, color: 'rgba(255,255,255,0.5)', width: 1}}}], layout: {title, margin: {l: 0, r: 0, t: 36, b: 0}, scene: scene(), uirevision: revision}}));
    return;
  }
  draw(box, () => ({traces: [
    {type: 'contour', x, y, z, ...range, ncontours: 14, contours: {coloring: 'heatmap', showlines: true}, line: {color: 'rgba(255,255,255,0.55)', width: 0.8},
      hovertemplate: `${axisLabel(variables[a])}: ${place(variables[a], 'x')}<br>${axisLabel(variables[b])}: ${place(variables[b], 'y')}<br>${axisLabel(f.response)}: %{z:.4g}<extra></extra>`},
    {x: [chosen.x[a]], y: [chosen.x[b]], mode: 'markers', hoverinfo: 'skip', marker: {symbol: 'cross-thin', size: 13, line: {color: '#fff', width: 2.5}}},
  ], layout: {title, showlegend: false, margin: {l: 56, r: 8, t: 36, b: 52}, uirevision: revision, xaxis: axis(axisLabel(variables[a]), within(variables[a])), yaxis: axis(axisLabel(variables[b]), within(variables[b]))}}));
}

/// Of an axis: no wider than the variable, wherever the cross is.
const within = (v) => ({...ticks(v), ...(v.kind ? {} : {range: [v.lower, v.upper]})});

function profiles(data, fitted, chosen) {
  const weight = (k) => Math.max(...data.influence.filter(Boolean).map((row) => row[k]));
  const shown = data.problem.variables.map((_, k) => k).sort((p, q) => weight(q) - weight(p)).slice(0, mostProfiles).sort((p, q) => p - q);
  const box = plotBox(60 + 190 * fitted.length, 'Profiles along each variable');
  const redraw = oncePerFrame(() => draw(box, () => profile(data, fitted, shown, chosen)));
  chosen.onchange(redraw);
  redraw.now();
  const single = data.problem.variables.length === 1;
  return figure(box, single ? 'Predicted response (line) and simulated training runs (dots).' :
    'Predicted response along each variable alone, through the same point (dots: where the sliders stand). All panels of a row share one scale, so a flat line means a weak variable.');
}

function profile(data, fitted, shown, chosen) {
  const rows = fitted.length, columns = shown.length, traces = [];
  const layout = {showlegend: false, grid: {rows, columns, pattern: 'independent', xgap: 0.06, ygap: 0.14}, margin: {l: 66, r: 12, t: 12, b: 52}};
  fitted.forEach((f, r) => {
    const curves = shown.map((k) => {
      const v = data.problem.variables[k], x = places(v, 61), point = [...chosen.x];
      return {k, v, x, y: x.map((value) => { point[k] = value; return f.mean(point); })};
    });
    const [low, high] = extent([...curves.flatMap((c) => c.y), ...f.range]);
    const pad = 0.05 * (high - low);
    curves.forEach(({k, v, x, y}, c) => {
      const id = r * columns + c + 1, suffix = id === 1 ? '' : id, panel = {xaxis: 'x' + suffix, yaxis: 'y' + suffix};
      if (data.problem.variables.length === 1) traces.push(simulated(data, f, panel));
      traces.push({x, y, mode: v.kind ? 'lines+markers' : 'lines', marker: {size: 4}, line: {color: series[r % series.length], width: 2.5}, hovertemplate: `${place(v, 'x')}: %{y:.4g}<extra></extra>`, ...panel},
        {x: [chosen.x[k]], y: [f.mean(chosen.x)], mode: 'markers', marker: {size: 8, color: series[r % series.length], line: {color: colour.paper, width: 1.5}}, hoverinfo: 'skip', ...panel});
      layout['xaxis' + suffix] = axis(r === rows - 1 ? axisLabel(v) : '', {showticklabels: r === rows - 1, nticks: 6, automargin: false, ...ticks(v)});
      layout['yaxis' + suffix] = axis(c === 0 ? axisLabel(f.response) : '', {showticklabels: c === 0, range: [low - pad, high + pad], nticks: 6, automargin: false});
    });
  });
  return {traces, layout};
}

function simulated(data, f, panel) {
  const done = data.training.rows.filter((r) => r.y);
  return {x: done.map((r) => r.x[0]), y: done.map((r) => r.y[f.j]), mode: 'markers', marker: {size: 5, color: colour.guide}, hovertemplate: 'simulated %{y:.4g}<extra></extra>', ...panel};
}

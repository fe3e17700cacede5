// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Response surfaces: each response over two chosen variables, cut at the sliders' values of all variables,
// and along every variable alone. The surrogates are evaluated here, in the browser.

import {runText} from './designs.js';
import {dimmedBy, linkPoints, movingLink} from './dimming.js';
import {choice, el, figure, section, select} from './dom.js';
import {axisLabel, labelled, place, plain, pretty, settingWithUnit, ticks, withUnit} from './format.js';
import {oncePerFrame} from './frames.js';
import {predictor} from './kriging.js';
import {meanInterval} from './kriging_error.js';
import {breaksLimit, legendOfLimits, symbols} from './limits.js';
import {namedPlaces} from './named.js';
import {namedTrace} from './named_trace.js';
import {nested} from './nested.js';
import {axis, draw, plotBox} from './plot.js';
import {profiles} from './profiles.js';
import {own} from './responses.js';
import {nearCut} from './sampled.js';
import {extent, places} from './steps.js';
import {colour, faded, scale, series} from './theme.js';

const dots = 200; // runs drawn on a surface

export function surfaces(data, shared) {
  const {chosen} = shared;
  const known = own(data.problem.responses)
    .map((f) => ({...f, model: data.models[f.j]}))
    .filter((f) => f.model?.surface);
  const fitted = known.filter(({j}) => !data.flat[j]),
    flat = known.filter(({j}) => data.flat[j]);
  const node = section(
    'surfaces',
    'Response surfaces',
    fitted.length ? 'What the surrogates predict between the simulated points.' : 'There is no surrogate to draw.',
  );
  node.append(
    flat.length
      ? el(
          'p',
          {class: 'note'},
          `Of ${flat.map(({response}) => pretty(response.name)).join(', ')} nothing is drawn: flat within the ` +
            'error of the surrogate.',
        )
      : '',
  );
  if (!fitted.length) return node;
  for (const f of fitted) {
    const mean = predictor(f.model.surface),
      ends = meanInterval(f.model.surface);
    const within = (value) => Math.min(Math.max(value, f.response.lower ?? -Infinity), f.response.upper ?? Infinity);
    f.mean = (x) => within(mean(x));
    f.interval = ends && ((x) => ends(x).map(within));
    f.range = extent(data.training.rows.filter((r) => r.y).map((r) => r.y[f.j]));
  }
  node.append(influence(data, fitted));
  const controls = sliders(data, chosen);
  node.append(controls);
  if (data.problem.variables.length > 1) node.append(maps(data, fitted, shared));
  node.append(profiles(data, fitted, shared));
  const grid = nested(data, fitted, chosen);
  if (grid) node.append(grid);
  return node;
}

function influence(data, fitted) {
  const known = fitted.filter((f) => data.influence[f.j]);
  const order = data.problem.variables.map((_, k) => k).reverse();
  const box = plotBox(
    90 + 34 * Math.max(2, order.length) * Math.max(1, known.length / 2.2),
    'Influence of each variable',
  );
  draw(box, () => ({
    traces: known
      .map((f, i) => ({
        type: 'bar',
        orientation: 'h',
        name: plain(pretty(f.response.name)),
        y: order.map((k) => plain(pretty(data.problem.variables[k].name))),
        x: order.map((k) => data.influence[f.j][k]),
        marker: {color: series[i % series.length]},
        hovertemplate: '%{y}: %{x:.2f}<extra>%{fullData.name}</extra>',
      }))
      .reverse(),
    layout: {
      barmode: 'group',
      bargap: 0.28,
      legend: {orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom', traceorder: 'reversed'},
      margin: {l: 100, r: 16, t: 24, b: 48},
      xaxis: axis('share of the variation in which the variable takes part (total effect)', {rangemode: 'tozero'}),
      yaxis: axis('', {showgrid: false}),
    },
  }));
  return figure(
    box,
    'What drives each response, over the whole box (total Sobol index of the surrogate). A bar near zero means ' +
      'that the variable hardly matters; shares can add up to more than one where variables act together.',
  );
}

function sliders(data, chosen) {
  const rows = data.problem.variables.map((v, k) => {
    const out = el('output', {});
    const whole = v.upper - v.lower,
      most = v.kind ? whole : 200;
    const input = el('input', {
      type: 'range',
      min: 0,
      max: most,
      step: 1,
      'aria-label': pretty(v.name),
      oninput: () => {
        const x = [...chosen.x];
        x[k] = v.lower + (whole * Number(input.value)) / most;
        chosen.move(x);
      },
    });
    return {k, v, most, input, out, node: el('label', {class: 'slider'}, el('span', {}, pretty(v.name)), input, out)};
  });
  const update = () =>
    rows.forEach(({k, v, most, input, out}) => {
      const position = String(Math.round((most * (chosen.x[k] - v.lower)) / (v.upper - v.lower)));
      if (input.value !== position) input.value = position;
      out.textContent = settingWithUnit(chosen.x[k], v);
    });
  chosen.onchange(update);
  update();
  return el(
    'div',
    {class: 'block sliders'},
    el('p', {class: 'note'}, 'Cut through the point'),
    rows.map((r) => r.node),
    el('button', {type: 'button', onclick: () => chosen.reset()}, 'Middle of the box'),
  );
}

function maps(data, fitted, shared) {
  const {variables} = data.problem,
    {chosen, selection} = shared;
  let [a, b] = data.main_pair;
  const named = namedPlaces(data);
  let solid = false,
    near = null;
  const boxes = fitted.map((f) => plotBox(fitted.length === 1 ? 460 : 380, 'Response surface of ' + f.response.name));
  const known = movingLink('runs', () => near.indices);
  const redraw = oncePerFrame(() => {
    near = nearCut(data.problem, data.training.rows, chosen.x, [a, b], dots);
    fitted.forEach((f, i) =>
      map(boxes[i], f, data, [a, b], {
        chosen,
        near,
        opacity: () => dimmedBy(selection, known, near.opacity),
        solid,
        named,
      }),
    );
  });
  selection.onchange(() => {
    if (solid) redraw();
  });
  const names = variables.map(labelled);
  const across = select('Across', names, a, (k) => {
    if (k === b) {
      b = a;
      up.querySelector('select').value = b;
    }
    a = k;
    redraw();
  });
  const up = select('Up', names, b, (k) => {
    if (k === a) {
      a = b;
      across.querySelector('select').value = a;
    }
    b = k;
    redraw();
  });
  chosen.onchange(redraw);
  redraw.now();
  const links = [undefined, known],
    listening = boxes.map((box) => linkPoints(box, links, shared));
  const change = (i) => {
    solid = i === 1;
    boxes.forEach((box) => Plotly.purge(box));
    redraw.now();
    listening.forEach((listen) => listen());
  };
  return figure(
    el(
      'div',
      {},
      el('div', {class: 'controls'}, across, up, choice(['Contours', '3-D'], change)),
      el('div', {class: 'grid'}, boxes),
    ),
    'Predicted response over two variables, the others held at the sliders above. The colours span the ' +
      'simulated range of each response and do not move with the sliders; the cross marks the sliders’ ' +
      'point, names stand at places projected onto the cut. ' +
      'Lines close together mean a steep response. Dots are simulated runs, projected onto the cut: the ' +
      'fainter, the farther they lie from it; a click marks one and moves the cut there. In 3-D the pale ' +
      'sheets below and above hold the mean of many runs with 95 %.' +
      legendOfLimits(data.training.rows),
  );
}

/// The runs are the second trace. opacity(): theirs where a plot does not dim them itself.
function map(box, f, data, [a, b], {chosen, near, opacity, solid, named}) {
  const {variables} = data.problem;
  const count = f.model.surface.weights.length > 200 ? 31 : 41;
  const x = places(variables[a], count),
    y = places(variables[b], count);
  const point = [...chosen.x];
  const z = y.map((vb) =>
    x.map((va) => {
      point[a] = va;
      point[b] = vb;
      return f.mean(point);
    }),
  );
  const revision = `${a} ${b} ${solid}`;
  const title = {text: axisLabel(f.response), font: {size: 14}, x: 0, xanchor: 'left', xref: 'paper'};
  const range = () => ({
    zmin: f.range[0],
    zmax: f.range[1],
    colorscale: scale(),
    colorbar: {thickness: 11, len: 0.95, outlinewidth: 0, tickfont: {size: 11}},
  });
  if (solid) {
    const side = (item) => ({
      title: {text: axisLabel(item)},
      color: colour.ink,
      gridcolor: colour.axis,
      zeroline: false,
    });
    const scene = () => ({
      xaxis: {...side(variables[a]), ...ticks(variables[a])},
      yaxis: {...side(variables[b]), ...ticks(variables[b])},
      zaxis: side(f.response),
      camera: {eye: {x: -1.75, y: -1.85, z: 1.05}, center: {x: 0, y: 0, z: -0.15}},
    });
    const solidRange = () => {
      const {zmin, zmax, ...rest} = range();
      return {cmin: zmin, cmax: zmax, ...rest};
    };
    draw(box, () => ({
      traces: [
        {
          type: 'surface',
          x,
          y,
          z,
          ...solidRange(),
          showscale: false,
          contours: {z: {show: true, usecolormap: false, color: 'rgba(255,255,255,0.5)', width: 1}},
        },
        sampledIn3d(data.problem, f, {rows: near.rows, opacity: opacity()}, [a, b]),
        ...sheets(f, variables, [a, b], chosen),
      ],
      layout: {title, margin: {l: 0, r: 0, t: 36, b: 0}, scene: scene(), uirevision: revision},
    }));
    return;
  }
  const across = ({x: at}) => at[a],
    upward = ({x: at}) => at[b];
  draw(box, (saved) => {
    const {trace, annotations} = namedTrace(named, across, upward, true);
    return {
      traces: [
        {
          type: 'contour',
          x,
          y,
          z,
          ...range(),
          ncontours: 14,
          contours: {coloring: 'heatmap', showlines: true},
          line: {color: 'rgba(255,255,255,0.55)', width: 0.8},
          hovertemplate:
            `${axisLabel(variables[a])}: ${place(variables[a], 'x')}<br>${axisLabel(variables[b])}: ` +
            `${place(variables[b], 'y')}<br>${axisLabel(f.response)}: %{z:.4g}<extra></extra>`,
        },
        {
          x: near.rows.map((r) => r.x[a]),
          y: near.rows.map((r) => r.x[b]),
          mode: 'markers',
          text: near.rows.map((r) => dotText(data.problem, f, r)),
          hovertemplate: '%{text}<extra></extra>',
          marker: {
            size: 6,
            color: '#fff',
            opacity: saved ? opacity() : near.opacity,
            symbol: symbols(near.rows),
            line: {color: '#1c2733', width: 1},
          },
        },
        {
          x: [chosen.x[a]],
          y: [chosen.x[b]],
          mode: 'markers',
          hoverinfo: 'skip',
          marker: {symbol: 'cross-thin', size: 13, line: {color: '#fff', width: 2.5}},
        },
        trace,
      ],
      layout: {
        title,
        annotations,
        showlegend: false,
        margin: {l: 56, r: 8, t: 36, b: 52},
        uirevision: revision,
        xaxis: axis(axisLabel(variables[a]), within(variables[a])),
        yaxis: axis(axisLabel(variables[b]), within(variables[b])),
      },
    };
  });
}

/// The ends of the interval of the mean as surfaces, none where the model does not know them.
function sheets(f, variables, [a, b], chosen) {
  if (!f.interval) return [];
  const x = places(variables[a], 15),
    y = places(variables[b], 15),
    point = [...chosen.x];
  const ends = y.map((vb) =>
    x.map((va) => {
      point[a] = va;
      point[b] = vb;
      return f.interval(point);
    }),
  );
  return [0, 1].map((end) => ({
    type: 'surface',
    x,
    y,
    z: ends.map((row) => row.map((interval) => interval[end])),
    opacity: 0.3,
    showscale: false,
    hoverinfo: 'skip',
    colorscale: [
      [0, colour.guide],
      [1, colour.guide],
    ],
  }));
}

const dotText = (problem, {response, j}, r) =>
  runText(problem, r, `${plain(pretty(response.name))}: ${plain(withUnit(r.y[j], response))}`);

const sampledIn3d = (problem, f, {rows, opacity}, [a, b]) => ({
  type: 'scatter3d',
  mode: 'markers',
  x: rows.map((r) => r.x[a]),
  y: rows.map((r) => r.x[b]),
  z: rows.map((r) => r.y[f.j]),
  text: rows.map((r) => dotText(problem, f, r)),
  hovertemplate: '%{text}<extra></extra>',
  marker: {
    size: 3,
    symbol: rows.map((r) => (breaksLimit(r) ? 'x' : 'circle')),
    color: opacity.map((o) => faded(colour.ink, o)),
  },
});

/// Of an axis: no wider than the variable, wherever the cross is.
const within = (v) => ({...ticks(v), ...(v.kind ? {} : {range: [v.lower, v.upper]})});

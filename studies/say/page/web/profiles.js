// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Each response along each variable alone, through the point of the sliders: the mean, the band that holds
// it, and the runs near the cut.

import {runText} from './designs.js';
import {dimmedBy, linkPoints, movingLink} from './dimming.js';
import {figure} from './dom.js';
import {axisLabel, place, plain, pretty, ticks} from './format.js';
import {oncePerFrame} from './frames.js';
import {legendOfLimits, symbols} from './limits.js';
import {axis, draw, plotBox} from './plot.js';
import {nearCut} from './sampled.js';
import {extent, places} from './steps.js';
import {colour, series, translucent} from './theme.js';

const mostProfiles = 6;
const many = 200; // runs of a model from which on bands have fewer places

export function profiles(data, fitted, shared) {
  const {variables} = data.problem,
    {chosen, selection} = shared;
  const weight = (k) => Math.max(0, ...data.influence.filter(Boolean).map((row) => row[k]));
  const shown = variables
    .map((_, k) => k)
    .sort((p, q) => weight(q) - weight(p))
    .slice(0, mostProfiles)
    .sort((p, q) => p - q);
  const box = plotBox(60 + 190 * fitted.length, 'Profiles along each variable');
  let near = null;
  const known = new Map(shown.map((k) => [k, movingLink('runs', () => near.get(k).indices)]));
  const redraw = oncePerFrame(() => {
    near = new Map(shown.map((k) => [k, nearCut(data.problem, data.training.rows, chosen.x, [k])]));
    draw(box, (saved) =>
      profile(data, fitted, shown, {
        chosen,
        near,
        opacity: (k) => (saved ? dimmedBy(selection, known.get(k), near.get(k).opacity) : near.get(k).opacity),
      }),
    );
  });
  chosen.onchange(redraw);
  redraw.now();
  linkPoints(
    box,
    fitted.flatMap((f) =>
      shown.flatMap((k) => [...(f.interval ? [undefined] : []), known.get(k), undefined, undefined]),
    ),
    shared,
  );
  return figure(
    box,
    caption(
      variables.length,
      fitted.some((f) => f.interval),
    ) + legendOfLimits(data.training.rows),
  );
}

function caption(variables, banded) {
  const band = banded
    ? ' The band holds the mean of many runs with 95 %, as sure as the surrogate is of it; single runs scatter more.'
    : '';
  if (variables === 1) return 'Predicted response (line) and simulated training runs (dots).' + band;
  return (
    'Predicted response along each variable alone, through the same point (large dots: where the sliders ' +
    'stand). All panels of a row share one scale, so a flat line means a weak variable.' +
    band +
    ' Small dots are the simulated runs nearest to the line, projected onto it: the fainter, the farther they ' +
    'lie from the values held in the other variables, so a faint one need not lie on the line; a click marks ' +
    'one and moves the lines there.'
  );
}

function curve(f, v, k, chosen) {
  const through = (value) => {
    const point = [...chosen.x];
    point[k] = value;
    return point;
  };
  const x = places(v, 61),
    xBand = places(v, f.model.surface.X.length > many ? 13 : 31);
  return {
    k,
    v,
    x,
    y: x.map((value) => f.mean(through(value))),
    xBand,
    band: f.interval ? xBand.map((value) => f.interval(through(value))) : [],
  };
}

function profile(data, fitted, shown, {chosen, near, opacity}) {
  const rows = fitted.length,
    columns = shown.length,
    traces = [];
  const layout = {
    showlegend: false,
    grid: {rows, columns, pattern: 'independent', xgap: 0.06, ygap: 0.14},
    margin: {l: 66, r: 12, t: 12, b: 52},
  };
  fitted.forEach((f, r) => {
    const curves = shown.map((k) => curve(f, data.problem.variables[k], k, chosen));
    const [low, high] = extent([...curves.flatMap((c) => [...c.y, ...c.band.flat()]), ...f.range]);
    const pad = 0.05 * (high - low);
    curves.forEach((c, column) => {
      const id = r * columns + column + 1,
        suffix = id === 1 ? '' : id;
      traces.push(
        ...panel(
          data.problem,
          f,
          c,
          {chosen, rows: near.get(c.k).rows, opacity: opacity(c.k)},
          series[r % series.length],
        ).map((trace) => ({...trace, xaxis: 'x' + suffix, yaxis: 'y' + suffix})),
      );
      layout['xaxis' + suffix] = axis(r === rows - 1 ? axisLabel(c.v) : '', {
        showticklabels: r === rows - 1,
        nticks: 6,
        automargin: false,
        ...ticks(c.v),
      });
      layout['yaxis' + suffix] = axis(column === 0 ? axisLabel(f.response) : '', {
        showticklabels: column === 0,
        range: [low - pad, high + pad],
        nticks: 6,
        automargin: false,
      });
    });
  });
  return {traces, layout};
}

/// Traces: the band, where the model knows one, the runs, the curve, the point of the sliders.
function panel(problem, f, {k, v, x, y, xBand, band}, {chosen, rows, opacity}, hue) {
  const around = {
    x: [...xBand, ...[...xBand].reverse()],
    y: [...band.map(([low]) => low), ...[...band].reverse().map(([, high]) => high)],
    mode: 'lines',
    fill: 'toself',
    fillcolor: translucent(hue, 0.2),
    line: {width: 0},
    hoverinfo: 'skip',
  };
  return [
    ...(band.length ? [around] : []),
    {
      x: rows.map((r) => r.x[k]),
      y: rows.map((r) => r.y[f.j]),
      mode: 'markers',
      marker: {size: 5, color: colour.guide, opacity, symbol: symbols(rows)},
      text: rows.map((r) => runText(problem, r)),
      hovertemplate: `%{text}<br>${plain(pretty(f.response.name))}: %{y:.4g}<extra></extra>`,
    },
    {
      x,
      y,
      mode: v.kind ? 'lines+markers' : 'lines',
      marker: {size: 4},
      line: {color: hue, width: 2.5},
      hovertemplate: `${place(v, 'x')}: %{y:.4g}<extra></extra>`,
    },
    {
      x: [chosen.x[k]],
      y: [f.mean(chosen.x)],
      mode: 'markers',
      marker: {size: 8, color: hue, line: {color: colour.paper, width: 1.5}},
      hoverinfo: 'skip',
    },
  ];
}

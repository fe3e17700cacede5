// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Nested contours: a response over four variables at once, as a grid of contour plots. Two outer variables
// take some levels each, and every plot of the grid spans two inner ones. Computed when the figure is opened.

import {el, figure, select} from './dom.js';
import {axisLabel, labelled, plain, pretty, settingWithUnit, ticks} from './format.js';
import {oncePerFrame} from './frames.js';
import {leftOutText, nestedVariables, outerLevels} from './nested_levels.js';
import {axis, draw, fit, plotBox} from './plot.js';
import {places} from './steps.js';
import {scale} from './theme.js';

const count = 21; // places along an inner variable

export function nested(data, fitted, chosen) {
  const {variables} = data.problem,
    shown = nestedVariables(data);
  if (shown.length < 3) return null;
  const held = shown.map((k) => variables[k]),
    rest = variables.filter((_, k) => !shown.includes(k));
  let f = fitted[0],
    ready = false;
  const box = plotBox(shown.length === 4 ? 760 : 330, 'Nested contours');
  const redraw = oncePerFrame(() => {
    if (ready) draw(box, () => grid(data, f, shown, chosen));
  });
  const pick =
    fitted.length > 1
      ? el(
          'div',
          {class: 'controls'},
          select(
            'Response',
            fitted.map(({response}) => labelled(response)),
            0,
            (i) => {
              f = fitted[i];
              redraw();
            },
          ),
        )
      : null;
  const leftOut = held
    .slice(2)
    .map((v) => leftOutText(v, pretty(v.name)))
    .filter(Boolean)
    .map((text) => ' ' + text)
    .join('');
  const across = pretty(held[2].name),
    up = held[3]
      ? ` from left to right, and by that of ${pretty(held[3].name)} from bottom to top`
      : ' from left to right';
  const node = el(
    'details',
    {
      class: 'block',
      ontoggle: () => {
        if (ready || !node.open) return;
        ready = true;
        redraw.now();
        fit(box);
      },
    },
    el('summary', {}, 'Nested contours'),
    figure(
      el('div', {}, pick, box),
      `The predicted response over ${shown.length === 4 ? 'four' : 'three'} variables at once: each small plot ` +
        `spans ${pretty(held[0].name)} and ${pretty(held[1].name)}, and the plots differ by the value of ` +
        `${across}${up}. ` +
        `All plots share one scale of colours, that of all of ` +
        `them${rest.length ? `; ${rest.map((v) => pretty(v.name)).join(', ')} as the sliders say` : ''}.${leftOut}`,
    ),
  );
  if (rest.length) chosen.onchange(redraw);
  return node;
}

function grid(data, f, shown, chosen) {
  const {variables} = data.problem,
    [a, b, c, d] = shown,
    columns = outerLevels(variables[c]),
    rows = d === undefined ? [null] : outerLevels(variables[d]);
  const x = places(variables[a], count),
    y = places(variables[b], count),
    panels = [];
  rows.forEach((down, row) =>
    columns.forEach((along, column) => {
      const point = [...chosen.x];
      point[c] = along;
      if (down !== null) point[d] = down;
      panels.push({
        row,
        column,
        along,
        down,
        z: y.map((vb) =>
          x.map((va) => {
            point[a] = va;
            point[b] = vb;
            return f.mean(point);
          }),
        ),
      });
    }),
  );
  const values = panels.flatMap((p) => p.z.flat()),
    range = {zmin: Math.min(...values), zmax: Math.max(...values)};
  const layout = {showlegend: false, margin: {l: 60, r: 8, t: 34, b: 56}, annotations: []};
  const traces = panels.map((p, i) =>
    cell(p, i, {x, y, range, f, inner: [variables[a], variables[b]], size: [columns.length, rows.length]}, layout),
  );
  const outer = (v, value) => `${plain(pretty(v.name))} = ${plain(settingWithUnit(value, v))}`;
  const label = (text, more) =>
    layout.annotations.push({text, showarrow: false, xref: 'paper', yref: 'paper', font: {size: 12}, ...more});
  columns.forEach((value, i) =>
    label(outer(variables[c], value), {x: (i + 0.5) / columns.length, y: 1.005, xanchor: 'center', yanchor: 'bottom'}),
  );
  if (d !== undefined)
    rows.forEach((value, i) =>
      label(outer(variables[d], value), {
        x: 1.003,
        y: (i + 0.5) / rows.length,
        xanchor: 'left',
        yanchor: 'middle',
        textangle: 90,
      }),
    );
  return {traces, layout};
}

function cell({row, column, z}, i, {x, y, range, f, inner: [v, w], size: [columns, rows]}, layout) {
  const suffix = i === 0 ? '' : i + 1,
    gap = 0.02;
  const span = (k, n) => {
    const size = (1 - gap * (n - 1)) / n,
      low = k * (size + gap);
    return [low, low + size];
  };
  const side = (variable, shown, domain, anchor) =>
    axis(shown ? axisLabel(variable) : '', {
      domain,
      anchor: anchor + suffix,
      showticklabels: shown,
      nticks: 4,
      automargin: false,
      ...ticks(variable),
    });
  layout['xaxis' + suffix] = side(v, row === 0, span(column, columns), 'y');
  layout['yaxis' + suffix] = side(w, column === 0, span(row, rows), 'x');
  return {
    type: 'contour',
    x,
    y,
    z,
    ...range,
    colorscale: scale(),
    ncontours: 12,
    contours: {coloring: 'heatmap', showlines: true},
    line: {color: 'rgba(255,255,255,0.55)', width: 0.7},
    showscale: i === 0,
    colorbar: {
      title: {text: axisLabel(f.response), side: 'right', font: {size: 12}},
      x: 1.03,
      thickness: 11,
      len: 0.95,
      outlinewidth: 0,
      tickfont: {size: 11},
    },
    xaxis: 'x' + suffix,
    yaxis: 'y' + suffix,
    hovertemplate:
      `${axisLabel(v)}: %{x:.3g}<br>${axisLabel(w)}: %{y:.3g}<br>${axisLabel(f.response)}: ` +
      `%{z:.4g}<extra></extra>`,
  };
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A pile from above: its columns by height, curves across it, and the place that is attacked.

import {number, plain} from './format.js';
import {axis, draw, plotBox} from './plot.js';
import {colour, faded, isDark} from './theme.js';

const empty = 0.1; // a column this low shows the floor [m]

/// Floor to crest, from what is near the paper's colour to what is far from it.
const sand = () =>
  isDark()
    ? [
        [0, '#2a2f33'],
        [0.4, '#7a6448'],
        [1, '#f0dfc0'],
      ]
    : [
        [0, '#f4efe6'],
        [0.4, '#c9ab7c'],
        [1, '#5c4326'],
      ];

export function planView(panel) {
  const {x, y, heights, walls, curves, place} = panel;
  const [near, far] = extentOf(panel);
  const box = plotBox(
    Math.round(Math.min(560, Math.max(300, 130 + (900 * (walls[1] - walls[0])) / (far - near)))),
    panel.title,
  );
  const columns = () => ({
    type: 'heatmap',
    x,
    y,
    z: heights.map((row) => row.map((h) => (h > empty ? h : null))),
    colorscale: sand(),
    xgap: 1,
    ygap: 1,
    zmin: 0,
    colorbar: {title: {text: plain(panel.z_label), side: 'right'}, thickness: 12, outlinewidth: 0},
    hovertemplate: '%{x:.2f} m, %{y:.2f} m: %{z:.2f} m high<extra></extra>',
    hoverongaps: false,
  });
  const lines = () =>
    curves.map((curve, k) => ({
      name: plain(curve.name),
      x: curve.x,
      y: curve.y,
      mode: 'lines+markers',
      line: {color: k ? colour.training : colour.failed, width: 2.5, dash: k ? 'dash' : 'solid'},
      marker: {size: 5, symbol: k ? 'diamond' : 'circle'},
      hovertemplate: '%{x:.2f} m, %{y:.2f} m<extra>%{fullData.name}</extra>',
    }));
  const attacked = () => ({
    name: plain(place.name),
    x: [place.x[0], place.x[1], place.x[1], place.x[0], place.x[0]],
    y: [place.y[0], place.y[0], place.y[1], place.y[1], place.y[0]],
    mode: 'lines',
    fill: 'toself',
    fillcolor: 'rgba(217, 162, 27, 0.28)',
    line: {color: isDark() ? '#f2c14a' : '#9a6d00', width: 2.5},
    hoverinfo: 'name',
  });
  const middle = 0.5 * (place.y[0] + place.y[1]);
  draw(box, () => ({
    traces: [columns(), attacked(), ...lines()],
    layout: {
      margin: {l: 60, r: 16, t: 30, b: 52},
      xaxis: axis(plain(panel.x_label), {range: [near, far]}),
      yaxis: axis(plain(panel.y_label), {scaleanchor: 'x', scaleratio: 1, range: [walls[0] - 0.3, walls[1] + 0.3]}),
      shapes: walls.map((at) => ({
        type: 'line',
        x0: near,
        x1: far,
        y0: at,
        y1: at,
        line: {color: faded(colour.ink, 0.7), width: 3},
      })),
      annotations: [
        {
          x: place.x[0],
          y: middle,
          ax: place.x[0] - 1.2,
          ay: middle,
          axref: 'x',
          ayref: 'y',
          arrowhead: 2,
          arrowwidth: 2.5,
          arrowcolor: colour.ink,
          text: `${number(middle)} m`,
          xanchor: 'right',
        },
      ],
    },
  }));
  return box;
}

/// From a little before the pile to its end.
function extentOf({x, heights, place}) {
  const first = x.findIndex((_, i) => heights.some((row) => row[i] > empty));
  const step = x.length > 1 ? x[1] - x[0] : 1;
  return [Math.min(place.x[0], x[Math.max(0, first)]) - 2.5, x[x.length - 1] + step / 2];
}

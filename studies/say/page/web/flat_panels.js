// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Figures that the simulation itself supplies, but for the scene: a path over the pile, lines, a table.

import {number, plain} from './format.js';
import {axis, draw, fit, plotBox} from './plot.js';
import {table} from './table.js';
import {colour, series} from './theme.js';

/// Each gives the element of a panel.
export const flat = {path, lines, table: valueTable};

function path(panel) {
  const {contour, planned, actual, stages = []} = panel;
  const box = plotBox(heightOf([contour, planned, actual]), panel.title);
  const floor = Math.min(0, ...contour.z);
  const traces = () => [
    {
      x: contour.x,
      y: contour.x.map(() => floor),
      mode: 'lines',
      line: {width: 0},
      hoverinfo: 'skip',
      showlegend: false,
    },
    {
      name: 'pile',
      x: contour.x,
      y: contour.z,
      mode: 'lines',
      fill: 'tonexty',
      fillcolor: colour.soil,
      line: {color: colour.soilEdge, width: 1.5},
    },
    {
      name: 'planned',
      x: planned.x,
      y: planned.z,
      mode: 'lines+markers',
      line: {color: colour.ink, width: 2, dash: 'dash'},
      marker: {size: 5},
    },
    {
      name: 'actual',
      x: actual.x,
      y: actual.z,
      mode: 'lines',
      line: {color: stages.length ? colour.guide : colour.accent, width: stages.length ? 1.5 : 3},
    },
    ...stages.map((s, i) => ({
      name: plain(s.name),
      x: s.x,
      y: s.z,
      mode: 'lines',
      line: {color: series[i % series.length], width: 3},
    })),
  ];
  const hover = {hovertemplate: '%{x:.2f}, %{y:.2f}<extra>%{fullData.name}</extra>'};
  draw(box, () => ({
    traces: traces().map((t) => (t.hoverinfo ? t : {...t, ...hover})),
    layout: {
      margin: {l: 60, r: 16, t: 30, b: 52},
      xaxis: axis(plain(panel.x_label ?? 'x [m]')),
      yaxis: axis(plain(panel.z_label ?? 'z [m]'), {scaleanchor: 'x', scaleratio: 1}),
    },
  }));
  return box;
}

/// Height that shows the curves with equal scales on both axes over the full width.
function heightOf(curves) {
  const span = (key) => {
    const values = curves.flatMap((curve) => curve[key]);
    return values.length ? Math.max(...values) - Math.min(...values) : 1;
  };
  return Math.round(Math.min(560, Math.max(280, 90 + (1060 * span('z')) / (span('x') || 1))));
}

function lines(panel) {
  const box = plotBox(340, panel.title);
  draw(box, () => ({
    traces: panel.series.map((s, i) => ({
      name: plain(s.name),
      x: s.x,
      y: s.y,
      mode: 'lines',
      line: {color: series[i % series.length], width: 1.8},
    })),
    layout: {
      hovermode: 'x unified',
      margin: {l: 64, r: 16, t: 30, b: 52},
      showlegend: panel.series.length > 1,
      xaxis: axis(plain(panel.x_label ?? '')),
      yaxis: axis(plain(panel.y_label ?? '')),
    },
  }));
  requestAnimationFrame(() => fit(box)); // a legend's rows depend on the width that the box has in the page
  return box;
}

function valueTable(panel) {
  const text = panel.columns.map((_, c) => panel.rows.some((row) => typeof row[c] === 'string'));
  return table(
    panel.columns.map((title, c) => ({title, format: number, text: text[c]})),
    panel.rows,
    {name: panel.title, tall: panel.rows.length > 16},
  ).node;
}

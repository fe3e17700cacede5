// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// One look for all plots.
/* global Plotly */

import {colour} from './format.js';
import {el} from './dom.js';

export const axis = (title, more = {}) => ({
  title: {text: title, font: {size: 13}, standoff: 8}, gridcolor: colour.grid, linecolor: '#b8c2cb', zeroline: false, ticks: 'outside',
  ticklen: 4, tickcolor: '#b8c2cb', mirror: false, showline: true, automargin: true, ...more,
});

const base = () => ({
  font: {family: 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif', size: 12, color: colour.ink},
  paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)', margin: {l: 56, r: 16, t: 24, b: 48},
  modebar: {bgcolor: 'rgba(255,255,255,0.8)', color: '#9aa7b2', activecolor: colour.ink},
  hoverlabel: {bgcolor: '#fff', bordercolor: '#9aa7b2', font: {color: colour.ink, size: 12}},
  legend: {orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom', font: {size: 12}, traceorder: 'normal'},
});

// Without a pointer that hovers, Plotly would show its buttons all the time, over the titles.
const config = {responsive: true, displayModeBar: matchMedia('(hover: hover)').matches ? 'hover' : false, displaylogo: false, modeBarButtonsToRemove: ['lasso2d', 'select2d', 'autoScale2d', 'sendDataToCloud']};

export function plotBox(height, label) {
  return el('div', {class: 'plot', style: `height:${height}px`, role: 'img', 'aria-label': label});
}

/// Draws, or redraws in place.
export function draw(box, traces, layout) {
  return Plotly.react(box, traces, {...base(), ...layout}, config);
}

/// Paper has another width than the window: print at one width, and give the window its plots back afterwards.
export function fitPlotsToPrint() {
  const resize = (printing) => {
    document.body.classList.toggle('printing', printing);
    document.querySelectorAll('.js-plotly-plot').forEach((box) => Plotly.Plots.resize(box));
  };
  addEventListener('beforeprint', () => resize(true));
  addEventListener('afterprint', () => resize(false));
}

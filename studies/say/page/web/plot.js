// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// One look for all plots. A plot is drawn from a function that builds it, so that it can be drawn again in
// other colours.

import {fileName} from './delimited.js';
import {el} from './dom.js';
import {colour, onPaper, onTheme} from './theme.js';

export const axis = (title, more = {}) => ({
  title: {text: title, font: {size: 13}, standoff: 8},
  gridcolor: colour.grid,
  linecolor: colour.axis,
  zeroline: false,
  ticks: 'outside',
  ticklen: 4,
  tickcolor: colour.axis,
  mirror: false,
  showline: true,
  automargin: true,
  ...more,
});

const base = () => ({
  font: {
    family: 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif',
    size: 12,
    color: colour.ink,
  },
  paper_bgcolor: 'rgba(0,0,0,0)',
  plot_bgcolor: 'rgba(0,0,0,0)',
  margin: {l: 56, r: 16, t: 24, b: 48},
  uirevision: 'kept',
  modebar: {bgcolor: 'rgba(0,0,0,0)', color: colour.guide, activecolor: colour.ink},
  hoverlabel: {bgcolor: colour.paper, bordercolor: colour.guide, font: {color: colour.ink, size: 12}, align: 'left'},
  legend: {orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom', font: {size: 12}, traceorder: 'normal'},
  newselection: {line: {color: colour.ink, width: 1.2, dash: 'dot'}},
  activeselection: {fillcolor: colour.guide, opacity: 0.12},
});

// Without a pointer that hovers, Plotly would show its buttons all the time, over the titles.
const config = {
  responsive: true,
  displayModeBar: matchMedia('(hover: hover)').matches ? 'hover' : false,
  displaylogo: false,
  modeBarButtonsToRemove: ['toImage', 'lasso2d', 'select2d', 'autoScale2d', 'sendDataToCloud'],
  modeBarButtonsToAdd: [{name: 'Save as SVG', title: 'Save as SVG', icon: Plotly.Icons.camera, click: save}],
};

const drawn = new Map();

export function plotBox(height, label) {
  return el('div', {class: 'plot', style: `height:${height}px`, role: 'img', 'aria-label': label});
}

/// Draws, or redraws in place, what build(saved) returns: {traces, layout}. saved: to be saved as a file.
export function draw(box, build) {
  drawn.set(box, build);
  const {traces, layout} = build(false);
  return Plotly.react(box, traces, {...base(), ...layout}, config);
}

export const redraw = (box) => draw(box, drawn.get(box));

/// For what has come into the page after it was drawn: its plots are drawn afresh in the width that they have
/// there.
export function fit(node) {
  for (const box of drawn.keys()) {
    if (!node.contains(box)) continue;
    Plotly.purge(box);
    redraw(box);
  }
}

/// For what is taken out of the page: its plots are drawn no more.
export function forget(node) {
  for (const box of drawn.keys()) {
    if (!node.contains(box)) continue;
    drawn.delete(box);
    Plotly.purge(box);
  }
}

/// The plot as it is seen, in the colours for paper.
function save(box) {
  const {data, layout} = onPaper(() => {
    const {traces, layout: own} = drawn.get(box)(true);
    return {data: traces, layout: {...base(), ...own, paper_bgcolor: colour.paper}};
  });
  for (const [key, seen] of Object.entries(box.layout)) {
    if (/^[xy]axis/.test(key) && seen.range)
      Object.assign((layout[key] ??= {}), {range: [...seen.range], autorange: false});
    if (/^scene/.test(key) && seen.camera) layout[key] = {...layout[key], camera: seen.camera};
  }
  return Plotly.downloadImage(
    {data, layout},
    {
      format: 'svg',
      filename: fileName(document.title, box.getAttribute('aria-label')),
      width: box.clientWidth,
      height: box.clientHeight,
    },
  );
}

let turn = 0;

/// One plot per task, those on screen first, so that the page answers meanwhile; for paper all at once, in
/// its width.
function redrawAll(now) {
  const mine = ++turn;
  const again = (box) => {
    redraw(box);
    if (now) Plotly.Plots.resize(box);
  };
  const distance = (box) => Math.abs(box.getBoundingClientRect().top - 0.5 * innerHeight);
  const waiting = [...drawn.keys()].sort((a, b) => distance(a) - distance(b));
  const next = () => {
    if (mine !== turn || !waiting.length) return;
    again(waiting.shift());
    setTimeout(next);
  };
  if (now) waiting.forEach(again);
  else next();
}

onTheme(redrawAll);

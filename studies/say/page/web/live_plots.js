// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The live page's plots: best so far of each objective, and the runs along two axes.

import {inputsText} from './designs.js';
import {el, select} from './dom.js';
import {axisLabel, labelled, plain, pretty, ticks} from './format.js';
import {axesOf, curve, firstAxes} from './live_state.js';
import {axis, draw, plotBox} from './plot.js';
import {colour} from './theme.js';

const kinds = ['training', 'adaptive', 'confirmation', 'imported', 'validation'];

/// {node, update(state)}
export function bestPlots({responses}) {
  const shown = responses
    .map((response, j) => ({response, j}))
    .filter(({response}) => /^(min|max)imize$/.test(response.goal));
  const boxes = shown.map(({response}) => plotBox(260, `Best so far of ${pretty(response.name)}`));
  const update = (state) =>
    shown.forEach(({response, j}, i) => {
      const {x, y, runs} = curve(state.responses[j].improvements, state.ended);
      draw(boxes[i], () => ({
        traces: [
          {
            x,
            y,
            text: runs.map((run) => 'run ' + run),
            mode: 'lines+markers',
            line: {shape: 'hv', color: colour.accent, width: 2},
            marker: {
              color: colour.accent,
              size: x.map((_, k) => (k === state.responses[j].improvements.length ? 0.1 : 6)),
            },
            hovertemplate: '%{y:.4g}<br>%{text}, after %{x} runs<extra></extra>',
          },
        ],
        layout: {
          showlegend: false,
          margin: {l: 60, r: 16, t: 12, b: 46},
          xaxis: axis('runs ended', {
            range: [0, Math.max(1, state.ended) * 1.03],
            tickformat: 'd',
            ...(state.ended < 8 ? {dtick: 1} : {nticks: 6}),
          }),
          yaxis: axis(axisLabel(response), {nticks: 5}),
        },
      }));
    });
  return {node: el('div', {class: 'grid'}, boxes), update};
}

/// {node, update(rows, last run)}
export function runsPlot(problem) {
  const axes = axesOf(problem),
    names = axes.map(({item}) => labelled(item)),
    box = plotBox(440, 'The runs');
  let [across, up] = firstAxes(problem),
    rows = [],
    lastRun = null;
  const redrawn = () =>
    draw(box, () => ({
      traces: traces(),
      layout: {
        margin: {l: 66, r: 16, t: 30, b: 52},
        xaxis: axis(axisLabel(axes[across].item), ticks(axes[across].item)),
        yaxis: axis(axisLabel(axes[up].item), ticks(axes[up].item)),
      },
    }));
  const trace = (name, shown, look) => ({
    name,
    x: shown.map(axes[across].of),
    y: shown.map(axes[up].of),
    text: shown.map((row) => hover(problem, row)),
    mode: 'markers',
    marker: look,
    hovertemplate: '%{text}<extra></extra>',
  });
  /** @type {(kind: string, of: any[][]) => object} */
  const ofKind = (kind, of) => trace(kind, of, {size: 7, color: colour[kind] ?? colour.guide, opacity: 0.75});
  const traces = () => {
    const all = kinds
      .map((kind) => [kind, rows.filter((row) => row[1] === kind && row[3])])
      .filter(([, of]) => of.length)
      .map(([kind, of]) => ofKind(String(kind), /** @type {any[][]} */ (of)));
    const failed = rows.filter((row) => !row[3]),
      newest = rows.filter((row) => row[0] === lastRun);
    if (failed.length)
      all.push(trace('failed', failed, {size: 8, symbol: 'x-thin', line: {color: colour.failed, width: 2}}));
    if (newest.length)
      all.push(
        trace('last', newest, {
          size: 14,
          symbol: 'circle-open',
          line: {color: colour.accent, width: 2.5},
          color: colour.accent,
        }),
      );
    return all;
  };
  const controls = el(
    'div',
    {class: 'controls'},
    select('Across', names, across, (i) => {
      across = i;
      redrawn();
    }),
    select('Up', names, up, (i) => {
      up = i;
      redrawn();
    }),
  );
  const update = (next, last) => {
    rows = next;
    lastRun = last;
    redrawn();
  };
  return {node: el('div', {}, controls, box), update};
}

const hover = (problem, [run, kind, x, y]) =>
  [
    `<b>run ${run}, ${kind}${y ? '' : ', failed'}</b>`,
    inputsText(problem, x),
    ...(y ? problem.responses.map((r, j) => `${plain(pretty(r.name))} ${y[j]?.toPrecision(4)}`) : []),
  ].join('<br>');

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Other hauls than that of the runs: a slider, what each strategy gives then, and where their order turns.

import {el, figure, section} from './dom.js';
import {axisLabel, number, percent, plain, pretty, withUnit} from './format.js';
import {oncePerFrame} from './frames.js';
import {ranked, rateOfRun, turnTexts} from './haul_rates.js';
import {axis, draw, plotBox} from './plot.js';
import {colour} from './theme.js';

export function hauls(data) {
  const choice = data.hauls;
  if (!choice) return null;
  const response = data.problem.responses[choice.response];
  const state = {haul: choice.haul},
    name = pretty(response.name);
  const box = plotBox(60 + 34 * choice.strategies.length, `${name} by haul`);
  const said = el('p', {class: 'sentence'});
  const out = el('output', {});
  const slider = el('input', {
    type: 'range',
    min: 0,
    max: choice.longest,
    step: 1,
    value: choice.haul,
    'aria-label': 'haul',
    oninput: () => {
      state.haul = Number(slider.value);
      update();
    },
  });
  const update = oncePerFrame(() => {
    out.textContent = `${state.haul} s`;
    said.textContent = orderText(choice, response, state.haul);
    draw(box, () => bars(choice, response, state.haul));
  });
  update.now();
  return section(
    'haul',
    'Another haul',
    `${name[0].toUpperCase()}${name.slice(1)} is load over the time of a cycle and its haul, so that it can be ` +
      'said of any haul without new runs. The runs count ' +
      `${number(choice.haul)} s.`,
    figure(
      el(
        'div',
        {},
        el(
          'div',
          {class: 'sliders'},
          el('label', {class: 'slider'}, el('span', {}, 'Haul, dump and way back'), slider, out),
        ),
        said,
        box,
      ),
      'Bars: models of load and time of a cycle, fitted to the cycles of the runs' +
        (choice.error === null
          ? ''
          : `; they miss single validation runs by ${percent(choice.error)} of their mean, noise included`) +
        '. Circles: runs made there, cycle by cycle, exact. A ratio of means for the mean of ratios adds ' +
        `${percent(choice.deviation)} at most.`,
    ),
    el(
      'ul',
      {},
      turnTexts(choice).map((text) => el('li', {}, text)),
    ),
  );
}

function orderText({strategies}, response, haul) {
  const [best, second] = ranked(strategies, haul);
  const words = `With a haul of ${haul} s “${best.strategy.name}” gives most, ${withUnit(best.rate, response)}`;
  return second ? `${words}; then “${second.strategy.name}”, ${withUnit(second.rate, response)}.` : `${words}.`;
}

function bars(choice, response, haul) {
  const order = ranked(choice.strategies, haul).reverse();
  const name = ({strategy}) => plain(strategy.name);
  const runs = order.flatMap((entry) => entry.strategy.runs.map((run) => ({entry, run, rate: rateOfRun(run, haul)})));
  return {
    traces: [
      {
        type: 'bar',
        orientation: 'h',
        x: order.map(({rate}) => rate),
        y: order.map(name),
        text: order.map(({rate}) => number(rate)),
        textposition: 'auto',
        marker: {color: order.map(({strategy}) => (strategy.name === 'recommended' ? colour.accent : colour.training))},
        hoverinfo: 'skip',
      },
      {
        mode: 'markers',
        x: runs.map(({rate}) => rate),
        y: runs.map(({entry}) => name(entry)),
        text: runs.map(({run}) => `run ${run.run}`),
        hovertemplate: '%{text}: %{x:.4g}<extra></extra>',
        marker: {symbol: 'circle-open', size: 10, color: colour.ink, line: {width: 2}},
      },
    ],
    layout: {
      showlegend: false,
      bargap: 0.3,
      margin: {l: 140, r: 16, t: 8, b: 44},
      xaxis: axis(axisLabel(response), {rangemode: 'tozero'}),
      yaxis: axis('', {showgrid: false}),
    },
  };
}

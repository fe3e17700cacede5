// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How good the surrogates are: a table, and predicted against simulated values.

import {inputsText} from './designs.js';
import {link, linkPoints, opacities, ring, ringMarked} from './dimming.js';
import {el, figure, section} from './dom.js';
import {labelled, number, percent, plain, pretty} from './format.js';
import {legendOfLimits, symbols} from './limits.js';
import {axis, draw, plotBox} from './plot.js';
import {own} from './responses.js';
import {table} from './table.js';
import {colour} from './theme.js';

export function validation(data, shared) {
  const {variables, responses} = data.problem;
  const columns = [
    {title: 'Response', text: true},
    withInterval('Error of the mean, of the range', percent),
    withInterval('Error of the mean', number),
    {title: 'Noise of a run', format: number},
    {title: 'RMSE', format: number},
    {title: 'NRMSE', format: percent},
    {title: 'Range', format: number},
    {title: 'Points', format: String},
    {title: 'Scale', text: true},
    ...variables.map((v) => ({title: 'ϑ ' + pretty(v.name), format: number})),
    {title: 'Nugget', format: number},
    {title: 'Process σ', format: number},
  ];
  const rows = own(responses).map(({response: r, j}) =>
    row(labelled(r), data.models[j], data.validations[j], variables.length),
  );
  const node = section(
    'surrogates',
    'How good the surrogates are',
    data.models.length
      ? 'A regression Kriging model stands in for the simulation. It was fitted to the training runs and ' +
          'checked on validation runs that it has never seen.'
      : 'No surrogate could be fitted.',
  );
  if (!data.models.length) return node;
  node.append(
    el(
      'div',
      {class: 'block'},
      table(columns, rows, {name: 'Surrogates', sortable: false}).node,
      el(
        'p',
        {class: 'note'},
        'Error of the mean: by how much the model misses the mean of many runs, in brackets with 95 %; over the ' +
          'range of the simulated values, and in the unit of the response. ' +
          'RMSE: root mean square error on the validation runs, in which the noise of a run is, as the runs ' +
          'report it or else the model has it. NRMSE: RMSE over the range. ' +
          'Scale: what was fitted, the response itself or its square root, logarithm or logit, chosen by ' +
          'leave-one-out; ' +
          'ϑ, nugget and process σ are of that scale. ϑ: how fast the response changes along an input scaled to ' +
          '[-1, 1]; larger is livelier. Nugget: share of run-to-run noise, relative to the process variance.',
      ),
    ),
  );
  const known = own(responses)
    .map(({j}) => j)
    .filter((j) => data.validations[j]?.observed.length);
  if (known.length)
    node.append(
      figure(
        el(
          'div',
          {class: 'grid'},
          known.map((j) => parity(data, j, shared)),
        ),
        'Predicted against simulated value of each validation run. A perfect surrogate puts every point on the ' +
          'dashed line; the bars are its own 95 % intervals, and about 19 of 20 should reach the line.' +
          legendOfLimits(data.validation.rows),
      ),
    );
  return node;
}

function row(name, model, check, inputs) {
  const fit = model
    ? [pretty(model.scale), ...model.theta, model.nugget, Math.sqrt(model.process_variance)]
    : ['', ...Array(inputs + 2).fill(null)];
  return [
    name,
    ...(check
      ? [
          check.mean_nrmse,
          check.rmse_without_noise,
          check.noise,
          check.rmse,
          check.nrmse,
          check.range,
          check.observed.length,
        ]
      : [...Array(6).fill(null), 0]),
    ...fit,
  ];
}

/// A column of [value, lower end, upper end].
const withInterval = (title, format) => ({
  title,
  text: true,
  missing: '',
  format: ([value, lower, upper]) => `${format(value)} (${format(lower)} to ${format(upper)})`,
  parts: [title, 'its lower end', 'its upper end'].map((name, k) => ({title: name, of: (ends) => ends?.[k]})),
});

/// Index of each validation run that ended, in the order of the checks.
const checkedRuns = ({runs}) => runs.map((_, i) => i).filter((i) => runs[i].kind === 'validation' && runs[i].y);

function parity(data, j, shared) {
  const {designs, chosen, selection} = shared,
    response = data.problem.responses[j];
  const {
    observed,
    predicted,
    lower,
    upper,
    mean_nrmse: [error],
  } = data.validations[j];
  const indices = checkedRuns(designs),
    known = link('runs', indices);
  const box = plotBox(340, 'Predicted against simulated ' + response.name);
  const low = Math.min(...observed, ...predicted, ...lower),
    high = Math.max(...observed, ...predicted, ...upper);
  const pad = 0.04 * (high - low || Math.abs(high) || 1);
  const range = [low - pad, high + pad];
  const rings = () => {
    const i = indices.indexOf(chosen.marked('runs'));
    return i < 0 ? [] : [ring(observed[i], predicted[i])];
  };
  draw(box, (saved) => ({
    traces: [
      {x: range, y: range, mode: 'lines', line: {color: colour.guide, dash: 'dash', width: 1.5}, hoverinfo: 'skip'},
      {
        x: observed,
        y: predicted,
        mode: 'markers',
        marker: {
          color: colour.validation,
          size: 8,
          symbol: symbols(indices.map((i) => designs.runs[i])),
          line: {color: colour.paper, width: 1},
          opacity: opacities(selection, known, observed.length, saved),
        },
        error_y: {
          type: 'data',
          symmetric: false,
          array: upper.map((u, i) => u - predicted[i]),
          arrayminus: predicted.map((p, i) => p - lower[i]),
          color: 'rgba(217,130,43,0.45)',
          thickness: 1.5,
          width: 3,
        },
        text: indices.map((i) => `<b>run ${designs.runs[i].run}</b><br>${inputsText(data.problem, designs.runs[i].x)}`),
        hovertemplate: '%{text}<br>simulated %{x:.4g}<br>predicted %{y:.4g}<extra></extra>',
      },
    ],
    layout: {
      showlegend: false,
      margin: {l: 60, r: 16, t: 36, b: 52},
      shapes: rings(),
      title: {
        text:
          plain(labelled(response)) +
          (error === null
            ? ''
            : `  <span style="color:${colour.muted};font-weight:400">error of the mean ${percent(error)}</span>`),
        font: {size: 14},
        x: 0,
        xanchor: 'left',
        xref: 'paper',
      },
      xaxis: axis('simulated', {range: [...range]}),
      yaxis: axis('predicted', {range: [...range]}),
    },
  }));
  linkPoints(box, [undefined, known], shared);
  ringMarked(box, chosen, rings);
  return box;
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Every design of the study with its values: the runs, and the points of the front. Other modules name one of
// them by its set, 'runs' or 'front', and its index there.

import {labelled, plain, pretty, settingWithUnit, withUnit} from './format.js';
import {predictor} from './kriging.js';
import {brokenText} from './limits.js';
import {own} from './responses.js';

/// {runs, front, axes}. A run is as in the data, with its kind; a point of the front is {x, y}, y being null
/// where nothing is known. An axis is a variable or a response: {item, title, isVariable, low, high, values:
/// {runs, front}}; a missing value is NaN; an axis that has no others is empty.
export function collect(data) {
  const runs = [
    ...data.training.rows.map((r) => ({...r, kind: r.kind || 'training'})),
    ...data.validation.rows.map((r) => ({...r, kind: 'validation'})),
  ];
  const front = predicted(data);
  const {variables, responses} = data.problem;
  const values = (key, k) => ({runs: column(runs, key, k), front: column(front, key, k)});
  const axes = [
    ...variables.map((item, k) => ({
      item,
      isVariable: true,
      low: item.lower,
      high: item.upper,
      values: values('x', k),
    })),
    ...own(responses).map(({response: item, j}) => bounded({item, isVariable: false, values: values('y', j)})),
  ];
  return {runs, front, axes: axes.map((axis) => ({...axis, title: labelled(axis.item)}))};
}

const column = (rows, key, k) => Float64Array.from(rows, (row) => row[key]?.[k] ?? NaN);

/// The front's objectives are in the data; its other responses are what the models of this page say.
function predicted({front, models, problem}) {
  const others = problem.responses.map((response, j) => {
    const k = front.objectives.indexOf(j);
    if (k >= 0) return (i) => front.Y[i][k];
    const surface = models[j]?.surface;
    if (!surface) return () => null;
    const mean = predictor(surface),
      {lower, upper} = response;
    return (i) => Math.min(Math.max(mean(front.X[i]), lower ?? -Infinity), upper ?? Infinity);
  });
  return front.X.map((x, i) => ({x, y: others.map((value) => value(i))}));
}

function bounded(axis) {
  let low = Infinity,
    high = -Infinity;
  for (const set of Object.values(axis.values))
    for (const value of set) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  const empty = !(low <= high);
  if (empty) [low, high] = [0, 1];
  const pad = high > low ? 0 : 0.5 * (Math.abs(high) || 1);
  return {...axis, empty, low: low - pad, high: high + pad};
}

export const nameOf = ({runs}, set, i) =>
  set === 'front' ? `point ${i + 1} of the front` : `${runs[i].kind} run ${runs[i].run}`;

/// All variables of a design with their units, one per line, for a hover text.
export const inputsText = ({variables}, x) =>
  variables.map((v, k) => `${plain(pretty(v.name))} = ${plain(settingWithUnit(x[k], v))}`).join('<br>');

/// A run for a hover text: its number, its variables, lines of the plot's own, and a limit that it breaks.
export const runText = (problem, r, ...more) =>
  [`<b>run ${r.run}${r.y ? '' : ', failed'}</b>`, inputsText(problem, r.x), ...more, plain(brokenText(problem, r))]
    .filter(Boolean)
    .join('<br>');

/// Name, responses and variables of a design in one sentence.
export function sentence(data, designs, set, i) {
  const {x, y, reason} = designs[set][i];
  const outputs = own(data.problem.responses)
    .map(({response: r, j}) => (y?.[j] == null ? '' : `${pretty(r.name)} ${withUnit(y[j], r)}`))
    .filter(Boolean);
  const said = y ? outputs.join(', ') : `failed (${reason})`;
  const name = nameOf(designs, set, i),
    broken = brokenText(data.problem, designs[set][i]);
  return (
    `${name[0].toUpperCase() + name.slice(1)}: ${said} at ` +
    data.problem.variables.map((v, k) => `${pretty(v.name)} = ${settingWithUnit(x[k], v)}`).join(', ') +
    `${broken ? `; it ${broken}` : ''}.`
  );
}

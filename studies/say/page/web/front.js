// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The trade-offs: projections of the front on pairs of objectives, what was confirmed of it, and its points
// as a table.

import {el, section} from './dom.js';
import {labelled, number, pretty} from './format.js';
import {frontTable, intervalColumn} from './front_table.js';
import {projections} from './projections.js';
import {inputColumn, tableOfRuns} from './tables.js';

export function tradeOffs(data, shared) {
  const objectives = data.front.objectives.map((j) => data.problem.responses[j]);
  const node = section('front', objectives.length > 1 ? 'Trade-offs' : 'Best point', lead(data, objectives));
  if (!data.front.X.length) return node;
  if (objectives.length > 1) node.append(projections(data, objectives, shared));
  if (data.confirmations.rows.length) node.append(confirmed(data, shared));
  node.append(frontTable(data, objectives, shared));
  return node;
}

/// Predicted and simulated, side by side.
function confirmed(data, shared) {
  const judged = data.problem.responses
    .map((response, j) => ({response, j}))
    .filter(({response}) => response.goal !== 'record');
  const columns = [
    {title: 'Run', format: String},
    {title: 'Round', format: String},
    ...data.problem.variables.map(inputColumn),
    ...judged.flatMap(({response}) => [
      intervalColumn(`${labelled(response)} predicted`, labelled(response)),
      simulatedColumn(response),
    ]),
    {title: 'Note', text: true},
  ];
  const cell = (r, j) => [[r.lower[j], r.upper[j]], r.y === null ? null : [r.y[j], r.within[j]]];
  const note = (r) =>
    [
      r.named ? 'named by the user' : '',
      r.y === null ? r.reason : '',
      r.breaks_limit ? 'breaks a limit' : '',
      r.dominated ? 'dominated' : '',
    ]
      .filter(Boolean)
      .join(', ');
  const rows = data.confirmations.rows.map((r) => [
    r.run,
    r.round,
    ...r.x,
    ...judged.flatMap(({j}) => cell(r, j)),
    note(r),
  ]);
  const indices = data.confirmations.rows.map((c) => shared.designs.runs.findIndex((r) => r.run === c.run));
  return el(
    'div',
    {class: 'block'},
    el('h3', {}, 'Confirmed by simulation'),
    el(
      'p',
      {class: 'note'},
      `Each run was predicted by the models of the runs before it; the interval given should hold 95 of 100 ` +
        `such runs. ${data.confirmations.text}.`,
    ),
    tableOfRuns(columns, rows, indices, 'Confirmed by simulation', shared),
  );
}

const simulatedColumn = (response) => ({
  title: 'simulated',
  text: true,
  missing: 'failed',
  format: ([y, within]) => number(y) + (within ? '' : ' outside'),
  parts: [
    {title: `${labelled(response)} simulated`, of: (value) => value?.[0]},
    {title: `${labelled(response)} within`, of: (value) => value?.[1]},
  ],
});

function lead(data, objectives) {
  if (!objectives.length && data.no_front) return `There is no front: ${data.no_front}.`;
  if (!objectives.length)
    return 'The study names no response to minimize or maximize, so there is nothing to search for.';
  if (!data.front.X.length)
    return `There is no front: ${data.no_front || 'the surrogates could not be fitted or searched'}.`;
  const leftOut = data.problem.responses
    .flatMap((r, j) =>
      data.flat[j] && /^(min|max)imize$/.test(r.goal)
        ? [` Left out is ${pretty(r.name)}, whose surrogate is flat within its own error.`]
        : [],
    )
    .join('');
  if (objectives.length === 1)
    return `The surrogate was searched for the best ${pretty(objectives[0].name)}.${leftOut}`;
  return (
    `${data.front.X.length} points that the surrogates cannot improve in one objective without losing in ` +
    `another (the Pareto front). All are ` +
    'predictions' +
    (data.confirmations.rows.length
      ? '; below stand those that were simulated.'
      : `: simulate a point before relying on it (command ${data.confirming}).`) +
    leftOut
  );
}

/// Which points meet the conditions of an optimum, and what it took. Of the surrogates, so no promise for the
/// simulation.
export function certificate({residual, certified, tolerance, gain, skipped}) {
  if (skipped) return `The search was not finished with gradients: ${skipped}.`;
  if (!residual.length) return '';
  const added = gain === null ? '' : ` Finishing the search with gradients added ${number(gain, 2)} % of hypervolume.`;
  return (
    `${certified} of ${residual.length} are certified: they meet the first-order conditions of an optimum ` +
    `of the surrogates (KKT residual at most ${tolerance.toExponential(0)}).${added}`
  );
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The points of the front as a table.

import {sentence} from './designs.js';
import {el} from './dom.js';
import {labelled, number, percent} from './format.js';
import {table} from './table.js';
import {inputColumn, linkTable} from './tables.js';

/// On one line.
export const interval95 = ([low, high]) => `${number(low, 3)}\u00a0to\u00a0${number(high, 3)}`;

export const intervalColumn = (title, of) => ({
  title,
  text: true,
  format: interval95,
  parts: [
    {title: `${of} 95 % from`, of: ([low]) => low},
    {title: `${of} 95 % to`, of: ([, high]) => high},
  ],
});

const many = 12; // columns, of which a table is as wide as a page

const meaning =
  'Non-dominated: how likely the mean of many runs at the point keeps every limit while no other point of the ' +
  'front is at least as good in all objectives and better in one, as sure as the surrogates are of these ' +
  'means; the noise of single runs is left out.';

export function frontTable(data, objectives, shared) {
  const {chosen, designs, selection} = shared,
    {lower, upper, non_dominated: sure, success, X, Y} = data.front;
  const values = objectives.flatMap((item) => [
    {title: labelled(item), format: number},
    ...(lower.length ? [intervalColumn('95 % of runs', labelled(item))] : []),
  ]);
  const onFront = sure.length ? [{title: 'non-dominated', format: percent}] : [];
  const chance = success.length ? [{title: 'a run succeeds', format: percent}] : [];
  const columns = [
    {title: 'Point', format: String},
    ...data.problem.variables.map(inputColumn),
    ...values,
    ...onFront,
    ...chance,
  ];
  const interval = (i, k) => (lower.length ? [[lower[i][k], upper[i][k]]] : []);
  const rows = X.map((x, i) => [
    i + 1,
    ...x,
    ...Y[i].flatMap((y, k) => [y, ...interval(i, k)]),
    ...sure.slice(i, i + 1),
    ...success.slice(i, i + 1),
  ]);
  const title = objectives.length > 1 ? 'Points of the front' : 'Points found';
  const made = linkTable(
    'front',
    table(columns, rows, {
      name: title,
      onpick: (i) => chosen.toggle('front', i),
      passes: (i) => selection.has('front', i),
      tall: true,
    }),
    shared,
  );
  const detail = el('p', {class: 'note'});
  const update = () => {
    const i = chosen.marked('front');
    const likely = i >= 0 && sure.length ? ` It is non-dominated with a chance of ${percent(sure[i])}.` : '';
    const chance =
      i >= 0 && success.length
        ? ` A run there succeeds with a chance of ${percent(success[i])}, as the runs that failed say.`
        : '';
    detail.textContent =
      i < 0
        ? 'Click a head to sort, a row to mark the point in the plots and to cut the response surfaces through it.'
        : sentence(data, designs, 'front', i) + likely + chance;
  };
  chosen.onchange(update);
  update();
  return el(
    'div',
    {class: columns.length > many ? 'block dense denser' : 'block dense'},
    el('h3', {}, title),
    detail,
    made.node,
    sure.length ? el('p', {class: 'note'}, meaning) : null,
  );
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The runs behind everything: the scatter matrix of the design, the failures, and every run as a table.

import {comparing} from './compare.js';
import {el, section} from './dom.js';
import {labelled, number} from './format.js';
import {anyBreaks, brokenText} from './limits.js';
import {scatterMatrix} from './scatter_matrix.js';
import {table} from './table.js';
import {inputColumn, linkTable, tableOfRuns} from './tables.js';

export function runs(data, shared) {
  const node = section(
    'runs',
    'The runs',
    'Each point is one simulation. The training runs are spread evenly over the whole box; adaptive runs were ' +
      'added where the runs before them showed most to learn, confirmation runs on predicted fronts; all of ' +
      'these make the models. The validation runs are drawn at random and were kept from the fit.',
  );
  node.append(scatterMatrix(data, shared));
  const {runs: all} = shared.designs,
    failed = all.map((_, i) => i).filter((i) => all[i].y === null);
  if (failed.length)
    node.append(
      el(
        'div',
        {class: 'block'},
        el('h3', {}, `${failed.length} failed ${failed.length === 1 ? 'run' : 'runs'}`),
        failures(data, failed, shared),
      ),
    );
  const compared = comparing(data, shared.designs);
  node.append(
    el(
      'details',
      {class: 'block'},
      el('summary', {}, 'All runs as a table'),
      compared.node,
      runTable(data, compared, shared),
    ),
  );
  return node;
}

function failures(data, failed, shared) {
  const columns = [
    {title: 'Run', format: String},
    {title: 'Kind', text: true},
    ...data.problem.variables.map(inputColumn),
    {title: 'Reason', text: true},
  ];
  const rows = failed.map((i) => shared.designs.runs[i]).map((r) => [r.run, r.kind, ...r.x, r.reason]);
  return tableOfRuns(columns, rows, failed, 'Failed runs', shared);
}

function runTable(data, compared, shared) {
  const {designs, chosen, selection} = shared;
  const outputs = data.problem.responses.map((r) => ({title: labelled(r), format: number, missing: 'failed'}));
  const anyFailed = designs.runs.some((r) => !r.y),
    limited = anyBreaks(designs.runs);
  const columns = [
    {title: 'Compare', control: compared.box},
    {title: 'Run', format: String},
    {title: 'Kind', text: true},
    ...data.problem.variables.map(inputColumn),
    ...outputs,
    ...(limited ? [{title: 'Limits', text: true}] : []),
    {title: 'Time [s]', format: number},
    ...(anyFailed ? [{title: 'Reason', text: true}] : []),
  ];
  const rows = designs.runs.map((r) => [
    null,
    r.run,
    r.kind,
    ...r.x,
    ...(r.y ?? data.problem.responses.map(() => null)),
    ...(limited ? [brokenText(data.problem, r)] : []),
    r.seconds,
    ...(anyFailed ? [r.reason] : []),
  ]);
  return linkTable(
    'runs',
    table(columns, rows, {
      name: 'Runs',
      onpick: (i) => chosen.toggle('runs', i),
      passes: (i) => selection.has('runs', i),
      tall: true,
    }),
    shared,
  ).node;
}

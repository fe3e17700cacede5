// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// One run: its point and what came out of it.

import {el, section} from './dom.js';
import {labelled, number, setting} from './format.js';
import {table} from './table.js';

export function oneRun(data) {
  const {run, kind, x, y, reason, cautions} = data.replay;
  const {variables, responses} = data.problem;
  const inputs = table(
    [
      {title: 'Variable', text: true},
      {title: 'Value', text: true},
    ],
    variables.map((v, k) => [labelled(v), setting(x[k], v)]),
    {sortable: false},
  );
  const outputs = table(
    [
      {title: 'Response', text: true},
      {title: 'Value', text: true},
    ],
    responses.map((r, j) => [labelled(r), y === null ? 'none' : number(y[j], 4)]),
    {sortable: false},
  );
  return section(
    'run',
    'Run ' + run,
    `A ${kind} run of this study.`,
    y === null ? el('p', {class: 'caution'}, 'This run failed: ' + reason) : null,
    el('div', {class: 'columns'}, inputs.node, outputs.node),
    cautions.length
      ? el(
          'ul',
          {class: 'cautions'},
          cautions.map((text) => el('li', {}, text)),
        )
      : null,
  );
}

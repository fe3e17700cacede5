// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// One run: its point and what came out of it.

import {el, section} from './dom.js';
import {runTables} from './run_tables.js';

export function oneRun(data) {
  const {run, kind, x, y, reason, cautions} = data.replay;
  const [inputs, outputs] = runTables({x, y}, data.problem);
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

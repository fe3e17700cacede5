// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The point of one run and what came out of it, as two tables.

import {labelled, number, setting} from './format.js';
import {table} from './table.js';

/// x: a value per variable; y: one per response, or null for a run that failed.
export function runTables({x, y}, {variables, responses}) {
  const columns = (name) => [
    {title: name, text: true},
    {title: 'Value', text: true},
  ];
  const inputs = variables.map((v, k) => [labelled(v), setting(x[k], v)]);
  const outputs = responses.map((r, j) => [labelled(r), y === null ? 'none' : number(y[j], 4)]);
  return [
    table(columns('Variable'), inputs, {sortable: false}),
    table(columns('Response'), outputs, {sortable: false}),
  ];
}

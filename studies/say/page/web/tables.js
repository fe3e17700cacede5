// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Columns that several tables share, and the way to a design's row in the table that lists it.

import {labelled, setting} from './format.js';
import {whenResting} from './frames.js';
import {table} from './table.js';

const many = 2000; // rows from which on a table waits until the selection rests

/// Of a variable: whole numbers and levels as such, in a copy too.
export const inputColumn = (v) => ({
  title: labelled(v),
  format: (value) => setting(value, v),
  parts: v.kind ? [{title: labelled(v), of: (value) => v.levels?.[Math.round(value)] ?? Math.round(value)}] : undefined,
});

/// A table of some runs: row k is run indices[k].
export function tableOfRuns(columns, rows, indices, name, {chosen, selection}) {
  const made = table(columns, rows, {
    name,
    tall: true,
    onpick: (k) => chosen.toggle('runs', indices[k]),
    passes: (k) => selection.has('runs', indices[k]),
  });
  selection.onchange(made.refresh);
  followMark(made, chosen, () => (chosen.mark?.set === 'runs' ? indices.indexOf(chosen.mark.index) : -1));
  return made.node;
}

/// A table of all designs of a set follows the mark and the selection, and is where "Show in table" leads.
export function linkTable(set, made, {chosen, designs, selection, rows}) {
  followMark(made, chosen, () => chosen.marked(set));
  selection.onchange(designs[set].length > many ? whenResting(made.refresh) : made.refresh);
  rows[set] = (index) => {
    openDetails(made.node);
    made.show(index);
    made.node.scrollIntoView({block: 'nearest'});
  };
  return made;
}

/// row(): of the marked design, or -1.
function followMark(made, chosen, row) {
  let mark = null;
  chosen.onchange(() => {
    if (mark === chosen.mark) return;
    mark = chosen.mark;
    const index = row();
    made.mark(index);
    if (index < 0) return;
    openDetails(made.node);
    made.show(index);
  });
}

function openDetails(node) {
  const details = node.closest('details');
  if (details) details.open = true;
}

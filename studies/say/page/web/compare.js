// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Up to four runs side by side, each with its difference to the first.

import {el} from './dom.js';
import {labelled, number, setting} from './format.js';
import {anyBreaks, brokenText} from './limits.js';
import {table} from './table.js';

const most = 4;

/// {box(run index): the tick box of a run, node: the comparison}.
export function comparing(data, designs) {
  let picked = [];
  const boxes = new Map();
  const node = el('div', {class: 'comparison', 'aria-live': 'polite'});
  const update = () => {
    for (const [i, box] of boxes) {
      box.checked = picked.includes(i);
      box.disabled = picked.length === most && !box.checked;
    }
    node.replaceChildren(
      ...(picked.length
        ? comparison(
            data,
            picked.map((i) => designs.runs[i]),
            clear,
          )
        : [el('p', {class: 'note'}, `Tick up to ${most} runs to see them side by side.`)]),
    );
  };
  const clear = () => {
    picked = [];
    update();
  };
  const box = (i) => {
    const made = el('input', {
      type: 'checkbox',
      checked: picked.includes(i),
      disabled: picked.length === most && !picked.includes(i),
      'aria-label': `Compare run ${designs.runs[i].run}`,
      onchange: () => {
        picked = made.checked ? [...picked, i] : picked.filter((k) => k !== i);
        update();
      },
    });
    boxes.set(i, made);
    return made;
  };
  update();
  return {box, node};
}

function comparison({problem}, runs, clear) {
  const columns = [
    {title: '', text: true},
    ...runs.flatMap((r, i) => [{title: `Run ${r.run}`}, ...(i ? [{title: 'difference'}] : [])]),
  ];
  const line = (title, of, {shown = number, missing = 'n/a', levels = false} = {}) => [
    title,
    ...runs.flatMap((r, i) => {
      const value = of(r);
      return [
        value == null ? {value: null, shown: missing} : levels ? shown(value) : {value, shown: shown(value)},
        ...(i ? [difference(value, of(runs[0]), shown, levels)] : []),
      ];
    }),
  ];
  const words = (title, of) => [title, ...runs.flatMap((r, i) => [of(r), ...(i ? [''] : [])])];
  const rows = [
    words('kind', (r) => r.kind),
    ...problem.variables.map((v, k) =>
      line(labelled(v), (r) => r.x[k], {shown: (value) => setting(value, v), levels: Boolean(v.levels)}),
    ),
    ...problem.responses.map((response, j) => line(labelled(response), (r) => r.y?.[j], {missing: 'failed'})),
    line('time [s]', (r) => r.seconds),
  ];
  if (anyBreaks(runs)) rows.push(words('limits', (r) => brokenText(problem, r)));
  if (runs.some((r) => !r.y)) rows.push(words('failed, because', (r) => (r.y ? '' : r.reason)));
  return [
    el('div', {class: 'tools'}, el('h3', {}, 'Side by side'), el('button', {type: 'button', onclick: clear}, 'Clear')),
    table(columns, rows, {name: 'Side by side', sortable: false}).node,
  ];
}

function difference(value, reference, shown, levels) {
  if (value == null || reference == null) return {value: null, shown: 'n/a'};
  if (levels) return value === reference ? 'same' : 'another';
  const change = value - reference;
  return {value: change, shown: (change > 0 ? '+' : '') + shown(change)};
}

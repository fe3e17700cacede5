// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The ranges of the axes in numbers: to read, to take away, and to set without a pointer.

import {el, select} from './dom.js';
import {hasUnit, pretty, setting} from './format.js';

export function rangeForm(axes, selection) {
  let axis = 0;
  const entry = (label) => el('input', {type: 'number', step: 'any', 'aria-label': label, placeholder: label});
  const from = entry('from'),
    to = entry('to'),
    list = el('span', {class: 'chips'});
  const given = (input, other) => (input.value === '' ? other : Number(input.value));
  const set = (e) => {
    e.preventDefault();
    const ends = [given(from, axes[axis].low), given(to, axes[axis].high)];
    selection.setRange(axis, [Math.min(...ends), Math.max(...ends)]);
  };
  const node = el(
    'form',
    {class: 'controls', onsubmit: set},
    select(
      'Range of',
      axes.map((a) => a.title),
      0,
      (k) => {
        axis = k;
      },
    ),
    from,
    to,
    el('button', {type: 'submit'}, 'Set range'),
    list,
  );
  const chip = ([k, range]) => {
    const {item} = axes[k],
      text =
        `${pretty(item.name)} ` +
        `${range.map((value) => setting(value, item)).join(' to ')}${hasUnit(item.unit) ? ' ' + item.unit : ''}`;
    return el(
      'button',
      {
        type: 'button',
        class: 'chip',
        'aria-label': 'Take away the range ' + text,
        onclick: () => selection.setRange(k, null),
      },
      text + ' ×',
    );
  };
  selection.onchange(() => list.replaceChildren(...[...selection.ranges].map(chip)));
  return node;
}

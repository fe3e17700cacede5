// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// At the foot of the window while something is selected or marked: how much is, and the way back.

import {nameOf} from './designs.js';
import {el} from './dom.js';

export function selectionBar({chosen, designs, selection, rows}) {
  const count = el('span', {}),
    mark = el('span', {});
  const clear = el('button', {type: 'button', onclick: () => selection.clear()}, 'Clear selection');
  const show = el(
    'button',
    {type: 'button', onclick: () => rows[chosen.mark.set]?.(chosen.mark.index)},
    'Show in table',
  );
  const unmark = el('button', {type: 'button', onclick: () => chosen.reset()}, 'Take mark away');
  const node = el(
    'div',
    {class: 'selection', role: 'status', hidden: true},
    el('span', {class: 'part'}, count, clear),
    el('span', {class: 'part'}, mark, show, unmark),
  );
  const update = () => {
    const {counts, sizes} = selection;
    const parts = [
      sizes.front ? `${counts.front} of ${sizes.front} front points` : '',
      `${counts.runs} of ${sizes.runs} runs`,
    ].filter(Boolean);
    count.textContent = `Selected: ${parts.join(', ')}`;
    count.parentNode.hidden = !selection.active;
    if (chosen.mark) mark.textContent = 'Marked: ' + nameOf(designs, chosen.mark.set, chosen.mark.index);
    mark.parentNode.hidden = !chosen.mark;
    node.hidden = !selection.active && !chosen.mark;
  };
  selection.onchange(update);
  chosen.onchange(update);
  return node;
}

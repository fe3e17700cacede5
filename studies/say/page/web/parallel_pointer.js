// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The line of the parallel coordinates at the pointer: what it is stands beside it, and a click marks it.

import {nameOf} from './designs.js';
import {el} from './dom.js';
import {pretty, settingWithUnit, withUnit} from './format.js';
import {oncePerFrame} from './frames.js';
import {brokenText} from './limits.js';
import {own} from './responses.js';

const reach = 6; // px up or down to a line
const still = 4; // px that a click may move

/// The line {set, i} nearest to (x, y) between two axes, of those that shown(set, i) lets pass, or null.
/// counts: [[set, lines]..]; axes: [{x, y(value), values}]. Where a value is missing there is no line.
export function lineAt(axes, counts, shown, [x, y]) {
  const right = axes.findIndex((axis) => axis.x > x);
  if (right < 1) return null;
  const [a, b] = [axes[right - 1], axes[right]],
    share = (x - a.x) / (b.x - a.x);
  let best = null,
    least = reach;
  for (const [set, count] of counts)
    for (let i = 0; i < count; ++i) {
      const away = Math.abs((1 - share) * a.y(a.values[set][i]) + share * b.y(b.values[set][i]) - y);
      if (away < least && shown(set, i)) [best, least] = [{set, i}, away];
    }
  return best;
}

function wordsOf(data, designs, {set, i}) {
  const {variables, responses} = data.problem,
    {x, y, reason} = designs[set][i];
  return [
    nameOf(designs, set, i),
    ...variables.map((v, k) => `${pretty(v.name)} = ${settingWithUnit(x[k], v)}`),
    ...own(responses)
      .filter(({j}) => y?.[j] != null)
      .map(({response, j}) => `${pretty(response.name)}: ${withUnit(y[j], response)}`),
    y || set === 'front' ? '' : `failed (${reason})`,
    brokenText(data.problem, designs[set][i]),
  ].filter(Boolean);
}

/// at([x, y]): the line there, or null. label: an element over the surface, which stands at the pointer.
/// highlight(line or null) is called when another line is at the pointer.
export function pointing(surface, label, {data, designs, chosen}, at, highlight) {
  let place = null,
    line = null,
    pressed = null;
  const placeOf = (e) => {
    const frame = surface.getBoundingClientRect();
    return [e.clientX - frame.left, e.clientY - frame.top];
  };
  const stand = ([x, y]) => {
    const inner = label.parentElement,
      {scrollLeft, clientWidth} = inner.parentElement,
      right = x + 14;
    const left = Math.max(scrollLeft, x - 14 - label.offsetWidth);
    label.style.left = `${right + label.offsetWidth < scrollLeft + clientWidth ? right : left}px`;
    label.style.top = `${Math.max(0, Math.min(inner.clientHeight - label.offsetHeight, y + 10))}px`;
  };
  const show = oncePerFrame(() => {
    const found = place && at(place);
    if (found?.set !== line?.set || found?.i !== line?.i) {
      line = found;
      highlight(line);
      if (line) label.replaceChildren(...wordsOf(data, designs, line).map((text, k) => el(k ? 'div' : 'b', {}, text)));
    }
    label.hidden = !line;
    if (!line) return;
    surface.style.cursor = 'pointer';
    stand(place);
  });
  surface.addEventListener('pointermove', (e) => {
    place = e.buttons ? null : placeOf(e);
    show();
  });
  surface.addEventListener('pointerleave', () => {
    place = null;
    show();
  });
  // What the label said is marked; a finger has no label.
  surface.addEventListener('pointerdown', (e) => {
    pressed = {from: placeOf(e), on: line ?? at(placeOf(e))};
  });
  surface.addEventListener('click', (e) => {
    const [x, y] = placeOf(e),
      {from, on} = pressed ?? {};
    if (on && Math.hypot(x - from[0], y - from[1]) < still) chosen.pick(on.set, on.i);
  });
}

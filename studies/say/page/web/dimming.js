// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The points of a plot that stand for designs: a click marks the design, and those that are not selected are
// dimmed. This writes to the drawn points: for ten thousand of them that takes a tenth of the time in which
// Plotly restyles the plot.

import {whenResting} from './frames.js';
import {colour} from './theme.js';

const dimmed = 0.15;
const still = 4; // px that a press may move
const late = 300; // ms after a press in which a plot says what was clicked
const many = 2000; // points from which on a plot waits until the selection rests, and has points without edges

/// A trace whose i-th point is design indices[i] of the set, or its i-th design.
export const link = (set, indices = null, opacity = 1) => ({set, index: (i) => (indices ? indices[i] : i), opacity});

/// The same of a trace that shows others each time: indices() are those of now.
export const movingLink = (set, indices) => ({set, index: (i) => indices()[i], opacity: 1});

/// links: per trace of the plot a link, or undefined for a trace that does not belong to designs. Returns what
/// links the plot again after it was taken apart (Plotly.purge) and drawn.
export function linkPoints(box, links, {chosen, selection}) {
  const large = box.querySelectorAll('.point').length > many;
  const apply = () =>
    box.querySelectorAll('.scatterlayer .trace').forEach((trace) => {
      const known = links[trace.__data__[0].trace.index];
      if (!known) return;
      const shareOf = ({__data__}) => (selection.has(known.set, known.index(__data__.i)) ? '1' : String(dimmed));
      for (const bar of trace.querySelectorAll('.errorbar')) bar.style.opacity = shareOf(bar);
      for (const node of trace.querySelectorAll('.point')) {
        const share = shareOf(node);
        if (node.style.fillOpacity === share) continue;
        node.style.fillOpacity = share; // not opacity, for which a browser composes each point on its own
        if (!large) node.style.strokeOpacity = share;
      }
    });
  selection.onchange(large ? whenResting(apply) : apply);
  const clicked = oncePerPress(box, chosen.pick);
  const listen = () => {
    box.on('plotly_afterplot', apply);
    box.on('plotly_click', ({points: [point]}) => {
      const known = links[point.curveNumber];
      if (known) clicked(known.set, known.index(point.pointIndex ?? point.pointNumber));
    });
  };
  listen();
  return listen;
}

/// A plot in 3-D says "click" at each of its frames while a button is down, also while it is being turned. Of
/// these the first counts, once the button is up where it went down.
function oncePerPress(box, pick) {
  let press = null;
  const released = (mine, e) => {
    if (press !== mine) return;
    if (Math.hypot(e.clientX - mine.x, e.clientY - mine.y) >= still) press = null;
    else if (mine.design) {
      press = null;
      pick(...mine.design);
    } else
      setTimeout(() => {
        if (press === mine) press = null;
      }, late);
    mine.up = true;
  };
  box.addEventListener(
    'pointerdown',
    ({clientX: x, clientY: y}) => {
      const mine = (press = {x, y, design: null, up: false});
      addEventListener('pointerup', (e) => released(mine, e), {capture: true, once: true});
    },
    {capture: true},
  );
  return (...design) => {
    if (!press?.up) {
      if (press) press.design ??= design;
      return;
    }
    press = null;
    pick(...design);
  };
}

/// The same of points that have opacities of their own.
export const dimmedBy = (selection, {set, index}, opacity) =>
  selection.active ? opacity.map((o, i) => (selection.has(set, index(i)) ? o : dimmed * o)) : opacity;

/// The same as Plotly's marker.opacity, where the picture is to be saved and not drawn here.
export const opacities = (selection, {set, index, opacity}, count, saved) =>
  saved && selection.active
    ? Array.from({length: count}, (_, i) => (selection.has(set, index(i)) ? opacity : dimmed * opacity))
    : opacity;

/// A ring around a point of the plot, as a shape: it moves without the points being drawn again.
export const ring = (x, y) => ({
  type: 'circle',
  xsizemode: 'pixel',
  ysizemode: 'pixel',
  xanchor: x,
  yanchor: y,
  x0: -9,
  x1: 9,
  y0: -9,
  y1: 9,
  line: {color: colour.accent, width: 2.5},
});

/// Draws the rings again when another design is marked.
export function ringMarked(box, chosen, rings) {
  let mark = chosen.mark;
  chosen.onchange(() => {
    if (mark === chosen.mark) return;
    mark = chosen.mark;
    Plotly.relayout(box, {shapes: rings()});
  });
}

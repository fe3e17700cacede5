// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The points of a plot that stand for designs: a click marks the design, and those that are not selected are
// dimmed. This writes to the drawn points: for ten thousand of them that takes a tenth of the time in which
// Plotly restyles the plot.
/* global Plotly */

import {whenResting} from './frames.js';
import {colour} from './theme.js';

const dimmed = 0.15;
const many = 2000;  // points from which on a plot waits until the selection rests, and has points without edges

/// A trace whose i-th point is design indices[i] of the set, or its i-th design.
export const link = (set, indices = null, opacity = 1) => ({set, index: (i) => (indices ? indices[i] : i), opacity});

/// The same of a trace that shows others each time: indices() are those of now.
export const movingLink = (set, indices) => ({set, index: (i) => indices()[i], opacity: 1});

/// links: per trace of the plot a link, or undefined for a trace that does not belong to designs. Returns what
/// links the plot again after it was taken apart (Plotly.purge) and drawn.
export function linkPoints(box, links, {chosen, selection}) {
  const large = box.querySelectorAll('.point').length > many;
  const apply = () => box.querySelectorAll('.scatterlayer .trace').forEach((trace) => {
    const known = links[trace.__data__[0].trace.index];
    if (!known) return;
    const shareOf = ({__data__}) => (selection.has(known.set, known.index(__data__.i)) ? '1' : String(dimmed));
    for (const bar of trace.querySelectorAll('.errorbar')) bar.style.opacity = shareOf(bar);
    for (const node of trace.querySelectorAll('.point')) {
      const share = shareOf(node);
      if (node.style.fillOpacity === share) continue;
      node.style.fillOpacity = share;  // not opacity, for which a browser composes each point on its own
      if (!large) node.style.strokeOpacity = share;
    }
  });
  selection.onchange(large ? whenResting(apply) : apply);
  const listen = () => {
    box.on('plotly_afterplot', apply);
    box.on('plotly_click', ({points: [point]}) => {
      const known = links[point.curveNumber];
      if (known) chosen.pick(known.set, known.index(point.pointIndex ?? point.pointNumber));
    });
  };
  listen();
  return listen;
}

/// The same as Plotly's marker.opacity, where the picture is to be saved and not drawn here.
export const opacities = (selection, {set, index, opacity}, count, saved) =>
  (saved && selection.active ? Array.from({length: count}, (_, i) => (selection.has(set, index(i)) ? opacity : dimmed * opacity)) : opacity);

/// A ring around a point of the plot, as a shape: it moves without the points being drawn again.
export const ring = (x, y) => ({type: 'circle', xsizemode: 'pixel', ysizemode: 'pixel', xanchor: x, yanchor: y, x0: -9, x1: 9, y0: -9, y1: 9,
  line: {color: colour.accent, width: 2.5}});

/// Draws the rings again when another design is marked.
export function ringMarked(box, chosen, rings) {
  let mark = chosen.mark;
  chosen.onchange(() => {
    if (mark === chosen.mark) return;
    mark = chosen.mark;
    Plotly.relayout(box, {shapes: rings()});
  });
}

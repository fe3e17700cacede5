// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The points of a large trace on a canvas behind its plot. Each point in Plotly's SVG has a place of its own
// that a browser goes through whenever anything on the page changes: ten thousand of them, thrice, make every
// hover and every brush wait. Plotly still knows all points, so that hover, click and selection find them.

import {oncePerFrame} from './frames.js';

const shades = 64;
const dimmed = 0.15;
const valueless = 'rgb(128,128,128)';

/// Of a trace whose points stand on the canvas: Plotly draws the first alone.
export const onCanvas = {maxdisplayed: 1};

function channels(hex) {
  return [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));
}

/// The colour at a share of a scale [[stop, '#rrggbb']..].
export function colourAt(scale, share) {
  const above = scale.findIndex(([stop]) => stop >= share),
    k = above < 0 ? scale.length - 1 : Math.max(1, above);
  const [low, a] = scale[k - 1],
    [high, b] = scale[k],
    f = Math.min(1, Math.max(0, (share - low) / (high - low)));
  const ends = [channels(a), channels(b)];
  return `rgb(${[0, 1, 2].map((c) => Math.round((1 - f) * ends[0][c] + f * ends[1][c])).join(',')})`;
}

/// Points by what they are drawn in: [{fill, points: [i..]}], equal shades of a scale together, those without
/// a value grey.
export function byShade({color, colorscale, cmin, cmax}, count) {
  const all = Array.from({length: count}, (_, i) => i);
  if (!Array.isArray(color) && !ArrayBuffer.isView(color)) return [{fill: color, points: all}];
  const groups = Array.from({length: shades}, (_, k) => ({fill: colourAt(colorscale, (k + 0.5) / shades), points: []}));
  groups.push({fill: valueless, points: []});
  for (const i of all) {
    const shade = Math.floor((shades * (color[i] - cmin)) / (cmax - cmin || 1));
    groups[Number.isNaN(shade) ? shades : Math.min(shades - 1, Math.max(0, shade))].points.push(i);
  }
  return groups;
}

/// Draws trace `index` of a plot behind it, those not selected dimmed: has(i) tells.
export function pointCloud(box, index, {has, selection}) {
  const canvas = document.createElement('canvas');
  canvas.style.cssText = 'position:absolute;left:0;top:0;pointer-events:none';
  const paint = () => {
    const {_fullLayout: layout, _fullData: traces} = box,
      trace = traces?.[index];
    const svg = box.querySelector('.main-svg');
    if (!trace || !svg) return;
    if (canvas.parentNode !== svg.parentNode) svg.before(canvas);
    const ratio = Math.min(2, devicePixelRatio),
      {width, height} = layout,
      {xaxis, yaxis} = layout;
    Object.assign(canvas, {width: width * ratio, height: height * ratio});
    Object.assign(canvas.style, {width: width + 'px', height: height + 'px'});
    // Drawn by the processor, as parallel_lines.js does.
    const pen = canvas.getContext('2d', {willReadFrequently: true});
    pen.scale(ratio, ratio);
    pen.rect(xaxis._offset, yaxis._offset, xaxis._length, yaxis._length);
    pen.clip();
    const groups = byShade(trace.marker, trace.x.length),
      radius = trace.marker.size / 2;
    for (const inside of selection.active ? [false, true] : [true]) {
      pen.globalAlpha = inside ? 1 : dimmed;
      for (const {fill, points} of groups) {
        pen.fillStyle = fill;
        pen.beginPath();
        for (const i of points) {
          if (selection.active && has(i) !== inside) continue;
          const x = xaxis._offset + xaxis.l2p(trace.x[i]),
            y = yaxis._offset + yaxis.l2p(trace.y[i]);
          pen.moveTo(x + radius, y);
          pen.arc(x, y, radius, 0, 6.3);
        }
        pen.fill();
      }
    }
  };
  const soon = oncePerFrame(paint);
  // No frame comes before paper is laid out.
  box.on('plotly_afterplot', () => (matchMedia('print').matches ? paint() : soon()));
  selection.onchange(soon);
  soon();
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The axes of the parallel coordinates, and the ranges that are drawn on them with the pointer.

import {hasUnit, number, pretty} from './format.js';
import {colour} from './theme.js';

const margin = {top: 54, bottom: 18, side: 64};
const grip = 6; // px around an end of a range that move this end

const svg = (tag, attributes = {}, ...children) => {
  const node = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
};

/// Where each axis stands: [{x, y(value), value(y), ...axis}].
export function placed(axes, {width, height}) {
  const gap = axes.length > 1 ? (width - 2 * margin.side) / (axes.length - 1) : 0;
  const bottom = height - margin.bottom,
    length = bottom - margin.top;
  return axes.map((axis, k) => ({
    ...axis,
    gap,
    top: margin.top,
    bottom,
    x: margin.side + k * gap,
    y: (value) => bottom - (length * (value - axis.low)) / (axis.high - axis.low),
    value: (y) => axis.low + ((axis.high - axis.low) * (bottom - Math.min(bottom, Math.max(margin.top, y)))) / length,
  }));
}

/// Round numbers between low and high, about five of them.
function roundNumbers(low, high, whole) {
  const rough = (high - low) / 5,
    power = 10 ** Math.floor(Math.log10(rough));
  const step = Math.max(whole ? 1 : 0, power * [1, 2, 5, 10].find((m) => m * power >= rough));
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({length: Math.floor(high / step + 1e-9) - first + 1}, (_, i) => (first + i) * step);
}

function labels({item, low, high, empty}) {
  if (empty) return [];
  if (item.levels) return item.levels.map((name, i) => [i, short(pretty(name), 14)]);
  return roundNumbers(low, high, Boolean(item.kind)).map((value) => [value, tick(value)]);
}

const tick = (value) =>
  Math.abs(value) >= 1e5 || (value !== 0 && Math.abs(value) < 1e-3)
    ? number(value, 2)
    : String(Number(value.toPrecision(6)));
const short = (text, most) => (text.length > most ? text.slice(0, most - 1) + '…' : text);

/// The axes as SVG that stands alone. Every second title is higher, so that neighbours do not touch.
export function axesSvg(axes, ranges) {
  return svg(
    'g',
    {'font-family': 'system-ui, sans-serif', 'font-size': 12, fill: colour.ink},
    ...axes.map((axis, k) => one(axis, k, ranges.get(k))),
  );
}

function one(axis, k, range) {
  const {x, y, top, bottom, gap, item, isVariable} = axis;
  const halo = {stroke: colour.paper, 'stroke-width': 3, 'paint-order': 'stroke'};
  const goal = {maximize: ' ↑', minimize: ' ↓'}[item.goal] ?? '';
  const name = svg(
    'text',
    {x, y: gap < 110 && k % 2 ? top - 36 : top - 22, 'text-anchor': 'middle', 'font-weight': 600},
    short(pretty(item.name), Math.max(10, gap / 4)) + goal,
  );
  const unit = hasUnit(item.unit)
    ? svg(
        'text',
        {x, y: Number(name.getAttribute('y')) + 13, 'text-anchor': 'middle', fill: colour.muted, 'font-size': 11},
        item.unit,
      )
    : '';
  const node = svg(
    'g',
    {},
    svg('title', {}, axis.title),
    name,
    unit,
    svg('line', {
      x1: x,
      x2: x,
      y1: top,
      y2: bottom,
      stroke: isVariable ? colour.ink : colour.accent,
      'stroke-width': 1.5,
    }),
  );
  for (const [value, text] of labels(axis)) {
    node.append(
      svg('line', {x1: x - 4, x2: x, y1: y(value), y2: y(value), stroke: colour.ink}),
      svg('text', {x: x - 7, y: y(value) + 4, 'text-anchor': 'end', 'font-size': 11, ...halo}, text),
    );
  }
  if (range)
    node.append(
      svg('rect', {
        x: x - 7,
        y: y(Math.min(axis.high, range[1])),
        width: 14,
        rx: 2,
        height: Math.max(2, y(Math.max(axis.low, range[0])) - y(Math.min(axis.high, range[1]))),
        fill: colour.accent,
        'fill-opacity': 0.35,
        stroke: colour.accent,
      }),
    );
  return node;
}

/// The index of the axis that is meant by a pointer at x, or -1.
export const axisAt = (axes, x) =>
  axes.findIndex((axis) => Math.abs(axis.x - x) < Math.min(18, 0.45 * (axis.gap || 40)));

/// The places of a line over the axes, in pieces, as SVG.
export const outline = (pieces) =>
  svg(
    'g',
    {fill: 'none', 'pointer-events': 'none', stroke: colour.accent, 'stroke-width': 2.5},
    ...pieces.map((piece) => svg('polyline', {points: piece.map((place) => place.join(',')).join(' ')})),
  );

/// What the pointer does on the axes: draws a range, moves it or one of its ends; a click takes it away.
export function brush(surface, {axes, ranges, setRange}) {
  const at = (e) => {
    const frame = surface.getBoundingClientRect();
    return [e.clientX - frame.left, e.clientY - frame.top];
  };
  const near = (x) => axisAt(axes(), x);
  let held = null;
  surface.addEventListener('pointerdown', (e) => {
    const [x, y] = at(e),
      k = near(x);
    if (k < 0 || e.button !== 0) return;
    surface.setPointerCapture(e.pointerId);
    held = {k, from: y, ...grasp(axes()[k], ranges.get(k), y), moved: false};
    e.preventDefault();
  });
  surface.addEventListener('pointermove', (e) => {
    const [x, y] = at(e);
    if (!held) {
      surface.style.cursor = near(x) < 0 ? 'default' : 'ns-resize';
      return;
    }
    if (Math.abs(y - held.from) > 3) held.moved = true;
    if (!held.moved) return;
    const axis = axes()[held.k],
      ends = held.ends(y).map((v) => axis.value(v));
    setRange(held.k, [Math.min(...ends), Math.max(...ends)]);
  });
  const release = () => {
    if (held && !held.moved) setRange(held.k, null);
    held = null;
  };
  surface.addEventListener('pointerup', release);
  surface.addEventListener('pointercancel', () => {
    held = null;
  });
}

function grasp(axis, range, y) {
  if (range) {
    const [low, high] = range.map((value) => axis.y(value));
    if (Math.abs(y - low) < grip) return {ends: (now) => [high, now]};
    if (Math.abs(y - high) < grip) return {ends: (now) => [low, now]};
    if (y < low && y > high) return {ends: (now) => slid(axis, low, high, now - y)};
  }
  return {ends: (now) => [y, now]};
}

/// The range moved by a way, as far as its axis goes.
function slid(axis, low, high, way) {
  const step = Math.max(axis.top - high, Math.min(axis.bottom - low, way));
  return [low + step, high + step];
}

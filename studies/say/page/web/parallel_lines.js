// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The lines of the parallel coordinates: one per design, across all axes. Onto a canvas, since thousands of
// SVG paths are slow, or as SVG text to save.

import {breaksLimit} from './limits.js';
import {trace} from './parallel_trace.js';
import {colour} from './theme.js';

const bundle = 10; // lines per stroke: fewer strokes are faster, but within one stroke crossings do not get darker
export const many = 3000; // lines from which on they are one device pixel wide, which browsers draw ten times as fast

const beyond = ', breaks a limit';

/// What the designs of a set are drawn as: the names of colours, with what makes a line dashed.
export const drawnAs = ({runs, front}, set) =>
  set === 'front'
    ? front.map(() => 'front')
    : runs.map((r) => (r.y ? r.kind + (breaksLimit(r) ? beyond : '') : 'failed'));
export const colourOf = (name) => colour[name.replace(beyond, '')] ?? colour.training;
export const isDashed = (name) => name.endsWith(beyond);
const dashes = [6, 4];

/// Bundles of lines: {colour, opacity, width, lines: [{set, i}]}. Of every design, dimmed.
export function dimmedLines(designs, sets) {
  const count = lineCount(designs, sets),
    look = {colour: colour.guide, opacity: Math.max(0.012, Math.min(0.2, 60 / count)), width: widthOf(count)};
  return sets.flatMap((set) =>
    bundles(
      set,
      designs[set].map((_, i) => i),
      look,
    ),
  );
}

/// Of what is selected, and of the marked design. With most, about so many lines only, evenly taken.
export function selectedLines(designs, sets, {selection, chosen}, most = Infinity) {
  const count = lineCount(designs, sets),
    step = Math.max(1, Math.ceil(count / most));
  const lines = sets.flatMap((set) => {
    const inside = new Map();
    drawnAs(designs, set).forEach((name, i) => {
      if (i % step || !selection.has(set, i)) return;
      if (!inside.has(name)) inside.set(name, []);
      inside.get(name).push(i);
    });
    return [...inside].flatMap(([name, indices]) =>
      bundles(set, indices, {
        colour: colourOf(name),
        dashed: isDashed(name),
        opacity: Math.max(0.2, Math.min(0.75, 60 / indices.length)),
        width: widthOf(count),
      }),
    );
  });
  const {mark} = chosen;
  return mark && sets.includes(mark.set)
    ? [...lines, {colour: colour.accent, opacity: 1, width: 3, lines: [{set: mark.set, i: mark.index}]}]
    : lines;
}

export const lineCount = (designs, sets) => sets.reduce((sum, set) => sum + designs[set].length, 0);
const ratio = () => Math.max(2, devicePixelRatio);
const widthOf = (count) => (count > many ? 1 / ratio() : 1.2);

function bundles(set, indices, look) {
  return Array.from({length: Math.ceil(indices.length / bundle)}, (_, k) => ({
    ...look,
    lines: indices.slice(k * bundle, (k + 1) * bundle).map((i) => ({set, i})),
  }));
}

/// axes: [{x, y(value), values}].
export function paint(canvas, {width, height}, axes, all) {
  canvas.width = width * ratio();
  canvas.height = height * ratio();
  // Drawn by the processor: faster for so many short strokes.
  const pen = canvas.getContext('2d', {willReadFrequently: true});
  pen.scale(ratio(), ratio());
  pen.lineJoin = 'bevel';
  for (const {colour: stroke, opacity, width: thick, dashed, lines} of all) {
    pen.setLineDash(dashed ? dashes : []);
    Object.assign(pen, {strokeStyle: stroke, globalAlpha: opacity, lineWidth: thick});
    pen.beginPath();
    lines.forEach((line) => trace(line, axes, pen));
    pen.stroke();
  }
}

export function asSvg(axes, all) {
  return all
    .map(({colour: stroke, opacity, width, dashed, lines}) => {
      let d = '';
      const pen = {
        moveTo: (x, y) => {
          d += `M${x.toFixed(1)} ${y.toFixed(1)}`;
        },
        lineTo: (x, y) => {
          d += `L${x.toFixed(1)} ${y.toFixed(1)}`;
        },
      };
      lines.forEach((line) => trace(line, axes, pen));
      return (
        `<path d="${d}" fill="none" stroke="${stroke}" stroke-opacity="${opacity.toFixed(3)}" ` +
        `stroke-width="${width}"${dashed ? ` stroke-dasharray="${dashes}"` : ''}/>`
      );
    })
    .join('');
}

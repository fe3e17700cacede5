// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// All designs in parallel coordinates: a line per run and point of the front, an axis per variable and
// response.

import {choice, el, figure, section} from './dom.js';
import {download, fileName} from './delimited.js';
import {pretty} from './format.js';
import {oncePerFrame, whenResting} from './frames.js';
import {anyBreaks} from './limits.js';
import {axesSvg, axisAt, brush, outline, placed} from './parallel_axes.js';
import {
  asSvg,
  colourOf,
  dimmedLines,
  drawnAs,
  isDashed,
  lineCount,
  many,
  paint,
  selectedLines,
} from './parallel_lines.js';
import {lineAt, pointing} from './parallel_pointer.js';
import {piecesOf} from './parallel_trace.js';
import {rangeForm} from './range_form.js';
import {colour, onPaper, onTheme} from './theme.js';

const height = 400;
const leastGap = 78; // px between axes
const thinned = 1000; // lines that are drawn while a selection of many is still moving

export function parallelCoordinates(data, shared) {
  const {designs} = shared,
    front = designs.front.length > 0;
  const shownSets = [['front', 'runs'], ['front'], ['runs']];
  const view = {sets: front ? shownSets[0] : ['runs']};
  const {node, redraw, save} = stage(view, {data, ...shared});
  const which = front
    ? choice(['Runs and front', 'Front', 'Runs'], (i) => {
        view.sets = shownSets[i];
        redraw();
      })
    : null;
  const clear = clearButton(shared.selection);
  return section(
    'designs',
    'All designs',
    'Each line is one design: its variables, then its responses. What is selected here or in a trade-off is ' +
      'selected in every plot and table; the rest is dimmed.',
    figure(
      el(
        'div',
        {},
        el('div', {class: 'controls'}, which, el('button', {type: 'button', onclick: save}, 'Save as SVG'), clear),
        legend(designs),
        node,
        rangeForm(designs.axes, shared.selection),
      ),
      `Draw along an axis to select a range; drag the range or its ends to change it, click it to take it away. ` +
        `Several ranges select what lies in all of them. Point at a line between two axes to read it, and click ` +
        `to follow it through the report. A failed run has no responses, so its line ends ` +
        `early.${front ? ' Responses of the front are predicted.' : ''} Arrows say which way a response is ` +
        `wanted.${anyBreaks(designs.runs) ? ' A dashed line is a run that breaks a limit.' : ''}`,
    ),
  );
}

function clearButton(selection) {
  const button = el('button', {type: 'button', disabled: true, onclick: () => selection.clear()}, 'Clear selection');
  selection.onchange(() => {
    button.disabled = !selection.active;
  });
  return button;
}

function legend(designs) {
  const counts = new Map();
  for (const name of ['runs', 'front'].flatMap((set) => drawnAs(designs, set)))
    counts.set(name, (counts.get(name) ?? 0) + 1);
  const swatches = [...counts].map(([kind, count]) => ({
    kind,
    swatch: el('i', {class: isDashed(kind) ? 'swatch dashed' : 'swatch'}),
    count,
  }));
  const tint = () =>
    swatches.forEach(({kind, swatch}) => {
      swatch.style.color = colourOf(kind);
    });
  onTheme(tint);
  tint();
  return el(
    'div',
    {class: 'legend'},
    swatches.map(({kind, swatch, count}) => el('span', {}, swatch, `${pretty(kind)} ${count}`)),
  );
}

/// Two layers: all lines dimmed, drawn once, and the selected ones. While a selection of many lines is being
/// drawn, only a part of them is, until it rests.
function stage(view, shared) {
  const {designs, selection, chosen} = shared;
  const behind = el('canvas'),
    front = el('canvas'),
    overlay = document.createElementNS('http://www.w3.org/2000/svg', 'svg'),
    label = el('div', {class: 'label', hidden: true});
  const inner = el(
    'div',
    {class: 'parallel', style: `height:${height}px;min-width:${128 + leastGap * (designs.axes.length - 1)}px`},
    behind,
    front,
    overlay,
    label,
  );
  const node = el('div', {class: 'scrolled', role: 'img', 'aria-label': 'Parallel coordinates of all designs'}, inner);
  let axes = [],
    size = {width: 0, height},
    stale = true,
    pointed = null;
  const lines = () =>
    overlay.replaceChildren(axesSvg(axes, selection.ranges), ...(pointed ? [outline(piecesOf(axes, pointed))] : []));
  const draw = (most = Infinity) => {
    if (stale) {
      size = {width: inner.clientWidth, height};
      axes = placed(designs.axes, size);
    }
    if (!size.width) return;
    if (stale && selection.active) {
      paint(behind, size, axes, dimmedLines(designs, view.sets));
      stale = false;
    }
    behind.hidden = !selection.active;
    paint(front, size, axes, selectedLines(designs, view.sets, shared, most));
    lines();
  };
  const soon = oncePerFrame(() => draw(lineCount(designs, view.sets) > many ? thinned : Infinity)),
    later = whenResting(draw);
  const update = () => {
    soon();
    if (lineCount(designs, view.sets) > many) later();
  };
  const anew = () => {
    stale = true;
    update();
  };
  let mark = null;
  selection.onchange(update);
  chosen.onchange(() => {
    if (mark !== chosen.mark) {
      mark = chosen.mark;
      update();
    }
  });
  onTheme((now) => {
    anew();
    if (now) draw();
  });
  new ResizeObserver(anew).observe(inner);
  const at = (place) =>
    axisAt(axes, place[0]) < 0
      ? lineAt(
          axes,
          view.sets.map((set) => [set, designs[set].length]),
          selection.has,
          place,
        )
      : null;
  pointing(overlay, label, shared, at, (line) => {
    pointed = line;
    lines();
  });
  brush(overlay, {axes: () => axes, ranges: selection.ranges, setRange: selection.setRange});
  return {node, redraw: anew, save: () => onPaper(() => save(axes, size, view, shared))};
}

function save(axes, size, {sets}, {designs, selection, chosen}) {
  const lines = [
    ...(selection.active ? dimmedLines(designs, sets) : []),
    ...selectedLines(designs, sets, {selection, chosen}),
  ];
  const text =
    `<svg xmlns="http://www.w3.org/2000/svg" width="${size.width}" height="${height}" viewBox="0 0 ` +
    `${size.width} ${height}"><rect width="100%" height="100%" ` +
    `fill="${colour.paper}"/>${asSvg(axes, lines)}` +
    `${new XMLSerializer().serializeToString(axesSvg(axes, selection.ranges))}</svg>`;
  download(fileName(document.title, 'parallel coordinates') + '.svg', text, 'image/svg+xml');
}

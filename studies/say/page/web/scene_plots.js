// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Plots of signals in time with the scene: a cursor stands at the time that is shown, and a click goes to
// another.

import {download, fileName} from './delimited.js';
import {el} from './dom.js';
import {number} from './format.js';
import {peaksKept, valueAt} from './signals.js';
import {SvgPen} from './svg_pen.js';
import {colour, onPaper, onTheme, series} from './theme.js';

const height = 96,
  left = 58,
  right = 10,
  top = 18,
  bottom = 16; // [px]

/// 1, 2 or 5 times a power of ten, about a third of the span.
function tickOf(span) {
  const raw = span / 3,
    power = 10 ** Math.floor(Math.log10(raw)),
    head = raw / power;
  return power * (head < 1.5 ? 1 : head < 3.5 ? 2 : head < 7.5 ? 5 : 10);
}

/// With as many decimals as a step of this size can be told by.
const decimals = (step) => Math.min(6, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));

/// {node, show(t), end()}; seek(t) is called with the time of a click.
export function scenePlots(signals, times, seek) {
  const span = [times[0], times[times.length - 1]];
  const plots = signals.map((signal, k) => new Plot(signal, span, k, seek));
  const endTheme = onTheme(() => plots.forEach((plot) => plot.draw()));
  return {
    node: el(
      'div',
      {class: 'scene-plots'},
      plots.map((plot) => plot.node),
    ),
    show: (t) => plots.forEach((plot) => plot.show(t)),
    end: () => {
      endTheme();
      plots.forEach((plot) => plot.resizing.disconnect());
    },
  };
}

class Plot {
  constructor(signal, span, index, seek) {
    this.signal = signal;
    this.span = span;
    this.index = index;
    this.time = span[0];
    this.width = 0;
    this.background = document.createElement('canvas');
    this.canvas = el('canvas', {role: 'img', 'aria-label': `${signal.name} over time`});
    this.value = el('span', {class: 'note'});
    this.node = el(
      'div',
      {class: 'scene-plot'},
      el(
        'div',
        {},
        el('b', {}, signal.name),
        this.value,
        this.legend(),
        el(
          'button',
          {type: 'button', title: `Save the plot of ${signal.name} as SVG`, onclick: () => this.save()},
          'SVG',
        ),
      ),
      this.canvas,
    );
    const go = (event) => seek(this.timeAt(event.offsetX));
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) go(event);
    });
    this.resizing = new ResizeObserver(() => {
      this.width = this.canvas.clientWidth;
      this.draw();
    });
    this.resizing.observe(this.canvas);
  }

  /// Beside the plot, where no curve is in its way.
  legend() {
    const [, high] = this.range();
    return (this.signal.lines ?? []).map((line) =>
      el(
        'span',
        {class: 'note'},
        el('i', {class: 'swatch dashed limit'}),
        `${line.name} ${number(line.y)} ${this.signal.unit}${line.y > high ? ', above the plot' : ''}`,
      ),
    );
  }

  timeAt(x) {
    const [from, to] = this.span,
      share = (x - left) / (this.width - left - right);
    return from + Math.min(1, Math.max(0, share)) * (to - from);
  }

  x(t) {
    return left + ((t - this.span[0]) / (this.span[1] - this.span[0])) * (this.width - left - right);
  }

  /// With room for the lines that the study draws, if they are not out of all proportion to the signal.
  range() {
    const {y, lines = []} = this.signal;
    if (this.known) return this.known;
    const low = y.reduce((a, v) => Math.min(a, v), 0);
    let high = y.reduce((a, v) => Math.max(a, v), 0);
    for (const line of lines) if (line.y < 3 * high) high = Math.max(high, line.y);
    this.known = [low, high > low ? low + 1.06 * (high - low) : low + 1];
    return this.known;
  }

  /// What stands still while the cursor moves with play is drawn once.
  draw() {
    if (!this.width) return;
    const ratio = window.devicePixelRatio || 1;
    for (const canvas of [this.canvas, this.background]) {
      canvas.width = Math.round(this.width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const context = this.background.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.still(context);
    this.show(this.time);
  }

  /// All but the cursor.
  still(context) {
    const [low, high] = this.range(),
      y = (v) => height - bottom - ((v - low) / (high - low)) * (height - top - bottom);
    this.axes(context, low, high, y);
    this.curve(context, y);
  }

  /// With its name above it, in the colours for paper.
  save() {
    const {signal} = this,
      pen = new SvgPen(this.width, height);
    const text = onPaper(() => {
      this.still(pen);
      Object.assign(pen, {fillStyle: colour.ink, textAlign: 'left', font: 'bold 11px system-ui, sans-serif'});
      pen.fillText(
        [
          `${signal.name} [${signal.unit}]`,
          ...(signal.lines ?? []).map((line) => `${line.name} ${number(line.y)} ${signal.unit}`),
        ].join(', '),
        left,
        8,
      );
      return pen.text(colour.paper);
    });
    download(fileName(document.title, signal.name) + '.svg', text, 'image/svg+xml');
  }

  axes(context, low, high, y) {
    context.font = '11px system-ui, sans-serif';
    context.fillStyle = colour.muted;
    context.strokeStyle = colour.grid;
    context.textBaseline = 'middle';
    context.textAlign = 'right';
    const step = tickOf(high - low);
    for (let k = Math.ceil(low / step); k * step <= high; ++k) {
      context.fillText((k * step).toFixed(decimals(step)), left - 6, y(k * step));
      stroke(context, [
        [left, y(k * step)],
        [this.width - right, y(k * step)],
      ]);
    }
    context.textAlign = 'center';
    const every = tickOf((this.span[1] - this.span[0]) / 2);
    for (let k = Math.ceil(this.span[0] / every); k * every <= this.span[1]; ++k)
      context.fillText((k * every).toFixed(decimals(every)) + ' s', this.x(k * every), height - 7);
    context.strokeStyle = colour.failed;
    context.setLineDash([5, 4]);
    for (const line of this.signal.lines ?? [])
      if (line.y <= high)
        stroke(context, [
          [left, y(line.y)],
          [this.width - right, y(line.y)],
        ]);
    context.setLineDash([]);
  }

  curve(context, y) {
    const {t, y: values} = peaksKept(this.signal, this.span, Math.max(1, Math.round(this.width - left - right)));
    context.strokeStyle = series[this.index % series.length];
    context.lineWidth = 1.4;
    context.lineJoin = 'round';
    stroke(
      context,
      t.map((time, i) => [this.x(time), y(values[i])]),
    );
    context.lineWidth = 1;
  }

  show(t) {
    this.time = t;
    const [low, high] = this.range(),
      value = valueAt(this.signal, t);
    this.value.textContent =
      value === null ? '–' : `${value.toFixed(decimals((high - low) / 200))} ${this.signal.unit}`;
    if (!this.width) return;
    const ratio = window.devicePixelRatio || 1,
      context = this.canvas.getContext('2d');
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.background, 0, 0);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.strokeStyle = colour.ink;
    stroke(context, [
      [this.x(t), top - 6],
      [this.x(t), height - bottom],
    ]);
  }
}

function stroke(context, points) {
  context.beginPath();
  points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.stroke();
}

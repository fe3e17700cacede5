// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The figures of a run of several cycles: those of the run, and below them those of the cycle that is chosen.

import {cyclesOf, withBodies} from './cycle_panels.js';
import {el, figureNumber, numberAfter, select} from './dom.js';
import {fit, forget} from './plot.js';
import {endScenes} from './scene.js';

/// figures(): makes what makes a figure of a panel. A cycle's figures are made when it is chosen.
export function oneCycleAtATime(data, figures) {
  const panels = withBodies(data.illustrations),
    cycles = cyclesOf(panels);
  const whole = panels.filter((panel) => panel.cycle === undefined).map(figures());
  const before = figureNumber(),
    shown = el('div', {class: 'cycle'});
  let chosen = 0;
  const show = (k) => {
    chosen = k;
    forget(shown);
    endScenes(shown);
    numberAfter(before);
    shown.replaceChildren(...panels.filter((panel) => panel.cycle === cycles[k]).map(figures()));
    fit(shown);
    update();
  };
  const go = (by) => show(chosen + by);
  const back = el('button', {type: 'button', onclick: () => go(-1)}, 'Cycle before');
  const on = el('button', {type: 'button', onclick: () => go(1)}, 'Cycle after');
  const choice = select('Cycle', cycles.map(String), 0, show),
    box = choice.querySelector('select');
  const update = () => {
    box.value = String(chosen);
    back.disabled = chosen === 0;
    on.disabled = chosen === cycles.length - 1;
  };
  show(0);
  return el(
    'div',
    {},
    whole,
    el('div', {class: 'controls cycles'}, choice, back, on, el('span', {class: 'note'}, data.left_out)),
    shown,
  );
}

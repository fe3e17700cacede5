// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Plays a scene: button, slider, keys, speed and cameras, and the plots that go in time with it.

import {choice, el} from './dom.js';
import {number} from './format.js';
import {scenePlots} from './scene_plots.js';

const speeds = [0.25, 1, 3, 10],
  usual = 1;
const keyStep = 0.05,
  longStep = 1; // [s]
const plotStep = 250; // [ms] between two states of the plots, on a slow machine
const help = 'Space plays, the arrows go 0.05 s, with Shift 1 s, Home and End to the ends.';

/// {node, plots, end()}: the controls of a view, the plots or null, and what stops both; keys are heard in
/// `area`.
export function player(panel, times, view, area) {
  const first = times[0],
    last = times[times.length - 1];
  let t = times[panel.poster_frame ?? 0] ?? first,
    playing = false,
    speed = speeds[usual],
    before = 0,
    plotted = 0;
  const clock = el('span', {class: 'note'}),
    label = el('span', {class: 'label'});
  const slider = el('input', {
    type: 'range',
    min: first,
    max: last,
    step: 'any',
    'aria-label': 'time',
    oninput: () => seek(Number(slider.value)),
  });
  const button = el('button', {type: 'button', title: help, onclick: () => play(!playing)}, 'Play');
  const plots = panel.signals?.length ? scenePlots(panel.signals, times, (time) => seek(time)) : null;
  view.renderer.domElement.parentNode.append(label);
  const showPlots = () => {
    const now = performance.now();
    if (!plots || (playing && view.pace.level && now - plotted < plotStep)) return;
    plotted = now;
    plots.show(t);
  };
  const show = (time, draw = true) => {
    t = Math.min(last, Math.max(first, time));
    slider.value = t;
    clock.textContent = `${t.toFixed(2)} s of ${number(last)} s`;
    label.textContent = panel.frames[view.poses.place(t).k].label ?? '';
    label.hidden = !label.textContent;
    showPlots();
    if (draw) view.setTime(t);
  };
  const seek = (time) => {
    if (playing) play(false);
    show(time);
  };
  const step = (now) => {
    if (!playing) return;
    show(t + (speed * Math.min(250, now - before)) / 1000);
    before = now;
    if (t >= last) play(false);
    else requestAnimationFrame(step);
  };
  const play = (on) => {
    if (on && t >= last) t = first;
    playing = on;
    view.hurry(on);
    if (!on) showPlots();
    button.textContent = on ? 'Pause' : 'Play';
    before = performance.now();
    if (on) requestAnimationFrame(step);
  };
  area.addEventListener(
    'keydown',
    keys({play: () => play(!playing), go: (by) => seek(t + by), to: (end) => seek(end ? last : first)}),
  );
  show(t, false);
  const rate = choice(
    speeds.map((s) => s + '×'),
    (i) => {
      speed = speeds[i];
    },
    usual,
  );
  return {
    node: el('div', {class: 'player'}, button, slider, clock, rate, cameras(panel, view)),
    plots: plots?.node ?? null,
    end: () => {
      play(false);
      plots?.end();
    },
  };
}

function cameras(panel, view) {
  const presets = [
    ['Reset view', 'home'],
    ['Side', 'side'],
    ['Above', 'above'],
  ].map(([text, camera]) => el('button', {type: 'button', onclick: () => view.see(camera)}, text));
  if (panel.follow === undefined) return el('div', {class: 'choice'}, presets);
  const follow = el(
    'button',
    {
      type: 'button',
      'aria-pressed': 'false',
      title: 'The camera goes with the machine',
      onclick: () => {
        view.follow(!view.following);
        follow.setAttribute('aria-pressed', String(view.following));
      },
    },
    'Follow',
  );
  return el('div', {class: 'choice'}, presets, follow);
}

function keys({play, go, to}) {
  return (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const by = event.shiftKey ? longStep : keyStep;
    const does = {ArrowLeft: () => go(-by), ArrowRight: () => go(by), Home: () => to(false), End: () => to(true)}[
      event.key
    ];
    const space = event.key === ' ' && event.target.tagName !== 'BUTTON'; // a button hears it itself
    if (!does && !space) return;
    event.preventDefault();
    if (does) does();
    else play();
  };
}

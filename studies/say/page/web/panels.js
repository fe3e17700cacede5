// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Figures that the simulation itself supplies: a path over the pile, the pile from above, a scene to
// replay, lines, a table.

import {cyclesOf, withBodies} from './cycle_panels.js';
import {oneCycleAtATime} from './cycles.js';
import {el, figure, section} from './dom.js';
import {flat} from './flat_panels.js';
import {planView} from './plan_view.js';
import {sceneViewer} from './scene.js';

const builders = {scene: sceneViewer, plan: planView, ...flat};

/// What makes figures of panels; a note that several have is said under the first.
export function figures() {
  const said = new Set();
  return (panel) => {
    const note = panel.note && !said.has(panel.note) ? ' ' + panel.note : '';
    said.add(panel.note);
    return figure(builders[panel.type](panel), panel.caption + note, panel.title);
  };
}

/// Two in a row. make: of figures().
export function contrasts(data, {make}) {
  if (!(data.contrasts ?? []).length) return null;
  return section(
    'contrasts',
    'Runs side by side',
    'Chosen by the data of all runs: each figure says which run it is, and why.',
    el('div', {class: 'columns contrasts'}, data.contrasts.map(make)),
  );
}

export function panels(data, {make}) {
  if (!data.illustrations.length) return null;
  const node = section(
    'simulation',
    'Inside one simulation',
    'One run, looked at closely: check here whether the physics behind the figures makes sense.',
  );
  if (cyclesOf(data.illustrations).length > 1 || data.left_out) node.append(oneCycleAtATime(data, figures));
  else node.append(...withBodies(data.illustrations).map(make));
  return node;
}

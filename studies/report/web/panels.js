// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Figures that the simulation itself supplies: a path over the pile, a scene to replay, lines, a table.

import {el, figure, section} from './dom.js';
import {flat} from './flat_panels.js';
import {sceneViewer} from './scene.js';

const builders = {scene: sceneViewer, ...flat};

/// Two in a row.
export function contrasts(data) {
  if (!(data.contrasts ?? []).length) return null;
  return section('contrasts', 'Runs side by side', 'Chosen by the data of all runs: each figure says which run it is, and why.',
    el('div', {class: 'columns contrasts'}, data.contrasts.map((panel) => figure(builders[panel.type](panel), panel.caption, panel.title))));
}

export function panels(data) {
  if (!data.illustrations.length) return null;
  const node = section('simulation', 'Inside one simulation', 'One run, looked at closely: check here whether the physics behind the figures makes sense.');
  for (const panel of data.illustrations) node.append(figure(builders[panel.type](panel), panel.caption, panel.title));
  return node;
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Figures that the simulation itself supplies: a path over the pile, a scene to replay, lines, a table.

import {figure, section} from './dom.js';
import {flat} from './flat_panels.js';
import {sceneViewer} from './scene.js';

const builders = {scene: sceneViewer, ...flat};

export function panels(data) {
  if (!data.illustrations.length) return null;
  const node = section('simulation', 'Inside one simulation', 'One run, looked at closely: check here whether the physics behind the figures makes sense.');
  for (const panel of data.illustrations) node.append(figure(builders[panel.type](panel), panel.caption, panel.title));
  return node;
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Where the front may lie: the band that 5 to 95 of 100 draws of the surrogates reach in two objectives.

import {bandOutline} from './band_outline.js';
import {colour} from './theme.js';

/// The traces of the band of objectives a and b, which lie under all others; none where the front is not
/// known to be uncertain.
export function bandTraces({front}, objectives, a, b) {
  const band = front.bands.find(({first, second}) => first === a && second === b);
  if (!band) return [];
  const values = [...band.pessimistic.filter((value) => value !== null), ...front.Y.map((y) => y[b])];
  const {median, ...outline} = bandOutline(band, (objectives[b].goal === 'maximize' ? Math.min : Math.max)(...values));
  return [
    {...outline, mode: 'lines', fill: 'toself', fillcolor: colour.band, line: {width: 0}, hoverinfo: 'skip'},
    {...median, mode: 'lines', line: {color: colour.front, width: 1.2, dash: 'dot'}, hoverinfo: 'skip'},
  ];
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Places with names in a plot.

import {plain} from './format.js';
import {symbolOf} from './named.js';
import {colour} from './theme.js';

/// The trace of named places; across and up give where a place lies. On a map the names stand on paper.
export function namedTrace(places, across, up, onMap = false) {
  const shown = places.filter((place) => Number.isFinite(across(place)) && Number.isFinite(up(place)));
  const line = onMap ? '#fff' : colour.ink;
  return {
    trace: {
      x: shown.map(across),
      y: shown.map(up),
      mode: 'markers',
      name: 'named',
      text: shown.map(({name}) => plain(name)),
      hovertemplate: '%{text}<extra></extra>',
      unselected: {marker: {opacity: 1}},
      marker: {
        symbol: shown.map(symbolOf),
        size: shown.map(({recommended}) => (recommended ? 16 : 11)),
        color: shown.map(({recommended}) => (recommended ? colour.accent : line)),
        line: {color: line, width: shown.map(({recommended}) => (recommended ? 1 : 2))},
      },
    },
    annotations: shown.map((place, i) => ({
      x: across(place),
      y: up(place),
      text: plain(place.name),
      showarrow: false,
      yshift: (i % 2 === 0) === onMap ? 15 : -15, // neighbours would stand on each other
      font: {size: 11, color: colour.ink},
      bgcolor: colour.paper,
      opacity: 0.8,
      borderpad: 1,
    })),
  };
}

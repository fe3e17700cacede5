// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Places with names: the recommended one, what it is compared with, and the marks of the study and its user.

import {predictor} from './kriging.js';

/// {name, x, y, recommended}: y has what the models expect, null where nothing is known.
export function namedPlaces({answer, marks, models, problem}) {
  const expect = problem.responses.map((response, j) => {
    const surface = models[j]?.surface;
    if (!surface) return () => null;
    const mean = predictor(surface),
      {lower, upper} = response;
    return (x) => Math.min(Math.max(mean(x), lower ?? -Infinity), upper ?? Infinity);
  });
  const place = (name, x) => ({name, x, y: expect.map((of) => of(x)), recommended: false});
  const all = marks.map(({name, x}) => place(name, x));
  if (!answer.x) return all;
  const {name, x} = answer.reference;
  if (!all.some((other) => other.name === name)) all.unshift(place(name.replace('the middle of the box', 'middle'), x));
  return [{name: 'recommended', x: answer.x, y: answer.means, recommended: true}, ...all];
}

const symbols = {plus: 'cross-open', cross: 'x-open', circle: 'circle-open'};

/// Plotly's symbol of a place; the three marks of the loading study are what they are called.
export const symbolOf = ({name, recommended}) => (recommended ? 'star' : (symbols[name] ?? 'diamond-open'));

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Which variables nested contours have, and where the outer ones are held.

import {places, steps} from './steps.js';

const levels = 4;  // of an outer number

/// [inner, inner, outer, outer], the most influential within; of three variables the last is missing.
export function nestedVariables({main_pair: main, influence, problem}) {
  const weight = (k) => Math.max(0, ...influence.filter(Boolean).map((row) => row[k]));
  const others = problem.variables.map((_, k) => k).filter((k) => !main.includes(k)).sort((p, q) => weight(q) - weight(p));
  return [...main, ...others.slice(0, 2).sort((p, q) => p - q)];
}

/// Where an outer variable is held: at each value of one that has few.
export function outerLevels(v) {
  const values = v.upper - v.lower + 1;
  return v.kind && values <= levels ? places(v, values) : steps(v.lower, v.upper, levels).map((value) => (v.kind ? Math.round(value) : value));
}

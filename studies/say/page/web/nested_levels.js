// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Which variables nested contours have, where the outer ones are held, and what levels that leaves out.

import {places, steps} from './steps.js';

const levels = 4; // of an outer number

/// [inner, inner, outer, outer], the most influential within; of three variables the last is missing.
export function nestedVariables({main_pair: main, influence, problem}) {
  const weight = (k) => Math.max(0, ...influence.filter(Boolean).map((row) => row[k]));
  const others = problem.variables
    .map((_, k) => k)
    .filter((k) => !main.includes(k))
    .sort((p, q) => weight(q) - weight(p));
  return [...main, ...others.slice(0, 2).sort((p, q) => p - q)];
}

/// Of an outer category with more levels than plots: "Of tool, 4 of 6 levels are shown, without b and e."
export function leftOutText(v, name) {
  if (v.kind !== 'categorical') return '';
  const shown = new Set(outerLevels(v)),
    others = v.levels.filter((_, i) => !shown.has(i + v.lower));
  if (!others.length) return '';
  const last = others.pop();
  return (
    `Of ${name}, ${shown.size} of ${v.levels.length} levels are shown, without ` +
    `${others.length ? `${others.join(', ')} and ` : ''}${last}.`
  );
}

/// Where an outer variable is held: at each value of one that has few.
export function outerLevels(v) {
  const values = v.upper - v.lower + 1;
  return v.kind && values <= levels
    ? places(v, values)
    : steps(v.lower, v.upper, levels).map((value) => (v.kind ? Math.round(value) : value));
}

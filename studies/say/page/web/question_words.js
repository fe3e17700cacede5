// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What a study asks, in words.

import {pretty, withUnit} from './format.js';
import {own} from './responses.js';

const and = (items) => (items.length < 2 ? items.join('') : `${items.slice(0, -1).join(', ')} and ${items.at(-1)}`);
const limit = (response) =>
  `${response.goal === 'at_most' ? 'at most' : 'at least'} ${withUnit(response.limit, response)}`;

/// Of one response.
export const wanted = (response) =>
  ({minimize: 'as small as possible', maximize: 'as large as possible', record: 'recorded only'})[response.goal] ??
  limit(response);

/// "The study varies 4 variables and asks for production as large as possible, and for rock spill of at most
/// 0.2."
export function question({variables, responses}) {
  const of = (...goals) => responses.filter((r) => goals.includes(r.goal));
  const named = (goal) => (of(goal).length ? [`${and(of(goal).map((r) => pretty(r.name)))} ${wanted({goal})}`] : []);
  const sought = [...named('maximize'), ...named('minimize')],
    limits = of('at_most', 'at_least').map((r) => `${pretty(r.name)} of ${limit(r)}`);
  const asked = [...(sought.length ? [and(sought)] : []), ...(limits.length ? [and(limits)] : [])];
  const varied =
    `The study varies ` + `${variables.length === 1 ? pretty(variables[0].name) : `${variables.length} variables`}`;
  if (!asked.length) return `${varied} and records ${and(own(responses).map(({response}) => pretty(response.name)))}.`;
  return `${varied} and asks for ${asked.join(', with ')}.`;
}

/// Least and largest value of response j in the runs that succeeded, or null.
export function came(runs, j) {
  const values = runs.filter((r) => r.y).map((r) => r.y[j]);
  return values.length ? [Math.min(...values), Math.max(...values)] : null;
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Runs that break a limit of the study: their shape in plots, and the words for them.

import {pretty, withUnit} from './format.js';

export const breaksLimit = (run) => (run.breaks ?? []).length > 0;
export const anyBreaks = (runs) => runs.some(breaksLimit);

const broken = 'triangle-down-open';

/// Plotly's symbols for runs: one for all where none breaks a limit.
export const symbols = (runs, sound = 'circle') =>
  anyBreaks(runs) ? runs.map((run) => (breaksLimit(run) ? broken : sound)) : sound;

/// Plotly's sizes: an open shape needs more to be seen.
export const sizes = (runs, sound) =>
  anyBreaks(runs) ? runs.map((run) => (breaksLimit(run) ? sound + 3 : sound)) : sound;

/// For the caption of a figure; empty where no run breaks a limit.
export const legendOfLimits = (runs) => (anyBreaks(runs) ? ' An open triangle (▽) is a run that breaks a limit.' : '');

/// "breaks spill at most 0.25", or nothing.
export const brokenText = ({responses}, run) =>
  breaksLimit(run) ? 'breaks ' + run.breaks.map((j) => limitText(responses[j])).join(', ') : '';

const limitText = (response) =>
  `${pretty(response.name)} ${response.goal === 'at_most' ? 'at most' : 'at least'} ` +
  `${withUnit(response.limit, response)}`;

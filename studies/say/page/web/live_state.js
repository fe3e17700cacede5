// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the live page works out without a browser: which rows it has, curves, and how it stands with the
// server.

import {own} from './responses.js';

/// Points that a plot shows, the latest.
export const mostPoints = 3000;

export const nothingKept = {epoch: '', since: 0, rows: []};

/// What to ask the server for, having these rows.
export const question = ({epoch, since}) => `/state.json?epoch=${encodeURIComponent(epoch)}&since=${since}`;

/// The rows with those of an answer: kept on within an epoch, begun anew in another.
export function keep(kept, {epoch, from, rows}) {
  if (epoch === undefined) return kept;
  const goesOn = epoch === kept.epoch && from === kept.since;
  if (goesOn && !rows.length) return kept;
  const all = goesOn ? [...kept.rows, ...rows] : rows;
  return {epoch, since: from + rows.length, rows: all.slice(-mostPoints)};
}

/// Whether the server has more rows than the page.
export const lags = (kept, {ended}) => ended !== undefined && kept.since < ended;

/// Best so far over the number of runs that have ended: steps through improvements [ended, run, value], up to
/// now.
export function curve(improvements, ended) {
  const x = improvements.map(([at]) => at),
    y = improvements.map(([, , value]) => value),
    runs = improvements.map(([, run]) => run);
  if (x.length && ended > x[x.length - 1]) {
    x.push(ended);
    y.push(y[y.length - 1]);
    runs.push(runs[runs.length - 1]);
  }
  return {x, y, runs};
}

/// Runs in each state, all kinds together.
export function totals(counts) {
  const sum = {done: 0, failed: 0, running: 0, planned: 0};
  for (const kind of Object.values(counts)) for (const state of Object.keys(sum)) sum[state] += kind[state];
  return sum;
}

const two = (value) => String(value).padStart(2, '0');

/// Local time of day; another day is named.
export function clock(date, today = new Date()) {
  const time = `${two(date.getHours())}:${two(date.getMinutes())}`;
  return date.toDateString() === today.toDateString()
    ? time
    : `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())} ${time}`;
}

/// heard: when the server answered last, or null. Empty while connected.
export function connection(heard, connected, now = new Date()) {
  if (connected) return '';
  if (!heard) return 'The server does not answer. Is the command live still running?';
  return (
    `No longer connected since ${clock(heard, now)}: what stands below is how it was then. The study ` +
    `itself may go on; start the command live again, on the same port, to follow it here.`
  );
}

/// Until the next question [ms]: quickly while there is more, slowly where nothing happens.
export function pause(kind, connected, more) {
  if (!connected) return 5000;
  if (more) return 0;
  return kind === 'working' || kind === 'absent' ? 2000 : 5000;
}

/// The axes that runs can be shown along: name as of a variable or response, and the value of a row.
export function axesOf({variables, responses}) {
  return [
    ...own(responses).map(({response: item, j}) => ({item, of: ([, , , y]) => (y ? y[j] : null)})),
    ...variables.map((item, k) => ({item, of: ([, , x]) => x[k]})),
    {item: {name: 'run', unit: '1'}, of: ([run]) => run},
  ];
}

/// Which two of these a study's runs are shown along first: two objectives, or one over the runs.
/** @type {(problem: any) => number[]} */
export function firstAxes(problem) {
  const axes = axesOf(problem),
    objectives = axes.map(({item}, i) => (/^(min|max)imize$/.test(item.goal) ? i : -1)).filter((i) => i >= 0);
  if (objectives.length >= 2) return [objectives[0], objectives[1]];
  return [axes.length - 1, objectives[0] ?? 0];
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The live page's tables and figures in words: progress, best runs, failures, the last run.

import {el} from './dom.js';
import {labelled, number, pretty, setting, settingWithUnit, withUnit} from './format.js';
import {clock, totals} from './live_state.js';
import {own} from './responses.js';
import {runTables} from './run_tables.js';
import {table} from './table.js';

const card = (label, value, note = null, unit = null) =>
  el(
    'div',
    {class: 'card'},
    el('span', {class: 'label'}, label),
    el('span', {class: 'value'}, value, unit ? el('small', {}, ' ' + unit) : null),
    note ? el('span', {class: 'note'}, note) : null,
  );

/// The number of a run, and the way to its page where runs have logs.
const runLink = (run, state) =>
  state.logged === null ? String(run) : el('a', {href: '/run/' + run, target: '_blank', rel: 'noopener'}, String(run));

export function standing({standing: {kind, text, next}, program, folder}) {
  const words = {
    absent: 'waiting',
    unreadable: 'not readable',
    working: 'at work',
    stopped: 'stopped',
    ended: 'finished',
  };
  return el(
    'div',
    {class: 'block standing ' + kind},
    el('p', {}, el('span', {class: 'grade'}, words[kind]), ' ' + text),
    next ? el('p', {class: 'next'}, el('code', {}, `${program} ${next}`)) : null,
    el('p', {class: 'note'}, 'Folder: ' + folder),
  );
}

export function progress(state) {
  const sum = totals(state.counts),
    ended = sum.done + sum.failed;
  const share = (count) => (state.total ? `width:${(100 * count) / state.total}%` : 'width:0');
  const bar = el(
    'div',
    {class: 'bar', role: 'img', 'aria-label': state.progress},
    ['done', 'failed', 'running'].map((name) => el('span', {class: name, style: share(sum[name])})),
  );
  const kinds = Object.entries(state.counts).filter(([, of]) => Object.values(of).some((n) => n > 0));
  const states = ['done', 'failed', 'running', 'planned'];
  return [
    el(
      'div',
      {class: 'cards narrow'},
      card(
        'Runs ended',
        String(ended),
        `${sum.running} running or waiting, ${sum.planned} planned`,
        'of ' + state.total,
      ),
      card(
        'Failed',
        String(sum.failed),
        ended ? `${number((100 * sum.failed) / ended, 2)} % of those that ended` : null,
      ),
      ...(state.runs_per_hour === null
        ? []
        : [
            card('Pace', number(state.runs_per_hour), 'runs, since the first of the command at work', 'per hour'),
            card('To go', state.left, 'for the runs that are planned, at this pace'),
          ]),
      card('Time in runs', state.time, 'of all processes together'),
    ),
    el(
      'div',
      {class: 'block'},
      bar,
      table(
        [{title: 'Kind', text: true}, ...states.map((title) => ({title, format: String}))],
        kinds.map(([kind, of]) => [kind, ...states.map((name) => of[name])]),
        {sortable: false},
      ).node,
    ),
  ];
}

const design = (x, variables) => variables.map((v, k) => `${pretty(v.name)} ${settingWithUnit(x[k], v)}`).join(', ');
const goals = {minimize: 'smallest', maximize: 'largest', at_most: 'at most', at_least: 'at least', record: 'recorded'};

/// One run with what it may as well have given, by its own standard error.
function lucky(value, r, error) {
  if (!(error > 0)) return withUnit(value, r);
  const ends = [-1.96, 1.96].map((by) =>
    Math.min(Math.max(value + by * error, r.lower ?? -Infinity), r.upper ?? Infinity),
  );
  return `${withUnit(value, r)} (${number(ends[0])} to ${number(ends[1])} with 95 %)`;
}

export function best(state) {
  const {variables, responses} = state.problem;
  const rows = own(responses).map(({response: r, j}) => {
    const {lowest, highest, done, within, best: found, best_error: error} = state.responses[j];
    const span = done ? `${number(lowest)} to ${number(highest)}` : 'none yet';
    if (r.limit != null)
      return [labelled(r), `${goals[r.goal]} ${number(r.limit)}`, `kept by ${within} of ${done}`, '', span, ''];
    if (!found) return [labelled(r), goals[r.goal], r.goal === 'record' ? '' : 'none yet', '', span, ''];
    const [run, , x, y] = found;
    return [labelled(r), goals[r.goal], lucky(y[j], r, error), runLink(run, state), span, design(x, variables)];
  });
  const columns = ['Response', 'Wanted', 'Luckiest run so far', 'Run', 'All runs', 'At'].map((title) => ({
    title,
    text: true,
  }));
  return el('div', {class: 'block'}, table(columns, rows, {sortable: false}).node);
}

export function failures(state) {
  if (!state.failures.length) return el('p', {class: 'note'}, 'No run has failed.');
  const rows = state.failures.map(({reason, times, run}) => [times, runLink(run, state), reason]);
  return el(
    'div',
    {class: 'block'},
    table([{title: 'Times', format: String}, {title: 'Last run'}, {title: 'Message', text: true}], rows, {
      sortable: false,
    }).node,
    state.more_failures
      ? el('p', {class: 'note'}, `${state.more_failures} more messages are left out; the command status has them all.`)
      : null,
  );
}

export function running(state) {
  const {variables} = state.problem;
  if (!state.running.length) return null;
  const rows = state.running.map(({run, kind, x, started}) => [run, kind, ...x, clock(new Date(started))]);
  return el(
    'details',
    {class: 'block'},
    el('summary', {}, `Running or waiting now: ${totals(state.counts).running}`),
    table(
      [
        {title: 'Run', format: String},
        {title: 'Kind', text: true},
        ...variables.map((v) => ({title: labelled(v), format: (value) => setting(value, v)})),
        {title: 'Since', text: true},
      ],
      rows,
      {sortable: false, tall: true},
    ).node,
  );
}

export function last(state) {
  if (!state.last) return el('p', {class: 'note'}, 'No run has ended yet.');
  const {run, kind, x, y, reason, seconds, finished} = state.last;
  const [inputs, outputs] = runTables({x, y}, state.problem);
  return el(
    'div',
    {class: 'block'},
    el(
      'p',
      {},
      'Run ',
      runLink(run, state),
      `, ${kind}, ended at ${clock(new Date(finished))} after ${number(seconds)} s.`,
    ),
    y === null ? el('p', {class: 'caution'}, 'It failed: ' + reason) : null,
    el('div', {class: 'columns'}, inputs.node, outputs.node),
  );
}

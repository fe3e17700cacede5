// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The live page of a study: asks its server how the study stands, again and again, and shows it.

import {el, section} from './dom.js';
import {pageHeader} from './header.js';
import {lastFigures} from './live_figures.js';
import {bestPlots, runsPlot} from './live_plots.js';
import {connection, keep, lags, nothingKept, pause, question} from './live_state.js';
import {best, failures, last, progress, running, standing} from './live_tables.js';

const patience = 15000; // with an answer [ms]
const page = document.getElementById('live');
const note = el('p', {class: 'caution', role: 'status', hidden: true});
const content = el('div');
let kept = nothingKept,
  heard = null,
  parts = null;

/// An element whose content is built anew when what it shows has changed.
function slot(build) {
  const node = el('div');
  let before = null;
  const update = (state, ...shown) => {
    const now = JSON.stringify(shown);
    if (now === before) return;
    before = now;
    node.replaceChildren(...[build(state)].flat().filter(Boolean));
  };
  return {node, update};
}

/// The page of a study that is there; one that has come anew begins a page anew.
function layOut(state) {
  const key = JSON.stringify(state.problem);
  if (parts?.key === key) return;
  const of = {
    standing: slot(standing),
    progress: slot(progress),
    best: slot(best),
    failures: slot(failures),
    running: slot(running),
    last: slot(last),
  };
  parts = {
    key,
    of,
    curves: bestPlots(state.problem),
    runs: runsPlot(state.problem),
    figures: lastFigures(),
    rows: null,
    ended: -1,
  };
  content.replaceChildren(
    of.standing.node,
    section('progress', 'Progress', null, of.progress.node, of.running.node),
    section(
      'best',
      'Luckiest runs so far',
      'Single runs, as simulated; objectives among the runs that keep all limits. The best of many runs that scatter ' +
        'looks better than its strategy is: what the models expect there, the report says.',
      of.best.node,
      el('div', {class: 'block'}, parts.curves.node),
    ),
    section('runs', 'The runs', null, el('div', {class: 'block'}, parts.runs.node)),
    section('failures', 'Failures', null, of.failures.node),
    section('last', 'The last run', null, of.last.node, parts.figures.node),
  );
}

function showStudy(state) {
  layOut(state);
  const {of, curves, runs, figures} = parts;
  of.standing.update(state, state.standing);
  of.progress.update(state, state.progress, state.counts, state.runs_per_hour, state.time);
  of.best.update(state, state.responses, state.logged !== null);
  of.failures.update(state, state.failures);
  of.running.update(state, state.running);
  of.last.update(state, state.last);
  if (parts.ended !== state.epoch + state.ended) curves.update(state);
  if (parts.rows !== kept.rows) runs.update(kept.rows, state.last?.run ?? null);
  Object.assign(parts, {ended: state.epoch + state.ended, rows: kept.rows});
  figures.update(state.logged);
  const {total} = state;
  document.title = `${state.progress.match(/^\d+/)[0]}/${total} ${state.study}, live`;
}

function show(state) {
  if (!page.querySelector('header'))
    page.replaceChildren(pageHeader('Drawpoint study, live', state.study, state.about), el('main', {}, note, content));
  kept = keep(kept, state);
  if (state.problem) return showStudy(state);
  parts = null;
  content.replaceChildren(standing(state));
  document.title = `${state.study}, live`;
}

function tellConnection(connected) {
  const text = connection(heard, connected);
  if (!connected && !page.contains(note)) page.replaceChildren(el('main', {}, note, content));
  note.hidden = text === '';
  note.textContent = text;
  content.classList.toggle('stale', !connected);
  if (!connected) document.title = 'Not connected: ' + document.title.replace(/^Not connected: /, '');
}

async function ask() {
  let answer = null;
  try {
    const response = await fetch(question(kept), {signal: AbortSignal.timeout(patience)});
    if (!response.ok) throw new Error(await response.text());
    answer = await response.json();
    heard = new Date();
  } catch {
    // tellConnection says it
  }
  if (answer) show(answer);
  tellConnection(answer !== null);
  setTimeout(ask, pause(answer?.standing.kind, answer !== null, answer !== null && lags(kept, answer)));
  document.documentElement.dataset.ready = 'true';
}

ask();

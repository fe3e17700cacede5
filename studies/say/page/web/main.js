// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Assembles the page from the data embedded in it: the report of a study, or the replay of one run.

import {answer, besidesTheScene} from './answer.js';
import {choose} from './choice.js';
import {collect} from './designs.js';
import {header, navigation, facts} from './summary.js';
import {findings} from './findings.js';
import {foldOnNarrow} from './fold.js';
import {hauls} from './haul.js';
import {contrasts, figures, panels} from './panels.js';
import {asked} from './question.js';
import {oneRun} from './replay.js';
import {tradeOffs} from './front.js';
import {parallelCoordinates} from './parallel.js';
import {surfaces} from './surfaces.js';
import {validation} from './validation.js';
import {runs} from './runs.js';
import {selecting} from './selection.js';
import {selectionBar} from './selection_bar.js';
import {trust} from './trust.js';

const data = JSON.parse(document.getElementById('report-data').textContent);
const page = document.getElementById('report');
/// What the sections of a report share; rows: by set of designs, what shows the row of one in its table.
/** @type {any} */
const shared = {make: figures(), ...(data.replay ? {} : sharing(collect(data)))};

function sharing(designs) {
  return {designs, chosen: choose(data, designs), selection: selecting(designs), rows: {}};
}

/// A section that cannot be drawn says so and leaves the others standing.
function attempt(build) {
  try {
    return build(data, shared);
  } catch (error) {
    console.error(error);
    const note = document.createElement('p');
    note.className = 'caution';
    note.textContent = 'A part of this report could not be drawn: ' + error.message;
    return note;
  }
}

const builders = data.replay
  ? [oneRun, panels, facts]
  : [
      answer,
      tradeOffs,
      contrasts,
      (all, of) => panels(besidesTheScene(all), of),
      surfaces,
      hauls,
      parallelCoordinates,
      trust,
      validation,
      findings,
      runs,
      asked,
      facts,
    ];
const behind = ['surfaces', 'haul', 'designs', 'trust', 'surrogates', 'findings', 'runs', 'study', 'making'];
const sections = builders.map(attempt).filter(Boolean);
page.replaceChildren(
  header(data),
  navigation(sections.filter((s) => s.id)),
  Object.assign(document.createElement('main'), {id: 'main'}),
  data.replay ? '' : selectionBar(shared),
);
document.getElementById('main').append(...sections);
if (!data.replay) foldOnNarrow(sections, behind);
window.dispatchEvent(new Event('resize'));
document.documentElement.dataset.ready = 'true';

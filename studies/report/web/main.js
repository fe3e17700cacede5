// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Assembles the page from the data embedded in it: the report of a study, or the replay of one run.

import {choose} from './choice.js';
import {summary, header, navigation, facts} from './summary.js';
import {findings} from './findings.js';
import {panels} from './panels.js';
import {oneRun} from './replay.js';
import {tradeOffs} from './front.js';
import {surfaces} from './surfaces.js';
import {validation} from './validation.js';
import {fitPlotsToPrint} from './plot.js';
import {runs} from './runs.js';

const data = JSON.parse(document.getElementById('report-data').textContent);
const page = document.getElementById('report');
const chosen = choose(data);

/// A section that cannot be drawn says so and leaves the others standing.
function attempt(build) {
  try {
    return build(data, chosen);
  } catch (error) {
    console.error(error);
    const note = document.createElement('p');
    note.className = 'caution';
    note.textContent = 'A part of this report could not be drawn: ' + error.message;
    return note;
  }
}

const builders = data.replay ? [oneRun, panels, facts] : [summary, findings, panels, tradeOffs, surfaces, validation, runs, facts];
const sections = builders.map(attempt).filter(Boolean);
page.replaceChildren(header(data), navigation(sections.filter((s) => s.id)), Object.assign(document.createElement('main'), {id: 'main'}));
document.getElementById('main').append(...sections);
fitPlotsToPrint();
window.dispatchEvent(new Event('resize'));
document.documentElement.dataset.ready = 'true';

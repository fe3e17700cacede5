// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Head of the page, the way to its sections, and how it was made.

import {certificate} from './front.js';
import {el, section} from './dom.js';
import {pageHeader} from './header.js';

export const header = (data) =>
  pageHeader(data.replay ? 'Drawpoint replay of a run' : 'Drawpoint study report', data.study, data.about);

/// Names of sections that fit side by side.
const short = {
  summary: 'Answer',
  front: 'Trade-off',
  contrasts: 'Good and bad',
  simulation: 'One run',
  surfaces: 'Surfaces',
  haul: 'Haul',
  designs: 'Designs',
  trust: 'Trust',
  surrogates: 'Validation',
  findings: 'Findings',
  runs: 'Runs',
  study: 'Question',
  making: 'Making',
};

export function navigation(sections) {
  return el(
    'nav',
    {'aria-label': 'Sections'},
    el(
      'div',
      {class: 'inner'},
      sections.map((s) => el('a', {href: '#' + s.id}, short[s.id] ?? s.querySelector('h2').textContent)),
    ),
  );
}

const card = ({label, value, unit, note}) =>
  el(
    'div',
    {class: 'card'},
    el('span', {class: 'label'}, label),
    el('span', {class: 'value'}, value, unit ? el('small', {}, ' ' + unit) : null),
    el('span', {class: 'note'}, note),
  );

/// Figures that tell what the runs are worth, folded.
function tiles({cards}) {
  if (!cards.length) return null;
  return el(
    'details',
    {class: 'block more'},
    el('summary', {}, 'The runs in figures'),
    el('div', {class: 'cards'}, cards.map(card)),
  );
}

export function facts(data) {
  const rows = [...data.facts];
  const search = data.polishing ? certificate(data.polishing) : '';
  if (search) rows.push(['Search for the front', search]);
  if (data.command) rows.unshift(['Command', el('code', {}, data.command)]);
  return section(
    'making',
    'How it was made',
    null,
    rows.length
      ? el('dl', {class: 'facts'}, rows.map(([label, value]) => [el('dt', {}, label), el('dd', {}, value)]).flat())
      : null,
    data.summary ? tiles(data.summary) : null,
  );
}

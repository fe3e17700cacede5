// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Head of the page and the summary in words. The sentences come ready in the data.

import {certificate} from './front.js';
import {el, section} from './dom.js';
import {pageHeader} from './header.js';

export const header = (data) =>
  pageHeader(data.replay ? 'Drawpoint replay of a run' : 'Drawpoint study report', data.study, data.about);

export function navigation(sections) {
  return el(
    'nav',
    {'aria-label': 'Sections'},
    el(
      'div',
      {class: 'inner'},
      sections.map((s) => el('a', {href: '#' + s.id}, s.querySelector('h2').textContent)),
    ),
  );
}

export function summary(data) {
  const {cards, sentences, trust, cautions, next} = data.summary;
  return section(
    'summary',
    'In brief',
    null,
    sentences.map((text) => el('p', {class: 'sentence'}, text)),
    el(
      'div',
      {class: 'columns'},
      el('div', {}, el('h3', {}, 'How far to trust it'), el('ul', {class: 'trust'}, trust.map(verdict))),
      cautions.length
        ? el(
            'div',
            {},
            el('h3', {}, 'Cautions'),
            el(
              'ul',
              {class: 'cautions'},
              cautions.map((text) => el('li', {}, text)),
            ),
          )
        : null,
    ),
    next.length ? el('div', {}, el('h3', {}, 'What to do next'), el('ol', {class: 'next'}, next.map(step))) : null,
    cards.length ? el('div', {class: 'cards'}, cards.map(card)) : null,
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

const step = ({text, command}) => el('li', {}, text, command ? [' ', el('code', {}, command)] : null);

const verdict = ({response, grade, text}) =>
  el('li', {}, el('span', {class: 'grade ' + grade}, grade), el('span', {}, el('b', {}, response), ' ' + text));

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
  );
}

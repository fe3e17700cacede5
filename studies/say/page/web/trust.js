// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How far to trust the models: grades, cautions, what to do next, and what else there is to say, folded.

import {el, section} from './dom.js';

export function trust(data) {
  const {sentences, trust: grades, cautions, next} = data.summary;
  return section(
    'trust',
    'How far to trust it',
    null,
    el(
      'div',
      {class: 'columns'},
      el('ul', {class: 'trust'}, grades.map(verdict)),
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
    sentences.length
      ? el(
          'details',
          {class: 'block more'},
          el('summary', {}, 'In more words'),
          sentences.map((text) => el('p', {class: 'sentence'}, text)),
        )
      : null,
  );
}

const step = ({text, command}) => el('li', {}, text, command ? [' ', el('code', {}, command)] : null);

const verdict = ({response, grade, text}) =>
  el('li', {}, el('span', {class: 'grade ' + grade}, grade), el('span', {}, el('b', {}, response), ' ' + text));

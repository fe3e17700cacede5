// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What was asked, before what came out: the variables with their ranges, the responses with what is wanted of
// them and what the runs gave.

import {el, section} from './dom.js';
import {labelled, number, setting} from './format.js';
import {came, question, wanted} from './question_words.js';
import {own} from './responses.js';
import {table} from './table.js';

export function asked(data, {designs}) {
  const {variables, responses} = data.problem;
  const inputs = list('Variable', variables, [
    ['Values', (v) => (v.levels ? v.levels.join(', ') : span(setting(v.lower, v), setting(v.upper, v)))],
  ]);
  const outputs = list(
    'Response',
    own(responses).map(({response, j}) => ({...response, j})),
    [
      ['Wanted', wanted],
      ['Runs gave', ({j}) => range(came(designs.runs, j))],
    ],
  );
  return section(
    'study',
    'The study',
    question(data.problem),
    el('div', {class: 'block columns compact'}, inputs, outputs),
  );
}

const span = (low, high) => `${low}\u00a0to\u00a0${high}`; // on one line
const range = (ends) => (ends ? span(...ends.map((value) => number(value))) : 'nothing');

/// What an item is stands last, where any has a description.
function list(title, items, more) {
  const columns = [
    [title, labelled],
    ...more,
    ...(items.some((item) => item.description) ? [['What it is', (item) => item.description ?? '']] : []),
  ];
  return table(
    columns.map(([head]) => ({title: head, text: true})),
    items.map((item, i) => columns.map(([, of]) => of(item, i))),
    {sortable: false},
  ).node;
}

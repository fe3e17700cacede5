// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What is claimed about the black box, and what the runs say to it.

import {el, section} from './dom.js';
import {table} from './table.js';

export function findings(data) {
  if (!data.findings.length) return null;
  const columns = ['Finding', 'Claim', 'Verdict', 'Grounds'].map((title) => ({title, text: true}));
  return section(
    'findings',
    'Findings',
    'Claims held against all runs of the study. What decides is given with two standard errors; unclear: the ' +
      'runs do not tell.',
    el('div', {class: 'block'}, table(columns, data.findings, {name: 'Findings'}).node),
  );
}

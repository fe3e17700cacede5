// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Above a table: a box to filter its rows, and buttons that copy or download those that are left.

import {copy, csv, download, fileName, tsv} from './delimited.js';
import {el} from './dom.js';

/// rows(): head and rows as values. Returns {node, update(count of rows)}.
export function tableTools(name, {onfilter, rows}) {
  const box = el('input', {
    type: 'search',
    placeholder: 'Filter',
    'aria-label': `Filter the table ${name}`,
    oninput: () => onfilter(box.value),
  });
  const said = el('span', {class: 'note', role: 'status'});
  const say = (text) => {
    said.textContent = text;
    setTimeout(() => {
      if (said.textContent === text) said.textContent = '';
    }, 3000);
  };
  const copying = el('button', {
    type: 'button',
    onclick: async () => say((await copy(tsv(rows()))) ? 'Copied' : 'The browser does not allow copying'),
  });
  const saving = el('button', {
    type: 'button',
    onclick: () => download(fileName(document.title, name) + '.csv', csv(rows()), 'text/csv'),
  });
  const update = (count) => {
    const text = `${count} ${count === 1 ? 'row' : 'rows'}`;
    copying.textContent = 'Copy ' + text;
    saving.textContent = `Download ${text} as CSV`;
    copying.disabled = saving.disabled = count === 0;
  };
  const clear = () => {
    box.value = '';
    onfilter('');
  };
  return {node: el('div', {class: 'tools'}, box, copying, saving, said), update, clear};
}

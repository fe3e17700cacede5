// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Elements from data. Text always goes in as text nodes, so no name, reason or caption can become markup.

export function el(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

export function section(id, title, lead, ...children) {
  return el('section', {id}, el('h2', {}, title), lead ? el('p', {class: 'lead'}, lead) : null, ...children);
}

let figures = 0;

export function figure(content, caption, title = null) {
  figures += 1;
  return el('figure', {}, title ? el('h3', {}, title) : null, content,
    el('figcaption', {}, el('b', {}, `Figure ${figures}. `), caption));
}

export function select(label, options, chosen, onchange) {
  const box = el('select', {onchange: () => onchange(Number(box.value))},
    options.map((text, i) => el('option', {value: i, selected: i === chosen}, text)));
  return el('label', {class: 'control'}, label, box);
}

/// A row of mutually exclusive buttons.
export function choice(labels, onchoose) {
  const buttons = labels.map((label, i) => el('button', {type: 'button', 'aria-pressed': String(i === 0), onclick: () => {
    buttons.forEach((b, k) => b.setAttribute('aria-pressed', k === i));
    onchoose(i);
  }}, label));
  return el('div', {class: 'choice', role: 'group'}, buttons);
}

const order = (a, b) => {
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  if (typeof a === 'number') return -1;
  if (typeof b === 'number') return 1;
  return String(a).localeCompare(String(b), undefined, {numeric: true});
};

/// columns: [{title, format?}], rows: arrays of values. A click on a head sorts; onselect(index into rows) makes the
/// rows selectable. Returns {node, select(index)}.
export function table(columns, rows, {onselect = null, sortable = true, tall = false} = {}) {
  const body = el('tbody');
  const lines = rows.map((row, i) => el('tr',
    onselect ? {tabindex: 0, onclick: () => onselect(i),
                onkeydown: (e) => { if (e.key === 'Enter' || e.key === ' ') { e.preventDefault(); onselect(i); } }} : {},
    row.map((value, c) => cell(value, columns[c]))));
  body.append(...lines);
  let sorted = null;
  const sort = (c, head) => {
    const down = sorted === c;
    sorted = down ? null : c;
    const permutation = rows.map((_, i) => i).sort((a, b) => (down ? -1 : 1) * order(rows[a][c], rows[b][c]));
    body.append(...permutation.map((i) => lines[i]));
    head.parentNode.querySelectorAll('th').forEach((th) => th.removeAttribute('aria-sort'));
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
  };
  const heads = columns.map((column, c) => {
    const head = el('th', {scope: 'col', class: column.text ? 'text' : null});
    if (sortable) head.append(el('button', {type: 'button', onclick: () => sort(c, head)}, column.title));
    else head.append(column.title);
    return head;
  });
  const node = el('div', {class: tall ? 'table tall' : 'table'},
    el('table', {class: onselect ? 'selectable' : null}, el('thead', {}, el('tr', {}, heads)), body));
  const mark = (index) => lines.forEach((line, i) => line.toggleAttribute('data-selected', i === index));
  return {node, select: mark};
}

function cell(value, column = {}) {
  if (value instanceof Node) return el('td', {class: column.text ? 'text' : null}, value);
  const shown = typeof value === 'number' && column.format ? column.format(value) : value;
  return el('td', {class: column.text ? 'text' : null}, shown === null ? 'n/a' : String(shown));
}

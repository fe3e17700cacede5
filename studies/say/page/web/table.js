// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Tables: sorted by a click on a head, filtered, marked, dimmed by the selection. Only one page of the rows
// is in the document.

import {el} from './dom.js';
import {tableTools} from './table_tools.js';

const pageSize = 100;
const printed = 12; // rows on paper; style.css hides the others

const order = (a, b) => {
  if (Array.isArray(a) && Array.isArray(b)) return order(a[0], b[0]);
  if (typeof a === 'number' && typeof b === 'number') return a - b;
  if (typeof a === 'number') return -1;
  if (typeof b === 'number') return 1;
  return String(a ?? '').localeCompare(String(b ?? ''), undefined, {numeric: true});
};

/// columns: [{title, format?, text?, missing?, parts?, control?}]; rows: arrays of values, or of {value, shown}
/// with a text of their own. parts: [{title, of(value)}] are the columns that a copy has in place of this one;
/// control(row index) gives an element and is no value. name: of the table, gives it the tools to filter and
/// copy. onpick(row index) makes the rows selectable. passes(row index) tells whether a row is selected. Returns
/// {node, mark(row index), show(row index), refresh()}.
export function table(columns, rows, {name = null, onpick = null, passes = null, sortable = true, tall = false} = {}) {
  const body = el('tbody'),
    cut = el('p', {class: 'note cut'});
  const heads = columns.map((column, c) => head(column, sortable && !column.control ? () => sort(c) : null));
  const frame = el(
    'div',
    {
      class: tall ? 'table tall' : 'table',
      tabindex: tall ? 0 : null,
      role: tall ? 'region' : null,
      'aria-label': tall ? (name ?? 'Table') : null,
    },
    el('table', {class: onpick ? 'selectable' : null}, el('thead', {}, el('tr', {}, heads)), body),
  );
  const sorted = rows.map((_, i) => i);
  let by = null,
    down = false,
    wanted = '',
    shown = sorted,
    first = 0,
    marked = -1,
    texts = null;

  const sort = (c) => {
    down = by === c && !down;
    by = c;
    sorted.sort((a, b) => (down ? -1 : 1) * order(rows[a][c], rows[b][c]) || a - b);
    heads.forEach((h) => h.removeAttribute('aria-sort'));
    heads[c].setAttribute('aria-sort', down ? 'descending' : 'ascending');
    refresh();
  };
  const text = (i) => {
    texts ??= [];
    return (texts[i] ??= columns
      .map((column, c) => (column.control ? '' : said(rows[i][c], column)))
      .join('\n')
      .toLowerCase());
  };
  const passing = () => {
    const found = wanted ? sorted.filter((i) => text(i).includes(wanted)) : sorted;
    if (!passes) return [found, found];
    const inside = found.filter(passes);
    return [inside.length === found.length ? found : [...inside, ...found.filter((i) => !passes(i))], inside];
  };
  const exported = () => [
    columns.flatMap((column) => (column.control ? [] : (column.parts?.map((p) => p.title) ?? [column.title]))),
    ...passing()[1].map((i) =>
      columns.flatMap((column, c) =>
        column.control ? [] : (column.parts?.map((p) => p.of(rows[i][c])) ?? [raw(rows[i][c])]),
      ),
    ),
  ];
  const tools =
    name === null
      ? null
      : tableTools(name, {
          onfilter: (value) => {
            wanted = value.trim().toLowerCase();
            refresh();
          },
          rows: exported,
        });
  const pages = pager((step) => {
    first += step * pageSize;
    draw();
    frame.scrollTop = 0;
  });

  const line = (i) =>
    el(
      'tr',
      {
        'data-row': i,
        'data-selected': i === marked,
        class: passes && !passes(i) ? 'dimmed' : null,
        tabindex: onpick ? 0 : null,
      },
      columns.map((column, c) =>
        el(
          'td',
          {class: column.text ? 'text' : null},
          column.control ? column.control(i) : content(rows[i][c], column),
        ),
      ),
    );
  const draw = () => {
    const last = Math.min(shown.length, first + pageSize);
    body.replaceChildren(...shown.slice(first, last).map(line));
    pages.update(first, last, shown.length, pageSize);
    cut.hidden = last - first <= printed;
    cut.textContent = `On paper: ${printed} of ${shown.length} rows; the page on screen has them all.`;
  };
  const refresh = () => {
    const [all, inside] = passing();
    shown = all;
    first = 0;
    tools?.update(inside.length);
    draw();
  };
  const mark = (index) => {
    marked = index;
    body.querySelectorAll('tr').forEach((tr) => tr.toggleAttribute('data-selected', Number(tr.dataset.row) === index));
  };
  const show = (index) => {
    if (!shown.includes(index)) tools?.clear();
    const page = Math.floor(shown.indexOf(index) / pageSize) * pageSize;
    if (page !== first) {
      first = page;
      draw();
    }
    scrollTo(frame, body.querySelector(`tr[data-row="${index}"]`), heads[0]);
  };
  if (onpick) pickRows(body, onpick);
  refresh();
  return {node: el('div', {class: 'whole-table'}, tools?.node, frame, pages.node, cut), mark, show, refresh};
}

function head(column, onclick) {
  return el(
    'th',
    {scope: 'col', class: column.text ? 'text' : null},
    onclick ? el('button', {type: 'button', onclick}, column.title) : column.title,
  );
}

function pickRows(body, onpick) {
  const pick = (e) => {
    const row = e.target.closest('tr');
    if (row && !e.target.closest('input')) {
      e.preventDefault();
      onpick(Number(row.dataset.row));
    }
  };
  body.addEventListener('click', pick);
  body.addEventListener('keydown', (e) => {
    if (e.key === 'Enter' || e.key === ' ') pick(e);
  });
}

/// Within the frame only: the page stays where the reader is.
function scrollTo(frame, row, head) {
  const above = head.offsetHeight,
    top = row.offsetTop - above;
  if (top < frame.scrollTop || row.offsetTop + row.offsetHeight > frame.scrollTop + frame.clientHeight)
    frame.scrollTop = top - above;
}

function pager(onstep) {
  const where = el('span', {class: 'note'});
  const back = el('button', {type: 'button', 'aria-label': 'Rows before', onclick: () => onstep(-1)}, '‹');
  const on = el('button', {type: 'button', 'aria-label': 'Rows after', onclick: () => onstep(1)}, '›');
  const node = el('div', {class: 'pager'}, back, where, on);
  const update = (first, last, count, size) => {
    node.hidden = count <= size;
    where.textContent = `rows ${first + 1} to ${last} of ${count}`;
    back.disabled = first === 0;
    on.disabled = last >= count;
  };
  return {node, update};
}

/** @type {(value: any, column?: {format?: (value: number) => string, missing?: string}) => string} */
function said(value, {format, missing = 'n/a'} = {}) {
  if (value instanceof Node) return value.textContent;
  if (value === null || value === undefined) return missing;
  if (value.shown !== undefined) return value.shown;
  return format && typeof value !== 'string' ? format(value) : String(value);
}

const content = (value, column) => (value instanceof Node ? value : said(value, column));
const raw = (value) => (value instanceof Node ? value.textContent : value?.shown === undefined ? value : value.value);

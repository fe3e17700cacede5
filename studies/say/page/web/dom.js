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

/// Of the figure that was made last; the next one has the number after it.
export const figureNumber = () => figures;
export const numberAfter = (number) => {
  figures = number;
};

export function figure(content, caption, title = null) {
  figures += 1;
  return el(
    'figure',
    {},
    title ? el('h3', {}, title) : null,
    content,
    el('figcaption', {}, el('b', {}, `Figure ${figures}. `), caption),
  );
}

export function select(label, options, chosen, onchange) {
  const box = el(
    'select',
    {onchange: () => onchange(Number(box.value))},
    options.map((text, i) => el('option', {value: i, selected: i === chosen}, text)),
  );
  return el('label', {class: 'control'}, label, box);
}

/// A row of mutually exclusive buttons.
export function choice(labels, onchoose, chosen = 0) {
  const buttons = labels.map((label, i) =>
    el(
      'button',
      {
        type: 'button',
        'aria-pressed': String(i === chosen),
        onclick: () => {
          buttons.forEach((b, k) => b.setAttribute('aria-pressed', k === i));
          onchoose(i);
        },
      },
      label,
    ),
  );
  return el('div', {class: 'choice', role: 'group'}, buttons);
}

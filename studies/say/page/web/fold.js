// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// On a narrow screen what comes behind the answer is folded, and opens where somebody asks for it.

import {el} from './dom.js';

const narrow = '(max-width: 640px)';

/// The section with all but its title folded.
function folded(section) {
  const title = section.querySelector(':scope > h2'),
    details = el('details', {class: 'folded'}, el('summary', {}, title));
  details.append(...section.childNodes);
  details.addEventListener('toggle', () => window.dispatchEvent(new Event('resize'))); // plots have a width now
  section.append(details);
}

function open(section) {
  const details = section?.querySelector(':scope > details.folded');
  if (details) details.open = true;
}

/// Of the sections those with these ids, where the screen is narrow.
export function foldOnNarrow(sections, ids) {
  if (!window.matchMedia(narrow).matches) return;
  const mine = sections.filter(({id}) => ids.includes(id));
  mine.forEach(folded);
  const openAsked = () => open(document.getElementById(location.hash.slice(1)));
  openAsked();
  window.addEventListener('hashchange', openAsked);
  document.addEventListener('click', ({target}) => {
    const link = target instanceof Element ? target.closest('a') : null;
    if (link?.hash === location.hash) openAsked(); // a link that is followed again changes no hash
  });
  window.addEventListener('beforeprint', () => mine.forEach(open));
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Head of a page: what it is, of which study, and the choice of colours.

import {el} from './dom.js';
import {isDark, onTheme, toggleTheme} from './theme.js';

export function pageHeader(kicker, study, about) {
  return el(
    'header',
    {},
    el(
      'div',
      {class: 'inner'},
      el('p', {class: 'kicker'}, kicker),
      el('h1', {}, study),
      about ? el('p', {class: 'about'}, about) : null,
      themeButton(),
    ),
  );
}

function themeButton() {
  const button = el('button', {type: 'button', class: 'theme', onclick: toggleTheme});
  const name = () => {
    button.textContent = isDark() ? 'Light colours' : 'Dark colours';
  };
  onTheme(name);
  name();
  return button;
}

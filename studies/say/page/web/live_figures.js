// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Figures from the log of the last run that wrote one.

import {el} from './dom.js';
import {flat} from './flat_panels.js';
import {fit, forget} from './plot.js';

const rest = 10000; // between two logs [ms]: reading one takes the server some of a core

/// {node, update(run or null)}
export function lastFigures() {
  const node = el('div');
  let shown = null,
    asked = 0,
    busy = false;
  const show = (...children) => {
    forget(node);
    node.replaceChildren(...children);
  };
  const panel = (p) => {
    const content = flat[p.type](p);
    return el(
      'figure',
      {},
      el('h3', {}, p.title),
      content,
      el('figcaption', {}, [p.caption, p.note].filter(Boolean).join(' ')),
    );
  };
  const update = async (run) => {
    if (run === null || run === shown || busy || Date.now() - asked < rest) return;
    busy = true;
    asked = Date.now();
    try {
      const answer = await (await fetch('/figures.json?run=' + run)).json();
      shown = run;
      if (answer.error) show(el('p', {class: 'note'}, 'There are no figures of it: ' + answer.error));
      else
        show(
          el(
            'p',
            {class: 'note'},
            `From the log of run ${run}. `,
            el(
              'a',
              {href: '/run/' + run, target: '_blank', rel: 'noopener'},
              'All figures of it, with the scene to replay',
            ),
          ),
          ...answer.cautions.map((text) => el('p', {class: 'caution'}, text)),
          ...answer.illustrations.map(panel),
        );
      fit(node);
    } catch {
      // the next state says whether the server is there
    }
    busy = false;
  };
  return {node, update};
}

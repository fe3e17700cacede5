// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What the page says first: what to do, what that gains and how sure it is, the trade-off beside the machine at
// work, how far to trust the models, and the next command. The sentences come ready in the data.

import {cyclesOf, withBodies} from './cycle_panels.js';
import {el, figure} from './dom.js';
import {axisLabel} from './format.js';
import {bandTraces} from './front_band.js';
import {symbols} from './limits.js';
import {namedPlaces} from './named.js';
import {namedTrace} from './named_trace.js';
import {axis, draw, plotBox} from './plot.js';
import {sceneViewer} from './scene.js';
import {colour} from './theme.js';

export function answer(data, {designs}) {
  const pictures = [overview(data, designs), atWork(data)].filter(Boolean);
  return el(
    'section',
    {id: 'summary', 'data-nav': 'Answer', 'aria-label': 'The answer'},
    data.answer.sentences.map((text) => el('p', {class: 'sentence'}, withCommand(text, data.answer.command))),
    trustLine(data.answer),
    nextLine(data),
    pictures.length ? el('div', {class: 'hero'}, pictures) : null,
  );
}

/// The command of a sentence as what is typed.
function withCommand(text, command) {
  const at = command ? text.indexOf(command) : -1;
  return at < 0 ? text : [text.slice(0, at), el('code', {}, command), text.slice(at + command.length)];
}

function trustLine({trust, cautions}) {
  return el(
    'p',
    {class: 'brief'},
    el('b', {}, 'Models: '),
    `${trust}. `,
    el('a', {href: '#trust'}, cautions ? `${cautions} caution${cautions > 1 ? 's' : ''}` : 'What that means'),
  );
}

function nextLine({summary: {next}}) {
  if (!next.length) return null;
  const [first] = next,
    doing = next.find((step) => step.command);
  const command = doing ? el('code', {}, doing.command) : null,
    or = doing && doing !== first ? el('span', {class: 'or'}, ' Or: ', command) : null;
  return el('p', {class: 'brief'}, el('b', {}, 'Next: '), doing === first ? command : first.text, or);
}

/// The first two objectives, or the only one over the variable that matters most.
function overview(data, designs) {
  const wanted = data.front.objectives;
  if (!wanted.length) return null;
  const response = (j) => ({item: data.problem.responses[j], of: ({y}) => y?.[j]});
  const [first] = data.main_pair;
  const sides =
    wanted.length > 1
      ? [response(wanted[0]), response(wanted[1])]
      : [{item: data.problem.variables[first], of: ({x}) => x[first]}, response(wanted[0])];
  const box = plotBox(300, 'Overview of the trade-off');
  draw(box, () => scatter(data, designs, sides));
  return figure(
    box,
    `Star: recommended. ${wanted.length > 1 ? 'Coloured dots: the front' : 'Coloured dot: the best point'}, ` +
      'predicted; grey dots: simulated runs.',
  );
}

function scatter(data, designs, sides) {
  const [across, up] = sides;
  const runs = designs.runs.filter((run) => run.y);
  const dots = (of, more) => ({x: of.map(across.of), y: of.map(up.of), mode: 'markers', hoverinfo: 'skip', ...more});
  const {trace, annotations} = namedTrace(namedPlaces(data), across.of, up.of);
  const objectives = data.front.objectives.map((j) => data.problem.responses[j]);
  return {
    traces: [
      ...(objectives.length > 1 ? bandTraces(data, objectives, 0, 1) : []),
      dots(runs, {marker: {size: 5, color: colour.simulated, symbol: symbols(runs)}}),
      dots(designs.front, {marker: {size: 6, color: colour.training}}),
      trace,
    ],
    layout: {
      showlegend: false,
      annotations,
      margin: {l: 56, r: 8, t: 16, b: 44},
      xaxis: axis(titleOf(across.item)),
      yaxis: axis(titleOf(up.item)),
    },
  };
}

const titleOf = (item) => axisLabel(item) + ({maximize: ' →', minimize: ' ←'}[item.goal] ?? '');

/// The scene of the run that is shown.
function atWork(data) {
  const panel = withBodies(data.illustrations).find(({type}) => type === 'scene');
  return panel ? figure(sceneViewer(panel), `${data.shown} ${panel.caption}`) : null;
}

/// The panels that are not shown first; of several cycles all, as their figures are chosen below.
export function besidesTheScene(data) {
  const panels = withBodies(data.illustrations);
  if (cyclesOf(panels).length > 1) return data;
  const first = panels.findIndex(({type}) => type === 'scene');
  return {...data, illustrations: panels.filter((_, i) => i !== first)};
}

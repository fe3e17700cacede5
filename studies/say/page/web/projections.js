// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The front seen from each pair of objectives. A box or lasso there selects the runs and points inside.

import {onCanvas, pointCloud} from './cloud.js';
import {inputsText} from './designs.js';
import {link, linkPoints, opacities, ring, ringMarked} from './dimming.js';
import {choice, el, figure, select} from './dom.js';
import {axisLabel, labelled, percent, plain, ticks} from './format.js';
import {bandTraces} from './front_band.js';
import {brokenText, legendOfLimits, sizes, symbols} from './limits.js';
import {namedPlaces} from './named.js';
import {namedTrace} from './named_trace.js';
import {axis, draw, plotBox, redraw} from './plot.js';
import {colour, scale} from './theme.js';

const mostProjections = 6;
const many = 2000; // points from which on they are drawn smaller and plainer
const tools = ['select', 'lasso', 'zoom'];

export function projections(data, objectives, shared) {
  const cloud = {...points(data, shared.designs), named: namedPlaces(data)};
  const state = {by: objectives.length > 2 && differs(data, 2) ? 0 : objectives.length + 1, tool: tools[0]};
  const shown = pairs(objectives.length).map((pair) => projection(pair, {data, objectives, cloud, state, ...shared}));
  const colourings = [
    objectives.length > 2 ? 'the third response' : 'nothing',
    ...objectives.map(labelled),
    ...data.problem.variables.map(labelled),
  ];
  return figure(
    el(
      'div',
      {},
      el(
        'div',
        {class: 'controls'},
        select('Colour by', colourings, state.by, (i) => {
          state.by = i;
          shown.forEach((box) => setTimeout(redraw, 0, box));
        }),
        el(
          'span',
          {class: 'control'},
          'Drag to',
          choice(['Select in a box', 'Select with a lasso', 'Zoom'], (i) => {
            state.tool = tools[i];
            shown.forEach((box) => Plotly.relayout(box, {dragmode: tools[i]}));
          }),
        ),
      ),
      el('div', {class: shown.length > 1 ? 'grid wide' : ''}, shown),
    ),
    'The front seen from each pair of objectives. ' +
      (data.front.bands.length
        ? 'The shaded band is where the best trade-off of the two alone may lie, the other objectives left ' +
          'free: 5 to 95 of 100 draws of the surrogates reach it; dotted, half of them do. '
        : '') +
      'Grey dots are simulated runs, for scale; the diamond is the balanced point, nearest to the best of every ' +
      'objective at once, the star what is recommended; a line leads from what was predicted of a ' +
      'confirmed point to what its simulation ' +
      'gave (square). Click a point to follow it through the report; drag a box or a lasso to select what ' +
      'is inside in all plots and tables, and double-click to clear it.' +
      legendOfLimits(shared.designs.runs),
  );
}

/// Whether the front spans enough of the runs' values of an objective that its colours say something.
function differs({front, training}, k) {
  const spread = (values) => Math.max(...values) - Math.min(...values);
  const runs = training.rows.filter((r) => r.y).map((r) => r.y[front.objectives[k]]);
  return spread(front.Y.map((y) => y[k])) > 0.02 * spread(runs);
}

function pairs(count) {
  const all = [];
  for (let a = 0; a < count; ++a) for (let b = a + 1; b < count; ++b) all.push([a, b]);
  return all.slice(0, mostProjections);
}

const brokenLine = (problem, run) => (brokenText(problem, run) ? '<br>' + plain(brokenText(problem, run)) : '');

/// What the projections share: which runs they show, and the hover texts.
function points({problem, confirmations, front}, {runs}) {
  const confirmed = new Set(confirmations.rows.map((r) => r.run));
  const done = runs
    .map((_, i) => i)
    .filter((i) => runs[i].y && runs[i].kind !== 'validation' && !confirmed.has(runs[i].run));
  return {
    done,
    made: done.map((i) => runs[i]),
    runTexts: done.map(
      (i) =>
        `<b>${runs[i].kind} run ${runs[i].run}</b><br>${inputsText(problem, runs[i].x)}${brokenLine(problem, runs[i])}`,
    ),
    frontTexts: front.X.map(
      (x, i) =>
        `<b>point ` +
        `${i + 1}</b><br>${inputsText(problem, x)}` +
        (front.non_dominated.length ? `<br>non-dominated: ${percent(front.non_dominated[i])}` : ''),
    ),
  };
}

function projection([a, b], view) {
  const {data, objectives, cloud, designs, chosen, selection, state} = view;
  const box = plotBox(480, `Pareto projection ${objectives[a].name} ${objectives[b].name}`);
  const runs = {x: values(a), y: values(b)},
    front = {x: data.front.Y.map((y) => y[a]), y: data.front.Y.map((y) => y[b])};
  function values(k) {
    return cloud.done.map((i) => designs.runs[i].y[data.front.objectives[k]]);
  }
  const confirmed = confirmations(view, a, b);
  const bands = () => bandTraces(data, objectives, a, b),
    first = bands().length;
  const links = [...Array(first).fill(undefined), link('runs', cloud.done), link('front'), undefined, confirmed.link];
  const hover = `<br>${axisLabel(objectives[a])}: %{x:.4g}<br>${axisLabel(objectives[b])}: %{y:.4g}<extra></extra>`;
  const rings = () => [
    ...ringOf(chosen.marked('front'), (i) => [front.x[i], front.y[i]]),
    ...ringOf(chosen.marked('runs'), (i) => [a, b].map((k) => designs.runs[i].y?.[data.front.objectives[k]])),
  ];
  const small = data.front.X.length > many;
  const response = (k) => (place) => place.y[data.front.objectives[k]];
  draw(box, (saved) => {
    const shade = colouring(data, objectives, [a, b], state.by);
    const marker = {
      size: small ? 5 : 8,
      line: {color: colour.paper, width: small ? 0 : 0.6},
      color: shade ? shade.values : colour.training,
      opacity: opacities(selection, links[first + 1], front.x.length, saved),
    };
    if (small && !saved) Object.assign(marker, onCanvas);
    if (shade)
      Object.assign(marker, {
        colorscale: scale(),
        showscale: true,
        colorbar: {
          title: {text: axisLabel(shade.item), side: 'right', font: {size: 12}},
          thickness: 11,
          len: 0.95,
          outlinewidth: 0,
          tickfont: {size: 11},
          ...ticks(shade.item),
        },
      });
    const named = namedTrace(cloud.named, response(a), response(b));
    const trace = (more) => ({mode: 'markers', unselected: {marker: {opacity: 1}}, ...more});
    return {
      traces: [
        ...bands(),
        trace({
          name: 'simulated',
          ...runs,
          marker: {
            size: sizes(cloud.made, 5),
            color: colour.simulated,
            symbol: symbols(cloud.made),
            opacity: opacities(selection, links[first], runs.x.length, saved),
          },
          text: cloud.runTexts,
          hovertemplate: '%{text}' + hover,
        }),
        trace({name: 'front', ...front, marker, text: cloud.frontTexts, hovertemplate: '%{text}' + hover}),
        ...confirmed.traces(hover, saved),
        ...(data.front.balanced >= 0
          ? [
              trace({
                x: [front.x[data.front.balanced]],
                y: [front.y[data.front.balanced]],
                hoverinfo: 'skip',
                marker: {symbol: 'diamond-open', size: 16, color: colour.ink, line: {width: 2.5}},
              }),
            ]
          : []),
        named.trace,
      ],
      layout: {
        showlegend: false,
        annotations: named.annotations,
        dragmode: state.tool,
        shapes: rings(),
        margin: {l: 60, r: 8, t: 12, b: 52},
        xaxis: axis(goal(objectives[a])),
        yaxis: axis(goal(objectives[b])),
      },
    };
  });
  linkPoints(box, links, view);
  if (small) pointCloud(box, first + 1, {has: (i) => selection.has('front', i), selection});
  ringMarked(box, chosen, rings);
  selectAreas(box, links, selection);
  return box;
}

const ringOf = (i, place) => {
  const [x, y] = i < 0 ? [] : place(i);
  return x == null ? [] : [ring(x, y)];
};

/// A box or lasso becomes the selection's area; there is one at a time.
function selectAreas(box, links, selection) {
  box.on('plotly_selected', (event) => {
    if (!event?.selections?.length) return; // Plotly also says so when a selection is taken away
    const area = {owner: box, runs: new Set(), front: new Set()};
    for (const {curveNumber, pointIndex} of event.points) {
      const known = links[curveNumber];
      if (known) area[known.set].add(known.index(pointIndex));
    }
    selection.setArea(area);
  });
  box.on('plotly_deselect', () => {
    if (selection.areaOwner === box) selection.setArea(null);
  });
  selection.onchange(() => {
    if (selection.areaOwner !== box && box.layout.selections?.length) Plotly.relayout(box, {selections: []});
  });
}

function colouring(data, objectives, [a, b], by) {
  const m = objectives.length;
  if (by === 0) {
    const third = objectives.findIndex((_, k) => k !== a && k !== b);
    return third < 0 ? null : {item: objectives[third], values: data.front.Y.map((y) => y[third])};
  }
  if (by <= m) return {item: objectives[by - 1], values: data.front.Y.map((y) => y[by - 1])};
  return {item: data.problem.variables[by - 1 - m], values: data.front.X.map((x) => x[by - 1 - m])};
}

/// From predicted to simulated.
function confirmations({data, designs, selection}, a, b) {
  const [ja, jb] = [data.front.objectives[a], data.front.objectives[b]];
  const rows = data.confirmations.rows.filter((r) => r.y);
  const known = link(
    'runs',
    rows.map((r) => designs.runs.findIndex((run) => run.run === r.run)),
  );
  const line = (j) => rows.flatMap((r) => [r.predicted[j], r.y[j], null]);
  const made = rows.map((r) => designs.runs.find((run) => run.run === r.run) ?? r);
  const texts = rows.map(
    (r, k) => `<b>run ${r.run}, simulated</b><br>${inputsText(data.problem, r.x)}${brokenLine(data.problem, made[k])}`,
  );
  const traces = (hover, saved) =>
    rows.length
      ? [
          {x: line(ja), y: line(jb), mode: 'lines', hoverinfo: 'skip', line: {color: colour.ink, width: 1}},
          {
            x: rows.map((r) => r.y[ja]),
            y: rows.map((r) => r.y[jb]),
            mode: 'markers',
            text: texts,
            unselected: {marker: {opacity: 1}},
            marker: {
              symbol: symbols(made, 'square'),
              size: 8,
              color: colour.ink,
              opacity: opacities(selection, known, rows.length, saved),
            },
            hovertemplate: '%{text}' + hover,
          },
        ]
      : [];
  return {traces, link: rows.length ? known : undefined};
}

const goal = (response) => axisLabel(response) + (response.goal === 'maximize' ? ' →' : ' ←');

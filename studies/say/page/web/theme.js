// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Light or dark: the palette that all figures share, and who is told when it changes. It follows the system
// until the reader decides; the decision is kept as long as the page is open. Paper is always light.

const light = {
  ink: '#1c2733',
  muted: '#5f6e7c',
  grid: '#e6eaee',
  axis: '#b8c2cb',
  guide: '#8d9ba7',
  paper: '#ffffff',
  sky: '#e9edf0',
  training: '#2b6592',
  adaptive: '#3f9aa8',
  confirmation: '#1c2733',
  validation: '#d9822b',
  front: '#2f7d4f',
  accent: '#b4531a',
  failed: '#b3372f',
  simulated: '#b4bfc9',
  soil: 'rgba(203,183,156,0.55)',
  soilEdge: '#9b8466',
  band: 'rgba(47,125,79,0.16)',
};
const dark = {
  ink: '#e4eaef',
  muted: '#a7b4bf',
  grid: '#2d3943',
  axis: '#566571',
  guide: '#8493a0',
  paper: '#1a232b',
  sky: '#2a353e',
  training: '#6aaadb',
  adaptive: '#5fc0cd',
  confirmation: '#e4eaef',
  validation: '#eda056',
  front: '#6cbf8a',
  accent: '#ee9162',
  failed: '#f07f75',
  simulated: '#66757f',
  soil: 'rgba(150,130,104,0.45)',
  soilEdge: '#b39c7e',
  band: 'rgba(108,191,138,0.2)',
};
const lightSeries = ['#2b6592', '#d9822b', '#4d8f63', '#8a5a9e', '#b3372f', '#6c7a86', '#b8992c', '#3f9aa8'];
const darkSeries = ['#6aaadb', '#eda056', '#7cc596', '#bd92d0', '#f07f75', '#a3b0bb', '#d8bb55', '#5fc0cd'];

export const colour = {...light};
export const series = [...lightSeries];
/// Viridis; on dark paper its dark end, which would vanish there, is lighter.
const darkScale = [
  [0, '#5a68b8'],
  [0.25, '#3e8fb0'],
  [0.5, '#2bb0a0'],
  [0.75, '#7ad151'],
  [1, '#fde725'],
];
export const scale = () => (colour.paper === dark.paper ? darkScale : 'Viridis');

/// What '#rrggbb' over paper looks like with an opacity, as an opaque colour.
export const faded = (hex, opacity) => {
  const part = (of, i) => parseInt(of.slice(i, i + 2), 16);
  const mixed = (i) => Math.round(opacity * part(hex, i) + (1 - opacity) * part(colour.paper, i));
  return `rgb(${[1, 3, 5].map(mixed).join(',')})`;
};

/// '#rrggbb' with an opacity.
export const translucent = (hex, opacity) =>
  `rgba(${[1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)).join(',')},${opacity})`;

const listeners = new Set();
const system = matchMedia('(prefers-color-scheme: dark)');
let decided = null,
  printing = false;

export const isDark = () => !printing && (decided ?? system.matches);

/// listener(now): draw again; now tells that the paper does not wait. Returns what ends that.
export function onTheme(listener) {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

function paint(inDark) {
  Object.assign(colour, inDark ? dark : light);
  series.splice(0, series.length, ...(inDark ? darkSeries : lightSeries));
}

/// What f returns, with the colours for paper.
export function onPaper(f) {
  paint(false);
  try {
    return f();
  } finally {
    paint(isDark());
  }
}

function change(now = false) {
  document.documentElement.dataset.theme = isDark() ? 'dark' : 'light';
  paint(isDark());
  listeners.forEach((f) => f(now));
}

export function toggleTheme() {
  decided = !isDark();
  change();
}

/// Paper is light and has another width than the window.
function print(on) {
  printing = on;
  document.body.classList.toggle('printing', on);
  change(true);
}

system.addEventListener('change', () => {
  if (decided === null) change();
});
addEventListener('beforeprint', () => print(true));
addEventListener('afterprint', () => print(false));
change();

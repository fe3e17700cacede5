// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Numbers, units and names as text.

export function number(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return 'n/a';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(digits - 1);
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return value.toFixed(Math.min(decimals, 8));
}

export const percent = (value) => (value === null || !Number.isFinite(value) ? 'n/a' : `${number(100 * value, 2)} %`);
export const pretty = (name) => name.replaceAll('_', ' ');
export const hasUnit = (unit) => unit !== '' && unit !== '1';
export const labelled = (item) => pretty(item.name) + (hasUnit(item.unit) ? ` [${item.unit}]` : '');
/// A variable's value: the name of a level, a whole number, or a number; of one whose range holds 0, what is
/// nearer to it than 1e-4 of the range is 0.
export const setting = (value, {levels, kind, lower, upper}) => {
  if (levels) return pretty(levels[Math.round(value)] ?? 'n/a');
  if (kind) return String(Math.round(value));
  return number(lower <= 0 && upper >= 0 && Math.abs(value) < 1e-4 * (upper - lower) ? 0 : value);
};
export const settingWithUnit = (value, item) => setting(value, item) + (hasUnit(item.unit) ? ' ' + item.unit : '');
/// Of an axis along a variable: the names of its levels.
export const ticks = ({levels}) =>
  levels ? {tickvals: levels.map((_, i) => i), ticktext: levels.map((name) => plain(pretty(name)))} : {};
/// In a hover text, the place along 'x' or 'y' as its axis says it: with names and whole numbers as they are.
export const place = ({kind}, along, digits = 3) => (kind ? `%{${along}}` : `%{${along}:.${digits}g}`);
export const withUnit = (value, item) => number(value) + (hasUnit(item.unit) ? ' ' + item.unit : '');

/// Text for Plotly, which reads a little markup and its own %{...} patterns.
export const plain = (text) =>
  String(text).replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('>', '&gt;').replaceAll('%{', '% {');
export const axisLabel = (item) => plain(labelled(item));

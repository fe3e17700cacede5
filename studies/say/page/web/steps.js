// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Places along a variable, and the range of values.

export const steps = (lower, upper, count) =>
  Array.from({length: count}, (_, i) => lower + ((upper - lower) * i) / (count - 1));

/// Where a curve along a variable is drawn: at all of its values where there are few, so that none is made up
/// between them.
export const places = (v, count) =>
  steps(v.lower, v.upper, v.kind ? Math.min(count, v.upper - v.lower + 1) : count).map((value) =>
    v.kind ? Math.round(value) : value,
  );

export function extent(values) {
  const low = Math.min(...values),
    high = Math.max(...values);
  return high > low ? [low, high] : [low - 0.5, high + 0.5];
}

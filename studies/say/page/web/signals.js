// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Signals over time for plots that are narrower than they have samples.

/// Index of the last sample up to time, or the first one.
export function sampleAt(t, time) {
  let low = 0,
    high = t.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle] <= time) low = middle;
    else high = middle;
  }
  return low;
}

/// The last sample up to time, which holds for a step beyond the end; null where there is none.
export function valueAt({t, y}, time) {
  const last = t.length - 1,
    step = last > 0 ? (t[last] - t[0]) / last : 0;
  return last < 0 || time < t[0] || time > t[last] + step ? null : y[sampleAt(t, time)];
}

/// The lowest and the highest sample of each of `count` equal parts of [from, to], in the order of their
/// times: no peak is lost. Parts without a sample give nothing.
export function peaksKept({t, y}, [from, to], count) {
  const kept = [];
  let column = -1,
    low = 0,
    high = 0;
  const close = () => {
    if (column < 0) return;
    const pair = low === high ? [low] : low < high ? [low, high] : [high, low];
    for (const i of pair) kept.push(i);
  };
  for (let i = 0; i < t.length; ++i) {
    if (t[i] < from || t[i] > to) continue;
    const at = Math.min(count - 1, Math.floor((count * (t[i] - from)) / (to - from)));
    if (at !== column) {
      close();
      column = at;
      low = high = i;
    }
    if (y[i] < y[low]) low = i;
    if (y[i] > y[high]) high = i;
  }
  close();
  return {t: kept.map((i) => t[i]), y: kept.map((i) => y[i])};
}

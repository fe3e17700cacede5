// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Which designs are selected: those within a range on each restricted axis and, if there is one, in the area
// drawn in a projection. Every view reads this one state and dims the rest.

const selected = (flags) => flags.reduce((sum, flag) => sum + flag, 0);

export function selecting({axes, runs, front}) {
  const sizes = {runs: runs.length, front: front.length};
  const listeners = [];
  const ranges = new Map();
  let area = null,
    flags = null,
    counts = sizes;

  const update = () => {
    flags = null;
    counts = sizes;
    if (ranges.size || area) {
      flags = {runs: within('runs'), front: within('front')};
      counts = {runs: selected(flags.runs), front: selected(flags.front)};
    }
    listeners.forEach((f) => f(state));
  };

  const within = (set) => {
    const all = new Uint8Array(sizes[set]).fill(1);
    for (const [a, [low, high]] of ranges) {
      const values = axes[a].values[set];
      for (let i = 0; i < all.length; ++i) if (!(values[i] >= low && values[i] <= high)) all[i] = 0;
    }
    if (area) for (let i = 0; i < all.length; ++i) if (!area[set].has(i)) all[i] = 0;
    return all;
  };

  const state = {
    sizes,
    ranges,
    onchange: (listener) => listeners.push(listener),
    get active() {
      return flags !== null;
    },
    get counts() {
      return counts;
    },
    /// Who drew the area, if there is one.
    get areaOwner() {
      return area?.owner ?? null;
    },
    has: (set, i) => flags === null || flags[set][i] === 1,
    /// range: [low, high], or null for all.
    setRange(axis, range) {
      if (range) ranges.set(axis, range);
      else ranges.delete(axis);
      update();
    },
    /// area: {owner, runs: Set of indices, front: Set of indices}, or null for none.
    setArea(drawn) {
      area = drawn;
      update();
    },
    clear() {
      ranges.clear();
      area = null;
      update();
    },
  };
  return state;
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Simulated runs on a cut through the box: each is projected onto it, and the fainter the farther it lies
// from it.

const farthest = 0.5,
  faintest = 0.08;

/// Root mean square over the variables that the cut holds, in shares of their ranges; 0 where it holds none.
/// Another level of a category is a whole range away.
export function distanceToCut({variables}, point, at, along) {
  const held = variables.map((_, k) => k).filter((k) => !along.includes(k));
  const share = (k) =>
    variables[k].levels
      ? Number(point[k] !== Math.round(at[k]))
      : (point[k] - at[k]) / (variables[k].upper - variables[k].lower);
  return held.length ? Math.sqrt(held.reduce((sum, k) => sum + share(k) ** 2, 0) / held.length) : 0;
}

/// The runs of `rows` with values that lie nearest to the cut through `at` along some variables, at most so
/// many: {rows, indices, opacity}, per run its index in `rows` and its opacity.
export function nearCut(problem, rows, at, along, most = 60) {
  const near = rows
    .map((r, i) => ({r, i, d: distanceToCut(problem, r.x, at, along)}))
    .filter(({r}) => r.y)
    .sort((p, q) => p.d - q.d)
    .slice(0, most);
  return {
    rows: near.map(({r}) => r),
    indices: near.map(({i}) => i),
    opacity: near.map(({d}) => Math.max(faintest, 1 - d / farthest)),
  };
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The band of a front as a closed line.

/// The corners of the band around, and its middle: {x, y, median}. What too few draws reach goes on to the
/// worst value drawn; where hardly any reaches anything there is no band.
export function bandOutline({at, optimistic, median, pessimistic}, worst) {
  const known = at.map((_, i) => i).filter((i) => optimistic[i] !== null);
  const back = [...known].reverse();
  return {
    x: [...known, ...back].map((i) => at[i]),
    y: [...known.map((i) => optimistic[i]), ...back.map((i) => pessimistic[i] ?? worst)],
    median: {x: known.map((i) => at[i]), y: known.map((i) => median[i])},
  };
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How often each part of a variable's range occurs.

/// Percent of the values in each of the equal parts of a variable's range; both bounds belong to a part.
export function shares(values, {lower, upper}, parts) {
  const counts = new Array(parts).fill(0);
  for (const value of values) ++counts[Math.min(parts - 1, Math.floor((parts * (value - lower)) / (upper - lower)))];
  return counts.map((count) => (100 * count) / values.length);
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The way of a design's line over the axes.

/// Moves and lines of a pen along {set, i}; a missing value is a gap.
export function trace({set, i}, axes, pen) {
  let down = false;
  for (const {x, y, values} of axes) {
    const value = values[set][i];
    if (Number.isNaN(value)) {
      down = false;
      continue;
    }
    if (down) pen.lineTo(x, y(value));
    else pen.moveTo(x, y(value));
    down = true;
  }
}

/// The corners (x, y) of a line, in pieces where values are missing.
export function piecesOf(axes, line) {
  const pieces = [];
  trace(line, axes, {
    moveTo: (x, y) => pieces.push([[x, y]]),
    lineTo: (x, y) => pieces[pieces.length - 1].push([x, y]),
  });
  return pieces.filter((piece) => piece.length > 1);
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A tyre about the y axis: round shoulders and slanting lugs, within the cylinder of the simulation.

const sides = 36,
  lugs = 18,
  groove = 0.05, // depth of the tread, of the radius
  sidewall = 0.6; // radius of the rim, of the tyre's

/// Adds it. radius and half its width [m]; rubber: {colour, finish}; tread is what touches the floor.
export function addTyre(facets, {radius, half}, {colour, finish}) {
  const bed = radius * (1 - groove);
  const profile = [
    [-0.94 * half, sidewall * radius],
    [-half, 0.78 * radius],
    [-0.93 * half, 0.92 * radius],
    [-0.78 * half, bed],
    [0.78 * half, bed],
    [0.93 * half, 0.92 * radius],
    [half, 0.78 * radius],
    [0.94 * half, sidewall * radius],
  ];
  const at = (y, r, angle) => [r * Math.cos(angle), y, r * Math.sin(angle)];
  for (let k = 0; k < sides; ++k) {
    const [a, b] = [k, k + 1].map((n) => (2 * Math.PI * n) / sides);
    for (let j = 0; j + 1 < profile.length; ++j) {
      const [[y, r], [z, s]] = [profile[j], profile[j + 1]];
      facets.polygon([at(y, r, a), at(z, s, a), at(z, s, b), at(y, r, b)], colour, finish);
    }
  }
  const worn = colour.map((c) => 1.5 * c);
  for (let k = 0; k < lugs; ++k)
    for (const side of [-1, 1])
      addLug(
        facets,
        {side, at, bed, radius, half, angle: (2 * Math.PI * (k + (side > 0 ? 0.5 : 0))) / lugs},
        worn,
        finish,
      );
}

// From the middle to a shoulder, leading at the middle.
function addLug(facets, {side, at, bed, radius, half, angle}, colour, finish) {
  const wide = (0.56 * Math.PI) / lugs,
    lead = (0.7 * Math.PI) / lugs;
  const line = [
    {share: 0.03, turn: lead, r: radius},
    {share: 0.72, turn: 0, r: radius},
    {share: 0.99, turn: 0, r: 0.9 * radius},
  ];
  const corner = ({share, turn, r}, way, low = false) =>
    at(side * share * half, low ? Math.min(r, bed) - 0.02 * radius : r, angle + turn + way * wide);
  const face = (corners) => facets.polygon(side > 0 ? corners : [...corners].reverse(), colour, finish);
  for (let k = 0; k + 1 < line.length; ++k) {
    const [p, q] = [line[k], line[k + 1]];
    face([corner(p, -1), corner(q, -1), corner(q, 1), corner(p, 1)]);
    face([corner(p, -1, true), corner(q, -1, true), corner(q, -1), corner(p, -1)]);
    face([corner(p, 1), corner(q, 1), corner(q, 1, true), corner(p, 1, true)]);
  }
  face([corner(line[0], -1, true), corner(line[0], -1), corner(line[0], 1), corner(line[0], 1, true)]);
  face([corner(line[2], -1), corner(line[2], -1, true), corner(line[2], 1, true), corner(line[2], 1)]);
}

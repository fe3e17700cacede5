// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A drift as it was blasted: floor, walls and roof of rough rock around the smooth box of the simulation, and
// lamps under the roof. Its faces look inwards, so that it is open to whoever looks from outside.

import {hash, rough} from './grain.js';
import {Facets, linear} from './mesh.js';

const cell = 0.42,
  deepest = 0.5, // that the rock recedes behind the box [m]
  thickness = 0.45; // of the floor where it is cut [m]
const stone = linear('#837d76'),
  ground = linear('#85796a'),
  cut = linear('#3d3833'),
  housing = linear('#3a3d40'),
  bulb = linear('#ffe9c4');
const rockFace = [0.55, 0, 0.3],
  dirt = [0.8, 0, 0.4],
  plain = [0.3, 0, 0];

const steps = (low, high) => {
  const count = Math.max(1, Math.round((high - low) / cell));
  return Array.from({length: count + 1}, (_, k) => low + ((high - low) * k) / count);
};

/// drift: {from, length, width, height, raise: {x, radius}}, as in study.hpp.
export function driftMesh(drift) {
  const facets = new Facets();
  addTunnel(facets, drift, false);
  addBack(facets, drift);
  addFloor(facets, drift);
  for (const place of lampPlaces(drift)) addLamp(facets, place, drift.height);
  return facets;
}

/// Middles of the lamps, a row under the roof on the far side.
export function lampPlaces({from, length, width, height}) {
  const count = Math.min(6, Math.max(2, Math.round((length - from) / 4.5)));
  const gap = (length - from) / count;
  return Array.from({length: count}, (_, k) => [from + gap * (k + 0.4), 0.27 * width, height - 0.35]);
}

/// Two triangles, each of its own shade.
function patch(facets, corners, {colour, finish, key}) {
  const [a, b, c, d] = corners;
  const shade = (k) => 0.87 + 0.26 * hash(key[0], key[1], key[2] + k);
  const tinted = (k) => colour.map((v) => v * shade(k));
  if (hash(key[0], key[1], 77) < 0.5) {
    facets.polygon([a, b, c], tinted(0), finish);
    facets.polygon([a, c, d], tinted(1), finish);
  } else {
    facets.polygon([a, b, d], tinted(0), finish);
    facets.polygon([b, c, d], tinted(1), finish);
  }
}

function grid(facets, rows, columns, at, {colour, finish, key, keeps = null}) {
  const points = rows.map((u, i) => columns.map((v, j) => at(u, v, i, j)));
  for (let i = 0; i + 1 < rows.length; ++i)
    for (let j = 0; j + 1 < columns.length; ++j) {
      const corners = [points[i][j], points[i + 1][j], points[i + 1][j + 1], points[i][j + 1]];
      if (!keeps || keeps(corners)) patch(facets, corners, {colour, finish, key: [i, j, key]});
    }
}

// Walls or roof: along the drift, and round its section from the floor on the right to the left.
function addTunnel(facets, {from, length, width, height, raise}, roof) {
  const around = steps(0, 2 * height + width),
    half = width / 2,
    bend = 0.9;
  const section = (s) => {
    if (s < height) return {y: -half, z: s, ny: -1, nz: 0, corner: height - s};
    if (s < height + width) {
      const y = s - height - half;
      return {y, z: height, ny: 0, nz: 1, corner: half - Math.abs(y)};
    }
    return {y: half, z: 2 * height + width - s, ny: 1, nz: 0, corner: s - height - width};
  };
  grid(
    facets,
    around,
    steps(from, length + 0.3),
    (s, x, i, j) => {
      const ends = i === 0 || i === around.length - 1, // at the floor
        along = ends ? s : s + cell * 0.7 * (hash(i, j, 11) - 0.5);
      const {y, z, ny, nz, corner} = section(along);
      const round = Math.max(0, 1 - corner / bend) ** 2; // the corner of roof and wall is round
      const bumps = rough(0.9 * x, 0.9 * y, 0.9 * z) ** 1.5 * (0.6 + 0.8 * hash(i, j, 12));
      const out = 0.02 + deepest * bumps - 0.3 * round;
      return [
        x + cell * 0.7 * (hash(i, j, 13) - 0.5),
        y + ny * out - (nz ? Math.sign(y) * 0.1 * round : 0),
        z + nz * out - (ny ? 0.1 * round : 0),
      ];
    },
    {
      colour: stone,
      finish: rockFace,
      key: 1,
      keeps: (corners) => {
        const isRoof = corners.every(([, , z]) => z > height - 0.4);
        if (isRoof !== roof) return false;
        return !isRoof || !corners.every(([x, y]) => Math.hypot(x - raise.x, y) < raise.radius + 0.1);
      },
    },
  );
}

// Rocks stand out of it, as they do in the simulation.
function addBack(facets, {length, width, height}) {
  const half = width / 2 + deepest;
  grid(
    facets,
    steps(0, height + deepest),
    steps(-half, half),
    (z, y, i, j) => [
      length - 0.02 - 0.3 * rough(1.4 * y, 1.4 * z, 3) * (0.5 + hash(i, j, 21)),
      y + cell * 0.7 * (hash(i, j, 22) - 0.5),
      z && z + cell * 0.7 * (hash(i, j, 23) - 0.5),
    ],
    {colour: stone, finish: rockFace, key: 2},
  );
}

function addFloor(facets, {from, length, width}) {
  const half = width / 2 + deepest,
    columns = steps(-half, half),
    rows = steps(from, length + 0.3);
  const top = (x, y) => [x, y, -0.05 * rough(1.7 * x, 1.7 * y, 0) - 0.01];
  grid(facets, rows, columns, top, {colour: ground, finish: dirt, key: 3});
  const wall = (a, b) => facets.polygon([a, b, [b[0], b[1], -thickness], [a[0], a[1], -thickness]], cut, plain);
  for (let k = 0; k + 1 < rows.length; ++k) {
    wall(top(rows[k + 1], -half), top(rows[k], -half));
    wall(top(rows[k], half), top(rows[k + 1], half));
  }
  for (let k = 0; k + 1 < columns.length; ++k) wall(top(from, columns[k]), top(from, columns[k + 1]));
}

/// The roof and the lower part of the raise, from inside.
export function roofMesh(drift) {
  const facets = new Facets(),
    {height, raise} = drift;
  addTunnel(facets, drift, true);
  const round = Array.from({length: 25}, (_, k) => (2 * Math.PI * k) / 24);
  grid(
    facets,
    [height - 0.1, height + 0.7, height + 1.5, height + 2.3, height + 3.1],
    round,
    (z, angle, i) => {
      const a = angle % (2 * Math.PI - 1e-9),
        x = Math.cos(a),
        y = Math.sin(a);
      const r = raise.radius + 0.05 + 0.35 * rough(2 * x, 2 * y, 0.8 * z + 0.3 * i);
      return [raise.x + r * x, r * y, z];
    },
    {colour: stone, finish: rockFace, key: 4},
  );
  return facets;
}

// A box with a bright lower side, on a rod from the roof.
function addLamp(facets, place, height) {
  const [x, y, z] = place;
  const box = (a, b, colour, finish) => {
    const at = (i, j, k) => [i ? b[0] : a[0], j ? b[1] : a[1], k ? b[2] : a[2]];
    for (const corners of [
      [at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)],
      [at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)],
      [at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)],
      [at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)],
      [at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)],
      [at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)],
    ])
      facets.polygon(corners, colour, finish);
  };
  box([x - 0.42, y - 0.11, z], [x + 0.42, y + 0.11, z + 0.1], housing, plain);
  box([x - 0.36, y - 0.085, z - 0.05], [x + 0.36, y + 0.085, z], bulb, [0, 1, 0]);
  for (const dx of [-0.3, 0.3])
    box([x + dx - 0.015, y - 0.015, z + 0.1], [x + dx + 0.015, y + 0.015, height + 0.3], housing, plain);
}

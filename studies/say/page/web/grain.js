// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Noise that is the same each time: for the rough walls, and the grain of stone as a texture.

import * as THREE from 'three';

/// In [0, 1), of whole numbers.
export function hash(x, y = 0, z = 0) {
  let n = (Math.imul(x, 374761393) + Math.imul(y, 668265263) + Math.imul(z, 2147483647 ^ 0x2c1b3c6d)) | 0;
  n = Math.imul(n ^ (n >>> 13), 1274126177);
  n = Math.imul(n ^ (n >>> 16), 0x45d9f3b);
  return ((n ^ (n >>> 15)) >>> 0) / 4294967296;
}

const smooth = (f) => f * f * (3 - 2 * f);
const between = (a, b, f) => a + f * (b - a);

/// Even noise in [0, 1], about one feature per unit.
export function noise(x, y, z) {
  const i = Math.floor(x),
    j = Math.floor(y),
    k = Math.floor(z);
  const u = smooth(x - i),
    v = smooth(y - j),
    w = smooth(z - k);
  const row = (b, c) => between(hash(i, j + b, k + c), hash(i + 1, j + b, k + c), u);
  return between(between(row(0, 0), row(1, 0), v), between(row(0, 1), row(1, 1), v), w);
}

/// Noise of three sizes together.
export const rough = (x, y, z) =>
  (4 * noise(x, y, z) + 2 * noise(2.1 * x + 5, 2.1 * y, 2.1 * z) + noise(4.3 * x, 4.3 * y + 9, 4.3 * z)) / 7;

const side = 128;

/// Noise of a period, so that the texture has no seam.
function wrapped(x, y, period, seed) {
  const i = Math.floor(x),
    j = Math.floor(y),
    at = (a, b) => hash((i + a) % period, (j + b) % period, seed);
  const u = smooth(x - i),
    v = smooth(y - j);
  return between(between(at(0, 0), at(1, 0), u), between(at(0, 1), at(1, 1), u), v);
}

export function grainTexture() {
  const data = new Uint8Array(side * side);
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      let value = 0;
      for (const [period, share] of [
        [8, 0.16],
        [32, 0.34],
        [128, 0.5],
      ])
        value += share * wrapped((x * period) / side, (y * period) / side, period, period);
      data[y * side + x] = Math.max(0, Math.min(255, Math.round(255 * (0.5 + 1.5 * (value - 0.5)))));
    }
  const texture = new THREE.DataTexture(data, side, side, THREE.RedFormat);
  texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
  texture.magFilter = THREE.LinearFilter;
  texture.minFilter = THREE.LinearMipmapNearestFilter;
  texture.generateMipmaps = true;
  texture.needsUpdate = true;
  return texture;
}

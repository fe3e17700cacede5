// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The surface of the rock as heights over a grid, and a core below it: whatever lies in the core is hidden by the core,
// so that of a pile only what one can see is drawn. The heights also darken what lies deep between rocks.

import * as THREE from 'three';
import {Facets, linear} from './mesh.js';

const cell = 0.25, // [m]
  cover = 0.35, // of rock over the core [m]
  gap = 0.5, // above the rock below, over which a rock lies on it [m]
  rim = 3, // cells along a side through which one looks at the rock, where the core ends
  slight = 0.05, // change of the core [m]
  highest = 16; // that a height can be [m]; rocks higher than this are left to themselves
const dark = linear('#4a443d');

export class RockCover {
  /// box: {x: [low, high], y: [low, high]}, within which rock lies.
  constructor({x, y}, material) {
    this.low = [x[0], y[0]];
    this.nx = Math.ceil((x[1] - x[0]) / cell);
    this.ny = Math.ceil((y[1] - y[0]) / cell);
    this.top = new Float32Array(this.nx * this.ny);
    this.core = new Float32Array(this.nx * this.ny);
    this.known = new Float32Array(this.nx * this.ny); // by who asks for changes
    this.bytes = new Uint8Array(this.nx * this.ny);
    this.texture = new THREE.DataTexture(this.bytes, this.nx, this.ny, THREE.RedFormat);
    this.texture.magFilter = this.texture.minFilter = THREE.LinearFilter;
    this.texture.unpackAlignment = 1;
    this.mesh = this.makeMesh(material);
    this.box = {x, y};
    this.open = [false, false, false];
    this.order = []; // of the rocks, from below
  }

  light(shared) {
    shared.heights.value = this.texture;
    shared.heightsScale.value = highest;
    shared.heightsBox.value.set(this.low[0], this.low[1], 1 / (cell * this.nx), 1 / (cell * this.ny));
  }

  /// Of so many rocks: x y z one after the other, a radius each, and whether it is there.
  update(count, places, radii, there) {
    this.top.fill(0);
    if (this.order.length !== count) this.order = Array.from({length: count}, (_, k) => k);
    this.order.sort((a, b) => places[3 * a + 2] - places[3 * b + 2]); // from the last time it is nearly in order
    for (const k of this.order) if (there[k]) this.raise(places, 3 * k, radii[k]);
    this.sink();
    for (let k = 0; k < this.bytes.length; ++k)
      this.bytes[k] = Math.min(255, Math.max(0, (255 * (this.top[k] - 0.12)) / highest));
    this.texture.needsUpdate = true;
    this.place();
  }

  /// The cells under a sphere: lows and highs, half open.
  cells(x, y, r) {
    const at = (v, low, n) => Math.min(n, Math.max(0, Math.round((v - low) / cell)));
    return [
      at(x - r, this.low[0], this.nx),
      at(x + r, this.low[0], this.nx),
      at(y - r, this.low[1], this.ny),
      at(y + r, this.low[1], this.ny),
    ];
  }

  // Only by what lies on the rock below: what a bucket carries over a gap, or what falls, covers nothing.
  raise(places, at, radius) {
    const x = places[at],
      y = places[at + 1],
      z = places[at + 2] + 0.5 * radius,
      r = 0.7 * radius;
    const [i0, i1, j0, j1] = this.cells(x, y, r);
    let below = 0;
    for (let j = j0; j < j1; ++j) for (let i = i0; i < i1; ++i) below += this.top[j * this.nx + i];
    if (z - radius > below / ((i1 - i0) * (j1 - j0)) + gap) return;
    for (let j = j0; j < j1; ++j)
      for (let i = i0; i < i1; ++i) if (this.top[j * this.nx + i] < z) this.top[j * this.nx + i] = z;
  }

  /// For a camera there: from beyond a wall one looks through it at the side of the rock. Whether that changed what is
  /// hidden.
  seenFrom({x, y}) {
    const open = [y < this.box.y[0], y > this.box.y[1], x > this.box.x[1]];
    if (open.every((is, k) => is === this.open[k])) return false;
    this.open = open;
    this.sink();
    this.place();
    return true;
  }

  // The core lies below the lowest top around.
  sink() {
    const {nx, ny, top, core, open} = this;
    const [first, last, end] = [open[0] ? rim : 0, ny - (open[1] ? rim : 0), nx - (open[2] ? rim : 0)];
    const at = (i, j) => top[Math.min(ny - 1, Math.max(0, j)) * nx + Math.min(nx - 1, Math.max(0, i))];
    for (let j = 0; j < ny; ++j)
      for (let i = 0; i < nx; ++i) {
        const least =
          j < first || j >= last || i >= end
            ? 0
            : Math.min(at(i, j), at(i - 1, j), at(i + 1, j), at(i, j - 1), at(i, j + 1));
        core[j * nx + i] = Math.max(0, least - cover);
      }
  }

  /// Where the core is another one than when this was last asked: a box {low, high} [m], or null.
  changes() {
    const {nx, core, known} = this,
      low = [Infinity, Infinity, 0],
      high = [-Infinity, -Infinity, 0];
    core.forEach((z, k) => {
      if (Math.abs(z - known[k]) < slight) return;
      [k % nx, Math.floor(k / nx)].forEach((cells, i) => {
        low[i] = Math.min(low[i], this.low[i] + (cells - 1) * cell);
        high[i] = Math.max(high[i], this.low[i] + (cells + 2) * cell);
      });
      high[2] = Math.max(high[2], z, known[k]);
      known[k] = z;
    });
    return low[0] < high[0] ? {low, high} : null;
  }

  /// Whether a sphere lies within the core.
  hides(x, y, z, r) {
    const [i0, i1, j0, j1] = this.cells(x, y, r + cell);
    if (i0 >= i1 || j0 >= j1) return false;
    for (let j = j0; j < j1; ++j) for (let i = i0; i < i1; ++i) if (this.core[j * this.nx + i] < z + r) return false;
    return true;
  }

  /// Whether the core hides a sphere from the eye: a straight line from its top meets the core.
  hidesFrom(eye, x, y, z, r) {
    const [ex, ey, ez] = [eye.x - x, eye.y - y, eye.z - z - r],
      far = Math.hypot(ex, ey);
    for (let s = r + cell; s < Math.min(far, 8); s += cell) {
      const i = Math.floor((x + (ex * s) / far - this.low[0]) / cell),
        j = Math.floor((y + (ey * s) / far - this.low[1]) / cell);
      if (i < 0 || j < 0 || i >= this.nx || j >= this.ny) return false;
      if (this.core[j * this.nx + i] > z + r + (ez * s) / far + 0.05) return true;
    }
    return false;
  }

  makeMesh(material) {
    const facets = new Facets(),
      {nx, ny} = this;
    const point = (i, j) => [this.low[0] + (i + 0.5) * cell, this.low[1] + (j + 0.5) * cell, 0];
    for (let j = 0; j < ny; ++j)
      for (let i = 0; i < nx; ++i) {
        facets.position.push(...point(i, j));
        facets.normal.push(0, 0, 1);
        facets.colour.push(...dark);
        facets.finish.push(1, 0, 0);
        if (i + 1 === nx || j + 1 === ny) continue;
        const k = j * nx + i;
        facets.index.push(k, k + 1, k + 1 + nx, k, k + 1 + nx, k + nx);
      }
    const mesh = new THREE.Mesh(facets.geometry(1).geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = 1;
    return mesh;
  }

  // Only where the core is above the floor has it triangles.
  place() {
    const {nx, ny, core} = this,
      position = this.mesh.geometry.getAttribute('position'),
      index = this.mesh.geometry.getIndex();
    for (let k = 0; k < core.length; ++k) position.array[3 * k + 2] = core[k];
    position.needsUpdate = true;
    let n = 0;
    for (let j = 0; j + 1 < ny; ++j)
      for (let i = 0; i + 1 < nx; ++i) {
        const k = j * nx + i;
        if (!core[k] && !core[k + 1] && !core[k + nx] && !core[k + nx + 1]) continue;
        index.array.set([k, k + 1, k + 1 + nx, k, k + 1 + nx, k + nx], n);
        n += 6;
      }
    index.needsUpdate = true;
    this.mesh.geometry.setDrawRange(0, n);
    this.mesh.visible = n > 0;
  }
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Flat facets gathered into one geometry of instances (surface_material.js).

import * as THREE from 'three';

const one = new THREE.Vector3(),
  two = new THREE.Vector3();

export class Facets {
  constructor() {
    this.position = [];
    this.normal = [];
    this.colour = [];
    this.finish = [];
    this.index = [];
  }

  /// A flat polygon, counter-clockwise seen from outside. colour: linear [r, g, b]; finish: [grain, glow, dust].
  polygon(corners, colour, finish) {
    const n = normalOf(corners),
      first = this.position.length / 3;
    for (const corner of corners) {
      this.position.push(...corner);
      this.normal.push(...n);
      this.colour.push(...colour);
      this.finish.push(...finish);
    }
    for (let k = 1; k + 1 < corners.length; ++k) this.index.push(first, first + k, first + k + 1);
  }

  /// A convex body. shade(face): what its colour is multiplied with.
  solid({vertices, faces}, colour, finish, shade = null) {
    faces.forEach((face, k) => {
      const s = shade ? shade(k) : 1;
      this.polygon(
        face.map((v) => vertices[v]),
        colour.map((c) => c * s),
        finish,
      );
    });
  }

  /// Room for so many instances; {geometry, place, turn, tint}: the arrays of the instances.
  geometry(instances) {
    const g = new THREE.InstancedBufferGeometry();
    const vertex = (name, list) => g.setAttribute(name, new THREE.Float32BufferAttribute(list, 3));
    for (const name of ['position', 'normal', 'colour', 'finish']) vertex(name, this[name]);
    g.setIndex(this.index);
    const own = (name, size) => {
      const attribute = new THREE.InstancedBufferAttribute(new Float32Array(size * instances), size);
      attribute.setUsage(THREE.DynamicDrawUsage);
      g.setAttribute(name, attribute);
      return attribute.array;
    };
    const arrays = {place: own('place', 4), turn: own('turn', 4), tint: own('tint', 3)};
    g.instanceCount = instances;
    for (let k = 0; k < instances; ++k) {
      arrays.place[4 * k + 3] = arrays.turn[4 * k + 3] = 1;
      arrays.tint.fill(1, 3 * k, 3 * k + 3);
    }
    return {geometry: g, ...arrays};
  }
}

/// By Newell, so that a bent polygon has one too.
function normalOf(corners) {
  const n = [0, 0, 0];
  corners.forEach((a, k) => {
    const b = corners[(k + 1) % corners.length];
    one.fromArray(a);
    two.fromArray(b);
    n[0] += (one.y - two.y) * (one.z + two.z);
    n[1] += (one.z - two.z) * (one.x + two.x);
    n[2] += (one.x - two.x) * (one.y + two.y);
  });
  const length = Math.hypot(...n) || 1;
  return n.map((v) => v / length);
}

/// Linear [r, g, b] of '#rrggbb'.
export const linear = (colour) => new THREE.Color(colour).toArray();

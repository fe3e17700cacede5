// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The rocks of a scene at a time: where each one is, and which of them are drawn.

import * as THREE from 'three';
import {changed} from './scene_parts.js';

const position = new THREE.Vector3(),
  turn = new THREE.Quaternion(),
  sphere = new THREE.Sphere(),
  frustum = new THREE.Frustum(),
  matrix = new THREE.Matrix4();

export class Rocks {
  /// cover: of rock_cover.js, or null where rocks do not lie in a box.
  constructor(parts, poses, cover) {
    this.parts = parts;
    this.poses = poses;
    this.cover = cover;
    this.count = parts.reduce((sum, part) => sum + part.members.length, 0);
    this.places = new Float32Array(3 * this.count);
    this.turns = new Float32Array(4 * this.count);
    this.radii = Float32Array.from(parts.flatMap((part) => part.members.map(() => part.radius)));
    this.there = new Uint8Array(this.count);
  }

  setTime(place) {
    let k = 0;
    for (const part of this.parts)
      for (const body of part.members) {
        this.there[k] = this.poses.read(body, place, position, turn) ? 1 : 0;
        position.toArray(this.places, 3 * k);
        turn.toArray(this.turns, 4 * k);
        ++k;
      }
    this.cover?.update(this.count, this.places, this.radii, this.there);
    this.uncovered = null;
  }

  /// Writes those that a camera may see into the parts; of all cameras without one. How many these are.
  choose(camera = null) {
    if (camera && this.cover?.seenFrom(camera.position)) this.uncovered = null;
    this.uncovered ??= Uint8Array.from(this.there, (is, k) => (is && !this.isCovered(k) ? 1 : 0));
    if (camera)
      frustum.setFromProjectionMatrix(matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
    let k = 0,
      chosen = 0;
    for (const part of this.parts) {
      let n = 0;
      for (let m = 0; m < part.members.length; ++m, ++k) {
        if (!this.uncovered[k]) continue;
        if (camera) {
          sphere.center.fromArray(this.places, 3 * k);
          sphere.radius = this.radii[k];
          if (!frustum.intersectsSphere(sphere) || this.isBehind(camera, k)) continue;
        }
        this.write(part, n++, k, m);
      }
      changed(part, n);
      chosen += n;
    }
    return chosen;
  }

  growBox(box) {
    for (let k = 0; k < this.count; ++k) {
      if (!this.there[k]) continue;
      position.fromArray(this.places, 3 * k);
      box.expandByPoint(position.clone().addScalar(this.radii[k])).expandByPoint(position.addScalar(-this.radii[k]));
    }
  }

  isCovered(k) {
    return this.cover?.hides(this.places[3 * k], this.places[3 * k + 1], this.places[3 * k + 2], this.radii[k]);
  }

  isBehind(camera, k) {
    return this.cover?.hidesFrom(
      camera.position,
      this.places[3 * k],
      this.places[3 * k + 1],
      this.places[3 * k + 2],
      this.radii[k],
    );
  }

  write({place, turn, tint, tints}, n, k, m) {
    for (let i = 0; i < 3; ++i) {
      place[4 * n + i] = this.places[3 * k + i];
      tint[3 * n + i] = tints[3 * m + i];
    }
    place[4 * n + 3] = 1;
    for (let i = 0; i < 4; ++i) turn[4 * n + i] = this.turns[4 * k + i];
  }
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The rocks of a scene at a time: where each one is, and which of them are drawn.

import * as THREE from 'three';
import {KeptRocks} from './kept_rocks.js';
import {changed} from './scene_parts.js';

// While pictures follow each other:
const stale = 0.2, // [s] that what covers the pile's core may be late
  unseen = 0.04; // [m] that a rock may be off

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
    this.reads = new Float64Array(2 * this.count).fill(NaN); // [s] when each was read, and until when that will do
    this.moved = false; // since what covers the core was reckoned, for the time `covered`
    this.kept = new KeptRocks(this);
  }

  /// hurried: pictures follow each other, and rocks may be late by what one does not see.
  setTime(place, hurried) {
    const {reads, places, turns, there, radii} = this;
    this.time = place.t;
    let k = -1;
    for (const part of this.parts)
      for (const body of part.members) {
        ++k;
        const [from, to] = reads.subarray(2 * k, 2 * k + 2);
        if (hurried && from <= place.t && place.t <= to) continue;
        there[k] = this.poses.read(body, place, position, turn) ? 1 : 0;
        position.toArray(places, 3 * k);
        turn.toArray(turns, 4 * k);
        reads[2 * k] = place.t;
        reads[2 * k + 1] = this.poses.staysUntil(body, place, radii[k], unseen);
        this.kept.look(k);
        this.moved = true;
      }
    const soon = hurried && Math.abs(place.t - this.covered) < stale;
    if (!this.moved || soon) return;
    this.moved = false;
    this.cover?.update(this.count, places, this.radii, there);
    this.covered = place.t;
    this.uncovered = null;
  }

  findUncovered(camera) {
    if (camera && this.cover?.seenFrom(camera.position)) this.uncovered = null;
    if (this.uncovered) return;
    this.uncovered = Uint8Array.from(this.there, (is, k) => (is && !this.isCovered(k) ? 1 : 0));
    this.kept.lookAtAll();
  }

  /// Sets what isSeen looks through.
  aim(camera) {
    frustum.setFromProjectionMatrix(matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
  }

  isSeen(camera, k) {
    sphere.center.fromArray(this.places, 3 * k);
    sphere.radius = this.radii[k];
    return frustum.intersectsSphere(sphere) && !this.isBehind(camera, k);
  }

  /// Writes those that a camera may see into the parts; of all cameras without one.
  choose(camera = null) {
    this.findUncovered(camera);
    if (camera) this.aim(camera);
    this.writeThose((k) => this.uncovered[k] && (!camera || this.isSeen(camera, k)));
  }

  writeThose(drawn) {
    let k = 0;
    for (const part of this.parts) {
      let n = 0;
      for (let m = 0; m < part.members.length; ++m, ++k) if (drawn(k)) this.write(part, n++, k, m);
      changed(part, n);
    }
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

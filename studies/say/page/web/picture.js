// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// A picture of a scene: with smooth edges, or coarse where pictures follow each other and the machine is slow.

import * as THREE from 'three';
import {overAll} from './over_all.js';

const slow = 45, // [ms] between two pictures, above which they get coarser
  fewer = 0.7, // of the pixels along a side, in the coarsest
  enough = 6, // pictures that show how fast the machine is, or two
  long = 500, // [ms] that they take together
  pause = 10000; // [ms] that show nothing of it

/// How long pictures take while they follow each other: they are smooth (level 0), coarse (1), or coarse of fewer
/// pixels (2).
export class Pace {
  constructor() {
    this.hurrying = false;
    this.slowness = 0;
    this.restart();
  }

  get level() {
    return this.hurrying ? this.slowness : 0;
  }

  /// The share of the pixels along a side.
  get share() {
    return this.level > 1 ? fewer : 1;
  }

  hurry(on) {
    this.hurrying = on;
    this.restart();
  }

  restart() {
    this.before = 0;
    this.spans = [];
  }

  /// A picture is about to be drawn.
  drawn() {
    const now = performance.now(),
      span = now - this.before;
    if (this.hurrying && this.before && span < pause) this.spans.push(span);
    this.before = now;
    const count = this.spans.length,
      total = this.spans.reduce((sum, value) => sum + value, 0);
    if (count < enough && !(count > 1 && total > long)) return;
    if (total / count > slow) this.slowness = Math.min(2, this.slowness + 1);
    this.spans = [];
  }
}

/// Draws on the renderer's canvas.
export class Picture {
  constructor(renderer) {
    this.renderer = renderer;
    this.size = new THREE.Vector2();
    this.target = new THREE.WebGLRenderTarget(1, 1, {samples: 4, depthBuffer: true, generateMipmaps: false});
    this.copy = overAll(
      `
      precision highp float;
      uniform sampler2D drawn;
      out vec4 pixel;
      void main() { pixel = texelFetch(drawn, ivec2(gl_FragCoord.xy), 0); }`,
      {drawn: {value: this.target.texture}},
      {depthTest: false, depthWrite: false},
    );
    this.camera = new THREE.Camera();
  }

  draw(scene, camera, smooth) {
    const {renderer, target, size} = this;
    if (!smooth) {
      renderer.render(scene, camera);
      return;
    }
    renderer.getDrawingBufferSize(size);
    if (target.width !== size.x || target.height !== size.y) target.setSize(size.x, size.y);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.render(this.copy, this.camera);
  }

  end() {
    this.target.dispose();
    this.copy.geometry.dispose();
    this.copy.material.dispose();
  }
}

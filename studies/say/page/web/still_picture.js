// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What stands still before a camera that stands still, drawn once and kept. A picture is then what is kept, and what
// moves. Where a rock leaves its place or comes to rest that part alone is drawn anew.
//
// Kept are the parts of the light (surface_material.js, STILL), and what they give with the shadows and the head lamps,
// of which each picture makes one strip anew.

import * as THREE from 'three';
import {stillPasses} from './still_passes.js';
import {stillMaterial} from './surface_material.js';

const wide = 0.6, // of the picture: a larger part is drawn as all of it
  strips = 4; // so many pictures late are shadows, and rocks that leave their places or come to rest

const target = (count) =>
  new THREE.WebGLRenderTarget(1, 1, {count, magFilter: THREE.NearestFilter, minFilter: THREE.NearestFilter});

/// [left, bottom, width, height] in pixels of a part [left, bottom, right, top] of -1 to 1; null: there are none.
function pixels(part, width, height) {
  const at = (v, n) => Math.max(0, Math.min(n, 0.5 * n * (v + 1)));
  const [left, bottom] = [Math.floor(at(part[0], width)), Math.floor(at(part[1], height))],
    [right, top] = [Math.ceil(at(part[2], width)), Math.ceil(at(part[3], height))];
  return right > left && top > bottom ? [left, bottom, right - left, top - bottom] : null;
}

/// The target, of which only this part is drawn.
function cut(target, part) {
  target.scissorTest = true;
  target.scissor.set(...(pixels(part, target.width, target.height) ?? [0, 0, 0, 0]));
  return target;
}

export class StillPicture {
  constructor(renderer, light) {
    this.renderer = renderer;
    this.parts = target(3);
    const depths = (this.parts.depthTexture = new THREE.DepthTexture(1, 1, THREE.UnsignedIntType));
    this.shown = target(1);
    this.shown.depthBuffer = false;
    this.material = stillMaterial(light);
    this.toWorld = new THREE.Matrix4();
    this.passes = stillPasses(light, this.toWorld, this.parts.textures, depths, this.shown.texture);
    this.flat = new THREE.Camera();
    this.size = new THREE.Vector2();
    this.view = new THREE.Matrix4();
    this.before = new THREE.Matrix4(); // the view of the last picture
    this.pictures = 0; // made of what is kept
  }

  /// Draws a picture on the canvas if the camera stands where it stood in the last one; else false.
  draw(stage, camera) {
    const {renderer, view, before, size, parts} = this;
    view.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    renderer.getDrawingBufferSize(size);
    if (!view.equals(before) || size.x !== parts.width || size.y !== parts.height) {
      before.copy(view);
      parts.setSize(size.x, size.y);
      this.shown.setSize(size.x, size.y);
      return false;
    }
    const clears = renderer.autoClear;
    renderer.autoClear = false;
    this.keep(stage, camera);
    this.pass(this.passes.copy, null);
    stage.rocks.kept.chooseOthers();
    stage.withoutStill(() => renderer.render(stage.scene, camera));
    renderer.autoClear = clears;
    ++this.pictures;
    return true;
  }

  /// The next picture keeps everything anew.
  forget() {
    this.pictures = 0;
  }

  keep(stage, camera) {
    const {kept} = stage.rocks,
      strip = this.pictures % strips;
    if (!this.pictures) {
      this.toWorld.copy(this.view).invert();
      kept.forget();
    }
    let part = strip === 0 ? kept.settle(camera, this.view) : null;
    if (!this.pictures || (part && (part[2] - part[0]) * (part[3] - part[1]) > 4 * wide)) part = [-1, -1, 1, 1];
    if (part) this.drawParts(stage, camera, part);
    if (part) this.pass(this.passes.light, cut(this.shown, part));
    if (this.pictures)
      this.pass(this.passes.light, cut(this.shown, [-1, (2 * strip) / strips - 1, 1, (2 * (strip + 1)) / strips - 1]));
  }

  drawParts(stage, camera, part) {
    const {renderer, parts, material} = this;
    stage.rocks.kept.chooseKept(part);
    renderer.setRenderTarget(cut(parts, part));
    renderer.clear();
    for (const scene of [stage.fixed, stage.resting]) {
      scene.overrideMaterial = material;
      renderer.render(scene, camera);
      scene.overrideMaterial = null;
    }
    renderer.setRenderTarget(null);
  }

  /// On a target; null: the canvas.
  pass(mesh, target) {
    const {renderer, flat} = this;
    renderer.setRenderTarget(target);
    renderer.render(mesh, flat);
    renderer.setRenderTarget(null);
  }

  end() {
    this.parts.dispose();
    this.shown.dispose();
    this.material.dispose();
    for (const {geometry, material} of Object.values(this.passes)) {
      geometry.dispose();
      material.dispose();
    }
  }
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Shadows of the key light, in two maps: that of what rests covers the scene and is made anew only when asked for; that
// of what moves covers it closely.

import * as THREE from 'three';
import {depthMaterial} from './surface_material.js';

const side = 1024,
  movingSide = 512;
const halves = new THREE.Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);

/// Depths from the light, and the matrix that finds a place in them.
class DepthMap {
  constructor(renderer, size, texture, matrix) {
    this.target = new THREE.WebGLRenderTarget(size, size, {depthBuffer: true});
    const depths = (this.target.depthTexture = new THREE.DepthTexture(size, size, THREE.UnsignedIntType));
    depths.compareFunction = THREE.LessEqualCompare;
    depths.magFilter = depths.minFilter = THREE.LinearFilter;
    renderer.initRenderTarget(this.target);
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
    this.camera.up.set(0, 0, 1);
    this.matrix = matrix.value;
    texture.value = depths;
  }

  /// The map holds this sphere from now on.
  cover(centre, radius, way) {
    const {camera} = this;
    Object.assign(camera, {left: -radius, right: radius, top: radius, bottom: -radius, near: 0.1, far: 4 * radius});
    camera.position.copy(centre).addScaledVector(way, 2 * radius);
    camera.lookAt(centre);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.matrix.copy(halves).multiply(camera.projectionMatrix).multiply(camera.matrixWorldInverse);
  }
}

export class ShadowMap {
  constructor(renderer, light) {
    this.renderer = renderer;
    this.light = light;
    this.resting = new DepthMap(renderer, side, light.shadow, light.shadowMatrix);
    this.moving = new DepthMap(renderer, movingSide, light.movingShadow, light.movingMatrix);
    this.material = depthMaterial();
    this.late = true; // the shadow of what moves is a moved one
  }

  /// The light covers this sphere from now on.
  cover(centre, radius) {
    this.resting.cover(centre, radius, this.light.keyWay.value);
  }

  drawResting(scene) {
    this.draw(scene, this.resting);
  }

  /// Draws a scene that lies within a box, and goes with an anchor. Where it may be late every second one is the last
  /// one, moved by what the anchor has moved.
  drawMoving(scene, box, anchor, mayBeLate) {
    if (mayBeLate && !this.late) {
      this.late = true;
      const {x, y, z} = this.anchor.sub(anchor);
      this.moving.matrix.multiply(new THREE.Matrix4().makeTranslation(x, y, z));
    } else {
      this.late = false;
      const {center, radius} = box.getBoundingSphere(new THREE.Sphere());
      this.moving.cover(center, Math.max(0.1, radius), this.light.keyWay.value);
      this.draw(scene, this.moving);
    }
    this.anchor = anchor.clone();
  }

  draw(scene, {target, camera}) {
    const {renderer} = this;
    renderer.setRenderTarget(target);
    scene.overrideMaterial = this.material;
    renderer.render(scene, camera);
    scene.overrideMaterial = null;
    renderer.setRenderTarget(null);
  }

  end() {
    this.resting.target.dispose();
    this.moving.target.dispose();
    this.material.dispose();
  }
}

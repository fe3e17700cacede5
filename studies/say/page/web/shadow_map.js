// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Shadows of the key light. What rests is drawn into a map of its own, which is made anew only when asked for; what
// moves is added to a copy of it for each picture.

import * as THREE from 'three';
import {depthMaterial} from './surface_material.js';

const side = 1024;

function target() {
  const map = new THREE.WebGLRenderTarget(side, side, {depthBuffer: true});
  map.depthTexture = new THREE.DepthTexture(side, side, THREE.UnsignedIntType);
  map.depthTexture.compareFunction = THREE.LessEqualCompare;
  map.depthTexture.magFilter = map.depthTexture.minFilter = THREE.LinearFilter;
  return map;
}

export class ShadowMap {
  constructor(renderer, light) {
    this.renderer = renderer;
    this.light = light;
    this.resting = target();
    this.all = target();
    for (const map of [this.resting, this.all]) renderer.initRenderTarget(map);
    this.material = depthMaterial();
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
    this.camera.up.set(0, 0, 1);
    light.shadow.value = this.all.depthTexture;
  }

  /// The light covers this sphere from now on.
  cover(centre, radius) {
    const {camera} = this;
    Object.assign(camera, {left: -radius, right: radius, top: radius, bottom: -radius, near: 0.1, far: 4 * radius});
    camera.position.copy(centre).addScaledVector(this.light.keyWay.value, 2 * radius);
    camera.lookAt(centre);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    const halves = new THREE.Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);
    this.light.shadowMatrix.value.copy(halves).multiply(camera.projectionMatrix).multiply(camera.matrixWorldInverse);
  }

  draw(scene, map, clears) {
    const {renderer} = this,
      before = renderer.autoClear;
    renderer.autoClear = clears;
    renderer.setRenderTarget(map);
    scene.overrideMaterial = this.material;
    renderer.render(scene, this.camera);
    scene.overrideMaterial = null;
    renderer.setRenderTarget(null);
    renderer.autoClear = before;
  }

  /// scenes: what rests, and what moves.
  update(resting, moving, restingAnew) {
    if (restingAnew) this.draw(resting, this.resting, true);
    this.renderer.copyTextureToTexture(this.resting.depthTexture, this.all.depthTexture);
    this.draw(moving, this.all, false);
  }

  end() {
    this.resting.dispose();
    this.all.dispose();
    this.material.dispose();
  }
}

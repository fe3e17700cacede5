// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What is behind a scene, and the glow around its lamps.

import * as THREE from 'three';
import {aroundPicture} from './over_all.js';

/// Fills what nothing covers: from one colour below to another above.
export class Backdrop {
  constructor() {
    this.low = {value: new THREE.Vector3()};
    this.high = {value: new THREE.Vector3()};
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: `
        precision highp float;
        in vec3 position;
        out float up;
        void main() { up = 0.5 + 0.5 * position.y; gl_Position = vec4(position.xy, 1.0, 1.0); }`,
      fragmentShader: `
        precision highp float;
        in float up;
        uniform vec3 low, high;
        out vec4 pixel;
        void main() { pixel = vec4(mix(low, high, up), 1.0); }`,
      uniforms: {low: this.low, high: this.high},
      depthWrite: false,
    });
    this.mesh = new THREE.Mesh(aroundPicture(), material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 3;
  }

  /// As the screen shows them: '#rrggbb'.
  tint(low, high) {
    for (const [to, hex] of [
      [this.low.value, low],
      [this.high.value, high],
    ])
      to.fromArray([1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255));
  }
}

/// Round glows, bright in the middle; places: Vector4 of x, y, z and radius [m], which may change.
export class Glows {
  constructor(count) {
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.places = new THREE.InstancedBufferAttribute(new Float32Array(4 * count), 4);
    geometry.setAttribute('place', this.places);
    geometry.instanceCount = count;
    const material = new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: `
        precision highp float;
        in vec3 position;
        in vec4 place;
        uniform mat4 viewMatrix, projectionMatrix;
        out vec2 at;
        void main() {
          at = position.xy;
          vec4 middle = viewMatrix * vec4(place.xyz, 1.0);
          middle.xyz += 0.25 * normalize(-middle.xyz); // out of the lamp
          gl_Position = projectionMatrix * (middle + vec4(place.w * position.xy, 0.0, 0.0));
        }`,
      fragmentShader: `
        precision highp float;
        in vec2 at;
        out vec4 pixel;
        void main() {
          float f = max(0.0, 1.0 - dot(at, at));
          pixel = vec4(vec3(1.0, 0.86, 0.62) * (0.5 * f * f * f), 1.0);
        }`,
      blending: THREE.AdditiveBlending,
      transparent: true,
      depthWrite: false,
    });
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 4;
  }

  set(k, [x, y, z], radius) {
    this.places.setXYZW(k, x, y, z, radius);
    this.places.needsUpdate = true;
  }
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What covers all of a picture.

import * as THREE from 'three';

/// A triangle around the square from -1 to 1.
export function aroundPicture() {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute([-1, -1, 0, 3, -1, 0, -1, 3, 0], 3));
  return geometry;
}

/// What a shader makes of textures and light at each pixel; state: of the material.
export function overAll(fragmentShader, uniforms, state) {
  const material = new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
    fragmentShader,
    uniforms,
    ...state,
  });
  const mesh = new THREE.Mesh(aroundPicture(), material);
  mesh.frustumCulled = false;
  return mesh;
}

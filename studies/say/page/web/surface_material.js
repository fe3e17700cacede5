// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How surfaces of a scene look. Light is reckoned per vertex, for facets are flat and drawing in software pays per
// triangle and per pixel; a pixel adds the shadow and the grain of the material.
//
// Attributes per vertex: position, normal, colour (linear), finish (grain, glow, dust: each 0 to 1). Per instance:
// place (x, y, z, and 1, or 0 where it hides), turn (quaternion x y z w), tint (linear).

import * as THREE from 'three';
import {grainTexture} from './grain.js';

export const mostLamps = 8;

/// What all materials of a scene share: its light, the shadow, and the heights of the rock, which darken what lies
/// deep.
export function sharedLight() {
  return {
    lamps: {value: Array.from({length: mostLamps}, () => new THREE.Vector4(0, 0, 0, 0))}, // x y z, strength
    lampColour: {value: new THREE.Color('#ffdcae')},
    head: {value: new THREE.Vector4(0, 0, 0, 0)}, // place of the machine's head lamps, strength
    headWay: {value: new THREE.Vector3(1, 0, 0)},
    keyWay: {value: new THREE.Vector3(-0.4, -0.5, 0.77)}, // to the light
    keyColour: {value: new THREE.Color(1, 1, 1)},
    skyColour: {value: new THREE.Color(1, 1, 1)},
    groundColour: {value: new THREE.Color(1, 1, 1)},
    shadow: {value: null},
    shadowMatrix: {value: new THREE.Matrix4()},
    grain: {value: grainTexture()},
    heights: {value: null},
    heightsBox: {value: new THREE.Vector4(0, 0, 0, 0)}, // low x, low y, 1 / extents
    heightsScale: {value: 0}, // [m]; 0: there is no rock
    shown: {value: 1}, // opacity
  };
}

const turned = `
  vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }`;

// From light to what a screen shows.
const seen = `
  vec3 seen(vec3 light) { return sqrt(light * (1.0 + 0.18 * light) / (1.0 + light)); }`;

const vertexShader = `
  precision highp float;
  in vec3 position, normal, colour, finish;
  in vec4 place, turn;
  in vec3 tint;
  uniform mat4 viewMatrix, projectionMatrix, shadowMatrix;
  uniform vec4 lamps[${mostLamps}], head, heightsBox;
  uniform vec3 lampColour, headWay, keyWay, keyColour, skyColour, groundColour;
  uniform float heightsScale;
  uniform sampler2D heights;
  #ifdef SIMPLE
  precision highp sampler2DShadow;
  uniform sampler2DShadow shadow;
  out vec3 shade;
  #else
  out vec3 near, far, inShadow, grainAt;
  #endif
  ${turned}
  ${seen}

  // Of the sky that a place sees: less the deeper it lies below the rock around it.
  float openness(vec3 p, vec3 n) {
    if (heightsScale == 0.0) return 1.0;
    vec2 at = clamp((p.xy + 0.15 * n.xy - heightsBox.xy) * heightsBox.zw, 0.0, 1.0);
    float depth = max(0.0, heightsScale * texture(heights, at).r - p.z - 0.1 * n.z);
    return 1.0 / (1.0 + 5.0 * depth * depth + 0.9 * depth);
  }

  void main() {
    vec3 p = place.xyz + place.w * turned(turn, position), n = turned(turn, normal);
    vec3 light = mix(groundColour, skyColour, 0.5 + 0.5 * n.z);
    for (int k = 0; k < ${mostLamps}; ++k) {
      if (lamps[k].w == 0.0) break;
      vec3 way = lamps[k].xyz - p;
      float square = dot(way, way);
      float facing = max(0.0, (dot(n, way) * inversesqrt(square) + 0.2) / 1.2);
      light += lampColour * (lamps[k].w * facing / (1.0 + 0.55 * square));
    }
    vec3 beam = p - head.xyz;
    float reach = length(beam), along = dot(beam, headWay) / reach;
    float beamed = smoothstep(0.80, 0.97, along) * max(0.0, -dot(n, beam) / reach);
    light += vec3(1.0, 0.95, 0.85) * (head.w * beamed / (1.0 + 0.06 * reach * reach));
    float open = openness(p, n);
    vec3 dusty = mix(colour * tint, vec3(0.33, 0.29, 0.24), finish.z * max(0.0, n.z));
    vec3 always = dusty * (light * open + 6.0 * finish.y);
    vec3 unshaded = dusty * keyColour * (max(0.0, dot(n, keyWay)) * sqrt(open) * (1.0 - finish.y));
    vec3 onMap = (shadowMatrix * vec4(p + 0.04 * n, 1.0)).xyz;
    gl_Position = projectionMatrix * (viewMatrix * vec4(p, 1.0));
  #ifdef SIMPLE
    shade = seen(always + unshaded * texture(shadow, onMap));
  #else
    near = always;
    far = unshaded;
    inShadow = onMap;
    vec3 a = abs(normal);
    vec2 flatly = a.z > a.x && a.z > a.y ? position.xy : a.x > a.y ? position.yz : position.xz;
    grainAt = vec3(0.55 * flatly + 7.0 * tint.xy, finish.x);
  #endif
  }`;

const fragmentShader = `
  precision highp float;
  out vec4 pixel;
  uniform float shown;
  #ifdef SIMPLE
  in vec3 shade;
  void main() { pixel = vec4(shade, shown); }
  #else
  precision highp sampler2DShadow;
  in vec3 near, far, inShadow, grainAt;
  uniform sampler2DShadow shadow;
  uniform sampler2D grain;
  ${seen}
  float lit() {
  #ifdef SMOOTH
    vec2 off = vec2(0.7, -0.7) / float(textureSize(shadow, 0).x);
    float sum = texture(shadow, inShadow + vec3(off.xx, 0.0)) + texture(shadow, inShadow + vec3(off.xy, 0.0));
    sum += texture(shadow, inShadow + vec3(off.yx, 0.0)) + texture(shadow, inShadow + vec3(off.yy, 0.0));
    return 0.25 * sum;
  #else
    return texture(shadow, inShadow);
  #endif
  }
  void main() {
    vec3 light = near + far * lit();
    light *= 1.0 + grainAt.z * (texture(grain, grainAt.xy).r - 0.5);
    pixel = vec4(seen(light), shown);
  }
  #endif`;

const depthVertexShader = `
  precision highp float;
  in vec3 position;
  in vec4 place, turn;
  uniform mat4 viewMatrix, projectionMatrix;
  ${turned}
  void main() {
    gl_Position = projectionMatrix * (viewMatrix * vec4(place.xyz + place.w * turned(turn, position), 1.0));
  }`;

const depthFragmentShader = `
  precision highp float;
  out vec4 pixel;
  void main() { pixel = vec4(1.0); }`;

/// quality: SMOOTH, with soft edges of shadows; SIMPLE, without grain and with shadows per vertex; or "".
export function surfaceMaterial(light, {opacity = 1, quality = ''} = {}) {
  const see = opacity < 1;
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    defines: quality ? {[quality]: ''} : {},
    vertexShader,
    fragmentShader,
    uniforms: {...light, shown: {value: opacity}},
    transparent: see,
    depthWrite: !see,
    side: see ? THREE.DoubleSide : THREE.FrontSide,
  });
}

/// For the shadow map: only how far away things are.
export const depthMaterial = () =>
  new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: depthVertexShader,
    fragmentShader: depthFragmentShader,
    side: THREE.DoubleSide,
    colorWrite: false,
  });

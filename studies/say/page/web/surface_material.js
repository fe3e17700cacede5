// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// How surfaces of a scene look. Light is reckoned per vertex, for facets are flat and drawing in software pays per
// triangle and per pixel; a pixel adds the shadow and the grain of the material.
//
// What is kept of a still picture (still_picture.js) is the same in parts: STILL writes what is always there, what the
// key light adds where nothing shades it, and what the head lamps' light falls on, with the normal in the places that
// are left; stillPasses puts the three together, and the head lamps and the shadow with them.
//
// Attributes per vertex: position, normal, colour (linear), finish (grain, glow, dust: each 0 to 1). Per instance:
// place (x, y, z, and 1, or 0 where it hides), turn (quaternion x y z w), tint (linear).

import * as THREE from 'three';
import {grainTexture} from './grain.js';
import {beamed, folded, packed, seen, turned, within} from './shader_parts.js';

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
    shadow: {value: null}, // of what rests
    shadowMatrix: {value: new THREE.Matrix4()},
    movingShadow: {value: null},
    movingMatrix: {value: new THREE.Matrix4()},
    grain: {value: grainTexture()},
    heights: {value: null},
    heightsBox: {value: new THREE.Vector4(0, 0, 0, 0)}, // low x, low y, 1 / extents
    heightsScale: {value: 0}, // [m]; 0: there is no rock
    shown: {value: 1}, // opacity
  };
}

const vertexShader = `
  precision highp float;
  in vec3 position, normal, colour, finish;
  in vec4 place, turn;
  in vec3 tint;
  uniform mat4 viewMatrix, projectionMatrix, shadowMatrix, movingMatrix;
  uniform vec4 lamps[${mostLamps}], heightsBox;
  uniform vec3 lampColour, keyWay, keyColour, skyColour, groundColour;
  uniform float heightsScale;
  uniform sampler2D heights;
  #if defined(SIMPLE) || defined(QUICK)
  precision highp sampler2DShadow;
  uniform sampler2DShadow shadow, movingShadow;
  #endif
  #ifdef SIMPLE
  out vec3 shade;
  #else
  out vec3 near, far, inShadow, inMoving, grainAt;
  #endif
  #ifdef STILL
  out vec3 own, facing;
  #endif
  ${turned}
  ${seen}
  ${beamed}
  ${within}

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
  #ifndef STILL
    light += beamed(p, n);
  #endif
    float open = openness(p, n);
    vec3 dusty = mix(colour * tint, vec3(0.33, 0.29, 0.24), finish.z * max(0.0, n.z));
    vec3 always = dusty * (light * open + 6.0 * finish.y);
    vec3 unshaded = dusty * keyColour * (max(0.0, dot(n, keyWay)) * sqrt(open) * (1.0 - finish.y));
    vec4 above = vec4(p + 0.04 * n, 1.0);
    vec3 onMap = (shadowMatrix * above).xyz, onMoving = (movingMatrix * above).xyz;
    gl_Position = projectionMatrix * (viewMatrix * vec4(p, 1.0));
  #ifdef SIMPLE
    shade = seen(always + unshaded * (texture(shadow, onMap) * texture(movingShadow, within(onMoving))));
  #else
    near = always;
    far = unshaded;
  #ifdef QUICK
    far *= texture(shadow, onMap);
  #endif
    inShadow = onMap;
    inMoving = onMoving;
    vec3 a = abs(normal);
    vec2 flatly = a.z > a.x && a.z > a.y ? position.xy : a.x > a.y ? position.yz : position.xz;
    grainAt = vec3(0.55 * flatly + 7.0 * tint.xy, finish.x);
  #endif
  #ifdef STILL
    own = dusty * open;
    facing = n;
  #endif
  }`;

const fragmentShader = `
  precision highp float;
  #ifdef STILL
  layout(location = 0) out vec4 always;
  layout(location = 1) out vec4 keyed;
  layout(location = 2) out vec4 lit;
  in vec3 near, far, grainAt, own, facing;
  uniform sampler2D grain;
  ${packed}
  ${folded}
  void main() {
    float bright = 1.0 + grainAt.z * (texture(grain, grainAt.xy).r - 0.5);
    vec2 normal = folded(facing);
    always = vec4(packed(bright * near), normal.x);
    keyed = vec4(packed(bright * far), normal.y);
    lit = vec4(packed(bright * own), 1.0);
  }
  #else
  out vec4 pixel;
  uniform float shown;
  #ifdef SIMPLE
  in vec3 shade;
  void main() { pixel = vec4(shade, shown); }
  #else
  precision highp sampler2DShadow;
  in vec3 near, far, inShadow, inMoving, grainAt;
  uniform sampler2DShadow shadow, movingShadow;
  uniform sampler2D grain;
  ${seen}
  ${within}
  float softly(sampler2DShadow map, vec3 at) {
    vec2 off = vec2(0.7, -0.7) / float(textureSize(map, 0).x);
    float sum = texture(map, at + vec3(off.xx, 0.0)) + texture(map, at + vec3(off.xy, 0.0));
    return 0.25 * (sum + texture(map, at + vec3(off.yx, 0.0)) + texture(map, at + vec3(off.yy, 0.0)));
  }
  float lit() {
  #ifdef QUICK
    return texture(movingShadow, within(inMoving));
  #else
    return softly(shadow, inShadow) * softly(movingShadow, within(inMoving));
  #endif
  }
  void main() {
    vec3 light = near + far * lit();
  #ifndef QUICK
    light *= 1.0 + grainAt.z * (texture(grain, grainAt.xy).r - 0.5);
  #endif
    pixel = vec4(seen(light), shown);
  }
  #endif
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

/// quality: SMOOTH, with soft edges of shadows; QUICK, without grain and with the shadow of what rests per
/// vertex; SIMPLE, with both shadows so; STILL, in parts.
export function surfaceMaterial(light, {opacity = 1, quality}) {
  const see = opacity < 1;
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    defines: {[quality]: ''},
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

export const stillMaterial = (light) => surfaceMaterial(light, {quality: 'STILL'});

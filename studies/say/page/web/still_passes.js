// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What makes a picture of a still one that is kept in parts (still_picture.js).

import * as THREE from 'three';
import {overAll} from './over_all.js';
import {beamed, folded, packed, seen, within} from './shader_parts.js';

const lightShader = `
  precision highp float;
  precision highp sampler2DShadow;
  uniform sampler2D always, keyed, lit, depths;
  uniform sampler2DShadow shadow, movingShadow;
  uniform mat4 toWorld, shadowMatrix, movingMatrix;
  out vec4 pixel;
  ${seen}
  ${beamed}
  ${packed}
  ${folded}
  ${within}
  void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 first = texelFetch(always, at, 0), second = texelFetch(keyed, at, 0);
    vec2 share = gl_FragCoord.xy / vec2(textureSize(depths, 0));
    vec4 place = toWorld * vec4(2.0 * vec3(share, texelFetch(depths, at, 0).r) - 1.0, 1.0);
    vec3 p = place.xyz / place.w, n = unfolded(vec2(first.a, second.a));
    vec4 above = vec4(p + 0.04 * n, 1.0);
    float key = texture(shadow, (shadowMatrix * above).xyz) * texture(movingShadow, within((movingMatrix * above).xyz));
    vec3 light = unpacked(first.rgb) + key * unpacked(second.rgb), beam = beamed(p, n);
    if (beam.r > 0.0) light += unpacked(texelFetch(lit, at, 0).rgb) * beam;
    pixel = vec4(seen(light), 1.0);
  }`;

const copyShader = `
  precision highp float;
  uniform sampler2D shown, depths;
  out vec4 pixel;
  void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    gl_FragDepth = texelFetch(depths, at, 0).r;
    pixel = texelFetch(shown, at, 0);
  }`;

/// {light, copy}: meshes over all of a picture. The one puts together the three parts of a still picture, with
/// their depths, the shadows and the head lamps' light; toWorld turns a place in the picture into one in the world. The
/// other shows what that made, and how far away it is.
export function stillPasses(light, toWorld, parts, depths, shown) {
  const [always, keyed, lit] = parts;
  const {shadow, shadowMatrix, movingShadow, movingMatrix, head, headWay} = light;
  const of = (values) => Object.fromEntries(Object.entries(values).map(([name, value]) => [name, {value}]));
  const lamps = {shadow, shadowMatrix, movingShadow, movingMatrix, head, headWay};
  return {
    light: overAll(lightShader, {...of({always, keyed, lit, depths, toWorld}), ...lamps}, {depthTest: false}),
    copy: overAll(copyShader, of({shown, depths}), {depthFunc: THREE.AlwaysDepth}),
  };
}

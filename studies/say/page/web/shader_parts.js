// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Parts of the shaders of a scene, in GLSL.

export const turned = `
  vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }`;

// Light of the head lamps, of strength 1 before them, that a surface there gets.
export const beamed = `
  uniform vec4 head;
  uniform vec3 headWay;
  vec3 beamed(vec3 p, vec3 n) {
    vec3 beam = p - head.xyz;
    float square = dot(beam, beam), reach = sqrt(square), along = dot(beam, headWay), facing = -dot(n, beam);
    if (head.w == 0.0 || along < 0.80 * reach || facing <= 0.0) return vec3(0.0);
    float share = smoothstep(0.80, 0.97, along / reach) * facing / reach;
    return vec3(1.0, 0.95, 0.85) * (head.w * share / (1.0 + 0.06 * square));
  }`;

// A place in the map of what moves: nothing beyond that is in its shadow.
export const within = `
  vec3 within(vec3 onMap) { return vec3(clamp(onMap.xy, 0.0, 1.0), min(onMap.z, 0.999)); }`;

// From light to what a screen shows.
export const seen = `
  vec3 seen(vec3 light) { return sqrt(light * (1.0 + 0.18 * light) / (1.0 + light)); }`;

// Any light in a byte, dark light finely.
export const packed = `
  vec3 packed(vec3 light) { return sqrt(light / (1.0 + light)); }
  vec3 unpacked(vec3 byte) { vec3 square = byte * byte; return square / (1.004 - square); }`;

// A normal in two bytes: the sphere unfolded to a square.
export const folded = `
  vec2 around(vec2 v) { return (1.0 - abs(v.yx)) * (2.0 * step(0.0, v) - 1.0); }
  vec2 folded(vec3 n) {
    vec2 flat_ = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return 0.5 + 0.5 * (n.z < 0.0 ? around(flat_) : flat_);
  }
  vec3 unfolded(vec2 at) {
    vec2 flat_ = 2.0 * at - 1.0;
    float up = 1.0 - abs(flat_.x) - abs(flat_.y);
    return normalize(vec3(up < 0.0 ? around(flat_) : flat_, up));
  }`;

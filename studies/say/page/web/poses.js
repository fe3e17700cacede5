// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Where the bodies of a scene are at any time. A body has poses in some frames and goes evenly between them.
// They come packed, one body after the other: the frame of each pose (16 bits), and seven little-endian
// 16-bit integers, position (times scale, from origin) and quaternion w x y z (of 32767); a body that hides
// has -32768 in the first place.

const absent = -32768;

function words(text, Kind, read) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Kind.from({length: bytes.length / 2}, (_, i) => view[read](2 * i, true));
}

/// Last place of a rising list whose value is at most v, in [from, to); from - 1 where there is none.
function lastUpTo(list, v, from, to) {
  let low = from - 1,
    high = to;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (list[middle] <= v) low = middle;
    else high = middle;
  }
  return low;
}

export class Poses {
  constructor(scene) {
    const {counts, frames, data, origin, scale} = scene.poses;
    this.origin = origin;
    this.scale = scale;
    this.times = scene.frames.map((frame) => frame.t);
    this.values = words(data, Int16Array, 'getInt16');
    this.frames = words(frames, Uint16Array, 'getUint16');
    const starts = [0];
    for (const count of counts) starts.push(starts[starts.length - 1] + count);
    const carrier = scene.bodies.map((body, k) => body.with ?? k);
    this.first = Int32Array.from(carrier, (k) => starts[k]);
    this.end = Int32Array.from(carrier, (k) => starts[k + 1]);
  }

  /// The last frame up to t, the first where there is none.
  place(t) {
    return {t, k: Math.max(0, lastUpTo(this.times, t, 0, this.times.length))};
  }

  /// Sets position and quaternion of a body at a place; false where it is not shown.
  read(body, {t, k}, position, quaternion) {
    const {values, frames, times, origin, scale} = this;
    const at = lastUpTo(frames, k, this.first[body], this.end[body]);
    const a = 7 * at;
    if (at < this.first[body] || values[a] === absent) return false;
    const goes = at + 1 < this.end[body] && values[a + 7] !== absent;
    const b = goes ? a + 7 : a,
      before = times[frames[at]];
    const f = goes ? Math.min(1, Math.max(0, (t - before) / (times[frames[at + 1]] - before))) : 0;
    let dot = 0;
    for (let i = 3; i < 7; ++i) dot += values[a + i] * values[b + i];
    const g = dot < 0 ? -f : f,
      mix = (i, share) => (1 - f) * values[a + i] + share * values[b + i];
    position.set(origin[0] + scale * mix(0, f), origin[1] + scale * mix(1, f), origin[2] + scale * mix(2, f));
    quaternion.set(mix(4, g), mix(5, g), mix(6, g), mix(3, g)).normalize();
    return true;
  }

  /// The time until which a body stays within `most` [m] of where it is at a place, turns counted at `radius`, or stays
  /// hidden.
  staysUntil(body, {t, k}, radius, most) {
    const end = this.end[body];
    let at = lastUpTo(this.frames, k, this.first[body], end),
      left = most,
      now = t;
    for (; at + 1 < end; ++at) {
      const next = this.time(at + 1);
      if (this.hides(body, at) !== this.hides(body, at + 1)) return next;
      if (!this.hides(body, at)) {
        const way = (this.way(at, at + 1, radius) * (next - now)) / (next - this.time(at));
        if (way > left) return now + ((next - now) * left) / way;
        left -= way;
      }
      now = next;
    }
    return Infinity;
  }

  hides(body, at) {
    return at < this.first[body] || this.values[7 * at] === absent;
  }

  time(at) {
    return this.times[this.frames[at]];
  }

  /// How far a body goes from one of its poses to another [m].
  way(a, b, radius) {
    const {values, scale} = this;
    let square = 0,
      dot = 0;
    for (let i = 0; i < 3; ++i) square += (values[7 * b + i] - values[7 * a + i]) ** 2;
    for (let i = 3; i < 7; ++i) dot += values[7 * a + i] * values[7 * b + i];
    const turn = 2 * Math.acos(Math.min(1, Math.abs(dot) / 32767 ** 2));
    return scale * Math.sqrt(square) + radius * turn;
  }
}

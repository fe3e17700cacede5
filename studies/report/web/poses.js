// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Poses of all bodies in all frames. They come packed as little-endian 16-bit integers, seven per body: position (times
// scale, from origin) and quaternion w x y z (of 32767); an absent body has -32768 in the first place.

const absent = -32768;

export class Poses {
  constructor({data, origin, scale}, bodies, times) {
    const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
    const view = new DataView(bytes.buffer);
    this.values = Int16Array.from({length: bytes.length / 2}, (_, i) => view.getInt16(2 * i, true));
    Object.assign(this, {origin, scale, bodies, times});
  }

  /// Frame before t and how far t is toward the next, 0 to 1.
  place(t) {
    let k = 0;
    while (k + 1 < this.times.length && this.times[k + 1] <= t) ++k;
    const next = this.times[k + 1];
    return {k, fraction: next === undefined ? 0 : Math.min(1, Math.max(0, (t - this.times[k]) / (next - this.times[k])))};
  }

  /// Sets position and quaternion of a body between two frames; false where it is absent.
  read(body, {k, fraction}, position, quaternion) {
    const a = 7 * (k * this.bodies + body);
    if (this.values[a] === absent) return false;
    let b = fraction > 0 ? a + 7 * this.bodies : a;
    if (this.values[b] === absent) b = a;
    const mix = (i, sign = 1) => (1 - fraction) * this.values[a + i] + fraction * sign * this.values[b + i];
    let dot = 0;
    for (let i = 3; i < 7; ++i) dot += this.values[a + i] * this.values[b + i];
    const sign = dot < 0 ? -1 : 1;
    position.set(...[0, 1, 2].map((i) => this.origin[i] + this.scale * mix(i)));
    quaternion.set(mix(4, sign), mix(5, sign), mix(6, sign), mix(3, sign)).normalize();
    return true;
  }
}

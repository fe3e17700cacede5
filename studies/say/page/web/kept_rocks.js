// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Which rocks are drawn into the picture that is kept of what stands still (still_picture.js): those that its camera
// may see and that stay where they are for a while. A rock that is hidden later stays in it: what hides it is drawn.
// Parts of the picture are [left, bottom, right, top] of -1 to 1.

const rest = 1; // [s] that a rock must stay for

export class KeptRocks {
  constructor(rocks) {
    const {count} = rocks;
    this.rocks = rocks;
    this.is = new Uint8Array(count);
    this.seen = new Uint8Array(count); // among those that are not kept: by the camera
    this.poses = new Float32Array(7 * count); // of what is kept
    this.spans = new Float32Array(4 * count); // of what is kept: the parts in which they lie
    this.due = new Uint8Array(count).fill(1); // to be looked at
  }

  look(k) {
    this.due[k] = 1;
  }

  lookAtAll() {
    this.due.fill(1);
  }

  forget() {
    this.is.fill(0);
    this.due.fill(1);
  }

  /// Chooses anew for a camera, `view` of which turns the world into its picture. The part that changes, or null.
  settle(camera, view) {
    const {rocks, is, seen, due} = this,
      part = [1, 1, -1, -1];
    rocks.findUncovered(camera);
    rocks.aim(camera);
    const core = rocks.cover?.changes();
    if (core) grow(part, spanOfBox(core, view.elements));
    for (let k = 0; k < due.length; ++k) {
      if (!due[k]) continue;
      due[k] = 0;
      if (is[k] && this.isWhereItWas(k)) continue;
      if (is[k]) grow(part, this.span(k));
      is[k] = 0;
      seen[k] = rocks.there[k] && !rocks.isCovered(k) && rocks.isSeen(camera, k) ? 1 : 0;
      if (!seen[k]) continue;
      if (rocks.reads[2 * k + 1] - rocks.time < rest) {
        due[k] = 1; // it may stay later
        continue;
      }
      is[k] = 1;
      this.note(k, camera.projectionMatrix.elements, view.elements);
      grow(part, this.span(k));
    }
    return part[0] < part[2] && part[1] < part[3] ? part : null;
  }

  isWhereItWas(k) {
    const {places, turns, there} = this.rocks,
      pose = this.poses;
    if (!there[k]) return false;
    for (let i = 0; i < 3; ++i) if (pose[7 * k + i] !== places[3 * k + i]) return false;
    for (let i = 0; i < 4; ++i) if (pose[7 * k + 3 + i] !== turns[4 * k + i]) return false;
    return true;
  }

  note(k, projection, view) {
    const {places, turns, radii} = this.rocks,
      place = places.subarray(3 * k, 3 * k + 3);
    this.poses.set(place, 7 * k);
    this.poses.set(turns.subarray(4 * k, 4 * k + 4), 7 * k + 3);
    this.spans.set(spanOf(place, radii[k], projection, view), 4 * k);
  }

  span(k) {
    return this.spans.subarray(4 * k, 4 * k + 4);
  }

  /// Writes those of a part of the picture into the parts of the rocks.
  chooseKept([left, bottom, right, top]) {
    const {is, spans} = this;
    this.rocks.writeThose(
      (k) =>
        is[k] && spans[4 * k] < right && spans[4 * k + 1] < top && spans[4 * k + 2] > left && spans[4 * k + 3] > bottom,
    );
  }

  /// Writes those that are to be drawn beside the picture.
  chooseOthers() {
    const {is, seen} = this;
    this.rocks.writeThose((k) => seen[k] && !is[k]);
  }
}

/// The part in which a sphere lies; matrices column by column.
export function spanOf(centre, radius, projection, view) {
  const [x, y, w] = seenAt(centre, view);
  if (w <= radius) return [-1, -1, 1, 1];
  // Seen from a slant a sphere is an ellipse, up to 1.5 times as long as its radius over its nearest distance.
  const [a, b] = [projection[0], projection[5]].map((scale) => (1.5 * scale * radius) / (w - radius) + 0.005);
  return [x - a, y - b, x + a, y + b];
}

function spanOfBox({low, high}, view) {
  const span = [1, 1, -1, -1];
  for (let corner = 0; corner < 8; ++corner) {
    const [x, y, w] = seenAt(
      [0, 1, 2].map((i) => (corner & (1 << i) ? high : low)[i]),
      view,
    );
    if (w <= 0) return [-1, -1, 1, 1];
    grow(span, [x, y, x, y]);
  }
  return span;
}

/// [x, y] in the picture, and how far before the eye.
function seenAt(place, m) {
  const [x, y, z] = place;
  const w = m[3] * x + m[7] * y + m[11] * z + m[15];
  return [(m[0] * x + m[4] * y + m[8] * z + m[12]) / w, (m[1] * x + m[5] * y + m[9] * z + m[13]) / w, w];
}

function grow(part, span) {
  for (let i = 0; i < 2; ++i) {
    part[i] = Math.min(part[i], span[i]);
    part[2 + i] = Math.max(part[2 + i], span[2 + i]);
  }
}

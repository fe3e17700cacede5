// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What a replay reckons without a browser to draw quickly: until when a body stays, and which rocks are kept in a picture.

import assert from 'node:assert/strict';
import test from 'node:test';
import {KeptRocks, spanOf} from '../../studies/say/page/web/kept_rocks.js';
import {Poses} from '../../studies/say/page/web/poses.js';

const absent = -32768,
  one = 32767;
const packed = (Kind, list) => Buffer.from(Kind.from(list).buffer).toString('base64');

/// Numbers in [0, 1), the same each time.
function random(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 4294967296;
  };
}

/// Of bodies, lists of [frame, x, y, z, turn about z] with lengths in units of `scale`, or of [frame] where they hide.
function posesOf(bodies, frames, scale) {
  const rows = bodies.flat();
  const values = rows.flatMap(([, x, y, z, turn]) =>
    x === undefined
      ? [absent, 0, 0, 0, 0, 0, 0]
      : [x, y, z, Math.round(one * Math.cos(turn / 2)), 0, 0, Math.round(one * Math.sin(turn / 2))],
  );
  return new Poses({
    frames: Array.from({length: frames}, (_, t) => ({t: 0.1 * t})),
    bodies: bodies.map(() => ({})),
    poses: {
      origin: [0, 0, 0],
      scale,
      counts: bodies.map((list) => list.length),
      frames: packed(Uint16Array, rows.map(([frame]) => frame)),
      data: packed(Int16Array, values),
    },
  });
}

function poseAt(poses, body, t) {
  const p = [],
    q = [];
  const quaternion = {
    set: (...v) => {
      const n = Math.hypot(...v);
      q.splice(0, 4, ...v.map((x) => x / n));
      return {normalize: () => {}};
    },
  };
  const there = poses.read(body, poses.place(t), {set: (...v) => p.splice(0, 3, ...v)}, quaternion);
  return there ? {p, q} : null;
}

/// How far a sphere's surface has moved from one pose to another.
function way(a, b, radius) {
  const dot = Math.abs(a.q.reduce((sum, v, i) => sum + v * b.q[i], 0));
  return Math.hypot(...a.p.map((v, i) => v - b.p[i])) + 2 * radius * Math.acos(Math.min(1, dot));
}

// 10 mm per unit. Body 0 goes 1 m in a second from 1 s on; body 1 hides from 2 s to 3 s; body 2 turns by 1 rad from 0 to 1 s.
test('a body stays until it has moved by more than is allowed', () => {
  const poses = posesOf(
    [
      [[0, 0, 0, 0, 0], [10, 0, 0, 0, 0], [20, 100, 0, 0, 0]],
      [[0, 0, 0, 0, 0], [20], [30, 0, 0, 0, 0]],
      [[0, 0, 0, 0, 0], [10, 0, 0, 0, 1]],
    ],
    40,
    0.01,
  );
  const until = (body, t, radius, most) => poses.staysUntil(body, poses.place(t), radius, most);
  assert.ok(Math.abs(until(0, 0.3, 0.2, 0.05) - 1.05) < 1e-9);
  assert.ok(Math.abs(until(0, 1.5, 0.2, 0.05) - 1.55) < 1e-9);
  assert.equal(until(0, 2.5, 0.2, 0.05), Infinity);
  assert.ok(Math.abs(until(1, 0.5, 0.2, 0.05) - 2) < 1e-9);
  assert.ok(Math.abs(until(1, 2.5, 0.2, 0.05) - 3) < 1e-9);
  assert.equal(until(1, 3.5, 0.2, 0.05), Infinity);
  assert.ok(Math.abs(until(2, 0, 0.5, 0.05) - 0.1) < 1e-4);
});

// A third rests, a third begins to move at some time and rests again, a third creeps; some hide for a while.
function rocksThatMove(seed, count, frames) {
  const next = random(seed),
    bodies = [];
  for (let k = 0; k < count; ++k) {
    let at = [Math.round(6000 * next() - 3000), Math.round(6000 * next() - 3000), Math.round(1000 * next()), 6 * next()];
    const rows = [[0, ...at]];
    if (k % 3 === 1) {
      const begins = 1 + Math.floor(0.5 * frames * next());
      rows.push([begins, ...at]);
      for (let f = begins + 1; f < begins + 8; ++f) {
        at = at.map((v, i) => (i < 3 ? Math.round(v + 300 * (next() - 0.5)) : v + next()));
        rows.push([f, ...at]);
      }
    } else if (k % 3 === 2) rows.push([frames - 1, ...at.map((v, i) => (i < 3 ? v + Math.round(400 * next()) : v))]);
    if (k % 7 === 0) rows.push([rows.at(-1)[0] + 3], [rows.at(-1)[0] + 6, ...at]);
    bodies.push(rows.filter(([frame]) => frame < frames));
  }
  return posesOf(bodies, frames, 0.001);
}

// As rocks.js has them, of one part, with nothing in front of them.
class Rocks {
  constructor(poses, count, unseen) {
    Object.assign(this, {poses, count, unseen, radii: new Float32Array(count).fill(0.2), drawn: []});
    this.places = new Float32Array(3 * count);
    this.turns = new Float32Array(4 * count);
    this.there = new Uint8Array(count);
    this.reads = new Float64Array(2 * count).fill(NaN);
    this.kept = new KeptRocks(this);
  }
  setTime(t) {
    const place = this.poses.place(t);
    this.time = t;
    for (let k = 0; k < this.count; ++k) {
      if (this.reads[2 * k] <= t && t <= this.reads[2 * k + 1]) continue;
      const pose = poseAt(this.poses, k, t);
      this.there[k] = pose ? 1 : 0;
      this.places.set(pose?.p ?? [0, 0, 0], 3 * k);
      this.turns.set(pose?.q ?? [0, 0, 0, 1], 4 * k);
      this.reads.set([t, this.poses.staysUntil(k, place, 0.2, this.unseen)], 2 * k);
      this.kept.look(k);
    }
  }
  findUncovered() {}
  aim() {}
  isCovered() {
    return false;
  }
  isSeen() {
    return true;
  }
  writeThose(drawn) {
    this.drawn = Array.from({length: this.count}, (_, k) => k).filter(drawn);
  }
}

// Looking along y from 10 m away.
const projection = [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1, -1, 0, 0, -0.2, 0];
const view = {elements: [2, 0, 0, 0, 0, 0, 1, 1, 0, 2, 0, 0, 0, 0, 9.8, 10]};
const camera = {projectionMatrix: {elements: projection}};

test('a kept picture and what is drawn beside it show every rock once, where it is', () => {
  const unseen = 0.04,
    count = 90;
  for (let seed = 1; seed <= 5; ++seed) {
    const next = random(99 + seed),
      poses = rocksThatMove(seed, count, 60),
      rocks = new Rocks(poses, count, unseen),
      {kept} = rocks;
    let t = 0;
    for (let picture = 0; picture < 200; ++picture) {
      t = picture % 50 === 49 ? 6 * next() : Math.min(5.9, t + 0.05 * next()); // and jumps now and then
      const before = kept.poses.slice(),
        was = kept.is.slice();
      rocks.setTime(t);
      const part = kept.settle(camera, view);
      kept.chooseOthers();
      const others = new Set(rocks.drawn);
      for (let k = 0; k < count; ++k) {
        const now = poseAt(poses, k, t);
        assert.equal(others.has(k) + kept.is[k], now ? 1 : 0, `rock ${k} at ${t}`);
        if (now && kept.is[k]) {
          const pose = {p: [...kept.poses.slice(7 * k, 7 * k + 3)], q: [...kept.poses.slice(7 * k + 3, 7 * k + 7)]};
          assert.ok(way(pose, now, 0.2) < unseen + 2e-3, `rock ${k} at ${t}: off by ${way(pose, now, 0.2)} m`);
        }
        const same = was[k] === kept.is[k] && before[7 * k] === kept.poses[7 * k];
        if (same && before[7 * k + 6] === kept.poses[7 * k + 6]) continue;
        for (const [is, pose] of [[was[k], before], [kept.is[k], kept.poses]]) {
          if (!is) continue;
          const span = spanOf(pose.slice(7 * k, 7 * k + 3), 0.2, projection, view.elements);
          const inside = part && span.every((v, i) => (i < 2 ? part[i] <= v + 1e-6 : part[i] >= v - 1e-6));
          assert.ok(inside, `rock ${k} at ${t} lies in ${span}, drawn anew is ${part}`);
        }
      }
    }
  }
});

// By points on the sphere, from near and far, in the middle and at the edge of the picture.
test('the part of a picture that a sphere is given holds it', () => {
  const next = random(3);
  for (let trial = 0; trial < 300; ++trial) {
    const centre = [8 * next() - 4, 12 * next() - 9, 6 * next() - 3],
      radius = 0.05 + 0.5 * next(),
      span = spanOf(centre, radius, projection, view.elements);
    for (let k = 0; k < 200; ++k) {
      const [h, turn] = [2 * next() - 1, 2 * Math.PI * next()],
        flat = Math.sqrt(1 - h * h);
      const [x, y, z] = [flat * Math.cos(turn), flat * Math.sin(turn), h].map((v, i) => centre[i] + radius * v);
      const w = y + 10;
      if (w < 0.1) continue;
      const [a, b] = [(2 * x) / w, (2 * z) / w];
      if (Math.abs(a) > 1 || Math.abs(b) > 1) continue;
      assert.ok(a >= span[0] && a <= span[2] && b >= span[1] && b <= span[3], `${[x, y, z]} at ${[a, b]} in ${span}`);
    }
  }
});

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What moves in a scene, as few meshes: rocks of one shape are instances of one, and what moves together is one.

import * as THREE from 'three';
import {hash} from './grain.js';
import {Facets, linear} from './mesh.js';
import {addTyre} from './tyre_mesh.js';

// [grain, glow, dust] of what a body is made of.
const finishes = {
  rock: [1, 0, 0.55],
  tyre: [0.5, 0, 0.3],
  steel: [0.8, 0, 0.15],
  paint: [0.22, 0, 0.2],
  glass: [0.05, 0.03, 0],
  lamp: [0, 1, 0],
};
const plain = [0, 0, 0];

const finishOf = (body) => finishes[body.look] ?? plain;
const colourOf = (body) => linear(body.color ?? '#8d8a85');

/// {rocks, others}: parts {mesh, place, turn, tint, members: body numbers, solid}. A part of rocks has one instance per
/// rock, and the radius of the sphere about its shape; any other has one, and moves as its first member does.
export function parts(panel, material) {
  const rocks = new Map(),
    others = new Map();
  panel.bodies.forEach((body, index) => {
    if (body.look === 'drift' && panel.drift) return;
    const alone = (body.opacity ?? 1) < 1;
    const [kind, key] =
      body.look === 'rock' ? [rocks, body.shape] : [others, (body.with ?? index) + (alone ? '/' + index : '')];
    if (!kind.has(key)) kind.set(key, []);
    kind.get(key).push(index);
  });
  return {
    rocks: [...rocks].map(([shape, members]) => rockPart(panel, panel.shapes[shape], members, material(1))),
    others: [...others.values()].map((members) =>
      otherPart(panel, members, material(panel.bodies[members[0]].opacity ?? 1)),
    ),
  };
}

// Facets of broken rock differ a little, and rocks of one colour do.
function rockPart(panel, shape, members, material) {
  const facets = new Facets();
  facets.solid(shape, [1, 1, 1], finishes.rock, (face) => 0.84 + 0.32 * hash(face, shape.vertices.length, 5));
  const part = partOf(facets, members, members.length, material);
  part.radius = Math.max(...shape.vertices.map((v) => Math.hypot(...v)));
  part.tints = new Float32Array(3 * members.length);
  members.forEach((index, k) => {
    const bright = 0.62 + 0.76 * hash(index, 1),
      warm = 0.9 + 0.2 * hash(index, 2);
    colourOf(panel.bodies[index]).forEach((c, i) => (part.tints[3 * k + i] = c * bright * [warm, 1, 2 - warm][i]));
  });
  return part;
}

function otherPart(panel, members, material) {
  const facets = new Facets();
  for (const index of members) {
    const body = panel.bodies[index],
      shape = panel.shapes[body.shape];
    if (body.look === 'tyre') addTyre(facets, extentOf(shape), {colour: colourOf(body), finish: finishes.tyre});
    else facets.solid(shape, colourOf(body), finishOf(body));
  }
  return partOf(facets, members, 1, material);
}

const extentOf = ({vertices}) => ({
  radius: Math.max(...vertices.map((v) => Math.hypot(v[0], v[2]))),
  half: Math.max(...vertices.map((v) => Math.abs(v[1]))),
});

function partOf(facets, members, instances, material) {
  const {geometry, ...arrays} = facets.geometry(instances);
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = material.transparent ? 3 : 1;
  return {mesh, members, solid: !material.transparent, ...arrays};
}

/// The GPU gets what was written into the arrays of a part's instances.
export function changed({mesh}, count = mesh.geometry.instanceCount) {
  mesh.geometry.instanceCount = count;
  mesh.visible = count > 0;
  for (const name of ['place', 'turn', 'tint']) {
    const attribute = mesh.geometry.getAttribute(name);
    attribute.clearUpdateRanges();
    attribute.addUpdateRange(0, count * attribute.itemSize);
    attribute.needsUpdate = true;
  }
}

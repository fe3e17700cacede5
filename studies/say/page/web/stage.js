// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// What a scene consists of, and its light: a drift with lamps where it has one, else bodies under the open sky.

import * as THREE from 'three';
import {driftMesh, lampPlaces, roofMesh} from './drift_mesh.js';
import {Backdrop, Glows} from './glow.js';
import {RockCover} from './rock_cover.js';
import {Rocks} from './rocks.js';
import {changed, parts} from './scene_parts.js';
import {mostLamps, sharedLight, surfaceMaterial} from './surface_material.js';
import {isDark} from './theme.js';

// Behind a drift, below and above; behind a scene without one.
const backdrops = {
  drift: {light: ['#c9cdd0', '#e6e9ec'], dark: ['#0d1114', '#1b242c']},
  open: {light: ['#dfe4e8', '#eef1f4'], dark: ['#222c34', '#303d47']},
};

const position = new THREE.Vector3(),
  turn = new THREE.Quaternion();

export class Stage {
  constructor(panel, poses) {
    this.panel = panel;
    this.poses = poses;
    this.light = sharedLight();
    this.surfaces = []; // opaque meshes, whose materials change with quality
    this.scene = new THREE.Scene();
    this.fixed = new THREE.Scene(); // the drift
    this.resting = new THREE.Scene(); // rock, which casts shadows
    this.moving = new THREE.Scene(); // what else does
    this.scene.add(this.fixed, this.resting, this.moving);
    const materials = new Map();
    const material = (opacity) => {
      if (!materials.has(opacity)) materials.set(opacity, surfacesOf(this.light, opacity));
      return materials.get(opacity).smooth;
    };
    this.materials = materials;
    const {rocks, others} = parts(panel, material);
    this.others = others;
    this.backdrop = new Backdrop();
    this.scene.add(this.backdrop.mesh);
    const cover = panel.drift ? new RockCover(insideOf(panel.drift), material(1)) : null;
    this.rocks = new Rocks(rocks, poses, cover);
    if (cover) {
      cover.light(this.light);
      this.resting.add(cover.mesh);
    }
    for (const {mesh} of [...rocks, ...others.filter((part) => part.solid), ...(cover ? [cover] : [])])
      this.surfaces.push(mesh);
    rocks.forEach((part) => this.resting.add(part.mesh));
    others.forEach((part) => (part.solid ? this.moving : this.scene).add(part.mesh));
    if (panel.drift) this.addDrift(panel.drift, material(1));
    else this.light.keyColour.value.set(0.95, 0.92, 0.86);
    if (!panel.drift) {
      this.light.skyColour.value.set(0.5, 0.53, 0.57);
      this.light.groundColour.value.set(0.26, 0.24, 0.22);
      this.light.keyWay.value.set(-0.45, -0.55, 1).normalize();
    }
  }

  addDrift(drift, material) {
    const [, roof] = [driftMesh(drift), roofMesh(drift)].map((facets) => {
      const mesh = new THREE.Mesh(facets.geometry(1).geometry, material);
      mesh.frustumCulled = false;
      mesh.renderOrder = 2; // behind what stands in it
      this.fixed.add(mesh);
      this.surfaces.push(mesh);
      return mesh;
    });
    this.roof = roof;
    this.headLamps = headLampsOf(this.panel);
    const places = lampPlaces(drift).slice(0, mostLamps);
    this.glows = new Glows(places.length);
    places.forEach(([x, y, z], k) => {
      this.light.lamps.value[k].set(x, y, z - 0.1, 5.5);
      this.glows.set(k, [x, y, z - 0.03], 0.75);
    });
    this.scene.add(this.glows.mesh);
    this.light.keyColour.value.set(0.86, 0.8, 0.7);
    this.light.skyColour.value.set(0.1, 0.108, 0.125);
    this.light.groundColour.value.set(0.075, 0.066, 0.056);
    this.light.keyWay.value.set(-0.62, -0.34, 0.8).normalize();
  }

  /// Coarse, for pictures that follow each other quickly: surfaces have no grain, shadows hard edges.
  beCoarse(coarse) {
    if (coarse === this.coarse) return;
    this.coarse = coarse;
    const {smooth, quick, simple} = this.materials.get(1);
    for (const mesh of this.surfaces) mesh.material = !coarse ? smooth : mesh.parent === this.resting ? simple : quick;
  }

  /// Draws what a still picture does not show.
  withoutStill(draw) {
    const core = this.rocks.cover?.mesh,
      visible = core?.visible;
    this.fixed.visible = false;
    if (core) core.visible = false;
    draw();
    this.fixed.visible = true;
    if (core) core.visible = visible;
  }

  /// For a picture by this camera; from over the roof one looks past it.
  see(camera) {
    if (this.roof) this.roof.visible = camera.position.z < this.panel.drift.height;
  }

  /// hurried: pictures follow each other.
  setTime(place, hurried) {
    for (const part of this.others) {
      const there = this.poses.read(part.members[0], place, position, turn);
      position.toArray(part.place);
      part.place[3] = there ? 1 : 0;
      turn.toArray(part.turn);
      changed(part);
    }
    this.movingBox = boxOf(this.others.filter((part) => part.solid));
    this.rocks.setTime(place, hurried);
    if (this.headLamps?.length) this.aimHeadLamps(place);
  }

  aimHeadLamps(place) {
    const there = this.poses.read(this.panel.follow, place, position, turn);
    const middle = new THREE.Vector3();
    for (const lamp of this.headLamps) middle.addScaledVector(lamp, 1 / this.headLamps.length);
    middle.applyQuaternion(turn).add(position);
    this.light.head.value.set(middle.x, middle.y, middle.z, there ? 3.2 : 0);
    this.light.headWay.value.set(1, 0, -0.16).normalize().applyQuaternion(turn);
  }

  /// Sphere around what is solid now.
  extent() {
    if (this.panel.drift) return extentOfDrift(this.panel.drift);
    const solid = this.others.filter((part) => part.solid),
      box = boxOf(solid.length ? solid : this.others);
    this.rocks.growBox(box);
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    return {centre: sphere.center, radius: Math.max(sphere.radius, 0.1)};
  }

  tint() {
    this.backdrop.tint(...backdrops[this.panel.drift ? 'drift' : 'open'][isDark() ? 'dark' : 'light']);
  }
}

const surfacesOf = (light, opacity) => ({
  smooth: surfaceMaterial(light, {opacity, quality: 'SMOOTH'}),
  quick: surfaceMaterial(light, {opacity, quality: 'QUICK'}),
  simple: surfaceMaterial(light, {opacity, quality: 'SIMPLE'}),
});

/// Around those parts that are there.
function boxOf(parts) {
  const box = new THREE.Box3();
  for (const part of parts) {
    if (!part.place[3]) continue;
    const {centre, radius} = sphereOf(part);
    box.expandByPoint(position.copy(centre).addScalar(radius)).expandByPoint(position.copy(centre).addScalar(-radius));
  }
  return box;
}

/// Around a part where it is: {centre, radius}.
function sphereOf({mesh, turn: turned, place}) {
  if (!mesh.geometry.boundingSphere) mesh.geometry.computeBoundingSphere();
  const {center, radius} = mesh.geometry.boundingSphere;
  const centre = center.clone().applyQuaternion(turn.fromArray(turned)).add(new THREE.Vector3().fromArray(place));
  return {centre, radius};
}

const insideOf = ({from, length, width}) => ({x: [from, length], y: [-width / 2, width / 2]});

function extentOfDrift({from, length, width, height}) {
  const centre = new THREE.Vector3((from + length) / 2, 0, height / 3);
  return {centre, radius: 0.5 * Math.hypot(length - from, width, height)};
}

/// Of the body that a camera follows, in its frame: the middles of its lamps.
function headLampsOf({bodies, shapes, follow}) {
  return bodies
    .filter((body) => body.look === 'lamp' && follow !== undefined && body.with === follow)
    .map(({shape}) => {
      const {vertices} = shapes[shape],
        sum = new THREE.Vector3();
      vertices.forEach((v) => sum.add(new THREE.Vector3().fromArray(v)));
      return sum.divideScalar(vertices.length);
    });
}

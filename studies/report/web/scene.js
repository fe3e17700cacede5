// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Scene viewer: the bodies of one run, to look around in and to replay. It draws only when something changes.

import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {choice, el} from './dom.js';
import {number} from './format.js';
import {Poses} from './poses.js';
import {groups, lights} from './scene_parts.js';
import {colour, onTheme} from './theme.js';

const speeds = [1, 3, 10];
const directions = {side: [0, -1, 0.02], above: [-0.001, 0, 1]};

export function sceneViewer(panel) {
  const times = panel.frames.map((frame) => frame.t);
  const stage = el('div', {class: 'scene'});
  if (!times.length) return el('p', {class: 'caution'}, 'The scene has no frames.');
  try {
    const view = new View(panel, new Poses(panel.poses, panel.bodies.length, times));
    view.fill(stage);
    return el('div', {}, stage, player(panel, times, view));
  } catch (error) {
    return el('p', {class: 'caution'}, 'The scene needs WebGL, which this browser does not offer: ' + error.message);
  }
}

export class View {
  constructor(panel, poses) {
    this.poses = poses;
    this.renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.shadowMap.enabled = true;
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(colour.sky);
    this.parts = groups(panel);
    this.parts.forEach((part) => this.scene.add(part.mesh, ...part.edges));
    this.setTime(poses.times[panel.poster_frame ?? 0] ?? poses.times[0], false);
    const {centre, radius} = this.extent();
    this.scene.add(...lights(centre, radius));
    this.home = panel.camera ?? {eye: centre.clone().add(new THREE.Vector3(-1.2, -1.6, 0.9).multiplyScalar(radius)).toArray(), target: centre.toArray()};
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.01 * radius, 40 * radius);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.look(this.home.eye);
    this.controls.addEventListener('change', () => this.render());
    onTheme(() => this.tint());
  }

  fill(stage) {
    stage.append(this.renderer.domElement);
    new ResizeObserver(() => this.resize(stage.clientWidth, stage.clientHeight)).observe(stage);
  }

  /// Sphere around what is solid now.
  extent() {
    const box = new THREE.Box3();
    const solid = this.parts.filter((part) => part.mesh.castShadow);
    for (const part of solid.length ? solid : this.parts) {
      part.mesh.computeBoundingBox();
      box.union(part.mesh.boundingBox);
    }
    const sphere = box.getBoundingSphere(new THREE.Sphere());
    return {centre: sphere.center, radius: Math.max(sphere.radius, 0.1)};
  }

  look(eye) {
    this.camera.position.set(...eye);
    this.controls.target.set(...this.home.target);
    this.controls.update();
    this.render();
  }

  /// As the study says (home), or from the side or from above at that distance.
  see(camera) {
    if (camera === 'home') return this.look(this.home.eye);
    const target = new THREE.Vector3(...this.home.target);
    const distance = target.distanceTo(new THREE.Vector3(...this.home.eye));
    return this.look(target.add(new THREE.Vector3(...directions[camera]).normalize().multiplyScalar(distance)).toArray());
  }

  setTime(t, draw = true) {
    const place = this.poses.place(t), matrix = new THREE.Matrix4();
    const position = new THREE.Vector3(), turn = new THREE.Quaternion(), one = new THREE.Vector3(1, 1, 1);
    for (const {mesh, members, edges} of this.parts) {
      members.forEach((body, i) => {
        const there = this.poses.read(body, place, position, turn);
        if (there) matrix.compose(position, turn, one);
        else matrix.makeScale(0, 0, 0);
        mesh.setMatrixAt(i, matrix);
        if (edges[i]) { edges[i].matrix.copy(matrix); edges[i].matrixWorldNeedsUpdate = true; edges[i].visible = there; }
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
    if (draw) this.render();
  }

  resize(width, height) {
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  tint() {
    this.scene.background.set(colour.sky);
    this.render();
  }

  render() { this.renderer.render(this.scene, this.camera); }
}

function player(panel, times, view) {
  const first = times[0], last = times[times.length - 1];
  let t = times[panel.poster_frame ?? 0] ?? first, playing = false, speed = speeds[0], before = 0;
  const clock = el('span', {class: 'note'}), label = el('span', {class: 'label'});
  const slider = el('input', {type: 'range', min: first, max: last, step: 'any', 'aria-label': 'time', oninput: () => { play(false); show(Number(slider.value)); }});
  const button = el('button', {type: 'button', onclick: () => play(!playing)}, 'Play');
  view.renderer.domElement.parentNode.append(label);
  const show = (time, draw = true) => {
    t = time;
    slider.value = t;
    clock.textContent = `${number(t)} s of ${number(last)} s`;
    label.textContent = panel.frames[view.poses.place(t).k].label ?? '';
    label.hidden = !label.textContent;
    if (draw) view.setTime(t);
  };
  const step = (now) => {
    if (!playing) return;
    show(Math.min(last, t + (speed * Math.min(250, now - before)) / 1000));
    before = now;
    if (t >= last) play(false);
    else requestAnimationFrame(step);
  };
  const play = (on) => {
    if (on && t >= last) t = first;
    playing = on;
    button.textContent = on ? 'Pause' : 'Play';
    before = performance.now();
    if (on) requestAnimationFrame(step);
  };
  show(t, false);
  const views = el('div', {class: 'choice'}, [['Reset view', 'home'], ['Side', 'side'], ['Above', 'above']]
    .map(([text, camera]) => el('button', {type: 'button', onclick: () => view.see(camera)}, text)));
  return el('div', {class: 'player'}, button, slider, clock, choice(speeds.map((s) => s + '×'), (i) => { speed = speeds[i]; }), views);
}

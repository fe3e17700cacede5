// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Scene viewer: the bodies of one run, to look around in and to replay. It draws only when something changes.
// Bodies of one shape are one instanced mesh, so that thousands of rocks are some twenty draw calls.

import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {el} from './dom.js';
import {player} from './player.js';
import {Poses} from './poses.js';
import {Pace, Picture} from './picture.js';
import {ShadowMap} from './shadow_map.js';
import {Stage} from './stage.js';
import {StillPicture} from './still_picture.js';
import {onTheme} from './theme.js';

const shadowDelay = 0.5; // [s]
const mostPixels = () => Math.min(2, window.devicePixelRatio);
const directions = {side: [0, -1, 0.02], above: [-0.001, 0, 1]};

const shown = new Map(); // by their elements, what ends them

/// For what is taken out of the page: its scenes stop, and their place on the graphics card is free again.
export function endScenes(node) {
  for (const [area, end] of shown) {
    if (!node.contains(area)) continue;
    shown.delete(area);
    end();
  }
}

export function sceneViewer(panel) {
  const times = panel.frames.map((frame) => frame.t);
  const stage = el('div', {class: 'scene'});
  if (!times.length) return el('p', {class: 'caution'}, 'The scene has no frames.');
  try {
    const view = new View(panel, new Poses(panel));
    view.fill(stage);
    const area = el('div', {class: 'replay', tabindex: '0'}, stage);
    const {node, plots, end} = player(panel, times, view, area);
    area.append(node, plots ?? '');
    shown.set(area, () => {
      end();
      view.end();
    });
    return area;
  } catch (error) {
    return el('p', {class: 'caution'}, 'The scene needs WebGL, which this browser does not offer: ' + error.message);
  }
}

/// What is behind an opaque canvas is not drawn with it. Its picture stays, for who saves or prints it.
function rendererOf(canvas) {
  const given = {alpha: false, antialias: false, depth: true, stencil: false, preserveDrawingBuffer: true};
  const context = canvas.getContext('webgl2', given);
  return new THREE.WebGLRenderer({canvas, context: context ?? undefined, antialias: false});
}

export class View {
  constructor(panel, poses) {
    this.poses = poses;
    this.pace = new Pace();
    this.pixels = null; // of the picture per pixel of the page; the screen's
    this.renderer = rendererOf(document.createElement('canvas'));
    this.renderer.setPixelRatio(mostPixels());
    this.picture = new Picture(this.renderer);
    this.stage = new Stage(panel, poses);
    this.shadow = new ShadowMap(this.renderer, this.stage.light);
    this.still = new StillPicture(this.renderer, this.stage.light);
    this.followed = panel.follow ?? null;
    this.following = false;
    this.setTime(poses.times[panel.poster_frame ?? 0] ?? poses.times[0], false);
    const {centre, radius} = this.stage.extent();
    this.shadow.cover(centre, radius);
    this.home = panel.camera ?? {
      eye: centre
        .clone()
        .add(new THREE.Vector3(-1.2, -1.6, 0.9).multiplyScalar(radius))
        .toArray(),
      target: centre.toArray(),
    };
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.01 * radius, 40 * radius);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    if (panel.drift) this.controls.maxPolarAngle = 0.5 * Math.PI; // not from below its floor
    this.look(this.home.eye);
    this.controls.addEventListener('start', () => this.hurry(true));
    this.controls.addEventListener('end', () => this.hurry(false));
    this.controls.addEventListener('change', () => {
      if (!this.shifting) this.render();
    });
    this.renderer.domElement.addEventListener('webglcontextrestored', () => this.still.forget());
    this.endTheme = onTheme(() => this.tint());
    this.stage.tint();
  }

  fill(stage) {
    stage.append(this.renderer.domElement);
    this.resizing = new ResizeObserver(() => this.resize(stage.clientWidth, stage.clientHeight));
    this.resizing.observe(stage);
  }

  /// A browser has few graphics contexts.
  end() {
    this.endTheme();
    this.resizing?.disconnect();
    this.controls.dispose();
    this.shadow.end();
    this.still.end();
    this.picture.end();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  look(eye) {
    this.camera.position.fromArray(eye);
    this.controls.target.fromArray(this.home.target);
    this.controls.update();
    this.render();
  }

  /// Where the followed body is now.
  anchor() {
    const position = new THREE.Vector3();
    this.poses.read(this.followed, this.place, position, new THREE.Quaternion());
    return position;
  }

  /// The camera goes with the followed body from now on, looking at it as it looks now; or stays where it is.
  follow(on) {
    this.following = on && this.followed !== null;
    if (!this.following) return;
    this.anchored = this.anchor();
    this.shift(this.anchored.clone().sub(this.controls.target));
    this.render();
  }

  shift(way) {
    this.shifting = true; // whoever shifts draws
    this.camera.position.add(way);
    this.controls.target.add(way);
    this.controls.update();
    this.shifting = false;
  }

  keepUp() {
    const now = this.anchor(),
      way = now.clone().sub(this.anchored);
    this.anchored = now;
    this.shift(way);
  }

  /// As the study says (home), or from the side or from above at that distance; or with the followed body
  /// (follow).
  see(camera) {
    if (camera === 'follow') this.following = true;
    const target = new THREE.Vector3(...this.home.target);
    const distance = target.distanceTo(new THREE.Vector3(...this.home.eye)),
      way = directions[camera];
    this.look(
      way ? target.add(new THREE.Vector3(...way).normalize().multiplyScalar(distance)).toArray() : this.home.eye,
    );
    if (this.following) this.follow(true);
  }

  setTime(t, draw = true) {
    this.place = this.poses.place(t);
    this.stage.setTime(this.place, this.pace.level > 0);
    this.posed = true;
    if (this.following) this.keepUp();
    if (draw) this.render();
  }

  resize(width, height) {
    if (!width || !height) return;
    this.size = [width, height];
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.render();
  }

  tint() {
    this.stage.tint();
    this.render();
  }

  /// While pictures follow each other, each may be coarser than the last one, where the machine is slow.
  hurry(on) {
    this.pace.hurry(on);
    this.still.forget();
    if (!on) this.setTime(this.place.t);
  }

  usePixels() {
    const {level, share} = this.pace,
      ratio = this.pixels ?? (level ? Math.min(1, mostPixels()) : mostPixels());
    if (ratio * share !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio * share);
  }

  render() {
    const {stage, camera, pace} = this;
    pace.drawn();
    this.usePixels();
    camera.updateMatrixWorld();
    if (this.posed) this.updateShadow();
    stage.see(camera);
    stage.beCoarse(pace.level > 0);
    if (pace.level && this.still.draw(stage, camera)) return;
    this.still.forget();
    stage.rocks.choose(camera);
    this.picture.draw(stage.scene, camera, !pace.level);
  }

  // The rock's shadow may be a little late while pictures follow each other.
  updateShadow() {
    const {stage, place, pace} = this;
    const anew = !pace.level || !(Math.abs(place.t - this.shadowTime) < shadowDelay);
    if (anew) {
      stage.rocks.choose();
      this.shadow.drawResting(stage.resting);
      this.shadowTime = place.t;
    }
    const anchored = this.followed !== null;
    this.shadow.drawMoving(
      stage.moving,
      stage.movingBox,
      anchored ? this.anchor() : new THREE.Vector3(),
      anchored && pace.level > 0,
    );
    this.posed = pace.level > 0;
  }
}

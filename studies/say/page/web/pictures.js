// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The scene of a replay as pictures: one for each time that the data name, drawn one after the other whatever
// the clock says, and sent to the server that gave this page.

import {Poses} from './poses.js';
import {View} from './scene.js';
import {inscription} from './inscription.js';
import {isDark, toggleTheme} from './theme.js';

async function send(where, body) {
  const answer = await fetch(where, {method: 'POST', body});
  if (!answer.ok) throw new Error(`${where} was refused: ${await answer.text()}`);
}

function viewOf({scene, camera, width, height}) {
  const view = new View(scene, new Poses(scene));
  view.pixels = 1;
  view.resize(width, height);
  const {drawingBufferWidth, drawingBufferHeight} = view.renderer.getContext();
  if (drawingBufferWidth !== width || drawingBufferHeight !== height)
    throw new Error(`it draws ${drawingBufferWidth}x${drawingBufferHeight} pixels at most, not ${width}x${height}`);
  view.see(camera);
  return view;
}

function picture(canvas) {
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('it made no PNG'))), 'image/png'),
  );
}

/// While a picture is sent, the next is drawn.
async function takePictures(data) {
  const {scene, times, width, height} = data;
  if (isDark()) toggleTheme();
  const view = viewOf(data);
  const canvas = Object.assign(document.createElement('canvas'), {width, height});
  const context = canvas.getContext('2d', {alpha: false, willReadFrequently: true});
  let sent = Promise.resolve();
  for (const [k, t] of times.entries()) {
    view.setTime(t);
    context.drawImage(view.renderer.domElement, 0, 0);
    inscription(context, t, scene.frames[view.poses.place(t).k].label);
    const blob = await picture(canvas);
    await sent;
    sent = send('frame/' + (k + 1), blob);
  }
  await sent;
}

const tell = (problem) => send('problem', String(problem?.message ?? problem)).catch(() => {});
addEventListener('error', (event) => tell(event.error ?? event.message));
takePictures(JSON.parse(document.getElementById('pictures-data').textContent)).catch(tell);

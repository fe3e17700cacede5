// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Pointers move faster than plots draw: at most one redraw per frame, or one when the pointer rests.

export function oncePerFrame(f) {
  let waiting = false;
  const later = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      f();
    });
  };
  later.now = f;
  return later;
}

const rest = 150; // ms

/// f once nothing has asked for it for a moment.
export function whenResting(f) {
  let waiting = null;
  return () => {
    clearTimeout(waiting);
    waiting = setTimeout(f, rest);
  };
}

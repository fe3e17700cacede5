// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Time and label in the corner of a picture.

/// "3.40 s, curl"; every picture of a run has its time with as many digits.
export const words = (t, label) => `${t.toFixed(2)} s` + (label ? `, ${label}` : '');

export function inscription(context, t, label) {
  const size = Math.max(11, Math.round(context.canvas.height / 36)),
    text = words(t, label);
  context.font = `${size}px sans-serif`;
  context.textBaseline = 'middle';
  context.fillStyle = 'rgba(255, 255, 255, 0.82)';
  context.fillRect(size, size, context.measureText(text).width + size, 1.7 * size);
  context.fillStyle = '#1c2733';
  context.fillText(text, 1.5 * size, 1.9 * size);
}

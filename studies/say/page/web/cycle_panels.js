// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// Panels of a run of several cycles.

/// Numbers of the cycles that panels name.
export const cyclesOf = (panels) => [
  ...new Set(panels.map((panel) => panel.cycle).filter((cycle) => cycle !== undefined)),
];

/// Scenes that have their bodies from another one, with them.
export function withBodies(panels) {
  return panels.map((panel) => {
    const from = panels[panel.bodies_of];
    return from ? {...panel, shapes: from.shapes, bodies: from.bodies} : panel;
  });
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The point of the design space that the figures share: the table of the front sets it, the sliders move it.

export function choose(data) {
  const listeners = [];
  const middle = data.problem.variables.map((v) => (v.kind ? Math.floor(0.5 * (v.lower + v.upper)) : 0.5 * (v.lower + v.upper)));
  const state = {
    x: [...middle], selected: -1, middle,
    onchange: (listener) => listeners.push(listener),
    move(x) { state.x = [...x]; listeners.forEach((f) => f(state)); },
    select(index) {
      state.selected = index;
      state.move(index < 0 ? middle : data.front.X[index]);
    },
  };
  return state;
}

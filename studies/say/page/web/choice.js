// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The point of the design space that the figures share: a click on a design sets and marks it, the sliders
// move it.

export function choose(data, designs) {
  const listeners = [];
  const middle = data.problem.variables.map((v) =>
    v.kind ? Math.floor(0.5 * (v.lower + v.upper)) : 0.5 * (v.lower + v.upper),
  );
  const state = {
    x: [...middle],
    /// {set, index} of the marked design, or null.
    mark: null,
    onchange: (listener) => listeners.push(listener),
    move(x) {
      state.x = [...x];
      listeners.forEach((f) => f(state));
    },
    pick(set, index) {
      state.mark = {set, index};
      state.move(designs[set][index].x);
    },
    reset() {
      state.mark = null;
      state.move(middle);
    },
    marked: (set) => (state.mark?.set === set ? state.mark.index : -1),
    /// What a click on a row does: the second one takes the mark away.
    toggle: (set, index) => (state.marked(set) === index ? state.reset() : state.pick(set, index)),
  };
  return state;
}

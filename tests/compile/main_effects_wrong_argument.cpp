// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// expect: drawpoint: not a black box. It cannot be called with a point.

#include <drawpoint/doe/main_effects.hpp>

auto effects(const drawpoint::doe::Problem& problem) {
  return drawpoint::doe::main_effects([](double x) { return x; }, problem);
}

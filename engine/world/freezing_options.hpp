// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// When a rock that stands still is taken out of the solve, and when it comes back. The rules, with the meaning of
/// balance, load and impact, are those of freezing.h; docs/measurements/freezing.md says what freezing costs in accuracy.
namespace drawpoint::engine {

struct FreezingOptions {
  bool on = false;
  double hold = 0.5;       ///< stood still for this long [s] > 0; a throw's top lasts 0.02 s
  double distance = 5e-4;  ///< [m] > 0; moved less in that time, turns counted at the radius of gyration
  double tolerance = 0.1;  ///< of the balance, relative to the load carried; above 0, at most 1
  double average = 0.05;   ///< time over which loads are averaged [s], above 0
  double impact = 0.75;    ///< unbalance in a single step that is solved again, at least tolerance [1]
  double nudge = 0.02;     ///< speed of a rock that thaws those it touches [m/s]
  int spread = 2;          ///< contacts from an overloaded rock over which others thaw with it, 0 to 100
};

}  // namespace drawpoint::engine

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/column_model.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>

/// How a pile lies, in the figures by which a miner judges it.
namespace drawpoint::engine::loading {

struct PileShape {
  double mass = 0;   ///< of all rocks [kg]
  double crest = 0;  ///< highest point of an attacked row's contour, mean over the rows [m]
  double toe = 0;    ///< x of the toe, mean over the rows [m]
  /// Elevation of the straight line fitted, by least squares in height, to the contour where it climbs from a
  /// fifth to four fifths of its crest; mean over the rows [rad]. Toe and crest are left out: single rocks
  /// lie strewn before the one, and the other is as wide as the raise.
  double angle = 0;
};

/// Over the rows in which the bucket can attack. Throws std::invalid_argument for a pile without such a row.
PileShape pile_shape(const SettledPile& pile, const Scenario& scenario);

/// The angle of one row's contour, as above [rad].
double surface_angle(const ColumnModel& model, const Row& row);

/// The grid of columns over a drift's floor.
ColumnGrid grid_over(const Drift& drift);

}  // namespace drawpoint::engine::loading

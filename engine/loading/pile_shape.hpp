// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/loading/strategy/column_model.hpp>

/// How a pile lies, in the figures that a miner looks at.
namespace drawpoint::engine::loading {

/// Over the rows in which the bucket can attack: the elevation of the straight line fitted, by least squares
/// in height, to a row's contour where it climbs from a fifth to four fifths of its crest. Toe and crest are
/// left out: single rocks lie strewn before the one, and the other is as wide as the raise.
struct SurfaceAngles {
  double mean = 0, least = 0, most = 0;  ///< [rad]
  double crest = 0;                      ///< highest point of a row's contour, mean over the rows [m]
  double toe = 0;                        ///< x of the toe, mean over the rows [m]
};

struct PileShape {
  double mass = 0;  ///< of all rocks [kg]
  SurfaceAngles surface;
};

/// Needs at least one row.
SurfaceAngles surface_angles(const ColumnModel& model);

/// Throws std::invalid_argument for a pile without a row.
PileShape pile_shape(const SettledPile& pile, const Scenario& scenario);

/// The angle of one row's contour, as above [rad]; its slope from toe to volume centre where fewer than two
/// columns lie in that part.
double surface_angle(const ColumnModel& model, const Row& row);

/// Rocks as columns over the scenario's drift, in rows as wide as the machine's bucket.
ColumnModel columns_of(std::span<const PosedRock> rocks, const Scenario& scenario, const Lhd& lhd);

}  // namespace drawpoint::engine::loading

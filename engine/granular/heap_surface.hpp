// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/world.hpp>
#include <vector>

/// The surface of a heap, its slope, and the solid volume in a part of it.
///
/// The surface over a place (x, y) is the highest rock on the vertical line there, found exactly by clipping
/// the line against the rocks' faces; places lie in a square grid. Slopes are read from the area A(z) that
/// the surface has above height z, which needs no centre and no edge to be found: a cone has the radius
/// √(A/π) there, a bank of width W the depth A/W, and the angle is that of the least-squares line through
/// radius or depth against z. The solid volume is the sum of what the lines have in rock times the square of
/// the spacing s: off by O(s/L) of a rock of size L with either sign, so by its root over many rocks.
/// World frame, z up, SI units. Cost: rocks times places under each. All functions throw
/// std::invalid_argument for a spacing or a size that is not finite and above 0, for a crest that is not
/// finite, and for an area without a place: the sides have to be finite and longer than half the spacing.
namespace drawpoint::engine::granular {

/// A rectangle of places.
struct Area {
  double x0, x1, y0, y1;  ///< [m]
};

/// Default spacing of places, for rocks of 0.3 m [m]; a sixth of the smallest rock.
inline constexpr double place_spacing = 0.05;

/// Surface height over each place of the area [m], 0 where there is no rock.
std::vector<double> surface_heights(const engine::World& world, const Area& area,
                                    double spacing = place_spacing);
/// Over which the surface stands higher than z [m²].
double area_above(const std::vector<double>& heights, double spacing, double z);
double mean_height(const engine::World& world, const Area& area, double spacing = place_spacing);  ///< [m]

/// Angle [deg] of a heap with these heights, from one `size` above the floor to where it is one `size` in
/// radius; NaN for a heap of fewer than three sections, which lie 0.1 `size` apart.
double angle_of_cone(const std::vector<double>& heights, double spacing, double size);
/// Angle [deg] of a heap that was poured on the floor, wherever it lies; NaN as above.
double angle_of_cone(const engine::World& world, double size, double spacing = place_spacing);
/// Angle [deg] of a bank that runs down along x, from half a rock above z = 0 to one rock below `crest` [m];
/// NaN for fewer than three sections.
double angle_of_bank(const engine::World& world, const Area& area, double size, double crest,
                     double spacing = place_spacing);

/// Volume of rock between two heights over an area [m³].
double solid_volume(const engine::World& world, const Area& area, double z0, double z1,
                    double spacing = place_spacing);

}  // namespace drawpoint::engine::granular

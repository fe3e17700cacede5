// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/eigen.hpp>
#include <vector>

/// The bucket of the loader as a design: how wide, how large, and what follows in volume, shape and mass.
///
/// All buckets are made like the machine's own, of the same plates: its profile drawn larger or smaller about the
/// foot of its back, so that it stays where the arm holds it, and cut to another width. Its mass goes with the
/// area of its plates. Simplified: a larger bucket would be made of thicker plates, and its hinge would be moved.
namespace drawpoint::engine::loading {

struct BucketOptions {
  double width = 3.2;  ///< between the outsides of its walls [m]
  double size = 1;     ///< lengths of the profile over those of the machine's own bucket [1]
};

/// The bucket of this width [m] that holds so much, heaped 2:1 [m³].
BucketOptions bucket_of(double width, double heaped_volume);

/// Inside (x, z), from the cutting edge over the lip and the back to the floor; reference pose of the loader [m].
std::vector<Eigen::Vector2d> bucket_profile(const BucketOptions& bucket);
/// A profile with a 2:1 heap on the plane between its first point, the cutting edge, and its second, the lip.
std::vector<Eigen::Vector2d> heaped(const std::vector<Eigen::Vector2d>& profile);
/// Of a profile, counter-clockwise [m²].
double area(const std::vector<Eigen::Vector2d>& profile);

double bucket_mass(const BucketOptions& bucket);             ///< [kg]
Eigen::Vector2d bucket_centre(const BucketOptions& bucket);  ///< of mass (x, z), reference pose [m]

/// Throws std::invalid_argument naming the value and what is allowed.
void check(const BucketOptions& bucket);

}  // namespace drawpoint::engine::loading

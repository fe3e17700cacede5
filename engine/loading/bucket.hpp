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
///
/// Volumes are those that rock can have: between the walls, which stand inside the width, and over the floor,
/// whose underside is flat on the ground. So that the own bucket holds what is stated of it, 6.3 m³ struck and
/// 7.9 m³ heaped, its upper lip stands 0.1 m higher and farther forward than in the estimate that the linkage
/// is from: plates that stop a rock at any speed of the machine are twice as thick as a real bucket's.
namespace drawpoint::engine::loading {

struct BucketOptions {
  double width = 3.2;  ///< between the outsides of its walls [m]
  double size = 1;     ///< lengths of the profile over those of the machine's own bucket [1]
};

/// Thickness of the bucket's plates [m]. That of the floor tapers to a quarter of it at the cutting edge.
inline constexpr double plate_thickness = 0.08;

/// The bucket of this width [m] that holds so much, heaped 2:1 [m³].
BucketOptions bucket_of(double width, double heaped_volume);

/// Faces (x, z) that rock meets, from the cutting edge over the lip and down the back, and the floor's underside;
/// reference pose of the loader [m].
std::vector<Eigen::Vector2d> bucket_profile(const BucketOptions& bucket);
/// A profile with a 2:1 heap on the plane between its first point, the cutting edge, and its second, the lip.
std::vector<Eigen::Vector2d> heaped(const std::vector<Eigen::Vector2d>& profile);
/// Area inside a profile whose points go counter-clockwise [m²].
double area(const std::vector<Eigen::Vector2d>& profile);

double clear_width(const BucketOptions& bucket);    ///< between its walls [m]
double struck_volume(const BucketOptions& bucket);  ///< level between cutting edge and lip [m³]
double heaped_volume(const BucketOptions& bucket);  ///< with a 2:1 heap on that [m³]

double bucket_mass(const BucketOptions& bucket);             ///< [kg]
Eigen::Vector2d bucket_centre(const BucketOptions& bucket);  ///< of mass (x, z), reference pose [m]

/// Throws std::invalid_argument naming the value and what is allowed.
void check(const BucketOptions& bucket);

}  // namespace drawpoint::engine::loading

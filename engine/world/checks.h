// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/constants.hpp>
#include <drawpoint/engine/world/world.hpp>

/// What a World takes and what it refuses: every number that goes in is looked at before anything changes.
///
/// Each check throws std::invalid_argument with place, name, value, unit and the allowed range. The ranges
/// are wide: they keep out what is certainly a mistake (not finite, negative, twelve orders of magnitude off)
/// and what would overflow inside a step.
namespace drawpoint::engine::detail {

void check(const WorldOptions& options);
void check(const MaterialTable& materials);
void check(const RockBody& body, int materials);
void check_step(const char* place, double h);
void check_material(const char* place, int material, int materials);
void check_pose(const char* place, const Eigen::Isometry3d& pose);
void check_velocity(const char* place, const Eigen::Vector3d& velocity,
                    const Eigen::Vector3d& angular_velocity);

/// Largest distance of a point of the shape from the origin [m]; infinite for a half-space.
double radius_about_origin(const Shape& shape);

}  // namespace drawpoint::engine::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/granular/pile.hpp>
#include <drawpoint/engine/world/world.hpp>

/// The drift: floor, two walls, rough back wall, a roof that opens at the end into a conical raise.
///
/// x runs from the machine toward the back wall at x = length; the floor is z = 0. Floor and side walls are
/// half-spaces. The raise is a ring of eight plates round the opening; the roof is three slabs with the
/// opening left free. The back wall is a half-space set with frozen rocks of the pile's own shapes, centred
/// on it on a jittered grid, which stand out by up to half a rock: the simplified form of the mould of rocks
/// frozen where they lay.
namespace drawpoint::engine::loading {

struct Drift {
  double length = 20;  ///< [m]
  double width = 6;    ///< [m]
  double height = 5;   ///< roof above the floor [m]
  double raise_radius =
      2.2;  ///< inner radius of the opening [m]; below five large rocks across, they hang up in it
  double raise_widening = 0;  ///< radius gained per metre of height [-]; a funnel makes rocks hang up sooner
  double raise_height = 9;    ///< top of the raise above the floor [m]
  double wall_roughness = 0.6;  ///< longest dimension of the rocks in the back wall [m]; 0: smooth

  Eigen::Vector2d raise_axis() const { return {length - raise_radius - 0.3, 0.0}; }
};

/// Throws std::invalid_argument naming the value and what is allowed.
void check(const Drift& drift);

/// Adds the drift's fixed surfaces to a world.
void add_drift(engine::World& world, const Drift& drift);

/// Where rocks come in: under the raise, low over what lies there, at most at its top.
granular::EmitterOptions emitter_of(const Drift& drift);

}  // namespace drawpoint::engine::loading

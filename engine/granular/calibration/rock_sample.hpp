// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/granular/size_distribution.hpp>
#include <drawpoint/engine/world/material.hpp>
#include <drawpoint/engine/world/world_options.hpp>
#include <functional>
#include <stop_token>
#include <string_view>

/// What is calibrated, and what all tests of it share.
///
/// A sample is rock of the six shapes (rock_shapes.hpp), its sizes by mass, its density and its coefficients.
/// A test pours it as the emitter does, a layer at a time, at rest, low over what lies (pile.hpp), and measures
/// one quantity that is also measured in the field. Walls and floors are as rough as the rock is to itself, or
/// smooth where the header says so. Lengths of boxes are given in largest rocks, so that one set of options
/// fits every size. The same sample, options and seed give the same bits, on any number of threads. SI units.
namespace drawpoint::engine::granular {

struct RockSample {
  engine::Material contact = {.friction = 0.9, .rolling = 0.1};  ///< of rock on rock and on rough walls
  double density = 4500;                                         ///< of the solid rock [kg/m³]
  SizeDistribution sizes = blasted_ore;
};

/// What loose rock fills of a space, for sizing a fill; the tests measure it [1].
inline constexpr double loose_solid_share = 0.56;

/// All rocks of one length [m].
SizeDistribution single_size(double length);
double largest(const SizeDistribution& sizes);      ///< [m]
double mean_length(const SizeDistribution& sizes);  ///< by mass, Σ w_i L_i [m]
/// Mean mass of the rocks by number, Σ p_i m_i [kg].
double mean_mass(const RockSample& sample);

enum class RunStatus {
  completed,
  moving,  ///< the rocks had not come to rest within RestOptions::cap; the figure is of what lay then
  stopped  ///< asked to by `stop`; the figures are not to be used
};
std::string_view to_string(RunStatus status);

struct RunOptions {
  std::uint64_t seed = 1;
  engine::WorldOptions world;
  std::stop_token stop = {};  ///< looked at after every step
  /// Called after every step with what is being done and the share of it that is done (0 to 1).
  std::function<void(std::string_view phase, double done)> progress = {};
};

}  // namespace drawpoint::engine::granular

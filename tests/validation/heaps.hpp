// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/granular/heap_surface.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <string>
#include <vector>

/// Heaps of rocks: how they are poured. The shape of their surface: engine/granular/heap_surface.hpp.
///
/// Rocks are of one size, their six shapes in turn, turned at random (CounterRandom: the seed gives the
/// heap), let go in layers over the highest rock that lies. World frame, z up, SI units.
namespace drawpoint::validation {

/// "μ = 0.9, μ_r = 0.1", with μ_r the rolling resistance.
std::string name_of(const engine::Material& material);

struct Pour {
  int rocks = 100;
  double size = 0.3, density = 2700;  ///< longest dimension [m]; [kg/m³]
  Eigen::Vector2d centre = {0, 0};    ///< of the places where rocks are let go [m]
  int nx = 3, ny = 3;                 ///< places, one size apart
  double clearance = 0.6;             ///< of the places over the highest rock that lies [m]
  double lowest = 0;                  ///< they are never lower than this [m]
  double interval = 0.2;              ///< a layer every so many seconds
  double speed = 1;                   ///< downwards when let go [m/s]
  std::uint64_t seed = 1;
};

/// Pours into the world; `each_step` is called after every step. Returns the rocks' indices.
template <class EachStep>
void pour(engine::World& world, const Pour& options, EachStep&& each_step);

/// Steps for `time` seconds.
template <class EachStep>
void settle(engine::World& world, double time, EachStep&& each_step);

/// Lets the next layer of at most `most` rocks go; returns how many.
int let_go_layer(engine::World& world, const Pour& options, int most);

/// Highest centre of the rocks slower than `slower_than` [m/s]; 0 without any [m].
double highest_rock(const engine::World& world, double slower_than);

using engine::granular::angle_of_bank;
using engine::granular::angle_of_cone;
using engine::granular::Area;
using engine::granular::mean_height;

/// Mean and standard error of a sample of at least two.
struct Estimate {
  double mean, standard_error;
};
Estimate estimate(const std::vector<double>& sample);

template <class EachStep>
void settle(engine::World& world, double time, EachStep&& each_step) {
  const int steps = static_cast<int>(time / world.options().step + 0.5);
  for (int k = 0; k < steps; ++k) {
    world.step();
    each_step();
  }
}

template <class EachStep>
void pour(engine::World& world, const Pour& options, EachStep&& each_step) {
  for (int left = options.rocks; left > 0;) {
    left -= let_go_layer(world, options, left);
    settle(world, options.interval, each_step);
  }
}

}  // namespace drawpoint::validation

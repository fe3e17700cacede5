// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/world/world.hpp>
#include <string>
#include <vector>

/// Heaps of rocks: how they are poured, and the shape of their surface.
///
/// Rocks are of one size, their six shapes in turn, turned at random (CounterRandom: the seed gives the
/// heap). The surface over a place (x, y) is the highest rock on the vertical line there, found exactly by
/// clipping the line against the rocks' faces. Slopes are read from the area A(z) that the surface has above
/// height z, which needs no centre and no edge to be found: a cone has the radius √(A/π) there, a bank of
/// width W the depth A/W, and the angle is that of the least-squares line through radius or depth against z.
/// World frame, z up, SI units.
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

/// A rectangle of places in a square grid of 5 cm.
struct Area {
  double x0, x1, y0, y1;  ///< [m]
};
constexpr double place_spacing = 0.05;  ///< [m]

/// Surface height over each place of the area [m], 0 where there is no rock.
std::vector<double> surface_heights(const engine::World& world, const Area& area);
double mean_height(const engine::World& world, const Area& area);  ///< [m]

/// Angle [deg] of a heap that was poured on the floor anywhere, from one rock above the floor to where it is
/// one rock in radius.
double angle_of_cone(const engine::World& world, double size);
/// Angle [deg] of a bank that runs down along x, from half a rock above z = 0 to one rock below `crest` [m].
double angle_of_bank(const engine::World& world, const Area& area, double size, double crest);

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

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/engine/granular/size_distribution.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <vector>

/// Rocks as data, the emitter that pours them and the settling of a pile.
///
/// Rocks have one of six shapes and one of the four sizes of the distribution by mass; the emitter draws
/// sizes to a mass quota and shapes evenly, turns each at random and lets it go at rest, low over what
/// already lies below: ore in a raise comes down choked, it does not fall. Dropped from the top of the raise
/// instead, 8 m, the same rocks lie at 17 to 25 degrees in place of 36 to 39. All random numbers are
/// counter-based: the seed gives the pile, bit for bit.
namespace drawpoint::engine::granular {

struct RockSpec {
  int shape = 0;    ///< index into rock_shapes()
  double size = 0;  ///< longest dimension [m]
};

struct PlacedRock {
  RockSpec spec;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< centre of mass, principal axes
};

/// Rock body of a spec at a density [kg/m³]; bodies of equal rocks share their shape.
class RockLibrary {
 public:
  explicit RockLibrary(double density = 4500, int material = 0);
  engine::RockBody body(const RockSpec& spec) const;

 private:
  double density_;
  int material_;
  mutable std::vector<std::pair<RockSpec, engine::RockBody>> made_;
};

struct EmitterOptions {
  Eigen::Vector3d top = {0, 0, 8};  ///< no rock is born higher [m]; x and y: middle of the layer
  double radius = 1.2;              ///< centres of new rocks lie within this radius [m]
  /// If positive, they lie in a rectangle of these half lengths along x and y instead [m].
  Eigen::Vector2d half_lengths = {0, 0};
  double spacing = 0.91;   ///< of the places in a layer [m], at least the largest rock
  double clearance = 0.1;  ///< free fall of a new rock's sphere onto the spheres below it [m]
  double interval = 0.5;   ///< between two layers [s]; a rock comes to rest in about that
};

/// Draws rocks and lets them go over the heap, a layer of one rock per place at a time.
class Emitter {
 public:
  Emitter(const EmitterOptions& options, double density, std::uint64_t seed,
          const SizeDistribution& sizes = blasted_ore);
  /// Call once per step. When a layer is due, lets go at most `mass` [kg] (the last rock may exceed it), but
  /// nothing where the heap reaches the top. Returns the new rocks' indices.
  std::vector<int> emit(engine::World& world, const RockLibrary& library, std::vector<RockSpec>& specs,
                        double mass);

 private:
  EmitterOptions options_;
  std::vector<Eigen::Vector2d> places_;
  CounterRandom turns_;
  RockSampler sampler_;
  RockDraw next_;
  double due_ = 0;  // time of the next layer [s]
};

/// At rest: little energy in all, and nothing on the move. The speed limit lets single rocks tick as their
/// contacts change features (up to about 0.1 m/s for a step or two) but no rock fall or roll.
struct RestOptions {
  double mean_energy = 1e-4;  ///< mean kinetic energy per kilogram [J/kg]
  double fastest = 0.2;       ///< [m/s]
  double hold = 1.0;          ///< both for this long [s]
  double cap = 20.0;          ///< give up after [s]
};

/// Watches a world come to rest.
class RestWatch {
 public:
  explicit RestWatch(const RestOptions& options = {}) : options_(options) {}
  /// Call once per step; true once the pile has been at rest for `hold`, or after `cap` (then timed_out()).
  bool at_rest(const engine::World& world);
  bool timed_out() const { return timed_out_; }

 private:
  RestOptions options_;
  double calm_ = 0, elapsed_ = 0;
  bool timed_out_ = false;
};

double present_mass(const engine::World& world);  ///< [kg]

/// A raise that has let no rock go for this long is full or blocked [s].
constexpr double blocked_after = 5;

}  // namespace drawpoint::engine::granular

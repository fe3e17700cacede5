// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <drawpoint/engine/contact/world.hpp>
#include <drawpoint/engine/granular/size_distribution.hpp>
#include <drawpoint/engine/random.hpp>
#include <vector>

/// Rocks as data, the emitter that pours them and the settling of a pile.
///
/// Rocks have one of six shapes and one of the four sizes of the distribution by mass; the emitter draws
/// sizes to a mass quota and shapes evenly, turns each at random and lets it go at the top of the raise, a
/// layer of free places at a time, so that no two are born overlapping. All random numbers are counter-based:
/// the seed gives the pile, bit for bit.
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
  contact::RockBody body(const RockSpec& spec) const;

 private:
  double density_;
  int material_;
  mutable std::vector<std::pair<RockSpec, contact::RockBody>> made_;
};

struct EmitterOptions {
  Eigen::Vector3d centre = {0, 0, 8};  ///< middle of the emitting layer [m]
  double radius = 1.2;                 ///< rocks are born within this radius [m]
  double spacing = 0.91;               ///< of the places in the layer [m], at least the largest rock
  double speed = 2.0;                  ///< downward at birth [m/s]
};

/// Draws rocks and drops them where the layer is free.
class Emitter {
 public:
  Emitter(const EmitterOptions& options, double density, std::uint64_t seed);
  /// Fills the free places of the layer, at most up to `mass` [kg] (the last rock may exceed it). Returns the
  /// new rocks' indices.
  std::vector<int> emit(contact::World& world, const RockLibrary& library, std::vector<RockSpec>& specs,
                        double mass);

 private:
  EmitterOptions options_;
  std::vector<Eigen::Vector3d> places_;
  CounterRandom turns_;
  RockSampler sampler_;
};

/// At rest: little energy in all, and nothing on the move. The speed limit lets single rocks tick as their
/// contacts change features (up to about 0.1 m/s for a step or two) but no rock fall or roll.
struct RestOptions {
  double mean_energy = 1e-4;  ///< mean kinetic energy a kilogram [J/kg]
  double fastest = 0.2;       ///< [m/s]
  double hold = 1.0;          ///< both for this long [s]
  double cap = 20.0;          ///< give up after [s]
};

/// Watches a world come to rest.
class RestWatch {
 public:
  explicit RestWatch(const RestOptions& options = {}) : options_(options) {}
  /// Call once a step; true once the pile has been at rest for `hold`, or after `cap` (then timed_out()).
  bool at_rest(const contact::World& world);
  bool timed_out() const { return timed_out_; }

 private:
  RestOptions options_;
  double calm_ = 0, elapsed_ = 0;
  bool timed_out_ = false;
};

double present_mass(const contact::World& world);  ///< [kg]

}  // namespace drawpoint::engine::granular

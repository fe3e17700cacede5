// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Steps a world through the phases of a test: pour, wait for rest, go on for a time.
///
/// Every phase returns early when a stop was asked for. SI units.

#include <drawpoint/engine/granular/calibration/rock_sample.hpp>
#include <drawpoint/engine/granular/pile.hpp>
#include <initializer_list>
#include <memory>

namespace drawpoint::engine::granular {

/// Kinds of surface of the tests' worlds: rock and rough walls, and walls without friction.
enum CalibrationKind : int { rough = 0, smooth = 1 };
engine::MaterialTable calibration_materials(const engine::Material& contact);

std::shared_ptr<const engine::Shape> shape_of(engine::Shape shape);
/// A wall whose inside is where inward·x ≥ −distance.
void add_wall(engine::World& world, const Eigen::Vector3d& inward, double distance, int kind);
/// Floor and four walls of a box in the middle of the plane; the floor is rough.
void add_open_box(engine::World& world, double half_side, int kind_of_walls);
/// Layers that fill a rectangle about (x, 0).
EmitterOptions over_box(double x, const Eigen::Vector2d& half_lengths, double largest_rock);
/// Returns the number of the surface.
int add_block(engine::World& world, const Eigen::Vector3d& half, const Eigen::Vector3d& centre, int kind);

/// Takes rocks away that slid over an edge and are a metre below it.
void remove_fallen(engine::World& world);

/// Whether no value is NaN, which std::min lets through, or infinite: such a box is never full.
bool all_finite(std::initializer_list<double> values);

class TestRun {
 public:
  TestRun(engine::World& world, const RunOptions& options) : world_(&world), options_(&options) {}

  /// Lets go `mass` [kg] of the sample over the places of `where` and waits for rest.
  void pour(const RockSample& sample, const EmitterOptions& where, double mass,
            const std::function<void()>& each_step = {});
  void settle(const std::function<void()>& each_step = {});
  /// Until `done`, asked after every step, for at most `time` [s].
  void go_until(std::string_view phase, double time, const std::function<bool()>& done);
  /// For the steps that make up `time` [s].
  void go_on(std::string_view phase, double time, const std::function<void()>& each_step = {});

  bool stopped() const { return options_->stop.stop_requested(); }
  RunStatus status() const;

 private:
  void step(std::string_view phase, double done);

  engine::World* world_;
  const RunOptions* options_;
  bool moving_ = false;
};

}  // namespace drawpoint::engine::granular

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/granular/calibration/test_run.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace drawpoint::engine::granular {

engine::MaterialTable calibration_materials(const engine::Material& contact) {
  engine::MaterialTable table(2);
  table.set(rough, rough, contact);
  engine::Material slippery = contact;
  slippery.friction = slippery.rolling = slippery.spinning = 0;
  for (int kind : {rough, smooth}) table.set(kind, smooth, slippery);
  return table;
}

std::shared_ptr<const engine::Shape> shape_of(engine::Shape shape) {
  return std::make_shared<const engine::Shape>(std::move(shape));
}

void add_wall(engine::World& world, const Eigen::Vector3d& inward, double distance, int kind) {
  world.add_static(shape_of(engine::HalfSpace{inward, -distance}), Eigen::Isometry3d::Identity(), kind);
}

void add_open_box(engine::World& world, double half_side, int kind_of_walls) {
  add_wall(world, Eigen::Vector3d::UnitZ(), 0, rough);
  for (double side : {-1.0, 1.0})
    for (int axis : {0, 1}) add_wall(world, side * Eigen::Vector3d::Unit(axis), half_side, kind_of_walls);
}

EmitterOptions over_box(double x, const Eigen::Vector2d& half_lengths, double largest_rock) {
  constexpr double very_high = 1e3;  // [m]
  EmitterOptions where;
  where.top = {x, 0, very_high};
  where.half_lengths = half_lengths;
  where.spacing = 0.99 * largest_rock;  // a whole number of rocks fits in spite of round-off
  return where;
}

int add_block(engine::World& world, const Eigen::Vector3d& half, const Eigen::Vector3d& centre, int kind) {
  return world.add_static(shape_of(engine::box(half)), Eigen::Isometry3d(Eigen::Translation3d(centre)), kind);
}

void remove_fallen(engine::World& world) {
  for (int k = 0; k < static_cast<int>(world.rocks().size()); ++k)
    if (world.rocks()[k].present && world.rocks()[k].pose.translation().z() < -1) world.remove_rock(k);
}

bool all_finite(std::initializer_list<double> values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

void TestRun::step(std::string_view phase, double done) {
  world_->step();
  if (options_->progress) options_->progress(phase, done);
}

void TestRun::pour(const RockSample& sample, const EmitterOptions& where, double mass,
                   const std::function<void()>& each_step) {
  const RockLibrary library(sample.density, rough);
  Emitter emitter(where, sample.density, options_->seed, sample.sizes);
  std::vector<RockSpec> specs;
  double left = mass;
  while (left > 0 && !stopped()) {
    for (const int rock : emitter.emit(*world_, library, specs, left)) left -= world_->rock(rock).body.mass;
    step("pour", 1 - std::max(0.0, left) / mass);
    if (each_step) each_step();
  }
  settle(each_step);
}

void TestRun::settle(const std::function<void()>& each_step) {
  const RestOptions limits{.hold = 0.5, .cap = 15};
  RestWatch watch(limits);
  const double start = world_->time();
  do {
    if (stopped()) return;
    step("settle", std::min(1.0, (world_->time() - start) / limits.cap));
    if (each_step) each_step();
  } while (!watch.at_rest(*world_));
  moving_ = moving_ || watch.timed_out();
}

void TestRun::go_until(std::string_view phase, double time, const std::function<bool()>& done) {
  const int steps = static_cast<int>(std::lround(time / world_->options().step));
  for (int k = 0; k < steps && !stopped(); ++k) {
    step(phase, (k + 1.0) / steps);
    if (done()) return;
  }
}

void TestRun::go_on(std::string_view phase, double time, const std::function<void()>& each_step) {
  go_until(phase, time, [&] {
    if (each_step) each_step();
    return false;
  });
}

RunStatus TestRun::status() const {
  if (stopped()) return RunStatus::stopped;
  return moving_ ? RunStatus::moving : RunStatus::completed;
}

}  // namespace drawpoint::engine::granular

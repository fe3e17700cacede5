// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/base/random.hpp>
#include <drawpoint/tests/support/machines.hpp>
#include <drawpoint/tests/support/rocks.hpp>

/// A heap of rocks on a floor between walls, with a blade of 800 kg on a slider pushed into it by a motor
/// with limited force: a small scene in which everything that a step can do happens at once.
namespace drawpoint::support {

inline engine::machine::MachineSpec blade_on_a_slider(double max_force) {
  engine::machine::BodySpec body;
  body.name = "blade";
  body.joint = engine::machine::JointKind::slider;
  body.joint_point = body.centre = {-1.5, 0, 0.45};
  body.joint_axis = Vector3d::UnitX();
  body.mass = 800;
  body.inertia = Vector3d(120, 60, 120).asDiagonal();
  return {{body}, {}, {{"push", {0}, max_force}}, {{"travel", {0}, -0.5, 2.0}}};
}

/// Rocks of 0.3 to 0.6 m in layers over the floor, turned at random by the seed.
class BladePile {
 public:
  static constexpr engine::Material stone{.friction = 0.6, .rolling = 0.1, .stiffness = 1e8};

  BladePile(int rocks, const engine::WorldOptions& options, std::uint64_t seed = 7,
            const engine::Material& material = stone)
      : blade_(blade_on_a_slider(20e3)), world_(options, one_material(material)) {
    add_floor(world_);
    for (double side : {-1.0, 1.0})
      world_.add_static(shared(engine::box({3, 0.2, 3})), at(0, 1.7 * side, 3), 0);
    world_.add_static(shared(engine::box({0.2, 3, 3})), at(2.2, 0, 3), 0);
    world_.attach(&blade_);
    world_.add_part_shape(0, shared(engine::box({0.05, 1.4, 0.4})), at(0, 0, 0), 0);
    const std::array<engine::RockBody, 3> bodies{rock_body(0, 0.3), rock_body(2, 0.4), rock_body(4, 0.6)};
    engine::CounterRandom turns(seed);
    for (int k = 0; k < rocks; ++k) {
      Eigen::Isometry3d pose(turns.rotation());
      const int layer = k / 20, place = k % 20;
      pose.translation() = Vector3d(-0.9 + 0.65 * (place % 5), -1.0 + 0.65 * (place / 5), 0.4 + 0.65 * layer);
      world_.add_rock(bodies[static_cast<std::size_t>(k % 3)], pose);
    }
    blade_.set_motor(0, 0.6);
  }
  BladePile(const BladePile&) = delete;

  void run(int steps) {
    for (int k = 0; k < steps; ++k) report_ = world_.step();
  }

  engine::World& world() { return world_; }
  engine::machine::Machine& blade() { return blade_; }
  const engine::StepReport& report() const { return report_; }

 private:
  engine::machine::Machine blade_;
  engine::World world_;
  engine::StepReport report_;
};

}  // namespace drawpoint::support

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/support/pile_measures.hpp>

/// The pile of rock_pile.hpp in Drawpoint's own engine.
///
/// The blade is a machine of one part and one degree of freedom, w = √M v with M = 1e12 kg, whose velocity is
/// set anew at every step: it gives way by less than 1e-6 m/s under 1e6 N s per step, and the solver gives
/// the impulse on it as on any machine. So it costs what a machine's contacts cost. World frame, SI units.
namespace drawpoint::support {

/// A body that moves along x as it is told.
class PrescribedBody final : public engine::ArticulatedBody {
 public:
  explicit PrescribedBody(const Vector3d& centre) : pose_(Eigen::Translation3d(centre)) {}

  void set_speed(double speed) { speed_ = speed; }  ///< along +x from the next step on [m/s]
  /// Mean contact force over the last step [N].
  const Vector3d& force() const { return force_; }

  int parts() const override { return 1; }
  Eigen::Isometry3d part_pose(int) const override { return pose_; }

  const engine::SuperBody& linearise(double h, const Vector3d&) override {
    h_ = h;
    body_.velocity_before = body_.velocity = Eigen::VectorXd::Constant(1, root_mass * speed_);
    body_.part_maps.assign(1, engine::SpatialMap::Zero(6, 1));
    body_.part_maps[0](3, 0) = 1 / root_mass;
    body_.origins = {pose_.translation()};
    return body_;
  }
  void advance(const engine::SuperBodySolution& solution) override {
    force_ = solution.part_impulses.at(0).tail<3>() / h_;
    pose_.translation().x() += h_ * speed_;
  }

 private:
  static constexpr double root_mass = 1e6;  // [√kg]
  Eigen::Isometry3d pose_;
  double speed_ = 0, h_ = 1;
  Vector3d force_ = Vector3d::Zero();
  engine::SuperBody body_;
};

inline engine::MaterialTable pile_materials(const PileMaterial& m) {
  engine::MaterialTable table(1);
  table.set(0, 0,
            {.friction = m.friction,
             .rolling = m.rolling,
             .stiffness = m.stiffness,
             .damping_time = m.damping_time,
             .spinning = m.spinning,
             .restitution = m.restitution});
  return table;
}

/// The scene built; rocks have the numbers that they have in the pile.
class PileWorld {
 public:
  PileWorld(RockPile pile, const engine::WorldOptions& options)
      : pile_(std::move(pile)), blade_(pile_.blade.start), world_(options, pile_materials(pile_.material)) {
    for (const PileWall& wall : pile_.walls)
      world_.add_static(shape(engine::HalfSpace{wall.normal, wall.offset}), Eigen::Isometry3d::Identity(), 0);
    world_.attach(&blade_);
    world_.add_part_shape(0, shape(engine::box(pile_.blade.half)), Eigen::Isometry3d::Identity(), 0);
    std::vector<engine::RockBody> bodies;
    for (const PileHull& hull : pile_.hulls) bodies.push_back({shape(hull.hull), hull.mass, hull.inertia, 0});
    for (const PileRock& rock : pile_.rocks) world_.add_rock(bodies[rock.hull], rock.start);
  }
  PileWorld(const PileWorld&) = delete;
  PileWorld& operator=(const PileWorld&) = delete;

  const RockPile& pile() const { return pile_; }
  const PrescribedBody& blade() const { return blade_; }
  engine::World& world() { return world_; }
  const engine::World& world() const { return world_; }

  /// Sets the blade moving at its digging speed.
  void dig() { blade_.set_speed(pile_.blade.speed); }

  std::vector<RockState> states() const {
    std::vector<RockState> states;
    states.reserve(world_.rocks().size());
    for (const engine::Rock& rock : world_.rocks())
      states.push_back({rock.pose, rock.velocity, rock.angular_velocity});
    return states;
  }

 private:
  static std::shared_ptr<const engine::Shape> shape(engine::Shape s) {
    return std::make_shared<const engine::Shape>(std::move(s));
  }

  RockPile pile_;
  PrescribedBody blade_;
  engine::World world_;
};

}  // namespace drawpoint::support

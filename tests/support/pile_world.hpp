// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/kinematic_body.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/support/pile_measures.hpp>

/// The pile of rock_pile.hpp in Drawpoint's own engine.
///
/// The blade is a kinematic body: it costs what a machine's contacts cost. World frame, SI units.
namespace drawpoint::support {

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
      : pile_(std::move(pile)),
        blade_(Eigen::Isometry3d(Eigen::Translation3d(pile_.blade.start))),
        world_(options, pile_materials(pile_.material)) {
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
  const engine::KinematicBody& blade() const { return blade_; }
  engine::World& world() { return world_; }
  const engine::World& world() const { return world_; }

  /// Sets the blade moving at its digging speed.
  void dig() { blade_.set_velocity({pile_.blade.speed, 0, 0}); }

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
  engine::KinematicBody blade_;
  engine::World world_;
};

}  // namespace drawpoint::support

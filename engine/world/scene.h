// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/extra_reach.h>
#include <array>
#include <drawpoint/engine/base/hash.hpp>
#include <drawpoint/engine/collision/contact_finder.hpp>
#include <drawpoint/engine/collision/rigid_motion.hpp>
#include <drawpoint/engine/geometry/ray.hpp>
#include <drawpoint/engine/world/articulated_body.hpp>
#include <drawpoint/engine/world/contacts.hpp>
#include <drawpoint/engine/world/material.hpp>
#include <drawpoint/engine/world/rock.hpp>
#include <drawpoint/engine/world/world_options.hpp>
#include <memory>
#include <optional>
#include <vector>

/// What is in a world: rocks, fixed surroundings, the machine with its parts' shapes, and the finder of their
/// contacts. It alone knows which collider belongs to what.
namespace drawpoint::engine {

/// Adds a shape's defining numbers to a hash.
void add(StateHash& hash, const Shape& shape);

namespace detail {

/// What a collider is the surface of.
struct Surface : SurfaceOwner {
  int material = 0;
  double radius = 0;  ///< that holds the shape, about the body's origin [m]; 0 for a fixed one
};

class Scene {
 public:
  Scene(const WorldOptions& options, const MaterialTable& materials, std::shared_ptr<const ThreadPool> pool);

  /// As World's functions of these names.
  int add_rock(const RockBody& body, const Eigen::Isometry3d& pose, const Eigen::Vector3d& velocity,
               const Eigen::Vector3d& angular_velocity);
  int add_static(std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& pose, int material);
  void attach(ArticulatedBody* machine);
  void add_part_shape(int part, std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& X_PS,
                      int material);
  void remove_rock(int rock);

  /// The rock of this number, which may be a removed one in the first; else std::invalid_argument that names
  /// the function `place` of World.
  Rock& present_rock(int rock, const char* place);
  const Rock& rock(int rock, const char* place) const;
  const Rock& present_rock(int rock, const char* place) const;

  /// Finds the contacts of rocks and machine parts with everything, in a step of h [s]. Valid until the next call.
  const std::vector<Manifold>& find_contacts(double h);
  const FinderTimes& finder_times() const { return finder_.times(); }

  /// The machine's super-body for the coming step of h [s]; nullptr without a machine that contacts move.
  /// Stays as it is until the next call, whatever becomes of the machine.
  const SuperBody* linearise(double h);

  std::vector<Rock>& rocks() { return rocks_; }
  const std::vector<Rock>& rocks() const { return rocks_; }
  /// Numbers of the rocks that were not removed, ascending.
  const std::vector<int>& present() const { return present_; }
  const Surface& surface(int collider) const { return surfaces_[static_cast<std::size_t>(collider)]; }
  const MaterialTable& materials() const { return materials_; }
  ArticulatedBody* machine() const { return machine_; }
  /// Whose the collider is, as a user names it.
  SurfaceOwner owner(int collider) const;
  /// Where the origin of the surface's body is; of a machine, at the start of the last step.
  Eigen::Vector3d origin_of(const Surface& surface) const;
  RigidMotion motion_of(const Surface& surface) const;
  /// Acceleration of the point of a part that is at `position`, in a step of h [s]: that by outer and inertia forces,
  /// or the prescribed one [m/s²].
  Eigen::Vector3d part_acceleration(int part, const Eigen::Vector3d& position, double h) const;
  /// The machine's prescribed motion in this step; empty where contacts move it or there is none.
  const std::optional<PrescribedMotion>& prescribed() const { return prescribed_; }

  /// Beyond what velocities say, in this step [m].
  ExtraReach& extra_reach() { return extra_reach_; }
  double extra_reach_of(const Surface& surface) const {
    if (surface.owner == Owner::part) return extra_reach_.of_part(surface.index);
    return surface.owner == Owner::rock ? extra_reach_.of(surface.index) : 0.0;
  }

  bool reach_of_parts_grows(const SuperBodySolution& solved, double h) {
    return machine_ && !prescribed_ && extra_reach_.grow(super_, solved, h);
  }

  /// As World's function of this name.
  std::optional<RayHit> cast_ray(const Ray& ray, double most) const;

  const ContactFinder& finder() const { return finder_; }
  Eigen::Isometry3d shape_pose(int collider) const;
  /// Whether any shape of the surroundings or of a part may go on into another of the same body.
  bool has_inner_edges() const { return joined_surfaces_ > 1; }
  /// A new finder with these colliders, numbered as here, for these rocks.
  ContactFinder finder_for(const std::vector<Rock>& rocks) const;
  void replace(std::vector<Rock> rocks, ContactFinder finder);

  /// Hash of the calls that made the surroundings and parts.
  std::uint64_t surroundings_hash() const { return surroundings_.value(); }

 private:
  int add_surface(const char* place, const Surface& surface, const Collider& collider,
                  const Eigen::Isometry3d& pose);
  void check_materials(const char* place, const SurfaceOwner& owner, int kind) const;
  void hash_surface(int id, const Shape& shape, const Eigen::Isometry3d& pose);
  void place_colliders(double h);
  double speculative_margin_of(const Surface& surface, double h) const;

  WorldOptions options_;
  MaterialTable materials_;
  std::shared_ptr<const ThreadPool> pool_;
  ContactFinder finder_;
  std::vector<Surface> surfaces_;           // by collider
  std::array<std::vector<bool>, 3> kinds_;  // of the surfaces so far, by their owner
  int joined_surfaces_ = 0;                 // that are no rocks
  std::vector<Rock> rocks_;
  std::vector<int> present_;
  ExtraReach extra_reach_;
  ArticulatedBody* machine_ = nullptr;
  std::optional<PrescribedMotion> prescribed_;
  SuperBody super_;                  // of the last step, a copy: the machine's own is valid until it advances
  std::vector<ColliderMove> moves_;  // of this step
  StateHash surroundings_;
};

}  // namespace detail
}  // namespace drawpoint::engine

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <drawpoint/engine/base/eigen.hpp>
#include <drawpoint/engine/base/wrench.hpp>
#include <drawpoint/engine/geometry/ray.hpp>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <drawpoint/engine/world/articulated_body.hpp>
#include <drawpoint/engine/world/contacts.hpp>
#include <drawpoint/engine/world/material.hpp>
#include <drawpoint/engine/world/rock.hpp>
#include <drawpoint/engine/world/step_report.hpp>
#include <drawpoint/engine/world/world_options.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

/// Rocks, fixed surroundings and at most one machine, stepped together: nonsmooth DEM with fixed steps of h.
///
/// A step: find contacts at q; v* = v + h f/m; solve all impulses (rocks and machine in one problem); q⁺ = q
/// + h v⁺, and for rocks that nothing pushes q + h (v + v⁺)/2, a parabola. Rocks turn by the exponential map and keep
/// their angular momentum through the turn, so free rotation conserves it to round-off, and its energy but for a swing
/// of O(h²) (free_rotation.h). First order in h. World frame: x toward the back wall, z up.
///
/// Deterministic: the same calls give the same bits. Not thread-safe. Cost: linear in contacts.
namespace drawpoint::engine {

class World {
 public:
  /// Throws std::invalid_argument for options or materials out of range.
  World(const WorldOptions& options, const MaterialTable& materials);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// All of these throw std::invalid_argument for a value out of its range (checks.cpp), a rock that is not
  /// there or was removed, a part that the machine does not have; nothing has changed then. A rock may be
  /// given at most 1000 m/s and 10 000 rad/s.
  int add_rock(const RockBody& body, const Eigen::Isometry3d& pose,
               const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero(),
               const Eigen::Vector3d& angular_velocity = Eigen::Vector3d::Zero());
  void remove_rock(int rock);
  void set_rock_velocity(int rock, const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity);
  /// Returns the number by which SurfaceOwner names it.
  int add_static(std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& pose, int material);

  /// The machine is stepped with the rocks from now on; it must outlive the world. nullptr detaches it and
  /// takes its parts' shapes away.
  void attach(ArticulatedBody* machine);
  /// Gives machine part `part` a shape, placed in the part's frame. Parts do not collide with each other.
  void add_part_shape(int part, std::shared_ptr<const Shape> shape, const Eigen::Isometry3d& X_PS,
                      int material);

  /// Throws SolutionBroken when a velocity or the machine comes out not finite or absurdly fast; the rocks,
  /// machine and the time are then as before the step.
  StepReport step();
  /// A step of h [s], 1e-9 to 0.1, in place of options().step; the impulses that it starts from are scaled with h.
  StepReport step(double h);

  /// What all bodies put on each other in the last step; in no order that says anything.
  std::vector<PairForce> pair_forces() const;
  /// Contact force and moment on a rock about its centre, on a machine part about its origin: means of the last step.
  Wrench rock_wrench(int rock) const;
  Wrench part_wrench(int part) const;
  /// The first surface within `most` [m] on the ray, whose direction must be a unit vector; shapes that the origin is
  /// in are not hit. Cost: linear in the bodies, 30 ns for a rock that the ray passes by.
  std::optional<RayHit> cast_ray(const Ray& ray, double most = 1e3) const;

  /// All that later steps depend on, as bytes: rocks, machine, time, remembered contacts and impulses. The
  /// scene itself (options, materials, surroundings, kinds of rocks, machine) is not in it but its hashes.
  std::vector<std::byte> save() const;
  /// Takes a saved state back: from here on, the same bits. The world must have been built by the same calls
  /// with the same values; threads may differ. Throws std::runtime_error for another scene (naming its part)
  /// or damaged bytes, and then changes nothing.
  void restore(std::span<const std::byte> state);

  const std::vector<Rock>& rocks() const;
  /// Pose, velocity and properties of one. Throws std::invalid_argument for a rock that is not there.
  const Rock& rock(int rock) const;
  double time() const;  ///< [s]
  const ArticulatedBody* machine() const;
  const WorldOptions& options() const;
  /// Later steps are solved with these: to go on from one state at another accuracy. They belong to the options that a
  /// saved state is compared with. Throws std::invalid_argument for options out of range and then changes nothing.
  void set_solver(const SolverOptions& solver);
  /// Returns the last step's problem with its impulses. Bodies are the world, then the rocks; sides that
  /// stand still are the world.
  const ContactProblem& problem() const;

  /// Called in each step with the problem as it is about to be solved, for recording it.
  using Observer = std::function<void(const ContactProblem&)>;
  void before_solve(Observer observer);

  double kinetic_energy() const;  ///< of the rocks [J]
  double fastest_rock() const;    ///< [m/s], over the rocks' centres

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace drawpoint::engine

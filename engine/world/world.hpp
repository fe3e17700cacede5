// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/collision/contact_finder.hpp>
#include <drawpoint/engine/world/freezing.h>
#include <drawpoint/engine/world/material.hpp>
#include <drawpoint/engine/base/thread_pool.h>
#include <drawpoint/engine/solver/solver.hpp>
#include <drawpoint/engine/base/bytes.hpp>
#include <drawpoint/engine/world/warm_start.h>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

/// Rocks, fixed surroundings and at most one machine, stepped together: nonsmooth DEM with fixed steps of h.
///
/// A step: find contacts at q; v* = v + h f/m; solve all impulses (rocks and machine in one problem); q⁺ = q
/// + h v⁺. Rocks turn by the exponential map and keep their angular momentum through the turn, so free
/// rotation conserves it to round-off, and its energy but for a swing of O(h²) (free_turn.hpp). First order
/// in h. Rock frames: origin at the centre of mass, principal axes. World frame: x toward the back wall, z
/// up.
///
/// Deterministic: the same calls give the same bits. Not thread-safe. Cost: linear in contacts.
namespace drawpoint::engine {

struct WorldOptions {
  double step = 0.01;                                      ///< h [s]
  Eigen::Vector3d gravity = Eigen::Vector3d(0, 0, -9.81);  ///< [m/s²]
  SolverOptions solver;
  /// Share of last step's impulses to start from, 0 to 1. Less than 1 forgets load that the sweeps must then
  /// find again each step: a pile creeps.
  double warm_start = 1;
  ContactFinderOptions contacts;  ///< its threads are those of the solver
  FreezingOptions freezing;
};

/// A rock's fixed properties, shared by equal rocks.
struct RockBody {
  std::shared_ptr<const Shape> shape;  ///< convex polyhedron, centred, principal axes
  double mass = 0;                     ///< [kg]
  Eigen::Vector3d inertia;             ///< principal moments [kg m²]
  int material = 0;
};

struct Rock {
  RockBody body;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(), angular_velocity = Eigen::Vector3d::Zero();  ///< world
  bool present = true;  ///< a removed rock keeps its index
  int collider = -1;
};

/// What a step did and where its time went.
struct StepReport {
  int manifolds = 0, points = 0;
  double last_change = 0;                ///< of the solver's last sweep, relative to the normal load
  double complementarity = 0, cone = 0;  ///< residual of the contact law, relative to the normal load
  double max_overlap = 0;                ///< [m]
  int awake = 0;                         ///< rocks that were solved
  int solves = 0;  ///< 1, and one more for each time that the load on frozen rocks changed too much
  double broad_s = 0, narrow_s = 0, machine_s = 0, solver_s = 0, rest_s = 0;
};

/// The solution of a step came out not finite or absurdly fast.
class SolutionBroken : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class World {
 public:
  World(const WorldOptions& options, const MaterialTable& materials);

  /// All of these throw std::invalid_argument for a value out of its range (world_checks.hpp), a rock that is
  /// not there or was removed, a part that the machine does not have; nothing has changed then. A rock may be
  /// given at most 1000 m/s and 10 000 rad/s.
  int add_rock(const RockBody& body, const Eigen::Isometry3d& pose,
               const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero(),
               const Eigen::Vector3d& angular_velocity = Eigen::Vector3d::Zero());
  void remove_rock(int rock);
  void set_rock_velocity(int rock, const Eigen::Vector3d& velocity, const Eigen::Vector3d& angular_velocity);
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

  /// Whether a rock stands still and is not solved (freezing.hpp).
  bool frozen(int rock) const { return freezing_.frozen(rock); }
  void thaw_all();
  const Freezing& freezing() const { return freezing_; }

  /// All that later steps depend on, as bytes: rocks, machine, time, remembered contacts and impulses. The
  /// scene itself (options, materials, surroundings, kinds of rocks, machine) is not in it but marked.
  std::vector<std::byte> save() const;
  /// Takes a saved state back: from here on, the same bits. The world must have been built by the same calls
  /// with the same values; threads may differ. Throws std::runtime_error for another scene (naming its part)
  /// or damaged bytes, and then changes nothing.
  void restore(std::span<const std::byte> state);

  const std::vector<Rock>& rocks() const { return rocks_; }
  double time() const { return time_; }
  const ArticulatedBody* machine() const { return machine_; }
  const WorldOptions& options() const { return options_; }
  /// Of the last step, with its impulses. Bodies are the world, then the rocks that are awake; sides that
  /// stand still are the world.
  const ContactProblem& problem() const { return problem_; }

  /// Called in each step with the problem as it is about to be solved, for recording it.
  using Observer = std::function<void(const ContactProblem&)>;
  void before_solve(Observer observer) { before_solve_ = std::move(observer); }

  double kinetic_energy() const;  ///< of the rocks [J]
  double fastest_rock() const;    ///< [m/s], over the rocks' centres

 private:
  enum class Owner { fixed, rock, part };
  static constexpr int world_body = 0;  // problem_.bodies[0] never moves
  static constexpr int detached = -2;   // index of a part's surface whose machine was detached
  struct Surface {
    Owner owner;
    int index;
    int material;
    double radius = 0;  // that holds the shape, about the body's origin [m]
  };

  struct Side {
    Eigen::Vector3d origin, velocity, spin;
    Eigen::Vector3d at(const Eigen::Vector3d& position) const {
      return velocity + spin.cross(position - origin);
    }
  };

  // Where the next pair and the next point go in the problem; at first, how many a block of manifolds has.
  struct ContactPlace {
    int pair = 0, point = 0;
  };

  struct SceneMarks;
  SceneMarks scene_marks() const;

  static Collider rock_collider(const RockBody& body, int rock);
  ContactFinder finder_for(const std::vector<Rock>& rocks) const;

  int add_surface(const Surface& surface, const Collider& collider);
  void mark_surface(int id, const Shape& shape, const Eigen::Isometry3d& pose);
  int checked(int rock, const char* place) const;
  void place_colliders();
  void find_contacts(StepReport& report);
  SolverReport solve_contacts(StepReport& report);
  void keep_impulses();
  double deepest_overlap();
  void thaw(const std::vector<int>& rocks);
  void thaw_near_machine(StepReport& report);
  bool thaw_struck(int round);
  void settle_frozen();
  double reach_of(const Surface& surface) const;
  void check_solution(const SuperBodySolution& machine) const;
  void check_solution(int rock, const SolverBody& body) const;
  [[noreturn]] void fail(const std::string& what) const;
  void fill_bodies();
  void fill_contacts();
  unsigned joining(const Manifold& m) const;  // a bit for each point that may come to bear
  void count_joining(int first, int last);    // of these manifolds
  void fill_pairs(int first, int last);
  void fill_pair(const Manifold& m, unsigned joins, ContactPlace place, WarmStart::Reader& reader);
  int solver_index(const Surface& surface) const;
  Side side_of(const Surface& surface) const;
  Eigen::Vector3d origin_of(const Surface& surface) const;
  inline void fetch_origins(const Manifold& m) const;
  void move_rocks();
  void move(Rock& rock, const SolverBody& body) const;

  WorldOptions options_;
  MaterialTable materials_;
  std::shared_ptr<const detail::Parallel> parallel_;  // that the finder and the solver work on as well
  ContactFinder finder_;
  ContactSolver solver_;
  std::vector<Surface> surfaces_;  // by collider
  std::vector<Rock> rocks_;
  ArticulatedBody* machine_ = nullptr;
  const SuperBody* super_ = nullptr;
  const std::vector<Manifold>* manifolds_ = nullptr;
  std::vector<int> body_of_rock_;     // in the problem
  std::vector<unsigned> joins_;       // by manifold
  std::vector<ColliderMove> moves_;   // of this step
  std::vector<double> deepest_;       // overlap by block of manifolds [m]
  std::vector<ContactPlace> places_;  // by block of manifolds
  ContactProblem problem_;
  WarmStart warm_start_;
  StateHash surfaces_mark_;  // of the calls that made them
  long steps_ = 0;
  Observer before_solve_;
  Freezing freezing_;
  double time_ = 0;
};

}  // namespace drawpoint::engine

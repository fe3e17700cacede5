// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/machine/simbody_types.h>

/// A MachineSpec as a Simbody system with its state: the tree of bodies, and the pins that close its loops.
///
/// Joints turn about z and slide along x of their own frames, as Simbody's do, which are turned to the
/// joint's axis; at zero coordinates all bodies stand in the reference pose. Whatever moves the tree projects
/// q on to the loops (loop_projection.h), but for set_motion(), which gives a state its
/// very bits back. Throws std::runtime_error where the loops cannot be closed. Internal, as simbody_types.h.
namespace drawpoint::engine::machine {

struct SimbodyTree {
  static constexpr double fastest = 1e5;  ///< norm of all joint speeds; beyond, a step has broken down

  explicit SimbodyTree(const MachineSpec& spec);
  SimbodyTree(const SimbodyTree&) = delete;
  SimbodyTree& operator=(const SimbodyTree&) = delete;

  /// At rest in the reference pose, the machine frame at X_WM.
  void place(const Eigen::Isometry3d& X_WM);
  /// Moves the tree as it is by a world vector [m].
  void translate(const Eigen::Vector3d& by);
  /// The bases move so, without turning, and these joints turn or slide so.
  void set_velocity(const Eigen::Vector3d& velocity, const std::vector<std::pair<int, double>>& joint_speeds);
  /// One joint's coordinate; the others of its loops follow. Not moved if this throws.
  void set_coordinate(int body, double value);
  /// To the coordinates `q` moved on by `way`, speeds of all joints over a time, with the speeds `u`. Not
  /// moved if this throws.
  void move(const Eigen::VectorXd& u, const SimTK::Vector& q, const Eigen::VectorXd& way);
  /// Coordinates and speeds as they once were, not projected. They must close the loops; not moved if not.
  void set_motion(const Eigen::VectorXd& q, const Eigen::VectorXd& u);

  Eigen::Index speed_index(int body) const { return bodies[body].getFirstUIndex(state); }
  double coordinate(int body) const { return bodies[body].getOneQ(state, 0); }
  /// In the body's frame: its point that stands at p_M in the reference pose.
  SimTK::Vec3 station(int body, const Eigen::Vector3d& p_M) const {
    return to_simbody(Eigen::Vector3d(p_M - spec.bodies[body].centre));
  }

  const MachineSpec spec;
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> bodies;  ///< in the order of the spec
  SimTK::State state;                        ///< realised to velocities

 private:
  bool is_base(std::size_t body) const;
  void add_body(const BodySpec& body);
  void add_loop(const LoopPinSpec& loop);
  void close_loops(const std::vector<int>& held = {});
  void close_loops_by_all(const std::vector<int>& held, const SimTK::Vector& before);
  void put_back(const SimTK::Vector& q, const SimTK::Vector& u);
};

}  // namespace drawpoint::engine::machine

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/machine/joint_forces.h>

namespace drawpoint::engine::machine {

std::vector<JointForce> joint_forces(const std::vector<BodyMotion>& bodies) {
  std::vector<JointForce> joints(bodies.size(), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  // Until its turn comes, joints[b] collects what b's children pull out of it, at b's centre of mass.
  for (std::size_t k = bodies.size(); k-- > 0;) {
    const BodyMotion& b = bodies[k];
    const Eigen::Vector3d Iw = b.inertia * b.angular_velocity;
    const Eigen::Vector3d force = b.mass * b.acceleration - b.force + joints[k].force;
    const Eigen::Vector3d moment =
        b.inertia * b.angular_acceleration + b.angular_velocity.cross(Iw) - b.moment + joints[k].moment;
    joints[k] = {moment + (b.centre - b.joint_point).cross(force), force};
    if (b.parent < 0) continue;
    JointForce& parent = joints[b.parent];
    parent.force += force;
    parent.moment += joints[k].moment + (b.joint_point - bodies[b.parent].centre).cross(force);
  }
  return joints;
}

}  // namespace drawpoint::engine::machine

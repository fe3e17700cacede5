// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/world/step_bodies.h>

namespace drawpoint::engine::detail {
namespace {

constexpr int bodies_per_fill_block = 128;  // that a thread takes at a time

Eigen::Matrix3d turned(const Eigen::Matrix3d& R, const Eigen::Vector3d& principal) {
  return R * principal.asDiagonal() * R.transpose();
}

}  // namespace

void StepBodies::fill(const ThreadPool& pool, ContactProblem& problem) {
  const std::vector<Rock>& rocks = scene_.rocks();
  const std::vector<int>& present = scene_.present();
  problem.bodies.resize(present.size() + 1);
  problem.bodies[world] = SolverBody();
  motions_.resize(problem.bodies.size());
  motions_[world] = RigidMotion();
  body_of_rock_.assign(rocks.size(), world);
  pool.blocks(static_cast<int>(present.size()), bodies_per_fill_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) {
      const Rock& rock = rocks[present[k]];
      SolverBody& body = problem.bodies[k + 1];
      body_of_rock_[present[k]] = k + 1;
      body.inverse_mass = 1 / rock.body.mass;
      body.inverse_inertia = turned(rock.pose.linear(), rock.body.inertia.cwiseInverse());
      body.velocity = rock.velocity;
      body.external_velocity_change = problem.step * options_.gravity;
      body.angular_velocity = rock.angular_velocity;
      motions_[k + 1] = {rock.pose.translation(), rock.velocity, rock.angular_velocity, options_.gravity};
    }
  });
}

}  // namespace drawpoint::engine::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/engine/world/motion.h>

#include <drawpoint/engine/world/checks.h>
#include <drawpoint/engine/world/free_rotation.h>
#include <cmath>
#include <drawpoint/engine/world/step_report.hpp>
#include <sstream>

namespace drawpoint::engine::detail {
namespace {

constexpr int bodies_per_block = 128;  // that a thread takes at a time

void check(int rock, const SolverBody& body, const std::string& when) {
  const double speed = body.velocity.norm(), spin = body.angular_velocity.norm();
  const double motion = body.displacement.norm() + body.rotation_vector.norm();
  if (speed <= constants::fastest_solution && spin <= 10 * constants::fastest_solution &&
      std::isfinite(motion))
    return;
  std::ostringstream what;
  what << "rock " << rock << " comes out with " << speed << " m/s and " << spin << " rad/s";
  fail_solution(when, what.str());
}

void move(Rock& rock, const SolverBody& body, double h) {
  rock.velocity = body.velocity;
  rock.angular_velocity = body.angular_velocity;
  rock.pose.translation() += body.displacement;
  if (body.rotation_vector.squaredNorm() == 0) return;
  Eigen::Quaterniond q(rock.pose.linear());
  rotate_freely(q, rock.body.inertia, rock.angular_velocity, body.rotation_vector, h);
  rock.pose.linear() = q.toRotationMatrix();
}

}  // namespace

void fail_solution(const std::string& when, const std::string& what) {
  throw SolutionBroken("engine::World::step: " + when + ": " + what +
                       "; use a smaller step or more iterations");
}

void check_solution(const SolvedRocks& solved, const std::string& when) {
  solved.pool.blocks(static_cast<int>(solved.present.size()), bodies_per_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) check(solved.present[k], solved.problem.bodies[k + 1], when);
  });
}

void move_rocks(std::vector<Rock>& rocks, const SolvedRocks& solved, double h) {
  solved.pool.blocks(static_cast<int>(solved.present.size()), bodies_per_block, [&](int first, int last) {
    for (int k = first; k < last; ++k) move(rocks[solved.present[k]], solved.problem.bodies[k + 1], h);
  });
}

}  // namespace drawpoint::engine::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/solver/contact_block.h>
#include <Eigen/Dense>
#include <drawpoint/engine/solver/contact_problem.hpp>
#include <vector>

/// The law of one substep for few bodies, all points at once: Newton's method on the bodies' velocities.
///
/// Iterations over points pass the momentum of a heavy body through a light one in portions of the light one's
/// mass, so they need as many as the ratio of the masses; Newton's method does not see the ratio. Given the
/// bounds of friction and of moments, the law is the minimum of a convex function of the velocities,
/// ½ (v − v₀)ᵀ M (v − v₀) plus a potential of each point. Rigid parts of the law are relaxed by a share of a
/// point's own response, 1e-2 to 1e-8, about the impulses found so far (the proximal method of multipliers,
/// R. Rockafellar, Math. Oper. Res. 1 (1976) 97): rounds of "minimise, take the impulses over, set the bounds from
/// them" end where nothing is relaxed. Newton's steps to a minimum are as long as an exact search along them says.
/// Of 30 000 substeps of random stacks, masses 30 : 1 to 10⁸ : 1, 98 % solve the natural map to 1e-6 of the load and
/// the others to 1e-2 mostly, where bounds of friction find no fixed point. Cost: ten rounds of five steps, each a
/// factorisation of 6 rows per body: some 0.3 ms for three bodies.
namespace drawpoint::engine::detail {

class DirectSolution {
 public:
  /// Takes a problem without a machine, whose bodies and blocks must outlive it; `fastest`: see law::normal_step.
  DirectSolution(std::vector<SolverBody>& bodies, std::vector<PointBlock>& points,
                 std::vector<PairBlock>& pairs, double fastest);

  /// Moves impulses and velocities to the solution.
  void solve();

 private:
  using Rows = Eigen::Matrix<double, 3, 6>;
  // Three rows of the law: how bodies move them, and what bounds them.
  struct Triple {
    ContactBlock* block = nullptr;
    const PointBlock* point = nullptr;  // none: the moment of a pair
    int a = -1, b = -1;                 // places among the bodies that move, -1 for one that does not
    Rows rows_a = Rows::Zero(), rows_b = Rows::Zero();
    Eigen::Vector3d fixed = Eigen::Vector3d::Zero();  // velocity that bodies give which do not move
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
    double tangent_bound = 0, normal_bound = 0;
    double relaxed_normal = 0, relaxed_tangent = 0;  // r
  };
  struct Answer {
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
    Eigen::Matrix3d slope;  // - d impulse / d velocity
  };

  void add(ContactBlock& block, const PointBlock* point, int a, int b, const Rows& rows_a,
           const Rows& rows_b);
  Eigen::Vector3d velocity(const Triple& triple, const Eigen::VectorXd& v) const;
  Answer answer(const Triple& triple, const Eigen::Vector3d& u) const;
  Eigen::VectorXd gradient(const Eigen::VectorXd& v) const;
  Eigen::MatrixXd hessian(const Eigen::VectorXd& v) const;
  void minimise(Eigen::VectorXd& v) const;
  double length_of_step(const Eigen::VectorXd& v, const Eigen::VectorXd& step) const;
  void relax(int round);
  void set_bounds(double share);
  double take_over(const Eigen::VectorXd& v);
  Eigen::VectorXd pushed() const;

  std::vector<SolverBody>& bodies_;
  std::vector<PairBlock>& pairs_;
  double fastest_;
  std::vector<int> place_;       // of a body among those that move, -1
  std::vector<Triple> triples_;  // of the points, then of the pairs
  Eigen::MatrixXd mass_;         // 6 rows per body that moves: velocity, angular velocity
  Eigen::VectorXd free_;         // v₀: without any impulse
};

}  // namespace drawpoint::engine::detail

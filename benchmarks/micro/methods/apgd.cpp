// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/benchmarks/micro/matrix_form.hpp>

/// Accelerated projected gradient descent, double precision, S = 1; an iteration is one step of the gradient.
///
/// H. Mazhar, T. Heyn, D. Negrut, A. Tasora, "Using Nesterov's method to accelerate multibody dynamics with
/// friction and contact", 2015: a Nesterov step from an extrapolated point y, λ⁺ = P(y − D g(y) / L), with
/// the step size 1/L searched by doubling and the momentum dropped when it points uphill. Two departures.
/// Steps are scaled by D, the inverse of each point's own response, so that rocks of all masses share one L.
/// And P is not the projection on the friction cone, whose fixed points let sliding bodies rise (u_n = μ
/// |u_t|), but on the discs of the present normal impulses, whose fixed points are the law of
/// contact_problem.hpp; the price is that descent is no longer proven. A gradient costs one product with J
/// and one with Jᵀ: all rows at once, no order, no colours.
namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using Eigen::Index;
using Eigen::VectorXd;

class Apgd {
 public:
  Apgd(const ContactProblem& problem, const MatrixForm& form) : problem_(problem), form_(form) {
    impulses_ = form.start;
    form.project(problem, impulses_);
    x_ = form.x_free + pushed_by(impulses_);
    y_ = impulses_;
    x_y_ = x_;
  }

  void step() {
    const VectorXd gradient = form_.errors(y_, x_y_);
    VectorXd next, moved, change;
    for (;; bound_ *= 2) {
      next = y_ - form_.step_size.cwiseProduct(gradient) / bound_;
      form_.project(problem_, next);
      moved = next - y_;
      change = pushed_by(moved);
      if (curvature(moved, change) <= bound_ * scaled_square(moved)) break;
    }
    const VectorXd next_x = x_y_ + change, direction = next - impulses_;
    const double next_theta = 0.5 * theta_ * (std::sqrt(theta_ * theta_ + 4) - theta_);
    double momentum = theta_ * (1 - theta_) / (theta_ * theta_ + next_theta);
    theta_ = next_theta;
    if (gradient.dot(direction) > 0) momentum = 0, theta_ = 1;
    y_ = next + momentum * direction;
    x_y_ = next_x + momentum * (next_x - x_);
    impulses_ = next;
    x_ = next_x;
    bound_ *= 0.9;
  }

  const VectorXd& impulses() const { return impulses_; }
  VectorXd velocities() const { return form_.x_free + pushed_by(impulses_); }

 private:
  VectorXd pushed_by(const VectorXd& impulses) const {
    return form_.inverse_mass * (form_.J.transpose() * impulses);
  }
  // dᵀ (J M⁻¹ Jᵀ + Σ) d, which is at least what the gradient changes by along d, and dᵀ D⁻¹ d over the rows that
  // answer.
  double curvature(const VectorXd& d, const VectorXd& change) const {
    return d.dot(form_.J * change) + d.cwiseAbs2().dot(form_.sigma);
  }
  double scaled_square(const VectorXd& d) const {
    double sum = 0;
    for (Index row = 0; row < form_.rows; ++row)
      if (form_.step_size[row] > 0) sum += d[row] * d[row] / form_.step_size[row];
    return sum * (1 + 1e-12);  // round-off must not double the bound
  }

  const ContactProblem& problem_;
  const MatrixForm& form_;
  VectorXd impulses_, x_;  // λ and its velocities
  VectorXd y_, x_y_;       // extrapolated
  double theta_ = 1, bound_ = 1;
};

SolverReport solve_apgd(ContactProblem& problem, const MethodOptions& options) {
  const MatrixForm form(problem);
  Apgd method(problem, form);
  for (int k = 0; k < options.iterations; ++k) method.step();
  return form.store(problem, method.impulses(), method.velocities());
}

const RegisteredMethod apgd{{"apgd", solve_apgd}};

}  // namespace
}  // namespace drawpoint::benchmarks

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/benchmarks/micro/row_iteration.hpp>

/// Nonsmooth nonlinear conjugate gradients, double precision, S = 1; an iteration is one of Gauss-Seidel.
///
/// M. Silcowitz, S. Niebe, K. Erleben, "A nonsmooth nonlinear conjugate gradient method for interactive contact force
/// problems", 2010. The change by a Gauss-Seidel iteration is taken for minus the gradient, g = −(PGS(λ) − λ), and
/// Fletcher and Reeves' β = |g⁺|² / |g|² lets the last direction act on: λ ← PGS(λ) + β p, p ← β p − g. Where
/// β > 1, the change has grown, p starts anew. Norms are scaled by the rows' own responses, |g|² = gᵀ D⁻¹ g in N s m/s:
/// the energy of a change, so that a heavy contact does not outweigh all others. Impulses may leave their cones
/// between two iterations, so the method ends with a plain one.
namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using Eigen::VectorXd;

class Nncg {
 public:
  Nncg(const ContactProblem& problem, const MatrixForm& form)
      : iteration_(problem, form),
        scale_(form.step_size.unaryExpr([](double step) { return step > 0 ? 1 / step : 0.0; })) {}

  void step() {
    const VectorXd before = iteration_.impulses, before_x = iteration_.velocities;
    iteration_.iterate();
    const VectorXd change = iteration_.impulses - before, change_x = iteration_.velocities - before_x;
    const double square = change.cwiseAbs2().dot(scale_);
    const double beta = square_ > 0 ? square / square_ : 0;
    square_ = square;
    if (beta > 1 || direction_.size() == 0) {
      direction_ = change;
      direction_x_ = change_x;
      return;
    }
    iteration_.impulses += beta * direction_;
    iteration_.velocities += beta * direction_x_;
    direction_ = beta * direction_ + change;
    direction_x_ = beta * direction_x_ + change_x;
  }

  RowIteration& finished() {
    iteration_.project();
    iteration_.iterate();
    return iteration_;
  }

 private:
  RowIteration iteration_;
  VectorXd scale_, direction_, direction_x_;  // p, and the velocities that go with it
  double square_ = 0;                         // |g|² of the last iteration
};

SolverReport solve_nncg(ContactProblem& problem, const MethodOptions& options) {
  const MatrixForm form(problem);
  Nncg method(problem, form);
  for (int k = 1; k < options.iterations; ++k) method.step();
  const RowIteration& end = method.finished();
  return form.store(problem, end.impulses, end.velocities);
}

const RegisteredMethod nncg{{"nncg", solve_nncg}};

}  // namespace
}  // namespace drawpoint::benchmarks

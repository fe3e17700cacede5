// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Cholesky>
#include <deque>
#include <drawpoint/benchmarks/micro/contact_methods.hpp>
#include <drawpoint/benchmarks/micro/row_iteration.hpp>

/// Anderson acceleration of Gauss-Seidel, double precision, S = 1, over a window of five iterations.
///
/// D. G. Anderson, "Iterative procedures for nonlinear integral equations", 1965, as H. F. Walker and P. Ni, 2011,
/// write it: with the changes f = PGS(λ) − λ of the last iterations, λ ← PGS(λ) − Σ γ_k (ΔPGS)_k, where γ makes
/// |f − Σ γ_k Δf_k| least in the norm of the rows' own responses. Safeguard: when a change is more than twice the
/// least one so far, what is remembered is dropped and the plain iteration taken. The normal equations of the least
/// squares are small, and regularised by 1e-10 of their trace. It ends with a plain iteration, from the law's limits.
namespace drawpoint::benchmarks {
namespace {

using namespace engine;
using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t window = 5;

// What one iteration made of its start.
struct Memory {
  VectorXd change, impulses, velocities;  // f; PGS(λ) and its x
};

class Anderson {
 public:
  Anderson(const ContactProblem& problem, const MatrixForm& form)
      : iteration_(problem, form),
        scale_(form.step_size.unaryExpr([](double step) { return step > 0 ? 1 / step : 0.0; })) {}

  void step() {
    const VectorXd before = iteration_.impulses;
    iteration_.iterate();
    Memory now{iteration_.impulses - before, iteration_.impulses, iteration_.velocities};
    const double square = now.change.cwiseAbs2().dot(scale_);
    if (least_ >= 0 && square > 4 * least_) memory_.clear();
    if (least_ < 0 || square < least_) least_ = square;
    memory_.push_back(std::move(now));
    if (memory_.size() > window + 1) memory_.pop_front();
    if (memory_.size() > 1) mix();
  }

  RowIteration& finished() {
    iteration_.project();
    iteration_.iterate();
    return iteration_;
  }

 private:
  void mix() {
    const auto count = static_cast<Index>(memory_.size() - 1);
    Eigen::MatrixXd differences(scale_.size(), count);
    for (Index k = 0; k < count; ++k) differences.col(k) = memory_[k + 1].change - memory_[k].change;
    const Eigen::MatrixXd scaled = scale_.asDiagonal() * differences;
    Eigen::MatrixXd normal = differences.transpose() * scaled;
    normal.diagonal().array() += 1e-10 * normal.trace();
    const VectorXd gamma = normal.ldlt().solve(scaled.transpose() * memory_.back().change);
    if (!gamma.allFinite()) return;
    for (Index k = 0; k < count; ++k) {
      iteration_.impulses -= gamma[k] * (memory_[k + 1].impulses - memory_[k].impulses);
      iteration_.velocities -= gamma[k] * (memory_[k + 1].velocities - memory_[k].velocities);
    }
  }

  RowIteration iteration_;
  VectorXd scale_;
  std::deque<Memory> memory_;  // the newest last
  double least_ = -1;          // |f|² of the best iteration so far
};

SolverReport solve_anderson(ContactProblem& problem, const MethodOptions& options) {
  const MatrixForm form(problem);
  Anderson method(problem, form);
  for (int k = 1; k < options.iterations; ++k) method.step();
  const RowIteration& end = method.finished();
  return form.store(problem, end.impulses, end.velocities);
}

const RegisteredMethod anderson{{"anderson", solve_anderson}};

}  // namespace
}  // namespace drawpoint::benchmarks

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The scalar problems of polish.hpp, solved by Ipopt from one point of the front.
///
/// Variables (u, t) for chebyshev, u for epsilon_constraint; u in [0, 1]^d. Gradients are exact. The Hessian
/// of the Lagrangian is that of the gradients' forward differences with a step of 1e-6 of the box,
/// symmetrised: relative error about 1e-6, which costs no accuracy of the end point, only of the last steps
/// towards it, and saves most of the iterations that a quasi-Newton Hessian needs. Constraints are tightened
/// by ten tolerances, so that the end point meets them as they are. Nothing is printed and no option file is
/// read.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/pareto/detail/ipopt.hpp>
#include <limits>
#include <mutex>
#include <utility>

#include <drawpoint/doe/detail/ipopt_mutex.hpp>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/smooth_function.hpp>

namespace drawpoint::pareto {

enum class ScalarForm { chebyshev, epsilon_constraint };

namespace detail {

struct ScalarGoal {
  ScalarForm form = ScalarForm::chebyshev;
  int objective = 0;  ///< of epsilon_constraint
  double augmentation = 0.0;
};

struct ScalarEffort {
  double tolerance = 1e-9;
  int iterations = 100;
};

struct ScalarSolution {
  ScaledPoint point;
  bool converged = false;
};

class ScalarProblem : public Ipopt::TNLP {
 public:
  ScalarProblem(const ScaledProblem& scaled, const ScaledPoint& start, const ScalarGoal& goal, double margin)
      : scaled_(scaled), start_(start), at_(start), goal_(goal), margin_(margin) {}

  /// The last point that Ipopt accepted.
  const ScaledPoint& end() const { return end_; }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& rows, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override {
    n = size();
    rows = static_cast<Ipopt::Index>(objectives() + start_.limits.size());
    jacobian = n * rows;
    hessian = dimension() * (dimension() + 1) / 2;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Ipopt::Index n, double* lower, double* upper, Ipopt::Index rows, double* low,
                       double* high) override {
    std::fill(lower, lower + n, 0.0);
    std::fill(upper, upper + n, 1.0);
    for (Ipopt::Index i = 0; i < dimension(); ++i)
      if (!scaled_.moves(i)) lower[i] = upper[i] = start_.u[i];
    if (with_t()) lower[n - 1] = -(upper[n - 1] = infinite);
    std::fill(low, low + rows, -infinite);
    for (Ipopt::Index i = 0; i < rows; ++i) high[i] = i < objectives() && with_t() ? 0.0 : -margin_;
    if (!with_t()) high[goal_.objective] = infinite;  // the row of the objective itself says nothing
    return true;
  }

  bool get_starting_point(Ipopt::Index n, bool, double* x, bool, double*, double*, Ipopt::Index, bool,
                          double*) override {
    std::copy(start_.u.begin(), start_.u.end(), x);
    if (with_t()) x[n - 1] = 0.0;
    return true;
  }

  bool eval_f(Ipopt::Index n, const double* x, bool, double& f) override {
    if (!move_to(x)) return false;
    f = goal_.augmentation * gained().sum() + (with_t() ? x[n - 1] : gained()[goal_.objective]);
    return true;
  }

  bool eval_grad_f(Ipopt::Index n, const double* x, bool, double* g) override {
    if (!move_to(x)) return false;
    Eigen::Map<Eigen::RowVectorXd> gradient(g, n);
    gradient.head(dimension()) = goal_.augmentation * at_.gradients.colwise().sum();
    if (with_t())
      gradient[n - 1] = 1.0;
    else
      gradient.head(dimension()) += at_.gradients.row(goal_.objective);
    return true;
  }

  bool eval_g(Ipopt::Index n, const double* x, bool, Ipopt::Index, double* g) override {
    if (!move_to(x)) return false;
    const double t = with_t() ? x[n - 1] : 0.0;
    for (Ipopt::Index j = 0; j < objectives(); ++j) g[j] = gained()[j] - t;
    std::copy(at_.limits.begin(), at_.limits.end(), g + objectives());
    return true;
  }

  bool eval_jac_g(Ipopt::Index n, const double* x, bool, Ipopt::Index rows, Ipopt::Index, Ipopt::Index* row,
                  Ipopt::Index* column, double* values) override {
    if (!values) {
      for (Ipopt::Index i = 0; i < rows * n; ++i) {
        row[i] = i / n;
        column[i] = i % n;
      }
      return true;
    }
    if (!move_to(x)) return false;
    Eigen::Map<RowMajor> jacobian(values, rows, n);
    jacobian.topLeftCorner(objectives(), dimension()) = at_.gradients;
    jacobian.bottomLeftCorner(at_.limits.size(), dimension()) = at_.limit_gradients;
    if (with_t()) {
      jacobian.col(n - 1).setZero();
      jacobian.col(n - 1).head(objectives()).setConstant(-1.0);
    }
    return true;
  }

  bool eval_h(Ipopt::Index, const double* x, bool, double factor, Ipopt::Index rows,
              const double* multipliers, bool, Ipopt::Index, Ipopt::Index* row, Ipopt::Index* column,
              double* values) override {
    if (!values) {
      for (Ipopt::Index i = 0, entry = 0; i < dimension(); ++i)
        for (Ipopt::Index j = 0; j <= i; ++j, ++entry) {
          row[entry] = i;
          column[entry] = j;
        }
      return true;
    }
    if (!move_to(x)) return false;
    Eigen::VectorXd weights = Eigen::Map<const Eigen::VectorXd>(multipliers, rows);
    weights.head(objectives()).array() += factor * goal_.augmentation;
    if (!with_t()) weights[goal_.objective] += factor;
    return differences(weights, values);
  }

  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index, const double* x, const double*, const double*,
                         Ipopt::Index, const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    move_to(x);
    end_ = at_;
  }

 private:
  static constexpr double infinite = 1e20;  // Ipopt takes what is beyond 1e19 as no bound

  bool with_t() const { return goal_.form == ScalarForm::chebyshev; }
  Ipopt::Index dimension() const { return static_cast<Ipopt::Index>(start_.u.size()); }
  Ipopt::Index objectives() const { return static_cast<Ipopt::Index>(start_.F.size()); }
  Ipopt::Index size() const { return dimension() + (with_t() ? 1 : 0); }
  Eigen::VectorXd gained() const { return at_.F - start_.F; }

  bool move_to(const double* x) {
    const Eigen::VectorXd u = Eigen::Map<const Eigen::VectorXd>(x, dimension());
    if (u != at_.u) at_ = scaled_.at(u);
    return at_.sound;
  }

  static Eigen::RowVectorXd combined(const ScaledPoint& p, const Eigen::VectorXd& weights) {
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(p.u.size());
    for (Eigen::Index j = 0; j < p.F.size(); ++j) sum += weights[j] * p.gradients.row(j);
    for (Eigen::Index j = 0; j < p.limits.size(); ++j)
      sum += weights[p.F.size() + j] * p.limit_gradients.row(j);
    return sum;
  }

  /// The lower triangle of the weighted functions' Hessian.
  bool differences(const Eigen::VectorXd& weights, double* values) const {
    constexpr double step = 1e-6;
    const Eigen::RowVectorXd here = combined(at_, weights);
    Eigen::MatrixXd H(dimension(), dimension());
    for (Eigen::Index i = 0; i < H.rows(); ++i) {
      if (!scaled_.moves(i)) {
        H.row(i) = Eigen::RowVectorXd::Zero(H.cols());
        continue;
      }
      Eigen::VectorXd u = at_.u;
      u[i] += u[i] > 0.5 ? -step : step;
      const ScaledPoint there = scaled_.at(u);
      if (!there.sound) return false;
      H.row(i) = (combined(there, weights) - here) / (u[i] - at_.u[i]);
    }
    for (Eigen::Index i = 0; i < H.rows(); ++i)
      for (Eigen::Index j = 0; j <= i; ++j) *values++ = 0.5 * (H(i, j) + H(j, i));
    return true;
  }

  const ScaledProblem& scaled_;
  const ScaledPoint& start_;
  ScaledPoint at_, end_;
  ScalarGoal goal_;
  double margin_;
};

/// The barrier starts low and near the start, which is nearly optimal already.
inline Ipopt::SmartPtr<Ipopt::IpoptApplication> polishing_ipopt(const ScalarEffort& effort) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication(false);
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");
  ipopt->Options()->SetIntegerValue("max_iter", effort.iterations);
  ipopt->Options()->SetNumericValue("tol", effort.tolerance);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);
  ipopt->Options()->SetStringValue("nlp_scaling_method", "none");
  ipopt->Options()->SetNumericValue("mu_init", 1e-3);
  ipopt->Options()->SetNumericValue("bound_push", 1e-6);
  ipopt->Options()->SetNumericValue("bound_frac", 1e-6);
  ipopt->Initialize("");
  return ipopt;
}

/// From `start`, which is sound.
inline ScalarSolution solve_scalar(const ScaledProblem& scaled, const ScaledPoint& start,
                                   const ScalarGoal& goal, const ScalarEffort& effort) {
  const std::lock_guard<std::mutex> lock(doe::detail::ipopt_mutex());
  Ipopt::SmartPtr<ScalarProblem> problem = new ScalarProblem(scaled, start, goal, 10.0 * effort.tolerance);
  const auto status = polishing_ipopt(effort)->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(problem)));
  const bool done = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level ||
                    status == Ipopt::Search_Direction_Becomes_Too_Small;
  return {problem->end(), done};
}

}  // namespace detail
}  // namespace drawpoint::pareto

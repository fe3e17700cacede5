// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A local maximum of the likelihood in a box, by Ipopt from one start.
///
/// Ipopt gets the analytic gradient and one of two curvatures:
/// * exact: the Hessian, about 3d times the cost of a gradient. Few iterations, and saddles do not hold it.
/// * secant: a given matrix at the start, then damped BFGS updates (climb.hpp), one gradient an iteration.
/// Parameters that start at a bound with the gradient pushing outward are fixed there and released only when
/// the gradient turns: an interior-point method would push them off and spend iterations on their way back.
/// Stops when the gain that the curvature promises, ½ gᵀB⁻¹g, is below 1e-4, when Ipopt's optimality error is
/// below 1e-4, or when the last 4 iterations together gained less than 1e-3: near a singular R the likelihood
/// carries round-off that no step can climb.
///
/// Ipopt and its linear solver MUMPS call the BLAS that the system has chosen, whose last digits differ from
/// library to library. So the maximum is moved to the next multiple of 2⁻¹⁶ inside the box: all libraries
/// give the same bits, for a loss of log likelihood below 1e-9 per unit of curvature. MUMPS keeps global
/// state, so searches of different threads wait for each other.
/// Nothing is printed and no option file is read.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/detail/ipopt_mutex.hpp>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/ipopt.hpp>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <functional>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

struct Maximum {
  Eigen::VectorXd p;  ///< (ln θ, exponents where they are estimated, ln λ)
  double value = -std::numeric_limits<double>::infinity();
  bool converged = false;
};

/// Where a search starts. Without a curvature B ≈ −∂²LL/∂p∂p the exact Hessian is used throughout.
struct SearchStart {
  Eigen::VectorXd p;
  Eigen::MatrixXd curvature;
};

namespace detail {

inline constexpr double negligible_gain = 1e-4;

/// −LL as Ipopt wants it. Keeps the best point that was seen, which a search cut short would lose.
class NegativeLikelihood : public Ipopt::TNLP {
 public:
  NegativeLikelihood(Likelihood& likelihood, const Box& box, const SearchStart& start)
      : likelihood_(likelihood), box_(box), start_(start) {}

  const Eigen::VectorXd& best() const { return best_; }
  double best_value() const { return best_value_; }
  bool stopped() const { return stopped_; }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Ipopt::Index>(start_.p.size());
    m = jacobian = 0;
    hessian = n * (n + 1) / 2;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Ipopt::Index, double* lower, double* upper, Ipopt::Index, double*, double*) override {
    std::copy(box_.lower.begin(), box_.lower.end(), lower);
    std::copy(box_.upper.begin(), box_.upper.end(), upper);
    return true;
  }

  bool get_starting_point(Ipopt::Index, bool, double* x, bool, double*, double*, Ipopt::Index, bool,
                          double*) override {
    std::copy(start_.p.begin(), start_.p.end(), x);
    return true;
  }

  bool eval_f(Ipopt::Index n, const double* x, bool, double& f) override {
    const Eigen::VectorXd p = Eigen::Map<const Eigen::VectorXd>(x, n);
    const double value = likelihood_.value(p);
    if (value > best_value_) {
      best_value_ = value;
      best_ = p;
    }
    f = -value;
    return std::isfinite(value);
  }

  bool eval_grad_f(Ipopt::Index n, const double* x, bool, double* g) override {
    at_ = Eigen::Map<const Eigen::VectorXd>(x, n);
    gradient_ = likelihood_.gradient(at_);
    std::transform(gradient_.begin(), gradient_.end(), g, std::negate<>());
    return std::isfinite(likelihood_.estimates().log_likelihood);
  }

  bool eval_h(Ipopt::Index n, const double* x, bool, double factor, Ipopt::Index, const double*, bool,
              Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns, double* values) override {
    if (values) update_curvature(Eigen::Map<const Eigen::VectorXd>(x, n));
    for (Ipopt::Index i = 0, entry = 0; i < n; ++i) {
      for (Ipopt::Index j = 0; j <= i; ++j, ++entry) {
        if (values) {
          values[entry] = factor * B_(i, j);
        } else {
          rows[entry] = i;
          columns[entry] = j;
        }
      }
    }
    return !values || all_finite(B_);
  }

  bool eval_g(Ipopt::Index, const double*, bool, Ipopt::Index, double*) override { return true; }
  bool eval_jac_g(Ipopt::Index, const double*, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index*, Ipopt::Index*,
                  double*) override {
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Ipopt::Index, double, double, double, double, double,
                             double, double, double, Ipopt::Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    constexpr std::size_t window = 4;
    constexpr double gain = 1e-3;
    history_.push_back(best_value_);
    const std::size_t count = history_.size();
    const bool stalled = count > window && !(best_value_ - history_[count - 1 - window] >= gain);
    stopped_ = stalled || promises_nothing();
    return !stopped_;
  }

  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index, const double*, const double*, const double*,
                         Ipopt::Index, const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  void update_curvature(const Eigen::VectorXd& p) {
    if (start_.curvature.size() == 0) {
      B_ = likelihood_.hessian(p);
      std::transform(B_.data(), B_.data() + B_.size(), B_.data(), std::negate<>());
      return;
    }
    const Eigen::VectorXd g = likelihood_.gradient(p);
    if (secant_.empty())
      secant_.start(start_.curvature, p, g);
    else
      secant_.move_to(p, g);
    B_ = secant_.matrix();
  }

  // The curvature is the one before the last step, the gradient that of the last point.
  bool promises_nothing() const {
    if (B_.size() == 0 || gradient_.size() == 0) return false;
    const auto free = free_parameters(box_, at_, gradient_);
    if (free.empty()) return true;
    return 0.5 * dot(gradient_, newton_step(B_, free, gradient_)) < negligible_gain;
  }

  Likelihood& likelihood_;
  const Box& box_;
  const SearchStart& start_;
  Eigen::VectorXd best_, at_, gradient_;
  Curvature secant_;
  Eigen::MatrixXd B_;
  double best_value_ = -std::numeric_limits<double>::infinity();
  std::vector<double> history_;
  bool stopped_ = false;
};

inline Ipopt::SmartPtr<Ipopt::IpoptApplication> silent_ipopt(int max_iterations) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication(false);
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");
  ipopt->Options()->SetIntegerValue("max_iter", max_iterations);
  ipopt->Options()->SetNumericValue("tol", 1e-4);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);
  ipopt->Options()->SetStringValue("nlp_scaling_method", "none");
  // The start is near the maximum: no large barrier, which would push it away again.
  ipopt->Options()->SetNumericValue("mu_init", 1e-4);
  // Steps shrink fourfold and not below 1e-2 of the full one: shorter ones would only chase round-off.
  ipopt->Options()->SetNumericValue("alpha_red_factor", 0.25);
  ipopt->Options()->SetNumericValue("alpha_min_frac", 1.0);
  ipopt->Options()->SetNumericValue("gamma_theta", 1e-2);
  ipopt->Initialize("");
  return ipopt;
}

/// p on a grid that is far coarser than what a BLAS may change and far finer than what data can tell.
inline Eigen::VectorXd on_grid(const Box& box, const Eigen::VectorXd& p) {
  Eigen::VectorXd at = p;
  for (Eigen::Index i = 0; i < p.size(); ++i)
    at[i] = std::clamp(std::round(p[i] * 0x1p16) * 0x1p-16, box.lower[i], box.upper[i]);
  return at;
}

/// One run of Ipopt in a box in which equal bounds fix a parameter.
inline Maximum run_ipopt(Likelihood& likelihood, const Box& box, const SearchStart& start,
                         int max_iterations) {
  const std::lock_guard<std::mutex> lock(doe::detail::ipopt_mutex());
  Ipopt::SmartPtr<NegativeLikelihood> problem = new NegativeLikelihood(likelihood, box, start);
  const auto ipopt = silent_ipopt(max_iterations);
  const auto status = ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(problem)));
  const bool done = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level ||
                    status == Ipopt::Search_Direction_Becomes_Too_Small;
  const Eigen::VectorXd p = on_grid(box, problem->best());
  return {p, likelihood.value(p), done || problem->stopped()};  // the value of what is returned
}

/// `box` with the parameters fixed that a bound holds at p.
inline Box held_at(const Box& box, const Eigen::VectorXd& p, const Eigen::VectorXd& gradient) {
  Box held{p, p};
  for (const Eigen::Index i : free_parameters(box, p, gradient)) {
    held.lower[i] = box.lower[i];
    held.upper[i] = box.upper[i];
  }
  return held;
}

}  // namespace detail

/// Climbs from `start`, which lies in the box. The value is −∞ only when no point of the search had a finite
/// one.
inline Maximum maximize(Likelihood& likelihood, const Box& box, SearchStart start, int max_iterations) {
  Maximum best{start.p, likelihood.value(start.p), false};
  if (!std::isfinite(best.value)) return best;
  for (int round = 0; round < 3; ++round) {
    const Box held = detail::held_at(box, best.p, likelihood.gradient(best.p));
    if (held.lower == held.upper) {
      best.converged = true;
      return best;
    }
    start.p = best.p;
    const Maximum found = detail::run_ipopt(likelihood, held, start, max_iterations);
    const bool better = found.value >= best.value;
    best.converged = found.converged;
    if (!better) return best;
    best.p = found.p;
    best.value = found.value;
    const Box now = detail::held_at(box, best.p, likelihood.gradient(best.p));
    bool released = false;
    for (Eigen::Index i = 0; i < now.lower.size(); ++i)
      released = released || (held.lower[i] == held.upper[i] && now.lower[i] < now.upper[i]);
    if (!released) return best;
  }
  return best;
}

}  // namespace drawpoint::kriging

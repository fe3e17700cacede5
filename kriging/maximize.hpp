// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A local maximum of the likelihood in a box, by Ipopt from one start.
///
/// Ipopt gets the analytic gradient and one of two curvatures:
/// * exact: the Hessian, about 3d times the cost of a gradient. Few iterations, and saddles do not hold it.
/// * secant: the Fisher information at the start, then damped BFGS updates (Nocedal, Wright 2006, "Numerical
///   Optimization", procedure 18.2), one gradient an iteration.
/// Stops when Ipopt's optimality error is below 1e-4, or when the last 4 iterations together gained less than
/// 1e-3: near a singular R the likelihood carries round-off that no step can climb.
///
/// Ipopt's linear solver MUMPS keeps global state, so searches of different threads wait for each other.
/// Nothing is printed and no option file is read.

#include <Eigen/Core>
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <cmath>
#include <drawpoint/kriging/likelihood.hpp>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

namespace drawpoint::kriging {

enum class Curvature { exact, secant };

struct Maximum {
  Eigen::VectorXd p;  ///< (ln θ, ln λ)
  double value = -std::numeric_limits<double>::infinity();
  bool converged = false;
};

struct Box {
  Eigen::VectorXd lower, upper;
};

namespace detail {

/// Positive definite approximation of the Hessian of a function that is minimised.
class SecantHessian {
 public:
  bool empty() const { return B_.size() == 0; }
  const Eigen::MatrixXd& matrix() const { return B_; }

  void start(const Eigen::MatrixXd& B, const Eigen::VectorXd& p, const Eigen::VectorXd& g) {
    B_ = B;
    p_ = p;
    g_ = g;
  }

  void move_to(const Eigen::VectorXd& p, const Eigen::VectorXd& g) {
    const Eigen::VectorXd s = p - p_, Bs = B_ * s;
    Eigen::VectorXd y = g - g_;
    const double curvature = s.dot(Bs);
    p_ = p;
    g_ = g;
    if (!(curvature > 1e-14)) return;
    if (s.dot(y) < 0.2 * curvature) {
      const double share = 0.8 * curvature / (curvature - s.dot(y));
      y = share * y + (1.0 - share) * Bs;
    }
    B_ += y * y.transpose() / s.dot(y) - Bs * Bs.transpose() / curvature;
  }

 private:
  Eigen::MatrixXd B_;
  Eigen::VectorXd p_, g_;
};

/// −LL as Ipopt wants it. Keeps the best point that was seen, which a search cut short would lose.
class NegativeLikelihood : public Ipopt::TNLP {
 public:
  NegativeLikelihood(Likelihood& likelihood, const Box& box, Eigen::VectorXd start, Curvature curvature)
      : likelihood_(likelihood), box_(box), start_(std::move(start)), curvature_(curvature) {}

  const Eigen::VectorXd& best() const { return best_; }
  double best_value() const { return best_value_; }
  bool stalled() const { return stalled_; }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian, Ipopt::Index& hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Ipopt::Index>(start_.size());
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
    std::copy(start_.begin(), start_.end(), x);
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
    Eigen::Map<Eigen::VectorXd>(g, n) = -likelihood_.gradient(Eigen::Map<const Eigen::VectorXd>(x, n));
    return std::isfinite(likelihood_.estimates().log_likelihood);
  }

  bool eval_h(Ipopt::Index n, const double* x, bool, double factor, Ipopt::Index, const double*, bool,
              Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns, double* values) override {
    Eigen::MatrixXd H;
    if (values) H = factor * curvature_at(Eigen::Map<const Eigen::VectorXd>(x, n));
    for (Ipopt::Index i = 0, entry = 0; i < n; ++i) {
      for (Ipopt::Index j = 0; j <= i; ++j, ++entry) {
        if (values) {
          values[entry] = H(i, j);
        } else {
          rows[entry] = i;
          columns[entry] = j;
        }
      }
    }
    return !values || H.allFinite();
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
    stalled_ = count > window && !(best_value_ - history_[count - 1 - window] >= gain);
    return !stalled_;
  }

  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index, const double*, const double*, const double*,
                         Ipopt::Index, const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  Eigen::MatrixXd curvature_at(const Eigen::VectorXd& p) {
    if (curvature_ == Curvature::exact) return -likelihood_.hessian(p);
    const Eigen::VectorXd g = -likelihood_.gradient(p);
    if (secant_.empty())
      secant_.start(likelihood_.fisher(p), p, g);
    else
      secant_.move_to(p, g);
    return secant_.matrix();
  }

  Likelihood& likelihood_;
  const Box& box_;
  Eigen::VectorXd start_, best_;
  Curvature curvature_;
  SecantHessian secant_;
  double best_value_ = -std::numeric_limits<double>::infinity();
  std::vector<double> history_;
  bool stalled_ = false;
};

inline Ipopt::SmartPtr<Ipopt::IpoptApplication> silent_ipopt(int max_iterations) {
  Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication(false);
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");
  ipopt->Options()->SetIntegerValue("max_iter", max_iterations);
  ipopt->Options()->SetNumericValue("tol", 1e-4);
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);
  ipopt->Options()->SetStringValue("nlp_scaling_method", "none");
  // Steps shrink fourfold and not below 1e-2 of the full one: shorter ones would only chase round-off.
  ipopt->Options()->SetNumericValue("alpha_red_factor", 0.25);
  ipopt->Options()->SetNumericValue("alpha_min_frac", 1.0);
  ipopt->Options()->SetNumericValue("gamma_theta", 1e-2);
  ipopt->Initialize("");
  return ipopt;
}

inline std::mutex& ipopt_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace detail

/// Climbs from `start`, which lies in the box. The value is −∞ only when no point of the search had a finite
/// one.
inline Maximum maximize(Likelihood& likelihood, const Box& box, const Eigen::VectorXd& start,
                        Curvature curvature, int max_iterations) {
  const std::lock_guard<std::mutex> lock(detail::ipopt_mutex());
  Ipopt::SmartPtr<detail::NegativeLikelihood> problem =
      new detail::NegativeLikelihood(likelihood, box, start, curvature);
  const auto ipopt = detail::silent_ipopt(max_iterations);
  const auto status = ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(problem)));
  const bool done = status == Ipopt::Solve_Succeeded || status == Ipopt::Solved_To_Acceptable_Level ||
                    status == Ipopt::Search_Direction_Becomes_Too_Small;
  return {problem->best(), problem->best_value(), done || problem->stalled()};
}

}  // namespace drawpoint::kriging

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// From the points of a search to true optima of smooth functions, each with a certificate.
///
/// A search by populations ends near the front, and the dominated volume that it leaves is in every point.
/// Where gradients exist (a fitted surrogate, a formula) each point x° of the front is improved by
/// * chebyshev: min t + ρ Σ_j F_j(x) over x and t with F_j(x) - F_j(x°) <= t for all j: the point moves
///   straight at the front in all objectives alike (Wierzbicki 1980);
/// * epsilon_constraint: min F_k(x) + ρ Σ_j F_j(x) with F_j(x) <= F_j(x°) for all others (Haimes, Lasdon,
///   Wismer 1971; ρ after Mavrotas 2009): the point keeps its place in the others;
/// both within the bounds and the limits of the problem, by Ipopt with the gradients as given and Hessians
/// from differences of gradients. F are the objectives, minimised and scaled by their ranges on the front, x
/// in the unit box; integer and categorical variables keep their values. A result is kept only when it is
/// feasible and no objective is worse than at x°, so the dominated volume never falls. Every point, moved or
/// not, gets the residual of the first-order conditions (stationarity.hpp). Local: a point on a local front
/// stays there. Cost: 10 to 30 iterations per point, each one evaluation and d for the Hessian, plus about
/// half a millisecond per iteration inside Ipopt.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <drawpoint/pareto/detail/scalar_problem.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/search.hpp>
#include <drawpoint/pareto/stationarity.hpp>

namespace drawpoint::pareto {

struct PolishOptions {
  ScalarForm form = ScalarForm::chebyshev;
  int objective = 0;           ///< k of epsilon_constraint: its place among the objectives
  double augmentation = 1e-4;  ///< ρ >= 0; above 0 no result is only weakly optimal
  double tolerance = 1e-9;     ///< of Ipopt's optimality error in scaled units, above 0
  int iterations = 100;        ///< most iterations per point, 1 or more
  /// The reference point of the hypervolumes: m, natural units; none: worst of the front + a tenth of its range.
  std::optional<Eigen::VectorXd> reference{};
};

enum class PolishedPoint {
  improved,
  unchanged,  ///< it was an optimum already, or the end point was no better
  failed      ///< the function gave no finite numbers there, or Ipopt did not end
};

enum class PolishStatus {
  completed,
  points_failed,  ///< some points were left as they were
  empty_front     ///< there was nothing to polish
};

inline std::string_view to_string(PolishedPoint point) {
  switch (point) {
    case PolishedPoint::improved:
      return "improved";
    case PolishedPoint::unchanged:
      return "unchanged";
    case PolishedPoint::failed:
      return "failed";
  }
  return "unknown";
}

inline std::string_view to_string(PolishStatus status) {
  switch (status) {
    case PolishStatus::completed:
      return "completed";
    case PolishStatus::points_failed:
      return "points_failed";
    case PolishStatus::empty_front:
      return "empty_front";
  }
  return "unknown";
}

struct Polished {
  Front front;  ///< row i is polished from row i of the given front; rows may dominate each other
  /// The residuals of the first-order conditions in the real variables, 0 to 1; NaN where f failed or none is real.
  Eigen::VectorXd residual_before, residual;
  Eigen::MatrixXd weights;            ///< n x m, λ of the conditions at the polished points
  std::vector<PolishedPoint> points;  ///< n: what became of each
  double hypervolume_before = 0.0, hypervolume = 0.0;
  Eigen::VectorXd reference;  ///< that they were taken with, natural units
  int evaluations = 0;
  PolishStatus status = PolishStatus::completed;
  std::string message;  ///< empty when completed
};

namespace detail {

inline void check(const PolishOptions& o, const Front& front, std::size_t d, std::size_t m) {
  const std::string place = "pareto::polish: ";
  check_range(place, "objective", o.objective, o.objective >= 0 && o.objective < static_cast<int>(m),
              "0 to the number of objectives - 1");
  check_range(place, "augmentation", o.augmentation, o.augmentation >= 0.0, "0 or more");
  check_range(place, "tolerance", o.tolerance, o.tolerance > 0.0, "above 0");
  check_range(place, "iterations", o.iterations, o.iterations >= 1, "1 or more");
  if (front.X.cols() != static_cast<Eigen::Index>(d) || front.Y.cols() != static_cast<Eigen::Index>(m))
    throw std::invalid_argument(place + "front has " + std::to_string(front.X.cols()) + " variables and " +
                                std::to_string(front.Y.cols()) + " objectives, the problem has " +
                                std::to_string(d) + " and " + std::to_string(m) +
                                "; give the front of this problem");
  if (o.reference && o.reference->size() != static_cast<Eigen::Index>(m))
    throw std::invalid_argument(place + "reference has " + std::to_string(o.reference->size()) +
                                " entries; give one per objective or leave it out");
}

/// Gradients of the active limits and bounds at a point, as stationarity() wants them. Active is what lies
/// nearer than 1e-6 of the box: Ipopt's iterates keep a distance of about 1e-8 from what holds them.
inline Eigen::MatrixXd active_gradients(const ScaledPoint& p) {
  constexpr double near = 1e-6;
  const Eigen::Index d = p.u.size();
  std::vector<Eigen::RowVectorXd> rows;
  for (Eigen::Index c = 0; c < p.limits.size(); ++c)
    if (p.limits[c] >= -near * p.limit_gradients.row(c).norm()) rows.push_back(p.limit_gradients.row(c));
  for (Eigen::Index i = 0; i < d; ++i) {
    if (p.u[i] <= near) rows.push_back(-Eigen::RowVectorXd::Unit(d, i));
    if (p.u[i] >= 1.0 - near) rows.push_back(Eigen::RowVectorXd::Unit(d, i));
  }
  Eigen::MatrixXd gradients(static_cast<Eigen::Index>(rows.size()), d);
  for (std::size_t i = 0; i < rows.size(); ++i) gradients.row(static_cast<Eigen::Index>(i)) = rows[i];
  return gradients;
}

class Polisher {
 public:
  Polisher(ScaledProblem::Function f, const doe::Problem& problem, const Front& front,
           const PolishOptions& options)
      : options_(options),
        problem_(problem),
        scaled_(std::move(f), problem, front.responses),
        before_(front) {
    result_.front = front;
    result_.residual_before = result_.residual =
        Eigen::VectorXd::Constant(front.X.rows(), std::numeric_limits<double>::quiet_NaN());
    result_.weights = Eigen::MatrixXd::Zero(front.X.rows(), front.Y.cols());
  }

  Polished run() {
    int failed = 0;
    for (Eigen::Index i = 0; i < before_.X.rows(); ++i) {
      result_.points.push_back(polish(i));
      failed += result_.points.back() == PolishedPoint::failed;
    }
    measure();
    result_.evaluations = scaled_.evaluations();
    if (failed > 0) {
      result_.status = PolishStatus::points_failed;
      result_.message =
          std::to_string(failed) + " of " + std::to_string(before_.X.rows()) +
          " points were left as they were: the function failed there, or the search did not end";
    }
    return std::move(result_);
  }

 private:
  PolishedPoint polish(Eigen::Index i) {
    const ScaledPoint start = scaled_.at(scaled_.unit(before_.X.row(i).transpose()));
    if (!start.sound) return PolishedPoint::failed;
    if (!scaled_.any_moves()) return PolishedPoint::unchanged;
    result_.residual_before[i] = certify(i, start);
    const ScalarSolution end =
        solve_scalar(scaled_, start, {options_.form, options_.objective, options_.augmentation},
                     {options_.tolerance, options_.iterations});
    const bool better = end.point.sound && (end.point.limits.array() <= 0.0).all() &&
                        (end.point.F.array() <= start.F.array()).all() && end.point.F != start.F;
    const double residual = result_.residual_before[i];
    result_.residual[i] = better ? certify(i, end.point) : residual;
    if (!better) return end.converged ? PolishedPoint::unchanged : PolishedPoint::failed;
    result_.front.X.row(i) = scaled_.natural(end.point.u).transpose();
    result_.front.responses.row(i) = end.point.responses.transpose();
    return PolishedPoint::improved;
  }

  double certify(Eigen::Index i, const ScaledPoint& p) {
    const Stationarity s = stationarity(p.gradients, active_gradients(p));
    result_.weights.row(i) = s.weights.transpose();
    return s.residual;
  }

  void measure() {
    result_.front.Y = result_.front.responses(Eigen::all, scaled_.roles().objectives);
    const Eigen::MatrixXd before = minimised(problem_, before_.Y);
    const Eigen::RowVectorXd worst = before.colwise().maxCoeff();
    const Eigen::RowVectorXd usual = worst + 0.1 * (worst - before.colwise().minCoeff());
    result_.reference =
        options_.reference ? *options_.reference : Eigen::VectorXd(minimised(problem_, usual).transpose());
    result_.hypervolume_before = hypervolume(problem_, before_.Y, result_.reference);
    result_.hypervolume = hypervolume(problem_, result_.front.Y, result_.reference);
  }

  const PolishOptions& options_;
  const doe::Problem& problem_;
  ScaledProblem scaled_;
  const Front& before_;
  Polished result_;
};

}  // namespace detail

/// front: what a search on f found; f gives all responses of the problem and their derivatives. Throws
/// std::invalid_argument on a faulty option or a front of another problem. Deterministic; one thread at a
/// time is inside Ipopt.
template <class F>
Polished polish(const F& f, const doe::Problem& problem, const Front& front,
                const PolishOptions& options = {}) {
  static_assert(DifferentiableFunction<F>,
                "drawpoint: not a differentiable function. Expected "
                "pareto::ValueAndJacobian f(const Eigen::VectorXd& x) const; "
                "with all responses of the problem (r values) and their derivatives (r x d), natural units.");
  if constexpr (DifferentiableFunction<F>) {
    doe::check(problem);
    detail::check(options, front, problem.variables.size(), detail::roles(problem).objectives.size());
    if (front.X.rows() == 0) {
      Polished none;
      none.front = front;
      none.status = PolishStatus::empty_front;
      none.message = "the front has no points";
      return none;
    }
    return detail::Polisher([&f](const Eigen::VectorXd& x) -> ValueAndJacobian { return f(x); }, problem,
                            front, options)
        .run();
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What one objective costs in another at a point of a smooth front: the slope of the front there.
///
/// At a Pareto-stationary point Σ λ_j ∇F_j + Σ μ_c ∇g_c = 0 (stationarity.hpp), F_j = s_j y_j/range_j. Moving
/// along the front with all other objectives and the active limits held, λ_a dF_a + λ_b dF_b = 0, so
///   ∂y_a/∂y_b = - (λ_b s_b/range_b) / (λ_a s_a/range_a),  natural units.
/// Limits that are active are held where they are. To be used at polished points (polish.hpp); the residual
/// says how far the first-order conditions are from being met, and the rates are off by about that share. λ
/// is not unique where the gradients of objectives and active limits span less than m - 1 directions (a kink
/// or corner of the front): the rates are then one of the slopes between those on both sides. Cost: one
/// evaluation.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <string_view>

#include <drawpoint/pareto/detail/normalized.hpp>
#include <drawpoint/pareto/polish.hpp>

namespace drawpoint::pareto {

struct LocalTradeOffOptions {
  double tolerance = 1e-3;  ///< largest residual of a point that counts as stationary, above 0
};

enum class LocalTradeOffStatus {
  stationary,
  not_stationary,  ///< the residual is above the tolerance: polish the front first
  failed           ///< the function gave no finite numbers there
};

inline std::string_view to_string(LocalTradeOffStatus status) {
  switch (status) {
    case LocalTradeOffStatus::stationary:
      return "stationary";
    case LocalTradeOffStatus::not_stationary:
      return "not_stationary";
    case LocalTradeOffStatus::failed:
      return "failed";
  }
  return "unknown";
}

struct LocalTradeOff {
  LocalTradeOffStatus status = LocalTradeOffStatus::failed;
  /// m x m, entry (a, b) = ∂y_a/∂y_b in natural units, 1 on the diagonal. Infinity where λ_a = 0 (y_a falls
  /// to its optimum whatever y_b does), NaN where λ_b = 0 too.
  Eigen::MatrixXd rates;
  Eigen::VectorXd weights;                                     ///< λ: m, sum 1, of the scaled objectives
  double residual = std::numeric_limits<double>::quiet_NaN();  ///< NaN when failed
  std::string message;                                         ///< empty when stationary
};

namespace detail {

inline Eigen::MatrixXd rates_of(const Eigen::VectorXd& slope) {
  Eigen::MatrixXd rates = -(slope.cwiseInverse() * slope.transpose());
  for (Eigen::Index a = 0; a < rates.rows(); ++a)
    for (Eigen::Index b = 0; b < rates.cols(); ++b)
      if (slope[a] == 0.0)
        rates(a, b) = slope[b] == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                      : std::numeric_limits<double>::infinity();
  rates.diagonal().setOnes();
  return rates;
}

inline LocalTradeOff trade_off_at(const ScaledProblem& scaled, const Eigen::VectorXd& ranges,
                                  const Eigen::VectorXd& x, double tolerance) {
  LocalTradeOff result;
  const ScaledPoint point = scaled.at(scaled.unit(x));
  if (!point.sound) {
    result.message = "the function threw, or gave numbers that are not finite or of the wrong count, there";
    return result;
  }
  const Stationarity s = stationarity(point.gradients, active_gradients(point));
  result.weights = s.weights;
  result.residual = s.residual;
  result.status =
      s.residual <= tolerance ? LocalTradeOffStatus::stationary : LocalTradeOffStatus::not_stationary;
  if (s.residual > tolerance)
    result.message = "the residual is " + doe::detail::number_text(s.residual) + ", above the tolerance of " +
                     doe::detail::number_text(tolerance) + "; polish the front first";
  const auto m = s.weights.size();
  Eigen::VectorXd slope(m);
  for (Eigen::Index j = 0; j < m; ++j)
    slope[j] = s.weights[j] * scaled.roles().signs[static_cast<std::size_t>(j)] / ranges[j];
  result.rates = rates_of(slope);
  return result;
}

}  // namespace detail

/// row: of the front. f: as in polish. Throws std::invalid_argument for a front of another problem, a row
/// that does not exist and a faulty option.
template <class F>
LocalTradeOff local_trade_off(const F& f, const doe::Problem& problem, const Front& front, int row,
                              const LocalTradeOffOptions& options = {}) {
  static_assert(DifferentiableFunction<F>,
                "drawpoint: not a differentiable function. Expected "
                "pareto::ValueAndJacobian f(const Eigen::VectorXd& x) const; "
                "with all responses of the problem (r values) and their derivatives (r x d), natural units.");
  if constexpr (DifferentiableFunction<F>) {
    const std::string place = "pareto::local_trade_off: ";
    detail::check_front(place, problem, front);
    detail::check_range(place, "row", row, row >= 0 && row < static_cast<int>(front.X.rows()),
                        "0 to the number of points - 1");
    detail::check_range(place, "tolerance", options.tolerance, options.tolerance > 0.0, "above 0");
    const detail::ScaledProblem scaled([&f](const Eigen::VectorXd& x) -> ValueAndJacobian { return f(x); },
                                       problem, front.responses);
    return detail::trade_off_at(scaled, detail::normalized(problem, front).range.transpose(),
                                front.X.row(row).transpose(), options.tolerance);
  } else {
    return {};  // so that the message above stands alone
  }
}

}  // namespace drawpoint::pareto

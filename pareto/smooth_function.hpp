// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A function with derivatives, and the problem as an optimiser wants it: unit box, minimised objectives of
/// range one, limits as g <= 0.
///
/// F_j = ± y_j / (range of y_j on the front), g_c = ± (y_c - limit) / (range of y_c on the front, or a
/// thousandth of the limit where that is more). A response that does not vary on the front keeps its unit.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <exception>
#include <functional>
#include <vector>

#include <drawpoint/doe/value_and_jacobian.hpp>
#include <drawpoint/pareto/detail/roles.hpp>

namespace drawpoint::pareto {

using doe::ValueAndJacobian;

template <class F>
concept DifferentiableFunction = requires(const F& f, const Eigen::VectorXd& x) {
  { f(x) } -> std::convertible_to<ValueAndJacobian>;
};

namespace detail {

struct ScaledPoint {
  Eigen::VectorXd u, responses;                ///< place in the unit box; all responses in natural units
  Eigen::VectorXd F, limits;                   ///< m objectives; limits, each <= 0 when met
  Eigen::MatrixXd gradients, limit_gradients;  ///< by u
  bool sound = false;                          ///< f returned finite numbers of the right shape
};

class ScaledProblem {
 public:
  using Function = std::function<ValueAndJacobian(const Eigen::VectorXd&)>;

  /// responses: n x r on the front, n >= 1.
  ScaledProblem(Function f, const doe::Problem& problem, const Eigen::MatrixXd& responses)
      : f_(std::move(f)), problem_(problem), role_(detail::roles(problem)) {
    const auto d = static_cast<Eigen::Index>(problem.variables.size());
    lower_.resize(d);
    width_.resize(d);
    for (Eigen::Index i = 0; i < d; ++i) {
      const doe::Variable& v = problem.variables[static_cast<std::size_t>(i)];
      lower_[i] = v.lower;
      width_[i] = v.upper - v.lower;
      moves_.push_back(v.kind == doe::VariableKind::real);
    }
    range_ = (responses.colwise().maxCoeff() - responses.colwise().minCoeff()).transpose();
    for (const int c : role_.constraints)
      range_[c] = std::max(range_[c], 1e-3 * std::abs(problem.responses[static_cast<std::size_t>(c)].limit));
    for (double& r : range_)
      if (!(r > 0.0)) r = 1.0;
  }

  const Roles& roles() const { return role_; }
  int evaluations() const { return evaluations_; }
  /// Integer and categorical variables keep the values that the search gave them, and count with no slope.
  bool moves(Eigen::Index i) const { return moves_[static_cast<std::size_t>(i)]; }

  bool any_moves() const { return std::find(moves_.begin(), moves_.end(), true) != moves_.end(); }

  Eigen::VectorXd unit(const Eigen::VectorXd& x) const {
    return (x - lower_).cwiseQuotient(width_).cwiseMax(0.0).cwiseMin(1.0);
  }
  Eigen::VectorXd natural(const Eigen::VectorXd& u) const {
    Eigen::VectorXd x = (lower_ + u.cwiseProduct(width_)).cwiseMax(lower_).cwiseMin(lower_ + width_);
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (!moves(i)) x[i] = std::round(x[i]);
    return x;
  }

  ScaledPoint at(const Eigen::VectorXd& u) const {
    ++evaluations_;
    ScaledPoint p;
    p.u = u;
    ValueAndJacobian y;
    try {
      y = f_(natural(u));
    } catch (const std::exception&) {
      return p;  // not sound: as a value that is not finite
    }
    p.sound = y.values.size() == range_.size() && y.jacobian.rows() == range_.size() &&
              y.jacobian.cols() == u.size() && y.values.allFinite() && y.jacobian.allFinite();
    if (!p.sound) return p;
    fill(p, y);
    return p;
  }

 private:
  void fill(ScaledPoint& p, const ValueAndJacobian& y) const {
    const auto m = static_cast<Eigen::Index>(role_.objectives.size());
    const auto k = static_cast<Eigen::Index>(role_.constraints.size());
    p.responses = y.values;
    p.F.resize(m);
    p.gradients.resize(m, p.u.size());
    for (Eigen::Index j = 0; j < m; ++j) {
      const int row = role_.objectives[j];
      const double scale = role_.signs[j] / range_[row];
      p.F[j] = scale * y.values[row];
      p.gradients.row(j) = scale * slope(y, row);
    }
    p.limits.resize(k);
    p.limit_gradients.resize(k, p.u.size());
    for (Eigen::Index c = 0; c < k; ++c) {
      const int row = role_.constraints[c];
      const doe::Response& response = problem_.responses[row];
      const double scale = doe::sign_of(response.goal) / range_[row];
      p.limits[c] = scale * (y.values[row] - response.limit);
      p.limit_gradients.row(c) = scale * slope(y, row);
    }
  }

  // By the unit box.
  Eigen::RowVectorXd slope(const ValueAndJacobian& y, int row) const {
    Eigen::RowVectorXd g = y.jacobian.row(row).cwiseProduct(width_.transpose());
    for (Eigen::Index i = 0; i < g.size(); ++i)
      if (!moves(i)) g[i] = 0.0;
    return g;
  }

  Function f_;
  const doe::Problem& problem_;
  Roles role_;
  Eigen::VectorXd lower_, width_, range_;
  std::vector<bool> moves_;
  mutable int evaluations_ = 0;
};

}  // namespace detail
}  // namespace drawpoint::pareto

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The box that a search moves in, as the unit box [0, 1]^d, with integer variables on its grid.
///
/// An integer variable of K values in lower..upper (whole numbers) has the grid u = k/(K-1). A start that is
/// uniform in [0, 1] gives each value the same share, k = ⌊u K⌋; what crossover makes goes to the nearest
/// value. The black box sees exact whole numbers. A categorical variable is searched as the integer of its
/// level, as if levels had an order.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::pareto::detail {

class SearchSpace {
 public:
  explicit SearchSpace(const doe::Problem& problem)
      : variables_(problem.variables), steps_(problem.variables.size(), 0.0) {
    for (std::size_t j = 0; j < variables_.size(); ++j)
      if (variables_[j].kind != doe::VariableKind::real)
        steps_[j] = variables_[j].upper - variables_[j].lower;
  }

  Eigen::Index dimension() const { return static_cast<Eigen::Index>(steps_.size()); }

  /// K - 1 for an integer variable of K values, else 0.
  double steps(Eigen::Index j) const { return steps_[static_cast<std::size_t>(j)]; }

  double nearest(double u, Eigen::Index j) const {
    return steps(j) > 0.0 ? std::round(u * steps(j)) / steps(j) : u;
  }

  Eigen::MatrixXd start(int points, doe::Seed seed) const {
    Eigen::MatrixXd U = doe::detail::unit_latin_hypercube(points, dimension(), seed);
    for (Eigen::Index j = 0; j < U.cols(); ++j)
      if (const double K = steps(j) + 1.0; K > 1.0)
        for (double& u : U.col(j)) u = std::min(std::floor(u * K), K - 1.0) / (K - 1.0);
    return U;
  }

  Eigen::MatrixXd natural(const Eigen::MatrixXd& U) const {
    Eigen::MatrixXd X = U;
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      const doe::Variable& v = variables_[static_cast<std::size_t>(j)];
      const bool whole = steps(j) > 0.0;
      for (double& x : X.col(j))
        x = whole ? v.lower + std::round(x * steps(j))
                  : std::clamp(v.lower + x * (v.upper - v.lower), v.lower, v.upper);
    }
    return X;
  }

 private:
  std::vector<doe::Variable> variables_;
  std::vector<double> steps_;
};

}  // namespace drawpoint::pareto::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The box that a search moves in, as the unit box [0, 1]^d, with integer variables on its grid.
///
/// An integer variable of K values in lower..upper (whole numbers) has the grid u = k/(K-1). A start that is
/// uniform in [0, 1] gives each value the same share, k = ⌊u K⌋; what crossover makes goes to the nearest
/// value. The black box sees exact whole numbers. Integer are the variables of kind integer and those that
/// the options name; a categorical variable is searched as the integer of its level, as if they had an order.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::pareto::detail {

class SearchSpace {
 public:
  /// integers: places of the integer variables in problem.variables. Throws std::invalid_argument, with
  /// `place` in front, for a place that does not exist or a bound that is not whole.
  SearchSpace(const std::string& place, const doe::Problem& problem, const std::vector<int>& integers)
      : problem_(problem), steps_(problem.variables.size(), 0.0) {
    const int d = static_cast<int>(problem.variables.size());
    for (int j = 0; j < d; ++j) {
      const doe::Variable& v = problem.variables[static_cast<std::size_t>(j)];
      if (v.kind != doe::VariableKind::real) steps_[static_cast<std::size_t>(j)] = v.upper - v.lower;
    }
    for (const int j : integers) {
      if (j < 0 || j >= d)
        throw std::invalid_argument(place + "integers holds " + std::to_string(j) + "; allowed is 0 to " +
                                    std::to_string(d - 1) + ", places in Problem::variables");
      const doe::Variable& v = problem.variables[static_cast<std::size_t>(j)];
      if (v.lower != std::floor(v.lower) || v.upper != std::floor(v.upper))
        throw std::invalid_argument(place + "integer variable \"" + v.name + "\" has bounds " +
                                    doe::detail::with_unit(v.lower, v.unit) + " and " +
                                    doe::detail::with_unit(v.upper, v.unit) + "; give whole numbers");
      steps_[static_cast<std::size_t>(j)] = v.upper - v.lower;
    }
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
      const doe::Variable& v = problem_.variables[static_cast<std::size_t>(j)];
      const bool whole = steps(j) > 0.0;
      for (double& x : X.col(j))
        x = whole ? v.lower + std::round(x * steps(j))
                  : std::clamp(v.lower + x * (v.upper - v.lower), v.lower, v.upper);
    }
    return X;
  }

 private:
  const doe::Problem& problem_;
  std::vector<double> steps_;
};

}  // namespace drawpoint::pareto::detail

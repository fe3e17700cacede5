// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The box that a search moves in, as the unit box [0, 1]^d, with integer variables on its grid.
///
/// An integer variable of K values in lower..upper (whole numbers) has the grid u = k/(K-1). A start that is
/// uniform in [0, 1] gives each value the same share, k = ⌊u K⌋; what crossover makes goes to the nearest
/// value. The black box sees exact whole numbers. A categorical variable is searched as the integer of its
/// level, as if levels had an order. Points that the caller gives come back as they were given: the way to
/// the unit box and back rounds, so their values are kept beside their places.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/problem.hpp>

namespace drawpoint::pareto::detail {

class SearchSpace {
 public:
  /// given: k x d, inside the box, natural units.
  SearchSpace(const doe::Problem& problem, const Eigen::MatrixXd& given)
      : variables_(problem.variables),
        steps_(problem.variables.size(), 0.0),
        given_(given.rows(), dimension()),
        known_(problem.variables.size()) {
    for (std::size_t j = 0; j < variables_.size(); ++j)
      if (variables_[j].kind != doe::VariableKind::real)
        steps_[j] = variables_[j].upper - variables_[j].lower;
    if (given.rows() > 0)
      for (Eigen::Index j = 0; j < dimension(); ++j) take_in(given.col(j), j);
  }

  Eigen::Index dimension() const { return static_cast<Eigen::Index>(steps_.size()); }

  /// K - 1 for an integer variable of K values, else 0.
  double steps(Eigen::Index j) const { return steps_[static_cast<std::size_t>(j)]; }

  double nearest(double u, Eigen::Index j) const {
    return steps(j) > 0.0 ? std::round(u * steps(j)) / steps(j) : u;
  }

  /// The given points, all of them, and as many of a Latin hypercube as are missing.
  Eigen::MatrixXd start(int points, doe::Seed seed) const {
    const auto missing = std::max<Eigen::Index>(points - given_.rows(), 0);
    Eigen::MatrixXd U(given_.rows() + missing, dimension());
    U.topRows(given_.rows()) = given_;
    if (missing > 0) U.bottomRows(missing) = latin_hypercube(static_cast<int>(missing), seed);
    return U;
  }

  Eigen::MatrixXd natural(const Eigen::MatrixXd& U) const {
    Eigen::MatrixXd X = U;
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
      const doe::Variable& v = variables_[static_cast<std::size_t>(j)];
      const bool whole = steps(j) > 0.0;
      for (double& x : X.col(j))
        x = whole ? v.lower + std::round(x * steps(j))
                  : known(x, j, std::clamp(v.lower + x * (v.upper - v.lower), v.lower, v.upper));
    }
    return X;
  }

 private:
  using Known = std::vector<std::pair<double, double>>;  // place in the unit box and value, rising

  Eigen::MatrixXd latin_hypercube(int points, doe::Seed seed) const {
    Eigen::MatrixXd U = doe::detail::unit_latin_hypercube(points, dimension(), seed);
    for (Eigen::Index j = 0; j < U.cols(); ++j)
      if (const double K = steps(j) + 1.0; K > 1.0)
        for (double& u : U.col(j)) u = std::min(std::floor(u * K), K - 1.0) / (K - 1.0);
    return U;
  }

  /// Values of variable j of the given points; of two that share a place the lower one is kept.
  void take_in(const Eigen::VectorXd& values, Eigen::Index j) {
    const doe::Variable& v = variables_[static_cast<std::size_t>(j)];
    Known& known = known_[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      given_(i, j) = (values[i] - v.lower) / (v.upper - v.lower);
      known.emplace_back(given_(i, j), values[i]);
    }
    std::sort(known.begin(), known.end());
  }

  /// The value given for this place, else the other one.
  double known(double u, Eigen::Index j, double otherwise) const {
    const Known& known = known_[static_cast<std::size_t>(j)];
    const auto at = std::lower_bound(known.begin(), known.end(), u,
                                     [](const auto& entry, double place) { return entry.first < place; });
    return at != known.end() && at->first == u ? at->second : otherwise;
  }

  std::vector<doe::Variable> variables_;
  std::vector<double> steps_;
  Eigen::MatrixXd given_;  // k x d, in the unit box
  std::vector<Known> known_;
};

}  // namespace drawpoint::pareto::detail

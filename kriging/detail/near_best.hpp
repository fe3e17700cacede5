// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A region around the best run, for a search with fewer than ten runs per variable (trust region; Eriksson,
/// Pearce, Gardner, Turner, Poloczek 2019).
///
/// A model that meets the runs of a rugged response swings between them and expects most far from all, in corners or
/// gaps. Half the side of the region is 0.3 of each range, and 0.6 times as much for every six runs since the best
/// one was made.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/doe/seed.hpp>
#include <vector>

namespace drawpoint::kriging::detail {

class NearBest {
 public:
  /// `age`: runs since the best one. The variables outlive this.
  NearBest(const std::vector<doe::Variable>& variables, const Eigen::VectorXd& best, double age)
      : variables_(variables), best_(best), half_(std::max(0.01, 0.3 * std::pow(0.6, age / 6.0))) {}

  bool contains(const Eigen::VectorXd& x) const {
    for (Eigen::Index k = 0; k < x.size(); ++k)
      if (std::abs(x[k] - best_[k]) > reach(k) * (1 + 1e-12)) return false;
    return true;
  }

  /// count x d; equal seeds give equal points.
  Eigen::MatrixXd points(Eigen::Index count, doe::Seed seed) const {
    doe::RandomStream random(seed);
    Eigen::MatrixXd P(count, best_.size());
    for (Eigen::Index i = 0; i < count; ++i)
      for (Eigen::Index k = 0; k < P.cols(); ++k) P(i, k) = coordinate(k, random.uniform());
    return P;
  }

 private:
  const doe::Variable& variable(Eigen::Index k) const { return variables_[static_cast<std::size_t>(k)]; }

  /// Whole numbers may go by one at least, categories anywhere.
  double reach(Eigen::Index k) const {
    const double range = variable(k).upper - variable(k).lower;
    if (variable(k).kind == doe::VariableKind::categorical) return range;
    return variable(k).kind == doe::VariableKind::integer ? std::max(1.0, half_ * range) : half_ * range;
  }

  double coordinate(Eigen::Index k, double u) const {
    const double lower = std::max(variable(k).lower, best_[k] - reach(k)),
                 upper = std::min(variable(k).upper, best_[k] + reach(k));
    if (variable(k).kind == doe::VariableKind::real) return lower + u * (upper - lower);
    const double least = std::ceil(lower), most = std::floor(upper);
    return std::min(most, least + std::floor(u * (most - least + 1.0)));
  }

  const std::vector<doe::Variable>& variables_;
  Eigen::VectorXd best_;
  double half_;
};

}  // namespace drawpoint::kriging::detail

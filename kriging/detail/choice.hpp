// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Which of several maxima a fit takes: the highest, unless leave-one-out speaks clearly for another.
///
/// The highest maximum may be a poor predictor. In a Latin hypercube with its corners half of the runs see
/// the edge of the box alone; a model that fits these very well and the rest badly is likelier than one that
/// predicts well everywhere. Squared leave-one-out errors therefore count by the run's share of the box
/// (box_shares.hpp). From the highest maximum down, another one is taken when its error is
/// below half of the error taken so far: between fits that explain noise more or less closely the ratio is
/// above 0.8, so noise does not decide. Cost: n³/3 a maximum, and 50 n² d for the shares.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <drawpoint/kriging/detail/box_shares.hpp>
#include <drawpoint/kriging/detail/climb.hpp>
#include <drawpoint/kriging/detail/left_out.hpp>
#include <drawpoint/kriging/detail/likelihood.hpp>
#include <limits>
#include <vector>

namespace drawpoint::kriging::detail {

/// A maximum's mean square error below this share of the other's speaks for it.
inline constexpr double clearly_better = 0.5;

/// Σ shareᵢ eᵢ² of the leave-one-out errors of a fit to the rows of X, standardised.
inline double squares_left_out(const Eigen::MatrixXd& L, const LeastSquares& gls, const Eigen::MatrixXd& X,
                               const Eigen::VectorXd& share) {
  const Eigen::VectorXd error = left_out(L, gls, X).error;
  return dot(share, entry_products(error, error));
}

/// The same at p; +∞ where R is singular or the trend rests on one site.
inline double predictive_error(Likelihood& likelihood, const Eigen::VectorXd& p,
                               const Eigen::VectorXd& share) {
  if (!std::isfinite(likelihood.value(p))) return std::numeric_limits<double>::infinity();
  const double sum =
      squares_left_out(likelihood.cholesky(), likelihood.least_squares(), likelihood.problem().X, share);
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;
}

struct Choice {
  std::size_t place = 0;  ///< among the maxima
  double ratio = 1;       ///< its error over that of the highest, as a root mean square
};

/// `ranked`: highest first, the first one finite.
inline Choice chosen(Likelihood& likelihood, const std::vector<Climb>& ranked) {
  const Eigen::VectorXd share = shares_of_box(likelihood.problem().X, likelihood.problem().levels);
  const double highest = predictive_error(likelihood, ranked.front().p(), share);
  Choice choice;
  double least = highest;
  for (std::size_t i = 1; i < ranked.size(); ++i) {
    const double error = predictive_error(likelihood, ranked[i].p(), share);
    if (!(error < clearly_better * least)) continue;
    least = error;
    choice = {i, std::sqrt(error / highest)};
  }
  return choice;
}

}  // namespace drawpoint::kriging::detail

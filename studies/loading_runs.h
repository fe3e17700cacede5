// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The runs of a loading study as its findings look at them: by variable and response, by window of a
/// variable, and those that no other run dominates.

#include <drawpoint/studies/finding_statistics.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace drawpoint::studies {

namespace of_loading {
enum Variable : Eigen::Index { alpha, beta, gamma, kappa };
enum Response : Eigen::Index { production, damage, spill };
}  // namespace of_loading

constexpr double small_correlation = 0.1;  ///< 1 % of the variance of the ranks
constexpr double small_difference =
    0.2;  ///< in standard deviations: a small effect, by Cohen's (1988) convention

/// Training runs; v is a variable, r a response.
class LoadingRuns {
 public:
  explicit LoadingRuns(const StudyResults& results);

  const StudyResults& results() const { return results_; }
  int runs() const { return static_cast<int>(results_.X.rows()); }
  double lower(Eigen::Index v) const { return results_.problem.variables[static_cast<std::size_t>(v)].lower; }
  double upper(Eigen::Index v) const { return results_.problem.variables[static_cast<std::size_t>(v)].upper; }
  /// Where the k-th third of a variable's range ends.
  double third(Eigen::Index v, int k) const { return lower(v) + k * (upper(v) - lower(v)) / 3; }
  Eigen::VectorXd x(Eigen::Index v) const { return results_.X.col(v); }
  Eigen::VectorXd y(Eigen::Index r) const { return results_.Y.col(r); }
  /// Of the runs that no other dominates.
  Eigen::VectorXd front_x(Eigen::Index v) const { return results_.X(front_, v); }
  Eigen::VectorXd front_y(Eigen::Index r) const { return results_.Y(front_, r); }

  /// A response of the runs in which a variable is in [from, to).
  Eigen::VectorXd within(Eigen::Index r, Eigen::Index v, double from, double to) const;
  /// That a response is higher in [from, to) of a variable than below and than above.
  std::vector<Criterion> ridge(Eigen::Index r, Eigen::Index v, double from, double to) const;
  /// That one variable explains more of a response than another. The two shares a and b are taken as
  /// independent, though both are of the same y. For additive effects of independent variables and n runs
  /// their covariance is a b (−2 + 3.5 (a + b) − 1.5 (a² + b²))/n: the error of the difference is up to 3 %
  /// too small for a + b below 0.65, which favours a verdict over "unclear", and too large beyond, which
  /// favours "unclear".
  Criterion explains_more(Eigen::Index r, Eigen::Index more, Eigen::Index less) const;

 private:
  StudyResults results_;
  std::vector<int> front_;
};

}  // namespace drawpoint::studies

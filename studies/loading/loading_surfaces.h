// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the runs of a loading study leave possible of its mean responses: some hundred draws of the three over
/// the whole box (mean_draws.h), at points that fill it evenly, and what the findings ask of each: by variable
/// and response, by window of a variable, and the points that no other dominates. A finding's effect is computed
/// on every draw; how it scatters over the draws is how unsure it is.
///
/// Whether a response depends on the variables: with u_k the draws less their means over the box, of length 1, the
/// squared length of the mean of u_k is the part of them that they agree on. It must be above a half. Of forty runs
/// of pure noise it was 0.2 in the median of 120, in nineteen of twenty below 0.35, and 0.63 once; of runs whose
/// noise is half the deviation of their mean response it was 0.9 in the median of 45, and 0.61 at least.
///
/// Differences are in standard deviations of the mean response over the box. Simplified: the three responses are
/// drawn apart, though their runs err together; and a mean response is a sum of polynomials, so that what is
/// finer than a fifth of a variable's range counts as noise.

#include <drawpoint/studies/loading/statistics/finding_statistics.h>
#include <drawpoint/studies/loading/statistics/mean_draws.h>

#include <Eigen/Core>
#include <array>
#include <functional>
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

/// One draw. v is a variable, r a response.
class LoadingSurface {
 public:
  /// points: m x 4; means: m x 3. Both outlive it, and so does the problem.
  LoadingSurface(const doe::Problem& problem, const Eigen::MatrixXd& points, Eigen::MatrixXd means);

  double lower(Eigen::Index v) const { return problem_->variables[static_cast<std::size_t>(v)].lower; }
  double upper(Eigen::Index v) const { return problem_->variables[static_cast<std::size_t>(v)].upper; }
  /// Where the k-th third of a variable's range ends.
  double third(Eigen::Index v, int k) const { return lower(v) + k * (upper(v) - lower(v)) / 3; }
  Eigen::VectorXd x(Eigen::Index v) const { return points_->col(v); }
  Eigen::VectorXd y(Eigen::Index r) const { return means_.col(r); }
  /// A variable and a response at the points that no other dominates.
  Eigen::VectorXd front_x(Eigen::Index v) const { return (*points_)(front_, v); }
  Eigen::VectorXd front_y(Eigen::Index r) const { return means_(front_, r); }

  /// Mean of a response where a variable is in [from, to), in its deviations over the box.
  double level(Eigen::Index r, Eigen::Index v, double from, double to) const;
  /// Share of a response's variance that a variable explains.
  double explained(Eigen::Index r, Eigen::Index v) const;
  /// Range of a response's means over the thirds of a variable, in deviations over the box.
  double profile_range(Eigen::Index r, Eigen::Index v) const;

 private:
  const doe::Problem* problem_;
  const Eigen::MatrixXd* points_;
  Eigen::MatrixXd means_;
  std::vector<int> front_;
};

class LoadingSurfaces {
 public:
  using Effect = std::function<double(const LoadingSurface&)>;

  /// points: m x 4; draws: m x 3 each.
  LoadingSurfaces(doe::Problem problem, Eigen::MatrixXd points, const std::vector<Eigen::MatrixXd>& draws);
  LoadingSurfaces(const LoadingSurfaces&) = delete;
  LoadingSurfaces& operator=(const LoadingSurfaces&) = delete;

  /// An effect of these responses. It is unknown where the runs do not show that each of them depends on the
  /// variables at all: shares, places and ranks of noise mean nothing.
  Criterion criterion(const std::string& name, const std::vector<Eigen::Index>& responses,
                      const Effect& effect, double least = 0) const;
  /// That a response is higher in [from, to) of a variable than below and than above.
  std::vector<Criterion> ridge(Eigen::Index r, Eigen::Index v, double from, double to) const;
  /// That one variable explains more of a response than another.
  Criterion explains_more(Eigen::Index r, Eigen::Index more, Eigen::Index less) const;

 private:
  doe::Problem problem_;
  Eigen::MatrixXd points_;
  std::vector<LoadingSurface> draws_;
  std::array<double, 3> agreement_ = {};  // per response
};

/// From all runs of the first design and of the validation, of which no model is fitted here that they would
/// check. Noise: of the three responses, from the logs. No draws of fewer than ten runs.
LoadingSurfaces draw_surfaces(const StudyResults& results);

}  // namespace drawpoint::studies

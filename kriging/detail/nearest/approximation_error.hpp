// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What neighbours and neighbourhoods leave out, by the change that twice as many make. Deterministic.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/nearest/conditional.hpp>
#include <drawpoint/kriging/nearest_model.hpp>
#include <map>
#include <vector>

namespace drawpoint::kriging::detail {

/// ln p of a block given its neighbours, without −n_b/2 ln(2π s²). z: y − Fβ.
inline double log_density(const LikelihoodProblem& in, const ModelState& s, const Family& family,
                          const Eigen::MatrixXd& z) {
  const Conditional block(in, s.correlation, s.nugget, family);
  const Eigen::MatrixXd u = block.whitened(z);
  return -block.half_log_determinant() - 0.5 * dot(u, u) / s.process_variance;
}

/// What twice the neighbours add to the log density of some 32 blocks, per run. z: y − Fβ.
inline double log_density_change(const LikelihoodProblem& in, const ModelState& s, const Eigen::VectorXd& z,
                                 Index neighbours) {
  const Cells cells(in.X, s.correlation, runs_of_cell(neighbours));
  const std::vector<Family> own = families_of(in.X, s.correlation, cells, neighbours, in.threads),
                            twice = families_of(in.X, s.correlation, cells, 2 * neighbours, in.threads);
  const std::size_t step = std::max<std::size_t>(own.size() / 32, 1);
  double sum = 0, runs = 0;
  for (std::size_t b = 0; b < own.size(); b += step) {
    sum += log_density(in, s, twice[b], z) - log_density(in, s, own[b], z);
    runs += static_cast<double>(own[b].own);
  }
  return sum / runs;
}

/// Random points of eight cells at most, 16 in each as far as 20 000 draws in the box find them: scaled.
inline Eigen::MatrixXd points_of_cells(const ModelState& s, const Cells& cells) {
  constexpr Index each = 16, chosen = 8, draws = 20000;
  const Index d = s.X.cols(), step = std::max<Index>(cells.count() / chosen, 1);
  doe::RandomStream random(1);
  std::vector<Index> found(static_cast<std::size_t>(cells.count()), 0);
  Eigen::MatrixXd points(each * chosen, d), x(1, d);
  Index size = 0;
  for (Index i = 0; i < draws && size < points.rows(); ++i) {
    for (Index k = 0; k < d; ++k) {
      if (is_category(s.correlation.levels, k))
        x(0, k) = random.below(s.correlation.levels[static_cast<std::size_t>(k)]);
      else
        x(0, k) = s.input.factor[k] > 0 ? 2.0 * random.uniform() - 1.0 : 0.0;  // 0: it never varies
    }
    const int cell = cells.at(x, 0);
    if (cell % step != 0 || ++found[static_cast<std::size_t>(cell)] > each) continue;
    points.row(size++) = x;
  }
  return points.topRows(size);
}

/// Natural units of scaled points; an input that never varies keeps its value.
inline Eigen::MatrixXd natural_points(const InputScale& input, Eigen::MatrixXd X) {
  for (Index k = 0; k < X.cols(); ++k)
    for (Index i = 0; i < X.rows(); ++i)
      X(i, k) = input.centre[k] + (input.factor[k] > 0 ? X(i, k) / input.factor[k] : 0.0);
  return X;
}

/// What is predicted at points of one cell, standardised: the part of the mean beside the trend, and the
/// variance in units of s².
struct LocalPrediction {
  Eigen::VectorXd mean, variance;
};

/// points: m x d, scaled; whitened: F T⁻¹ of all runs; residual: y − Fβ.
inline LocalPrediction predict_locally(const ModelState& s, const std::vector<int>& rows,
                                       const Eigen::MatrixXd& points, const Eigen::MatrixXd& whitened,
                                       const Eigen::VectorXd& residual) {
  const LocalRuns runs(s, rows, &whitened);
  const Eigen::MatrixXd C = cross_correlation(runs.X, points, s.correlation);
  const Eigen::MatrixXd F = trend_matrix(s.trend, natural_points(s.input, points), points, s.input);
  return {transposed_product(C, runs.factor->weights(residual)),
          runs.relative_variance(C, whitened_trend(s, F))};
}

/// Root mean squares of the change of the mean by neighbourhoods of twice the runs, and of the deviation.
inline void add_prediction_change(const ModelState& s, const Eigen::VectorXd& residual, Index neighbourhood,
                                  NearestError& error) {
  const Cells cells(s.X, s.correlation, runs_of_cell(neighbourhood));
  const Eigen::MatrixXd points = points_of_cells(s, cells), whitened = whitened_trend(s, s.F);
  std::map<int, std::vector<Index>> by_cell;
  for (Index i = 0; i < points.rows(); ++i) by_cell[cells.at(points, i)].push_back(i);
  double change = 0, variance = 0;
  for (const auto& entry : by_cell) {
    const std::vector<Index>& rows = entry.second;
    const auto with = [&](Index size) {
      return predict_locally(s, neighbourhood_of(s.X, s.correlation, cells.runs(entry.first), size),
                             rows_of(points, rows), whitened, residual);
    };
    const LocalPrediction own = with(neighbourhood), twice = with(2 * neighbourhood);
    change += square(difference(own.mean, twice.mean));
    variance += s.process_variance * mean_of(own.variance) * static_cast<double>(rows.size());
  }
  const double count = std::max(static_cast<double>(points.rows()), 1.0);
  error.mean = s.y_scale * std::sqrt(change / count);
  error.deviation = s.y_scale * std::sqrt(variance / count);
}

}  // namespace drawpoint::kriging::detail

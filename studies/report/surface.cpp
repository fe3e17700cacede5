// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/doe/uniform.hpp>
#include <drawpoint/kriging/correlation.hpp>
#include <drawpoint/studies/report/surface.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <set>
#include <vector>

namespace drawpoint::studies::detail {

namespace {

// The correlation matrix of a smooth surrogate is singular to round-off; this keeps its factor positive and
// changes the means by far less than can be seen.
constexpr double jitter = 1e-11;
constexpr int probes = 64;
constexpr double tolerance = 1e-3;  // of the range of the means

/// The rows of X, each once: replicates repeat points.
Eigen::MatrixXd distinct(const Eigen::MatrixXd& X) {
  std::set<std::vector<double>> seen;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    const Eigen::VectorXd row = X.row(i);
    if (seen.insert({row.begin(), row.end()}).second) rows.push_back(i);
  }
  return X(rows, Eigen::all);
}

/// A variable without a range cannot be scaled; all its values go to 0.
Eigen::MatrixXd scaled(const Eigen::MatrixXd& X, const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::ArrayXd range = upper - lower;
  const Eigen::VectorXd factor = (range > 0.0).select(2.0 / range, 0.0);
  return (X.rowwise() - 0.5 * (lower + upper).transpose()) * factor.asDiagonal();
}

Surface solved(const kriging::Model& model, const Eigen::MatrixXd& X, const Eigen::VectorXd& lower,
               const Eigen::VectorXd& upper) {
  Surface s{lower, upper, scaled(X, lower, upper), {}};
  Eigen::MatrixXd C = kriging::cross_correlation(s.X, s.X, model.theta());
  C.diagonal().array() += jitter;
  s.weights = C.ldlt().solve((model.mean(X).array() - model.trend()).matrix());
  return s;
}

/// Largest difference from the model at the probes, as a share of the range of the means.
double error(const Surface& s, const kriging::Model& model, const Eigen::MatrixXd& points,
             const Eigen::MatrixXd& X) {
  const Eigen::MatrixXd C = kriging::cross_correlation(s.X, scaled(points, s.lower, s.upper), model.theta());
  const Eigen::VectorXd mean = (C.transpose() * s.weights).array() + model.trend();
  const Eigen::VectorXd wanted = model.mean(points), at_runs = model.mean(X);
  const double high = std::max(wanted.maxCoeff(), at_runs.maxCoeff());
  const double low = std::min(wanted.minCoeff(), at_runs.minCoeff());
  const double difference = (mean - wanted).cwiseAbs().maxCoeff();
  return high > low ? difference / (high - low) : difference;
}

}  // namespace

std::optional<Surface> surface(const kriging::Model& model, const doe::Problem& problem,
                               const Eigen::MatrixXd& X) {
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  Eigen::VectorXd lower(d), upper(d);
  for (Eigen::Index k = 0; k < d; ++k) {
    lower[k] = problem.variables[static_cast<std::size_t>(k)].lower;
    upper[k] = problem.variables[static_cast<std::size_t>(k)].upper;
  }
  const Eigen::MatrixXd points = doe::uniform_random(problem, probes), runs = distinct(X);
  const Surface of_box = solved(model, runs, lower, upper);
  if (error(of_box, model, points, X) < tolerance) return of_box;
  const Surface of_data = solved(model, runs, X.colwise().minCoeff(), X.colwise().maxCoeff());
  if (error(of_data, model, points, X) < tolerance) return of_data;
  return std::nullopt;
}

Eigen::VectorXd influence(const kriging::Model& model, const doe::Problem& problem) {
  constexpr int samples = 512;
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const Eigen::MatrixXd A = doe::uniform_random(problem, samples, 1),
                        B = doe::uniform_random(problem, samples, 2);
  const Eigen::VectorXd at_a = model.mean(A), at_b = model.mean(B);
  const double centre = 0.5 * (at_a.mean() + at_b.mean());
  const double variance =
      ((at_a.array() - centre).square().sum() + (at_b.array() - centre).square().sum()) / (2.0 * samples);
  Eigen::VectorXd total = Eigen::VectorXd::Zero(d);
  if (!(variance > 0.0)) return total;
  for (Eigen::Index k = 0; k < d; ++k) {
    Eigen::MatrixXd mixed = A;
    mixed.col(k) = B.col(k);
    total[k] = (at_a - model.mean(mixed)).squaredNorm() / (2.0 * samples * variance);
  }
  return total;
}

}  // namespace drawpoint::studies::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Draws of the latent function at m points at once, as the model believes it to be.
///
/// path = ŷ + C^½ z with C the joint covariance, C^½ its symmetric root and z standard normal. C of points at
/// or near runs is singular, where a Cholesky factor fails; its eigenvalues below 0 are round-off and are set
/// to 0. Deterministic in the seed. Cost m n² + m² n + about 10 m³. Draws of several responses whose models
/// err together: error_correlation.hpp.

#include <Eigen/Core>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/detail/symmetric_root.hpp>
#include <drawpoint/kriging/model.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::kriging {

struct SamplePathsOptions {
  doe::Seed seed = 1;
};

namespace detail {

inline Eigen::MatrixXd standard_normals(Eigen::Index rows, Eigen::Index count, doe::Seed seed) {
  doe::RandomStream random(seed);
  Eigen::MatrixXd Z(rows, count);
  for (auto column : Z.colwise())
    for (double& z : column) z = random.normal();
  return Z;
}

}  // namespace detail

/// X: m x d, natural units; normals: m x count, the z of `count` paths. Gives m x count, one path per column,
/// unit of y. Throws std::invalid_argument for another number of rows and for models of infinite variance, and
/// as Model::predict.
inline Eigen::MatrixXd sample_paths(const Model& model, const Eigen::MatrixXd& X,
                                    const Eigen::MatrixXd& normals) {
  if (normals.rows() != X.rows())
    throw std::invalid_argument("kriging::sample_paths: there are " + std::to_string(normals.rows()) +
                                " rows of normal numbers for " + std::to_string(X.rows()) +
                                " points; give one row per point");
  const Eigen::MatrixXd covariance = model.covariance(X);
  if (!covariance.allFinite())
    throw std::invalid_argument(
        "kriging::sample_paths: the model of one run has infinite variance; allowed are models of "
        "two runs or more; fit more runs");
  return (detail::symmetric_root(covariance) * normals).colwise() + model.mean(X);
}

/// The same with `count` paths, 1 or more, of a seed.
inline Eigen::MatrixXd sample_paths(const Model& model, const Eigen::MatrixXd& X, int count,
                                    const SamplePathsOptions& options = {}) {
  if (count < 1)
    throw std::invalid_argument("kriging::sample_paths: count is " + std::to_string(count) +
                                "; allowed is 1 or more; ask for one path or more");
  return sample_paths(model, X, detail::standard_normals(X.rows(), count, options.seed));
}

}  // namespace drawpoint::kriging

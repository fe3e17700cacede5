// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Draws of the latent function at m points at once, as the model believes it to be.
///
/// path = ŷ + V √D z with V D Vᵀ the joint covariance and z standard normal. The covariance of points at or
/// near runs is singular, where a Cholesky factor fails; its eigenvalues below 0 are round-off and are set to
/// 0. Deterministic in the seed. Cost m n² + m² n + about 10 m³.

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <drawpoint/doe/seed.hpp>
#include <drawpoint/kriging/model.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::kriging {

struct SamplePathsOptions {
  doe::Seed seed = 1;
};

/// X: m x d, natural units. Gives m x count, one path a column, unit of y. Throws std::invalid_argument for
/// count < 1 and for models of infinite variance, and as Model::predict.
inline Eigen::MatrixXd sample_paths(const Model& model, const Eigen::MatrixXd& X, int count,
                                    const SamplePathsOptions& options = {}) {
  if (count < 1)
    throw std::invalid_argument("kriging::sample_paths: count is " + std::to_string(count) +
                                "; allowed is 1 or more; ask for one path or more");
  const Eigen::MatrixXd covariance = model.covariance(X);
  if (!covariance.allFinite())
    throw std::invalid_argument(
        "kriging::sample_paths: the model of one run has infinite variance; allowed are models of "
        "two runs or more; fit more runs");
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  const Eigen::VectorXd deviation = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  doe::RandomStream random(options.seed);
  Eigen::MatrixXd Z(X.rows(), count);
  for (auto column : Z.colwise())
    for (double& z : column) z = random.normal();
  return (eigen.eigenvectors() * (deviation.asDiagonal() * Z)).colwise() + model.mean(X);
}

}  // namespace drawpoint::kriging

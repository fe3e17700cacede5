// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

namespace drawpoint::kriging::detail {

/// V √D Vᵀ for a symmetric V D Vᵀ. Eigenvalues below 0 are taken for round-off, and for 0. About 10 m³.
inline Eigen::MatrixXd symmetric_root(const Eigen::MatrixXd& C) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(C);
  const Eigen::VectorXd deviation = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return eigen.eigenvectors() * deviation.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace drawpoint::kriging::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/statistics/cycle_scatter.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

namespace drawpoint::studies {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void CycleScatter::add(const std::vector<int>& numbers, const std::vector<double>& values) {
  const auto n = static_cast<Index>(values.size());
  if (n < 2) return;
  const Eigen::Map<const VectorXd> y(values.data(), n);
  MatrixXd centring = MatrixXd::Identity(n, n).array() - 1.0 / static_cast<double>(n);
  MatrixXd indicator = MatrixXd::Zero(n, *std::max_element(numbers.begin(), numbers.end()) + 1);
  for (Index i = 0; i < n; ++i) indicator(i, numbers[static_cast<std::size_t>(i)]) = 1;
  const MatrixXd F = centring * indicator;
  const VectorXd deviations = centring * y;
  if (F.cols() > information_.cols()) {
    information_.conservativeResizeLike(MatrixXd::Zero(F.cols(), F.cols()));
    right_.conservativeResizeLike(VectorXd::Zero(F.cols()));
  }
  information_.topLeftCorner(F.cols(), F.cols()) += F.transpose() * F;
  right_.head(F.cols()) += F.transpose() * deviations;
  squares_ += deviations.squaredNorm();
  within_ += static_cast<int>(n) - 1;
}

int CycleScatter::degrees() const {
  if (within_ == 0) return 0;
  return within_ - static_cast<int>(information_.completeOrthogonalDecomposition().rank());
}

double CycleScatter::variance() const {
  const int freedoms = degrees();
  if (freedoms < 1) return std::numeric_limits<double>::quiet_NaN();
  const VectorXd effects = information_.completeOrthogonalDecomposition().solve(right_);
  return std::max(squares_ - right_.dot(effects), 0.0) / freedoms;
}

}  // namespace drawpoint::studies

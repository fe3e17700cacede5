// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What tells that a stored model is the one that was stored (save.hpp), apart from the format, and how its
/// factor is stored: the lower triangle by columns.

#include <Eigen/Core>
#include <drawpoint/doe/detail/hash.hpp>

namespace drawpoint::kriging::detail {

using doe::detail::checksum;

/// n(n + 1)/2 numbers.
inline Eigen::VectorXd packed_lower(const Eigen::MatrixXd& L) {
  const Eigen::Index n = L.rows();
  Eigen::VectorXd values(n * (n + 1) / 2);
  for (Eigen::Index j = 0, k = 0; j < n; k += n - j, ++j) values.segment(k, n - j) = L.col(j).tail(n - j);
  return values;
}

inline Eigen::MatrixXd unpacked_lower(const Eigen::VectorXd& values, Eigen::Index n) {
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0, k = 0; j < n; k += n - j, ++j) L.col(j).tail(n - j) = values.segment(k, n - j);
  return L;
}

}  // namespace drawpoint::kriging::detail

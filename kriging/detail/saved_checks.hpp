// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What tells that a stored model is the one that was stored (save.hpp), apart from the format, and how its
/// factor is stored: the lower triangle by columns.

#include <Eigen/Core>
#include <cstdint>
#include <cstdio>
#include <string>

namespace drawpoint::kriging::detail {

/// 64-bit FNV-1a as 16 hexadecimal digits: any change of one byte changes it.
inline std::string checksum(const std::string& text) {
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const unsigned char c : text) hash = (hash ^ c) * 0x100000001B3ULL;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

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

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far two points of a problem are apart, and when they are one strategy.

#include <drawpoint/doe/problem.hpp>

#include <Eigen/Core>

namespace drawpoint::studies {
namespace detail {

/// Between two points: the largest difference in one variable, as a share of its range.
double largest_difference(const doe::Problem& problem, const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace detail

/// Two points are the same strategy when they differ by at most this share of the range in every variable.
inline constexpr double same_place = 0.02;

bool is_same_place(const doe::Problem& problem, const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace drawpoint::studies

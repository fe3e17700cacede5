// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Points that the user types.

#include <drawpoint/doe/problem.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// What is typed for the variable: a number, or the name of a level; NaN for what is neither.
double typed_value(const doe::Variable& variable, const std::string& text);

/// One or more points, one after the other in `x`, as rows. Throws UsageError for a wrong number of values, for what is
/// no value of its variable and for a value out of its range.
Eigen::MatrixXd checked_points(const doe::Problem& problem, const std::vector<std::string>& x);

/// A point as it would be typed.
std::vector<std::string> typed(const Eigen::VectorXd& point);

/// "alpha=1,rock=ore": every variable once, a level by its name or number. Throws UsageError that begins with the
/// option and says which variables there are.
Eigen::VectorXd point_named(const doe::Problem& problem, const std::string& option, const std::string& text);

}  // namespace drawpoint::studies

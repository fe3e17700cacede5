// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Numbers, names and points as words for the report's sentences.

#include <drawpoint/doe/problem.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace drawpoint::studies::detail {

/// Three significant digits without an exponent between 1e-4 and 1e6: "412", "0.0746"; "n/a" when not finite.
std::string number(double value);

std::string number_with_unit(double value, const std::string& unit);
std::string percent(double share);
std::string pretty(const std::string& name);                             ///< underscores become spaces
std::string counted(std::size_t count, const std::string& thing);        ///< "1 run", "2 runs"
std::string listed(const std::vector<std::string>& items);               ///< "a, b and c"
std::string labelled(const std::string& name, const std::string& unit);  ///< "lip [m]", "fill"

std::string superlative(const doe::Response& objective);  ///< "highest" or "lowest" is best

/// The value of a variable as text, without its unit: "1.2", "3", "ore"; "0" if nearer to 0 than 1e-4 of the range.
std::string setting(const doe::Variable& variable, double x);

/// "alpha = 1.2, bolts = 3, rock = ore".
std::string point_text(const doe::Problem& problem, const Eigen::VectorXd& x);

}  // namespace drawpoint::studies::detail

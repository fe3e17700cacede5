// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The report in words: the figures that matter, sentences, how far to trust each surrogate, and cautions.
///
/// Cautions are raised for failed runs, a poor surrogate (trust.h), fewer than 10 validation points, error bars
/// that are too narrow (fewer than 3 in 4 validation points within their 95 % interval), and a predicted best
/// beyond everything simulated.

#include <drawpoint/studies/report/report.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies::detail {

/// Validation runs, below which errors are rough.
inline constexpr Eigen::Index enough_points = 10;

/// Row of the front nearest to the ideal point, each objective scaled to its range on the front; -1 without a
/// front.
Eigen::Index balanced_point(const doe::Problem& problem, const pareto::Front& front);

/// Between two points: the largest difference in one variable, as a share of its range.
double largest_difference(const doe::Problem& problem, const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Places in Problem::responses of the objectives, the order of the front's columns.
std::vector<std::size_t> objectives(const doe::Problem& problem);

/// Why to be careful, in sentences, the warnings first.
std::vector<std::string> cautions(const ReportInput& input);

/// {cards, sentences, trust, cautions, next: [{text, command}]}. influence: one vector per model, as many as
/// input.models.
nlohmann::json summary(const ReportInput& input, const std::vector<Eigen::VectorXd>& influence);

}  // namespace drawpoint::studies::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sixteen findings of Lindmark (2016) on loading strategies, F1 to F16, held against the runs of a
/// study.
///
/// Each is turned into effects that must be above 0, estimated from the runs with standard errors
/// (finding_statistics.h), (but for F15, the models' errors): differences of group means, rank correlations,
/// shares of variance. What is said of the Pareto front is held against the runs that no other run dominates;
/// noise puts some there by luck, which blurs these findings. Of sixteen findings that were all decided by
/// chance, every third study would call one reproduced: 1 − (1 − 0.023)¹⁶.

#include <drawpoint/studies/finding.hpp>

#include <vector>

namespace drawpoint::studies {

/// In order. The problem's variables are alpha, beta, gamma, kappa, its responses production, joint damage,
/// rock spill. F14 reads the logs; it skips those that cannot be read or lack what tracking takes (of older
/// versions), and its grounds say how many and why the first; with fewer than five left it is unclear. Throws
/// std::invalid_argument for another number of variables or responses.
std::vector<Finding> loading_findings(const StudyResults& results);

/// F14 alone, from what the logs say of each run: root mean square distance of the tip from its plan [m],
/// planned depth [m], and beta.
Finding tracking_finding(const Eigen::VectorXd& error, const Eigen::VectorXd& depth,
                         const Eigen::VectorXd& beta);

}  // namespace drawpoint::studies

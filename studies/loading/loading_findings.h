// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The sixteen findings of Lindmark (2016) on loading strategies, F1 to F16, held against the runs of a
/// study.
///
/// Each is turned into effects that must be above 0. F1 to F13 are about the mean responses, and their effects
/// are read off draws of these over the box (loading_surfaces.h), which all cycles of all runs share in;
/// F14 to F16 are about the runs themselves and the models' errors (loading_run_findings.h). Of sixteen findings
/// that were all decided by chance, every third study would call one reproduced: 1 − (1 − 0.023)¹⁶.

#include <drawpoint/studies/finding.hpp>

#include <vector>

namespace drawpoint::studies {

/// In order. The problem's variables are alpha, beta, gamma, kappa, its responses production, joint damage,
/// rock spill. F14 reads the logs; it skips those that cannot be read or lack what tracking takes (of older
/// versions), and its grounds say how many and why the first; with fewer than five left it is unclear. Throws
/// std::invalid_argument for another number of variables or responses.
std::vector<Finding> loading_findings(const StudyResults& results);

}  // namespace drawpoint::studies

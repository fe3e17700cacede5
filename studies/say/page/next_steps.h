// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What to do next with a study, by what its runs, models and simulated points say; most needed first.

#include <drawpoint/studies/say/page/report.h>

#include <string>
#include <vector>

namespace drawpoint::studies::detail {

struct NextStep {
  std::string text;     ///< a sentence
  std::string command;  ///< that does it, without the program; empty: none does
};

/// Three at most; none for a study without objectives. In this order: runs that failed, errors that can be
/// known, models that can be relied on, a front that has been simulated; where the last three stand, the
/// choice.
std::vector<NextStep> next_steps(const ReportInput& input);

}  // namespace drawpoint::studies::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What Lindmark (2016) says of runs and models rather than of the mean responses: how well plans are tracked
/// (F14, from the logs), how well the models predict (F15), how the runs fill the box (F16).

#include <drawpoint/studies/finding.hpp>

namespace drawpoint::studies {

struct RunFindings {
  Finding f14, f15, f16;
};

RunFindings run_findings(const StudyResults& results);

/// F14 alone, from what the logs say of each run: root mean square distance of the tip from its plan [m],
/// planned depth [m], and beta.
Finding tracking_finding(const Eigen::VectorXd& error, const Eigen::VectorXd& depth,
                         const Eigen::VectorXd& beta);

}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Why to be careful with a report.
///
/// Cautions are raised for failed runs, a poor surrogate (model/trust.h), fewer than 10 validation points, error bars
/// that are too narrow (fewer than 3 in 4 validation points within their 95 % interval), and a predicted best
/// beyond everything simulated.

#include <drawpoint/studies/say/page/report.h>

#include <string>
#include <vector>

namespace drawpoint::studies::detail {

/// Why to be careful, in sentences, the warnings first.
std::vector<std::string> cautions(const ReportInput& input);

}  // namespace drawpoint::studies::detail

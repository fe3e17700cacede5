// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The report in words: the figures that matter, sentences, how far to trust each surrogate, and cautions.

#include <drawpoint/studies/say/page/report.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace drawpoint::studies::detail {

/// {cards, sentences, trust, cautions, next: [{text, command}]}. influence: one vector per model, as many as
/// input.models.
nlohmann::json summary(const ReportInput& input, const std::vector<Eigen::VectorXd>& influence);

}  // namespace drawpoint::studies::detail

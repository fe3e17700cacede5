// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How far to trust each surrogate, by the error of the mean over the range (kriging/mean_error.hpp): up to 0.1
/// good where its interval ends at 0.2 at most, up to 0.2 fair, above poor, without validation runs unknown;
/// flat where the surrogate shows no difference. All are of an input with mean errors.

#include <drawpoint/studies/say/page/report.h>

#include <nlohmann/json.hpp>
#include <string>

namespace drawpoint::studies::detail {

/// [{response, grade, text}] of the responses that are no standard errors.
nlohmann::json trust(const ReportInput& input);

/// "12 % of the range seen (8 % to 19 %)".
std::string share_text(const kriging::MeanError& error);

}  // namespace drawpoint::studies::detail

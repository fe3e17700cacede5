// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// All that the page shows, as one JSON object; say/page/web/main.js and the files it imports read it.

#include <drawpoint/studies/say/page/report.h>

#include <nlohmann/json.hpp>

namespace drawpoint::studies::detail {

/// With the descriptions, which are no part of a problem's identity.
nlohmann::json described(const doe::Problem& problem);

/// Throws std::invalid_argument when the parts of the input do not belong together.
nlohmann::json report_data(const ReportInput& input);

}  // namespace drawpoint::studies::detail

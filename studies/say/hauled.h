// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What other hauls would change in a study whose runs tell their cycles (Logs::cycles).

#include <drawpoint/studies/run/store/folder.h>
#include <drawpoint/studies/run/store/store.h>
#include <drawpoint/studies/say/page/report.h>
#include <drawpoint/studies/study.hpp>

#include <vector>

namespace drawpoint::studies {

/// Fills ReportInput::hauls from the logs of these runs. A run whose cycles do not give its stored response to a
/// millionth is left out with a warning, and so is one whose log cannot be read.
void add_hauls(ReportInput& input, const Study& study, const std::vector<const Run*>& logged,
               const OptionValues& options, const Folder& folder);

}  // namespace drawpoint::studies

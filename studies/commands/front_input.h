// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/studies/run/settings.h>
#include <drawpoint/studies/say/report_input.h>
#include <drawpoint/studies/study.hpp>

#include <string>

namespace drawpoint::studies {

/// Reads the folder of the settings, with models and a front. Throws std::runtime_error that begins with the command
/// and says what to do where it has none.
ReportInput input_with_front(const Study& study, const Settings& settings, const std::string& command);

}  // namespace drawpoint::studies

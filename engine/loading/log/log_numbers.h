// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// What the single numbers of a run log are (LoadingLog::numbers), for people who open the file in another
/// program.
namespace drawpoint::engine::loading {

struct LogNumber {
  const char *unit, *description;
};

/// Null for a number that no run of this version logs.
const LogNumber* log_number(const std::string& name);

}  // namespace drawpoint::engine::loading

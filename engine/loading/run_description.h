// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/site.hpp>

namespace drawpoint::engine::loading {

/// What a run was made with, into the log: every number and choice of its scenario, the machine's volumes, the pile.
void describe(const Scenario& scenario, const Site& site, LoadingLog& log);

}  // namespace drawpoint::engine::loading

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the report says about how its numbers came about: machine, versions, time, design.

#include <drawpoint/studies/run/store/store.h>

#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {

/// (label, value) in the order to show.
std::vector<std::pair<std::string, std::string>> facts(const Study& study, const Store& store,
                                                       const std::vector<Run>& runs);

/// What the runs are made with: a row of the options with their values, one of the simulator; none that is empty.
void add_options(const Identity& identity, std::vector<std::pair<std::string, std::string>>& all);

}  // namespace drawpoint::studies

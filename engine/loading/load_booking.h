// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/site.hpp>
#include <vector>

/// What a cycle loaded: what the bucket carries. What hangs on the rest of the machine is taken away with it.
namespace drawpoint::engine::loading {

/// By rock: whether it lies in front of the pile. `model` is that of the rocks that count.
std::vector<bool> rocks_in_front(const Site& site, const ColumnModel& model);

/// Writes the masses into the record and takes the load away; `model` is that of the rocks outside the bucket.
/// Returns the mass taken off the rest of the machine [kg].
double book_load(Site& site, const ColumnModel& model, CycleRecord& record);

}  // namespace drawpoint::engine::loading

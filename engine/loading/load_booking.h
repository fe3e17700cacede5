// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/site.hpp>
#include <vector>

/// What a cycle loaded and what it left before the pile.
///
/// What the bucket carries is loaded. Rock before the pile counts as spilled if it did not lie there before the run;
/// what hangs on the rest of the machine counts so too, and is taken away with it.
namespace drawpoint::engine::loading {

/// By rock: whether it lies in front of the pile. `model` is that of the rocks that count.
std::vector<bool> rocks_in_front(const Site& site, const ColumnModel& model);

/// Writes the masses into the record and takes the load away; `model` is that of the rocks outside the bucket. Returns
/// the mass taken off the rest of the machine [kg].
double book_load(Site& site, const ColumnModel& model, const std::vector<bool>& in_front_before,
                 CycleRecord& record);

}  // namespace drawpoint::engine::loading

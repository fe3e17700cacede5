// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/loading/log/loading_log.hpp>
#include <drawpoint/engine/loading/site.hpp>
#include <vector>

/// What a cycle loaded and what it left before the pile.
///
/// What the bucket carries is loaded. Rock before the pile counts as spilled if it did not lie there before the
/// run; what hangs on the rest of the machine counts so too, and is taken away with it. Spill that is taken away,
/// so or out of the machine's way, counts on after all later cycles, as if it had been pushed to the wall.
namespace drawpoint::engine::loading {

/// By rock: whether it lies in front of the pile. `model` is that of the rocks that count.
std::vector<bool> rocks_in_front(const Site& site, const ColumnModel& model);

/// Of a run.
struct Spill {
  std::vector<bool> in_front_before = {};  ///< rocks_in_front() before the machine first came
  double cleared = 0;                      ///< [kg]

  bool spilled(std::size_t rock, const std::vector<bool>& in_front) const;
  /// These rocks are taken away, which lay so.
  void clear(const Site& site, const std::vector<bool>& in_front, const std::vector<int>& rocks);
};

/// Writes the masses into the record and takes the load away; `model` is that of the rocks outside the bucket.
/// Returns the mass taken off the rest of the machine [kg].
double book_load(Site& site, const ColumnModel& model, Spill& spill, CycleRecord& record);

}  // namespace drawpoint::engine::loading

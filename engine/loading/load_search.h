// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/contacts.hpp>
#include <vector>

/// Which rocks hang together by their contacts, starting from a rock or from a part of the machine, and touch
/// nothing that is fixed: what a bucket carries, heaped higher than its profile or over its sides as well.
namespace drawpoint::engine::loading {

class LoadSearch {
 public:
  /// Looks at the rocks that are `allowed`, by number; `forces` are those of the last step.
  LoadSearch(std::vector<bool> allowed, const std::vector<engine::PairForce>& forces);

  /// Adds the rock, and all that hang together with it, unless they have been taken before. The rock itself may touch
  /// what is fixed.
  void take(int rock, std::vector<int>& taken);
  /// Adds all rocks that touch the part, with those that hang together with them.
  void take_on(int part, std::vector<int>& taken);

 private:
  std::vector<bool> open_;  // by rock: allowed and not taken
  std::vector<bool> grounded_;
  std::vector<std::vector<int>> neighbours_;        // by rock
  std::vector<std::pair<int, int>> part_and_rock_;  // that touch
};

}  // namespace drawpoint::engine::loading

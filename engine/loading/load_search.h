// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/engine/world/contacts.hpp>
#include <utility>
#include <vector>

/// What a machine carries: rocks that hang together with a part of it by their contacts and not with the ground.
///
/// The ground's are the rocks that touch what is fixed, and all that hang together with these except through a
/// named rock: rubble that leans on the bucket or on its load is not taken, nor what lies on such rubble.
namespace drawpoint::engine::loading {

class LoadSearch {
 public:
  /// Looks at the rocks that are `allowed`, by number; `named` ones are carried whatever they touch; `forces` are
  /// those of the last step.
  LoadSearch(std::vector<bool> allowed, const std::vector<int>& named,
             const std::vector<engine::PairForce>& forces);

  /// Adds the rock, and all that hang together with it, unless they have been taken before or are the ground's.
  void take(int rock, std::vector<int>& taken);
  /// Adds all rocks that touch the part, with those that hang together with them.
  void take_on(int part, std::vector<int>& taken);

 private:
  void ground(const std::vector<int>& touching, const std::vector<int>& named);

  std::vector<bool> open_;                          // by rock: allowed and not taken
  std::vector<bool> grounded_;                      // the ground's
  std::vector<std::vector<int>> neighbours_;        // by rock
  std::vector<std::pair<int, int>> part_and_rock_;  // that touch
};

}  // namespace drawpoint::engine::loading

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/load_search.h>

#include <utility>

namespace drawpoint::engine::loading {

using engine::Owner;

LoadSearch::LoadSearch(std::vector<bool> allowed, const std::vector<engine::PairForce>& forces)
    : open_(std::move(allowed)), grounded_(open_.size()), neighbours_(open_.size()) {
  const auto note = [&](const engine::SurfaceOwner& rock, const engine::SurfaceOwner& other) {
    if (rock.owner != Owner::rock) return;
    const auto k = static_cast<std::size_t>(rock.index);
    if (other.owner == Owner::rock) {
      neighbours_[k].push_back(other.index);
    } else if (other.owner == Owner::part) {
      part_and_rock_.emplace_back(other.index, rock.index);
    } else {
      grounded_[k] = true;
    }
  };
  for (const engine::PairForce& pair : forces) {
    if (pair.force.isZero()) continue;
    note(pair.a, pair.b);
    note(pair.b, pair.a);
  }
}

void LoadSearch::take(int rock, std::vector<int>& taken) {
  const auto add = [&](int k) {
    if (!open_[static_cast<std::size_t>(k)]) return;
    open_[static_cast<std::size_t>(k)] = false;
    taken.push_back(k);
  };
  std::size_t next = taken.size();
  add(rock);
  for (; next < taken.size(); ++next)
    for (int other : neighbours_[static_cast<std::size_t>(taken[next])])
      if (!grounded_[static_cast<std::size_t>(other)]) add(other);
}

void LoadSearch::take_on(int part, std::vector<int>& taken) {
  for (const auto& [touching, rock] : part_and_rock_)
    if (touching == part && !grounded_[static_cast<std::size_t>(rock)]) take(rock, taken);
}

}  // namespace drawpoint::engine::loading

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/load_search.h>

namespace drawpoint::engine::loading {

using engine::Owner;

LoadSearch::LoadSearch(std::vector<bool> allowed, const std::vector<int>& named,
                       const std::vector<engine::PairForce>& forces)
    : open_(std::move(allowed)), grounded_(open_.size()), neighbours_(open_.size()) {
  std::vector<int> touching;
  const auto note = [&](const engine::SurfaceOwner& rock, const engine::SurfaceOwner& other) {
    if (rock.owner != Owner::rock) return;
    if (other.owner == Owner::rock) {
      neighbours_[static_cast<std::size_t>(rock.index)].push_back(other.index);
    } else if (other.owner == Owner::part) {
      part_and_rock_.emplace_back(other.index, rock.index);
    } else {
      touching.push_back(rock.index);
    }
  };
  for (const engine::PairForce& pair : forces) {
    if (pair.force.isZero()) continue;
    note(pair.a, pair.b);
    note(pair.b, pair.a);
  }
  ground(touching, named);
}

void LoadSearch::ground(const std::vector<int>& touching, const std::vector<int>& named) {
  std::vector<bool> passed(grounded_.size());
  for (int rock : named) passed[static_cast<std::size_t>(rock)] = true;
  std::vector<int> found;
  const auto add = [&](int rock) {
    const auto k = static_cast<std::size_t>(rock);
    if (passed[k]) return;
    passed[k] = grounded_[k] = true;
    found.push_back(rock);
  };
  for (int rock : touching) add(rock);
  for (std::size_t next = 0; next < found.size(); ++next)
    for (int other : neighbours_[static_cast<std::size_t>(found[next])]) add(other);
}

void LoadSearch::take(int rock, std::vector<int>& taken) {
  const auto add = [&](int other) {
    const auto k = static_cast<std::size_t>(other);
    if (!open_[k] || grounded_[k]) return;
    open_[k] = false;
    taken.push_back(other);
  };
  std::size_t next = taken.size();
  add(rock);
  for (; next < taken.size(); ++next)
    for (int other : neighbours_[static_cast<std::size_t>(taken[next])]) add(other);
}

void LoadSearch::take_on(int part, std::vector<int>& taken) {
  for (const auto& [touching, rock] : part_and_rock_)
    if (touching == part) take(rock, taken);
}

}  // namespace drawpoint::engine::loading

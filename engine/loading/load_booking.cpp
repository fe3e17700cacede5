// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/load_booking.h>

namespace drawpoint::engine::loading {

std::vector<bool> rocks_in_front(const Site& site, const ColumnModel& model) {
  std::vector<bool> in_front;
  for (const engine::Rock& rock : site.world().rocks())
    in_front.push_back(rock.present && lies_in_front(model, rock.pose.translation()));
  return in_front;
}

bool Spill::spilled(std::size_t rock, const std::vector<bool>& in_front) const {
  return in_front[rock] && (rock >= in_front_before.size() || !in_front_before[rock]);
}

void Spill::clear(const Site& site, const std::vector<bool>& in_front, const std::vector<int>& rocks) {
  for (const int rock : rocks)
    if (spilled(static_cast<std::size_t>(rock), in_front)) cleared += site.mass_of({rock});
}

double book_load(Site& site, const ColumnModel& model, Spill& spill, CycleRecord& record) {
  const std::vector<engine::Rock>& rocks = site.world().rocks();
  std::vector<bool> in_front = rocks_in_front(site, model);
  const Site::Load load = site.load(in_front);
  for (int rock : load.in_bucket) {
    record.loaded_rock_masses.push_back(rocks[static_cast<std::size_t>(rock)].body.mass);
    in_front[static_cast<std::size_t>(rock)] = false;
  }
  record.spilled_mass = spill.cleared;
  for (std::size_t k = 0; k < in_front.size(); ++k) {
    if (in_front[k]) record.front_mass += rocks[k].body.mass;
    if (spill.spilled(k, in_front)) record.spilled_mass += rocks[k].body.mass;
  }
  spill.clear(site, in_front, load.elsewhere);
  record.loaded_mass = site.remove(load.in_bucket);
  return site.remove(load.elsewhere);
}

}  // namespace drawpoint::engine::loading

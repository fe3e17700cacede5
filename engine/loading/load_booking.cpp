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

double book_load(Site& site, const ColumnModel& model, const std::vector<bool>& in_front_before,
                 CycleRecord& record) {
  const std::vector<engine::Rock>& rocks = site.world().rocks();
  std::vector<bool> in_front = rocks_in_front(site, model);
  const Site::Load load = site.load(in_front);
  for (int rock : load.in_bucket) {
    record.loaded_rock_masses.push_back(rocks[static_cast<std::size_t>(rock)].body.mass);
    in_front[static_cast<std::size_t>(rock)] = false;
  }
  for (std::size_t k = 0; k < in_front.size(); ++k) {
    if (!in_front[k]) continue;
    record.front_mass += rocks[k].body.mass;
    if (k >= in_front_before.size() || !in_front_before[k]) record.spilled_mass += rocks[k].body.mass;
  }
  record.loaded_mass = site.remove(load.in_bucket);
  return site.remove(load.elsewhere);
}

}  // namespace drawpoint::engine::loading

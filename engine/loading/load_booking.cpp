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

double book_load(Site& site, const ColumnModel& model, CycleRecord& record) {
  const Site::Load load = site.load(rocks_in_front(site, model));
  for (int rock : load.in_bucket)
    record.loaded_rock_masses.push_back(site.world().rocks()[static_cast<std::size_t>(rock)].body.mass);
  record.loaded_mass = site.remove(load.in_bucket);
  return site.remove(load.elsewhere);
}

}  // namespace drawpoint::engine::loading

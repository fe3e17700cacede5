// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/model/haul_choice.h>

#include <cmath>
#include <numeric>

namespace drawpoint::studies {

double WorkOfRun::rate(double haul) const {
  double sum = 0;
  for (std::size_t c = 0; c < loads.size(); ++c) sum += loads[c] / (seconds[c] + haul);
  return sum / static_cast<double>(loads.size());
}

double WorkOfRun::mean_load() const {
  return std::accumulate(loads.begin(), loads.end(), 0.0) / static_cast<double>(loads.size());
}

double WorkOfRun::mean_seconds() const {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
}

double turning_haul(double load_a, double seconds_a, double load_b, double seconds_b, double longest) {
  const double haul = (load_b * seconds_a - load_a * seconds_b) / (load_a - load_b);
  return haul > 0 && haul <= longest ? haul : std::nan("");
}

}  // namespace drawpoint::studies

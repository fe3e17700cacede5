// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/studies/report/haul_choice.h>

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

namespace detail {

nlohmann::json to_json(const HaulChoice& choice) {
  using nlohmann::json;
  json strategies = json::array(), turns = json::array();
  for (const HauledStrategy& s : choice.strategies) {
    json runs = json::array();
    for (const WorkOfRun& run : s.runs)
      runs.push_back({{"run", run.run}, {"loads", run.loads}, {"seconds", run.seconds}});
    strategies.push_back({{"name", s.name},
                          {"x", std::vector<double>(s.x.begin(), s.x.end())},
                          {"load", s.load},
                          {"seconds", s.seconds},
                          {"runs", std::move(runs)}});
  }
  for (const HaulTurn& t : choice.turns)
    turns.push_back(
        {{"haul", t.haul}, {"better", t.better}, {"worse", t.worse}, {"lower", t.lower}, {"upper", t.upper}});
  return {{"response", choice.response}, {"haul", choice.haul},
          {"longest", choice.longest},   {"strategies", std::move(strategies)},
          {"turns", std::move(turns)},   {"deviation", choice.deviation},
          {"error", choice.error}};
}

}  // namespace detail
}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_contrasts.h>
#include <drawpoint/studies/loading/loading_panels.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/loading/loading_scene.h>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace drawpoint::studies {
namespace {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using engine::loading::LogContent;

struct ChosenCycle {
  double value = 0;
  std::filesystem::path log;
  std::size_t index = 0;  // in LoadingLog::cycles
};

/// The cycles with the least and the greatest of a measure.
struct Extremes {
  ChosenCycle least, most;
  int cycles = 0;

  void add(const ChosenCycle& cycle) {
    if (cycles == 0 || cycle.value < least.value) least = cycle;
    if (cycles == 0 || cycle.value > most.value) most = cycle;
    ++cycles;
  }
  void add(const std::vector<double>& by_cycle, const std::filesystem::path& log) {
    for (std::size_t c = 0; c < by_cycle.size(); ++c) add({by_cycle[c], log, c});
  }
  bool differ() const { return cycles > 1 && least.value < most.value; }
};

/// Nothing of a log without plans.
std::vector<double> tracking_errors(const LoadingLog& log) {
  try {
    return engine::loading::tracking_error_by_cycle(log);
  } catch (const std::invalid_argument&) {
    return {};
  }
}

/// "run 12" of run_0012.h5.
std::string run_of(const std::filesystem::path& log) {
  const std::string stem = log.stem().string();
  const std::size_t digits = stem.find_first_of("123456789");
  return digits == std::string::npos ? stem : "run " + stem.substr(digits);
}

std::string cycle_of(const ChosenCycle& chosen, const CycleRecord& cycle) {
  std::string text = run_of(chosen.log) + ", cycle " + std::to_string(cycle.number);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// Without the floor far before the plan: two figures share a row.
nlohmann::json near_the_plan(nlohmann::json panel) {
  const auto planned = panel["planned"]["x"].get<std::vector<double>>();
  const auto x = panel["contour"]["x"].get<std::vector<double>>(),
             z = panel["contour"]["z"].get<std::vector<double>>();
  const double first = *std::min_element(planned.begin(), planned.end()) - 1.0;
  std::vector<double> near_x, near_z;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (x[i] < first) continue;
    near_x.push_back(x[i]);
    near_z.push_back(z[i]);
  }
  panel["contour"] = {{"x", near_x}, {"z", near_z}};
  return panel;
}

nlohmann::json tracking_panel(const ChosenCycle& chosen, const Extremes& all, bool well) {
  const LoadingLog log = engine::loading::read_log(chosen.log, LogContent::without_scene);
  const CycleRecord& cycle = log.cycles.at(chosen.index);
  const std::string who = cycle_of(chosen, cycle) + ", the " + (well ? "best" : "worst") + " tracked of " +
                          std::to_string(all.cycles) + " cycles, its edge " + fixed(chosen.value, 2) +
                          " m off the planned path (root mean square, drive in to curl)";
  return near_the_plan(path_panel(log, cycle, who, well ? "A well tracked cycle" : "A badly tracked cycle"));
}

struct RankedRun {
  double production = 0;  // mean of its cycles
  std::filesystem::path log;
};

nlohmann::json production_panel(const std::vector<RankedRun>& runs, std::size_t rank,
                                const OptionValues& options, bool good) {
  const LoadingLog log = engine::loading::read_log(runs[rank].log);
  const std::size_t index = typical_cycle(log, options);
  const CycleRecord& cycle = log.cycles[index];
  const engine::loading::ProductionOptions producing = production_options(options);
  const std::string who = cycle_of({0, runs[rank].log, index}, cycle) +
                          ", of median production in a run of rank " + std::to_string(rank + 1) + " of " +
                          std::to_string(runs.size()) + ": " + fixed(1e-3 * cycle.loaded_mass, 1) + " t in " +
                          fixed(cycle.seconds(), 1) + " s, " +
                          fixed(production_by_cycle(log, producing)[index], 0) + " kg/s" +
                          (producing.haul > 0 ? " with a haul of " + fixed(producing.haul, 0) + " s" : "");
  return scene_panel(log, cycle, who, good ? "A good cycle" : "A bad cycle", damage_options(options));
}

constexpr std::size_t fewest_ranked = 10;  // of fewer runs none is good or bad

/// Panels of a cycle of a good run and of one of a bad run; none where production does not differ.
nlohmann::json production_panels(std::vector<RankedRun> runs, const OptionValues& options) {
  std::stable_sort(runs.begin(), runs.end(),
                   [](const RankedRun& a, const RankedRun& b) { return a.production > b.production; });
  if (runs.size() < fewest_ranked || runs.front().production == runs.back().production)
    return nlohmann::json::array();
  const std::size_t rank = runs.size() / 10;  // the last but a tenth from either end
  return {production_panel(runs, rank, options, true),
          production_panel(runs, runs.size() - 1 - rank, options, false)};
}

}  // namespace

nlohmann::json loading_contrasts(const std::vector<std::filesystem::path>& logs,
                                 const OptionValues& options) {
  const engine::loading::ProductionOptions producing = production_options(options);
  Extremes tracking;
  std::vector<RankedRun> runs;
  for (const std::filesystem::path& file : logs) {
    const LoadingLog log = engine::loading::read_log(file, LogContent::without_scene);
    if (log.cycles.empty()) continue;
    tracking.add(tracking_errors(log), file);
    runs.push_back({engine::loading::production(log, producing), file});
  }
  nlohmann::json panels = production_panels(std::move(runs), options);
  if (tracking.differ()) {
    panels.push_back(tracking_panel(tracking.least, tracking, true));
    panels.push_back(tracking_panel(tracking.most, tracking, false));
  }
  return panels;
}

}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_figures.h>
#include <drawpoint/studies/loading/loading_panels.h>
#include <drawpoint/studies/loading/loading_plan_view.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/loading/loading_scene.h>
#include <drawpoint/studies/loading/log_entries.h>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/pile_shape.hpp>

#include <algorithm>
#include <cmath>
#include <thread>

namespace drawpoint::studies {
namespace {

using engine::loading::CycleRecord;
using engine::loading::LoadingLog;
using nlohmann::json;

std::string name_of(const CycleRecord& cycle) { return "Cycle " + std::to_string(cycle.number); }

json line(const char* label, const std::vector<double>& t, const std::vector<double>& y) {
  return {{"name", label}, {"x", rounded(t)}, {"y", rounded(y)}};
}

json forces_panel(const LoadingLog& log, const CycleRecord& cycle, double yield_torque) {
  const Rows rows = rows_of(log, cycle.number);
  const bool cylinders = entry_of(log.texts, "arm_drive") == "cylinders";
  std::vector<double> t = samples(log, "time", rows);
  for (double& time : t) time -= cycle.t_start;
  const auto in_kilo = [&](const char* signal) {
    std::vector<double> y = samples(log, signal, rows);
    for (double& value : y) value *= 1e-3;
    return y;
  };
  using engine::loading::TorqueComponent;
  json series = {line("lift", t, in_kilo("lift_force")), line("tilt", t, in_kilo("tilt_force")),
                 line("wheels, sum [kN m]", t, in_kilo("wheel_torque")),
                 line("hinge G, whole torque", t, hinge_torque(log, rows, TorqueComponent::all)),
                 line("hinge G, what twists it", t, hinge_torque(log, rows, TorqueComponent::twisting))};
  if (!t.empty())
    series.push_back(line("yield torque", {0.0, t.back()}, {1e-3 * yield_torque, 1e-3 * yield_torque}));
  return {{"type", "lines"},
          {"title", "Drive forces and the torque in hinge G"},
          {"caption", name_of(cycle) +
                          " of the run shown. The whole torque has the tilt drive's moment about the pin; "
                          "the rest twists the "
                          "bucket on it. Damage integrates the excess over the yield torque of " +
                          fixed(1e-3 * yield_torque, 0) +
                          " kN m, low-passed at 20 Hz, relative to it. Every sample is drawn."},
          {"x_label", "time [s]"},
          {"y_label", cylinders ? "force [kN], torque [kN m]" : "torque [kN m]"},
          {"series", series}};
}

json bucket_panel(const LoadingLog& log, const CycleRecord& cycle) {
  std::vector<double> t, mass;
  for (const auto& frame : log.scene.frames) {
    if (frame.cycle != cycle.number || std::isnan(frame.bucket_mass)) continue;
    t.push_back(frame.t - cycle.t_start);
    mass.push_back(1e-3 * frame.bucket_mass);
  }
  return {{"type", "lines"},
          {"title", "Rock in the bucket"},
          {"caption", name_of(cycle) +
                          " of the run shown: the mass of all rocks whose centre is in the heaped bucket, "
                          "also while the bucket only passes round them. At the end it carried " +
                          fixed(1e-3 * cycle.loaded_mass, 1) + " t."},
          {"x_label", "time [s]"},
          {"y_label", "mass [t]"},
          {"in_scene", true},
          {"series", {{{"name", "rock in the bucket"}, {"x", rounded(t)}, {"y", rounded(mass)}}}}};
}

// Logs of version 4 do not tell what the bucket held.
std::string lost_in(const LoadingLog& log, std::size_t cycle) {
  const auto told = [](const auto& frame) { return !std::isnan(frame.bucket_mass); };
  if (std::none_of(log.scene.frames.begin(), log.scene.frames.end(), told)) return "unknown";
  return fixed(engine::loading::lost_mass_by_cycle(log)[cycle], 0);
}

json cycles_panel(const LoadingLog& log) {
  json rows = json::array();
  for (const CycleRecord& c : log.cycles) {
    std::string ends;
    for (const auto& stage : c.stages)
      ends += (ends.empty() ? "" : ", ") + std::string(name(stage.stage)) + ": " +
              std::string(name(stage.reason));
    rows.push_back({std::to_string(c.number), fixed(c.seconds(), 1), fixed(c.loaded_mass, 0),
                    lost_in(log, rows.size()), fixed(c.plan.depth, 2), fixed(c.plan.height, 2), ends});
  }
  return {
      {"type", "table"},
      {"title", "Cycles of the run shown"},
      {"caption",
       "How each stage ended: at its goal, by its time limit, or because a drive was too slow under load."},
      {"columns",
       {"cycle", "time [s]", "loaded [kg]", "taken and lost [kg]", "planned depth [m]", "planned height [m]",
        "stages"}},
      {"rows", rows}};
}

json figures_of_cycle(const LoadingLog& log, const CycleRecord& cycle, const OptionValues& options) {
  const std::string who = name_of(cycle) + " of the run shown";
  const engine::loading::DamageOptions damage = damage_options(options);
  json panels = json::array({path_panel(log, cycle, who, "Planned and actual path of the cutting edge")});
  if (json plan = plan_view_panel(log, cycle, who); !plan.is_null()) panels.push_back(std::move(plan));
  panels.push_back(scene_panel(log, cycle, who, "The machine in the drift", damage));
  panels.push_back(forces_panel(log, cycle, damage.tau_y));
  json bucket = bucket_panel(log, cycle);
  if (!bucket["series"][0]["x"].empty()) panels.push_back(std::move(bucket));  // logs of version 4 have none
  return panels;
}

// In the report, which shows one cycle.
std::string others_text(const LoadingLog& log) {
  if (log.cycles.size() < 2) return "";
  return std::string(log.cycles.size() > 2 ? " It is the one of median production." : "") +
         " The command replay shows all " + std::to_string(log.cycles.size()) + " cycles.";
}

}  // namespace

void settle_pile(engine::loading::Scenario scenario) {
  engine::loading::check(scenario);
  scenario.world.threads = static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1u, 8u));
  int told = -1;
  const auto pile = engine::loading::prepared_pile(scenario, [&](double share) {
    const int percent = static_cast<int>(100 * share) / 10 * 10;
    if (percent == told) return;
    told = percent;
    if (percent < 100)
      std::fprintf(stderr, "pouring the pile: %d %%\n", percent);
    else
      std::fprintf(stderr, "pouring the pile: done, settling\n");
  });
  const engine::loading::PileShape shape = engine::loading::pile_shape(pile, scenario);
  std::fprintf(stderr, "the pile: %zu rocks, %.0f t, %s after %.0f s; crest %.2f m, surface at %.1f deg\n",
               pile.rocks.size(), shape.mass / 1e3, pile.timed_out ? "still creeping" : "at rest",
               pile.poured_s, shape.surface.crest, shape.surface.mean * 180 / M_PI);
}

json loading_figures(const std::filesystem::path& log_file, const OptionValues& options) {
  const LoadingLog log = engine::loading::read_log(log_file);
  if (log.cycles.empty()) return json::array();
  json panels = figures_of_cycle(log, log.cycles[typical_cycle(log, options)], options);
  for (json& panel : panels)
    if (panel["type"] == "scene") panel["caption"] = panel["caption"].get<std::string>() + others_text(log);
  panels.push_back(cycles_panel(log));
  return panels;
}

json loading_replay(const std::filesystem::path& log_file, const OptionValues& options) {
  const LoadingLog log = engine::loading::read_log(log_file);
  if (log.cycles.empty()) return json::array();
  json panels = json::array({cycles_panel(log)});
  for (const CycleRecord& cycle : log.cycles)
    for (json& panel : figures_of_cycle(log, cycle, options)) {
      panel["cycle"] = cycle.number;
      panels.push_back(std::move(panel));
    }
  return panels;
}

}  // namespace drawpoint::studies

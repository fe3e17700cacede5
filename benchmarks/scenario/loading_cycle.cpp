// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <time.h>

#include <cstdio>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "command.hpp"
#include "loading_flags.hpp"
#include "setting.hpp"
#include "step_times.hpp"

/// What a loading cycle costs: seconds of a core per cycle, cycles per core-hour, and where steps spend them. See
/// --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using namespace drawpoint::engine::loading;

namespace {

constexpr const char* about =
    "Simulates loading cycles of the LHD and prints what they cost: seconds per cycle, cycles per core-hour, "
    "and\n"
    "where the steps spend their time. The pile is poured once and kept in PILE_FILE; pouring is not "
    "counted.\n\n"
    "  loading_cycle /tmp/small.h5                       the default scene: 120 t\n"
    "  loading_cycle /tmp/full.h5 --scene lindmark2016   the scale of Lindmark (2016): 290 t, some 4300 "
    "rocks\n"
    "  loading_cycle /tmp/fine.h5 --sizes well_broken    what finer rock costs\n\n"
    "Fields of --json:\n"
    "  seconds_per_cycle   processor time per cycle of a run, refill and wait for rest included;\n"
    "                      real_time_factor: simulated over that\n"
    "  phases              simulated and processor seconds per cycle, by stage and in the pauses between "
    "cycles\n"
    "  cycle_s             what a cycle takes the machine, with what is not simulated of it\n"
    "  cycles_per_core_hour   3600 over it: the measure by which versions are compared\n"
    "  ms_step, ms_*       per step, and its parts (wall time; broad, narrow, machine, solver, rest)\n"
    "  loaded_kg, production_kg_s, damage_s, spill   what came out, means over the cycles";

struct Settings {
  std::string pile, setting;
  PileFlags rock;
  OperationFlags operation;
  int cycles = 1, threads = 1;
  bool json = false;
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Where the time of a run goes: simulated and processor seconds of each stage, and of the pauses between cycles.
class PhaseTimes {
 public:
  explicit PhaseTimes(double step) : step_(step), last_(processor_seconds()) {}
  void add() {
    const double now = processor_seconds();
    cost_.push_back(now - last_);
    last_ = now;
  }
  /// Per cycle of the run.
  nlohmann::json per_cycle(const LoadingLog& log) const {
    const char* names[] = {"pauses", "drive_in", "lift", "curl", "back_out"};
    double simulated[5] = {}, spent[5] = {};
    for (std::size_t k = 0; k < cost_.size(); ++k) {
      const int phase = phase_at(log, step_ * (static_cast<double>(k) + 0.5));
      simulated[phase] += step_;
      spent[phase] += cost_[k];
    }
    const double cycles = static_cast<double>(log.cycles.size());
    nlohmann::json out;
    for (int p = 0; p < 5; ++p)
      out[names[p]] = {{"simulated_s", simulated[p] / cycles}, {"processor_s", spent[p] / cycles}};
    return out;
  }

 private:
  static int phase_at(const LoadingLog& log, double t) {
    for (const CycleRecord& cycle : log.cycles)
      for (const StageResult& stage : cycle.stages)
        if (t > stage.t_start && t <= stage.t_end) return static_cast<int>(stage.stage);
    return 0;
  }
  double step_, last_;
  std::vector<double> cost_;
};

Scenario scenario_of(const Settings& s) {
  Scenario scenario = s.rock.scenario();
  s.operation.apply(scenario);
  scenario.cycles = s.cycles;
  scenario.strategy = {1.2, 0.8, 0.8, 0.2};
  scenario.pile_file = s.pile;
  return scenario;
}

nlohmann::json run(const Settings& s) {
  Scenario scenario = scenario_of(s);
  const SettledPile pile = prepared_pile(scenario);
  if (!s.setting.empty()) scenario.world = with(scenario.world, setting_of(s.setting));
  scenario.world.threads = s.threads;
  StepTimes times;
  Progress progress;
  long steps = 0;
  const double start = processor_seconds();
  PhaseTimes phases(scenario.world.step);
  SimulationHooks hooks;
  hooks.on_step = [&](const auto& report) {
    times.add(report);
    phases.add();
    progress.show("steps", static_cast<int>(++steps), s.cycles * 1300);
  };
  const LoadingLog log = simulate(scenario, pile, hooks);
  const double spent = processor_seconds() - start;
  if (!log.completed) throw std::runtime_error(log.message);
  const double cycles = static_cast<double>(log.cycles.size()), simulated = log.cycles.back().t_end;
  double loaded = 0, counted = 0;
  for (const CycleRecord& cycle : log.cycles) {
    loaded += cycle.loaded_mass / cycles;
    counted += cycle.seconds() / cycles;
  }
  nlohmann::json out = times.per_step();
  out.update({{"scene", s.rock.scene},
              {"sizes", s.rock.sizes},
              {"threads", s.threads},
              {"cycles", log.cycles.size()},
              {"cycle_s", counted},
              {"phases", phases.per_cycle(log)},
              {"simulated_s", simulated},
              {"seconds_per_cycle", spent / cycles},
              {"cycles_per_core_hour", 3600 * cycles / spent},
              {"real_time_factor", simulated / spent},
              {"rocks", log.numbers.at("rocks")},
              {"most_contact_points", log.numbers.at("most_contact_points")},
              {"most_iterations_per_substep", log.numbers.at("most_iterations_per_substep")},
              {"loaded_kg", loaded},
              {"production_kg_s", production(log)},
              {"damage_s", joint_damage(log)},
              {"spill", rock_spill(log)}});
  return out;
}

double number(const nlohmann::json& j, const char* key) { return j.at(key).get<double>(); }

void print(const nlohmann::json& j) {
  std::printf(
      "%.0f rocks, %d thread%s: %.2f s of processor time per cycle of %.1f s, %.0f cycles per core-hour\n",
      number(j, "rocks"), j.at("threads").get<int>(), j.at("threads") == 1 ? "" : "s",
      number(j, "seconds_per_cycle"), number(j, "simulated_s") / number(j, "cycles"),
      number(j, "cycles_per_core_hour"));
  std::printf("  a cycle takes the machine %.1f s; simulated and processor seconds per cycle:",
              number(j, "cycle_s"));
  for (const char* phase : {"drive_in", "lift", "curl", "back_out", "pauses"})
    std::printf(" %s %.2f, %.2f%s", phase, number(j.at("phases").at(phase), "simulated_s"),
                number(j.at("phases").at(phase), "processor_s"), phase == std::string("pauses") ? "\n" : ";");
  std::printf(
      "  ms per step: total %.3f = broad %.3f + narrow %.3f + machine %.3f + solver %.3f + rest %.3f\n",
      number(j, "ms_step"), number(j, "ms_broad"), number(j, "ms_narrow"), number(j, "ms_machine"),
      number(j, "ms_solver"), number(j, "ms_rest"));
  std::printf(
      "  at most %.0f contact points, with up to %.0f iterations per substep while rocks move; largest "
      "overlap of a "
      "rock %.1f mm\n",
      number(j, "most_contact_points"), number(j, "most_iterations_per_substep"),
      number(j, "largest_overlap_mm"));
  std::printf("  loaded %.0f kg, production %.1f kg/s, damage %.2f s, spill %.3f\n", number(j, "loaded_kg"),
              number(j, "production_kg_s"), number(j, "damage_s"), number(j, "spill"));
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "loading_cycle");
  app.add_option("PILE_FILE", s.pile, "where the pile is kept; poured when missing")->required();
  add_pile_flags(app, s.rock);
  add_operation_flags(app, s.operation);
  app.add_option("--cycles", s.cycles, "of one run, each from the pile that the last one left")
      ->check(between(1, 1000, "", "1 to 5 are usual"))
      ->capture_default_str();
  app.add_option("--threads", s.threads, "threads; they change the time only")
      ->check(between(1, 256, "", "at most the machine's cores"))
      ->capture_default_str();
  app.add_option("--setting", s.setting,
                 "step and work, as 10x16x5 or 10x16x1+20000~0.02 (default: the scene's)")
      ->check(taken_by(setting_of));
  add_json_flag(app, s.json);
  return run_command(app, argc, argv, [&] { return show(run(s), s.json, print); });
}

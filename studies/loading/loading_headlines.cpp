// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_headlines.h>
#include <drawpoint/studies/loading/loading_noise.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/loading/statistics/cycle_scatter.h>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace drawpoint::studies {
namespace {

using engine::loading::LoadingLog;
using engine::loading::LogContent;

std::string percent(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
  return text;
}

/// What the runs show of one response's noise.
struct Noise {
  CycleScatter scatter;
  double relative_variances = 0;  ///< of a run over that of a cycle, summed over the runs
  long runs = 0;
  std::size_t fewest = std::numeric_limits<std::size_t>::max(), most_cycles = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;

  void add(const std::vector<int>& numbers, const ResponseCycles& cycles, double response) {
    scatter.add(numbers, cycles.by_cycle);
    relative_variances += cycles.relative_variance();
    ++runs;
    fewest = std::min(fewest, numbers.size());
    most_cycles = std::max(most_cycles, numbers.size());
    least = std::min(least, response);
    most = std::max(most, response);
  }
  /// A run may have lost cycles, or ended early.
  std::string cycles() const {
    const std::string few = std::to_string(fewest), many = std::to_string(most_cycles);
    return few == many ? few : few + " to " + many;
  }
};

/// Older logs lack some.
double number_or(double otherwise, const LoadingLog& log, const char* name) {
  const auto found = log.numbers.find(name);
  return found == log.numbers.end() ? otherwise : found->second;
}

/// Where the contact solution broke down, over all runs.
struct Breakdowns {
  double steps = 0, escaped = 0, cycles = 0;  // escaped [kg], cycles that were lost
  int runs = 0;

  void add(const LoadingLog& log) {
    const double broken = number_or(0, log, "repeated_steps"), strayed = number_or(0, log, "escaped_mass"),
                 lost = number_or(0, log, "lost_cycles");
    steps += broken;
    escaped += strayed;
    cycles += lost;
    runs += broken > 0 || strayed > 0 || lost > 0;
  }
  Headline headline() const {
    char note[160];
    std::snprintf(
        note, sizeof note,
        "runs in which it did: %.0f steps were done again in parts, %.0f kg of rock left the drift, %.0f "
        "cycles were lost",
        steps, escaped, cycles);
    return {"solution_broke_down", "1", static_cast<double>(runs), note};
  }
};

/// As the first run's log has it: the pile is the same for all.
Headline pile_of(const LoadingLog& log) {
  const auto number = [&](const char* name) { return number_or(std::nan(""), log, name); };
  char note[96];
  std::snprintf(note, sizeof note, "of the pile's surface before the first cycle; %.0f t, crest %.1f m",
                number("pile_mass") / 1e3, number("pile_crest"));
  return {"pile_angle", "deg", number("pile_angle_deg"), note};
}

/// The tables of Lindmark (2016) belong to a loose solution of the contacts.
std::string fill_note(double most, const OptionValues& options) {
  char note[96];
  std::snprintf(note, sizeof note, "loaded mass over the rated payload; %.2f in the run that loaded most",
                most);
  const auto given = [&](const char* option) {
    const auto found = options.find(option);
    return found == options.end() ? "" : found->second;
  };
  if (given("materials") != "lindmark2016" || given("solver") == "lindmark2016") return note;
  return note +
         std::string(
             "; the materials of Lindmark (2016) need its solver, without it rock sticks and buckets "
             "load half as much or less: begin another folder (--out) with --solver lindmark2016 too, or "
             "with --materials calibrated");
}

Headline noise_of(const std::string& response, const std::string& unit, const Noise& noise) {
  const std::string name = "noise_of_" + response;
  if (noise.scatter.degrees() < 1)
    return {name, unit, std::nan(""), "it takes two runs of two cycles; take --cycles 2 or more"};
  const double value =
      std::sqrt(noise.scatter.variance() * noise.relative_variances / static_cast<double>(noise.runs));
  const std::string share = noise.most > noise.least ? ", " + percent(value / (noise.most - noise.least)) +
                                                           " of the range of the runs"
                                                     : "";
  return {name, unit, value,
          "standard error of a run, from the scatter of its " + noise.cycles() +
              " cycles about what their number has in the mean" + share};
}

/// What one run adds to the sums of RunMean: `of` to the numerator, `among` to the denominator.
struct Part {
  double of, among = 1;
};

/// Σ of / Σ among over the runs: the mean of a measure, or the ratio of two.
class RunMean {
 public:
  RunMean(Headline headline, std::function<Part(const LoadingLog&)> measure)
      : headline_(std::move(headline)), measure_(std::move(measure)) {}

  void add(const LoadingLog& log) {
    try {
      const Part part = measure_(log);
      of_ += part.of;
      among_ += part.among;
    } catch (const std::invalid_argument&) {
      lacking_ = true;
    }
  }
  Headline headline() const {
    const auto unknown = [&](const char* why) -> Headline {
      return {headline_.name, headline_.unit, std::nan(""), why};
    };
    if (lacking_) return unknown("some logs lack what it takes: of an older version");
    if (!(among_ > 0)) return unknown("nothing was loaded");
    return {headline_.name, headline_.unit, of_ / among_, headline_.note};
  }

 private:
  Headline headline_;
  std::function<Part(const LoadingLog&)> measure_;
  double of_ = 0, among_ = 0;
  bool lacking_ = false;
};

Part energy_and_tonnes(const LoadingLog& log) {
  Part part{0, 0};
  for (const double energy : engine::loading::energy_by_cycle(log)) part.of += energy;
  for (const auto& cycle : log.cycles) part.among += cycle.loaded_mass / 1000;
  return part;
}

std::vector<RunMean> measures() {
  namespace loading = engine::loading;
  const auto mean_of = [](double (*measure)(const LoadingLog&)) {
    return [measure](const LoadingLog& log) { return Part{measure(log)}; };
  };
  return {{{"cycle_time", "s", 0, "from the start of stage 1 to the end of stage 4"},
           mean_of(loading::cycle_time)},
          {{"heaped_fill", "1", 0,
            "of the bucket's heaped volume, voids included; a handbook has 0.60 to 0.75 in poorly blasted "
            "rock, 0.80 "
            "to 0.95 in well blasted"},
           mean_of(loading::heaped_fill)},
          {{"energy_per_tonne", "kJ/t", 0, "positive work of drive, lift and tilt over what was loaded"},
           energy_and_tonnes},
          {{"tracking_error", "m", 0,
            "of the cutting edge from the planned path, stages 1 to 3, root mean square"},
           mean_of(loading::tracking_error)},
          {{"drive_lag", "1", 0, "share of the set drive speed that the machine lacks"},
           mean_of(loading::drive_lag)},
          {{"wheel_slip", "1", 0, "share of the tyres' speed that the machine lacks while it drives forward"},
           mean_of(loading::wheel_slip)},
          {{"peak_bucket_force", "kN", 0,
            "of rock and floor on the bucket, low-passed at 20 Hz, mean of the cycles' peaks"},
           [](const LoadingLog& log) { return Part{loading::peak_bucket_force(log)}; }},
          {{"peak_pin_force", "kN", 0, "in the bucket's pin, low-passed at 20 Hz, mean of the cycles' peaks"},
           [](const LoadingLog& log) { return Part{loading::peak_pin_force(log)}; }},
          {{"pin_load_range", "kN", 0,
            "in the worse of the bucket's two pins, the range that does its fatigue damage once per cycle"},
           [](const LoadingLog& log) { return Part{loading::pin_load_range(log)}; }}};
}

}  // namespace

std::vector<Headline> loading_headlines(const std::vector<std::filesystem::path>& logs,
                                        const OptionValues& options) {
  if (logs.empty()) return {};
  const engine::loading::ProductionOptions producing = production_options(options);
  const engine::loading::DamageOptions damaging = damage_options(options);
  const engine::loading::SpillOptions spilling = spill_options(options);
  double fill = 0, most_fill = 0, stalls = 0;
  Noise production, damage, spill;
  Headline pile;
  Breakdowns breakdowns;
  std::vector<RunMean> others = measures();
  for (const auto& file : logs) {
    const LoadingLog log = engine::loading::read_log(file, content_for(options));
    if (pile.name.empty()) pile = pile_of(log);
    const double of_run = fill_factor(log);
    fill += of_run / static_cast<double>(logs.size());
    most_fill = std::max(most_fill, of_run);
    stalls += stall_share(log) / static_cast<double>(logs.size());
    const std::vector<int> numbers = cycle_numbers(log);
    const auto [producing_cycles, damaging_cycles, spilling_cycles] = cycles_of(log, options);
    production.add(numbers, producing_cycles, engine::loading::production(log, producing));
    damage.add(numbers, damaging_cycles, joint_damage(log, damaging));
    spill.add(numbers, spilling_cycles, rock_spill(log, spilling));
    breakdowns.add(log);
    for (RunMean& measure : others) measure.add(log);
  }
  std::vector<Headline> said = {
      {"fill_factor", "1", fill, fill_note(most_fill, options)},
      {"stall_share", "1", stalls, "drive-ins that ended before their goal, by time or a slow actuator"},
      noise_of("production", "kg/s", production),
      noise_of("joint_damage", "s", damage),
      noise_of("rock_spill", "1", spill),
      pile};
  for (const RunMean& measure : others) said.push_back(measure.headline());
  if (breakdowns.runs > 0) said.push_back(breakdowns.headline());
  return said;
}

}  // namespace drawpoint::studies

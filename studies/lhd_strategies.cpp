// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Families of loading strategies against each other, what Lindmark (2016) leaves to later work: what should a driver
/// do, how hard should he push, how often drop the edge, and what does it cost in energy, in the pins and in spilt
/// rock?
///
/// At what the machine's engine and hydraulics can do, haul counted, at the middle of the drift.

#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/loading/loading_study.h>
#include <drawpoint/studies/loading/log_entries.h>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>
#include <drawpoint/engine/loading/strategy/families.hpp>

using namespace drawpoint;
using namespace drawpoint::engine::loading;
using doe::Goal, doe::Response;

doe::Variable variable(doe::Variable v, const char* description) {
  v.description = description;
  return v;
}

const Response production_response{
    .name = "production",
    .unit = "kg/s",
    .goal = Goal::maximize,
    .lower = 0,
    .description = "loaded mass over the time of a cycle and its haul, mean of the cycles",
    .standard_error = "production_error"},
    spill_response{
        .name = "rock_spill",
        .unit = "1",
        .goal = Goal::minimize,
        .lower = 0,
        .description = "rock that the bucket took and lost, over the 10 t that would stop the work",
        .standard_error = "rock_spill_error"};

const doe::Problem problem{
    .variables = {variable(
                      doe::categorical_variable("family", {family_names.begin(), family_names.end()}),
                      "what is done: Lindmark's slice, no lift, steps, or steps with the edge dropped back"),
                  variable({"alpha", "1", 0.4, 2.0}, "wanted fill: planned cut over the bucket's volume"),
                  variable({"beta", "1", 0.0, 1.0},
                           "end of the lift over the height of the pile; drive_and_curl has none"),
                  variable({"kappa", "1", 0.0, 1.0},
                           "tilt in the lift over the angle of the pile; drive_and_curl has none"),
                  variable(
                      doe::integer_variable("rounds", "1", 1, 5),
                      "of steps or drops in a drive-in that is held up; slice and drive_and_curl have none"),
                  variable({"crowd", "m/s", 0.0, 3.0}, "at which the drive pushes while the bucket curls")},
    .responses = {production_response,
                  {.name = "energy",
                   .unit = "kJ/t",
                   .goal = Goal::minimize,
                   .lower = 0,
                   .description = "of drive, lift and tilt over the loaded mass"},
                  {.name = "pin_load",
                   .unit = "kN",
                   .goal = Goal::minimize,
                   .lower = 0,
                   .description =
                       "range of force in the worse pin of the bucket that tires it as much as a cycle does"},
                  spill_response,
                  studies::standard_error("production_error", "kg/s", "production"),
                  studies::standard_error("rock_spill_error", "1", "rock spill"),
                  studies::recorded("load", "t", "per cycle; rated payload: 21 t"),
                  studies::recorded("cycle_time", "s", "at the pile, without haul")}};

Scenario scenario_of(const Eigen::VectorXd& x, const studies::RunContext& run) {
  Scenario scenario = studies::loading_scenario(studies::with_options(run, {{"speeds", "machine"}}));
  const auto family = static_cast<Family>(std::lround(x[0]));
  scenario.strategy = strategy_of(family, {.alpha = x[1], .beta = x[2], .gamma = 0.5, .kappa = x[3]});
  scenario.executor.moves = moves_of(family, static_cast<int>(std::lround(x[4])), x[5]);
  return scenario;
}

doe::Outcome responses_of(const LoadingLog& log, const studies::OptionValues& options) {
  const double loaded = 1e-3 * studies::entry_of(log.numbers, "payload") * fill_factor(log);
  if (loaded == 0) return doe::Failure{"nothing was loaded, so energy per tonne is unknown"};
  const auto producing = studies::production_options(options);
  const auto spilling = studies::spill_options(options);
  return {production(log, producing),
          energy_per_tonne(log),
          pin_load_range(log),
          rock_spill(log, spilling),
          production_standard_error(log, producing),
          rock_spill_standard_error(log, spilling),
          loaded,
          cycle_time(log)};
}

std::vector<studies::StudyOption> options() {
  auto options =
      studies::loading_options_without({"operator", "operator-rounds", "operator-crowd", "operator-slip",
                                        "speeds", "arm", "yield-torque", "damage", "spill"});
  for (auto& option : options)
    if (option.name == "haul") option.value = "120";
  return options;
}

int main(int argc, char** argv) {
  return studies::run(
      argc, argv,
      studies::study_of({.name = "lhd_strategies",
                         .about = "Families of loading strategies of an LHD, haul counted, in a drift.",
                         .problem = problem,
                         .defaults = {.runs = 60, .validation = 12},
                         .options = options(),
                         .scenario = scenario_of,
                         .responses = responses_of}));
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Bucket, speeds and strategy of an LHD together, what Lindmark (2016) leaves to later work: which bucket
/// and which pump pay in this rock, driven how, and what do they cost in energy and in the pins?
///
/// With the machine's own engine of 382 kW and with its hydraulics, whose pump goes with the speed of the
/// arm. The strategy's place across the drift (gamma, weak everywhere) stays in the middle.

#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/loading/loading_study.h>
#include <drawpoint/studies/loading/log_entries.h>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>

using namespace drawpoint;
using engine::loading::LoadingLog;
using engine::loading::Scenario;

doe::Variable real(const char* name, const char* unit, double lower, double upper, const char* description) {
  return {.name = name, .unit = unit, .lower = lower, .upper = upper, .description = description};
}

const doe::Problem problem{
    .variables = {real("width", "m", 3.1, 4.0, "of the bucket"),
                  real("volume", "m3", 6.0, 11.0, "of the bucket, heaped 2:1; its mass goes with its plates"),
                  real("drive_speed", "m/s", 0.8, 2.0, "at which the machine comes to the pile"),
                  real("arm_speed", "1", 0.7, 1.6,
                       "of lift, curl and pump over the machine's own: 485 l/min"),
                  real("alpha", "1", 0.4, 2.0, "wanted fill: planned cut over the bucket's volume"),
                  real("beta", "1", 0.0, 1.0, "end of the lift over the height of the pile"),
                  real("kappa", "1", 0.0, 1.0, "tilt in the lift over the angle of the pile")},
    .responses = {{.name = "production",
                   .unit = "kg/s",
                   .goal = doe::Goal::maximize,
                   .lower = 0,
                   .description = "loaded mass over the time of a cycle and its haul, mean of the cycles",
                   .standard_error = "production_error"},
                  {.name = "energy",
                   .unit = "kJ/t",
                   .goal = doe::Goal::minimize,
                   .lower = 0,
                   .description = "of drive, lift and tilt over the loaded mass"},
                  {.name = "pin_load",
                   .unit = "kN",
                   .goal = doe::Goal::minimize,
                   .lower = 0,
                   .description =
                       "range of force in the worse pin of the bucket that tires it as much as a cycle does"},
                  {.name = "load",
                   .unit = "t",
                   .goal = doe::Goal::record,
                   .lower = 0,
                   .description = "per cycle; rated payload: 21 t"},
                  {.name = "production_error",
                   .unit = "kg/s",
                   .goal = doe::Goal::record,
                   .lower = 0,
                   .description = "standard error of production, by the scatter of the run's cycles"}}};

/// Another bucket and other speeds are no other pile: all runs begin with the same.
Scenario scenario_of(const Eigen::VectorXd& x, const studies::RunContext& run) {
  Scenario scenario = studies::loading_scenario(studies::with_options(run, {{"speeds", "machine"}}));
  auto& speeds = scenario.executor.speeds;
  scenario.machine.bucket = engine::loading::bucket_of(x[0], x[1]);
  speeds.drive_in = x[2];
  for (double* speed : {&speeds.lift, &speeds.curl, &speeds.limits.boom, &speeds.limits.tilt,
                        &scenario.machine.hydraulics.pump_flow})
    *speed *= x[3];
  scenario.strategy = {.alpha = x[4], .beta = x[5], .gamma = 0.5, .kappa = x[6]};
  return scenario;
}

doe::Outcome responses_of(const LoadingLog& log, const studies::OptionValues& options) {
  const double loaded = 1e-3 * studies::entry_of(log.numbers, "payload") * fill_factor(log);
  if (loaded == 0) return doe::Failure{"nothing was loaded, so energy per tonne is unknown"};
  const auto producing = studies::production_options(options);
  return {production(log, producing), energy_per_tonne(log), pin_load_range(log), loaded,
          production_standard_error(log, producing)};
}

std::vector<studies::StudyOption> options() {
  auto options = studies::loading_options_without({"speeds", "yield-torque", "damage", "spill", "arm"});
  for (auto& option : options) {
    if (option.name == "operator") option.value = "skilled";
    if (option.name == "haul") option.value = "120";
  }
  return options;
}

int main(int argc, char** argv) {
  return studies::run(
      argc, argv,
      studies::study_of({.name = "lhd_bucket_and_speed",
                         .about = "Bucket, speeds and strategy of an LHD together, in a drift.",
                         .problem = problem,
                         .defaults = {.runs = 60, .validation = 12},
                         .options = options(),
                         .scenario = scenario_of,
                         .responses = responses_of}));
}

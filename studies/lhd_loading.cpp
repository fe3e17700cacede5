// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// The case of Lindmark (2016): how should an LHD load from a muckpile in a drift, and what does each choice
/// cost?

#include <drawpoint/studies/loading/loading_findings.h>
#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/loading/loading_study.h>
#include <drawpoint/engine/loading/log/rock_left.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>

#include <string>

using namespace drawpoint;

using studies::recorded, studies::standard_error;

const doe::Problem problem{
    .variables = {{.name = "alpha",
                   .unit = "1",
                   .lower = 0.2,
                   .upper = 2.0,
                   .description = "wanted fill: planned cut over the bucket's volume"},
                  {.name = "beta",
                   .unit = "1",
                   .lower = 0.0,
                   .upper = 1.0,
                   .description = "end of the lift over the height of the pile; 0: no lift"},
                  {.name = "gamma",
                   .unit = "1",
                   .lower = 0.0,
                   .upper = 1.0,
                   .description =
                       "place across the drift, from where the pile reaches farthest back to where "
                       "it stands farthest out"},
                  {.name = "kappa",
                   .unit = "1",
                   .lower = 0.0,
                   .upper = 1.0,
                   .description = "tilt in the lift over the angle of the pile; 0: the bucket stays level"}},
    .responses = {
        {.name = "production",
         .unit = "kg/s",
         .goal = doe::Goal::maximize,
         .lower = 0,
         .description = "loaded mass over the time of a cycle and its haul (--haul), mean of the cycles",
         .standard_error = "production_error"},
        {.name = "joint_damage",
         .unit = "s",
         .goal = doe::Goal::minimize,
         .lower = 0,
         .description =
             "whole torque in the bucket's hinge, the tilt drive's moment included, above the yield "
             "torque, over that and summed over the time of a run of --cycles cycles",
         .standard_error = "joint_damage_error"},
        {.name = "rock_spill",
         .unit = "1",
         .goal = doe::Goal::minimize,
         .lower = 0,
         .description = "rock that the bucket took and lost before the end of a cycle (or --spill), over the "
                        "10 t that would "
                        "stop the work",
         .standard_error = "rock_spill_error"},
        standard_error("production_error", "kg/s", "production"),
        standard_error("joint_damage_error", "s", "joint damage"),
        standard_error("rock_spill_error", "1", "rock spill"),
        recorded(
            "joint_twist", "s",
            "joint damage by what twists the bucket alone: bent pins and cracked lugs of an uneven load"),
        recorded(
            "peak_pin_force", "kN",
            "in the bucket's hinge, low-passed at 20 Hz, mean of the cycles' peaks: what its pins must bear"),
        recorded("pin_load_range", "kN",
                 "of the worse of the two pins, the range that does its fatigue damage once per cycle: "
                 "cracks by hours"),
        recorded("rock_in_lane", "kg",
                 "on the floor before the pile in the bucket's lane, after a cycle: what tyres run over, to "
                 "be cleared"),
        recorded("rock_before_front", "1",
                 "spill as in Lindmark (2016): rock before the first gap in the pile, counted from the wall, "
                 "over 10 t; "
                 "it measures how ragged the toe is")}};

doe::Outcome responses_of(const engine::loading::LoadingLog& log, const studies::OptionValues& options) {
  const auto producing = studies::production_options(options);
  const auto damaging = studies::damage_options(options);
  const auto spilling = studies::spill_options(options);
  const engine::loading::RockLeft left = rock_left(log);
  auto twisting = damaging;
  twisting.component = engine::loading::TorqueComponent::twisting;
  return {production(log, producing),
          joint_damage(log, damaging),
          rock_spill(log, spilling),
          production_standard_error(log, producing),
          joint_damage_standard_error(log, damaging),
          rock_spill_standard_error(log, spilling),
          joint_damage(log, twisting),
          peak_pin_force(log),
          pin_load_range(log),
          left.in_lane,
          left.before_front / engine::loading::SpillOptions{}.m_max};
}

//! [run]
engine::loading::Scenario scenario_of(const Eigen::VectorXd& x, const studies::RunContext& run) {
  engine::loading::Scenario scenario = studies::loading_scenario(run);
  scenario.strategy = {.alpha = x[0], .beta = x[1], .gamma = x[2], .kappa = x[3]};
  return scenario;
}
//! [run]

int main(int argc, char** argv) {
  studies::Study study =
      studies::study_of({.name = "lhd_loading",
                         .about = "Loading strategies of an LHD in a drift: fill, height, place and tilt.",
                         .problem = problem,
                         .defaults = {.runs = 40, .validation = 12},
                         .options = studies::loading_options(),
                         .scenario = scenario_of,
                         .content = engine::loading::LogContent::all,
                         .responses = responses_of});
  study.presets = {studies::lindmark2016_preset()};
  study.presentation.findings = studies::loading_findings;
  study.presentation.marks = {{"plus", Eigen::Vector4d(1.2, 0.8, 0.8, 0.0)},  // Lindmark (2016), section 5.3
                              {"circle", Eigen::Vector4d(0.3, 0.6, 0.4, 0.4)},
                              {"cross", Eigen::Vector4d(1.8, 0.1, 0.0, 0.8)}};
  return studies::run(argc, argv, study);
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Each option of the loading study chooses what it says, and nothing else.

#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/studies/run/store/option_values.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

using namespace drawpoint;
using namespace drawpoint::studies;

namespace {

namespace loading = engine::loading;

loading::Scenario with(const OptionValues& given) {
  return loading_scenario(
      {.log = "", .shared = "shared", .options = with_defaults(loading_options(), given)});
}

TEST(LoadingScenario, DefaultsAreTheSmallSceneThreeTimes) {
  const loading::Scenario s = with({}), small = loading::lh621_in_a_drift();
  EXPECT_EQ(s.cycles, 3);
  EXPECT_EQ(s.pile.mass, small.pile.mass);
  EXPECT_EQ(s.drift.width, small.drift.width);
  EXPECT_EQ(s.executor.speeds.drive_in, loading::lindmark2016_speeds().drive_in);
  EXPECT_TRUE(s.executor.moves.round.empty());
  EXPECT_EQ(s.executor.lift_end, loading::LiftEnd::arm);
  EXPECT_FALSE(s.whole_cycle);
  EXPECT_EQ(s.materials.rock_rock.rolling, loading::calibrated_materials().rock_rock.rolling);
  EXPECT_EQ(s.pile_file, "shared/pile.h5");
}

TEST(LoadingScenario, APrecisionInPerCentEndsRuns) {
  EXPECT_EQ(with({}).precision, 0) << "by default all cycles are run";
  EXPECT_DOUBLE_EQ(with({{"cycles", "30"}, {"precision", "5"}}).precision, 0.05);
  EXPECT_THROW(loading::check(with({{"cycles", "5"}, {"precision", "5"}})), std::invalid_argument)
      << "of five cycles none is left out";
  const auto complaint = [](const OptionValues& given) {
    return loading_options_complaint(with_defaults(loading_options(), given));
  };
  EXPECT_EQ(complaint({}), "");
  EXPECT_EQ(complaint({{"cycles", "6"}, {"precision", "5"}}), "");
  EXPECT_EQ(
      complaint({{"precision", "5"}}),
      "--precision 5 with --cycles 3: a run may end after five cycles, so that allowed are 6 or more; give "
      "--cycles 30, or no --precision");
}

TEST(LoadingScenario, TheSceneSetsItsOwnSolverButNotTheCycles) {
  const loading::Scenario s = with({{"scene", "lindmark2016"}}),
                          large = loading::lh621_at_lindmark2016_scale();
  EXPECT_EQ(s.cycles, 3);
  EXPECT_EQ(s.pile.mass, large.pile.mass);
  EXPECT_EQ(s.drift.width, large.drift.width);
  EXPECT_EQ(s.world.solver.iteration_budget, large.world.solver.iteration_budget);
  EXPECT_EQ(with({{"scene", "lindmark2016"}, {"cycles", "30"}}).cycles, 30);
}

TEST(LoadingScenario, TheSolverOfTheSourceGoesWithAnyScene) {
  const loading::Scenario s = with({{"solver", "lindmark2016"}, {"scene", "lindmark2016"}});
  EXPECT_EQ(s.world.solver.iterations, 150);
  EXPECT_EQ(s.world.solver.substeps, 1);
  EXPECT_EQ(s.world.warm_start, 0);
  EXPECT_DOUBLE_EQ(s.world.step, 1.0 / 60);
  EXPECT_EQ(s.pile.mass, loading::lh621_at_lindmark2016_scale().pile.mass);
  EXPECT_EQ(with({{"materials", "lindmark2016"}}).world.solver.iterations, 1)
      << "materials alone leave the solver";
}

TEST(LoadingScenario, SpeedsAndOperatorGoTogetherOrAlone) {
  const loading::Scenario s = with({{"speeds", "machine"}, {"operator", "skilled"}});
  EXPECT_EQ(s.executor.speeds.lift, loading::machine_speeds().lift);
  EXPECT_EQ(s.executor.moves.round.size(), loading::skilled_operator().round.size());
  EXPECT_EQ(s.executor.moves.crowd, loading::skilled_operator().crowd);
  EXPECT_TRUE(with({{"speeds", "machine"}}).executor.moves.round.empty());
  EXPECT_EQ(with({{"lift-end", "any"}}).executor.lift_end, loading::LiftEnd::any_actuator);
  EXPECT_TRUE(with({{"whole-cycle", "yes"}}).whole_cycle);
  EXPECT_EQ(with({{"operator", "skilled"}}).executor.speeds.lift, loading::lindmark2016_speeds().lift);
}

TEST(LoadingScenario, TheSkilledOperatorsNumbersAreHisOwnUnlessGiven) {
  const loading::OperatorMoves skilled = loading::skilled_operator(),
                               own = with({{"operator", "skilled"}}).executor.moves,
                               given = with({{"operator", "skilled"},
                                             {"operator-rounds", "5"},
                                             {"operator-crowd", "80"},
                                             {"operator-slip", "25"}})
                                           .executor.moves;
  EXPECT_EQ(own.rounds, skilled.rounds);
  EXPECT_DOUBLE_EQ(own.crowd, skilled.crowd);
  EXPECT_DOUBLE_EQ(own.most_slip, skilled.most_slip);
  EXPECT_EQ(given.rounds, 5);
  EXPECT_DOUBLE_EQ(given.crowd, 0.8);
  EXPECT_DOUBLE_EQ(given.most_slip, 0.25);
  EXPECT_EQ(loading_options_complaint(with_defaults(loading_options(), {{"operator-rounds", "5"}})),
            "--operator-rounds 5: the plan alone has no such moves; give --operator skilled too");
  EXPECT_EQ(loading_options_complaint(
                with_defaults(loading_options(), {{"operator", "skilled"}, {"operator-rounds", "5"}})),
            "");
}

TEST(LoadingScenario, FrictionIsThatOfAllPairsThatARockTakesPartIn) {
  const loading::MineMaterials usual = loading::calibrated_materials(),
                               rough = with({{"rock-friction", "120"}}).materials;
  EXPECT_DOUBLE_EQ(rough.rock_rock.friction, 1.2 * usual.rock_rock.friction);
  EXPECT_DOUBLE_EQ(rough.rock_terrain.friction, 1.2 * usual.rock_terrain.friction);
  EXPECT_DOUBLE_EQ(rough.rock_steel.friction, 1.2 * usual.rock_steel.friction);
  EXPECT_DOUBLE_EQ(rough.rock_tyre.friction, 1.2 * usual.rock_tyre.friction);
  EXPECT_EQ(rough.steel_terrain.friction, usual.steel_terrain.friction);
  EXPECT_EQ(rough.tyre_terrain.friction, usual.tyre_terrain.friction);
  EXPECT_EQ(with({}).materials.rock_steel.friction, usual.rock_steel.friction) << "bits of runs stay";
}

TEST(LoadingScenario, FinerRockIsSolvedAsFarAsTheScenes) {
  using namespace engine::granular;
  const loading::Scenario s = with({{"sizes", "mine_with_fines"}}), scene = with({});
  EXPECT_EQ(s.pile.sizes, blasted_ore_with_fines);
  EXPECT_EQ(s.pile.mass, scene.pile.mass);
  const auto budget = static_cast<double>(s.world.solver.iteration_budget);
  EXPECT_NEAR(budget / scene.world.solver.iteration_budget,
              rocks_per_mass(blasted_ore_with_fines) / rocks_per_mass(blasted_ore), 1e-4)
      << "a half iteration of rounding is 1.25e-5 of the budget";
  EXPECT_EQ(with({{"sizes", "mine_with_fines"}, {"solver", "lindmark2016"}}).world.solver.iteration_budget,
            0);
}

TEST(LoadingScenario, TheLawsOfTheSourceAreChosenOneByOne) {
  const loading::Scenario own = with({}), source = with({{"curl", "tip"},
                                                         {"lift", "slope"},
                                                         {"progress", "faithful"},
                                                         {"arm", "hinges"}});
  EXPECT_EQ(own.curl, loading::CurlMode::hinge_G);
  EXPECT_EQ(own.lift, loading::LiftGoal::behind_surface);
  EXPECT_EQ(own.executor.progress.mode, loading::ProgressMode::projected);
  EXPECT_EQ(own.machine.arm_drive, loading::ArmDrive::cylinders);
  EXPECT_EQ(source.curl, loading::CurlMode::tip_fixed);
  EXPECT_EQ(source.lift, loading::LiftGoal::along_slope);
  EXPECT_EQ(source.executor.progress.mode, loading::ProgressMode::faithful);
  EXPECT_EQ(source.executor.progress.velocity_floor, 0);
  EXPECT_EQ(source.machine.arm_drive, loading::ArmDrive::hinges);
}

TEST(LoadingScenario, FullMotionIsEveryStepAsItWas) {
  const loading::Scenario usual = with({}), full = with({{"motion", "full"}});
  EXPECT_EQ(usual.frame_tolerance, loading::Scenario{}.frame_tolerance);
  EXPECT_FALSE(usual.log_all_joints);
  EXPECT_EQ(full.frame_interval, full.world.step);
  EXPECT_EQ(full.frame_tolerance, 0);
  EXPECT_TRUE(full.log_all_joints);
}

TEST(LoadingScenario, AHigherPileIsSolvedAsFarAsTheScenes) {
  const loading::Scenario s = with({{"scene", "lindmark2016"}, {"pile-mass", "800"}}),
                          scene = with({{"scene", "lindmark2016"}});
  EXPECT_EQ(s.pile.mass, 800e3);
  EXPECT_NEAR(static_cast<double>(s.world.solver.iteration_budget),
              static_cast<double>(scene.world.solver.iteration_budget) * 800 / 290, 0.5);
}

TEST(LoadingScenario, AnotherPileDiffersByItsSeedAlone) {
  const loading::Scenario usual = with({}), other = with({{"pile", "7"}});
  EXPECT_EQ(usual.pile.seed, loading::Scenario{}.pile.seed);
  EXPECT_EQ(other.pile.seed, 7u);
  EXPECT_EQ(other.pile.mass, usual.pile.mass);
}

TEST(LoadingScenario, ThePresetOfTheSourceIsAllThatItPrints) {
  const Preset preset = lindmark2016_preset();
  EXPECT_NO_THROW(check({preset}, loading_options()));
  const loading::Scenario s = with(preset.values);
  EXPECT_NO_THROW(loading::check(s));
  EXPECT_EQ(s.cycles, 30);
  EXPECT_EQ(s.pile.mass, 800e3);
  EXPECT_EQ(s.drift.width, loading::lh621_at_lindmark2016_scale().drift.width);
  EXPECT_EQ(s.world.solver.iterations, 150);
  EXPECT_EQ(s.materials.rock_rock.rolling, loading::lindmark2016_materials().rock_rock.rolling);
  EXPECT_EQ(s.machine.arm_drive, loading::ArmDrive::hinges);
  EXPECT_EQ(s.curl, loading::CurlMode::tip_fixed);
  EXPECT_EQ(s.lift, loading::LiftGoal::along_slope);
  EXPECT_EQ(s.executor.lift_end, loading::LiftEnd::any_actuator);
  EXPECT_EQ(s.executor.progress.mode, loading::ProgressMode::faithful);
  EXPECT_TRUE(s.whole_cycle);
  EXPECT_EQ(s.columns.row_pitch, loading::ColumnGrid{}.cell);
  EXPECT_EQ(spill_options(preset.values).law, loading::SpillLaw::before_front);
  EXPECT_EQ(content_for(preset.values), loading::LogContent::all);
  EXPECT_EQ(loading_options_complaint(with_defaults(loading_options(), preset.values)), "");
}

TEST(Presets, SetWhatTheStudyHasOrAreRefused) {
  const auto refusal = [](const Preset& preset) {
    try {
      check({preset}, loading_options());
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal({.name = "own", .values = {{"rain", "yes"}}}),
            "studies::Study: preset \"own\" sets \"rain\", which is none of the study's options");
  EXPECT_EQ(refusal({.name = "own", .values = {{"arm", "ropes"}}}),
            "studies::Study: preset \"own\" sets what is not allowed: \"ropes\" is not one of the values of "
            "--arm; allowed: cylinders, hinges");
  EXPECT_EQ(preset_complaint({lindmark2016_preset()}, "lindmark2016"), "");
  EXPECT_EQ(preset_complaint({lindmark2016_preset()}, "lindmark"),
            "\"lindmark\" is not one of the values of --preset; allowed: lindmark2016");
}

TEST(LoadingScenario, DamageIsThatOfTheWholeTorqueOrOfItsTwist) {
  EXPECT_EQ(damage_options({}).component, loading::TorqueComponent::all);
  EXPECT_EQ(damage_options({{"damage", "all"}}).component, loading::TorqueComponent::all);
  EXPECT_EQ(damage_options({{"damage", "twisting"}}).component, loading::TorqueComponent::twisting);
}

TEST(LoadingScenario, WhatCannotGoTogetherIsRefused) {
  const auto complaint = [](const OptionValues& given) {
    return loading_options_complaint(with_defaults(loading_options(), given));
  };
  EXPECT_EQ(complaint({{"pile-mass", "10"}}), "");
  EXPECT_EQ(complaint({{"pile-mass", "9"}}),
            "--pile-mass 9: allowed are 10 t (a bucket load) to 10 000 t, or 0 for the scene's");
  EXPECT_EQ(complaint({{"arm", "hinges"}}), "");
  EXPECT_EQ(complaint({{"arm", "hinges"}, {"speeds", "machine"}}),
            "--arm hinges with --speeds machine: its pump drives cylinders, and motors in the hinges have "
            "none; give "
            "--arm cylinders, or --speeds lindmark2016");
}

TEST(LoadingScenario, EveryValueThatIsOfferedMakesAScenario) {
  EXPECT_NO_THROW(check(loading_options()));
  for (const StudyOption& option : loading_options())
    for (const std::string& choice : option.choices)
      EXPECT_NO_THROW(loading::check(with({{option.name, choice}}))) << option.name << " " << choice;
}

TEST(LoadingScenario, AnUnknownValueIsRefusedWithTheValuesThereAre) {
  try {
    with({{"speeds", "fast"}});
    FAIL() << "fast was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "loading::speeds_named: there are no speeds \"fast\"; choose lindmark2016 or machine");
  }
  EXPECT_THROW(loading_scenario({.log = "", .shared = ""}), std::invalid_argument);
}

}  // namespace

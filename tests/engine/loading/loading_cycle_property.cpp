// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/loading/load_booking.h>
#include <cmath>
#include <drawpoint/engine/loading/loading_cycle.hpp>
#include <drawpoint/engine/loading/log/energy_balance.hpp>
#include <drawpoint/engine/loading/log/responses.hpp>
#include <drawpoint/engine/loading/log/run_measures.hpp>
#include <drawpoint/engine/loading/pile_shape.hpp>
#include <drawpoint/engine/loading/pile_store.hpp>
#include <drawpoint/engine/record/file.hpp>

using namespace drawpoint::engine;
using namespace drawpoint::engine::loading;

namespace {

// A small pile, poured once for all tests of this file, and a strategy that enters it.
Scenario small_case() {
  static const std::filesystem::path pile = [] {
    const auto path = std::filesystem::path(testing::TempDir()) / "drawpoint_cycle_pile.h5";
    std::filesystem::remove(path);
    return path;
  }();
  Scenario scenario = lh621_in_a_drift();
  scenario.pile.mass = 25e3;
  scenario.pile_file = pile;
  scenario.strategy = {0.6, 0.6, 0.5, 0.5};
  return scenario;
}

const LoadingLog& cycle_log() {
  static const LoadingLog log = simulate(small_case());
  return log;
}

// The same, with approach, way back and standing simulated too.
const LoadingLog& whole_cycle_log() {
  static const LoadingLog log = [] {
    Scenario scenario = small_case();
    scenario.whole_cycle = true;
    return simulate(scenario);
  }();
  return log;
}

}  // namespace

TEST(LoadingCycle, LoadsRocksAndBooksEveryKilogram) {
  const LoadingLog& log = cycle_log();
  ASSERT_TRUE(log.completed) << log.message;
  ASSERT_EQ(log.cycles.size(), 1u);
  const CycleRecord& cycle = log.cycles[0];
  EXPECT_GT(cycle.loaded_mass, 100.0);
  double sum = 0;
  for (double mass : cycle.loaded_rock_masses) sum += mass;
  EXPECT_DOUBLE_EQ(sum, cycle.loaded_mass);
  EXPECT_EQ(log.texts.at("pile_provenance"), prepared_pile(small_case()).provenance);
  EXPECT_GT(log.numbers.at("most_contact_points"), 0);
  EXPECT_EQ(log.numbers.at("most_iterations_per_substep"),
            most_iterations(small_case().world.solver, log.numbers.at("most_contact_points")));
  EXPECT_EQ(cycle.stages.size(), 4u);
  EXPECT_DOUBLE_EQ(production(log), cycle.loaded_mass / cycle.seconds());
}

// What is counted for the parts that are left out is what they take: the machine follows its set speeds on a level
// floor to a few per cent, so that a tenth of the 5 s of both is room enough. The cycle that is simulated ends with a
// clear bucket on its way back. What the whole one simulates is longer by these parts, the digging being another (rocks
// part at once).
TEST(LoadingCycle, LeavesOutWhatTheMachineDrivesAlone) {
  const CycleRecord &part = cycle_log().cycles[0], &whole = whole_cycle_log().cycles[0];
  EXPECT_EQ(whole.left_out_time, 0);
  EXPECT_EQ(whole.left_out_energy, 0);
  EXPECT_GT(part.left_out_time, 1);
  const auto seconds = [](const CycleRecord& cycle, Stage stage) {
    for (const StageResult& result : cycle.stages)
      if (result.stage == stage) return result.t_end - result.t_start;
    return 0.0;
  };
  double drive = part.left_out_time, drive_whole = 0;
  for (const Stage stage : {Stage::drive_in, Stage::back_out}) {
    drive += seconds(part, stage);
    drive_whole += seconds(whole, stage);
  }
  EXPECT_NEAR(drive, drive_whole, 0.5);
  EXPECT_LT(seconds(part, Stage::back_out),
            seconds(whole, Stage::back_out) + 0.5);  // rock may stay at the bucket
  EXPECT_EQ(part.stages.back().reason, StageEnd::goal);
  // 57 t and the wheels at 1.5 m/s are 66 kJ and more; the way back adds at most that at 3.8 m/s with the load.
  EXPECT_GT(part.left_out_energy, 0.5 * 57e3 * 1.5 * 1.5);
  EXPECT_LT(part.left_out_energy, 0.5 * 80e3 * (1.5 * 1.5 + 3.8 * 3.8));
}

// Who opens the file in another program finds the unit of every number, and what it is.
TEST(LoadingCycle, EveryNumberOfTheLogSaysWhatItIs) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "drawpoint_cycle_log.h5";
  write_log(path, cycle_log());
  const record::Reader file(path, {"drawpoint loading log", 9});
  const std::vector<std::string> names = file.children("numbers");
  EXPECT_EQ(names.size(), cycle_log().numbers.size());
  for (const std::string& name : names) {
    const std::vector<std::string> expected{"description", "unit"};
    EXPECT_EQ(file.attributes("numbers/" + name), expected) << name;
  }
  EXPECT_EQ(file.text("numbers/hydraulic_pressure", "unit"), "Pa");
  EXPECT_EQ(read_log(path).numbers, cycle_log().numbers);
  const std::map<std::string, std::string> texts = read_log(path).texts;
  EXPECT_EQ(texts.at("progress"), "projected");
  EXPECT_EQ(texts.at("after_stuck"), "next stage");
  EXPECT_EQ(texts.at("rock_sizes"), "0.2 of 0.3 m, 0.3 of 0.4 m, 0.3 of 0.6 m, 0.2 of 0.8 m");
  std::filesystem::remove(path);
}

// Bounds that any loading cycle keeps: solid rock fills no more than the heaped bucket; to bring a tonne to
// the end of the cycle takes less than to lift it by 100 m; the tip stays within a bucket's length of its
// plan; the bucket is pushed by more than it carries.
TEST(LoadingCycle, LogHasWhatItsMeasuresTake) {
  const LoadingLog& log = cycle_log();
  ASSERT_TRUE(log.completed) << log.message;
  EXPECT_GT(solid_fill(log), 0);
  EXPECT_LT(solid_fill(log), log.numbers.at("bucket_heaped_volume") / log.numbers.at("bucket_struck_volume"));
  EXPECT_GT(energy_per_tonne(log), 0);
  EXPECT_LT(energy_per_tonne(log), 9.81 * 100);
  EXPECT_GT(tracking_error(log), 0);
  EXPECT_LT(tracking_error(log), 1.9);
  EXPECT_LT(drive_lag(log), 1);
  EXPECT_LT(wheel_slip(whole_cycle_log()), drive_lag(whole_cycle_log())) << "which gains speed";
  EXPECT_GT(peak_bucket_force(log), 9.81e-3 * log.cycles[0].loaded_mass);
  EXPECT_GT(peak_pin_force(log), 9.81e-3 * log.cycles[0].loaded_mass);  // it carries the load [kN]
}

// It begins flat on the floor, within the millimetre by which contacts with it may be open or pressed in.
// Until it comes to the rock the drive gains 2 m/s² and the machine rears: 57 t, 1.3 m up, over a wheelbase
// of 4.9 m shift 30 kN from front tyres of 4 MN/m to the rear ones, 7.6 mm each and so 3.1 mrad, which lift
// the edge, 3.85 m before the axle, by 20 mm: a tenth of the thinnest rock. A bucket that stands higher rides
// over rubble.
TEST(LoadingCycle, TheBucketComesAlongTheFloor) {
  const LoadingLog& log = whole_cycle_log();
  ASSERT_EQ(log.numbers.at("drive_acceleration"), 2);
  const record::Table& s = log.signals;
  const std::size_t x = s.index("tip_x"), z = s.index("tip_z"), angle = s.index("bucket_angle");
  EXPECT_NEAR(s.at(0, z), 0, 1e-3);
  EXPECT_NEAR(s.at(0, angle), 0, 1e-3);
  const double pile = log.cycles[0].plan.toe - 0.5;
  ASSERT_LT(s.at(0, x), pile - 1);
  double highest = 0, lowest = 0;
  for (std::size_t k = 0; k < s.rows() && s.at(k, x) < pile; ++k) {
    highest = std::max(highest, s.at(k, z));
    lowest = std::min(lowest, s.at(k, z));
  }
  EXPECT_LT(highest, 0.020);
  EXPECT_GT(lowest, -1e-3);
}

// What the motors give and machine and rock do not gain is dissipated, and does not come back, but for what
// springs hold. The softest are the tyres, 2 MN/m each: when the two front ones carry machine and load, 0.30
// MN each, they store 2 · (0.30 MN)² / (2 · 2 MN/m) = 45 kJ. A rock on anything but rock is a spring of 0.1
// GN/m: the machine's whole weight presses it in by 6 mm, and 57 t stopped at 1.6 m/s by a single contact by
// v √(m/k) = 38 mm.
TEST(LoadingCycle, EnergyDoesNotComeFromNothing) {
  const LoadingLog& log = whole_cycle_log();
  ASSERT_TRUE(log.completed) << log.message;
  ASSERT_EQ(log.numbers.at("emitted_mass"), 0);
  const std::vector<EnergyBalance> balance = energy_balances(log).at(0);
  double most = 0;
  for (const EnergyBalance& at : balance) {
    EXPECT_GT(at.dissipated, most - 45);
    most = std::max(most, at.dissipated);
  }
  const EnergyBalance end = energy_balance_by_cycle(log).at(0);
  EXPECT_EQ(end.dissipated, balance.back().dissipated);
  EXPECT_GT(end.rock, 0);
  EXPECT_GT(end.machine, 0);  // its arm is up
  EXPECT_GT(end.dissipated, end.rock + end.machine);
  EXPECT_LT(log.numbers.at("largest_loop_error"), 1e-9);
  EXPECT_LT(log.numbers.at("largest_overlap"), 0.044);
}

// Looking ahead with another solver, and coming back, changes no bit of the run.
TEST(LoadingCycle, LooksAheadWithoutATrace) {
  const Scenario scenario = small_case();
  SolverOptions harder = scenario.world.solver;
  harder.iterations = 5;
  int looks = 0, step = 0;
  SimulationHooks hooks;
  hooks.look_ahead = [&](World& world) {
    if (++step % 100 != 0) return;
    ++looks;
    const std::vector<std::byte> state = world.save();
    world.set_solver(harder);
    for (int k = 0; k < 5; ++k) world.step();
    world.set_solver(scenario.world.solver);
    world.restore(state);
  };
  const LoadingLog log = simulate(scenario, hooks);
  EXPECT_GT(looks, 3);
  for (const char* column : {"tip_x", "hinge_G_force_z", "contacts"})
    EXPECT_EQ(log.signals.column(column), cycle_log().signals.column(column)) << column;
}

// A broken step leaves the world as it was, so its ten parts lead to the same time: as many samples at the
// same times, and the same bits up to there.
TEST(LoadingCycle, OutlivesAStepThatBreaksDown) {
  int solves = 0;
  constexpr int broken = 200;
  SimulationHooks hooks;
  hooks.before_solve = [&](const ContactProblem&) {
    if (++solves == broken) throw SolutionBroken("a velocity is not finite");
  };
  const LoadingLog log = simulate(small_case(), hooks);
  ASSERT_TRUE(log.completed) << log.message;
  EXPECT_EQ(log.numbers.at("repeated_steps"), 1);
  EXPECT_EQ(cycle_log().numbers.at("repeated_steps"), 0);
  const std::vector<double> time = log.signals.column("time"), usual = cycle_log().signals.column("time");
  const std::vector<double> tip = log.signals.column("tip_x"),
                            usual_tip = cycle_log().signals.column("tip_x");
  constexpr std::size_t before = broken - 2;
  ASSERT_GT(time.size(), before);
  for (std::size_t k = 0; k < before; ++k) {
    EXPECT_NEAR(time[k], usual[k], 1e-9);
    const bool whole = usual[k] < (broken - 2) * small_case().world.step;
    if (whole) {
      EXPECT_EQ(tip[k], usual_tip[k]) << k;
    }
  }
  EXPECT_GT(log.cycles[0].loaded_mass, 0);
}

// Throws once in a whole step and once in the first of its ten parts.
SimulationHooks breaking_when(const std::function<bool(const World&)>& due) {
  auto breaks = std::make_shared<int>(0);
  auto armed = std::make_shared<bool>(false);
  SimulationHooks hooks;
  hooks.look_ahead = [=](World& world) { *armed = *armed || (*breaks == 0 && due(world)); };
  hooks.before_solve = [=](const ContactProblem&) {
    if (!*armed) return;
    if (++*breaks == 2) *armed = false;
    throw SolutionBroken("a velocity is not finite");
  };
  return hooks;
}

// A cycle that breaks down, also in parts, with its load in the bucket, is lost and named; the run goes on
// with the next, whose signals and record have its number. The load is taken away, and its share of the
// damage is that of the others. No run scatters so much that five cycles say nothing of its mean, so with a
// precision of 100 % it ends after these, the fewest, and two of the eight that were wanted are left out.
TEST(LoadingCycle, OutlivesACycleThatBreaksDownAndEndsOnceTheMeanIsKnown) {
  Scenario scenario = small_case();
  scenario.cycles = 8;
  scenario.precision = 1;
  const CycleRecord& usual = cycle_log().cycles[0];
  const double late = 0.5 * (usual.stages.back().t_start + usual.t_end);  // the machine backs out
  const LoadingLog log =
      simulate(scenario, breaking_when([&](const World& world) { return world.time() > late; }));
  ASSERT_TRUE(log.completed) << log.message;
  EXPECT_EQ(log.numbers.at("lost_cycles"), 1);
  EXPECT_NE(log.texts.at("lost_cycle_1").find("not finite"), std::string::npos);
  EXPECT_GT(log.numbers.at("cleared_mass"), 0.5 * usual.loaded_mass);
  ASSERT_EQ(log.cycles.size(), 5u);
  EXPECT_EQ(log.numbers.at("left_out_cycles"), 2);
  EXPECT_LE(relative_production_error(log), 1);
  EXPECT_EQ(cycle_log().numbers.at("left_out_cycles"), 0);
  const std::vector<double> time = log.signals.column("time"), number = log.signals.column("cycle");
  for (std::size_t k = 0; k < 5; ++k) {
    const CycleRecord& cycle = log.cycles[k];
    EXPECT_EQ(cycle.number, static_cast<int>(k) + 2);
    EXPECT_GT(cycle.loaded_mass, 0);
    for (std::size_t row = 0; row < time.size(); ++row) {
      const bool within = time[row] > cycle.t_start && time[row] <= cycle.t_end;
      ASSERT_EQ(within, number[row] == cycle.number) << time[row];
    }
  }
  // Every kilogram is somewhere: sums of some 500 masses are off by 500 · 2⁻⁵³ of the pile.
  double gone = log.numbers.at("cleared_mass") + log.numbers.at("escaped_mass"), damage = 0;
  for (const CycleRecord& cycle : log.cycles) gone += cycle.loaded_mass;
  EXPECT_NEAR(log.numbers.at("pile_mass") + log.numbers.at("emitted_mass"),
              gone + log.numbers.at("present_mass"), 1e-12 * log.numbers.at("pile_mass"));
  const DamageOptions soft{.tau_y = 10e3};
  for (const double of_cycle : joint_damage_by_cycle(log, soft)) damage += of_cycle;
  ASSERT_GT(damage, 0);
  EXPECT_DOUBLE_EQ(joint_damage(log, soft), damage * 8 / 5);
}

// Of a single cycle none may be lost.
TEST(LoadingCycle, ARunThatLosesTooManyCyclesFails) {
  const LoadingLog log = simulate(small_case(), breaking_when([](const World&) { return true; }));
  EXPECT_FALSE(log.completed);
  EXPECT_NE(log.message.find("cycle 1 broke down"), std::string::npos) << log.message;
}

// What the caller throws ends the run, however many cycles may be lost.
TEST(LoadingCycle, ACallerEndsTheRun) {
  Scenario scenario = small_case();
  scenario.cycles = 1000;
  SimulationHooks hooks;
  int steps = 0;
  hooks.on_step = [&](const StepReport&) {
    if (++steps == 150) throw std::runtime_error("enough");
  };
  const LoadingLog log = simulate(scenario, hooks);
  EXPECT_FALSE(log.completed);
  EXPECT_EQ(steps, 150);
  EXPECT_NE(log.message.find("enough"), std::string::npos) << log.message;
}

// The file that is there while the second cycle is made ready is the first cycle's log, whole; and twenty pictures
// per second show it.
TEST(LoadingCycle, ARunThatIsKilledLeavesWhatItHadDone) {
  Scenario scenario = small_case();
  scenario.cycles = 2;
  scenario.log_file = std::filesystem::path(testing::TempDir()) / "drawpoint_cycle_killed.h5";
  std::filesystem::remove(scenario.log_file);
  SimulationHooks hooks;
  LoadingLog left;
  hooks.on_step = [&](const StepReport&) {
    if (!std::filesystem::exists(scenario.log_file)) return;
    left = read_log(scenario.log_file);
    throw std::runtime_error("killed");
  };
  EXPECT_FALSE(simulate(scenario, hooks).completed);
  EXPECT_FALSE(left.completed);
  EXPECT_EQ(left.message, "not finished: written after cycle 1 of 2");
  ASSERT_EQ(left.cycles.size(), 1u);
  EXPECT_EQ(left.cycles[0].loaded_rock_masses, cycle_log().cycles[0].loaded_rock_masses);
  EXPECT_EQ(left.signals.values, cycle_log().signals.values);
  EXPECT_EQ(left.scene.frames.size(), cycle_log().scene.frames.size());
  EXPECT_GE(static_cast<double>(left.scene.frames.size()),
            20 * (left.cycles[0].t_end - left.cycles[0].t_start));
  EXPECT_EQ(left.numbers.at("present_mass"), cycle_log().numbers.at("present_mass"));
}

// One rock under the floor, behind the pile, where the machine does not clear its lane, is taken away and counted; a
// tenth of the pile there is failure.
TEST(LoadingCycle, RockThatLeftTheDriftIsCounted) {
  const Scenario scenario = small_case();
  SettledPile pile = prepared_pile(scenario);
  const granular::PlacedRock stray{{0, 0.4}, Eigen::Isometry3d(Eigen::Translation3d(19, 2.6, -3))};
  const double mass = granular::RockLibrary(scenario.pile.density).body(stray.spec).mass;
  pile.rocks.push_back(stray);
  const LoadingLog log = simulate(scenario, pile);
  ASSERT_TRUE(log.completed) << log.message;
  EXPECT_EQ(log.numbers.at("escaped_mass"), mass);
  for (int k = 1; k < 30; ++k) {
    pile.rocks.push_back(stray);
    pile.rocks.back().pose.translation().z() -= 0.5 * k;
  }
  const LoadingLog leaking = simulate(scenario, pile);
  EXPECT_FALSE(leaking.completed);
  EXPECT_NE(leaking.message.find("left the drift"), std::string::npos) << leaking.message;
}

TEST(LoadingCycle, LogNamesTheMoves) {
  const LoadingLog& log = cycle_log();
  const OperatorMoves moves = small_case().executor.moves;
  EXPECT_EQ(log.numbers.at("move_rounds"), moves.rounds);
  EXPECT_EQ(log.numbers.at("most_slip"), moves.most_slip);
  EXPECT_EQ(log.texts.at("moves"), "none");
  EXPECT_EQ(log.numbers.at("crowd"), moves.crowd);
  EXPECT_EQ(log.numbers.at("curl_hold"), moves.curl_hold);
}

// Every signal is finite, the machine's loops hold, and what drives is within its force limits: wheels 4 · 81
// kN m, lift and tilt as their cylinders; limits are impulses divided by the step, and signals are in single
// precision, so round-off of 6e-8 only.
TEST(LoadingCycle, SignalsAreFiniteAndWithinTheMotorLimits) {
  const record::Table& signals = cycle_log().signals;
  ASSERT_GT(signals.rows(), 100u);
  for (double value : signals.values) ASSERT_TRUE(std::isfinite(value));
  const auto largest = [&](const char* name) {
    double most = 0;
    for (double value : signals.column(name)) most = std::max(most, std::abs(value));
    return most;
  };
  const Hydraulics circuit;
  EXPECT_LE(largest("wheel_torque"), 4 * 81e3 * (1 + 1e-7));
  EXPECT_LE(largest("lift_force"), 2 * pushing_force(circuit.lift, circuit.pressure) * (1 + 1e-7));
  EXPECT_LE(largest("tilt_force"), pushing_force(circuit.tilt, circuit.pressure) * (1 + 1e-7));
  // With cylinder drive hinge G is a plain pin: no moment about it, up to round-off of forces of 1e6 N at
  // arms of 1 m.
  EXPECT_LT(largest("hinge_G_torque_y"), 1.0);
}

// Fifteen joints of the tree have six numbers each; what is logged changes nothing of what happens.
TEST(LoadingCycle, LogsTheWrenchInEveryJointWhenAsked) {
  Scenario scenario = small_case();
  scenario.log_all_joints = true;
  const LoadingLog log = simulate(scenario);
  EXPECT_EQ(log.signals.columns.size(), cycle_log().signals.columns.size() + 14 * 6);
  EXPECT_TRUE(log.signals.has("front_left_wheel_joint_force_z"));
  EXPECT_FALSE(cycle_log().signals.has("front_left_wheel_joint_force_z"));
  EXPECT_EQ(joint_damage(log), joint_damage(cycle_log()));
  EXPECT_EQ(production(log), production(cycle_log()));
}

TEST(LoadingCycle, SameScenarioSameBits) {
  const LoadingLog again = simulate(small_case());
  EXPECT_EQ(again.signals.values, cycle_log().signals.values);
  EXPECT_EQ(again.cycles[0].loaded_rock_masses, cycle_log().cycles[0].loaded_rock_masses);
}

// Two cycles: the first cycle is that of the one-cycle run bit for bit, the bucket's rocks are gone and the
// raise has made up for them, but for at most the heaviest rock (550 kg) too much. Other seeds give other rocks, which
// come from when the machine backs out: until then nothing differs.
TEST(LoadingCycle, RefillsBetweenCyclesBySeed) {
  Scenario scenario = small_case();
  scenario.cycles = 2;
  const LoadingLog log = simulate(scenario);
  ASSERT_TRUE(log.completed) << log.message;
  ASSERT_EQ(log.cycles.size(), 2u);
  EXPECT_EQ(log.cycles[0].loaded_rock_masses, cycle_log().cycles[0].loaded_rock_masses);
  EXPECT_GT(log.cycles[1].t_start, log.cycles[0].t_end + 0.1 - 1e-9);
  EXPECT_GT(log.scene.bodies.size(), cycle_log().scene.bodies.size());
  scenario.seed = 2;
  const LoadingLog other = simulate(scenario);
  ASSERT_TRUE(other.completed) << other.message;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(other.cycles[0].stages[k].t_end, log.cycles[0].stages[k].t_end);
    EXPECT_EQ(other.cycles[0].stages[k].end.x, log.cycles[0].stages[k].end.x);
  }
  EXPECT_NE(other.cycles[1].loaded_rock_masses, log.cycles[1].loaded_rock_masses);
}

TEST(LoadingCycle, ScenesHaveNames) {
  for (const std::string_view name : scene_names)
    EXPECT_NO_THROW(check(scene_named(std::string(name)))) << name;
  EXPECT_EQ(scene_named("lindmark2016").drift.width, lh621_at_lindmark2016_scale().drift.width);
  EXPECT_THROW(scene_named("large"), std::invalid_argument);
}

TEST(LoadingCycle, RefusesABadScenarioByName) {
  Scenario scenario = small_case();
  scenario.drift.width = 2;
  try {
    simulate(scenario);
    FAIL() << "a drift narrower than the machine was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "loading::Drift: width is 2.000000 m; allowed: 3.6 m (bucket and clearance) to 20 m");
  }
}

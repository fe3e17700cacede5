// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <drawpoint/engine/loading/arm_linkage.hpp>
#include <drawpoint/engine/loading/lhd.hpp>
#include <drawpoint/engine/world/world.hpp>
#include <drawpoint/tests/end_to_end/support.hpp>

using namespace drawpoint;
using namespace drawpoint::test;

/// The commands of benchmarks/scenario, run as scripts run them, on scenes that take seconds at most.
namespace {

const std::string pile = PILE_SCENARIO, table = MASS_RATIO_TABLE, study = ACCURACY_STUDY, fill = BUCKET_FILL,
                  sweep = STRATEGY_SWEEP, ledger = RUN_LEDGER, sheet = DATA_SHEET;
const std::string tiny = pile + " --rocks 40 --settle 60 --steps 20 --dig 20 --json";

using ScenarioCommands = StudyTest;

void expect_number(const nlohmann::json& j, const char* key, double low, double high) {
  ASSERT_TRUE(j.contains(key)) << key;
  ASSERT_TRUE(j[key].is_number()) << key;
  EXPECT_GE(j[key].get<double>(), low) << key;
  EXPECT_LE(j[key].get<double>(), high) << key;
}

}  // namespace

// Ten of twenty steps take the median or more, and a step a nanosecond at least for each of forty contacts.
TEST_F(ScenarioCommands, PilePrintsOneObjectWithItsFields) {
  const auto start = std::chrono::steady_clock::now();
  const Ended run = this->run(tiny);
  const double wall =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 1);
  EXPECT_TRUE(run.err.empty()) << run.err;  // no progress without a terminal
  const nlohmann::json j = run.json();
  expect_number(j, "ms_rest", 40e-6, wall / 10);
  expect_number(j, "ms_dig", 40e-6, wall / 20);
  expect_number(j, "contacts", 40, 40 * 40);  // every rock lies on something
  expect_number(j, "overlap_p99", 0, j["overlap_max"]);
  expect_number(j, "overlap_mean", 0, j["overlap_max"]);
  expect_number(j, "overlap_max", 0, 1);
  expect_number(j, "dig_overlap_p99", 0, 1);
  expect_number(j, "drift_mm_s", 0, j["drift_worst_mm_s"]);
  expect_number(j, "kinetic_energy_per_rock_j", 0, 1e3);
  EXPECT_EQ(j.at("hash").get<std::string>().size(), 16u);
  EXPECT_EQ(j.at("rest_steps"), 20);
}

TEST_F(ScenarioCommands, PileDefaultsAreTheEngines) {
  const nlohmann::json j = run(pile + " --rocks 2 --settle 1 --steps 1 --dig 1 --json").json();
  const engine::WorldOptions options;
  EXPECT_EQ(j.at("dt_s"), options.step);
  EXPECT_EQ(j.at("method"), to_string(options.solver.method));
  EXPECT_EQ(j.at("substeps"), options.solver.substeps);
  EXPECT_EQ(j.at("iterations"), options.solver.iterations);
  EXPECT_EQ(j.at("tolerance"), options.solver.tolerance);
  EXPECT_EQ(j.at("threads"), options.threads);
}

// The pile on which versions and engines are compared keeps its rock, the upper bound of what blasted ore may have
// (docs/decisions/0019), whatever the loading case takes.
TEST_F(ScenarioCommands, PileMaterialIsTheBoundOfOreUnlessTold) {
  const nlohmann::json j = run(pile + " --rocks 2 --settle 1 --steps 1 --dig 1 --json").json();
  EXPECT_EQ(j.at("rolling"), 0.1);
  EXPECT_EQ(j.at("spinning"), 0);
  const nlohmann::json other = run(tiny + " --rolling 0.5 --spinning 0.25").json();
  EXPECT_EQ(other.at("rolling"), 0.5);
  EXPECT_EQ(other.at("spinning"), 0.25);
}

TEST_F(ScenarioCommands, PileHashTellsRunsApart) {
  const auto hash = [&](const std::string& flags) { return run(tiny + flags).json().at("hash"); };
  const nlohmann::json once = hash("");
  EXPECT_EQ(hash(""), once);
  EXPECT_EQ(hash(" --threads 2"), once);
  for (const char* flags : {" --seed 2", " --rolling 0", " --spinning 0.1", " --iterations 10",
                            " --substeps 2", " --dt 0.004", " --tolerance 0.02"})
    EXPECT_NE(hash(flags), once) << flags;
}

TEST_F(ScenarioCommands, PileWithoutJsonPrintsATable) {
  const Ended run = this->run(pile + " --rocks 5 --settle 5 --steps 5 --dig 5");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "5 rocks"));
  EXPECT_TRUE(contains(run.out, "16 x 1 iterations to 1e-05"));
  EXPECT_TRUE(contains(run.out, "ms per step"));
}

// Each leg carries less than 1 kN at 1:1, which presses a pair of bodies of 1e9 N/m by less than 1e-6 m. The
// solver adds about 3 n/N g h² for n = 2 bodies on top of each other and N iterations: 6e-5 m with 25
// iterations at 5 ms. Both together are below 1e-4 m at each of the two joints: 5e-4 of the small cube, and
// 2e-4 m in height.
TEST_F(ScenarioCommands, TableOfEqualMassesStands) {
  const Ended run = this->run(table + " --ratio 1 --dt 0.005 --substeps 1 --iterations 25 --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const nlohmann::json j = run.json();
  EXPECT_DOUBLE_EQ(j.at("expected_height_m"), 0.32);
  expect_number(j, "height_m", 0.32 - 2e-4, 0.32 + 2e-4);
  expect_number(j, "overlap_fraction", 0, 5e-4);
  expect_number(j, "overlap_fraction_peak", j["overlap_fraction"], 1);
}

TEST_F(ScenarioCommands, StudyComparesWithItsReference) {
  const Ended run = this->run(study +
                              " --rocks 20 --seeds 2 --settings 10x1x5,10x4x1+50 --reference 10x1x20 --json"
                              " --reference-method batched --jobs 2");
  ASSERT_EQ(run.code, 0) << run.err;
  const nlohmann::json rows = run.json().at("configurations");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("name"), "reference");
  EXPECT_EQ(rows[0].at("mass_moved_kg_difference").at("mean"), 0);
  EXPECT_EQ(rows[1].at("name"), "replicate");
  EXPECT_EQ(rows[2].at("iterations"), 5);
  EXPECT_EQ(rows[3].at("setting"), "10x4x1+50");
  EXPECT_EQ(rows[3].at("iteration_budget"), 50);
  for (const nlohmann::json& row : rows) EXPECT_EQ(row.at("method"), "batched");
  EXPECT_TRUE(rows[2].at("drag_n").at("half_width").is_number());
}

// On a pile of 12 t, that is all a bucket could take: the table is there, and the pile is kept and found
// again.
TEST_F(ScenarioCommands, FillCountsWhatTheBucketLoads) {
  const std::string line =
      fill + " --piles " + (dir() / "piles").string() + " --mass 12 --seeds 1 --alphas 0.5 --json";
  const Ended run = this->run(line);
  ASSERT_EQ(run.code, 0) << run.err;
  const nlohmann::json row = run.json().at("rows").at(0);
  EXPECT_EQ(row.at("alpha"), 0.5);
  EXPECT_EQ(row.at("cycles"), 1);
  expect_number(row, "loaded_kg", 0, 13e3);
  expect_number(row, "cycle_s", 1, 60);
  expect_number(run.json().at("pile"), "angle_deg", 0, 60);
  EXPECT_EQ(this->run(line).json().at("rows"), run.json().at("rows"));
}

// Two cycles with the laws of the source: every kilogram is somewhere, but for the round-off of some thousand sums of
// numbers up to 1e5, and what the motors give is gained or dissipated.
TEST_F(ScenarioCommands, LedgerAccountsForRockAndWork) {
  const std::string logs = (dir() / "logs").string();
  const Ended made = run(fill + " --piles " + (dir() / "piles").string() + " --logs " + logs +
                         " --mass 12 --seeds 1 --alphas 0.5 --cycles 2 --arm hinges --progress faithful");
  ASSERT_EQ(made.code, 0) << made.err;
  const auto log = std::filesystem::directory_iterator(logs)->path();
  const Ended run = this->run(ledger + " " + log.string() + " --json");
  ASSERT_EQ(run.code, 0) << run.err;
  const nlohmann::json j = run.json();
  EXPECT_EQ(j.at("cycles").size(), 2);
  expect_number(j.at("rock"), "missing_kg", -1e-6, 1e-6);
  const nlohmann::json& energy = j.at("energy");
  const double gained = energy.at("machine_kJ").get<double>() + energy.at("rock_kJ").get<double>();
  expect_number(energy, "work_kJ", 1, 1e5);
  EXPECT_NEAR(energy.at("dissipated_kJ"), energy.at("work_kJ").get<double>() - gained, 1e-6);
  expect_number(j.at("errors"), "loop_gap_mm", 0, 0.1);
  EXPECT_TRUE(contains(this->run(ledger + " " + log.string()).out, "missing"));
  const Ended none = this->run(ledger + " " + (dir() / "none.h5").string());
  EXPECT_EQ(none.code, 1);
  EXPECT_TRUE(contains(none.err, "none.h5")) << none.err;
}

// What the docs keep is what the machine is, to the four digits that are printed. Axles carry the whole mass. Breakout
// by tilt again from the lever of the linkage, which knows no weights but the bucket's: bell-crank, link and cylinder
// take some kN m of 650.
TEST_F(ScenarioCommands, DataSheetIsThatOfTheDocs) {
  const Ended printed = run(sheet);
  ASSERT_EQ(printed.code, 0) << printed.err;
  EXPECT_EQ(printed.out, contents(MACHINE_SHEET));
  const auto value = [&](const std::string& quantity) {
    const std::size_t at = printed.out.find("\"" + quantity + "\",");
    EXPECT_NE(at, std::string::npos) << quantity;
    return std::stod(printed.out.substr(printed.out.find(',', at + quantity.size() + 3) + 1));
  };
  EXPECT_NEAR(value("front axle, empty, bucket on the floor") + value("rear axle, empty"),
              value("operating mass"), 0.01);
  EXPECT_NEAR(value("rear axle, empty") / value("operating mass"), 0.56, 1e-3);
  using namespace engine::loading;
  const ArmLinkage arm;
  const Eigen::Vector2d boom = arm.G - arm.F;
  const double push = pushing_force(Hydraulics{}.tilt, Hydraulics{}.pressure),
               weight = 9.81 * bucket_mass({}) * (bucket_centre({}).x() - arm.G.x()),
               lever = sandvik_lh621().K.x() - arm.G.x();
  const double tilt = (push * tilt_lever(arm, std::atan2(boom.y(), boom.x()), 0) - weight) / lever;
  EXPECT_NEAR(1e3 * value("breakout at the edge, tilt") / tilt, 1, 0.02);
  EXPECT_NEAR(value("thrust at 1.4 m/s"), 0.73 * 382 / 1.4, 0.5);
}

TEST_F(ScenarioCommands, WrongUsageNamesValueAndRange) {
  const auto refused = [&](const std::string& line, const std::string& value, const std::string& range) {
    const Ended run = this->run(line);
    EXPECT_EQ(run.code, 2) << line;
    EXPECT_TRUE(run.out.empty()) << line;
    EXPECT_TRUE(contains(run.err, value));
    EXPECT_TRUE(contains(run.err, range));
  };
  refused(pile + " --rocks 0", "--rocks: \"0\"", "1 to 100000");
  refused(pile + " --rocks many", "--rocks: \"many\"", "1 to 100000");
  refused(pile + " --dt 0.5", "--dt: \"0.5\"", "1e-05 to 0.1 s");
  refused(pile + " --dt nan", "--dt: \"nan\"", "1e-05 to 0.1 s");
  refused(pile + " --settle -1", "--settle: \"-1\"", "1 to 1e+07 steps");
  refused(pile + " --iterations 0", "--iterations: \"0\"", "1 to 1e+06");
  refused(pile + " --threads 0", "--threads: \"0\"", "1 to 256");
  refused(pile + " --method fastest", "\"fastest\"", "sequential, batched");
  refused(pile + " --rock 5", "--rock", "--help");
  refused(pile + " --rolling -1", "--rolling: \"-1\"", "0 to 2");
  refused(fill + " --piles x --materials gravel", "gravel", "calibrated,lindmark2016");
  refused(fill + " --seeds 1", "--piles", "--help");
  refused(sweep + " --piles x --vary delta", "delta", "alpha,beta,gamma,kappa");
  refused(sweep + " --piles x --vary beta --values 0.5,2", "beta is 2", "0 to 1");
  refused(study + " --windows x --length 9", "--length: \"9\"", "0.05 to 5 s");
  refused(table + " --ratio 0", "--ratio: \"0\"", "0.001 to 1e+06");
  refused(study + " --settings 10x16x1,20x1x1", "\"20x1x1\"", "0.01 to 10 ms");
  refused(study + " --settings 10x16", "\"10x16\"", "STEPxSUBSTEPSxITERATIONS");
  refused(study + " --reference 10x1x0", "\"10x1x0\"", "1 to 1000000 iterations");
}

TEST_F(ScenarioCommands, HelpTeaches) {
  for (const std::string& program : {pile, table, study}) {
    const Ended run = this->run(program + " --help");
    EXPECT_EQ(run.code, 0);
    EXPECT_TRUE(contains(run.out, "Fields of --json"));
    EXPECT_TRUE(contains(run.out, "--method"));
  }
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "command.hpp"
#include "estimate.hpp"
#include "estimate_json.hpp"
#include "interrupt.hpp"
#include "rock_tests.hpp"

/// The calibration of rock: what coefficients give, beside what is published. See --help.
using namespace drawpoint;
using namespace drawpoint::benchmarks;
using engine::granular::RockSample;
using engine::granular::RunStatus;

namespace {

constexpr const char* about =
    "What friction and rolling resistance make of rock: one test of soil mechanics for every pair of\n"
    "coefficients, with the spread over seeds, beside what is published for blasted rock and rockfill.\n\n"
    "  calibrate_rock --test repose                             the coefficients of the mine, three heaps\n"
    "  calibrate_rock --test shear --friction 0.5,0.7,0.9 --rolling 0,0.1,0.3 --sizes 0.3\n"
    "                                                           a table over both\n"
    "  calibrate_rock --test repose --sizes mine --rocks 1200   the sizes of the mine, 0.3 to 0.8 m\n"
    "  calibrate_rock --test shear --dt 0.005 --iterations 20   the same, solved harder: has it "
    "converged?\n\n"
    "Tests:\n"
    "  repose       a heap poured slowly on a rough floor: angle of repose\n"
    "  ledge        the bank that is left on a ledge when the end of a bin is taken away\n"
    "  tilt         a filled box tilted slowly: angle at which its bed slides\n"
    "  density      loosely filled rough box, its core: bulk density, porosity, swell; porosity of all of "
    "it\n"
    "  shear        direct shear of a large box under --stress: angle of friction at the peak and over the\n"
    "               last third of the way, mean dilation, normal stress on the cut\n"
    "  penetration  an upright plate pushed down into a bed: force, work; nothing published\n"
    "  edge         a level edge driven along the floor into a bank, as a bucket's: slope before, force, "
    "work\n\n"
    "Figures are mean +- standard error over the seeds (with one seed: none). A row marked * has runs whose\n"
    "rocks had not come to rest. Ctrl-C ends after the step in hand; the seeds that are complete are "
    "printed.\n"
    "A seed that fails is left out: its error goes to stderr, its number into the row, and the exit code is "
    "1.\n"
    "Fields of --json: rows with friction, rolling, seeds (how many are complete), failed (their numbers),\n"
    "rocks, moving (runs not at rest), and each quantity as\nmean, standard_error and values; published with "
    "low, high and source.";

struct Settings {
  EngineFlags engine;
  std::string test = "repose", sizes = "0.3";
  std::vector<double> friction = {0.7}, rolling = {0};
  double spinning = 0, density = 4500;
  int seeds = 3;
  RockTestOptions options;
  bool json = false;
};

bool is_size_name(const std::string& text) {
  const auto& names = engine::granular::size_names;
  return std::find(names.begin(), names.end(), text) != names.end();
}

engine::granular::SizeDistribution sizes_of(const std::string& text) {
  return is_size_name(text) ? engine::granular::sizes_named(text)
                            : engine::granular::single_size(std::stod(text));
}

std::string wrong_sizes(const std::string& text) {
  if (is_size_name(text)) return "";
  std::string copy = text;  // a validator may change what it checks
  return between(0.05, 5, "m",
                 "or choose mine (0.3 to 0.8 m by mass), mine_with_fines (from 0.2 m), mine_with_small_fines "
                 "(from 0.1 m) or well_broken (0.2 to 0.5 m)")(copy);
}

struct Row {
  double friction, rolling;
  int rocks = 0, moving = 0;
  std::vector<std::vector<double>> values;  // by seed that did not fail, by quantity
  std::vector<int> failed;                  // seeds
};

RockSample sample_of(const Settings& s, const Row& row) {
  RockSample sample;
  sample.contact.friction = row.friction;
  sample.contact.rolling = row.rolling;
  sample.contact.spinning = s.spinning;
  sample.density = s.density;
  sample.sizes = sizes_of(s.sizes);
  return sample;
}

std::string name_of(const Row& row, int seed) {
  return "friction " + std::to_string(row.friction).substr(0, 4) + ", rolling " +
         std::to_string(row.rolling).substr(0, 4) + ", seed " + std::to_string(seed);
}

RockTestRun run_seed(const Settings& s, const RockTest& test, const Row& row, int seed) {
  Progress progress;
  std::stop_source source;
  RockTestOptions options = s.options;
  options.run.world = world_options(s.engine);
  options.run.seed = static_cast<std::uint64_t>(seed);
  options.run.stop = source.get_token();
  options.run.progress = [&](std::string_view phase, double done) {
    if (interrupted()) source.request_stop();
    progress.show(name_of(row, seed) + ": " + std::string(phase) + " %", static_cast<int>(100 * done), 100);
  };
  return test.run(sample_of(s, row), options);
}

// Whether the row was not stopped. One seed that fails takes no other's figures away.
bool run_row(const Settings& s, const RockTest& test, Row& row) {
  for (int seed = 1; seed <= s.seeds; ++seed) {
    try {
      const RockTestRun run = run_seed(s, test, row, seed);
      if (run.status == RunStatus::stopped) return false;
      row.rocks = run.rocks;
      row.moving += run.status == RunStatus::moving ? 1 : 0;
      row.values.push_back(run.values);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "calibrate_rock: %s: %s\n", name_of(row, seed).c_str(), error.what());
      row.failed.push_back(seed);
    }
  }
  return true;
}

std::vector<Row> run_rows(const Settings& s, const RockTest& test) {
  std::vector<Row> rows;
  for (const double friction : s.friction)
    for (const double rolling : s.rolling) {
      Row row{.friction = friction, .rolling = rolling, .values = {}, .failed = {}};
      const bool complete = run_row(s, test, row);
      if (!row.values.empty() || !row.failed.empty()) rows.push_back(row);
      if (!complete) return rows;
    }
  return rows;
}

nlohmann::json finite_or_null(double value) {
  if (std::isfinite(value)) return value;
  return nullptr;
}

nlohmann::json row_as_json(const RockTest& test, const Row& row) {
  nlohmann::json out{{"friction", row.friction}, {"rolling", row.rolling}, {"seeds", row.values.size()},
                     {"failed", row.failed},     {"rocks", row.rocks},     {"moving", row.moving}};
  for (std::size_t k = 0; k < test.quantities.size(); ++k) {
    std::vector<double> values;
    for (const auto& run : row.values) values.push_back(run[k]);
    nlohmann::json all = nlohmann::json::array();
    for (const double v : values) all.push_back(finite_or_null(v));
    const double mean = values.empty() ? std::nan("") : mean_of(values);
    out[test.quantities[k].key] = {{"mean", finite_or_null(mean)},
                                   {"standard_error", finite_or_null(standard_error(values))},
                                   {"values", all}};
  }
  return out;
}

nlohmann::json published(const RockTest& test) {
  nlohmann::json out = nlohmann::json::object();
  for (const MeasuredQuantity& q : test.quantities)
    if (q.high > 0) out[q.key] = {{"low", q.low}, {"high", finite_or_null(q.high)}, {"source", q.source}};
  return out;
}

// "35 to 42", "at least 35"
std::string range_of(const MeasuredQuantity& q) {
  char text[64];
  if (std::isfinite(q.high))
    std::snprintf(text, sizeof text, "%g to %g", q.low, q.high);
  else
    std::snprintf(text, sizeof text, "at least %g", q.low);
  return text;
}

void print_table(const RockTest& test, const nlohmann::json& j) {
  std::printf("%s; sizes %s; %s\n%8s %8s %6s %6s ", test.what.c_str(),
              j.at("sizes").get<std::string>().c_str(), in_words(j.at("engine")).c_str(), "friction",
              "rolling", "seeds", "rocks");
  for (const MeasuredQuantity& q : test.quantities) std::printf(" %17s", q.title.c_str());
  std::printf("\n");
  for (const nlohmann::json& row : j.at("rows")) {
    std::printf("%8g %8g %6d %6d%s", row.at("friction").get<double>(), row.at("rolling").get<double>(),
                row.at("seeds").get<int>(), row.at("rocks").get<int>(),
                row.at("moving").get<int>() > 0 ? "*" : " ");
    for (const MeasuredQuantity& q : test.quantities)
      std::printf(" %17s",
                  plus_minus(row.at(q.key).at("mean"), row.at(q.key).at("standard_error"), q.digits).c_str());
    if (!row.at("failed").empty()) std::printf("  failed: seeds %s", row.at("failed").dump().c_str());
    std::printf("\n");
  }
  for (const MeasuredQuantity& q : test.quantities)
    if (q.high > 0)
      std::printf("published %s: %s; %s\n", q.title.c_str(), range_of(q).c_str(), q.source.c_str());
}

int run(const Settings& s) {
  constexpr int failed_exit = 1;
  const RockTest& test = rock_test_named(s.test);
  const std::vector<Row> rows = run_rows(s, test);
  nlohmann::json out{{"test", s.test},
                     {"sizes", s.sizes},
                     {"density_kg_m3", s.density},
                     {"spinning", s.spinning},
                     {"edge_friction", s.options.edge_friction},
                     {"rough_walls", s.options.rough_walls},
                     {"engine", described(world_options(s.engine))},
                     {"published", published(test)},
                     {"rows", nlohmann::json::array()}};
  for (const Row& row : rows) out["rows"].push_back(row_as_json(test, row));
  const int code = show(out, s.json, [&](const nlohmann::json& j) { print_table(test, j); });
  if (interrupted()) return interrupted_exit;
  const auto has_failed = [](const Row& row) { return !row.failed.empty(); };
  return std::any_of(rows.begin(), rows.end(), has_failed) ? failed_exit : code;
}

}  // namespace

int main(int argc, char** argv) {
  Settings s;
  CLI::App app(about, "calibrate_rock");
  app.add_option("--test", s.test, "repose, ledge, tilt, density, shear, penetration or edge")
      ->check(taken_by(rock_test_named))
      ->capture_default_str();
  app.add_option("--friction", s.friction, "of rock on rock and rough walls [1], with commas between")
      ->delimiter(',')
      ->check(between(0, 2, "", "0.5 to 0.9 is rock"))
      ->capture_default_str();
  app.add_option("--rolling", s.rolling, "rolling resistance [1], with commas between")
      ->delimiter(',')
      ->check(between(0, 2, "", "0 to 0.1 is calibrated ore"))
      ->capture_default_str();
  app.add_option("--spinning", s.spinning, "spinning resistance [1]")
      ->check(between(0, 2, "", "0 is usual"))
      ->capture_default_str();
  app.add_option(
         "--sizes", s.sizes,
         "longest dimension of all rocks [m], or mine, mine_with_fines, mine_with_small_fines or well_broken")
      ->check(wrong_sizes)
      ->capture_default_str();
  app.add_option("--density", s.density, "of the solid rock [kg/m3]")
      ->check(between(100, 20000, "kg/m3", "iron ore has 4300 to 4900"))
      ->capture_default_str();
  app.add_option("--seeds", s.seeds, "runs, seeds 1, 2, ...")
      ->check(between(1, 1000, "", "3 and more give an idea of the spread"))
      ->capture_default_str();
  app.add_option("--rocks", s.options.rocks, "repose: rocks in the heap")
      ->check(between(20, 100'000, "", "300 of one size, 1200 of the mine's"))
      ->capture_default_str();
  app.add_option("--stress", s.options.stress, "shear: normal stress [Pa]")
      ->check(between(100, 1e7, "Pa", "a pile presses 10 to 100 kPa"))
      ->capture_default_str();
  app.add_option("--edge-friction", s.options.edge_friction, "edge: of rock on the edge [1]")
      ->check(between(0, 2, "", "0.5 is steel"))
      ->capture_default_str();
  app.add_flag("--rough-walls", s.options.rough_walls,
               "edge: walls as rough as rock, in place of smooth ones");
  add_engine_flags(app, s.engine);
  add_json_flag(app, s.json);
  watch_for_interrupt();
  return run_command(app, argc, argv, [&] { return run(s); });
}

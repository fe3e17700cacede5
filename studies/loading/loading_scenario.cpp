// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <drawpoint/studies/loading/loading_scenario.h>
#include <drawpoint/engine/loading/loading_cycle.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>

namespace drawpoint::studies {
namespace {

using engine::loading::Scenario;

const std::string& chosen(const RunContext& run, const std::string& option) {
  const auto found = run.options.find(option);
  if (found == run.options.end())
    throw std::invalid_argument("studies::loading_scenario: option \"" + option +
                                "\" has no value; give one for each of loading_options()");
  return found->second;
}

bool solved_loosely(const std::string& solver) {
  if (solver != "scene" && solver != "lindmark2016")
    throw std::invalid_argument("studies::loading_scenario: option \"solver\" is \"" + solver +
                                "\"; choose scene or lindmark2016");
  return solver == "lindmark2016";
}

constexpr std::array<std::string_view, 2> motion_names = {"pictures", "full"}, yes_or_no = {"no", "yes"},
                                          place_names = {"free", "columns"};

// What a skilled operator's numbers are given in.
constexpr double cm = 0.01;

std::string in_cm(double value) { return std::to_string(std::lround(value / cm)); }

/// A number of the skilled operator, by default his own.
StudyOption of_operator(const std::string& name, const std::string& help, const std::string& own, int least,
                        int most) {
  return {.name = name,
          .help = help + "; of --operator skilled",
          .value = own,
          .least = least,
          .most = most,
          .before = own};
}

const std::array<StudyOption, 3>& operator_numbers() {
  const auto skilled = engine::loading::skilled_operator();
  static const std::array<StudyOption, 3> numbers = {
      of_operator("operator-rounds",
                  "lift, curl, dump and curl again, so often at most in a drive-in that is held up",
                  std::to_string(skilled.rounds), 1, 100),
      of_operator("operator-crowd", "cm/s that the drive pushes at while the bucket curls",
                  in_cm(skilled.crowd), 0, 400),
      of_operator("operator-slip", "cm/s of the wheels, beyond which the throttle is eased",
                  in_cm(skilled.most_slip), 1, 1000)};
  return numbers;
}

engine::loading::OperatorMoves operator_of(const RunContext& run) {
  auto moves = engine::loading::operator_named(chosen(run, "operator"));
  if (moves.round.empty()) return moves;
  moves.rounds = std::stoi(chosen(run, "operator-rounds"));
  moves.crowd = cm * std::stod(chosen(run, "operator-crowd"));
  moves.most_slip = cm * std::stod(chosen(run, "operator-slip"));
  return moves;
}

/// One of two ways that the program has, the first by default; folders of before the option have the one that `before`
/// is the place of.
StudyOption choice(const std::string& name, const std::string& help,
                   const std::array<std::string_view, 2>& names, std::size_t before = 0) {
  return {.name = name,
          .help = help,
          .value = std::string(names.front()),
          .choices = {names.begin(), names.end()},
          .before = std::string(names[before])};
}

}  // namespace

std::vector<StudyOption> loading_options() {
  return {
      {"materials",
       "contact coefficients",
       "calibrated",
       {engine::loading::material_names.begin(), engine::loading::material_names.end()}},
      {.name = "rock-friction",
       .help = "per cent of what --materials have on rock, floor, steel and tyre: a mine's own rock is "
               "rougher or smoother",
       .value = "100",
       .least = 10,
       .most = 200,
       .before = "100"},
      {"solver",
       "contacts: solved as far as force and load need it, or as loosely as in Lindmark (2016), whose "
       "materials need it",
       "scene",
       {"scene", "lindmark2016"}},
      {"scene",
       "drift and pile: 120 t in 6 m, or the scale of Lindmark (2016), 290 t in 7 m",
       "small",
       {engine::loading::scene_names.begin(), engine::loading::scene_names.end()}},
      {"sizes",
       "of the rocks: 0.3 to 0.8 m as in Lindmark (2016), half of it boulders; with a quarter of the "
       "mass as 0.2 m; with a tenth as 0.1 m; or broken well, 0.2 to 0.5 m. That is three, eight and four "
       "times as many rocks, and more than so many times the time",
       "mine",
       {engine::granular::size_names.begin(), engine::granular::size_names.end()}},
      {"speeds",
       "what drive, boom and bucket are set to: for the 12 s cycles of Lindmark (2016), or what the "
       "machine can do",
       "lindmark2016",
       {engine::loading::speed_names.begin(), engine::loading::speed_names.end()}},
      {"operator",
       "what is done beside the plan: nothing, or the moves of a skilled operator, who drops the edge back "
       "into the rock",
       "plan",
       {engine::loading::operator_names.begin(), engine::loading::operator_names.end()}},
      operator_numbers()[0],
      operator_numbers()[1],
      operator_numbers()[2],
      {.name = "pile-mass",
       .help = "t of rock in the drift, 10 or more; with --scene lindmark2016 800 choke the raise. 0: the "
               "scene's",
       .value = "0",
       .least = 0,
       .most = 10'000,
       .before = "0"},
      {.name = "pile",
       .help = "which one is poured, by the seed of its rocks: another is as good, and none of the study's "
               "runs saw it",
       .value = "1",
       .least = 1,
       .most = 1'000'000,
       .before = "1"},
      choice(
          "curl",
          "the bucket turns about its hinge; or its edge stays and the hinge sinks, as in Lindmark (2016), "
          "which a low edge forbids",
          engine::loading::curl_names),
      choice("lift",
             "aims behind the pile's surface, from wherever the drive-in ended; or goes by what was planned "
             "from there, as in Lindmark (2016)",
             engine::loading::lift_names),
      choice("lift-end",
             "a slow drive ends a lift only where the arm stands too; or any slow actuator does, as in "
             "Lindmark (2016)",
             engine::loading::lift_end_names, 1),
      choice("whole-cycle",
             "approach, way back and standing counted by the machine's own law; or simulated too, for films: "
             "half as "
             "much time again and more",
             yes_or_no, 1),
      choice("progress",
             "of a stage: along its goal; or as Lindmark (2016) prints it, with which stages end by their "
             "time limit",
             engine::loading::progress_names),
      choice("places",
             "across the drift: a centimetre apart; or a column's width of 25 cm, to which Lindmark (2016) "
             "rounds gamma",
             place_names),
      choice("arm", "what moves it: its cylinders, or motors in its hinges as in Lindmark (2016)",
             engine::loading::arm_drive_names),
      choice(
          "motion",
          "what run logs keep of it: pictures, 20 per second and 2 cm true, and the load of the bucket's "
          "hinge; or full: every step as it was, and the load of every joint of the tree, 6 MB per cycle of "
          "120 t in place of 0.6",
          motion_names),
      {.name = "cycles", .help = "loading cycles per run", .value = "3", .least = 1, .most = 1000},
      {.name = "precision",
       .help = "per cent: a run ends after five cycles or more once the standard error of its mean "
               "production, haul left out, is at most this; --cycles is then the most, 6 or more, and joint "
               "damage is that of so many. 0: all cycles",
       .value = "0",
       .least = 0,
       .most = 100,
       .before = "0"},
      {.name = "yield-torque",
       .help = "kN m in the bucket's hinge, above which a joint is damaged: 145 in Lindmark (2016); "
               "benchmarks/yield_torque says what a crash gives for this machine",
       .value = "145",
       .least = 1,
       .most = 1'000'000,
       .of_responses = true},
      {.name = "damage",
       .help = "by the whole torque in the bucket's hinge, the tilt drive's moment included, as in Lindmark "
               "(2016), or by "
               "what twists the bucket alone",
       .value = "all",
       .choices = {engine::loading::torque_component_names.begin(),
                   engine::loading::torque_component_names.end()},
       .of_responses = true},
      {.name = "spill",
       .help = "rock that the bucket took and lost; or, as in Lindmark (2016), all rock before the pile's "
               "front, which "
               "measures how ragged the toe is",
       .value = "lost",
       .choices = {engine::loading::spill_law_names.begin(), engine::loading::spill_law_names.end()},
       .of_responses = true},
      {.name = "haul",
       .help =
           "s per cycle for haul, dump and way back, which production counts; 0 as in Lindmark (2016), where "
           "loading alone counts",
       .value = "0",
       .least = 0,
       .most = 86'400,
       .of_responses = true}};
}

Preset lindmark2016_preset() {
  return {.name = "lindmark2016",
          .help =
              "all that Lindmark (2016) prints: materials and solver, a raise choked by 800 t, speeds, "
              "motors in the "
              "hinges, planner, executor and responses; thirty cycles",
          .values = {{"materials", "lindmark2016"},
                     {"solver", "lindmark2016"},
                     {"scene", "lindmark2016"},
                     {"pile-mass", "800"},
                     {"speeds", "lindmark2016"},
                     {"operator", "plan"},
                     {"curl", "tip"},
                     {"lift", "slope"},
                     {"lift-end", "any"},
                     {"whole-cycle", "yes"},
                     {"progress", "faithful"},
                     {"places", "columns"},
                     {"arm", "hinges"},
                     {"cycles", "30"},
                     {"yield-torque", "145"},
                     {"damage", "all"},
                     {"spill", "before_front"},
                     {"haul", "0"}}};
}

std::string loading_options_complaint(const OptionValues& options) {
  const std::string &precision = options.at("precision"), &cycles = options.at("cycles");
  if (precision != "0" && std::stoi(cycles) <= engine::loading::least_cycles_to_end)
    return "--precision " + precision + " with --cycles " + cycles +
           ": a run may end after five cycles, so that allowed are 6 or more; give --cycles 30, or no "
           "--precision";
  const int mass = std::stoi(options.at("pile-mass"));
  if (mass > 0 && mass < 10)
    return "--pile-mass " + std::to_string(mass) +
           ": allowed are 10 t (a bucket load) to 10 000 t, or 0 for the scene's";
  if (const auto operated = options.find("operator"); operated != options.end() && operated->second == "plan")
    for (const StudyOption& number : operator_numbers())
      if (options.at(number.name) != number.value)
        return "--" + number.name + " " + options.at(number.name) +
               ": the plan alone has no such moves; give --operator skilled too";
  const auto arm = options.find("arm");  // of bucket and speed together: always cylinders
  if (arm != options.end() && arm->second == "hinges" && options.at("speeds") == "machine")
    return "--arm hinges with --speeds machine: its pump drives cylinders, and motors in the hinges have "
           "none; "
           "give --arm cylinders, or --speeds lindmark2016";
  return "";
}

Scenario loading_scenario(const RunContext& run) {
  Scenario scenario = engine::loading::scene_named(chosen(run, "scene"));
  const double mass = 1e3 * std::stod(chosen(run, "pile-mass"));
  scenario = engine::loading::with_pile_of(scenario, mass > 0 ? mass : scenario.pile.mass,
                                           engine::granular::sizes_named(chosen(run, "sizes")));
  scenario.pile.seed = static_cast<std::uint64_t>(std::stoi(chosen(run, "pile")));
  if (solved_loosely(chosen(run, "solver"))) scenario.world = engine::loading::lindmark2016_solver();
  scenario = engine::loading::with_speeds(scenario, chosen(run, "speeds"));
  scenario.executor.moves = operator_of(run);
  scenario.materials =
      engine::loading::with_rock_friction(engine::loading::materials_named(chosen(run, "materials")),
                                          std::stod(chosen(run, "rock-friction")) / 100);
  scenario.curl = engine::loading::curl_named(chosen(run, "curl"));
  scenario.lift = engine::loading::lift_named(chosen(run, "lift"));
  scenario.executor.lift_end = engine::loading::lift_end_named(chosen(run, "lift-end"));
  scenario.whole_cycle = chosen(run, "whole-cycle") == yes_or_no[1];
  scenario.executor.progress = engine::loading::progress_named(chosen(run, "progress"));
  if (chosen(run, "places") == place_names[1])
    scenario.columns.row_pitch = engine::loading::ColumnGrid{}.cell;
  scenario.machine.arm_drive = engine::loading::arm_drive_named(chosen(run, "arm"));
  if (chosen(run, "motion") == motion_names[1]) {
    scenario.frame_interval = scenario.world.step;
    scenario.frame_tolerance = 0;
    scenario.log_all_joints = true;
  }
  scenario.cycles = std::stoi(chosen(run, "cycles"));
  scenario.precision = std::stod(chosen(run, "precision")) / 100;
  scenario.pile_file = run.shared / "pile.h5";
  return scenario;
}

engine::loading::LoadingLog simulate_run(const engine::loading::Scenario& scenario, const RunContext& run) {
  engine::loading::SimulationHooks hooks;
  if (run.progress) {
    hooks.on_cycle = [&](const engine::loading::CycleRecord& cycle) {
      char text[80];
      std::snprintf(text, sizeof text, "cycle %d of %d: %.1f t in %.1f s", cycle.number, scenario.cycles,
                    cycle.loaded_mass / 1e3, cycle.seconds());
      run.progress(text);
    };
  }
  return engine::loading::simulate(scenario, hooks);
}

engine::loading::ProductionOptions production_options(const OptionValues& options) {
  engine::loading::ProductionOptions production;
  if (const auto haul = options.find("haul"); haul != options.end())
    production.haul = std::stod(haul->second);
  return production;
}

engine::loading::SpillOptions spill_options(const OptionValues& options) {
  engine::loading::SpillOptions spill;
  if (const auto law = options.find("spill"); law != options.end())
    spill.law = engine::loading::spill_law_named(law->second);
  return spill;
}

engine::loading::LogContent content_for(const OptionValues& options) {
  return spill_options(options).law == engine::loading::SpillLaw::lost
             ? engine::loading::LogContent::without_scene
             : engine::loading::LogContent::all;
}

CycleWork loading_cycles(const std::filesystem::path& file, const OptionValues& options) {
  CycleWork work{.rate = "production", .haul = production_options(options).haul, .loads = {}, .seconds = {}};
  const engine::loading::LoadingLog log =
      engine::loading::read_log(file, engine::loading::LogContent::without_scene);
  for (const engine::loading::CycleRecord& cycle : log.cycles) {
    work.loads.push_back(cycle.loaded_mass);
    work.seconds.push_back(cycle.seconds());
  }
  return work;
}

std::size_t typical_cycle(const engine::loading::LoadingLog& log, const OptionValues& options) {
  const std::vector<double> rates = production_by_cycle(log, production_options(options));
  std::vector<std::size_t> order(rates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return rates[a] < rates[b]; });
  return order[(order.size() - 1) / 2];
}

engine::loading::DamageOptions damage_options(const OptionValues& options) {
  engine::loading::DamageOptions damage;
  if (const auto torque = options.find("yield-torque"); torque != options.end())
    damage.tau_y = 1e3 * std::stod(torque->second);
  if (const auto component = options.find("damage"); component != options.end())
    damage.component = engine::loading::torque_component_named(component->second);
  return damage;
}

}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include "loading_flags.hpp"

#include <drawpoint/engine/loading/mine_materials.hpp>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace drawpoint::benchmarks {

std::vector<engine::loading::Move> round_of(const std::string& text) {
  std::vector<engine::loading::Move> round;
  std::istringstream moves(text);
  for (std::string move; std::getline(moves, move, ',');) {
    engine::loading::Move read;
    char after_boom = 0, after_tilt = 0;
    std::istringstream numbers(move);
    if (!(numbers >> read.boom >> after_boom >> read.tilt >> after_tilt >> read.time) || after_boom != '/' ||
        after_tilt != '/' || !(numbers >> std::ws).eof())
      throw std::invalid_argument("\"" + move +
                                  "\" is no move; give BOOM/TILT/SECONDS, as 0.1/-0.4/0.5, in rad/s and s");
    round.push_back(read);
  }
  engine::loading::check(engine::loading::OperatorMoves{.round = round});
  return round;
}

void OperationFlags::apply(engine::loading::Scenario& scenario) const {
  scenario = engine::loading::with_speeds(scenario, speeds);
  scenario.executor.moves = engine::loading::operator_named(operated);
  if (curl_hold) scenario.executor.moves.curl_hold = *curl_hold;
  if (crowd) scenario.executor.moves.crowd = *crowd;
  if (rounds) scenario.executor.moves.rounds = *rounds;
  if (slip) scenario.executor.moves.most_slip = *slip;
  if (!moves.empty()) scenario.executor.moves.round = round_of(moves);
  scenario.executor.lift_end = engine::loading::lift_end_named(lift_end);
  scenario.whole_cycle = whole_cycle;
  scenario.curl = engine::loading::curl_named(curl);
  scenario.lift = engine::loading::lift_named(lift);
  scenario.executor.progress = engine::loading::progress_named(progress);
  scenario.machine.arm_drive = engine::loading::arm_drive_named(arm);
}

std::string in_words(const OperationFlags& flags) {
  std::ostringstream words;
  words << flags.operated;
  if (flags.curl_hold) words << ", curl held by " << *flags.curl_hold;
  if (flags.crowd) words << ", crowding at " << *flags.crowd << " m/s";
  if (flags.rounds) words << ", " << *flags.rounds << " rounds";
  if (flags.slip) words << ", slip of at most " << *flags.slip << " m/s";
  if (!flags.moves.empty()) words << ", moves " << flags.moves;
  if (flags.whole_cycle) words << ", whole cycles";
  const OperationFlags usual;
  if (flags.curl != usual.curl) words << ", --curl " << flags.curl;
  if (flags.lift != usual.lift) words << ", --lift " << flags.lift;
  if (flags.progress != usual.progress) words << ", --progress " << flags.progress;
  if (flags.lift_end != usual.lift_end) words << ", --lift-end " << flags.lift_end;
  if (flags.arm != usual.arm) words << ", --arm " << flags.arm;
  return words.str();
}

void add_operation_flags(CLI::App& app, OperationFlags& flags) {
  using engine::loading::operator_names, engine::loading::speed_names;
  app.add_option("--speeds", flags.speeds,
                 "preset of the actuators' speeds: for cycles of 12 s as in Lindmark (2016), or what the "
                 "machine can do, with its engine")
      ->check(one_of(speed_names))
      ->capture_default_str();
  app.add_option(
         "--operator", flags.operated,
         "what is done beside the plan: nothing, or skilled: lifts, curls and dumps when the drive is "
         "held up, the throttle eased where wheels spin, thrust while the bucket curls")
      ->check(one_of(operator_names))
      ->capture_default_str();
  app.add_option("--curl-hold", flags.curl_hold,
                 "share of the wheels' torque that holds the loader while the bucket curls; 0: they roll")
      ->check(between(0, 1, "", "leave it out for the operator's"));
  app.add_option(
         "--crowd", flags.crowd,
         "speed that the drive is set to while the bucket curls, which falls as the curl does [m/s]; skilled "
         "has 0.5, 0 stands")
      ->check(between(0, 4, "m/s", "leave it out for the operator's"));
  app.add_option("--moves", flags.moves,
                 "round of moves of a drive-in that is held up, each BOOM/TILT/SECONDS in rad/s, with commas "
                 "between: "
                 "0.1/0.1/0.5,0/0.25/0.5 is a lift and a curl; a negative tilt dumps")
      ->check(taken_by(round_of));
  app.add_option("--rounds", flags.rounds, "how often these are gone through in a cycle, at most")
      ->check(between(1, 100, "", "leave it out for the operator's"));
  app.add_option("--slip", flags.slip,
                 "of the wheels [m/s], beyond which the throttle is eased; leave it out for the operator's")
      ->check(between(0.01, 10, "m/s", "leave it out for the operator's"));
  app.add_option(
         "--lift-end", flags.lift_end,
         "a slow drive ends a lift only where the arm stands too, or any slow actuator does, as in Lindmark "
         "(2016)")
      ->check(one_of(engine::loading::lift_end_names))
      ->capture_default_str();
  app.add_flag("--whole-cycle", flags.whole_cycle,
               "simulate approach, way back, standing and all of the wait for rest too");
  app.add_option("--curl", flags.curl,
                 "the bucket breaks out about its hinge, or about its tip as in Lindmark (2016)")
      ->check(one_of(engine::loading::curl_names))
      ->capture_default_str();
  app.add_option(
         "--lift", flags.lift,
         "the lift aims behind the pile's surface, or along its slope from where the drive-in ended, as in "
         "Lindmark (2016)")
      ->check(one_of(engine::loading::lift_names))
      ->capture_default_str();
  app.add_option(
         "--progress", flags.progress,
         "of a stage: along its goal; or as Lindmark (2016) prints it, with which stages end by their "
         "time limit")
      ->check(one_of(engine::loading::progress_names))
      ->capture_default_str();
  app.add_option(
         "--arm", flags.arm,
         "what moves it: cylinders; or motors in its hinges as in Lindmark (2016), without the hydraulics "
         "of --speeds machine")
      ->check(one_of(engine::loading::arm_drive_names))
      ->capture_default_str();
}

engine::loading::Scenario PileFlags::scenario() const {
  const engine::loading::Scenario named = engine::loading::scene_named(scene);
  return engine::loading::with_pile_of(named, mass ? 1e3 * *mass : named.pile.mass,
                                       engine::granular::sizes_named(sizes));
}

void add_pile_flags(CLI::App& app, PileFlags& flags) {
  using engine::granular::size_names, engine::loading::scene_names;
  app.add_option("--scene", flags.scene,
                 "drift and pile: 120 t in 6 m, or the scale of Lindmark (2016), 290 t in 7 m")
      ->check(one_of(scene_names))
      ->capture_default_str();
  app.add_option("--mass", flags.mass, "of the piles [t]")->check(between(10, 1e4, "t", "leave it out"));
  app.add_option(
         "--sizes", flags.sizes,
         "of the rocks: 0.3 to 0.8 m; with a quarter of the mass as 0.2 m, three times as many; with a "
         "tenth as 0.1 m, eight times as many, twelve times the time; 0.2 to 0.5 m, four times as many")
      ->check(one_of(size_names))
      ->capture_default_str();
}

void add_shares_of_strategy(CLI::App& app, engine::loading::Strategy& strategy) {
  const auto share = between(0, 1, "", "0.4 and 0.5 are the middle of the study");
  app.add_option("--beta", strategy.beta, "height of the lift")->check(share)->capture_default_str();
  app.add_option("--gamma", strategy.gamma, "place across the drift")->check(share)->capture_default_str();
  app.add_option("--kappa", strategy.kappa, "tilt in the lift")->check(share)->capture_default_str();
}

void take_mine_materials(const CLI::App& app, MaterialFlags& flags) {
  const engine::Material rock = engine::loading::calibrated_materials().rock_rock;
  if (app.count("--rolling") == 0) flags.rolling = rock.rolling;
  if (app.count("--spinning") == 0) flags.spinning = rock.spinning;
}

}  // namespace drawpoint::benchmarks

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/log/log_numbers.h>

#include <map>

namespace drawpoint::engine::loading {
namespace {

using Meanings = std::map<std::string, LogNumber>;

const Meanings& of_the_scene() {
  static const Meanings meanings{
      {"alpha", {"1", "strategy: wanted fill as a share of the bucket's volume"}},
      {"beta", {"1", "strategy: height of the lift as a share of the highest"}},
      {"gamma",
       {"1", "strategy: lateral place, 0 nearest to the back wall, 1 where the pile protrudes most"}},
      {"kappa", {"1", "strategy: tilt in the lift as a share of the pile's slope"}},
      {"cycles", {"1", "wanted, or with a precision at most"}},
      {"precision", {"1", "share of the mean production at which its standard error ends the run; 0: never"}},
      {"standoff", {"m", "tip to the pile's toe at the start"}},
      {"drift_length", {"m", "length of the drift"}},
      {"drift_width", {"m", "width of the drift"}},
      {"drift_height", {"m", "height of the drift"}},
      {"pile_mass", {"kg", "rock at first"}},
      {"pile_angle_deg", {"deg", "mean slope of the pile at the start"}},
      {"pile_crest", {"m", "highest point of the pile at the start"}},
      {"rocks", {"1", "how many at first"}},
      {"density", {"kg/m³", "of the rock"}},
      {"rock_friction", {"1", "friction of rock on rock"}},
      {"rock_rolling", {"1", "rolling resistance of rock on rock"}},
      {"rock_spinning", {"1", "spinning resistance of rock on rock"}},
      {"steel_friction", {"1", "friction of rock on steel"}},
      {"steel_rolling", {"1", "rolling resistance of rock on steel"}},
      {"floor_friction", {"1", "friction of rock on floor"}},
      {"rock_tyre_friction", {"1", "friction of rock on tyre"}},
      {"steel_floor_friction", {"1", "friction of steel on floor"}},
      {"tyre_floor_friction", {"1", "friction of tyre on floor"}},
      {"whole_cycle", {"1", "1: approach, way back and standing are simulated too"}}};
  return meanings;
}

const Meanings& of_the_machine() {
  static const Meanings meanings{
      {"payload", {"kg", "rated load of the machine"}},
      {"bucket_width", {"m", "width of the bucket"}},
      {"bucket_struck_volume", {"m³", "level bucket"}},
      {"bucket_heaped_volume", {"m³", "heaped bucket"}},
      {"pin_spacing", {"m", "between the two pins of the bucket's hinge"}},
      {"tyre_radius", {"m", "free radius"}},
      {"wheel_torque_limit", {"N m", "of each of the four wheels, near stall"}},
      {"engine_power", {"W", "of the engine; infinite: wheel torque is the only limit"}},
      {"hydraulic_pressure", {"Pa", "at which the relief valves open"}},
      {"pump_flow", {"m³/s", "of the pump; infinite: no limit"}},
      {"lift_bore", {"m", "bore of the lift cylinder"}},
      {"lift_rod", {"m", "rod of the lift cylinder; 0: pulls as hard as it pushes"}},
      {"tilt_bore", {"m", "bore of the tilt cylinder"}},
      {"tilt_rod", {"m", "rod of the tilt cylinder; 0: pulls as hard as it pushes"}},
      {"set_drive_in", {"m/s", "set speed of the drive-in"}},
      {"set_lift", {"m/s", "set speed of the tip at the start of the lift, at most"}},
      {"set_curl", {"rad/s", "set speed at the start of the curl"}},
      {"set_back_out", {"m/s", "set speed of backing out"}},
      {"drive_acceleration", {"m/s²", "largest of the set speed of the drive"}},
      {"longest_drive_in", {"s", "time limit of the drive-in"}},
      {"longest_lift", {"s", "time limit of the lift"}},
      {"longest_curl", {"s", "time limit of the curl"}},
      {"longest_back_out", {"s", "time limit of backing out"}},
      {"slow_share", {"1", "of its set speed, below which a drive is stuck"}},
      {"slow_window", {"s", "how long it is that slow in curl and way back"}},
      {"dig_window", {"s", "how long it is that slow in drive-in and lift"}},
      {"move_rounds", {"1", "how often the operator's moves are gone through"}},
      {"held_up", {"s", "how long the drive is slow before a move"}},
      {"most_slip", {"m/s", "of the wheels before the throttle is eased; infinite: never"}},
      {"crowd", {"m/s", "speed of the drive in the curl"}},
      {"curl_hold", {"1", "share of the wheels' torque that holds the drive in the curl"}}};
  return meanings;
}

const Meanings& of_the_solver() {
  static const Meanings meanings{
      {"step", {"s", "time step"}},
      {"substeps", {"1", "per step"}},
      {"iterations", {"1", "per substep, at least"}},
      {"iteration_budget", {"1", "iterations times contact points of a substep, at most"}},
      {"tolerance", {"1", "change of the normal load at which iterations end"}},
      {"warm_start", {"1", "share of the last impulses that a step starts with"}}};
  return meanings;
}

const Meanings& of_the_run() {
  static const Meanings meanings{
      {"lost_cycles", {"1", "cycles that broke down"}},
      {"left_out_cycles", {"1", "cycles not run, because the mean production was known as well as wanted"}},
      {"cleared_mass", {"kg", "rock cleared away for the machine"}},
      {"escaped_mass", {"kg", "rock that left the drift"}},
      {"emitted_mass", {"kg", "rock that came down the raise"}},
      {"present_mass", {"kg", "rock at the end"}},
      {"largest_overlap", {"m", "of a rock with what it touches, while the machine worked"}},
      {"largest_loop_error", {"m", "of the arm's closed loops, while the machine worked"}},
      {"repeated_steps", {"1", "steps that were done again in parts"}},
      {"most_contact_points", {"1", "of a step"}},
      {"most_iterations_per_substep",
       {"1", "that the iteration budget left where contact points were most"}}};
  return meanings;
}

}  // namespace

const LogNumber* log_number(const std::string& name) {
  for (const Meanings* meanings : {&of_the_scene(), &of_the_machine(), &of_the_solver(), &of_the_run()}) {
    const auto found = meanings->find(name);
    if (found != meanings->end()) return &found->second;
  }
  return nullptr;
}

}  // namespace drawpoint::engine::loading

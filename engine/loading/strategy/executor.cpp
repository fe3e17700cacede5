// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <drawpoint/engine/loading/strategy/executor.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

int number(Stage stage) { return static_cast<int>(stage); }

void require(bool good, const char* name, double value, const char* allowed) {
  if (!good)
    throw std::invalid_argument("loading::ExecutorOptions: " + std::string(name) + " is " +
                                std::to_string(value) + "; give " + allowed);
}

void require_positive(const char* name, double value) {
  require(value > 0 && !std::isnan(value), name, value, "a value above 0");
}

void check(const ExecutorOptions& options) {
  const SpeedPreset& speeds = options.speeds;
  require_positive("speeds.drive_in [m/s]", speeds.drive_in);
  require_positive("speeds.lift [m/s]", speeds.lift);
  require_positive("speeds.curl [rad/s]", speeds.curl);
  require_positive("speeds.back_out [m/s]", speeds.back_out);
  require_positive("speeds.limits.drive [m/s]", speeds.limits.drive);
  require_positive("speeds.limits.boom [rad/s]", speeds.limits.boom);
  require_positive("speeds.limits.tilt [rad/s]", speeds.limits.tilt);
  require_positive("speeds.limits.drive_acceleration [m/s2]", speeds.limits.drive_acceleration);
  for (double limit : speeds.stage_limit) require_positive("speeds.stage_limit [s]", limit);
  require_positive("slow_window [s]", options.slow_window);
  require_positive("dig_window [s]", options.dig_window);
  require(options.slow_share >= 0 && options.slow_share < 1, "slow_share [1]", options.slow_share,
          "0 to below 1");
  require_positive("progress.angle_length [m]", options.progress.angle_length);
  const double floor = options.progress.velocity_floor, tolerance = options.progress.tolerance;
  require(floor >= 0 && floor <= 1, "progress.velocity_floor [1]", floor, "0 to 1");
  require(tolerance >= 0 && tolerance < 1, "progress.tolerance [1]", tolerance, "0 to below 1");
  check(options.moves);
}

// Time that an actuator has been slow, after a step of dt.
double slow_for(double before, double dt, double set, double actual, const ExecutorOptions& options,
                double least) {
  const bool checked = std::abs(set) > least;
  const bool slow = checked && actual * std::copysign(1.0, set) < options.slow_share * std::abs(set);
  return slow ? before + dt : 0.0;
}

// The set speed of the drive after one step toward `wanted`: slower at once, faster by `most` [m/s].
double eased(double before, double wanted, double most) {
  const double way = std::copysign(1.0, wanted), same_way = std::max(way * before, 0.0);
  return way * std::min(std::abs(wanted), same_way + most);
}

}  // namespace

std::string_view name(Stage stage) {
  constexpr std::string_view names[] = {"drive in", "lift", "curl", "back out", "finished"};
  return names[number(stage) - 1];
}

std::string_view name(StageEnd reason) {
  constexpr std::string_view names[] = {"goal", "timeout", "slow actuator"};
  return names[static_cast<int>(reason)];
}

LiftEnd lift_end_named(const std::string& name) {
  if (name == "arm") return LiftEnd::arm;
  if (name == "any") return LiftEnd::any_actuator;
  throw std::invalid_argument("loading::lift_end_named: there is no end of a lift \"" + name +
                              "\"; choose arm or any");
}

SpeedPreset machine_speeds() {
  return {.drive_in = 1.2,
          .lift = 0.4,
          .curl = 0.3,
          .back_out = 2.0,
          .stage_limit = {8, 15, 10, 12},
          .limits = {.drive = 2.5, .boom = 0.20, .tilt = 0.40, .drive_acceleration = 1.0}};
}

SpeedPreset lindmark2016_speeds() {
  return {.drive_in = 1.5,
          .lift = 1.1,
          .curl = 0.9,
          .back_out = 3.8,
          .stage_limit = {5, 6, 4, 6},
          .limits = {.drive = 4.5, .boom = 0.60, .tilt = 1.20, .drive_acceleration = 2.0}};
}

SpeedPreset speeds_named(const std::string& name) {
  if (name == "lindmark2016") return lindmark2016_speeds();
  if (name == "machine") return machine_speeds();
  throw std::invalid_argument("loading::speeds_named: there are no speeds \"" + name +
                              "\"; choose lindmark2016 or machine");
}

Executor::Executor(const Plan& plan, const ArmGeometry& arm, const ExecutorOptions& options,
                   const Approached& approached)
    : plan_(plan), arm_(arm), options_(options), approached_(approached), moves_(options.moves) {
  if (!plan.feasible)
    throw std::invalid_argument("loading::Executor: the plan is not feasible (" + plan.message +
                                "); end the run or plan anew");
  check(options);
}

void Executor::start(Stage stage, const Observation& now) {
  stage_ = stage;
  stage_start_ = now.tip;
  stage_time_ = now.time;
  slow_time_ = {};
  goal_ = stage_goal(plan_, number(stage), now.tip, cycle_start_);
}

void Executor::watch_actuators(const Observation& now, double dt) {
  const ActuatorRates& least = options_.least_set;
  slow_time_.drive = slow_for(slow_time_.drive, dt, set_.drive, now.actual.drive, options_, least.drive);
  slow_time_.boom = slow_for(slow_time_.boom, dt, set_.boom, now.actual.boom, options_, least.boom);
  slow_time_.tilt = slow_for(slow_time_.tilt, dt, set_.tilt, now.actual.tilt, options_, least.tilt);
}

// A drive that has moves left, or that pushes while the arm moves by more than a tenth of what it can, is not stuck.
bool Executor::drive_may_be_stuck() const {
  const RateLimits& most = options_.speeds.limits;
  const bool arm_moves = std::abs(set_.boom) > options_.slow_share * most.boom ||
                         std::abs(set_.tilt) > options_.slow_share * most.tilt;
  switch (stage_) {
    case Stage::drive_in:
      return !moves_.left();
    case Stage::lift:
      return options_.lift_end == LiftEnd::any_actuator || !arm_moves;
    case Stage::curl:
      return !(options_.moves.crowd > 0);
    default:
      return true;
  }
}

// Moves take their time beside that of the drive-in.
double Executor::stage_limit() const {
  const double limit = options_.speeds.stage_limit[static_cast<std::size_t>(number(stage_)) - 1];
  return stage_ == Stage::drive_in ? limit + longest_time(options_.moves) : limit;
}

bool Executor::stage_ends(const Observation& now, StageEnd& reason) const {
  const bool digs = stage_ == Stage::drive_in || stage_ == Stage::lift;
  // In the drive-in the arm makes moves alone, which end by their time.
  const double arm = stage_ == Stage::drive_in ? 0.0 : std::max(slow_time_.boom, slow_time_.tilt),
               slowest = std::max(drive_may_be_stuck() ? slow_time_.drive : 0.0, arm);
  if (goal_reached(progress_, options_.progress)) {
    reason = StageEnd::goal;
  } else if (now.time - stage_time_ >= stage_limit()) {
    reason = StageEnd::timeout;
  } else if (slowest > (digs ? options_.dig_window : options_.slow_window)) {
    reason = StageEnd::slow_actuator;
  } else {
    return false;
  }
  return true;
}

Stage Executor::after(StageEnd reason) const {
  const bool aborts = reason != StageEnd::goal && options_.stuck == StuckPolicy::abort_to_stage_4;
  if (aborts && stage_ != Stage::back_out) return Stage::back_out;
  if (stage_ == Stage::drive_in && !(plan_.height > 0)) return Stage::curl;
  return static_cast<Stage>(number(stage_) + 1);
}

// Straight at C from where the tip is, or along the slope as it was aimed at the start.
TipRates Executor::lift_rates(const TipPose& tip) const {
  const SpeedPreset& v = options_.speeds;
  const bool steered = plan_.lift == LiftGoal::behind_surface;
  const StageGoal ahead = steered ? stage_goal(plan_, number(Stage::lift), tip, cycle_start_) : goal_;
  const double time = std::max({ahead.z / v.lift, ahead.x / v.drive_in, ahead.phi / v.curl});
  if (!(time > 0)) return {};
  const double f = translation_factor(progress_, options_.progress) / time,
               g = rotation_factor(progress_, options_.progress) / time;
  return {.v_x = f * ahead.x, .v_z = f * ahead.z, .omega = g * ahead.phi};
}

ActuatorRates Executor::drive_in_speeds() const {
  ActuatorRates rates{.drive = options_.speeds.drive_in};
  if (const Move* move = moves_.current()) {
    rates.boom = move->boom;
    rates.tilt = move->tilt;
  }
  return rates;
}

// A bucket that is to turn about its edge, whose boom would have to sink, turns about its hinge: rock or floor is under
// it.
ActuatorRates Executor::lift_speeds(const TipPose& tip) const {
  const TipRates wanted = lift_rates(tip);
  const ArmPose pose = arm_pose(arm_, tip);
  ActuatorRates rates = actuator_rates(arm_, pose, wanted);
  if (rates.boom < 0)
    rates = {
        .drive = wanted.v_x + arm_.GK * std::sin(pose.b) * wanted.omega, .boom = 0, .tilt = wanted.omega};
  return rates;
}

ActuatorRates Executor::curl_speeds(const TipPose& tip) const {
  const double f = translation_factor(progress_, options_.progress), curl = options_.speeds.curl * f;
  ActuatorRates rates{.tilt = curl};
  if (plan_.curl == CurlMode::tip_fixed) rates = actuator_rates(arm_, arm_pose(arm_, tip), {.omega = curl});
  rates.drive += options_.moves.crowd * f;
  return rates;
}

ActuatorRates Executor::set_speeds(const TipPose& tip) const {
  const double f = translation_factor(progress_, options_.progress);
  const SpeedPreset& speeds = options_.speeds;
  switch (stage_) {
    case Stage::drive_in:
      return within_limits(drive_in_speeds(), speeds.limits);
    case Stage::lift:
      return within_limits(lift_speeds(tip), speeds.limits);
    case Stage::curl:
      return within_limits(curl_speeds(tip), speeds.limits);
    case Stage::back_out:
      return within_limits({.drive = -speeds.back_out * f}, speeds.limits);
    case Stage::finished:
      break;
  }
  return {};
}

ActuatorRates Executor::step(const Observation& now) {
  if (!started_) {
    started_ = true;
    cycle_start_ = now.tip;
    cycle_start_.x -= approached_.distance;
    set_.drive = approached_.speed;
    last_time_ = now.time;
    start(Stage::drive_in, now);
  }
  const double dt = now.time - last_time_;
  last_time_ = now.time;
  watch_actuators(now, dt);
  StageEnd reason = StageEnd::goal;
  while (!finished()) {
    progress_ = loading::progress(goal_, stage_start_, now.tip, options_.progress);
    if (!stage_ends(now, reason)) break;
    results_.push_back({stage_, reason, stage_time_, now.time, progress_, stage_start_, now.tip});
    start(after(reason), now);
  }
  if (stage_ == Stage::drive_in) moves_.step(now.time, slow_time_.drive);
  const double drive_before = set_.drive;
  set_ = set_speeds(now.tip);
  if (const double most = options_.speeds.limits.drive_acceleration; std::isfinite(most))
    set_.drive = eased(drive_before, set_.drive, most * dt);
  // The throttle is eased where wheels would spin.
  set_.drive = std::min(set_.drive, std::max(now.actual.drive, 0.0) + options_.moves.most_slip);
  return set_;
}

void Executor::end_backing_out(const Observation& now) {
  results_.push_back({stage_, StageEnd::goal, stage_time_, now.time, progress_, stage_start_, now.tip});
  stage_ = Stage::finished;
  set_ = {};
}

}  // namespace drawpoint::engine::loading

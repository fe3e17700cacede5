// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/strategy/operator_moves.hpp>
#include <drawpoint/engine/loading/strategy/progress.hpp>
#include <drawpoint/engine/loading/strategy/trajectory.hpp>
#include <string_view>
#include <vector>

/// Follows a plan with set speeds for drive, boom and tilt, in four stages: drive in, lift, curl, back out.
///
/// Each step: progress s from the tip; tip velocity from the stage's law; actuator rates by inverse
/// kinematics; one common factor keeps them within limits; a drive is set to go faster by no more than its
/// acceleration allows. First speeds: stage 1 v_x, constant; stage 2 straight to its goal in the least time
/// T₀ at which none of drive-in, lift and curl speed is exceeded (v_z = the lift speed, v_x = v_z / tan θ and
/// ω = κθ v_z / h when the drive-in reached its own), steered: what the pile keeps back in one direction is
/// made good, and no direction goes beyond its goal (LiftGoal::along_slope: as aimed at its start); stage 3
/// ω; stage 4 −v_x. A stage ends when (a) its goal is reached, (b) its time is up, or (c) an actuator whose
/// set speed exceeds `least_set` has run below `slow_share` of it for longer than `slow_window`, in stages 1 and 2
/// `dig_window`; in stage 1 the drive alone, as the arm then makes an operator's moves, which end by their time. (b)
/// and (c) are being stuck; the policy says what follows. In stage 2 a slow drive alone ends nothing while the arm
/// moves: cylinders that have force left go on while the wheels push (LiftEnd::any_actuator: it ends, as in the
/// source). Stage 2 never lowers the boom: where the wanted tilt would turn the bucket about its edge and press its
/// heel into floor or rock, it turns about its hinge. Stage 2 is left out if h = 0.
///
/// A value type on plain data: knows no simulator, deterministic. World frame, SI units. Source: Lindmark
/// 2016, section 3.4, algorithm 1.
namespace drawpoint::engine::loading {

enum class Stage : int { drive_in = 1, lift = 2, curl = 3, back_out = 4, finished = 5 };
enum class StageEnd : int { goal = 0, timeout = 1, slow_actuator = 2 };
enum class StuckPolicy { next_stage, abort_to_stage_4 };
enum class LiftEnd {
  arm,          ///< a slow drive ends a lift only where the arm stands too (default)
  any_actuator  ///< one that is slow ends it, as in Lindmark (2016)
};

/// By name. Throws std::invalid_argument with the names.
LiftEnd lift_end_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> lift_end_names = {"arm", "any"};

std::string_view name(Stage stage);
std::string_view name(StageEnd reason);

struct SpeedPreset {
  double drive_in = 0;                ///< v_x of stage 1 [m/s]
  double lift = 0;                    ///< v_z at the start of stage 2, at most [m/s]
  double curl = 0;                    ///< ω at the start of stage 3 [rad/s]
  double back_out = 0;                ///< speed at the start of stage 4 [m/s]
  std::array<double, 4> stage_limit;  ///< longest time of each stage [s]
  RateLimits limits;                  ///< of the actuators
};

/// What the hydraulics and first gear of an LH621-class machine deliver; a cycle of about 27 s (default).
SpeedPreset machine_speeds();
/// Fast enough for the 12 s cycles that Lindmark (2016) reports; 2-3 times what the machine can do.
SpeedPreset lindmark2016_speeds();
/// By name. Throws std::invalid_argument with the names there are.
SpeedPreset speeds_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> speed_names = {"lindmark2016", "machine"};

struct ExecutorOptions {
  SpeedPreset speeds = machine_speeds();
  ProgressOptions progress;
  StuckPolicy stuck = StuckPolicy::next_stage;
  LiftEnd lift_end = LiftEnd::arm;
  OperatorMoves moves;
  double slow_share = 0.10;  ///< [1]
  double slow_window = 1.0;  ///< of curl and way back [s]
  double dig_window = 0.5;   ///< of drive-in and lift, where what stands rarely moves again [s]
  ActuatorRates least_set = {0.05, 0.005, 0.01};  ///< v_min of rule (c) [m/s, rad/s, rad/s]
};

struct Observation {
  double time = 0;       ///< [s], never falls
  TipPose tip;           ///< odometry from the bucket's pose, not from the wheels
  ActuatorRates actual;  ///< speeds in the step just done
};

/// What of stage 1 was driven before the first observation: from rest over `distance` [m], to `speed` [m/s].
struct Approached {
  double distance = 0, speed = 0;
};

struct StageResult {
  Stage stage = Stage::drive_in;
  StageEnd reason = StageEnd::goal;
  double t_start = 0, t_end = 0;  ///< [s]
  double progress = 0;            ///< s at the end [1]
  TipPose start, end;
};

class Executor {
 public:
  /// Throws std::invalid_argument if the plan is not feasible or an option makes no sense.
  Executor(const Plan& plan, const ArmGeometry& arm, const ExecutorOptions& options = {},
           const Approached& approached = {});

  /// Set speeds until the next observation; all zero once finished. The first call starts stage 1.
  ActuatorRates step(const Observation& now);
  /// Ends stage 4 where the machine is: the rest of the way is not to be driven.
  void end_backing_out(const Observation& now);

  /// Share of the wheels' torque that may keep the drive at its set speed [1].
  double drive_share() const { return stage_ == Stage::curl ? options_.moves.curl_hold : 1; }

  Stage stage() const { return stage_; }
  bool finished() const { return stage_ == Stage::finished; }
  double progress() const { return progress_; }                         ///< s of the present stage [1]
  const StageGoal& goal() const { return goal_; }                       ///< of the present stage
  double stage_time() const { return last_time_ - stage_time_; }        ///< since it began [s]
  const std::vector<StageResult>& results() const { return results_; }  ///< stages done, in order

 private:
  void start(Stage stage, const Observation& now);
  void watch_actuators(const Observation& now, double dt);
  bool drive_may_be_stuck() const;
  double stage_limit() const;
  bool stage_ends(const Observation& now, StageEnd& reason) const;
  Stage after(StageEnd reason) const;
  ActuatorRates drive_in_speeds() const;
  ActuatorRates curl_speeds(const TipPose& tip) const;
  ActuatorRates lift_speeds(const TipPose& tip) const;
  ActuatorRates set_speeds(const TipPose& tip) const;
  TipRates lift_rates(const TipPose& tip) const;

  Plan plan_;
  ArmGeometry arm_;
  ExecutorOptions options_;
  Approached approached_;
  Stage stage_ = Stage::drive_in;
  bool started_ = false;
  TipPose cycle_start_, stage_start_;
  double stage_time_ = 0, last_time_ = 0, progress_ = 0;
  StageGoal goal_;
  ActuatorRates set_, slow_time_;
  MoveSequence moves_;
  std::vector<StageResult> results_;
};

}  // namespace drawpoint::engine::loading

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <string>
#include <string_view>

/// What an operator does at the pile beside following a plan.
///
/// Pulses: when the drive-in has been held up for `held_up`, boom and bucket move for `pulse` while the drive goes
/// on pushing. The lift loads the front tyres and loosens the rock over the edge, the curl turns it into the
/// bucket. Pressing: in the lift a drive that is held up while the arm moves is not stuck, it presses. Crowding: in
/// the curl the drive pushes at `crowd`, which falls as the curl does, instead of standing still; so rock is pressed
/// into the bucket while its mouth turns up. Releasing: with less than all of `curl_hold` the bucket, which swings
/// forward as it turns up, can push the machine back. Held, with the thrust of the lift still in the wheels, it may
/// jam, nose down and full, and lose its load in backing out. Lindmark (2016) has none of these. Source: how
/// loading is described by Hemami and Hassani (2009) and Dobson, Marshall and Larsson (2017); the numbers are chosen
/// here (docs/measurements/loading.md). World frame of kinematics.hpp, SI units.
namespace drawpoint::engine::loading {

struct OperatorMoves {
  int most_pulses = 0;   ///< per cycle; 0: none (default)
  double held_up = 0.3;  ///< [s] > 0; the drive has been slow for so long before a pulse
  double pulse = 0.5;    ///< [s] > 0
  ActuatorRates pulse_rates = {0, 0.10,
                               0.25};  ///< of boom and tilt in a pulse [rad/s] ≥ 0; the drive keeps its own
  bool press = false;  ///< in the lift, a drive that is held up while the arm moves is not stuck
  double crowd = 0;    ///< [m/s] ≥ 0; of the drive in the curl; 0: it stands (default)
  /// Of the wheels' torque, what keeps the drive at its speed in the curl [1]. 1: they hold as brakes do (default);
  /// 0: the pedal is released and they roll.
  double curl_hold = 1;
};

/// All three: four pulses, pressing, crowding at 0.5 m/s.
OperatorMoves skilled_operator();
/// "plan": none; "skilled": skilled_operator(). Throws std::invalid_argument with the names.
OperatorMoves operator_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> operator_names = {"plan", "skilled"};

/// Throws std::invalid_argument naming the value and what is allowed.
void check(const OperatorMoves& moves);

/// When to pulse, step by step in one drive-in. A value type, deterministic.
class Pulses {
 public:
  explicit Pulses(const OperatorMoves& moves = {}) : moves_(moves) {}
  /// `slow_for`: how long the drive has been slow [s]. Returns whether the moves are due until the next call.
  bool step(double time, double slow_for);
  bool under_way() const { return pulsing_; }
  /// Whether more pulses may come, one is under way, or the last one's time to show is not over: the drive is then not
  /// stuck.
  bool left() const { return done_ < moves_.most_pulses || pulsing_ || time_ < next_; }

 private:
  OperatorMoves moves_;
  int done_ = 0;
  bool pulsing_ = false;
  double time_ = 0, until_ = 0, next_ = 0;  // [s]
};

}  // namespace drawpoint::engine::loading

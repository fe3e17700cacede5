// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <drawpoint/engine/loading/strategy/kinematics.hpp>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

/// What an operator does at the pile beside following a plan.
///
/// Moves: when the drive-in has been held up for `held_up`, boom and bucket make the next move of `round` while the
/// drive goes on pushing; after the last move the round begins again, `rounds` times in all. A lift loads the front
/// tyres and loosens the rock over the edge, a curl turns it into the bucket, a dump (a negative tilt) drops the edge
/// back into the rock, so that the next push slides under what the curl has lifted. Easing: wheels that turn faster
/// than the machine moves by more than `most_slip` are set slower, so that they pull and do not spin. Crowding: in the
/// curl the drive pushes at `crowd`, which falls as the curl does, instead of standing still; so rock is pressed into
/// the bucket while its mouth turns up. Releasing: with less than all of `curl_hold` the bucket, which swings forward
/// as it turns up, can push the machine back. Lindmark (2016) has none of these. Sources: training material for
/// underground loaders ("Getting a full bucket of dirt", undergroundtraining.com.au), Hemami and Hassani (2009),
/// Dobson, Marshall and Larsson (2017); none gives rates or times, which are chosen here
/// (docs/measurements/loading.md). World frame of kinematics.hpp, SI units.
namespace drawpoint::engine::loading {

/// Boom and bucket move so while the drive keeps the drive-in's speed.
struct Move {
  double boom = 0;  ///< [rad/s], up positive
  double tilt = 0;  ///< [rad/s], curling back positive; negative: dumping
  double time = 0;  ///< [s] > 0
};

struct OperatorMoves {
  std::vector<Move> round = {};  ///< in order; none (default)
  int rounds = 1;                ///< [1] ≥ 1
  double held_up = 0.3;          ///< [s] > 0; the drive has been slow for so long before a move
  double crowd = 0;              ///< [m/s] ≥ 0; of the drive in the curl; 0: it stands (default)
  /// Share of the wheels' torque that keeps the drive at its speed in the curl [1]. 1 (default): they hold as brakes
  /// do; 0: the pedal is released and they roll.
  double curl_hold = 1;
  double most_slip =
      std::numeric_limits<double>::infinity();  ///< [m/s] > 0; infinity: the throttle is not eased
};

/// Three rounds of lift, curl, dump, curl of 0.4 s each; crowding at 2 m/s; slip of at most 0.4 m/s.
OperatorMoves skilled_operator();
/// "plan": none; "skilled": skilled_operator(). Throws std::invalid_argument with the names.
OperatorMoves operator_named(const std::string& name);
inline constexpr std::array<std::string_view, 2> operator_names = {"plan", "skilled"};

/// Throws std::invalid_argument naming the value and what is allowed.
void check(const OperatorMoves& moves);

/// What all rounds take at most, with the time to show after each move [s].
double longest_time(const OperatorMoves& moves);

/// When to make which move, step by step in one drive-in. A value type, deterministic.
class MoveSequence {
 public:
  explicit MoveSequence(const OperatorMoves& moves = {}) : moves_(moves) {}
  /// `slow_for`: how long the drive has been slow [s]. Decides what is made until the next call.
  void step(double time, double slow_for);
  /// Nothing while none is made.
  const Move* current() const { return making_ ? &moves_.round[number_ % moves_.round.size()] : nullptr; }
  /// Whether more moves may come, one is made, or the last one's time to show is not over: the drive is then not stuck.
  bool left() const { return made_before_end() || making_ || time_ < next_; }

 private:
  bool made_before_end() const {
    return number_ + (making_ ? 1 : 0) < moves_.round.size() * static_cast<std::size_t>(moves_.rounds);
  }

  OperatorMoves moves_;
  std::size_t number_ = 0;  // of the move that is made or comes next
  bool making_ = false;
  double time_ = 0, until_ = 0, next_ = 0;  // [s]
};

}  // namespace drawpoint::engine::loading

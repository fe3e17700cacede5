// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <drawpoint/engine/loading/strategy/operator_moves.hpp>
#include <stdexcept>
#include <string>

namespace drawpoint::engine::loading {
namespace {

void require_move(bool good, const char* name, double value, const char* allowed) {
  if (!good)
    throw std::invalid_argument("loading::OperatorMoves: " + std::string(name) + " is " +
                                std::to_string(value) + "; give " + allowed);
}

constexpr Move lift{.boom = 0.10, .tilt = 0, .time = 0.4}, curl{.boom = 0, .tilt = 0.30, .time = 0.4},
    dump{.boom = 0, .tilt = -0.30, .time = 0.4};

}  // namespace

OperatorMoves skilled_operator() {
  return {.round = {lift, curl, dump, curl}, .rounds = 3, .crowd = 2.0, .most_slip = 0.4};
}

OperatorMoves operator_named(const std::string& name) {
  if (name == "plan") return {};
  if (name == "skilled") return skilled_operator();
  throw std::invalid_argument("loading::operator_named: there is no operator \"" + name +
                              "\"; choose plan or skilled");
}

void check(const OperatorMoves& m) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  const auto not_negative = [](double value) { return value >= 0 && std::isfinite(value); };
  require_move(m.round.size() <= 100, "round.size() [1]", static_cast<double>(m.round.size()),
               "0 to 100 moves");
  for (const Move& move : m.round) {
    require_move(std::isfinite(move.boom), "round.boom [rad/s]", move.boom, "a finite value");
    require_move(std::isfinite(move.tilt), "round.tilt [rad/s]", move.tilt, "a finite value");
    require_move(positive(move.time), "round.time [s]", move.time, "a finite value above 0");
  }
  require_move(m.rounds >= 1 && m.rounds <= 100, "rounds [1]", m.rounds, "1 to 100");
  require_move(positive(m.held_up), "held_up [s]", m.held_up, "a finite value above 0");
  require_move(m.curl_hold >= 0 && m.curl_hold <= 1, "curl_hold [1]", m.curl_hold, "0 to 1");
  require_move(not_negative(m.crowd), "crowd [m/s]", m.crowd, "a finite value of at least 0");
  require_move(m.crowd == 0 || m.curl_hold > 0, "curl_hold [1]", m.curl_hold,
               "a value above 0, or no crowd: released wheels do not push");
  require_move(m.most_slip > 0, "most_slip [m/s]", m.most_slip,
               "a value above 0; infinity: the throttle is not eased");
}

double longest_time(const OperatorMoves& moves) {
  double round = 0;
  for (const Move& move : moves.round) round += move.time + moves.held_up;
  return moves.rounds * round;
}

// After a move the drive gets `held_up` to show that it moves again.
void MoveSequence::step(double time, double slow_for) {
  time_ = time;
  if (making_ && time >= until_) {
    making_ = false;
    ++number_;
    next_ = time + moves_.held_up;
  }
  if (making_ || !made_before_end() || slow_for < moves_.held_up || time < next_) return;
  making_ = true;
  until_ = time + moves_.round[number_ % moves_.round.size()].time;
}

}  // namespace drawpoint::engine::loading

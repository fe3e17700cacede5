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

}  // namespace

OperatorMoves skilled_operator() { return {.most_pulses = 4, .press = true, .crowd = 0.5}; }

OperatorMoves operator_named(const std::string& name) {
  if (name == "plan") return {};
  if (name == "skilled") return skilled_operator();
  throw std::invalid_argument("loading::operator_named: there is no operator \"" + name +
                              "\"; choose plan or skilled");
}

void check(const OperatorMoves& m) {
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  const auto not_negative = [](double value) { return value >= 0 && std::isfinite(value); };
  require_move(m.most_pulses >= 0 && m.most_pulses <= 100, "most_pulses [1]", m.most_pulses, "0 to 100");
  require_move(positive(m.held_up), "held_up [s]", m.held_up, "a finite value above 0");
  require_move(positive(m.pulse), "pulse [s]", m.pulse, "a finite value above 0");
  require_move(m.pulse_rates.drive == 0, "pulse_rates.drive [m/s]", m.pulse_rates.drive,
               "0; the drive keeps the speed of the drive-in");
  require_move(not_negative(m.pulse_rates.boom), "pulse_rates.boom [rad/s]", m.pulse_rates.boom,
               "a finite value of at least 0");
  require_move(not_negative(m.pulse_rates.tilt), "pulse_rates.tilt [rad/s]", m.pulse_rates.tilt,
               "a finite value of at least 0");
  require_move(m.curl_hold >= 0 && m.curl_hold <= 1, "curl_hold [1]", m.curl_hold, "0 to 1");
  require_move(not_negative(m.crowd), "crowd [m/s]", m.crowd, "a finite value of at least 0");
  require_move(m.crowd == 0 || m.curl_hold > 0, "curl_hold [1]", m.curl_hold,
               "a value above 0, or no crowd: released wheels do not push");
}

// After a pulse the drive gets `held_up` to show that it moves again.
bool Pulses::step(double time, double slow_for) {
  time_ = time;
  if (pulsing_ && time >= until_) {
    pulsing_ = false;
    next_ = time + moves_.held_up;
  }
  if (!pulsing_ && done_ < moves_.most_pulses && slow_for >= moves_.held_up && time >= next_) {
    ++done_;
    pulsing_ = true;
    until_ = time + moves_.pulse;
  }
  return pulsing_;
}

}  // namespace drawpoint::engine::loading

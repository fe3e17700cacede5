// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a study goes on after its first design: kept in the store, so that it resumes without repeating its
/// options. Unlike the identity it may change from one session to the next.

#include <cstdint>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// A round of `confirm`: the confirmation runs from one id up to the next round's.
struct ConfirmationRound {
  std::int64_t first = 0;  ///< id of its first run
  int named = 0;           ///< so many of its points, the first ones, were named by the user
};

/// What ended the last command before the study had all runs that it may have; `why` empty: nothing did.
struct StopNote {
  std::string why = {};    ///< "--until is reached: nrmse(cost) 0.08, wanted < 0.1"
  std::string go_on = {};  ///< what to give the command for more runs: "give smaller errors in --until"
  bool enough = false;     ///< the models are as good as was wanted
};

struct Sampling {
  int points = 0;  ///< adaptive points in all, 0 or more
  int batch = 8;   ///< points that are chosen together, 1 or more
  /// Who chooses and how often, as "name=weight" with commas between; model/sampling/criteria.h has the names.
  std::string criteria = "lola_voronoi=0.4,voronoi=0.4,error=0.2";
  std::vector<ConfirmationRound> rounds = {};  ///< in rising order
  double target =
      0.0;  ///< error of the mean over the range of every response but standard errors, at which to stop; 0: none
  /// Errors at which to stop, such as "nrmse(cost) < 0.1"; empty: none. model/fits/stop_rule.h reads it.
  std::string until = {};
  StopNote stopped = {};
};

/// As one JSON object. Throws std::invalid_argument for a target that is not finite.
std::string to_text(const Sampling& sampling);
/// Throws nlohmann::json::exception for what is not one, std::out_of_range for numbers that cannot be.
Sampling sampling_from(const std::string& text);

}  // namespace drawpoint::studies

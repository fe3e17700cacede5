// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What a rate, such as production, would be with another haul: load(x) / (seconds(x) + haul) of some strategies,
/// with load and seconds per cycle as models of the runs have them, and from which haul on one strategy passes
/// another. hauls.h finds them.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// The cycles of one run.
struct WorkOfRun {
  std::int64_t run = 0;
  Eigen::VectorXd x;
  std::vector<double> loads, seconds;  ///< per cycle, as many

  /// Mean over the cycles of load / (seconds + haul): what the response is with that haul.
  double rate(double haul) const;
  double mean_load() const;
  double mean_seconds() const;
};

struct HauledStrategy {
  std::string name;
  Eigen::VectorXd x;
  double load = 0, seconds = 0;      ///< per cycle, as the models have them
  std::vector<WorkOfRun> runs = {};  ///< made there

  double rate(double haul) const { return load / (seconds + haul); }
};

/// From which haul on the strategy `better` has the greater rate of the two; 95 of 100 draws of the models have their
/// turn between the ends, those without a turn counting at infinity or, where it is always better, at 0.
struct HaulTurn {
  double haul = 0;  ///< [s]
  std::size_t better = 0, worse = 0;
  double lower = 0, upper = std::numeric_limits<double>::infinity();
};

struct HaulChoice {
  std::size_t response = 0;  ///< the rate
  double haul = 0;           ///< [s] that the runs count
  double longest = 600;      ///< [s] that is asked about
  std::vector<HauledStrategy> strategies = {};
  std::vector<HaulTurn> turns = {};  ///< by haul
  double deviation =
      0;  ///< of the ratio of a run's means from its rate, at hauls up to the longest: the largest share
  double error =
      0;  ///< of the models' rate from that of validation runs, root mean square over its mean; NaN: none
};

/// Where the rates of a and b are equal, for a haul of 0 to `longest`, above 0; NaN: nowhere.
double turning_haul(double load_a, double seconds_a, double load_b, double seconds_b, double longest);

}  // namespace drawpoint::studies

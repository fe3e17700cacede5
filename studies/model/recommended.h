// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The one strategy that a report recommends, as recommendation.h finds it.

#include <drawpoint/doe/evaluations.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace drawpoint::studies {

/// How far the mean of many runs differs, recommended less reference, in the response's unit; the ends hold it with
/// 95 %, and are not numbers where the model does not know its error.
struct Gain {
  std::size_t response = 0;  ///< an objective
  double here = 0, there = 0, lower = 0, upper = 0;

  double difference() const { return here - there; }
  /// Whether both ends are on the same side of 0.
  bool is_sure() const { return lower > 0 || upper < 0; }
};

struct Reference {
  std::string name;  ///< "the middle of the box", or that of the mark
  Eigen::VectorXd x;
};

struct Recommendation {
  Eigen::VectorXd x;
  int row = -1;                                 ///< of the front; -1: a place that was simulated
  std::vector<doe::Evaluation> simulated = {};  ///< runs in this place that succeeded, the last first
  Reference reference = {};
  std::vector<Gain> gains = {};  ///< one per objective
};

}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How a study goes on after its first design: kept in the store, so that it resumes without repeating its
/// options. Unlike the identity it may change from one session to the next.

#include <string>

namespace drawpoint::studies {

struct Sampling {
  int points = 0;  ///< adaptive points in all, 0 or more
  int batch = 8;   ///< points that are chosen together, 1 or more
  /// Who chooses and how often, as "name=weight" with commas between; sampling/criteria.h has the names.
  std::string criteria = "lola_voronoi=0.7,error=0.3";
  double target = 0.0;  ///< NRMSE of every response on the validation runs at which to stop; 0: none
};

/// As one JSON object.
std::string to_text(const Sampling& sampling);
/// Throws nlohmann::json::exception for what is not one.
Sampling sampling_from(const std::string& text);

}  // namespace drawpoint::studies

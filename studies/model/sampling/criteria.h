// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The criteria by which a study chooses its adaptive points, by name: several take turns, each for its
/// share. What each does is in samplers.h.

#include <drawpoint/doe/problem.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// lola_voronoi        where responses bend and where there are holes (doe/lola_voronoi.hpp)
/// voronoi             holes alone
/// distance            far from all runs
/// error               where the ways to fit disagree most, over the responses, each divided by its range
/// cross_validation    beside the run that the others predict worst, likewise
/// variance            where a model is least certain, likewise
/// feasibility         where the limits are likeliest kept
/// improvement         where the front is expected to gain most hypervolume within the limits
/// joint_improvement   of one objective without limits: points of a batch that are expected to gain most together
/// knowledge_gradient  likewise, noisy: where a run is expected to better the best mean most
/// predicted           of one objective: where the model expects the best within the limits
/// repeat              a run made again, where the noise of runs limits the models most (repeats.h)
struct CriterionShare {
  std::string name;
  double weight;  ///< above 0; only the ratios matter
};

/// From "lola_voronoi=0.7,error=0.3", say; a name alone has weight 1. Throws UsageError, saying what is allowed.
std::vector<CriterionShare> criteria_from(const std::string& text);

/// How the next points are dealt out.
struct CriteriaTurns {
  int repeats = 0;                       ///< so many by repeat
  int together = 0;                      ///< so many by joint_improvement
  bool may_repeat = false;               ///< whether repeat was named
  bool may_join = false;                 ///< whether joint_improvement was
  std::vector<CriterionShare> new_ones;  ///< who choose the others, in turn
};

/// Deals out `count` points after the first `made`: each kind of criterion has its share of all so far to within one.
CriteriaTurns turns_of(const std::vector<CriterionShare>& shares, int made, int count);

/// Throws UsageError for criteria that the problem does not allow: improvement without an objective,
/// feasibility without a limit, those of one objective where there is another number or a limit.
void check_criteria(const std::string& text, const doe::Problem& problem);

}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The criteria by which a study chooses its adaptive points, by name: several take turns, each for its
/// share.

#include <drawpoint/studies/models/failures.h>
#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/kriging/transformed_model.hpp>

#include <string>
#include <vector>

namespace drawpoint::studies {

/// lola_voronoi  where responses bend and where there are holes (doe/lola_voronoi.hpp)
/// voronoi       holes alone
/// distance      far from all runs
/// error         where the ways to fit disagree most, over the responses, each divided by its range
/// variance      where a model is least certain, likewise
/// improvement   where the front is expected to gain most hypervolume within the limits
/// repeat        a run made again, where the noise of runs limits the models most (repeats.h)
struct CriterionShare {
  std::string name;
  double weight;  ///< above 0; only the ratios matter
};

/// From "lola_voronoi=0.7,error=0.3"; a name alone has weight 1. Throws UsageError, saying what is allowed.
std::vector<CriterionShare> criteria_from(const std::string& text);

/// How the next points are dealt out.
struct CriteriaTurns {
  int repeats = 0;                       ///< so many by the criterion repeat
  bool may_repeat = false;               ///< whether that was named
  std::vector<CriterionShare> new_ones;  ///< who chooses the others
};

/// Of `count` points after `made` ones: repeats get their share of all points so far to within one.
CriteriaTurns turns_of(const std::vector<CriterionShare>& shares, int made, int count);

/// Throws UsageError for criteria that the problem does not allow: improvement without an objective.
void check_criteria(const std::string& text, const doe::Problem& problem);

/// Of criteria for new points, one or more. models: one per response, of the runs so far. Each score is
/// multiplied by the probability that a run succeeds. `seed` is that of LOLA-Voronoi's test points.
doe::Mix mix_of(const std::vector<CriterionShare>& shares,
                const std::vector<kriging::TransformedModel>& models, const Failures& failures,
                doe::Seed seed);

}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The trade-offs that a study's models predict: found by a search, finished with gradients.
///
/// NSGA-II searches the means of the models; then each of its points is moved to an optimum by pareto::polish
/// in the Chebyshev form, and those that do not arrive again in the ε-constraint form, with the exact
/// gradients of the means and within the limits of the problem. The front is what is non-dominated among all
/// these points, so none of it is worse than the search alone. Points within 1e-7 of the range of a bound are
/// put on it first; their certificates are kept, and off by as little. The gain is measured with the
/// worst values of the searched front plus a tenth of their ranges as the reference point. Whole and
/// categorical variables cannot follow a gradient, and the hypervolume of more than most_polished_objectives
/// objectives takes too long: such fronts stay as searched, and say why. One objective leaves one point.
/// Cost: 10 to 30 iterations of half a millisecond per point inside Ipopt, beside n d per gradient.

#include <drawpoint/studies/polishing.h>
#include <drawpoint/doe/problem.hpp>
#include <drawpoint/kriging/model.hpp>
#include <drawpoint/pareto/search.hpp>

#include <vector>

namespace drawpoint::studies {

inline constexpr int most_polished_objectives = 5;

struct ModelFront {
  pareto::Front front;  ///< rows in rising order of the minimised objectives
  Polishing polishing;
};

/// models: one per response, in order, of the problem's variables. Deterministic: the seed is that of the
/// search.
ModelFront front_of(const std::vector<kriging::Model>& models, const doe::Problem& problem, doe::Seed seed);

/// The second half of it: a front that a search on these models found, polished.
ModelFront finished(const pareto::Front& searched, const std::vector<kriging::Model>& models,
                    const doe::Problem& problem);

}  // namespace drawpoint::studies

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <drawpoint/pareto/ask_and_tell.hpp>
#include <drawpoint/pareto/attainment.hpp>
#include <drawpoint/pareto/choice.hpp>
#include <drawpoint/pareto/crowding.hpp>
#include <drawpoint/pareto/dominance.hpp>
#include <drawpoint/pareto/draws.hpp>
#include <drawpoint/pareto/filter.hpp>
#include <drawpoint/pareto/hypervolume.hpp>
#include <drawpoint/pareto/indicators.hpp>
#include <drawpoint/pareto/knees.hpp>
#include <drawpoint/pareto/local_trade_off.hpp>
#include <drawpoint/pareto/minimised.hpp>
#include <drawpoint/pareto/moead.hpp>
#include <drawpoint/pareto/non_domination.hpp>
#include <drawpoint/pareto/nsga2.hpp>
#include <drawpoint/pareto/nsga3.hpp>
#include <drawpoint/pareto/polish.hpp>
#include <drawpoint/pareto/polished_front.hpp>
#include <drawpoint/pareto/polishing.hpp>
#include <drawpoint/pareto/preference.hpp>
#include <drawpoint/pareto/reference_directions.hpp>
#include <drawpoint/pareto/search.hpp>
#include <drawpoint/pareto/sharpening.hpp>
#include <drawpoint/pareto/smooth_function.hpp>
#include <drawpoint/pareto/sms_emoa.hpp>
#include <drawpoint/pareto/stationarity.hpp>
#include <drawpoint/pareto/trade_off.hpp>
#include <drawpoint/pareto/vorobev.hpp>

/// Search for trade-offs and work with fronts: the whole of the module, in the order of use.
///
/// Search:
///   search.hpp                     what all searches share: options, stopping, report, result
///   nsga2.hpp                      NSGA-II, plain or with controlled elitism, constraints included
///   nsga3.hpp                      NSGA-III, for three and more objectives
///   sms_emoa.hpp                   survival by hypervolume
///   moead.hpp                      one scalar problem per direction
///   ask_and_tell.hpp               a search driven from outside, saved and resumed
///   reference_directions.hpp       evenly spread directions for NSGA-III and MOEA/D
///
/// Polish and certify:
///   smooth_function.hpp            a function with derivatives
///   polish.hpp                     from the points of a search to optima of smooth functions
///   polished_front.hpp             the whole front of a smooth function: searched, polished, sorted out
///   polishing.hpp                  how sure its points are, and what polishing brought
///   stationarity.hpp               how far a point is from first-order optimality
///
/// Measure:
///   minimised.hpp                  from natural signs to objectives that are all minimised
///   dominance.hpp                  dominance and sorting by it
///   crowding.hpp                   crowding distance
///   hypervolume.hpp                exact hypervolume and contributions
///   indicators.hpp                 distances to a reference front
///
/// Decide:
///   choice.hpp                     the answer to a question about a front
///   filter.hpp                     questions with limits
///   preference.hpp                 from aspirations or weights to a point
///   knees.hpp                      points from which every further gain is dear
///   trade_off.hpp                  what one objective costs in another, from point to point
///   local_trade_off.hpp            the same as the slope of a smooth front
///
/// Uncertain fronts:
///   draws.hpp                      what uncertain responses might be
///   non_domination.hpp             how likely each point is on the front
///   attainment.hpp                 bands within which the front lies
///   vorobev.hpp                    how uncertain a front is, as one number
///   sharpening.hpp                 the next simulations that settle it
///
/// What stands in detail/ may change in any version. Needs doe, Eigen and Ipopt.
namespace drawpoint::pareto {}

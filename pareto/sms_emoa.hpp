// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// SMS-EMOA: survival by hypervolume, for the front of fixed size with the largest one.
///
/// Beume, Naujoks, Emmerich 2007, "SMS-EMOA: Multiobjective selection based on dominated hypervolume":
/// parents at random; of the front that does not fit whole, the point that contributes least to that front's
/// hypervolume goes, again and again until it fits. The contributions are those of the objectives scaled to
/// [0, 1] on that front, the reference point at 1 + reference_offset, so units do not matter. The original
/// makes one child at a time; more children per step suit a black box that runs in parallel. A hundred cost 2 %
/// of the hypervolume on ZDT6, at most 0.2 % on other fronts that both find, and keep more of OSY's pieces
/// (docs/measurements/pareto.md). Cost of a removal: contributions of up to N + children points
/// (hypervolume.hpp). Up to eight objectives; beyond five NSGA-III is much quicker.

#include <drawpoint/doe/black_box.hpp>
#include <drawpoint/pareto/ask_and_tell.hpp>
#include <drawpoint/pareto/search.hpp>

namespace drawpoint::pareto {

struct SmsEmoaOptions {
  SearchOptions search{};  ///< a generation is `population` children
  int children = 1;        ///< per step, 1 to population; as many as the black box evaluates at once
  /// Above 0: the larger, the more the ends of the front weigh. 0.1 keeps the ends without favouring them
  /// much at 100 points (Ishibuchi et al. 2018 advise one over the number of divisions of an even front).
  double reference_offset = 0.1;
};

/// Driven from outside (ask_and_tell.hpp). Throws as Nsga2 does, and beyond eight objectives.
class SmsEmoa : public Search {
 public:
  explicit SmsEmoa(const doe::Problem& problem, const SmsEmoaOptions& options = {});
};

/// As nsga2: same problems, same errors, same result.
template <class F>
Front sms_emoa(const F& black_box, const doe::Problem& problem, const SmsEmoaOptions& options = {}) {
  SmsEmoa search(problem, options);
  return finish(search, black_box);
}

}  // namespace drawpoint::pareto

#ifndef DRAWPOINT_PARETO_COMPILED
#include <drawpoint/pareto/detail/sms_emoa_definition.hpp>
#endif

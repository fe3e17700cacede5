// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The next points to run: the best of many random candidates, moved uphill, one after the other, kept apart.
///
/// A candidate is never where a run is already. Among candidates with equal scores, as all of one Voronoi
/// cell have, the one farthest from every run and from the points chosen before it wins (largest minimum
/// distance in the unit box), as LOLA-Voronoi places its points. How a batch is kept apart, with cells those
/// of the runs so far:
///   cells     a cell gives one point, until every cell has given one: the paper's rule
///   penalty   scores, counted from the lowest, are multiplied by min(1, |x − c|²/r²) for each chosen c; r is
///             how far c was from its nearest run. No cell limits it: for scores that vary within cells
///   believer  the sampler is asked anew after each choice, with the outcome that `believe` expects there
///   joint     a joint sampler's criterion knows the points chosen before: for scores of whole batches
/// A chosen candidate climbs to the next maximum of its score (detail/climb_score.hpp), within the rule,
/// where it is allowed, with whole and categorical variables as they are, and no nearer than 1e-4 of the unit
/// box to any run or chosen point. Scores that are constant around a candidate leave it where it is.
/// Cost O(candidates · (n + batch) · d) and the sampler's. Equal runs, options and seed give equal bits.

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <drawpoint/doe/criterion.hpp>
#include <drawpoint/doe/detail/chooser.hpp>
#include <drawpoint/doe/detail/sites.hpp>
#include <drawpoint/doe/propose_options.hpp>

namespace drawpoint::doe {

namespace detail {

inline void check_propose(const ProposeOptions& options) {
  const auto reject = [](const std::string& what) { throw std::invalid_argument("doe::propose: " + what); };
  if (options.batch < 1)
    reject("batch is " + std::to_string(options.batch) +
           "; allowed is 1 or more; ask for at least one point");
  if (options.candidates && *options.candidates < 1)
    reject("candidates is " + std::to_string(*options.candidates) +
           "; allowed is 1 or more; leave it out for 100 per run");
  if (options.rule == BatchRule::believer && !options.believe)
    reject("rule is believer, but believe is empty; give what a run at x would give");
}

/// The rule joint and a joint sampler belong together.
inline void check_rule(const ProposeOptions& options, bool joint_sampler) {
  if (joint_sampler == (options.rule == BatchRule::joint)) return;
  throw std::invalid_argument(
      joint_sampler
          ? "doe::propose: the sampler is a joint one, but the rule is not joint; allowed is "
            "BatchRule::joint; set it, or give a doe::Sampler"
          : "doe::propose: the rule is joint, but the sampler does not ask for the points chosen so far; "
            "allowed is a doe::JointSampler; give one, or another rule");
}

inline int distinct_points(const Evaluations& runs) {
  int sites = 0;
  site_of_rows(runs, sites);
  return sites;
}

/// The Mix that a sampler is or holds, else nullptr.
template <class S>
const Mix* mix_of(const S& sampler) {
  if constexpr (std::same_as<S, Mix>)
    return &sampler;
  else if constexpr (std::same_as<S, Sampler>)
    return sampler.template target<Mix>();
  else
    return nullptr;
}

/// Each part chooses for its turns, which those of pending points precede.
inline void choose_in_turns(Chooser& chooser, const Mix& mix, int first, int batch) {
  const std::vector<int> turns = mix.turns(first, batch);
  for (std::size_t k = 0; k < turns.size(); ++k)
    if (turns[k] > 0) chooser.choose(mix.parts()[k].sampler, turns[k]);
}

}  // namespace detail

/// Points for the next runs, natural units, batch x d; fewer rows when the candidates run out, as they do
/// where `allowed` hardly ever holds. `sampler` is a sampler or a joint one (criterion.hpp); a Mix shares the
/// batch out. Throws std::invalid_argument for options out of range and for a criterion that miscounts.
template <class S>
Eigen::MatrixXd propose(const Evaluations& runs, S&& sampler, const ProposeOptions& options = {}) {
  using Given = std::remove_reference_t<S>;
  check(runs.problem);
  detail::check_propose(options);
  detail::check_rule(options, JointSamplerFunction<Given>);
  detail::Chooser chooser(runs, options);
  require_sampler<Given>();
  if (const Mix* mix = detail::mix_of<std::remove_const_t<Given>>(sampler)) {
    const int pending = static_cast<int>(options.pending.rows());
    detail::choose_in_turns(chooser, *mix, detail::distinct_points(runs) + pending, options.batch);
  } else {
    if constexpr (JointSamplerFunction<Given>)
      chooser.choose_jointly(sampler(runs), options.batch);
    else if constexpr (SamplerFunction<Given>)
      chooser.choose([&sampler](const Evaluations& so_far) -> Criterion { return sampler(so_far); },
                     options.batch);
  }
  return chooser.chosen();
}

}  // namespace drawpoint::doe

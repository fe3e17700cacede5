// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Latin hypercubes that grow: runs are added to a design, and nested designs whose first rows are designs
/// themselves.
///
/// With n runs made and m more, each variable is cut into n + m strata and the new runs take strata that hold
/// none. The result is Latin exactly when no two old runs share a stratum of n + m; that is sure when the old
/// design is Latin and n divides n + m, for then each old stratum falls into equal parts. Else it is as near
/// to Latin as the old runs allow: no stratum gets a second run from us. `nested_latin_hypercube` grows
/// through sizes that divide each other, so that each of its layers is Latin (Qian 2009, "Nested Latin
/// hypercube designs"). The new runs are then improved by exchanges among themselves, with the old ones
/// counted in the criterion. An integer or categorical variable keeps the counts of its values within one
/// where the old runs allow it. Cost as optimized_latin_hypercube.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/optimized_latin_hypercube.hpp>

namespace drawpoint::doe {

struct AugmentedLatinOptions {
  Seed seed = 1;
  LatinCriterion criterion = LatinCriterion::maximin;
  int p = 10;                      ///< exponent of phi_p, even, 2 to 100
  std::optional<int> sweeps = {};  ///< as in OptimizedLatinOptions; 0: new runs at random in free strata
  bool centred = false;            ///< new runs in the middle of their strata
};

namespace detail {

/// Strata of `strata` that none of the values x of a variable has taken, at least strata - x.size() of them.
/// A value of a discrete variable takes one of the strata whose middle it is nearest to.
inline std::vector<int> free_strata(const Eigen::VectorXd& x, const Variable& v, int strata) {
  std::vector<bool> taken(static_cast<std::size_t>(strata), false);
  for (const double value : x) {
    const double share = (value - v.lower) / (is_discrete(v) ? value_count(v) : v.upper - v.lower);
    int s = std::clamp(static_cast<int>(std::floor(share * strata)), 0, strata - 1);
    if (is_discrete(v)) {
      const auto at = [&](int stratum) { return to_natural((stratum + 0.5) / strata, v); };
      while (s < strata && (taken[static_cast<std::size_t>(s)] || at(s) < value)) ++s;
      if (s == strata || at(s) > value) continue;  // the value is held more often than its share already
    }
    taken[static_cast<std::size_t>(s)] = true;
  }
  std::vector<int> free;
  for (int s = 0; s < strata; ++s)
    if (!taken[static_cast<std::size_t>(s)]) free.push_back(s);
  return free;
}

/// more x d strata, each free and none twice in a variable.
inline Eigen::MatrixXi strata_for_more(const Problem& problem, const Eigen::MatrixXd& X, int more,
                                       RandomStream& random) {
  const auto strata = static_cast<int>(X.rows()) + more;
  Eigen::MatrixXi chosen(more, X.cols());
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    std::vector<int> free = free_strata(X.col(j), problem.variables[static_cast<std::size_t>(j)], strata);
    for (int i = 0; i < more; ++i) {
      const int k = i + random.below(static_cast<int>(free.size()) - i);
      std::swap(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(k)]);
      chosen(i, j) = free[static_cast<std::size_t>(i)];
    }
  }
  return chosen;
}

}  // namespace detail

/// The rows of X (n x d, natural units, inside the bounds) as they are, then `more` new ones: (n + more) x d.
/// Throws std::invalid_argument when X does not fit the problem, more < 1, or an option is out of range.
inline Eigen::MatrixXd augmented_latin_hypercube(const Problem& problem, const Eigen::MatrixXd& X, int more,
                                                 const AugmentedLatinOptions& options = {}) {
  const std::string place = "doe::augmented_latin_hypercube";
  detail::check_search(place, options.p, options.sweeps);
  const Eigen::MatrixXd old = detail::to_unit_box(X, problem, place);
  if (more < 1)
    throw std::invalid_argument(place + ": more is " + std::to_string(more) +
                                "; allowed is 1 or more; ask for at least one new run");
  RandomStream random(run_seed(options.seed, static_cast<std::uint64_t>(X.rows()), 0));
  const Eigen::MatrixXi strata = detail::strata_for_more(problem, X, more, random);
  const Eigen::MatrixXd start =
      detail::placed(strata, problem, options.centred, static_cast<int>(X.rows()) + more, random);
  const int sweeps = detail::sweep_budget(options.sweeps, X.rows() + more, X.cols());
  const detail::LatinSearch search{
      options.criterion, options.p, {sweeps, 1e-3}, detail::ExchangeGroups::whole(more, X.cols()), old};
  Eigen::MatrixXd fresh = search.improve(start, random);
  if (search.loss(start) < search.loss(fresh)) fresh = start;
  Eigen::MatrixXd grown(X.rows() + more, X.cols());
  grown << X, detail::to_natural(std::move(fresh), problem);
  return grown;
}

/// sizes.back() x d; the first sizes[k] rows are a Latin hypercube for every k. Each size must be a multiple
/// of the one before. Throws std::invalid_argument otherwise.
inline Eigen::MatrixXd nested_latin_hypercube(const Problem& problem, std::span<const int> sizes,
                                              const AugmentedLatinOptions& options = {}) {
  const std::string place = "doe::nested_latin_hypercube: ";
  if (sizes.empty()) throw std::invalid_argument(place + "sizes is empty; name at least one number of runs");
  for (std::size_t k = 1; k < sizes.size(); ++k)
    if (sizes[k - 1] < 1 || sizes[k] <= sizes[k - 1] || sizes[k] % sizes[k - 1] != 0)
      throw std::invalid_argument(place + "size " + std::to_string(sizes[k]) + " after " +
                                  std::to_string(sizes[k - 1]) +
                                  "; allowed is a larger multiple of a positive size, such as 10, 20, 40");
  Eigen::MatrixXd X = optimized_latin_hypercube(problem, sizes.front(),
                                                {.seed = options.seed,
                                                 .criterion = options.criterion,
                                                 .p = options.p,
                                                 .sweeps = options.sweeps,
                                                 .centred = options.centred});
  for (std::size_t k = 1; k < sizes.size(); ++k)
    X = augmented_latin_hypercube(problem, X, sizes[k] - sizes[k - 1], options);
  return X;
}

}  // namespace drawpoint::doe

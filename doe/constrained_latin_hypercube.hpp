// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Latin hypercube inside a region: every run allowed and, where that can be done, still one run in each
/// stratum.
///
/// Starts from a Latin hypercube and removes its runs that are not allowed by exchanges: such a run swaps its
/// value in one variable with another run's; the swap is kept when the number of allowed runs does not fall
/// (a plateau walk, so that it gets out of dead ends). The design stays Latin all the time (Petelet, Iooss,
/// Asserin, Loredo 2010, "Latin hypercube sampling with inequality constraints"). Then exchanges that keep
/// every run allowed raise the smallest distance: their criterion is phi_p. No such design need exist: the
/// mean of a Latin design is the middle of the box, so a region on one side of it has none, and the search
/// can fail where one exists. Then the runs of the start that are not allowed are replaced as in
/// constrained.hpp, and the status says `not_latin`. Cost: two calls of the predicate an exchange, at most
/// `exchanges` n d of them, and O(n d) each.

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/constrained.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>

namespace drawpoint::doe {

struct ConstrainedLatinOptions {
  Seed seed = 1;
  int exchanges = 200;   ///< a run and variable, 0 or more: budget of the search for an allowed design
  int sweeps = 20;       ///< of exchanges that spread the runs, 0 or more
  int p = 50;            ///< exponent of phi_p, even, 2 to 100
  bool centred = false;  ///< runs in the middle of their strata
  std::optional<int> candidates = {};  ///< of RegionOptions, for runs that must be replaced
  int tries = 1'000'000;               ///< likewise
};

namespace detail {

/// A Latin design in the unit box, and which of its rows are allowed.
template <class P>
class RegionWalk {
 public:
  RegionWalk(const Problem& problem, Eigen::MatrixXd U, const P& allowed)
      : problem_(problem), allowed_(allowed), U_(std::move(U)), inside_(static_cast<std::size_t>(U_.rows())) {
    for (Eigen::Index i = 0; i < U_.rows(); ++i) inside_[static_cast<std::size_t>(i)] = holds(i);
  }

  const Eigen::MatrixXd& design() const { return U_; }

  std::vector<int> outside() const {
    std::vector<int> rows;
    for (std::size_t i = 0; i < inside_.size(); ++i)
      if (!inside_[i]) rows.push_back(static_cast<int>(i));
    return rows;
  }

  /// Plateau walk; true when every row is allowed.
  bool enter(int exchanges, RandomStream& random) {
    const auto n = static_cast<int>(U_.rows());
    for (int e = 0; e < exchanges && n > 1; ++e) {
      const std::vector<int> rows = outside();
      if (rows.empty()) return true;
      const int i = rows[static_cast<std::size_t>(random.below(static_cast<int>(rows.size())))];
      const int k = (i + 1 + random.below(n - 1)) % n;
      swap(i, k, random.below(static_cast<int>(U_.cols())));
    }
    return outside().empty();
  }

  /// Whether rows i and k are allowed after swapping variable j.
  bool may_swap(Eigen::Index i, Eigen::Index k, Eigen::Index j) {
    std::swap(U_(i, j), U_(k, j));
    const bool both = holds(i) && holds(k);
    std::swap(U_(i, j), U_(k, j));
    return both;
  }

  void apply(Eigen::Index i, Eigen::Index k, Eigen::Index j) { std::swap(U_(i, j), U_(k, j)); }

 private:
  bool holds(Eigen::Index i) const {
    Eigen::VectorXd x(U_.cols());
    for (Eigen::Index j = 0; j < x.size(); ++j)
      x[j] = to_natural(U_(i, j), problem_.variables[static_cast<std::size_t>(j)]);
    return allowed_(x);
  }

  /// Kept when as many of the two rows are allowed as before.
  void swap(int i, int k, int j) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(k);
    std::swap(U_(i, j), U_(k, j));
    const bool first = holds(i), second = holds(k);
    if (first + second >= inside_[a] + inside_[b]) {
      inside_[a] = first;
      inside_[b] = second;
    } else {
      std::swap(U_(i, j), U_(k, j));
    }
  }

  const Problem& problem_;
  const P& allowed_;
  Eigen::MatrixXd U_;
  std::vector<char> inside_;
};

/// Exchanges that lower phi_p and keep every row allowed.
template <class P>
Eigen::MatrixXd exchanged_inside(RegionWalk<P>& walk, int sweeps, int p, RandomStream& random) {
  PairPotential potential(walk.design(), p);
  const auto n = static_cast<int>(walk.design().rows());
  const Eigen::Index d = walk.design().cols();
  for (int s = 0; s < sweeps && n > 1; ++s) {
    for (Eigen::Index attempt = 0; attempt < n * d / 2; ++attempt) {
      const int i = random.below(n), k = (i + 1 + random.below(n - 1)) % n;
      const double change = potential.change(i, k, attempt % d);
      if (change >= 0.0 || !walk.may_swap(i, k, attempt % d)) continue;
      potential.exchange(i, k, attempt % d, change);
      walk.apply(i, k, attempt % d);
    }
    potential.refresh();
  }
  return walk.design();
}

}  // namespace detail

/// runs x d, or fewer with status too_small. Throws std::invalid_argument when runs < 1 or an option is out
/// of range.
template <class P>
ConstrainedDesign constrained_latin_hypercube(const Problem& problem, int runs, const P& allowed,
                                              const ConstrainedLatinOptions& options = {}) {
  require_point_predicate<P>();
  const std::string place = "doe::constrained_latin_hypercube";
  detail::check_design(place.c_str(), problem, runs);
  detail::check_search(place, options.p, options.sweeps);
  const RegionOptions region{.seed = options.seed, .candidates = options.candidates, .tries = options.tries};
  detail::check_region(place.c_str(), region);
  if (options.exchanges < 0)
    throw std::invalid_argument(place + ": exchanges is " + std::to_string(options.exchanges) +
                                "; allowed is 0 or more; 200 is usual");
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  RandomStream random(options.seed);
  const Eigen::MatrixXi strata = detail::random_strata(runs, d, random);
  const Eigen::MatrixXd start = detail::placed(strata, problem, options.centred, runs, random);
  detail::RegionWalk walk(problem, start, allowed);
  const double share = 1.0 - static_cast<double>(walk.outside().size()) / runs;
  const double budget = static_cast<double>(options.exchanges) * runs * static_cast<double>(d);
  if (walk.enter(static_cast<int>(std::min(budget, 1e9)), random)) {
    Eigen::MatrixXd U = detail::exchanged_inside(walk, options.sweeps, options.p, random);
    return {detail::to_natural(std::move(U), problem), RegionStatus::complete, "", share, 0};
  }
  ConstrainedDesign design =
      feasible_replacement(problem, detail::to_natural(start, problem), allowed, region);
  if (design.status != RegionStatus::complete) return design;
  design.status = RegionStatus::not_latin;
  design.message = "no Latin hypercube inside the region was found: " + std::to_string(design.replaced) +
                   " of " + std::to_string(runs) +
                   " runs moved; raise exchanges, or shrink the bounds to the region";
  return design;
}

}  // namespace drawpoint::doe

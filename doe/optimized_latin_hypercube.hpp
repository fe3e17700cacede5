// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Latin hypercubes chosen among all for how evenly they fill the box.
///
/// Criteria (unit box; quality.hpp has the formulas): the smallest distance of two runs, largest (Johnson,
/// Moore, Ylvisaker 1990); phi_p, smallest (Morris, Mitchell 1995); the centred L2 discrepancy, smallest
/// (Fang, Li, Sudjianto 2006). Maximin is searched through phi_p with p = 100, whose smallest value is the
/// largest distance as p → ∞.
///
/// Two searches: a random Latin hypercube is annealed (latin_annealing.hpp), and the best of many good lattice
/// point sets (lattice.hpp) is improved by descent. Lattices reach the larger distances for many runs in few
/// variables, but sample a wave at regular places: a model of it may be wrong everywhere between them, and
/// leave-one-out does not tell. So the default anneals. Fixed runs (corners) count in the criterion. Integer and
/// categorical variables stay balanced; levels of a categorical variable are taken as if they were in order,
/// which costs evenness, not balance. Cost O(sweeps n² d²) time, O(n d) memory. n = 500, d = 4 takes below a
/// second.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include <drawpoint/doe/detail/latin_annealing.hpp>
#include <drawpoint/doe/detail/lattice.hpp>
#include <drawpoint/doe/latin_hypercube.hpp>
#include <drawpoint/doe/quality.hpp>

namespace drawpoint::doe {

enum class LatinCriterion { maximin, phi_p, centred_discrepancy };

/// Where the search starts: `best` tries both, each with half of the sweeps, and takes the more even result. In
/// few variables the best lattice is the same for every seed: then `lattice` and `best` give the same set of
/// points again, which validates nothing that was fitted to it.
enum class LatinStart { best, random, lattice };

struct OptimizedLatinOptions {
  Seed seed = 1;
  LatinCriterion criterion = LatinCriterion::maximin;
  int p = 10;  ///< exponent of phi_p, even, 2 to 100; large p sees only the closest pairs
  /// Budget, 0 or more; empty: 2e8/(n d)² up to 2000, but 10 up to n d = 14 000, then fewer, never below
  /// 2: below a second up to n d = 5000, a few seconds up to 20 000.
  std::optional<int> sweeps = {};
  LatinStart start = LatinStart::random;
  bool corners = false;  ///< the 2^d corners come first and count in `runs`
  bool centred = true;   ///< runs in the middle of their strata; false: at random inside them
};

namespace detail {

inline void check_search(const std::string& place, int p, std::optional<int> sweeps) {
  if (p < 2 || p > 100 || p % 2 != 0)
    throw std::invalid_argument(place + ": p is " + std::to_string(p) +
                                "; allowed is an even number from 2 to 100; 10 is usual");
  if (sweeps && *sweeps < 0)
    throw std::invalid_argument(
        place + ": sweeps is " + std::to_string(*sweeps) +
        "; allowed is 0 or more; leave it out for a budget by size, 50 to 500 is usual");
}

/// The budget for n movable rows of d variables.
inline int sweep_budget(std::optional<int> sweeps, Eigen::Index n, Eigen::Index d) {
  if (sweeps) return *sweeps;
  const double elements = static_cast<double>(n) * static_cast<double>(d);
  const double least = std::clamp(2e9 / (elements * elements), 2.0, 10.0);
  return static_cast<int>(std::clamp(2e8 / (elements * elements), least, 2000.0));
}

/// A design being searched: movable rows of the unit box, and fixed rows that only count.
struct LatinSearch {
  LatinCriterion criterion = LatinCriterion::maximin;
  int p = 10;
  AnnealingSchedule schedule = {};
  ExchangeGroups groups = {};
  Eigen::MatrixXd fixed = {};

  /// The movable rows after the search.
  Eigen::MatrixXd improve(const Eigen::MatrixXd& movable, RandomStream& random) const {
    if (criterion == LatinCriterion::centred_discrepancy)
      return run(CentredDiscrepancy(joined(movable)), movable.rows(), random);
    return run(PairPotential(joined(movable), exponent()), movable.rows(), random);
  }

  /// What is to be small.
  double loss(const Eigen::MatrixXd& movable) const {
    switch (criterion) {
      case LatinCriterion::maximin:
        return -minimum_distance(joined(movable));
      case LatinCriterion::phi_p:
        return PairPotential(joined(movable), p).value();
      case LatinCriterion::centred_discrepancy:
        return squared_centred_discrepancy(joined(movable));
    }
    return 0.0;
  }

 private:
  int exponent() const { return criterion == LatinCriterion::maximin ? 100 : p; }

  Eigen::MatrixXd joined(const Eigen::MatrixXd& movable) const {
    Eigen::MatrixXd all(movable.rows() + fixed.rows(), movable.cols());
    all.topRows(movable.rows()) = movable;
    if (fixed.rows() > 0) all.bottomRows(fixed.rows()) = fixed;
    return all;
  }

  /// The temperature is a share of the value, which for phi_p is the p-th power of what counts.
  template <class Criterion>
  Eigen::MatrixXd run(Criterion state, Eigen::Index movable, RandomStream& random) const {
    AnnealingSchedule scaled = schedule;
    if (criterion != LatinCriterion::centred_discrepancy) scaled.temperature *= exponent();
    anneal(state, groups, scaled, random);
    return state.design().topRows(movable);
  }
};

/// Places in the unit box of n x d strata; an integer or categorical variable stands at the middle of its
/// value's part.
inline Eigen::MatrixXd placed(const Eigen::MatrixXi& strata, const Problem& problem, bool centred, int n,
                              RandomStream& random) {
  Eigen::MatrixXd U(strata.rows(), strata.cols());
  for (Eigen::Index j = 0; j < U.cols(); ++j) {
    const Variable& v = problem.variables[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < U.rows(); ++i) {
      const double within = centred || is_discrete(v) ? 0.5 : random.uniform();
      U(i, j) = (strata(i, j) + within) / n;
      if (is_discrete(v)) U(i, j) = to_unit(to_natural(U(i, j), v), v);
    }
  }
  return U;
}

inline Eigen::MatrixXi random_strata(int n, Eigen::Index d, RandomStream& random) {
  return (unit_latin_hypercube(n, d, random()) * n).array().floor().cast<int>();
}

/// The best of several shifted lattices without a correlation above 1/4; random strata when there is none.
inline Eigen::MatrixXd lattice_start(const LatinSearch& search, const Problem& problem, int n, bool centred,
                                     RandomStream& random) {
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const auto rank = search.criterion == LatinCriterion::centred_discrepancy ? LatticeRank::discrepancy
                                                                            : LatticeRank::distance;
  const double pairs = static_cast<double>(n) * n * static_cast<double>(d);
  const int tries = static_cast<int>(std::clamp(1e8 / pairs, 2.0, 16.0));
  Eigen::MatrixXd best = placed(random_strata(n, d, random), problem, centred, n, random);
  double least = search.loss(best);
  for (const Lattice& lattice : good_lattices(n, d, rank, tries))
    for (int shift = 0; shift < (lattice.modulus == n ? 4 : 1); ++shift) {
      Eigen::MatrixXd U = placed(lattice_strata(lattice, n, random), problem, centred, n, random);
      if (largest_correlation(U) > 0.25) continue;
      const double loss = search.loss(U);
      if (loss < least) std::tie(best, least) = std::pair(std::move(U), loss);
    }
  return best;
}

/// Annealings that share `sweeps`: small designs have deep local optima, and many starts are the cure.
inline int annealing_starts(int n, Eigen::Index d, int sweeps) {
  const int by_size = static_cast<int>(600 / std::max<Eigen::Index>(n * d, 1));
  return std::clamp(by_size, 1, std::clamp(sweeps / 50, 1, 40));
}

/// n x d in the unit box; `fixed` rows count in the criterion.
inline Eigen::MatrixXd optimized_unit_latin(const Problem& problem, int n,
                                            const OptimizedLatinOptions& options, Eigen::MatrixXd fixed) {
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const int budget = sweep_budget(options.sweeps, n, d);
  const int sweeps = options.start == LatinStart::best ? (budget + 1) / 2 : budget;
  LatinSearch search{
      options.criterion, options.p, {sweeps, 0.0}, ExchangeGroups::whole(n, d), std::move(fixed)};
  Eigen::MatrixXd best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](Eigen::MatrixXd start, double temperature, RandomStream& random) {
    search.schedule.temperature = temperature;
    Eigen::MatrixXd improved = search.improve(start, random);
    for (Eigen::MatrixXd* U : {&start, &improved})
      if (const double loss = search.loss(*U); loss < least || best.size() == 0)
        std::tie(best, least) = std::pair(std::move(*U), loss);
  };
  if (options.start != LatinStart::random) {
    RandomStream random(run_seed(options.seed, 0, 0));
    consider(lattice_start(search, problem, n, options.centred, random), 0.0, random);
  }
  if (options.start != LatinStart::lattice) {
    const int starts = annealing_starts(n, d, sweeps);
    search.schedule.sweeps = sweeps / starts;
    for (int start = 0; start < starts; ++start) {
      RandomStream random(run_seed(options.seed, 1, start));
      consider(placed(random_strata(n, d, random), problem, options.centred, n, random), 1e-3, random);
    }
  }
  return best;
}

}  // namespace detail

/// runs x d; Latin but for corners. Throws std::invalid_argument when runs < 1, when corners are asked for
/// and runs < 2^d, or on an option out of range.
inline Eigen::MatrixXd optimized_latin_hypercube(const Problem& problem, int runs,
                                                 const OptimizedLatinOptions& options = {}) {
  const char* place = "doe::optimized_latin_hypercube";
  detail::check_design(place, problem, runs);
  detail::check_search(place, options.p, options.sweeps);
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const int corners = detail::corner_count(place, problem, runs, options.corners);
  Eigen::MatrixXd X(runs, d), fixed;
  if (corners > 0) {
    X.topRows(corners) = detail::to_natural(detail::unit_corners(d), problem);
    fixed = detail::to_unit_box(X.topRows(corners), problem, place);
  }
  if (runs > corners)
    X.bottomRows(runs - corners) = detail::to_natural(
        detail::optimized_unit_latin(problem, runs - corners, options, std::move(fixed)), problem);
  return X;
}

}  // namespace drawpoint::doe

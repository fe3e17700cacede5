// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Orthogonal arrays, and Latin hypercubes that keep their balance in several variables at once.
///
/// An orthogonal array of strength t has q^t runs and q levels: in any t variables each of the q^t
/// combinations occurs once. Bush's construction (Bush 1952; Bose 1938 is t = 2): run i is the polynomial of
/// degree below t over GF(q) whose coefficients are the digits of i in base q; variable j takes its value at
/// the element j, and variable q its leading coefficient. It exists for q a prime power and, q + 1 >= d, t <=
/// q. In the Latin hypercube built on it (Tang 1993, "Orthogonal array-based Latin hypercubes") the runs of
/// one level take its q^(t-1) strata in random order, after the levels of each variable have been permuted: n
/// strata in each variable, a q^t grid with one run a cell in any t. Exchanges inside the levels keep both
/// and improve a criterion. Cost O(n d) and the search.

#include <Eigen/Core>
#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <drawpoint/doe/detail/galois_field.hpp>
#include <drawpoint/doe/detail/permutation.hpp>
#include <drawpoint/doe/optimized_latin_hypercube.hpp>

namespace drawpoint::doe {

struct OrthogonalLatinOptions {
  Seed seed = 1;
  int strength = 2;  ///< t, 2 or more: how many variables at once are stratified
  LatinCriterion criterion = LatinCriterion::centred_discrepancy;
  int p = 10;                      ///< exponent of phi_p, even, 2 to 100
  std::optional<int> sweeps = {};  ///< as in OptimizedLatinOptions; 0: the plain design of Tang
  bool centred = false;            ///< runs in the middle of their strata
};

namespace detail {

/// q when runs = q^t, q a prime power that serves d variables; else 0.
inline int array_levels(int runs, int strength, Eigen::Index d) {
  for (int q = 2; q <= runs; ++q) {
    std::int64_t power = 1;
    for (int t = 0; t < strength && power <= runs; ++t) power *= q;
    if (power > runs) return 0;
    if (power == runs) return prime_of_power(q) != 0 && q + 1 >= d && strength <= q ? q : 0;
  }
  return 0;
}

/// Value of the polynomial with these coefficients (lowest first) at x, by Horner.
inline int polynomial_value(const GaloisField& field, const std::vector<int>& coefficients, int x) {
  int value = 0;
  for (std::size_t k = coefficients.size(); k-- > 0;)
    value = field.sum(field.product(value, x), coefficients[k]);
  return value;
}

}  // namespace detail

/// The smallest number of runs, at least `at_least`, that an array of this strength for d variables can have.
inline int orthogonal_array_runs(int at_least, Eigen::Index d, int strength = 2) {
  if (strength < 2 || strength > 6 || d < 1 || d > 1000 || at_least < 1)
    throw std::invalid_argument("doe::orthogonal_array_runs: " + std::to_string(at_least) + " runs, " +
                                std::to_string(d) + " variables, strength " + std::to_string(strength) +
                                "; allowed are 1 or more, 1 to 1000, 2 to 6; correct the one outside");
  for (int q = 2;; ++q) {
    const double runs = std::pow(q, strength);
    if (runs > 1e9)
      throw std::invalid_argument("doe::orthogonal_array_runs: no array of strength " +
                                  std::to_string(strength) + " with fewer than 1e9 runs; lower the strength");
    if (runs >= at_least && detail::array_levels(static_cast<int>(runs), strength, d) == q)
      return static_cast<int>(runs);
  }
}

/// q^strength x d levels 0..q-1. Throws std::invalid_argument when q is no prime power, or serves too few
/// variables.
inline Eigen::MatrixXi orthogonal_array(int q, Eigen::Index d, int strength = 2) {
  if (detail::prime_of_power(q) == 0 || d < 1 || d > q + 1 || strength < 2 || strength > q || strength > 6)
    throw std::invalid_argument(
        "doe::orthogonal_array: " + std::to_string(q) + " levels, " + std::to_string(d) +
        " variables, strength " + std::to_string(strength) +
        "; allowed are a prime power, 1 to levels + 1, and 2 to the smaller of levels and 6; "
        "take more levels");
  const detail::GaloisField field(q);
  const auto runs = static_cast<Eigen::Index>(std::llround(std::pow(q, strength)));
  Eigen::MatrixXi levels(runs, d);
  std::vector<int> coefficients(static_cast<std::size_t>(strength));
  for (Eigen::Index i = 0; i < runs; ++i) {
    auto rest = static_cast<int>(i);
    for (int& c : coefficients) rest = (c = rest % q, rest / q);
    for (Eigen::Index j = 0; j < d; ++j)
      levels(i, j) =
          j == q ? coefficients.back() : detail::polynomial_value(field, coefficients, static_cast<int>(j));
  }
  return levels;
}

namespace detail {

/// Rows of each column level after level, in the order of the strata that they take; levels permuted at
/// random.
inline ExchangeGroups level_groups(const Eigen::MatrixXi& levels, int q, RandomStream& random) {
  ExchangeGroups groups{Eigen::MatrixXi(levels.rows(), levels.cols()), static_cast<int>(levels.rows()) / q};
  std::vector<int> place(static_cast<std::size_t>(q)), rows(static_cast<std::size_t>(groups.size));
  std::iota(place.begin(), place.end(), 0);
  for (Eigen::Index j = 0; j < levels.cols(); ++j) {
    shuffle(place, random);
    for (int level = 0; level < q; ++level) {
      rows.clear();
      for (Eigen::Index i = 0; i < levels.rows(); ++i)
        if (levels(i, j) == level) rows.push_back(static_cast<int>(i));
      shuffle(rows, random);
      const Eigen::Index first =
          static_cast<Eigen::Index>(place[static_cast<std::size_t>(level)]) * groups.size;
      groups.rows.col(j).segment(first, groups.size) = Eigen::Map<Eigen::VectorXi>(rows.data(), groups.size);
    }
  }
  return groups;
}

}  // namespace detail

/// runs x d, runs = q^strength. Throws std::invalid_argument, with the next number of runs that is allowed,
/// when there is no such array, or on an option out of range.
inline Eigen::MatrixXd orthogonal_latin_hypercube(const Problem& problem, int runs,
                                                  const OrthogonalLatinOptions& options = {}) {
  const std::string place = "doe::orthogonal_latin_hypercube";
  detail::check_design(place.c_str(), problem, runs);
  detail::check_search(place, options.p, options.sweeps);
  const auto d = static_cast<Eigen::Index>(problem.variables.size());
  const int next = orthogonal_array_runs(runs, d, options.strength);
  if (next != runs)
    throw std::invalid_argument(place + ": no orthogonal array of " + std::to_string(runs) + " runs for " +
                                std::to_string(d) + " variables at strength " +
                                std::to_string(options.strength) + "; the next larger one has " +
                                std::to_string(next) + " runs");
  const int q = detail::array_levels(runs, options.strength, d);
  RandomStream random(options.seed);
  detail::ExchangeGroups groups = detail::level_groups(orthogonal_array(q, d, options.strength), q, random);
  Eigen::MatrixXi strata(runs, d);
  for (Eigen::Index j = 0; j < d; ++j)
    for (int s = 0; s < runs; ++s) strata(groups.rows(s, j), j) = s;
  const Eigen::MatrixXd start = detail::placed(strata, problem, options.centred, runs, random);
  const int sweeps = detail::sweep_budget(options.sweeps, runs, d);
  const detail::LatinSearch search{options.criterion, options.p, {sweeps, 1e-3}, std::move(groups), {}};
  Eigen::MatrixXd U = search.improve(start, random);
  return detail::to_natural(search.loss(U) < search.loss(start) ? std::move(U) : start, problem);
}

}  // namespace drawpoint::doe

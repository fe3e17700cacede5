// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Fractional factorial: 2^k of the 2^d combinations of the bounds, chosen by generators (aliasing.hpp).
///
/// Run i has the bits of i as levels of the first k variables (the last of them fastest); the others are the
/// signed products that their generators name. `fractional_generators` finds generators of minimum aberration
/// by trying all sets where that takes fewer than 2e7 words, else the best of one generator after another, each the
/// best so far, and of lexicographic codes (then a higher resolution may exist). Cost O(n d) once the generators are
/// known.

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <drawpoint/doe/aliasing.hpp>
#include <drawpoint/doe/detail/scaling.hpp>

namespace drawpoint::doe {

namespace detail {

/// Searches the words of `generated` variables over `free` ones for the least word counts, shortest words
/// first.
class AberrationSearch {
 public:
  AberrationSearch(int free, int generated) : free_(free), generated_(generated) {
    for (std::uint32_t word = 1; word < 1U << free; ++word)
      if (std::popcount(word) >= 2) candidates_.push_back(word);
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](auto a, auto b) { return std::popcount(a) > std::popcount(b); });
  }

  std::vector<std::uint32_t> best() {
    if (choices() * std::ldexp(1.0, generated_) < 2e7) {
      extend(0, {0}, {});
      return best_;
    }
    std::vector<std::uint32_t> group{0}, chosen;
    while (static_cast<int>(chosen.size()) < generated_) chosen.push_back(best_next(group, chosen));
    least_ = counts(group), best_ = chosen;
    for (int resolution = 4; resolution <= 7; ++resolution) try_lexicode(resolution);
    return best_;
  }

 private:
  using Counts = std::vector<int>;

  double choices() const {
    double count = 1.0;
    for (int k = 0; k < generated_; ++k) count *= (static_cast<double>(candidates_.size()) - k) / (k + 1.0);
    return count;
  }

  /// The group with one more generator, word times its own variable.
  std::vector<std::uint32_t> joined(std::vector<std::uint32_t> group, std::uint32_t word,
                                    std::size_t place) const {
    const std::uint32_t own = word | 1U << (static_cast<std::size_t>(free_) + place);
    for (std::size_t k = 0, size = group.size(); k < size; ++k) group.push_back(group[k] ^ own);
    return group;
  }

  Counts counts(const std::vector<std::uint32_t>& group) const {
    Counts lengths(static_cast<std::size_t>(free_ + generated_ + 1), 0);
    for (const std::uint32_t word : group) ++lengths[static_cast<std::size_t>(std::popcount(word))];
    return lengths;
  }

  void extend(std::size_t next, const std::vector<std::uint32_t>& group, std::vector<std::uint32_t> chosen) {
    if (static_cast<int>(chosen.size()) == generated_) {
      if (const Counts found = counts(group); best_.empty() || found < least_)
        std::tie(least_, best_) = std::pair(found, std::move(chosen));
      return;
    }
    for (std::size_t k = next; k < candidates_.size(); ++k) {
      std::vector<std::uint32_t> more = chosen;
      more.push_back(candidates_[k]);
      extend(k + 1, joined(group, candidates_[k], chosen.size()), std::move(more));
    }
  }

  /// The columns in rising order that are no sum of resolution - 2 or fewer of those before (Conway, Sloane 1986).
  void try_lexicode(int resolution) {
    std::vector<int> terms(std::size_t{1} << free_, resolution);  // fewest columns that sum up to each word
    terms[0] = 0;
    const auto add = [&](std::uint32_t word) {
      const std::vector<int> before = terms;
      for (std::size_t w = 0; w < terms.size(); ++w)
        terms[w ^ word] = std::min(terms[w ^ word], before[w] + 1);
    };
    for (int j = 0; j < free_; ++j) add(1U << j);
    std::vector<std::uint32_t> group{0}, chosen;
    for (std::uint32_t word = 1; word < 1U << free_ && static_cast<int>(chosen.size()) < generated_; ++word) {
      if (terms[word] <= resolution - 2) continue;
      group = joined(std::move(group), word, chosen.size());
      chosen.push_back(word);
      add(word);
    }
    if (static_cast<int>(chosen.size()) < generated_) return;
    if (const Counts found = counts(group); found < least_) least_ = found, best_ = chosen;
  }

  std::uint32_t best_next(std::vector<std::uint32_t>& group, const std::vector<std::uint32_t>& chosen) const {
    std::uint32_t best = 0;
    Counts least;
    for (const std::uint32_t word : candidates_) {
      if (std::find(chosen.begin(), chosen.end(), word) != chosen.end()) continue;
      if (const Counts found = counts(joined(group, word, chosen.size())); best == 0 || found < least)
        std::tie(least, best) = std::pair(found, word);
    }
    group = joined(std::move(group), best, chosen.size());
    return best;
  }

  int free_, generated_;
  std::vector<std::uint32_t> candidates_;
  std::vector<std::uint32_t> best_ = {};
  Counts least_ = {};
};

}  // namespace detail

/// Generators for d variables in `runs` = 2^k runs, k <= 10, at most 20 generated variables; none when runs =
/// 2^d. Throws std::invalid_argument when runs is no such power, or too small to hold d main effects apart.
inline std::vector<std::string> fractional_generators(int d, int runs) {
  const bool power = runs >= 2 && runs <= 1024 && std::has_single_bit(static_cast<unsigned>(runs));
  const int k = power ? std::countr_zero(static_cast<unsigned>(runs)) : 0;
  if (!power || d < k || d > 25 || d - k > 20 || d > runs - 1)
    throw std::invalid_argument(
        "doe::fractional_generators: " + std::to_string(d) + " variables in " + std::to_string(runs) +
        " runs; allowed are a power of 2 from d + 1 to 2^d, at most " + "1024, and up to 25 variables");
  std::vector<std::string> generators;
  if (d == k) return generators;
  std::size_t j = static_cast<std::size_t>(k);
  for (const std::uint32_t word : detail::AberrationSearch(k, d - k).best())
    generators.push_back(std::string(1, detail::factor_letters[j++]) + "=" +
                         detail::word_text({word, false}));
  return generators;
}

/// 2^(d - generators) x d, the bounds as levels. Throws std::invalid_argument on a generator that cannot be
/// read, or more than 2^20 runs.
inline Eigen::MatrixXd fractional_factorial(const Problem& problem,
                                            const std::vector<std::string>& generators) {
  check(problem);
  const std::size_t d = problem.variables.size();
  const std::vector<detail::Word> generated = detail::generated_words(d, generators);
  const std::size_t free = d - generated.size();
  if (free > 20)
    throw std::invalid_argument("doe::fractional_factorial: 2^" + std::to_string(free) +
                                " runs; allowed is up to 2^20; add generators");
  Eigen::MatrixXd U(Eigen::Index{1} << free, static_cast<Eigen::Index>(d));
  for (Eigen::Index i = 0; i < U.rows(); ++i) {
    for (std::size_t j = 0; j < free; ++j)
      U(i, static_cast<Eigen::Index>(j)) = static_cast<double>(i >> (free - 1 - j) & 1);
    for (std::size_t g = 0; g < generated.size(); ++g) {
      bool minus = generated[g].negative;
      for (std::size_t j = 0; j < free; ++j)
        if (generated[g].factors >> j & 1U) minus = minus != (U(i, static_cast<Eigen::Index>(j)) == 0.0);
      U(i, static_cast<Eigen::Index>(free + g)) = minus ? 0.0 : 1.0;
    }
  }
  return detail::to_natural(std::move(U), problem);
}

/// The fraction of minimum aberration with this number of runs.
inline Eigen::MatrixXd fractional_factorial(const Problem& problem, int runs) {
  check(problem);
  return fractional_factorial(problem,
                              fractional_generators(static_cast<int>(problem.variables.size()), runs));
}

}  // namespace drawpoint::doe

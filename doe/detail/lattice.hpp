// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Good lattice points: Latin designs whose points lie on a lattice, the quick way to a design that is even.
///
/// Stratum of row i in variable j: (i·h_j + c_j) mod n, or ((i + 1)·h_j mod (n + 1)) - 1, with every h_j
/// coprime to the modulus, so that each variable meets each of the n strata once. Generators of Korobov's
/// form h_j = a^j mod the modulus are tried (all a up to the half, or an even choice of them when n is large)
/// and ranked either by the shortest distance on the torus or by the wrap-around discrepancy; both are O(n d)
/// a generator, because all points of a lattice see the same neighbours. Korobov 1959; Zhou, Xu 2015,
/// "Space-filling properties of good lattice point sets". Such a design is regular: many pairs stand at equal
/// distances.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <drawpoint/doe/seed.hpp>

namespace drawpoint::doe::detail {

struct Lattice {
  std::int64_t modulus = 1;             ///< n, or n + 1 with the point at the origin left out
  std::vector<std::int64_t> generator;  ///< h_j
  double loss = 0.0;                    ///< smaller is better, for the ranking only
};

enum class LatticeRank { distance, discrepancy };

/// -(shortest squared distance on the torus), or the wrap-around discrepancy without its constant.
inline double lattice_loss(const Lattice& lattice, LatticeRank rank) {
  const auto m = static_cast<double>(lattice.modulus);
  double least = std::numeric_limits<double>::infinity(), sum = 0.0;
  for (std::int64_t i = 1; i <= lattice.modulus / 2; ++i) {
    double squares = 0.0, product = 1.0;
    for (const std::int64_t h : lattice.generator) {
      const double t = static_cast<double>(i * h % lattice.modulus) / m;
      const double gap = std::min(t, 1.0 - t);
      squares += gap * gap;
      product *= 1.5 - t * (1.0 - t);
    }
    least = std::min(least, squares);
    sum += product;
  }
  return rank == LatticeRank::distance ? -least : sum / m;
}

/// Korobov's generator; empty when a is not coprime to the modulus.
inline std::vector<std::int64_t> korobov(std::int64_t a, Eigen::Index d, std::int64_t modulus) {
  if (std::gcd(a, modulus) != 1) return {};
  std::vector<std::int64_t> generator{1};
  while (static_cast<Eigen::Index>(generator.size()) < d) generator.push_back(generator.back() * a % modulus);
  return generator;
}

/// The best `count` lattices of n or n + 1 points, best first.
inline std::vector<Lattice> good_lattices(int n, Eigen::Index d, LatticeRank rank, int count) {
  std::vector<Lattice> found;
  for (const std::int64_t modulus : {std::int64_t{n}, std::int64_t{n} + 1}) {
    const std::int64_t affordable = std::max<std::int64_t>(16, 20'000'000 / (modulus * d));
    const std::int64_t step = std::max<std::int64_t>(1, modulus / 2 / affordable);
    for (std::int64_t a = 2; a <= modulus / 2; a += step) {
      Lattice lattice{modulus, korobov(a, d, modulus), 0.0};
      if (lattice.generator.empty()) continue;
      lattice.loss = lattice_loss(lattice, rank);
      found.push_back(std::move(lattice));
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.loss < b.loss; });
  if (found.size() > static_cast<std::size_t>(count)) found.resize(static_cast<std::size_t>(count));
  return found;
}

/// n x d strata 0..n-1; a lattice of n points is shifted at random, for each shift is Latin.
inline Eigen::MatrixXi lattice_strata(const Lattice& lattice, int n, RandomStream& random) {
  Eigen::MatrixXi strata(n, static_cast<Eigen::Index>(lattice.generator.size()));
  const bool shifted = lattice.modulus == n;
  for (Eigen::Index j = 0; j < strata.cols(); ++j) {
    const std::int64_t h = lattice.generator[static_cast<std::size_t>(j)],
                       shift = shifted ? random.below(n) : 0;
    for (int i = 0; i < n; ++i)
      strata(i, j) = static_cast<int>(shifted ? (i * h + shift) % n : (i + 1) * h % lattice.modulus - 1);
  }
  return strata;
}

}  // namespace drawpoint::doe::detail

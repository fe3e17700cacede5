// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// Simulated binary crossover and polynomial mutation in the unit box, and the children that they make.
///
/// Crossover (Deb, Agrawal 1995): children y = ((a + b) ∓ β (b - a))/2 with β drawn so that children stay in
/// [0, 1] and near the parents, the nearer the larger the index η_c; each variable takes part with
/// probability 1/2. Mutation (Deb, Goyal 1996): y + δ with δ from a polynomial of index η_m, cut at the
/// bounds. An integer variable takes the value nearest to what crossover made of it, and a mutation moves it
/// by δ times its number of steps, one step at least. Parents are chosen by binary tournament: the better
/// rank, then the larger distance.

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <drawpoint/doe/seed.hpp>
#include <drawpoint/pareto/detail/population.hpp>
#include <drawpoint/pareto/detail/search_space.hpp>
#include <drawpoint/pareto/detail/setting.hpp>

namespace drawpoint::pareto::detail {

/// base^exponent, by multiplication where the exponent is a small whole number, as η + 1 mostly is.
inline double power(double base, double exponent) {
  if (!(exponent >= 0.0 && exponent <= 256.0) || exponent != std::floor(exponent))
    return std::pow(base, exponent);
  double result = 1.0;
  for (auto bits = static_cast<unsigned>(exponent); bits != 0; bits >>= 1, base *= base)
    if (bits & 1u) result *= base;
  return result;
}

/// β for one child; `room` is the distance from the parent to its bound over the distance of the parents.
inline double sbx_spread(double room, double u, double index) {
  const double alpha = 2.0 - 1.0 / power(1.0 + 2.0 * room, index + 1.0);
  const double v = u * alpha;
  return std::exp(std::log(v <= 1.0 ? v : 1.0 / (2.0 - v)) / (index + 1.0));
}

/// Crosses two numbers of [0, 1] in place; `swap`: which child gets the lower one.
inline void sbx(double& first, double& second, double index, bool swap, doe::RandomStream& random) {
  const double a = std::min(first, second), b = std::max(first, second);
  if (b - a < 1e-14) return;  // closer than rounding resolves: children equal the parents
  const double u = random.uniform();
  const double low = 0.5 * (a + b - sbx_spread(a / (b - a), u, index) * (b - a));
  const double high = 0.5 * (a + b + sbx_spread((1.0 - b) / (b - a), u, index) * (b - a));
  first = std::clamp(swap ? high : low, 0.0, 1.0);
  second = std::clamp(swap ? low : high, 0.0, 1.0);
}

/// Mutates one number of [0, 1].
inline double polynomial_mutation(double y, double index, doe::RandomStream& random) {
  const double u = random.uniform(), root = 1.0 / (index + 1.0);
  const double delta = u < 0.5
                           ? std::pow(2.0 * u + (1.0 - 2.0 * u) * power(1.0 - y, index + 1.0), root) - 1.0
                           : 1.0 - std::pow(2.0 * (1.0 - u) + (2.0 * u - 1.0) * power(y, index + 1.0), root);
  return std::clamp(y + delta, 0.0, 1.0);
}

/// One step of the grid at least, back into the box from a bound.
inline double integer_mutation(double y, double steps, double index, doe::RandomStream& random) {
  const double at = std::round(y * steps);
  const double moved = std::round(polynomial_mutation(y, index, random) * steps);
  if (moved != at) return moved / steps;
  const double way = random.uniform() < 0.5 ? -1.0 : 1.0;
  return (at + way < 0.0 || at + way > steps ? at - way : at + way) / steps;
}

/// What the tournament compares: rank (the smaller the better), then distance (the larger the better).
struct Parents {
  const Population& points;
  std::vector<int> rank;
  std::vector<double> distance;

  Eigen::Index size() const { return points.size(); }
};

/// Assigns the parents to tournaments of two in random order, all of them once before any of them again, so
/// that each child-bearing round gives every parent the same number of chances.
class Tournaments {
 public:
  Tournaments(const Parents& parents, doe::RandomStream& random)
      : parents_(parents), random_(random), order_(parents.rank.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  /// A row of the parents.
  int winner() {
    const int a = next(), b = next();
    if (parents_.rank[a] != parents_.rank[b]) return parents_.rank[a] < parents_.rank[b] ? a : b;
    return parents_.distance[b] > parents_.distance[a] ? b : a;
  }

 private:
  int next() {
    if (assigned_ == order_.size()) assigned_ = 0;
    const auto left = static_cast<int>(order_.size() - assigned_);
    std::swap(order_[assigned_], order_[assigned_ + static_cast<std::size_t>(random_.below(left))]);
    return order_[assigned_++];
  }

  const Parents& parents_;
  doe::RandomStream& random_;
  std::vector<int> order_;
  std::size_t assigned_ = 0;
};

/// Makes children of the space's variables, one pair of columns (d each) at a time.
class Breeder {
 public:
  Breeder(SearchSpace space, const Rates& rates) : space_(std::move(space)), rates_(rates) {}

  const SearchSpace& space() const { return space_; }

  /// Both hold a parent each and become children.
  void breed(Eigen::Ref<Eigen::VectorXd> first, Eigen::Ref<Eigen::VectorXd> second,
             doe::RandomStream& random) const {
    if (random.uniform() < rates_.crossover_probability) cross(first, second, random);
    mutate(first, random);
    mutate(second, random);
  }

  /// count x d, parents by tournament.
  Eigen::MatrixXd children(const Parents& parents, int count, doe::RandomStream random) const {
    Eigen::MatrixXd result(space_.dimension(), count + count % 2);  // one per column while they are made
    Tournaments tournaments(parents, random);
    for (Eigen::Index i = 0; i < count; i += 2) {
      auto first = result.col(i), second = result.col(i + 1);
      first = parents.points.U.row(tournaments.winner()).transpose();
      second = parents.points.U.row(tournaments.winner()).transpose();
      breed(first, second, random);
    }
    return result.leftCols(count).transpose();
  }

 private:
  void cross(Eigen::Ref<Eigen::VectorXd> first, Eigen::Ref<Eigen::VectorXd> second,
             doe::RandomStream& random) const {
    for (Eigen::Index block = 0; block < first.size(); block += 64) {
      const Eigen::Index left = first.size() - block;
      std::uint64_t takes_part = random();  // one bit per variable
      const std::uint64_t swaps = random();
      if (left < 64) takes_part &= (std::uint64_t{1} << left) - 1;
      for (; takes_part != 0; takes_part &= takes_part - 1) {
        const int bit = std::countr_zero(takes_part);
        const Eigen::Index j = block + bit;
        sbx(first[j], second[j], rates_.crossover_index, (swaps >> bit) & 1u, random);
        first[j] = space_.nearest(first[j], j);
        second[j] = space_.nearest(second[j], j);
      }
    }
  }

  void mutate(Eigen::Ref<Eigen::VectorXd> child, doe::RandomStream& random) const {
    for (Eigen::Index j = 0; j < child.size(); ++j) {
      if (random.uniform() >= rates_.mutation_probability) continue;
      const double steps = space_.steps(j), index = rates_.mutation_index;
      child[j] = steps > 0.0 ? integer_mutation(child[j], steps, index, random)
                             : polynomial_mutation(child[j], index, random);
    }
  }

  SearchSpace space_;
  Rates rates_;
};

}  // namespace drawpoint::pareto::detail

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <drawpoint/doe/seed.hpp>
#include <vector>

using namespace drawpoint;
using namespace drawpoint::doe;

namespace {

// Published first outputs of splitmix64 for the seed 1234567.
TEST(RandomStream, IsSplitmix64) {
  RandomStream random(1234567);
  EXPECT_EQ(random(), 6457827717110365317ULL);
  EXPECT_EQ(random(), 3203168211198807973ULL);
}

// 40 x 40 x 40 seeds of 64 bits collide by chance with probability (64000²/2)·2⁻⁶⁴ = 1e-10.
TEST(RunSeed, StudiesRunsAndReplicatesDoNotShareSeeds) {
  std::vector<Seed> seeds;
  for (std::uint64_t study = 0; study < 40; ++study)
    for (std::uint64_t run = 0; run < 40; ++run)
      for (std::uint64_t replicate = 0; replicate < 40; ++replicate)
        seeds.push_back(run_seed(study, run, replicate));
  std::sort(seeds.begin(), seeds.end());
  EXPECT_EQ(std::adjacent_find(seeds.begin(), seeds.end()), seeds.end());
}

constexpr int cells = 64, draws = 64000;

/// χ² of counts that should be equal.
double chi_squared(const std::array<int, cells>& counts) {
  constexpr double expected = static_cast<double>(draws) / cells;
  double sum = 0.0;
  for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

// χ² with 63 degrees of freedom exceeds 63 + 5·sqrt(126) + 2·25/3 = 136 with probability 3e-7 (Cornish and
// Fisher); four tests at fixed seeds, so a false alarm after a change of the generator has probability 1e-6.
constexpr double chi_squared_bound = 136.0;

TEST(RandomStream, UniformsFillTheirCellsEvenly) {
  std::array<int, cells> first{}, pairs{}, across_runs{};
  RandomStream random(5);
  for (int i = 0; i < draws; ++i) {
    const double u = random.uniform(), v = random.uniform();
    ++first[static_cast<std::size_t>(u * cells)];
    ++pairs[static_cast<std::size_t>(u * 8) * 8 + static_cast<std::size_t>(v * 8)];
    ++across_runs[static_cast<std::size_t>(
        RandomStream(run_seed(1, static_cast<std::uint64_t>(i), 0)).uniform() * cells)];
  }
  EXPECT_LT(chi_squared(first), chi_squared_bound);
  EXPECT_LT(chi_squared(pairs), chi_squared_bound);
  EXPECT_LT(chi_squared(across_runs), chi_squared_bound);
}

TEST(RandomStream, NormalsFollowTheNormalDistribution) {
  std::array<int, cells> counts{};
  RandomStream random(6);
  for (int i = 0; i < draws; ++i) {
    const double probability = 0.5 * std::erfc(-random.normal() / std::sqrt(2.0));
    ++counts[std::min<std::size_t>(static_cast<std::size_t>(probability * cells), cells - 1)];
  }
  EXPECT_LT(chi_squared(counts), chi_squared_bound);
}

TEST(RandomStream, BelowReachesEveryNumberAndNoOther) {
  RandomStream random(7);
  std::array<int, 5> counts{};
  for (int i = 0; i < 500; ++i) ++counts.at(static_cast<std::size_t>(random.below(5)));
  for (const int count : counts) EXPECT_GT(count, 0);  // missing one by chance: 5·0.8^500 = 2e-48
}

}  // namespace

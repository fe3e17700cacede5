// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
// The full state of a pile under a moving blade, by its hash every 100 steps: equal in two runs, on 1, 2, 3
// and 8 threads, and when a snapshot file carries the run over in the middle. The long run, and Release
// against Debug with sanitizers, is benchmarks/scenario/state_hash.
#include <gtest/gtest.h>
#include <unistd.h>

#include <drawpoint/tests/support/dug_pile.hpp>

using namespace drawpoint;

namespace {

constexpr int rocks = 60, pieces = 3;

std::filesystem::path scratch() {
  return std::filesystem::temp_directory_path() / ("drawpoint_dug_pile_" + std::to_string(::getpid()));
}

/// Hashes after each hundred steps; `restart_at`: after that many hundreds through a snapshot file, -1:
/// never.
std::vector<std::uint64_t> hashes(int threads, int restart_at = -1) {
  engine::WorldOptions options;
  options.threads = threads;
  support::DugPile pile(rocks, options);
  std::vector<std::uint64_t> result;
  for (int k = 0; k < pieces; ++k) {
    if (k == restart_at) pile.restart(scratch());
    pile.run(100);
    result.push_back(pile.hash());
  }
  EXPECT_GT(pile.report().points, 100) << "the rocks must lie in a heap and some be pushed";
  return result;
}

TEST(StateHash, IsTheSameOnAnyThreadsInAnyRunAndAcrossASnapshotFile) {
  const auto expected = hashes(1);
  for (std::size_t k = 1; k < expected.size(); ++k)
    EXPECT_NE(expected[k], expected[k - 1]) << "nothing moved";
  EXPECT_EQ(hashes(1), expected) << "second run";
  for (int threads : {2, 3, 8}) EXPECT_EQ(hashes(threads), expected) << threads << " threads";
  EXPECT_EQ(hashes(1, 2), expected) << "across a snapshot file";
  EXPECT_EQ(hashes(3, 1), expected) << "across a snapshot file, on 3 threads";
}

}  // namespace

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <drawpoint/engine/loading/load_search.h>
#include <gtest/gtest.h>

#include <algorithm>

using namespace drawpoint::engine;
using drawpoint::engine::loading::LoadSearch;

namespace {

constexpr int bucket = 3, boom = 2;

SurfaceOwner rock(int k) { return {Owner::rock, k}; }
SurfaceOwner part(int k) { return {Owner::part, k}; }
const SurfaceOwner ground{Owner::fixed, 0};

PairForce touch(const SurfaceOwner& a, const SurfaceOwner& b, double force = 1) {
  PairForce pair{a, b};
  pair.force.z() = force;
  return pair;
}

std::vector<int> on(LoadSearch& search, int part) {
  std::vector<int> taken;
  search.take_on(part, taken);
  std::sort(taken.begin(), taken.end());
  return taken;
}

using Numbers = std::vector<int>;

}  // namespace

// Rocks 0 and 1 lie in the bucket and are named, 2 on 1, 3 on 2 and over the side; 4 leans on 0 from the floor and 5
// on 4, 6 lies on 5 and on the bucket's lip.
TEST(LoadSearch, TakesAHeapAndLeavesWhatHangsTogetherWithTheFloor) {
  LoadSearch search(std::vector<bool>(7, true), {0, 1},
                    {touch(part(bucket), rock(0)), touch(rock(1), part(bucket)), touch(rock(1), rock(2)),
                     touch(rock(3), rock(2)), touch(rock(4), rock(0)), touch(ground, rock(4)),
                     touch(rock(5), rock(4)), touch(rock(6), rock(5)), touch(rock(6), part(bucket))});
  EXPECT_EQ(on(search, bucket), (Numbers{0, 1, 2, 3}));
  EXPECT_TRUE(on(search, bucket).empty());  // taken before
}

// Shapes within the contact margin of each other touch only where they press.
TEST(LoadSearch, TakesNothingThroughAContactWithoutForce) {
  LoadSearch search(std::vector<bool>(2, true), {},
                    {touch(part(bucket), rock(0)), touch(rock(0), rock(1), 0), touch(ground, rock(0), 0)});
  EXPECT_EQ(on(search, bucket), Numbers{0});
}

TEST(LoadSearch, GoesThroughAllowedRocksOnly) {
  LoadSearch search({true, false, true}, {},
                    {touch(part(bucket), rock(0)), touch(rock(0), rock(1)), touch(rock(1), rock(2))});
  EXPECT_EQ(on(search, bucket), Numbers{0});
}

// A named rock is taken though it touches the floor, with what lies on it; one on the boom is the boom's.
TEST(LoadSearch, BeginsAtARockOrAPart) {
  LoadSearch search(std::vector<bool>(4, true), {0},
                    {touch(ground, rock(0)), touch(rock(0), rock(1)), touch(part(boom), rock(2)),
                     touch(part(boom), rock(1)), touch(ground, rock(3)), touch(part(boom), rock(3))});
  std::vector<int> taken;
  search.take(0, taken);
  EXPECT_EQ(taken, (Numbers{0, 1}));
  EXPECT_EQ(on(search, boom), Numbers{2});
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
/// Which moments become frames: counts and times known exactly.

#include <drawpoint/studies/say/frames/frame_times.h>
#include <gtest/gtest.h>

using namespace drawpoint::studies;

namespace {

// n = 1 + floor((to - from)·fps/speed), by hand.
TEST(FrameTimes, BothEndsCount) {
  EXPECT_EQ(frame_count({.from = 0, .to = 2, .fps = 20}), 41);
  EXPECT_EQ(frame_count({.from = 0, .to = 2, .fps = 20, .speed = 2}), 21);
  EXPECT_EQ(frame_count({.from = 0, .to = 2, .fps = 20, .speed = 0.5}), 81);
  EXPECT_EQ(frame_count({.from = 3, .to = 3, .fps = 20}), 1);
  EXPECT_EQ(frame_count({.from = 0, .to = 2.04, .fps = 20}), 41);
  EXPECT_EQ(frame_count({.from = 0, .to = 2.05, .fps = 20}), 42);
}

// None of these products is whole in binary: some are a little more, some a little less.
TEST(FrameTimes, RoundOffCostsNoFrame) {
  for (int tenths = 1; tenths < 1000; ++tenths)
    EXPECT_EQ(frame_count({.from = 0.1, .to = 0.1 * (1 + tenths), .fps = 10}), tenths + 1);
}

TEST(FrameTimes, AreEvenlySpacedAndEndInTime) {
  const auto times = all_times({.from = 1.5, .to = 4.0, .fps = 4, .speed = 3});
  ASSERT_EQ(times, (std::vector<double>{1.5, 2.25, 3.0, 3.75}));
  for (int tenths = 1; tenths < 1000; ++tenths) {
    const double to = 0.1 * (1 + tenths);
    EXPECT_LE(all_times({.from = 0.1, .to = to, .fps = 10}).back(), to);
  }
}

TEST(FrameTimes, AbsurdOnesAreCountedToo) {
  EXPECT_GT(frame_count({.from = 0, .to = 1e9, .fps = 240, .speed = 0.01}), 1e13);
}

}  // namespace

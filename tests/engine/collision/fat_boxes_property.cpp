// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <drawpoint/engine/collision/fat_boxes.h>
#include <drawpoint/tests/support/rock_heap.hpp>

// A box that a collider has not left holds all that it must; those that have been left look ahead.
using namespace drawpoint;
using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using engine::detail::FatBoxes;
using engine::detail::HullLibrary;
using engine::detail::Items;

namespace {

constexpr double growth = 0.005, slack = 0.02;  // [m]

// One rock on its way, and its box.
class Walker {
 public:
  Walker() {
    items.add(hulls_.make_item(support::collider_of(support::share(support::rock(2).scaled(0.5)), 0)),
              Eigen::Isometry3d::Identity());
    place(Eigen::Isometry3d::Identity());
    box = boxes.first(items, 0);
  }

  void place(const Eigen::Isometry3d& pose, double reach = 0) {
    pose_ = pose;
    items.place(0, pose);
    items.extend(0, reach);
  }
  const Eigen::Isometry3d& pose() const { return pose_; }

  // Whether it took another box.
  bool renewed() {
    if (!boxes.has_left(items, 0, box)) return false;
    box = boxes.next(items, 0, box);
    return true;
  }

  FatBoxes boxes{growth, slack};
  Items items;
  AlignedBox3d box;

 private:
  HullLibrary hulls_;
  Eigen::Isometry3d pose_;
};

// How far the box reaches beyond what it must hold, on the side where it does least.
double room(const Walker& walker) {
  const AlignedBox3d tight = walker.items.box(0);
  const double must = growth + walker.items.speculative_margin[0];
  return std::min((tight.min() - walker.box.min()).minCoeff(), (walker.box.max() - tight.max()).minCoeff()) -
         must;
}

}  // namespace

TEST(FatBoxes, HoldWhatTheyMustUntilTheyAreLeft) {
  constexpr double round_off = 1e-12;  // of a motion bound that sums metres, some thousand steps long
  constexpr double ways[] = {1e-4, 0.003, 0.015, 0.05}, turns[] = {0, 0.002, 0.02, 0.2};
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> reaches(0, 0.01);
  Walker walker;
  int renewals = 0, kept = 0;
  for (int k = 0; k < 4000; ++k) {
    const bool new_reach = k % 50 == 0;
    walker.place(support::moved(walker.pose(), rng, ways[k / 7 % 4], turns[k / 28 % 4]),
                 new_reach ? reaches(rng) : walker.items.speculative_margin[0]);
    if (walker.renewed()) {
      ++renewals;
      ASSERT_GE(room(walker), slack - round_off);
    } else {
      ++kept;
      ASSERT_GE(room(walker), -round_off) << "step " << k;
    }
  }
  EXPECT_GT(renewals, 400);
  EXPECT_GT(kept, 400);
}

// 15 mm per step: the first box is left after 20 mm, in the second step, and each of the others, which have
// 40 mm ahead, in the third after it was made.
TEST(FatBoxes, LookAhead) {
  Walker walker;
  int renewals = 0;
  for (int step = 1; step <= 32; ++step) {
    walker.place(Eigen::Isometry3d(Eigen::Translation3d(0.015 * step, 0, 0)));
    const bool renewed = walker.renewed();
    EXPECT_EQ(renewed, step % 3 == 2) << "step " << step;
    renewals += renewed;
  }
  EXPECT_EQ(renewals, 11);
}

// Its motion bound runs on, but it stays within 1 mm.
TEST(FatBoxes, AreKeptByWhatTrembles) {
  Walker walker;
  for (int step = 0; step < 1000; ++step) {
    walker.place(Eigen::Isometry3d(Eigen::Translation3d(step % 2 == 0 ? 0.001 : 0, 0, 0)));
    EXPECT_FALSE(walker.renewed()) << "step " << step;
  }
}

// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <drawpoint/tests/support/narrow_methods.hpp>
#include <drawpoint/tests/support/rock_heap.hpp>
#include <memory>
#include <stdexcept>

// Threads and snapshots change no bit; what cannot be a snapshot is refused.
using namespace drawpoint;
using engine::ContactFinder;
using engine::ContactFinderOptions;
using engine::Manifold;
using support::RockHeap;
using support::same_bits;

namespace {

constexpr int rocks = 120;

// Steps from creeping to throwing, with rocks that are taken away on the way.
void step(RockHeap& heap, int k) {
  constexpr double steps[] = {1e-6, 2e-4, 5e-3, 5e-4, 0, 0.04, 1e-3};
  heap.shake(steps[k % 7], steps[(k + 2) % 7]);
  if (k == 9) heap.finder().remove(100), heap.drop(99);
}

std::string refusal(ContactFinder& finder, std::span<const std::byte> bytes) {
  try {
    finder.restore(bytes);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::vector<std::byte> saved(RockHeap& heap) { return heap.finder().save(); }

class ContactFinderBits : public support::ByNarrowMethod {};

}  // namespace

INSTANTIATE_TEST_SUITE_P(Narrow, ContactFinderBits, support::every_narrow_method,
                         support::narrow_method_name);

TEST_P(ContactFinderBits, AreTheSameOnAnyNumberOfThreads) {
  constexpr int steps = 30;
  std::vector<std::vector<Manifold>> expected;
  RockHeap one(rocks, 31, options());
  for (int k = 0; k < steps; ++k) {
    step(one, k);
    expected.push_back(one.finder().find());
    ASSERT_GT(expected.back().size(), 100u);
  }
  EXPECT_GT(one.finder().times().pairs, 300) << "too few pairs for more than one block";
  for (int threads : {2, 3, 8}) {
    RockHeap other(rocks, 31, options(), threads);
    for (int k = 0; k < steps; ++k) {
      step(other, k);
      ASSERT_TRUE(same_bits(expected[k], other.finder().find())) << threads << " threads, step " << k;
    }
  }
}

TEST(ContactFinderThreads, MustBeAtLeastOne) {
  EXPECT_THROW(engine::ThreadPool{0}, std::invalid_argument);
  EXPECT_THROW(engine::ThreadPool{257}, std::invalid_argument);
}

// At every step of a run, before find() as well as after it: what is restored goes on as if nothing had been,
// on another number of threads.
TEST_P(ContactFinderBits, ContinueFromASavedState) {
  for (const bool before_find : {false, true})
    for (int at : {0, 3, 9, 12, 17}) {
      RockHeap whole(rocks, 32, options(), before_find ? 3 : 1),
          copy(rocks, 32, options(), before_find ? 1 : 3);
      if (at > 9) copy.finder().remove(100), copy.drop(99);
      for (int k = 0; k < at + 9; ++k) {
        step(whole, k);
        if (k == at && !before_find) whole.finder().find();
        if (k == at) {
          copy.follow(whole);
          if (at == 9) copy.finder().remove(100), copy.drop(99);
          copy.finder().restore(saved(whole));
        }
        if (k > at) step(copy, k);
        const std::vector<Manifold> expected = whole.finder().find();
        if (k < at) continue;
        ASSERT_TRUE(same_bits(expected, copy.finder().find())) << "saved at " << at << ", step " << k;
        ASSERT_EQ(whole.finder().times().computed, copy.finder().times().computed);
        ASSERT_EQ(saved(whole), saved(copy)) << "saved at " << at << ", step " << k;
      }
    }
}

TEST(ContactFinderState, RefusesWhatIsCutOrChanged) {
  RockHeap heap(20, 33);
  heap.finder().find();
  const auto bytes = saved(heap);
  RockHeap other(20, 33);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50)
    ASSERT_NE(refusal(other.finder(), std::span(bytes).first(size)), "") << size << " bytes";
  for (std::size_t at = 0; at < bytes.size(); at += 1 + at / 50) {
    auto changed = bytes;
    changed[at] ^= std::byte{0x10};
    ASSERT_NE(refusal(other.finder(), changed), "") << "byte " << at;
  }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_NE(refusal(other.finder(), longer), "");
  // Nothing of the above stuck.
  EXPECT_TRUE(same_bits(heap.finder().find(), other.finder().find()));
}

TEST(ContactFinderState, RefusesTheStateOfAnotherFinder) {
  RockHeap heap(20, 33);
  heap.finder().find();
  const auto bytes = saved(heap);
  RockHeap fewer(19, 33), wider(20, 33, ContactFinderOptions{.margin = 0.02}),
      by_fcl(20, 33, ContactFinderOptions{.narrow = engine::NarrowMethod::fcl_libccd}), removed(20, 33);
  removed.finder().remove(4);
  EXPECT_NE(refusal(fewer.finder(), bytes).find("the state has 21 colliders, here there are 20"),
            std::string::npos);
  EXPECT_NE(refusal(wider.finder(), bytes).find("an option"), std::string::npos);
  EXPECT_NE(refusal(by_fcl.finder(), bytes).find("an option"), std::string::npos);
  EXPECT_NE(refusal(removed.finder(), bytes).find("collider 4 is removed on one side only"),
            std::string::npos);
  ContactFinder shapes;
  for (int k = 0; k < 21; ++k) shapes.add(support::collider_of(support::share(engine::box({1, 1, 1})), k));
  EXPECT_NE(refusal(shapes, bytes).find("the number of vertices"), std::string::npos);
}

namespace {

// What save() puts at the end.
void sign(std::vector<std::byte>& bytes) {
  std::uint64_t sum = 0xcbf29ce484222325;
  for (std::size_t k = 0; k + 8 < bytes.size(); ++k)
    sum = (sum ^ static_cast<std::uint64_t>(bytes[k])) * 0x100000001b3;
  std::memcpy(bytes.data() + bytes.size() - 8, &sum, 8);
}

}  // namespace

// With a checksum that fits, the checks behind it are alone: whatever passes them must not crash, and must
// give numbers.
TEST(ContactFinderState, SurvivesHostileStates) {
  RockHeap heap(20, 34);
  heap.finder().find();
  const auto bytes = saved(heap);
  std::mt19937 rng(35);
  int refused = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    auto changed = bytes;
    for (int k = 0; k < 1 + trial % 3; ++k)
      changed[rng() % changed.size()] = static_cast<std::byte>(rng() % 256);
    sign(changed);
    RockHeap other(20, 34);
    refused += refusal(other.finder(), changed).empty() ? 0 : 1;
    other.shake(1e-3, 1e-3);
    for (const Manifold& m : other.finder().find()) {
      ASSERT_TRUE(m.normal.allFinite());
      for (int k = 0; k < m.count; ++k) ASSERT_TRUE(std::isfinite(m.points[k].gap)) << "trial " << trial;
    }
  }
  EXPECT_GT(refused, 300);
}

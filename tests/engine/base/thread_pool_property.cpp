// SPDX-FileCopyrightText: Drawpoint contributors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <drawpoint/engine/base/thread_pool.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

// Every block is done once, by one of the threads that were asked for, and what it wrote is there afterwards.
using drawpoint::engine::ThreadPool;

namespace {

constexpr int thread_counts[] = {1, 2, 3, 8};

// Blocks of one loop write plainly, as those of the engine do: the caller must see it all at the end.
void expect_each_once(const ThreadPool& parallel, int count, int block) {
  std::vector<int> visits(static_cast<std::size_t>(count), 0);
  parallel.blocks(count, block, [&](int begin, int end) {
    for (int k = begin; k < end; ++k) ++visits[static_cast<std::size_t>(k)];
  });
  for (int k = 0; k < count; ++k) ASSERT_EQ(visits[static_cast<std::size_t>(k)], 1) << k << " of " << count;
}

}  // namespace

TEST(ThreadPool, DoesEachBlockOnce) {
  for (const int threads : thread_counts) {
    const ThreadPool parallel(threads);
    for (const bool in_a_region : {false, true}) {
      std::optional<ThreadPool::Region> region;
      if (in_a_region) region.emplace(parallel);
      for (int count = 0; count < 200; count += 7)
        for (const int block : {1, 8, 64}) expect_each_once(parallel, count, block);
    }
  }
}

// Loop k + 1 reads what others wrote in loop k.
TEST(ThreadPool, EndsALoopBeforeTheNext) {
  constexpr int cells = 64, loops = 2000;
  for (const int threads : thread_counts) {
    const ThreadPool parallel(threads);
    const ThreadPool::Region region(parallel);
    std::vector<int> now(cells, 0), next(cells, 0);
    for (int loop = 0; loop < loops; ++loop) {
      parallel.run(cells, threads, [&](int k) {
        next[static_cast<std::size_t>(k)] = now[static_cast<std::size_t>((k + cells / 2) % cells)] + 1;
      });
      now.swap(next);
    }
    for (const int value : now) ASSERT_EQ(value, loops) << threads << " threads";
  }
}

TEST(ThreadPool, NumbersItsThreads) {
  constexpr int count = 5000;
  for (const int threads : thread_counts) {
    const ThreadPool parallel(threads);
    std::vector<int> sums(static_cast<std::size_t>(threads), 0);
    for (int loop = 0; loop < 50; ++loop)
      parallel.blocks_by_thread(count, 16, [&](int begin, int end, int thread) {
        ASSERT_GE(thread, 0);
        ASSERT_LT(thread, threads);
        sums[static_cast<std::size_t>(thread)] += end - begin;  // no other thread has this number
      });
    int sum = 0;
    for (const int part : sums) sum += part;
    EXPECT_EQ(sum, 50 * count);
  }
}

TEST(ThreadPool, HandsOnWhatABlockThrowsAndGoesOn) {
  for (const int threads : thread_counts) {
    const ThreadPool parallel(threads);
    const ThreadPool::Region region(parallel);
    for (int loop = 0; loop < 100; ++loop) {
      const int bad = loop % 20;
      try {
        parallel.run(20, threads, [&](int k) {
          if (k == bad) throw std::runtime_error(std::to_string(k));
        });
        FAIL() << "nothing came out";
      } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), std::to_string(bad));
      }
      expect_each_once(parallel, 100, 3);
    }
  }
}

// Whoever comes to it first: of two blocks that throw, what the earlier one throws comes out.
TEST(ThreadPool, HandsOnWhatTheFirstBlockThrows) {
  for (const int threads : thread_counts) {
    const ThreadPool parallel(threads);
    for (int loop = 0; loop < 100; ++loop) {
      std::string seen;
      try {
        parallel.run(20, threads, [](int k) {
          if (k == 5 || k == 17) throw std::runtime_error(std::to_string(k));
        });
      } catch (const std::runtime_error& error) {
        seen = error.what();
      }
      ASSERT_EQ(seen, "5") << threads << " threads";
    }
  }
}

// The second may find no helpers while the first is on region.
TEST(ThreadPool, TeamsMayBeOnShiftTogether) {
  const ThreadPool one(3), other(2);
  const ThreadPool::Region first(one), second(other);
  for (int k = 0; k < 100; ++k) {
    expect_each_once(one, 50, 2);
    expect_each_once(other, 50, 2);
  }
}

TEST(ThreadPool, ShiftsMayLieWithinOneAnother) {
  const ThreadPool parallel(3);
  const ThreadPool::Region outer(parallel);
  for (int k = 0; k < 100; ++k) {
    const ThreadPool::Region inner(parallel);
    expect_each_once(parallel, 50, 2);
  }
  expect_each_once(parallel, 50, 2);
}

// A loop may be kept to fewer threads than there are.
TEST(ThreadPool, KeepsToTheThreadsThatALoopMayHave) {
  const ThreadPool parallel(8);
  const ThreadPool::Region region(parallel);
  std::atomic<int> inside{0}, most{0};
  for (int loop = 0; loop < 200; ++loop)
    parallel.run(64, 2, [&](int) {
      const int now = ++inside;
      for (int seen = most.load(); seen < now && !most.compare_exchange_weak(seen, now);) continue;
      --inside;
    });
  EXPECT_LE(most.load(), 2);
}
